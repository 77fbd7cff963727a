//! Tests of mesh files: one square written in every encoding, and damage of every class.

use super::read;
use hyaline_scene::{MeshData, SceneError};
use std::path::Path;

fn read_ply(bytes: &[u8]) -> Result<MeshData, SceneError> {
    read(Path::new("a.ply"), bytes)
}

fn read_obj(text: &str) -> Result<MeshData, SceneError> {
    read(Path::new("a.obj"), text.as_bytes())
}

const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5]];

fn header(format: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a square\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nproperty uchar red\nproperty double s\nproperty double t\nelement face {faces}\n\
         property uchar flag\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
    )
}

fn ascii() -> String {
    let mut text = header("ascii", 4, 1);
    for [x, y, z] in CORNERS {
        text += &format!("{x} {y} {z} 255 {x} {y}\n");
    }
    text + "7 4 0 1 2 3 2 0.5 0.5\n"
}

fn binary(is_big: bool) -> Vec<u8> {
    let mut bytes =
        header(if is_big { "binary_big_endian" } else { "binary_little_endian" }, 4, 1).into_bytes();
    let four = |bytes: &mut Vec<u8>, value: [u8; 4]| {
        let value = if is_big { value } else { [value[3], value[2], value[1], value[0]] };
        bytes.extend(value);
    };
    for corner in CORNERS {
        for coordinate in corner {
            four(&mut bytes, coordinate.to_be_bytes());
        }
        bytes.push(255);
        for coordinate in &corner[..2] {
            let value = f64::from(*coordinate);
            bytes.extend(if is_big { value.to_be_bytes() } else { value.to_le_bytes() });
        }
    }
    bytes.extend([7, 4]);
    for index in 0..4i32 {
        four(&mut bytes, index.to_be_bytes());
    }
    bytes.push(1);
    four(&mut bytes, 0.5f32.to_be_bytes());
    bytes
}

#[test]
fn the_same_square_is_read_from_every_encoding() {
    let expected = MeshData {
        positions: CORNERS.to_vec(),
        uvs: CORNERS.map(|[x, y, _]| [x, y]).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..MeshData::default()
    };
    assert_eq!(read_ply(ascii().as_bytes()).unwrap(), expected);
    assert_eq!(read_ply(&binary(false)).unwrap(), expected);
    assert_eq!(read_ply(&binary(true)).unwrap(), expected);
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    assert_eq!(read_obj(obj).unwrap(), expected);
}

#[test]
fn normals_of_ply_are_read() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                property float nx\nproperty float ny\nproperty float nz\nelement face 1\n\
                property list uchar uint vertex_index\nend_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2";
    let mesh = read_ply(text.as_bytes()).unwrap();
    assert_eq!((mesh.normals, mesh.triangles), (vec![[0.0, 0.0, 1.0]; 3], vec![[0, 1, 2]]));
}

#[test]
fn corners_of_obj_are_joined_where_all_of_them_agree() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf -2//1 2//1 -1//1\nf 1//2 2//2 3//2";
    let mesh = read_obj(text).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3], [4, 5, 6]]);
    assert_eq!(mesh.positions[4], mesh.positions[0]);
    assert_eq!((mesh.normals[0], mesh.normals[4]), ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]));
    let mixed = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 1 1\nf 1//1 2//1 3\nf 1/1 2 3").unwrap();
    assert!(mixed.normals.is_empty(), "normals count only where all corners have one");
    assert_eq!(mixed.uvs.len(), mixed.positions.len());
}

#[test]
fn materials_of_obj_become_slots() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red glass\nf 1 2 3\nusemtl blue\nf 1 2 3 1\nusemtl red glass\nf 1 2 3";
    let mesh = read_obj(text).unwrap();
    assert_eq!(mesh.slots, ["red glass", "blue"]);
    assert_eq!(mesh.face_slots, [0, 1, 1, 0]);
    let late = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3").unwrap();
    assert_eq!((late.slots, late.face_slots), (vec![String::new(), "red".to_owned()], vec![0, 1]));
}

