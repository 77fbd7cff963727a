//! Where a ray meets the geometry: first the bare crossing, then the surface about it.

use hyaline_math::{Vec2, Vec3};

/// A crossing of a ray and a primitive, before anything about the surface is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Distance along the ray, scene units.
    pub t: f32,
    /// Index of the item in the aggregate.
    pub item: u32,
    /// Index of the primitive in the item: the face of a mesh, 0 for a shape.
    pub primitive: u32,
    /// Barycentric coordinates of the second and third vertex on a mesh; unused on a shape.
    pub barycentric: Vec2,
}

/// The surface at a crossing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// Distance along the ray, scene units.
    pub t: f32,
    /// Point on the surface.
    pub p: Vec3,
    /// Bound on the distance of `p` from the true surface, scene units.
    pub p_error: f32,
    /// Geometric normal, unit; points to the outside of the object, whichever side the ray comes from.
    pub ng: Vec3,
    /// Shading normal, unit, on the same side as `ng`.
    pub n: Vec3,
    /// Surface coordinates for textures.
    pub uv: Vec2,
    /// Derivative of the point by `uv.x`; any tangent where the object has no coordinates.
    pub dpdu: Vec3,
    /// Index of the item in the aggregate.
    pub item: u32,
    /// Index of the primitive in the item: the face of a mesh, 0 for a shape.
    pub primitive: u32,
}
