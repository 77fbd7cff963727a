//! Choosing the reader, and files beside the scene.

use hyaline_formats::{load, load_image, load_mesh};
use hyaline_scene::{LightKind, ShapeDescription};
use std::fs;
use std::path::Path;
use std::sync::Arc;

#[test]
fn the_ending_chooses_the_reader() {
    let folder = tempfile::tempdir().unwrap();
    let error = |name: &str| load(&folder.path().join(name), &[]).unwrap_err().to_string();
    for name in ["a.gltf", "a.GLB", "a.pbrt"] {
        assert!(error(name).contains("can't be read yet"), "{}", error(name));
    }
    assert!(error("a.blend").contains(".toml") && error("a.blend").contains(".xml"));
    assert!(error("a").contains("tells no scene format"));
    assert!(error("a.toml").contains("there is no such file"));
    fs::write(folder.path().join("bad.toml"), b"a = 1\nb = \"\xff\"\n").unwrap();
    assert!(error("bad.toml").contains("bad.toml:2: not a text in UTF-8"), "{}", error("bad.toml"));
}

#[test]
fn files_are_found_beside_the_scene_and_shared() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    fs::write(folder.path().join("meshes/a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        .unwrap();
    let mut sky = b"Pf 1 1 -1.0\n".to_vec();
    sky.extend(2f32.to_le_bytes());
    fs::write(folder.path().join("sky.pfm"), sky).unwrap();
    let text = "camera = { from = [0, 0, 4] }\n\
                object = [{ kind = 'mesh', file = 'meshes/a.obj', flat = true, slots = { red = { kind = 'mirror' } } },\n\
                { kind = 'mesh', file = 'meshes/a.obj' }]\n\
                light = { kind = 'environment', file = 'sky.pfm' }\n";
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    let scene = load(&path, &[]).unwrap();
    let mesh = |i: usize| match &scene.objects[i].shape {
        ShapeDescription::Mesh { mesh, flat } => (mesh.clone(), *flat),
        other => panic!("{other:?}"),
    };
    assert!(mesh(0).1 && !mesh(1).1);
    assert!(Arc::ptr_eq(&mesh(0).0, &mesh(1).0), "one file is read once");
    assert_eq!(scene.objects[0].slot_materials[0].0, "red");
    let LightKind::Environment { image: Some(name), .. } = &scene.lights[0].kind else { panic!("no image") };
    assert!(scene.textures.iter().any(|texture| texture.name == name.value));
    assert_eq!(load_image(&folder.path().join("sky.pfm")).unwrap().pixels, [[2.0; 3]]);
    assert_eq!(load_mesh(&folder.path().join("meshes/a.obj")).unwrap().triangles.len(), 1);
}

#[test]
fn faults_in_a_mesh_name_the_mesh_and_its_line() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), "v 0 0 0\nf 1 2 3\n").unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, "camera = { from = [0, 0, 4] }\nobject = { kind = 'mesh', file = 'a.obj' }\n").unwrap();
    let error = load(&path, &[]).unwrap_err().to_string();
    assert!(error.contains("a.obj:2: vertex index '2' is out of range"), "{error}");
}

#[test]
fn the_gallery_loads_without_warnings() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let scene = load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(scene.notes, [], "{}", path.display());
            count += 1;
        }
    }
    assert!(count > 0, "the gallery is empty");
}

/// A million triangles as binary PLY: a grid of 708 x 708 squares.
#[test]
fn a_million_triangles_are_read_at_once() {
    let side = 708u32;
    let (vertices, faces) = ((side + 1) * (side + 1), 2 * side * side);
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face {faces}\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for i in 0..vertices {
        for value in [(i % (side + 1)) as f32, (i / (side + 1)) as f32, 0.0, 0.0, 0.0, 1.0] {
            bytes.extend(value.to_le_bytes());
        }
    }
    for i in 0..side * side {
        let corner = i / side * (side + 1) + i % side;
        for triangle in
            [[corner, corner + 1, corner + side + 2], [corner, corner + side + 2, corner + side + 1]]
        {
            bytes.push(3);
            triangle.iter().for_each(|index| bytes.extend(index.to_le_bytes()));
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    fs::write(&path, bytes).unwrap();
    let start = std::time::Instant::now();
    let mesh = load_mesh(&path).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!((mesh.triangles.len(), mesh.normals.len()), (faces as usize, vertices as usize));
    assert_eq!(mesh.triangles.last().unwrap()[1], vertices - 1);
    // It takes about 0.15 s; the bound leaves room for busy machines.
    assert!(seconds < 2.0, "{seconds} s");
}
