//! Shapes: meshes of every format as Mitsuba turns them, and groups with their instances.

use super::{SENSOR, close, scene};
use crate::load_mitsuba_text;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use hyaline_math::DVec3;
use hyaline_scene::{MaterialKind, MeshData, SceneDescription, SceneError, ShapeDescription};
use std::io::Write;
use std::sync::Arc;

/// A bent strip of two triangles, without normals.
const STRIP: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nvt 0 0\nvt 1 0.25\n";

fn with_files(files: &[(&str, &[u8])], body: &str) -> Result<SceneDescription, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, bytes)| std::fs::write(folder.path().join(name), bytes).unwrap());
    let text = format!("<scene version='0.6.0'>{SENSOR}\n{body}</scene>");
    load_mitsuba_text(&text, "scene.xml", folder.path(), &[])
}

fn mesh(scene: &SceneDescription, object: usize) -> (Arc<MeshData>, bool) {
    match &scene.objects[object].shape {
        ShapeDescription::Mesh { mesh, flat } => (mesh.clone(), *flat),
        other => panic!("{other:?}"),
    }
}

/// The normal of a face by its winding.
fn face_normal(mesh: &MeshData, face: usize) -> DVec3 {
    let [a, b, c] = mesh.triangles[face].map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
    (b - a).cross(c - a).normalize()
}

fn obj(faces: &str, properties: &str) -> (Arc<MeshData>, bool) {
    let text = STRIP.to_owned() + faces;
    let body = format!("<shape type='obj'><string name='filename' value='a.obj'/>{properties}</shape>");
    mesh(&with_files(&[("a.obj", text.as_bytes())], &body).unwrap(), 0)
}

#[test]
fn meshes_without_normals_are_smooth_unless_told_otherwise() {
    let (smooth, flat) = obj("f 1 2 3\nf 1 3 4\n", "");
    assert!(!flat && smooth.normals.len() == 4);
    let shared = DVec3::from(smooth.normals[0].map(f64::from));
    let (first, second) = (face_normal(&smooth, 0), face_normal(&smooth, 1));
    assert!(shared.dot(first) > first.dot(second) + 0.01, "between the normals of its faces");
    let (faceted, flat) = obj("f 1 2 3\nf 1 3 4\n", "<boolean name='faceNormals' value='true'/>");
    assert!(flat && faceted.normals.is_empty());
}

#[test]
fn normals_tell_the_outside_and_flipping_turns_it() {
    let with_normals = "vn 0 0 1\nvn 0 0 1\nf 3//1 2//1 1//1\n";
    assert!(face_normal(&obj(with_normals, "").0, 0).z > 0.0, "the winding gives in to the normals");
    let flipped = obj(with_normals, "<boolean name='flipNormals' value='true'/>").0;
    assert!(face_normal(&flipped, 0).z < 0.0 && flipped.normals[0][2] < 0.0);
    let flat = obj(with_normals, "<boolean name='faceNormals' value='true'/>").0;
    assert!(face_normal(&flat, 0).z < 0.0, "without normals the winding counts");
}

#[test]
fn mirrors_turn_meshes_without_normals_inside_out() {
    let mirror = "<transform name='toWorld'><scale x='-1'/></transform>";
    assert!(face_normal(&obj("f 1 2 3\n", "").0, 0).z > 0.0);
    assert!(
        face_normal(&obj("f 1 2 3\n", mirror).0, 0).z < 0.0,
        "in object space; the placement turns nothing"
    );
    assert!(face_normal(&obj("vn 0 0 1\nf 1//1 2//1 3//1\n", mirror).0, 0).z > 0.0);
}

#[test]
fn texture_coordinates_of_obj_files_are_upside_down() {
    assert_eq!(obj("f 1/1 2/2 3/2\n", "").0.uvs[1], [1.0, 0.75]);
    let as_they_are = "<boolean name='flipTexCoords' value='false'/>";
    assert_eq!(obj("f 1/1 2/2 3/2\n", as_they_are).0.uvs[1], [1.0, 0.25]);
}

#[test]
fn materials_of_obj_files_take_bsdfs_of_their_names() {
    let text = STRIP.to_owned() + "usemtl Glass\nf 1 2 3\nusemtl red\nf 1 3 4\nusemtl unused\n";
    let body = "<shape type='obj' id='o'><string name='filename' value='a.obj'/>\
                <bsdf name='Glass' type='dielectric'><float name='intIOR' value='1.5'/>\
                <float name='extIOR' value='1'/></bsdf><bsdf name='red' type='diffuse'/></shape>";
    let scene = with_files(&[("a.obj", text.as_bytes())], body).unwrap();
    assert_eq!(scene.notes, []);
    assert_eq!(scene.objects.len(), 2);
    assert!(matches!(scene.materials[0].kind, MaterialKind::Dielectric { .. }));
    assert_eq!(scene.objects[1].material.value, scene.materials[1].name);
    let (first, second) = (mesh(&scene, 0).0, mesh(&scene, 1).0);
    assert_eq!((first.triangles.len(), first.positions.len()), (1, 3));
    assert_eq!(second.positions[2], [0.0, 1.0, 1.0]);
    let plain = "<shape type='obj'><string name='filename' value='a.obj'/></shape>";
    let scene = with_files(&[("a.obj", text.as_bytes())], plain).unwrap();
    assert_eq!(scene.objects.len(), 1);
    assert!(scene.notes[0].message.contains("materials of an OBJ file"), "{}", scene.notes[0]);
}

