//! Triangle meshes: checked vertices and faces, their measures, their surface, and how a ray meets a triangle.
//!
//! Faces are wound counter-clockwise seen from the outside; the geometric normal follows the winding.

mod error;
pub mod generate;
pub mod health;
mod measure;
mod sampler;
mod surface;
#[cfg(test)]
mod tests;
pub(crate) mod triangle;

pub use error::MeshError;
pub use health::MeshHealth;
pub use measure::MeshTopology;
pub use sampler::MeshSampler;

use hyaline_math::{Bounds, DVec3, Vec2, Vec3};
use rayon::prelude::*;

/// Largest coordinate a vertex may have, scene units; box tests stay within the range of `f32` up to here.
pub const MAX_COORDINATE: f32 = 1e15;

/// Most faces of one mesh: the tree keeps one bit of a face's index for itself.
pub const MAX_FACES: usize = (1 << 31) - 1;

/// Which normal a mesh is shaded with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// The normal of the face.
    Flat,
    /// The interpolated vertex normals; the normal of the face where the mesh has none.
    #[default]
    Smooth,
}

/// What a mesh is made of, as a file gives it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Vertices, scene units.
    pub positions: Vec<Vec3>,
    /// A normal for each vertex, any length; one that is zero or not finite counts as absent.
    pub normals: Option<Vec<Vec3>>,
    /// Texture coordinates of each vertex.
    pub uvs: Option<Vec<Vec2>>,
    /// Vertex indices of each face, counter-clockwise seen from the outside.
    pub triangles: Vec<[u32; 3]>,
    /// Material slot of each face.
    pub face_slots: Option<Vec<u16>>,
    /// Which normal to shade with.
    pub shading: Shading,
}

/// A triangle mesh whose indices are in range, whose vertices are finite, and whose faces all have an area.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    data: MeshData,
    bounds: Bounds,
    dropped_faces: usize,
}

impl Mesh {
    /// Checks the data and drops the faces that have no area.
    ///
    /// # Errors
    /// Where there is no face left, an index is out of range, a position or texture coordinate is not finite, a
    /// position is beyond `MAX_COORDINATE`, a list has the wrong length, or there are more than `MAX_FACES` faces.
    pub fn new(mut data: MeshData) -> Result<Self, MeshError> {
        error::check(&data)?;
        let face_count = data.triangles.len();
        drop_degenerate(&mut data);
        if data.triangles.is_empty() {
            return Err(MeshError::NoFaceHasAnArea { face_count });
        }
        // Made unit here rather than at every hit.
        if let Some(normals) = &mut data.normals {
            normals.par_iter_mut().for_each(|n| *n = n.normalize_or_zero());
        }
        let bounds = data
            .triangles
            .par_iter()
            .map(|face| Bounds::from_points(face.map(|i| data.positions[i as usize])))
            .reduce(|| Bounds::EMPTY, Bounds::union);
        let dropped_faces = face_count - data.triangles.len();
        Ok(Self { data, bounds, dropped_faces })
    }

    /// Vertices, scene units.
    pub fn positions(&self) -> &[Vec3] {
        &self.data.positions
    }

    /// Vertex normals: unit, or 0 where none was given that is.
    pub fn normals(&self) -> Option<&[Vec3]> {
        self.data.normals.as_deref()
    }

    /// Texture coordinates of the vertices.
    pub fn uvs(&self) -> Option<&[Vec2]> {
        self.data.uvs.as_deref()
    }

    /// Vertex indices of the faces that were kept.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.data.triangles
    }

    /// Which normal the mesh is shaded with.
    pub fn shading(&self) -> Shading {
        self.data.shading
    }

    /// Material slot of a face; 0 where the mesh has no slots.
    ///
    /// # Panics
    /// Where there is no such face.
    pub fn face_slot(&self, face: u32) -> u16 {
        self.data.face_slots.as_ref().map_or(0, |slots| slots[face as usize])
    }

    /// Number of faces that were kept.
    pub fn face_count(&self) -> usize {
        self.data.triangles.len()
    }

    /// Number of faces that `new` dropped, because two vertices coincide or all three lie on a line.
    pub fn dropped_faces(&self) -> usize {
        self.dropped_faces
    }

    /// The smallest box about the faces.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The vertices of a face.
    ///
    /// # Panics
    /// Where there is no such face.
    pub fn corners(&self, face: u32) -> [Vec3; 3] {
        self.data.triangles[face as usize].map(|i| self.data.positions[i as usize])
    }
}

/// Twice the area of a triangle times its unit normal, in `f64`.
pub(crate) fn doubled_area(corners: [DVec3; 3]) -> DVec3 {
    (corners[1] - corners[0]).cross(corners[2] - corners[0])
}

/// Removes the faces without area, and their slots with them.
fn drop_degenerate(data: &mut MeshData) {
    let keep: Vec<bool> = data
        .triangles
        .par_iter()
        .map(|face| {
            let corners = face.map(|i| data.positions[i as usize].as_dvec3());
            doubled_area(corners).length_squared() > 0.0
        })
        .collect();
    if keep.iter().all(|&kept| kept) {
        return;
    }
    let mut kept = keep.iter();
    data.triangles.retain(|_| kept.next().is_some_and(|&k| k));
    if let Some(slots) = &mut data.face_slots {
        let mut kept = keep.iter();
        slots.retain(|_| kept.next().is_some_and(|&k| k));
    }
}
