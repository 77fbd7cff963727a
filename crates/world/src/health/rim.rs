//! Where the open edges of one interface lie on those of another: surfaces that go on under another name.
//!
//! Files split a boundary where its media change: the wall of a glass above the water, below it, and the water's
//! surface are three interfaces that share their rims. Such a rim is no hole.

use super::subject::Scene;
use hyaline_geometry::ItemGeometry;
use hyaline_math::Vec3;
use hyaline_scattering::{BoundaryKind, ObjectId};
use std::collections::HashMap;

/// Vertices nearer than this fraction of the largest interface's size are the same.
const NEARNESS: f32 = 1e-5;

/// The ends of the open edges of all interfaces, in cells as large as the tolerance.
pub(super) struct Rims {
    tolerance: f32,
    cells: HashMap<[i64; 3], Vec<(ObjectId, Vec3)>>,
    /// The open edges of each item that is a mesh of an interface.
    edges: HashMap<usize, Vec<[Vec3; 2]>>,
}

impl Rims {
    pub(super) fn new(scene: &Scene) -> Self {
        let is_sheet = |object| matches!(scene.kind(object), BoundaryKind::Interface { .. });
        let sizes = scene.objects().filter(|&object| is_sheet(object)).map(|object| scene.size(object));
        let tolerance = NEARNESS * sizes.fold(f32::MIN_POSITIVE, f32::max);
        let mut rims = Self { tolerance, cells: HashMap::new(), edges: HashMap::new() };
        for (index, (info, item)) in scene.world.items.iter().zip(scene.world.geometry.items()).enumerate() {
            let ItemGeometry::Mesh { mesh, transform } = &item.geometry else { continue };
            if !is_sheet(info.object) {
                continue;
            }
            let placed = |p: Vec3| transform.map_or(p, |t| t.point(p.as_dvec3()).as_vec3());
            let edges: Vec<[Vec3; 2]> =
                mesh.mesh().open_edges().iter().map(|edge| edge.map(placed)).collect();
            for end in edges.as_flattened() {
                rims.cells.entry(rims.cell(*end)).or_default().push((info.object, *end));
            }
            rims.edges.insert(index, edges);
        }
        rims
    }

    /// The middles of the open edges of an item that lie on no other interface's.
    pub(super) fn holes(&self, item: usize, object: ObjectId) -> Vec<Vec3> {
        let edges = self.edges.get(&item).map_or(&[][..], Vec::as_slice);
        let holes = edges.iter().filter(|edge| !edge.iter().all(|&end| self.continues(object, end)));
        holes.map(|[a, b]| 0.5 * (*a + *b)).collect()
    }

    /// Whether another interface has an open edge that ends at `p`.
    fn continues(&self, object: ObjectId, p: Vec3) -> bool {
        let center = self.cell(p);
        (0..27).any(|i: i64| {
            let cell = [center[0] + i % 3 - 1, center[1] + i / 3 % 3 - 1, center[2] + i / 9 - 1];
            let ends = self.cells.get(&cell).map_or(&[][..], Vec::as_slice);
            ends.iter().any(|&(other, end)| other != object && end.distance(p) <= self.tolerance)
        })
    }

    fn cell(&self, p: Vec3) -> [i64; 3] {
        // Kept off the ends of the range, so that neighbors exist.
        p.to_array().map(|x| (x / self.tolerance).floor().clamp(-1e18, 1e18) as i64)
    }
}
