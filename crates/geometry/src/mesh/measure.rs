//! Area, volume and the open edges of a mesh.

use super::health::edge_uses;
use super::{Mesh, doubled_area};
use hyaline_math::{DVec3, Vec3};
use rayon::prelude::*;
use std::iter::Sum;

/// Faces that one task adds up.
const TASK: u32 = 1 << 16;

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
        self.sum_over_faces(|face| 0.5 * self.doubled_area(face).length())
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
        self.sum_over_faces(volume_of)
    }

    /// How far the mesh is from being closed: 0 for a closed one, 1 for a flat sheet, and little for a few holes.
    ///
    /// The length of the sum of the faces' areas as vectors, over the sum of their lengths: on a closed surface the
    /// vectors cancel. A tube without ends counts as closed.
    pub fn openness(&self) -> f64 {
        self.sum_over_faces(|face| self.doubled_area(face)).length()
            / self.sum_over_faces(|face| self.doubled_area(face).length())
    }

    /// The same surface with its other side out: every face wound the other way. Vertex normals stay: of them only
    /// the line counts.
    pub fn turned_inside_out(mut self) -> Self {
        self.data.triangles.iter_mut().for_each(|face| face.swap(1, 2));
        self
    }

    /// Counts open and flipped edges; vertices at the same position are one, since files split them at seams.
    pub fn topology(&self) -> MeshTopology {
        let (uses, _) = edge_uses(self);
        let mut topology = MeshTopology::default();
        for edge in uses.chunk_by(|a, b| a.edge() == b.edge()) {
            let forward = edge.iter().filter(|edge_use| edge_use.is_forward).count();
            if edge.len() % 2 == 1 {
                topology.open_edges += 1;
            } else if 2 * forward != edge.len() {
                topology.flipped_edges += 1;
            }
        }
        topology
    }

    /// The sum of a term over all faces, the same for any number of threads.
    fn sum_over_faces<T: Sum + Send>(&self, term: impl Fn(u32) -> T + Sync) -> T {
        let count = self.face_count() as u32;
        let tasks = (0..count.div_ceil(TASK)).into_par_iter();
        let sum_of = |task: u32| (task * TASK..count.min((task + 1) * TASK)).map(&term).sum::<T>();
        tasks.map(sum_of).collect::<Vec<T>>().into_iter().sum()
    }

    /// Twice the area of a face times its unit normal.
    pub(super) fn doubled_area(&self, face: u32) -> DVec3 {
        doubled_area(self.corners(face).map(|p| p.as_dvec3()))
    }
}

/// For each vertex the first one, in some fixed order, that lies at the same position.
pub(super) fn weld(positions: &[Vec3]) -> Vec<u32> {
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
