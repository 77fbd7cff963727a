//! A parallelogram from its center and two half edges.

use super::error::ShapeError;
use super::{Crossings, ShapePoint, end_slack};
use hyaline_math::{DVec2, DVec3, Vec2};

/// The points `center + a half_u + b half_v`, -1 ≤ a, b ≤ 1; the normal is along `half_u × half_v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    center: DVec3,
    half_u: DVec3,
    half_v: DVec3,
    n: DVec3,
    /// Vectors whose products with `p - center` are a and b.
    dual: [DVec3; 2],
    /// Lengths of those: what a margin is in units of a and b.
    dual_lengths: [f64; 2],
    extent: f64,
    area: f64,
}

impl Rectangle {
    /// From the center and the vectors to the middles of two neighboring edges.
    ///
    /// # Errors
    /// Where a number is not finite or the edges are parallel.
    pub fn new(center: DVec3, half_u: DVec3, half_v: DVec3) -> Result<Self, ShapeError> {
        let cross = half_u.cross(half_v);
        let sine = cross.length() / (half_u.length() * half_v.length());
        if !(center.is_finite() && sine > 1e-12 && cross.is_finite()) {
            let remedy = "give finite half edges that are neither 0 nor parallel";
            return Err(ShapeError::out_of_range("sine between a rectangle's edges", sine, remedy));
        }
        let n = cross / cross.length();
        let (u, v) = (half_v.cross(n), n.cross(half_u));
        let dual = [u / u.dot(half_u), v / v.dot(half_v)];
        let dual_lengths = dual.map(DVec3::length);
        let extent = (center.abs() + half_u.abs() + half_v.abs()).max_element();
        Ok(Self { center, half_u, half_v, n, dual, dual_lengths, extent, area: 4.0 * cross.length() })
    }

    /// Coordinates in units of the half edges.
    fn coordinates(&self, p: DVec3) -> DVec2 {
        let offset = p - self.center;
        DVec2::new(self.dual[0].dot(offset), self.dual[1].dot(offset))
    }

    /// The corners in order.
    pub(crate) fn corners(&self) -> [DVec3; 4] {
        let (u, v) = (self.half_u, self.half_v);
        [self.center - u - v, self.center + u - v, self.center + u + v, self.center - u + v]
    }

    /// How near an edge may be to the point whose surface coordinates were rounded to `uv`.
    pub(crate) fn distance_to_edge(&self, uv: Vec2) -> f64 {
        let uv = uv.as_dvec2();
        let share = 2.0 * (uv.min(1.0 - uv) - f64::from(f32::EPSILON));
        (share.x / self.dual_lengths[0]).min(share.y / self.dual_lengths[1])
    }

    pub(super) fn extent(&self) -> f64 {
        self.extent
    }

    pub(super) fn support(&self, v: DVec3) -> f64 {
        v.dot(self.center) + v.dot(self.half_u).abs() + v.dot(self.half_v).abs()
    }

    pub(super) fn crossings(&self, origin: DVec3, direction: DVec3, out: &mut Crossings) {
        let t = self.n.dot(self.center - origin) / self.n.dot(direction);
        if !out.admits(t) {
            return;
        }
        let slack = end_slack(self.extent, origin);
        let ab = self.coordinates(origin + direction * t).abs();
        if ab.x <= 1.0 + slack * self.dual_lengths[0] && ab.y <= 1.0 + slack * self.dual_lengths[1] {
            out.push(t);
        }
    }

    pub(super) fn surface_at(&self, p: DVec3) -> ShapePoint {
        let ab = self.coordinates(p);
        ShapePoint {
            p: self.center + self.half_u * ab.x + self.half_v * ab.y,
            n: self.n,
            uv: (0.5 * (ab + 1.0)).clamp(DVec2::ZERO, DVec2::ONE),
            dpdu: 2.0 * self.half_u,
            dpdv: 2.0 * self.half_v,
        }
    }

    pub(super) fn area(&self) -> f64 {
        self.area
    }

    pub(super) fn sample_area(&self, u: DVec2) -> (DVec3, DVec3) {
        let ab = 2.0 * u - 1.0;
        (self.center + self.half_u * ab.x + self.half_v * ab.y, self.n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_that_span_no_area_are_refused() {
        assert!(Rectangle::new(DVec3::ZERO, DVec3::X, DVec3::X).is_err());
        assert!(Rectangle::new(DVec3::ZERO, DVec3::X, DVec3::ZERO).is_err());
        assert!(Rectangle::new(DVec3::NAN, DVec3::X, DVec3::Y).is_err());
        assert!(Rectangle::new(DVec3::ZERO, DVec3::X * 1e-6, DVec3::Y * 1e-6).is_ok());
    }
}
