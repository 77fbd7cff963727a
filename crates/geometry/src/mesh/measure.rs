//! Area, volume and the open edges of a mesh.

use super::{Mesh, doubled_area};
use hyaline_math::Vec3;

/// How the faces of a mesh join.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshTopology {
    /// Edges with an odd number of faces: rims of holes and sheets.
    pub open_edges: usize,
    /// Edges with an even number of faces that don't pair up in opposite directions: a face is wound the wrong way.
    pub flipped_edges: usize,
}

impl MeshTopology {
    /// Whether the mesh has an inside: no open and no flipped edge.
    pub fn is_closed(&self) -> bool {
        self.open_edges == 0 && self.flipped_edges == 0
    }
}

impl Mesh {
    /// Surface area, square scene units.
    pub fn area(&self) -> f64 {
        (0..self.face_count() as u32).map(|face| 0.5 * self.doubled_area(face).length()).sum()
    }

    /// Volume enclosed, cubic scene units; negative where the mesh is inside out, meaningless where it is open.
    ///
    /// Source: Gauss's theorem on F = r / 3, one tetrahedron a face.
    pub fn signed_volume(&self) -> f64 {
        // About the center of the box, so that a mesh far from the origin loses no digits.
        let center = self.bounds().center().as_dvec3();
        let volume_of = |face| {
            let [a, b, c] = self.corners(face).map(|p| p.as_dvec3() - center);
            a.dot(b.cross(c)) / 6.0
        };
        (0..self.face_count() as u32).map(volume_of).sum()
    }

    /// Counts open and flipped edges; vertices at the same position are one, since files split them at seams.
    pub fn topology(&self) -> MeshTopology {
        let welded = weld(self.positions());
        let mut edges = Vec::with_capacity(3 * self.face_count());
        for face in self.triangles() {
            for corner in 0..3 {
                let (from, to) = (welded[face[corner] as usize], welded[face[(corner + 1) % 3] as usize]);
                edges.push((from.min(to), from.max(to), from < to));
            }
        }
        edges.sort_unstable();
        let mut topology = MeshTopology::default();
        for uses in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let forward = uses.iter().filter(|edge| edge.2).count();
            if uses.len() % 2 == 1 {
                topology.open_edges += 1;
            } else if 2 * forward != uses.len() {
                topology.flipped_edges += 1;
            }
        }
        topology
    }

    /// Twice the area of a face times its unit normal.
    pub(super) fn doubled_area(&self, face: u32) -> hyaline_math::DVec3 {
        doubled_area(self.corners(face).map(|p| p.as_dvec3()))
    }
}

/// For each vertex the first one, in some fixed order, that lies at the same position.
fn weld(positions: &[Vec3]) -> Vec<u32> {
    // Adding zero turns -0 into +0, which is the same place.
    let key = |i: u32| (positions[i as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&i| (key(i), i));
    let mut welded = vec![0; positions.len()];
    for group in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &vertex in group {
            welded[vertex as usize] = group[0];
        }
    }
    welded
}
