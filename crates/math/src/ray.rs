//! A ray, and the robust start of the next one.

use crate::Vec3;

/// A half-line with a search interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start, in scene units.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    /// Hits at or below this distance are ignored.
    pub t_min: f32,
    /// Hits at or beyond this distance are ignored; may be infinite.
    pub t_max: f32,
    /// Moment within the shutter interval, 0…1.
    pub time: f32,
}

impl Ray {
    /// An unbounded ray from `origin` along the unit vector `direction`.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f32::INFINITY, time: 0.0 }
    }

    /// The point at distance `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// Start of a ray that leaves a surface towards `direction`, moved off the surface so far that it cannot hit it
/// again, and no farther.
///
/// - `p`: the hit point; `p_error`: bound on its distance from the true surface, scene units.
/// - `ng`: unit geometric normal, either side.
///
/// Returns a point on the side of the surface that `direction` points to, at a distance of at least `p_error`.
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., §6.8.6.
pub fn offset_origin(p: Vec3, p_error: f32, ng: Vec3, direction: Vec3) -> Vec3 {
    let distance = offset_distance(p, p_error);
    let side = if direction.dot(ng) >= 0.0 { distance } else { -distance };
    p + ng * side
}

/// How far `offset_origin` moves along the normal: the error bound plus the rounding of the moved point itself.
pub fn offset_distance(p: Vec3, p_error: f32) -> f32 {
    p_error + p.abs().max_element() * (2.0 * f32::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_ray_starts_on_the_side_it_goes_to() {
        let p = Vec3::new(1000.0, -3.0, 0.25);
        let ng = Vec3::new(0.6, 0.0, 0.8);
        let up = offset_origin(p, 1e-4, ng, ng);
        let down = offset_origin(p, 1e-4, ng, -ng);
        assert!((up - p).dot(ng) >= 1e-4);
        assert!((down - p).dot(ng) <= -1e-4);
    }
}
