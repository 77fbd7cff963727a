//! Where a ray meets the geometry: first the bare crossing, then the surface about it.

use hyaline_math::{Frame, Vec2, Vec3};

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

/// Derivatives of a surface point by its coordinates; asked for where a texture turns the normal, which is seldom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// By `uv.x`.
    pub dpdu: Vec3,
    /// By `uv.y`; never parallel to `dpdu`.
    pub dpdv: Vec3,
}

impl Tangents {
    /// The derivatives, or unit tangents to the surface of normal `ng` where coordinates don't span it.
    pub(crate) fn new(dpdu: Vec3, dpdv: Vec3, ng: Vec3) -> Self {
        let area = dpdu.cross(dpdv).length();
        if area.is_finite() && area > 1e-6 * dpdu.length() * dpdv.length() {
            return Self { dpdu, dpdv };
        }
        let frame = Frame::from_normal(ng);
        Self { dpdu: frame.s, dpdv: frame.t }
    }
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
    /// Index of the item in the aggregate.
    pub item: u32,
    /// Index of the primitive in the item: the face of a mesh, 0 for a shape.
    pub primitive: u32,
}
