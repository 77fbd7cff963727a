//! A straight line of the (r, y) half-plane turned about y: cylinder, cone frustum, disc or annulus.
//!
//! A point is on the cone where its radius r satisfies `n_r r + n_y y = c`. Squared, this is a quadratic along a ray;
//! its discriminant is formed without the cancellation that spoils flat cones, and the mirrored nappe is told from
//! the right one by the sign that squaring lost.

use super::error::{ShapeError, finite, not_negative, positive};
use super::{AngleRange, Crossings, ShapePoint};
use super::{away_from_axis, axis_distance, end_slack, revolved_point, revolved_surface, ring_support};
use hyaline_math::{DVec2, DVec3};

/// Rise over length below which a line is taken as level.
const FLAT: f64 = 1e-12;

/// A line from (r, y) to (r, y), turned about y; the normal points to the right hand of the walk.
///
/// `uv.y` goes from 0 at the start to 1 at the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RevolvedSegment {
    start: DVec2,
    end: DVec2,
    phi: AngleRange,
    /// Unit vector from start to end.
    along: DVec2,
    length: f64,
}

impl RevolvedSegment {
    /// From the ends (radius, height) and the range of azimuth in radians.
    ///
    /// # Errors
    /// Where a number is not finite, a radius is below 0, the ends coincide, or the surface has no area.
    pub fn new(start: [f64; 2], end: [f64; 2], phi: [f64; 2]) -> Result<Self, ShapeError> {
        for [r, y] in [start, end] {
            not_negative("radius", r)?;
            finite("height", y)?;
        }
        let phi = AngleRange::new("phi", phi)?;
        let (start, end) = (DVec2::from(start), DVec2::from(end));
        let length = positive("length of a profile's line", (end - start).length())?;
        positive("larger radius of a turned line", start.x.max(end.x))?;
        let mut along = (end - start) / length;
        if along.y.abs() < FLAT {
            along = DVec2::new(along.x.signum(), 0.0);
        }
        Ok(Self { start, end, phi, along, length })
    }

    /// An open cylinder, walked upward: the normal points away from the axis.
    ///
    /// # Errors
    /// As `new`.
    pub fn cylinder(radius: f64, y: [f64; 2], phi: [f64; 2]) -> Result<Self, ShapeError> {
        Self::new([radius, y[0].min(y[1])], [radius, y[0].max(y[1])], phi)
    }

    /// An open cone with its base at y = 0 and its apex at y = `height`; the normal points away from the axis.
    ///
    /// # Errors
    /// As `new`.
    pub fn cone(radius: f64, height: f64, phi: [f64; 2]) -> Result<Self, ShapeError> {
        Self::new([positive("radius", radius)?, 0.0], [0.0, positive("height", height)?], phi)
    }

    /// A disc at height `y` that faces +y; an annulus where `inner_radius` is above 0.
    ///
    /// # Errors
    /// As `new`, and where the inner radius is not below the radius.
    pub fn disc(radius: f64, inner_radius: f64, y: f64, phi: [f64; 2]) -> Result<Self, ShapeError> {
        if inner_radius >= radius {
            return Err(ShapeError::out_of_range(
                "inner radius",
                inner_radius,
                "it must be below the radius",
            ));
        }
        Self::new([radius, y], [inner_radius, y], phi)
    }

    /// (r, y) components of the normal.
    fn normal(&self) -> DVec2 {
        DVec2::new(self.along.y, -self.along.x)
    }

    pub(super) fn extent(&self) -> f64 {
        self.start.abs().max(self.end.abs()).max_element()
    }

    pub(super) fn support(&self, v: DVec3) -> f64 {
        let v = DVec2::new(ring_support(v, &self.phi), v.y);
        v.dot(self.start).max(v.dot(self.end))
    }