/// A file of two meshes: a triangle at z = 0, and one at z = 5 with normals and coordinates.
fn serialized(version: u16, is_double: bool) -> Vec<u8> {
    let number = |value: f64| match is_double {
        true => value.to_le_bytes().to_vec(),
        false => (value as f32).to_le_bytes().to_vec(),
    };
    let mut bytes = Vec::new();
    let mut offsets = Vec::new();
    for (z, extras) in [(0.0, 0u32), (5.0, 0x0b)] {
        offsets.push(bytes.len());
        bytes.extend([0x041cu16, version].iter().flat_map(|n| n.to_le_bytes()));
        let mut content = if version == 4 { b"name\0".to_vec() } else { Vec::new() };
        let precision = if is_double { 0x2000 } else { 0x1000 };
        content.extend((extras | precision | if extras == 0 { 0x10 } else { 0 }).to_le_bytes());
        content.extend([3u64, 1].iter().flat_map(|n| n.to_le_bytes()));
        let mut put = |values: &[f64]| values.iter().for_each(|value| content.extend(number(*value)));
        put(&[0.0, 0.0, z, 1.0, 0.0, z, 0.0, 1.0, z]);
        if extras != 0 {
            put(&[0.0, 0.0, 1.0].repeat(3));
            put(&[0.0, 0.0, 1.0, 0.0, 0.5, 1.0]);
            put(&[0.25; 9]);
        }
        content.extend([0u32, 1, 2].iter().flat_map(|n| n.to_le_bytes()));
        let mut encoder = ZlibEncoder::new(&mut bytes, Compression::fast());
        encoder.write_all(&content).unwrap();
        encoder.finish().unwrap();
    }
    for offset in offsets {
        if version == 4 {
            bytes.extend((offset as u64).to_le_bytes());
        } else {
            bytes.extend((offset as u32).to_le_bytes());
        }
    }
    bytes.extend(2u32.to_le_bytes());
    bytes
}

#[test]
fn serialized_meshes_are_read_in_both_versions_and_precisions() {
    for version in [3, 4] {
        for is_double in [false, true] {
            let shape = |index: u32| {
                format!(
                    "<shape type='serialized'><string name='filename' value='a.serialized'/>\
                     <integer name='shapeIndex' value='{index}'/></shape>"
                )
            };
            let files: &[(&str, &[u8])] = &[("a.serialized", &serialized(version, is_double))];
            let scene = with_files(files, &(shape(0) + &shape(1))).unwrap();
            assert_eq!(scene.notes, []);
            let ((first, first_flat), (second, flat)) = (mesh(&scene, 0), mesh(&scene, 1));
            assert!(first_flat && !flat, "the first says that it has face normals");
            assert_eq!(first.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
            assert_eq!(second.positions[1], [1.0, 0.0, 5.0]);
            assert_eq!((second.normals[2], second.uvs[2]), ([0.0, 0.0, 1.0], [0.5, 1.0]));
            assert_eq!(second.triangles, [[0, 1, 2]]);
            let error = with_files(files, &shape(2)).unwrap_err().to_string();
            assert!(error.contains("no mesh 2 in a file of 2") && error.contains("scene.xml:2:"), "{error}");
        }
    }
}

#[test]
fn damaged_serialized_meshes_are_refused_in_words() {
    let shape = "<shape type='serialized'><string name='filename' value='a.serialized'/></shape>";
    let sound = serialized(4, false);
    let changed = |at: usize, byte: u8| {
        let mut bytes = sound.clone();
        bytes[at] = byte;
        bytes
    };
    for (bytes, message) in [
        (Vec::new(), "ends before"),
        (b"not a mesh at all".to_vec(), "not a serialized mesh"),
        (changed(2, 7), "version 7"),
        (changed(6, 0xff), "damaged"),
        (sound[..sound.len() - 6].to_vec(), "in a file of 0"),
        (changed(sound.len() - 1, 0xff), "ends before"),
    ] {
        let error = with_files(&[("a.serialized", &bytes)], shape).unwrap_err().to_string();
        assert!(error.contains(message), "{message}: {error}");
    }
    // Counts that no file of this size can hold are not believed.
    let mut content = b"\0".to_vec();
    content.extend(0x1000u32.to_le_bytes());
    content.extend([4_000_000_000u64, 4_000_000_000].iter().flat_map(|n| n.to_le_bytes()));
    let mut bytes = vec![0x1c, 0x04, 4, 0];
    let mut encoder = ZlibEncoder::new(&mut bytes, Compression::fast());
    encoder.write_all(&content).unwrap();
    encoder.finish().unwrap();
    bytes.extend(0u64.to_le_bytes());
    bytes.extend(1u32.to_le_bytes());
    let error = with_files(&[("a.serialized", &bytes)], shape).unwrap_err().to_string();
    assert!(error.contains("more than its file can hold"), "{error}");
}

const GROUP: &str = "<shape type='shapegroup' id='g'><shape type='obj'><string name='filename' value='a.obj'/></shape>\
                     <shape type='sphere'><transform name='toWorld'><translate y='1'/></transform>\
                     <bsdf type='dielectric'><float name='extIOR' value='1'/></bsdf></shape></shape>";

#[test]
fn instances_place_each_member_of_their_group_and_share_its_mesh() {
    let text = STRIP.to_owned() + "f 1 2 3\n";
    let body = format!(
        "{GROUP}<shape type='instance'><ref id='g'/></shape><shape type='instance' id='far'><ref id='g'/>\
         <transform name='toWorld'><scale value='2'/><translate x='10'/></transform></shape>"
    );
    let scene = with_files(&[("a.obj", text.as_bytes())], &body).unwrap();
    assert_eq!(scene.notes, []);
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["g/a", "g/sphere-1", "far/a", "far/sphere-1"]);
    assert!(Arc::ptr_eq(&mesh(&scene, 0).0, &mesh(&scene, 2).0));
    assert!(close(scene.objects[3].placement.point(DVec3::ZERO), DVec3::new(10.0, 2.0, 0.0)));
    assert_eq!(scene.objects[1].boundary, scene.objects[3].boundary);
    assert_eq!(scene.media.len(), 1);
}

