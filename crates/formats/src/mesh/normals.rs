//! Vertex normals of meshes whose files have none, and faces that agree with those that have.

use hyaline_math::{DVec3, float};
use hyaline_scene::MeshData;

/// Gives a mesh smooth normals: at each vertex the mean of the faces' normals, weighed by the angles of the corners.
///
/// Source: Thürmer & Wüthrich, Computing Vertex Normals from Polygonal Facets, Journal of Graphics Tools 3(1), 1998.
pub(crate) fn smooth(mesh: &mut MeshData) {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|index| position(mesh, index));
        let Some(n) = (b - a).cross(c - a).try_normalize() else { continue };
        for (index, (corner, next, last)) in triangle.iter().zip([(a, b, c), (b, c, a), (c, a, b)]) {
            let (u, v) = (next - corner, last - corner);
            sums[*index as usize] += n * float::f64::atan2(u.cross(v).length(), u.dot(v));
        }
    }
    mesh.normals = sums.into_iter().map(|sum| sum.normalize_or_zero().as_vec3().to_array()).collect();
}

/// Turns the faces that wind against the normals of their corners, so that the outside is where the normals point.
pub(crate) fn turn_faces(mesh: &mut MeshData) {
    if mesh.normals.is_empty() {
        return;
    }
    for i in 0..mesh.triangles.len() {
        let triangle = mesh.triangles[i];
        let [a, b, c] = triangle.map(|index| position(mesh, index));
        let normals = triangle.map(|index| DVec3::from(mesh.normals[index as usize].map(f64::from)));
        if (b - a).cross(c - a).dot(normals[0] + normals[1] + normals[2]) < 0.0 {
            mesh.triangles[i].swap(1, 2);
        }
    }
}

/// Turns a mesh inside out.
pub(crate) fn flip(mesh: &mut MeshData) {
    mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    for normal in &mut mesh.normals {
        *normal = normal.map(|coordinate| -coordinate);
    }
}

fn position(mesh: &MeshData, index: u32) -> DVec3 {
    DVec3::from(mesh.positions[index as usize].map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube about the origin, two triangles a side.
    fn cube() -> MeshData {
        let positions =
            (0..8u8).map(|i| [0, 1, 2].map(|axis| f32::from(i >> axis & 1) * 2.0 - 1.0)).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        MeshData { positions, triangles, ..MeshData::default() }
    }

    #[test]
    fn angles_make_the_normals_of_a_cube_its_diagonals() {
        // By area, or by face, the corners with two triangles of one side would lean to that side.
        let mut mesh = cube();
        smooth(&mut mesh);
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            for axis in 0..3 {
                assert!((n[axis] - p[axis] / 3f32.sqrt()).abs() < 1e-6, "{n:?} at {p:?}");
            }
        }
    }

    #[test]
    fn faces_follow_their_normals() {
        let mut mesh = cube();
        smooth(&mut mesh);
        let sound = mesh.clone();
        mesh.triangles[3].swap(0, 1);
        turn_faces(&mut mesh);
        let [a, b, c] = mesh.triangles[3].map(|index| position(&mesh, index));
        assert!((b - a).cross(c - a).dot(a) > 0.0, "the outside is outside again");
        flip(&mut mesh);
        turn_faces(&mut mesh);
        assert_eq!(mesh.triangles.len(), sound.triangles.len());
        let [a, b, c] = mesh.triangles[0].map(|index| position(&mesh, index));
        assert!((b - a).cross(c - a).dot(a) < 0.0, "inside out with its normals, it stays so");
    }
}