#[test]
fn damage_of_ascii_files_is_told_with_its_line() {
    let good = ascii();
    for (bad, line, message) in [
        (good.replace("7 4 0 1 2 3", "7 4 0 1 2 9"), 20, "vertex index 9 is out of range"),
        (good.replace("7 4 0 1 2 3", "7 4 0 1 2 -1"), 20, "vertex index -1 is out of range"),
        (good.replace("1 1 0 255", "1 nan 0 255"), 18, "not finite"),
        (good.replace("1 1 0 255", "1 x 0 255"), 18, "'x' is not a number"),
        (good.replace("element vertex 4", "element vertex 4000000000"), 16, "file ends before"),
        (good.replace("element face 1", "element face 3"), 21, "file ends before"),
        (good.replace("element face 1", "element face x"), 11, "no number"),
        (good.replace("property float z", "property floot z"), 7, "unknown type"),
        (good.replace("end_header\n", ""), 15, "unknown line"),
        (good.replace("format ascii", "format asci"), 2, "unknown PLY format"),
        (good.replacen("ply", "plz", 1), 1, "not a PLY file"),
    ] {
        let error = read_ply(bad.as_bytes()).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("a.ply:{line}: ")) && error.contains(message),
            "{line} {message}\n{error}"
        );
    }
}

#[test]
fn damage_of_binary_files_is_told_with_its_byte() {
    let good = binary(false);
    for length in 0..good.len() {
        assert!(read_ply(&good[..length]).is_err(), "cut at {length}");
    }
    let error = read_ply(&good[..good.len() - 1]).unwrap_err();
    assert!(error.message.starts_with("at byte ") && error.message.contains("file ends"), "{error}");
    let mut bad = good.clone();
    let index = good.len() - 9;
    bad[index] = 77;
    assert!(read_ply(&bad).unwrap_err().message.contains("vertex index 77 is out of range"));
}

#[test]
fn headers_can_not_claim_memory_that_the_file_does_not_back() {
    for format in ["ascii", "binary_little_endian"] {
        for count in [4_000_000_000usize, usize::MAX] {
            assert!(read_ply(header(format, count, 1).as_bytes()).is_err());
            assert!(read_ply(header(format, 0, count).as_bytes()).is_err());
        }
    }
    let empty_records = "ply\nformat ascii 1.0\nelement nothing 4000000000\nelement vertex 0\nproperty float x\n\
                         property float y\nproperty float z\nelement face 0\n\
                         property list uchar int vertex_indices\nend_header\n";
    assert!(read_ply(empty_records.as_bytes()).unwrap_err().message.contains("no vertices"));
}

#[test]
fn empty_meshes_and_other_formats_are_refused() {
    assert!(read_ply(header("ascii", 0, 0).as_bytes()).unwrap_err().message.contains("no vertices"));
    assert!(read_obj("# nothing").unwrap_err().message.contains("no vertices"));
    assert!(
        read_obj("v 0 0 0").unwrap_err().message.contains("no vertices"),
        "those without a face do not count"
    );
    assert!(read(Path::new("a.stl"), b"").unwrap_err().message.contains("'.stl'"));
}

#[test]
fn damage_of_obj_files_is_told_with_its_line() {
    for (text, line, message) in [
        ("v 0 0 0\nv 1 0\n", 2, "2 numbers where 3"),
        ("v 0 0 inf\n", 1, "not a finite number"),
        ("v 0 0 0\n\nf 1 2 3\n", 3, "vertex index '2' is out of range, there are 1"),
        ("v 0 0 0\nf 0 1 1\n", 2, "vertex index '0'"),
        ("v 0 0 0\nf -2 1 1\n", 2, "vertex index '-2'"),
        ("v 0 0 0\nf 1/1 1/1 1/1\n", 2, "texture coordinate index '1'"),
        ("v 0 0 0\nf 1//4 1//1 1//1\n", 2, "normal index '4'"),
        ("v 0 0 0\nf 1 1\n", 2, "a face of 2 corners"),
        ("v 0 0 0\nf / / /\n", 2, "has no vertex"),
    ] {
        let error = read_obj(text).unwrap_err();
        assert!(error.message.contains(message), "{error}");
        assert_eq!(error.source.unwrap().line, line, "{message}");
    }
}
