//! What may be wrong with a mesh as the boundary of a body: facts, each with a place; what they mean for a picture is
//! for others to say.

mod edges;
mod seam;
mod shells;
#[cfg(test)]
mod tests;
mod winding;

pub use edges::EdgeHealth;
pub(super) use edges::edge_uses;
pub use shells::ShellHealth;

use super::{Mesh, measure::weld};
use edges::EdgeUse;
use hyaline_math::Vec3;

/// How often something was found, and where first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Marked {
    /// How often.
    pub count: usize,
    /// A place of it, in the space of the mesh; `None` where there is none.
    pub place: Option<Vec3>,
}

impl Marked {
    fn mark(&mut self, place: Vec3) {
        self.count += 1;
        self.place.get_or_insert(place);
    }
}

/// Facts about one mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshHealth {
    /// How its faces meet.
    pub edges: EdgeHealth,
    /// Its connected pieces.
    pub shells: ShellHealth,
    /// Faces without area, which were dropped.
    pub dropped_faces: usize,
    /// Faces that lie on another face of the same vertices and look the same way.
    pub duplicate_faces: Marked,
    /// Pairs of faces of the same vertices that look opposite ways: a wall without thickness.
    pub back_to_back_faces: Marked,
    /// Volume enclosed, cubic scene units; negative where the mesh is inside out.
    pub volume: f64,
    /// 0 where the mesh is closed, 1 where it is a flat sheet; see `Mesh::openness`.
    pub openness: f64,
    /// Share of corners whose vertex normal is more than 90 degrees off the face's, 0…1.
    pub contrary_normals: f64,
}

impl Mesh {
    /// Looks for everything that may be wrong with the mesh; several times as slow as building its tree.
    pub fn health(&self) -> MeshHealth {
        let (uses, _) = edge_uses(self);
        let mut edges = EdgeHealth::new(self, &uses);
        if edges.open.count > 0 {
            let alone = uses.chunk_by(|a, b| a.edge() == b.edge()).filter(|edge| edge.len() == 1);
            let open: Vec<EdgeUse> = alone.map(|edge| edge[0]).collect();
            edges.nearly_closed = seam::nearly_closed(self.positions(), &open, self.bounds().size().length());
        }
        let (duplicate_faces, back_to_back_faces) = repeated_faces(self);
        MeshHealth {
            edges,
            shells: ShellHealth::new(self, &uses),
            dropped_faces: self.dropped_faces(),
            duplicate_faces,
            back_to_back_faces,
            volume: self.signed_volume(),
            openness: self.openness(),
            contrary_normals: self.contrary_normals(),
        }
    }

    /// The ends of every edge that has one face only.
    pub fn open_edges(&self) -> Vec<[Vec3; 2]> {
        let (uses, _) = edge_uses(self);
        let alone = uses.chunk_by(|a, b| a.edge() == b.edge()).filter(|edge| edge.len() == 1);
        alone.map(|edge| [edge[0].low, edge[0].high].map(|i| self.positions()[i as usize])).collect()
    }

    /// Share of corners whose vertex normal is more than 90 degrees off the face's, 0…1; absent normals don't count.
    pub fn contrary_normals(&self) -> f64 {
        let Some(normals) = self.normals() else { return 0.0 };
        let (mut contrary, mut count) = (0_usize, 0_usize);
        for (face, corners) in self.triangles().iter().enumerate() {
            let face_normal = self.doubled_area(face as u32);
            for &vertex in corners {
                let cosine = normals[vertex as usize].as_dvec3().dot(face_normal);
                count += usize::from(cosine != 0.0 && cosine.is_finite());
                contrary += usize::from(cosine < 0.0 && cosine.is_finite());
            }
        }
        contrary as f64 / count.max(1) as f64
    }
}

/// Faces of the same three vertices: those that look the same way as an earlier one, and pairs that don't.
fn repeated_faces(mesh: &Mesh) -> (Marked, Marked) {
    let welded = weld(mesh.positions());
    let mut faces: Vec<([u32; 3], bool, u32)> = (mesh.triangles().iter().enumerate())
        .map(|(face, corners)| {
            let [a, b, c] = corners.map(|vertex| welded[vertex as usize]);
            let mut sorted = [a, b, c];
            sorted.sort_unstable();
            // An even number of swaps sorts the corners of faces that look one way, an odd number the others'.
            (sorted, [a, b, c] == sorted || [b, c, a] == sorted || [c, a, b] == sorted, face as u32)
        })
        .collect();
    faces.sort_unstable();
    let (mut duplicate, mut opposite) = (Marked::default(), Marked::default());
    for alike in faces.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > 1) {
        let even = alike.iter().filter(|face| face.1).count();
        let place = mesh.corners(alike[0].2).iter().sum::<Vec3>() / 3.0;
        let pairs = even.min(alike.len() - even);
        (0..pairs).for_each(|_| opposite.mark(place));
        (1..alike.len() - pairs).for_each(|_| duplicate.mark(place));
    }
    (duplicate, opposite)
}