#[test]
fn shapes_of_one_file_share_its_mesh() {
    let text = STRIP.to_owned() + "f 1/1 2/1 3/1\n";
    let shape = "<shape type='obj'><string name='filename' value='a.obj'/></shape>";
    let scene = with_files(&[("a.obj", text.as_bytes())], &shape.repeat(2)).unwrap();
    assert!(Arc::ptr_eq(&mesh(&scene, 0).0, &mesh(&scene, 1).0));
}

#[test]
fn groups_that_cannot_be_are_named() {
    let error = |body: &str| with_files(&[], body).unwrap_err().to_string();
    assert!(error("<shape type='instance'/>").contains("scene.xml:2:1: an instance needs a shapegroup"));
    let own = "<shape type='shapegroup' id='g'><shape type='instance'><ref id='g'/></shape></shape>\
               <shape type='instance'><ref id='g'/></shape><shape type='sphere'/>";
    let scene = scene(own);
    assert_eq!(scene.objects.len(), 1);
    assert!(scene.notes[0].message.contains("shape 'instance' within a group"), "{}", scene.notes[0]);
    let many = "<shape type='sphere'/>".repeat(70);
    let instances = "<shape type='instance'><ref id='g'/></shape>".repeat(70);
    let bomb = error(&format!("<shape type='shapegroup' id='g'>{many}</shape>{instances}"));
    assert!(bomb.contains("more than 4096 objects"), "{bomb}");
}

#[test]
fn lamps_in_groups_are_noted() {
    let scene = scene(
        "<shape type='shapegroup' id='g'><shape type='sphere'><emitter type='area'/></shape></shape>\
         <shape type='instance'><ref id='g'/></shape>",
    );
    assert!(scene.objects[0].emission.is_some());
    assert!(scene.notes[0].message.contains("shine in every instance"), "{}", scene.notes[0]);
}

#[test]
fn merged_shapes_are_the_shapes() {
    let scene = scene("<shape type='merge'><shape type='sphere'/><shape type='cube'/></shape>");
    assert_eq!((scene.objects.len(), scene.notes.len()), (2, 0));
}

#[test]
fn shapes_that_there_are_not_are_listed() {
    for kind in ["hair", "heightfield", "bsplinecurve", "sdfgrid", "deformable"] {
        let scene = scene(&format!(
            "<shape type='sphere'/><shape type='{kind}'><string name='filename' value='a'/><bsdf type='diffuse'/></shape>"
        ));
        let notes: Vec<&str> = scene.notes.iter().map(|note| note.message.as_str()).collect();
        assert_eq!(notes, [format!("shape '{kind}' is not supported and left out")]);
        assert_eq!(scene.objects.len(), 1);
    }
}

#[test]
fn what_belongs_to_a_shape_and_is_not_read_is_listed() {
    let scene = scene(
        "<shape type='sphere'><bsdf type='diffuse'/><bsdf type='null'/><subsurface type='dipole'/>\
         <float name='maxSmoothAngle' value='30'/></shape>",
    );
    let notes: Vec<&str> = scene.notes.iter().map(|note| note.message.as_str()).collect();
    assert!(notes.contains(&"shape 'sphere' has several bsdfs; the first counts"), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("subsurface 'dipole'")), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("`max_smooth_angle`")), "{notes:?}");
}