    pub(super) fn crossings(&self, origin: DVec3, direction: DVec3, out: &mut Crossings) {
        if self.along.y == 0.0 {
            let t = (self.start.y - origin.y) / direction.y;
            let p = origin + direction * t;
            if out.admits(t) && self.is_in_range(DVec3::new(p.x, self.start.y, p.z), origin) {
                out.push(t);
            }
            return;
        }
        // From the point of closest approach to the middle of the axis, so that a far origin costs no digits.
        let middle = DVec3::Y * (0.5 * (self.start.y + self.end.y));
        let closest = (middle - origin).dot(direction) / direction.length_squared();
        let p = (origin - middle) + direction * closest;
        for step in self.nappe_crossings(p, direction, middle.y) {
            let t = closest + step;
            if out.admits(t) && self.is_in_range(p + direction * step + middle, origin) {
                out.push(t);
            }
        }
    }

    /// Parameters at which the line `p + t e`, heights counted from `middle`, meets the unbounded cone; NaN for none.
    fn nappe_crossings(&self, p: DVec3, e: DVec3, middle: f64) -> [f64; 2] {
        let n = self.normal();
        let (p_h, e_h) = (DVec2::new(p.x, p.z), DVec2::new(e.x, e.z));
        // On the cone n_r r = w + t w_slope; squared: a t² + 2 b t + c = 0.
        let w = n.dot(DVec2::new(self.start.x, self.start.y - middle)) - n.y * p.y;
        let w_slope = -n.y * e.y;
        let a = (n.x * e_h.length() - w_slope) * (n.x * e_h.length() + w_slope);
        let b = n.x * n.x * p_h.dot(e_h) - w * w_slope;
        let c = (n.x * p_h.length() - w) * (n.x * p_h.length() + w);
        // b² - a c = n_r² (reach² - miss²), by Lagrange's identity.
        let reach = (w * e_h - w_slope * p_h).length();
        let miss = n.x.abs() * p_h.perp_dot(e_h).abs();
        let root = n.x.abs() * ((reach - miss) * (reach + miss)).sqrt();
        let q = -(b + root.copysign(b));
        let candidates = if q == 0.0 { [0.0 / a; 2] } else { [q / a, c / q] };
        candidates.map(|t| {
            // Through the apex both nappes count: rather twice than never.
            let slack = 4.0 * f64::EPSILON * (w.abs() + (t * w_slope).abs());
            if (w + t * w_slope) * n.x.signum() >= -slack { t } else { f64::NAN }
        })
    }

    fn is_in_range(&self, p: DVec3, origin: DVec3) -> bool {
        let slack = end_slack(self.extent(), origin);
        let s = self.along.dot(DVec2::new(axis_distance(p), p.y) - self.start);
        -slack <= s && s <= self.length + slack && self.phi.contains(DVec2::new(p.z, p.x), slack)
    }

    pub(super) fn surface_at(&self, p: DVec3) -> ShapePoint {
        let s = self.along.dot(DVec2::new(axis_distance(p), p.y) - self.start);
        let profile = self.start + self.along * s;
        let profile = DVec2::new(profile.x.max(0.0), profile.y);
        let away = away_from_axis(p, &self.phi);
        let v = (s / self.length).clamp(0.0, 1.0);
        revolved_surface(profile, self.normal(), away, &self.phi, v, self.length)
    }

    /// Source: Pappus' theorem.
    pub(super) fn area(&self) -> f64 {
        self.phi.span() * self.length * 0.5 * (self.start.x + self.end.x)
    }

