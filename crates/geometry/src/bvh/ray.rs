//! What the box test and the triangle filter need to know of a ray, padded so that they never lose a hit.
//!
//! With u the unit roundoff of `f32`, S the largest coordinate of the tree along an axis and o the origin's:
//! - The distance of a plane is computed as `plane * (1/d) - o/d`, with or without a fused step. The inverse is off by
//!   3 u relatively (direction, division, both rounded), the product by u more; the quotient by 6 u (origin, padding,
//!   inverse, product); the difference by u (S + |o|) / |d|, and hits are rounded to `f32` once more: in all less than
//!   (6 u S + 8 u |o|) / |d|. Moving the origin by 10 u (S + |o|) against the plane covers it.
//! - A component of the direction below 1e-12 of the largest is replaced by that; the ray then strays by less than
//!   1e-11 of the scene's reach, which is added to the padding.
//! - A vertex in the frame of the ray is off by less than E = 10 u D, where D is the largest of the sums S + |o|. An
//!   edge value, the difference of two products of coordinates up to m, is then off by less than 6 E (m + E). Products
//!   overflow where m is beyond 1e19, and boxes are cut off before that.

use super::node::Tree;
use crate::mesh::triangle::LocalRay;
use hyaline_math::Vec3A;

/// Unit roundoff of `f32`.
const ROUNDOFF: f32 = f32::EPSILON / 2.0;

/// The parts of a prepared ray that are the same for all trees in one space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlabRay {
    origin: Vec3A,
    /// One over the direction.
    inverse: Vec3A,
    /// Rows of the near planes: the upper one of each axis along which the ray goes down.
    near_rows: [usize; 3],
    t_min: f32,
}

impl SlabRay {
    #[inline(always)]
    pub(crate) fn new(ray: &LocalRay) -> Self {
        let size = ray.direction.abs();
        let least = Vec3A::splat(1e-12 * size.max_element());
        let downward = ray.direction.is_negative_bitmask() as usize;
        Self {
            origin: ray.origin,
            inverse: size.max(least).copysign(ray.direction).recip(),
            near_rows: [downward & 1, 2 + (downward >> 1 & 1), 4 + (downward >> 2 & 1)],
            // Not -0, whose bits are those of a late distance.
            t_min: ray.t_min + 0.0,
        }
    }

    /// For each axis the largest coordinate of the tree plus that of the origin.
    #[inline(always)]
    fn sums(&self, tree: &Tree) -> Vec3A {
        tree.reach() + self.origin.abs()
    }
}

/// A ray prepared for the boxes of one tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    /// One over the direction.
    pub(crate) inverse: Vec3A,
    /// Origin over direction, moved so that the near planes come early.
    pub(crate) near: Vec3A,
    /// Origin over direction, moved so that the far planes come late.
    pub(crate) far: Vec3A,
    /// Rows of the near planes; the far ones are their neighbors.
    pub(crate) near_rows: [usize; 3],
    pub(crate) t_min: f32,
}

impl BoxRay {
    #[inline(always)]
    pub(crate) fn new(ray: &SlabRay, tree: &Tree) -> Self {
        let sums = ray.sums(tree);
        let padding = sums * (10.0 * ROUNDOFF) + Vec3A::splat(1e-11 * sums.max_element() + 1e-30);
        let padding = padding.copysign(ray.inverse);
        Self {
            inverse: ray.inverse,
            near: (ray.origin + padding) * ray.inverse,
            far: (ray.origin - padding) * ray.inverse,
            near_rows: ray.near_rows,
            t_min: ray.t_min,
        }
    }
}

/// A ray prepared for the triangle filter of one tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterRay {
    /// The axes of the ray's frame.
    pub(crate) axes: [usize; 3],
    /// In the order of `axes`.
    pub(crate) origin: [f32; 3],
    pub(crate) shear: [f32; 2],
    pub(crate) inverse_z: f32,
    /// E: bound on the error of a vertex.
    pub(crate) vertex_error: f32,
    /// Bound on the error of the distance of a vertex.
    pub(crate) t_error: f32,
    /// Triangles that end before this are not hit.
    pub(crate) t_min: f32,
}

impl FilterRay {
    #[inline(always)]
    pub(crate) fn new(ray: &LocalRay, slabs: &SlabRay, tree: &Tree) -> Self {
        let vertex_error = 10.0 * ROUNDOFF * slabs.sums(tree).max_element() + 1e-30;
        let [x, y, z] = ray.turned_origin;
        let inverse_z = ray.inverse_z as f32;
        let t_error = vertex_error * inverse_z.abs();
        Self {
            axes: ray.axes,
            origin: [x as f32, y as f32, z as f32],
            shear: [ray.shear[0] as f32, ray.shear[1] as f32],
            inverse_z,
            vertex_error,
            t_error,
            t_min: ray.t_min - t_error,
        }
    }
}
