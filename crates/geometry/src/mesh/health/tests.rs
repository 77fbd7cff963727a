use super::MeshHealth;
use crate::mesh::{Mesh, MeshData, generate};
use hyaline_math::Vec3;

/// A ball of equal faces with smooth normals.
fn ball(center: Vec3, radius: f32) -> MeshData {
    generate::icosphere(center, radius, 320)
}

fn health(data: MeshData) -> MeshHealth {
    Mesh::new(data).unwrap().health()
}

/// Both meshes as one.
fn joined(mut first: MeshData, second: MeshData) -> MeshData {
    let offset = first.positions.len() as u32;
    first.positions.extend(second.positions);
    first.normals.get_or_insert_default().extend(second.normals.unwrap_or_default());
    first.triangles.extend(second.triangles.into_iter().map(|face| face.map(|i| i + offset)));
    first
}

fn inside_out(mut mesh: MeshData) -> MeshData {
    mesh.triangles.iter_mut().for_each(|face| face.swap(1, 2));
    mesh.normals.iter_mut().flatten().for_each(|n| *n = -*n);
    mesh
}

#[test]
fn healthy_meshes_have_no_faults() {
    for data in [
        ball(Vec3::new(3.0, -2.0, 1.0), 0.1),
        generate::uv_sphere(Vec3::ZERO, 1.0, 2000),
        generate::displaced_sphere(Vec3::ZERO, 1.0, 5000, 0.1),
        generate::torus_knot(Vec3::ZERO, 1.0, 5000, 0.2),
        generate::hollow_ball(Vec3::ZERO, 1.0, 0.1, 1000),
        generate::hollow_balls(Vec3::ZERO, 1.0, 27, 20_000),
    ] {
        let found = health(data);
        let faults = [
            found.edges.open,
            found.edges.branching,
            found.edges.flipped,
            found.duplicate_faces,
            found.back_to_back_faces,
            found.shells.inside_out,
            found.shells.doubled,
            found.shells.crossing,
        ];
        assert!(faults.iter().all(|fault| fault.count == 0 && fault.place.is_none()), "{found:?}");
        assert!(found.volume > 0.0 && found.openness < 1e-6 && found.contrary_normals == 0.0, "{found:?}");
        assert_eq!(found.edges.nearly_closed, 0);
    }
}

#[test]
fn a_missing_face_leaves_three_open_edges_at_its_place() {
    let mut data = ball(Vec3::ZERO, 1.0);
    let gone = data.triangles.remove(17).map(|i| data.positions[i as usize]);
    let found = health(data);
    assert_eq!(found.edges.open.count, 3);
    let place = found.edges.open.place.unwrap();
    assert!(gone.iter().any(|p| p.distance(place) < 0.2), "{place} is far from {gone:?}");
    assert!(found.openness > 0.0 && found.openness < 0.01);
    assert_eq!((found.edges.flipped.count, found.edges.nearly_closed), (0, 0));
}

#[test]
fn a_flipped_face_flips_three_edges() {
    let mut data = ball(Vec3::ZERO, 1.0);
    data.triangles[40].swap(0, 1);
    let found = health(data);
    assert_eq!((found.edges.flipped.count, found.edges.open.count), (3, 0));
    assert!((found.contrary_normals - 1.0 / 320.0).abs() < 1e-9);
}

#[test]
fn a_fin_branches() {
    let mut data = ball(Vec3::ZERO, 1.0);
    let [a, b, _] = data.triangles[5];
    data.positions.push(Vec3::new(0.0, 3.0, 0.0));
    data.normals = None;
    data.triangles.push([a, b, data.positions.len() as u32 - 1]);
    let found = health(data);
    assert_eq!((found.edges.branching.count, found.edges.open.count), (1, 2));
}

#[test]
fn repeated_faces_are_told_from_faces_back_to_back() {
    let mut data = ball(Vec3::ZERO, 1.0);
    let [a, b, c] = data.triangles[9];
    data.triangles.push([b, c, a]);
    let found = health(data.clone());
    assert_eq!((found.duplicate_faces.count, found.back_to_back_faces.count), (1, 0));
    *data.triangles.last_mut().unwrap() = [b, a, c];
    let found = health(data);
    assert_eq!((found.duplicate_faces.count, found.back_to_back_faces.count), (0, 1));
}

#[test]
fn a_seam_that_rounding_opened_is_told_from_a_hole() {
    // Every second vertex is moved by less than a millionth of the size: no two faces share those any more.
    let mut data = ball(Vec3::ZERO, 1.0);
    for (i, p) in data.positions.iter_mut().enumerate().filter(|(i, _)| i % 2 == 0) {
        *p += Vec3::splat(2e-7) * (1.0 + (i % 3) as f32);
    }
    let found = health(data.clone());
    assert!(found.edges.open.count > 50, "{found:?}");
    assert_eq!(found.edges.nearly_closed, found.edges.open.count);
    data.triangles.remove(17);
    let found = health(data);
    assert_eq!(found.edges.open.count - found.edges.nearly_closed, 3);
}

#[test]
fn shells_are_told_apart_by_how_they_lie_and_face() {
    let outer = || ball(Vec3::ZERO, 1.0);
    let inner = || ball(Vec3::new(0.1, 0.0, 0.0), 0.4);
    let apart = || ball(Vec3::new(5.0, 0.0, 0.0), 0.4);
    let across = ball(Vec3::new(1.0, 0.0, 0.0), 0.4);
    let counts = |data| {
        let shells = health(data).shells;
        assert_eq!(shells.count, 2);
        [shells.hollow, shells.inside_out.count, shells.doubled.count, shells.crossing.count]
    };
    assert_eq!(counts(joined(outer(), inside_out(inner()))), [1, 0, 0, 0]);
    assert_eq!(counts(joined(outer(), inner())), [0, 0, 1, 0]);
    assert_eq!(counts(joined(outer(), apart())), [0, 0, 0, 0]);
    assert_eq!(counts(joined(outer(), inside_out(apart()))), [0, 1, 0, 0]);
    assert!(counts(joined(outer(), across))[3] > 0);
}

#[test]
fn turning_a_mesh_inside_out_changes_the_sign_of_its_volume() {
    let mesh = Mesh::new(ball(Vec3::ZERO, 1.0)).unwrap();
    let volume = mesh.signed_volume();
    let turned = mesh.turned_inside_out();
    assert_eq!(turned.signed_volume(), -volume);
    assert_eq!(turned.health().shells.inside_out.count, 1);
}

#[test]
fn a_sheet_is_as_open_as_can_be() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X + Vec3::Y];
    let data = MeshData {
        positions: corners.to_vec(),
        triangles: vec![[0, 1, 2], [2, 1, 3]],
        ..MeshData::default()
    };
    assert!((Mesh::new(data).unwrap().openness() - 1.0).abs() < 1e-12);
}
