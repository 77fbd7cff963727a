//! How often a surface winds about a point: 1 inside a closed surface that faces outward, 0 outside of it.

use hyaline_math::DVec3;
use hyaline_math::float::f64::atan2;
use std::f64::consts::TAU;

/// The winding number of some triangles about `p`; a whole number where they are closed.
///
/// Source: van Oosterom & Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 1983; Jacobson,
/// Kavan, Sorkine-Hornung, Robust inside-outside segmentation using generalized winding numbers, SIGGRAPH 2013, eq. 5.
pub(super) fn winding_number(triangles: impl Iterator<Item = [DVec3; 3]>, p: DVec3) -> f64 {
    triangles.map(|corners| half_solid_angle(corners.map(|corner| corner - p))).sum::<f64>() / TAU
}

/// Half the signed solid angle of a triangle about the origin, positive where its back is seen.
fn half_solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let [la, lb, lc] = [a, b, c].map(DVec3::length);
    let height = a.dot(b.cross(c));
    let base = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    atan2(height, base)
}
