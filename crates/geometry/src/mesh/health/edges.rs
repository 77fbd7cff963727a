//! How faces meet at edges. Vertices at the same position are one, since files split them at seams.

use super::super::{Mesh, measure::weld};
use super::Marked;
use hyaline_math::Vec3;

/// One face's use of an edge; sorts by edge, then by way, then by face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct EdgeUse {
    /// The end with the lower index.
    pub(crate) low: u32,
    /// The end with the higher index.
    pub(crate) high: u32,
    /// Whether the face walks from `low` to `high`.
    pub(crate) is_forward: bool,
    /// The face.
    pub(crate) face: u32,
}

impl EdgeUse {
    /// The two ends, the same for all uses of the edge.
    pub(crate) fn edge(&self) -> (u32, u32) {
        (self.low, self.high)
    }
}

/// Every use of every edge, sorted, and for each vertex the one that stands for its position.
pub(crate) fn edge_uses(mesh: &Mesh) -> (Vec<EdgeUse>, Vec<u32>) {
    let welded = weld(mesh.positions());
    let mut uses = Vec::with_capacity(3 * mesh.face_count());
    for (face, corners) in mesh.triangles().iter().enumerate() {
        for corner in 0..3 {
            let (from, to) = (welded[corners[corner] as usize], welded[corners[(corner + 1) % 3] as usize]);
            uses.push(EdgeUse {
                low: from.min(to),
                high: from.max(to),
                is_forward: from < to,
                face: face as u32,
            });
        }
    }
    uses.sort_unstable();
    (uses, welded)
}

/// What is wrong with the edges of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeHealth {
    /// Number of different edges.
    pub count: usize,
    /// Edges of one face only: rims of holes and sheets.
    pub open: Marked,
    /// Edges of more than two faces: the surface branches there.
    pub branching: Marked,
    /// Edges whose faces don't run along them in opposite ways: one of the faces is wound the wrong way.
    pub flipped: Marked,
    /// How many of the open edges would close if vertices nearer than a millionth of the mesh's size were one.
    pub nearly_closed: usize,
}

impl EdgeHealth {
    /// Judges sorted uses of edges, all but `nearly_closed`.
    pub(super) fn new(mesh: &Mesh, uses: &[EdgeUse]) -> Self {
        let mut health = Self::default();
        for edge in uses.chunk_by(|a, b| a.edge() == b.edge()) {
            let place = middle(mesh, &edge[0]);
            health.count += 1;
            let forward = edge.iter().filter(|edge_use| edge_use.is_forward).count();
            match edge.len() {
                1 => health.open.mark(place),
                2 if forward != 1 => health.flipped.mark(place),
                2 => {}
                count => {
                    health.branching.mark(place);
                    if count % 2 == 0 && 2 * forward != count {
                        health.flipped.mark(place);
                    }
                }
            }
        }
        health
    }
}

/// The middle of an edge.
fn middle(mesh: &Mesh, edge: &EdgeUse) -> Vec3 {
    0.5 * (mesh.positions()[edge.low as usize] + mesh.positions()[edge.high as usize])
}