    pub(super) fn sample_area(&self, u: DVec2) -> (DVec3, DVec3) {
        // Area up to the fraction s of the way is r0 s + (r1 - r0) s² / 2, in units of the turned length.
        let (r, growth) = (self.start.x, self.end.x - self.start.x);
        let target = u.y * 0.5 * (self.start.x + self.end.x);
        let root = (r * r + 2.0 * growth * target).max(0.0).sqrt();
        let s = if target > 0.0 { (2.0 * target / (r + root)).min(1.0) } else { 0.0 };
        let profile = self.start + (self.end - self.start) * s;
        let n = self.normal();
        let (p, away) = revolved_point(profile.x, profile.y, self.phi.start() + u.x * self.phi.span());
        (p, away * n.x + DVec3::Y * n.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Shape, WHOLE_TURN};

    fn crossings(segment: RevolvedSegment, origin: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
        let mut out = Crossings::new();
        let (origin, direction) = (DVec3::from(origin), DVec3::from(direction));
        Shape::Segment(segment).crossings(origin, direction, 0.0, f64::INFINITY, &mut out);
        out.as_slice().to_vec()
    }

    #[test]
    fn nearly_flat_cones_are_met_once_and_precisely() {
        for rise in [1e-3, 1e-6, 1e-9, 1e-11, 1e-14] {
            let cone = RevolvedSegment::new([1.0, 0.0], [0.0, rise], WHOLE_TURN).unwrap();
            let t = crossings(cone, [0.3, 5.0, 0.0], [0.0, -1.0, 0.0]);
            assert_eq!(t.len(), 1, "rise {rise}");
            assert!((t[0] - (5.0 - 0.7 * rise)).abs() < 1e-14, "rise {rise}");
        }
    }

    #[test]
    fn the_mirrored_nappe_is_not_there() {
        let cone = RevolvedSegment::new([0.0, 0.0], [2.0, 2.0], WHOLE_TURN).unwrap();
        assert_eq!(crossings(cone, [-5.0, 1.0, 0.0], [1.0, 0.0, 0.0]), [4.0, 6.0]);
        assert!(crossings(cone, [-5.0, -1.0, 0.0], [1.0, 0.0, 0.0]).is_empty());
        // Parallel to a generator there is one crossing.
        let parallel = crossings(cone, [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]);
        assert!(parallel.is_empty(), "{parallel:?}");
        let parallel = crossings(cone, [1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]);
        assert_eq!(parallel, [0.5]);
    }

    #[test]
    fn a_ray_along_the_axis_does_not_slip_through_the_apex() {
        for height in [0.1, 0.3, 1.0, 7.7] {
            let cone = RevolvedSegment::cone(0.7, height, WHOLE_TURN).unwrap();
            for start in [0.2, 1.1, 9.3] {
                let t = crossings(cone, [0.0, height + start, 0.0], [0.0, -0.9, 0.0]);
                assert!(!t.is_empty() && t.iter().all(|t| (t - start / 0.9).abs() < 1e-14), "{t:?}");
            }
        }
    }

    #[test]
    fn discs_face_up_and_cylinders_face_out() {
        let disc = Shape::Segment(RevolvedSegment::disc(1.0, 0.5, 2.0, WHOLE_TURN).unwrap());
        assert_eq!(disc.surface_at(DVec3::new(0.7, 2.0, 0.0)).n, DVec3::Y);
        let cylinder = Shape::Segment(RevolvedSegment::cylinder(1.0, [0.0, 1.0], WHOLE_TURN).unwrap());
        assert_eq!(cylinder.surface_at(DVec3::new(1.0, 0.5, 0.0)).n, DVec3::X);
        let cone = Shape::Segment(RevolvedSegment::cone(1.0, 1.0, WHOLE_TURN).unwrap());
        assert!(cone.surface_at(DVec3::new(0.5, 0.5, 0.0)).n.dot(DVec3::new(1.0, 1.0, 0.0)) > 1.4);
    }

    #[test]
    fn impossible_lines_are_refused() {
        assert!(RevolvedSegment::new([-1.0, 0.0], [1.0, 0.0], WHOLE_TURN).is_err());
        assert!(RevolvedSegment::new([0.0, 0.0], [0.0, 1.0], WHOLE_TURN).is_err());
        assert!(RevolvedSegment::new([1.0, 1.0], [1.0, 1.0], WHOLE_TURN).is_err());
        assert!(RevolvedSegment::disc(1.0, 1.0, 0.0, WHOLE_TURN).is_err());
        assert!(RevolvedSegment::cylinder(f64::NAN, [0.0, 1.0], WHOLE_TURN).is_err());
    }
}
