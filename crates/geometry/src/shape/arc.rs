//! A circular arc of the (r, y) half-plane turned about y: torus, part torus, rounded rim.
//!
//! Squaring the torus to its quartic loses digits and brings in the far side of the axis, so the equation is
//! solved as it is: along a ray of unit speed, with r the distance from the axis,
//!
//! `f(τ) = (r - r_c)² + (y - y_c)² - R²`, whose second derivative is `2 (1 - r_c k / r³)`, k constant along the ray.
//!
//! 1. f is convex where `r³ > r_c k`, concave between the two places where that is an equation.
//! 2. On each of these pieces f' is monotone and has at most one root.
//! 3. Between those roots f is monotone, and a change of sign is one crossing. Newton's method, bracketed, finds it.

use super::error::{ShapeError, finite, positive};
use super::{AngleRange, Crossings, RANGE_SLACK, ShapePoint};
use super::{away_from_axis, axis_distance, end_slack, revolved_point, revolved_surface, ring_support};
use hyaline_math::float::f64::{cbrt, cos, sin, sin_cos};
use hyaline_math::polynomial::bracketed_root;
use hyaline_math::{DVec2, DVec3};

/// An arc about (r, y) = `center`, turned about y; the normal points away from the center.
///
/// `uv.y` goes from 0 at the first angle to 1 at the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RevolvedArc {
    center: DVec2,
    radius: f64,
    /// Angle about the center, from +r towards +y.
    theta: AngleRange,
    phi: AngleRange,
    /// Largest distance from (0, `center.y`).
    reach: f64,
    /// Lowest and highest point, relative to the center.
    y_range: [f64; 2],
    /// Least and largest distance from the axis.
    r_range: [f64; 2],
}

/// A ray of unit speed that starts where it is closest to the torus' center, from which heights count.
struct UnitRay {
    p: DVec3,
    e: DVec3,
    /// Squared moment about the axis; the k of the module's derivation.
    k: f64,
    /// Squared speed across the axis.
    across2: f64,
    /// Where the ray is nearest to the axis.
    nearest: f64,
}

impl RevolvedArc {
    /// From the center (radius, height), the radius of the arc, and the ranges of the angle about the center (from
    /// the outermost point towards +y) and of azimuth, radians.
    ///
    /// # Errors
    /// Where a number is not finite, the radius is not above 0, a range is empty or too long, or the arc crosses the
    /// axis.
    pub fn new(center: [f64; 2], radius: f64, theta: [f64; 2], phi: [f64; 2]) -> Result<Self, ShapeError> {
        let center = DVec2::new(finite("radius", center[0])?, finite("height", center[1])?);
        let radius = positive("radius", radius)?;
        let theta = AngleRange::new("theta", theta)?;
        let phi = AngleRange::new("phi", phi)?;
        let lowest = center.x - radius * theta.support(-DVec2::X);
        if lowest < -RANGE_SLACK * (center.x.abs() + radius) {
            let remedy = "an arc that is turned must not cross the axis";
            return Err(ShapeError::out_of_range("least radius of an arc", lowest, remedy));
        }
        let largest = center.x + radius * theta.support(DVec2::X);
        let y_range = [-radius * theta.support(-DVec2::Y), radius * theta.support(DVec2::Y)];
        let reach = DVec2::new(largest, y_range[1].max(-y_range[0])).length();
        Ok(Self { center, radius, theta, phi, reach, y_range, r_range: [lowest.max(0.0), largest] })
    }

    /// A torus about y, its center at the origin, or a part of one.
    ///
    /// # Errors
    /// As `new`.
    pub fn torus(
        major_radius: f64,
        minor_radius: f64,
        theta: [f64; 2],
        phi: [f64; 2],
    ) -> Result<Self, ShapeError> {
        Self::new([positive("major radius", major_radius)?, 0.0], minor_radius, theta, phi)
    }

    pub(super) fn extent(&self) -> f64 {
        self.center.abs().max_element() + self.radius
    }

    pub(super) fn support(&self, v: DVec3) -> f64 {
        let v = DVec2::new(ring_support(v, &self.phi), v.y);
        v.dot(self.center) + self.radius * self.theta.support(v)
    }

    pub(super) fn crossings(&self, origin: DVec3, direction: DVec3, out: &mut Crossings) {
        let speed = direction.length();
        let e = direction / speed;
        let offset = origin - DVec3::Y * self.center.y;
        let closest = -offset.dot(e);
        let p = offset + e * closest;
        let ray = UnitRay::new(p, e);
        let slack = end_slack(self.extent(), origin);
        let Some((low, high)) = self.clip(&ray, slack) else { return };
        let t_of = |tau: f64| (closest + tau) / speed;
        let parts = self.within_shell(&ray, low, high, slack);
        // Most of what is behind the ray's start or beyond its end is known before it is solved for.
        if !parts.iter().flatten().any(|&(low, high)| out.admits_within(t_of(low), t_of(high))) {
            return;
        }
        let inflections = self.inflections(&ray);
        for (low, high) in parts.into_iter().flatten() {
            let (changes, count) = self.sign_changes(&ray, inflections, low, high);
            for &(low, high) in &changes[..count] {
                if !out.admits_within(t_of(low), t_of(high)) {
                    continue;
                }
                let tolerance = 0.25 * f64::EPSILON * self.reach;
                let tau = bracketed_root(|tau| self.f(&ray, tau), low, high, tolerance);
                if out.admits(t_of(tau)) && self.is_in_range(ray.at(tau), slack) {
                    out.push(t_of(tau));
                }
            }
        }
    }

    /// The parts of [low, high] between the least and the largest distance from the axis: a wall is thin, and most
    /// of a ray runs inside or outside of it.
    fn within_shell(&self, ray: &UnitRay, low: f64, high: f64, slack: f64) -> [Option<(f64, f64)>; 2] {
        let nearest2 = ray.k / ray.across2;
        let half = |r: f64| ((r * r - nearest2) / ray.across2).sqrt();
        let [inner, outer] = [half((self.r_range[0] - slack).max(0.0)), half(self.r_range[1] + slack)];
        if !ray.across2.is_normal() || !nearest2.is_finite() {
            return [Some((low, high)), None];
        }
        if outer.is_nan() {
            return [None, None];
        }
        let part = |first: f64, last: f64| {
            let (first, last) = (first.max(low), last.min(high));
            (first < last).then_some((first, last))
        };
        if inner > 0.0 {
            [part(ray.nearest - outer, ray.nearest - inner), part(ray.nearest + inner, ray.nearest + outer)]
        } else {
            [part(ray.nearest - outer, ray.nearest + outer), None]
        }
    }

    /// The part of the ray that can meet the arc: within its sphere, between its lowest and highest point.
    fn clip(&self, ray: &UnitRay, slack: f64) -> Option<(f64, f64)> {
        let (reach, distance) = (self.reach + slack, ray.p.length());
        let half = ((reach - distance) * (reach + distance)).sqrt();
        let first = (self.y_range[0] - slack - ray.p.y) / ray.e.y;
        let second = (self.y_range[1] + slack - ray.p.y) / ray.e.y;
        // A level ray is either within the slab for good or never; 0/0 is neither bound.
        let (enter, leave) = (first.min(second), first.max(second));
        let (low, high) = ((-half).max(enter), half.min(leave));
        (half > 0.0 && low < high).then_some((low, high))
    }

    /// The pieces of [low, high] that hold one root of f each, ascending, and their number.
    fn sign_changes(
        &self,
        ray: &UnitRay,
        inflections: [(f64, f64); 2],
        low: f64,
        high: f64,
    ) -> ([(f64, f64); 4], usize) {
        let (turns, turn_count) = self.turning_points(ray, inflections, low, high);
        let (mut changes, mut count) = ([(0.0, 0.0); 4], 0);
        let mut last = low;
        let mut last_is_inside = self.f(ray, low).0 < 0.0;
        for &next in turns[..turn_count].iter().chain([&high]) {
            let next_is_inside = self.f(ray, next).0 < 0.0;
            if next_is_inside != last_is_inside {
                changes[count] = (last, next);
                count += 1;
            }
            (last, last_is_inside) = (next, next_is_inside);
        }
        (changes, count)
    }

    /// The roots of f' in [low, high], ascending, and their number.
    fn turning_points(
        &self,
        ray: &UnitRay,
        inflections: [(f64, f64); 2],
        low: f64,
        high: f64,
    ) -> ([f64; 3], usize) {
        let ends = [low, high].map(|tau| (tau, self.half_slope(ray, tau).0));
        let [first, second] = inflections.map(|inflection| match inflection.0 {
            tau if tau <= low => ends[0],
            tau if tau >= high => ends[1],
            _ => inflection,
        });
        let knots = [ends[0], first, second, ends[1]];
        let mut turns = [0.0; 3];
        let mut count = 0;
        for pair in knots.windows(2) {
            if (pair[0].1 < 0.0) != (pair[1].1 < 0.0) {
                let slope = |tau| self.half_slope(ray, tau);
                turns[count] = bracketed_root(slope, pair[0].0, pair[1].0, 1e-7 * self.reach);
                count += 1;
            }
        }
        (turns, count)
    }

    /// Where f changes between convex and concave, each with f'/2; twice the same where it never does.
    fn inflections(&self, ray: &UnitRay) -> [(f64, f64); 2] {
        let r = cbrt(self.center.x * ray.k);
        let r2 = r * r;
        let half2 = (r2 - ray.k / ray.across2) / ray.across2;
        let never_changes = self.center.x <= 0.0 || half2.is_nan() || half2 < 0.0;
        if never_changes {
            return [(ray.nearest, self.half_slope(ray, ray.nearest).0); 2];
        }
        // From r'² = across² - k / r². Where the ray meets the axis, the two coincide, and these are the slopes on
        // either side of the kink.
        let lost = if ray.k > 0.0 { ray.k / r2 } else { 0.0 };
        let r_slope = (ray.across2 - lost).max(0.0).sqrt();
        let (before, after) = (ray.nearest - half2.sqrt(), ray.nearest + half2.sqrt());
        [(before, before + self.center.x * r_slope), (after, after - self.center.x * r_slope)]
    }

    /// f and its slope.
    fn f(&self, ray: &UnitRay, tau: f64) -> (f64, f64) {
        let q = ray.at(tau);
        let r = axis_distance(q);
        let past = r - self.center.x;
        let value = (past - self.radius) * (past + self.radius) + q.y * q.y;
        (value, 2.0 * (tau - self.center.x * ray.r_slope(q, r)))
    }

    /// f'/2 and its slope. Built on the point nearest to the axis, so that a kink lies where `inflections` says.
    fn half_slope(&self, ray: &UnitRay, tau: f64) -> (f64, f64) {
        let past = tau - ray.nearest;
        let r2 = ray.across2 * past * past + ray.k / ray.across2;
        if r2 > 0.0 {
            let r = r2.sqrt();
            (tau - self.center.x * ray.across2 * past / r, 1.0 - self.center.x * ray.k / (r2 * r))
        } else {
            // On the axis, or parallel to it (NaN).
            (tau, 1.0)
        }
    }

    fn is_in_range(&self, q: DVec3, slack: f64) -> bool {
        self.theta.contains(DVec2::new(axis_distance(q) - self.center.x, q.y), slack)
            && self.phi.contains(DVec2::new(q.z, q.x), slack)
    }

    pub(super) fn surface_at(&self, p: DVec3) -> ShapePoint {
        let away = away_from_axis(p, &self.phi);
        let offset = DVec2::new(axis_distance(p), p.y) - self.center;
        let normal = offset.try_normalize().unwrap_or(self.theta.from());
        let profile = self.center + normal * self.radius;
        let profile = DVec2::new(profile.x.max(0.0), profile.y);
        let length = self.radius * self.theta.span();
        revolved_surface(profile, normal, away, &self.phi, self.theta.fraction(normal), length)
    }

    /// Area from the first angle to `past` radians later, per radian of azimuth and unit of radius, and its slope.
    fn sector(&self, past: f64) -> (f64, f64) {
        let middle = self.theta.start() + 0.5 * past;
        // sin(θ0 + past) - sin θ0, without cancellation.
        let rise = 2.0 * cos(middle) * sin(0.5 * past);
        let r = self.center.x + self.radius * cos(self.theta.start() + past);
        (self.center.x * past + self.radius * rise, r)
    }

    /// Source: Pappus' theorem.
    pub(super) fn area(&self) -> f64 {
        self.phi.span() * self.radius * self.sector(self.theta.span()).0
    }

    pub(super) fn sample_area(&self, u: DVec2) -> (DVec3, DVec3) {
        let target = u.y * self.sector(self.theta.span()).0;
        let past = bracketed_root(
            |past| {
                let (area, slope) = self.sector(past);
                (area - target, slope)
            },
            0.0,
            self.theta.span(),
            1e-15 * self.theta.span(),
        );
        let (sin, cos) = sin_cos(self.theta.start() + past);
        let profile = self.center + DVec2::new(cos, sin) * self.radius;
        let (p, away) =
            revolved_point(profile.x.max(0.0), profile.y, self.phi.start() + u.x * self.phi.span());
        (p, away * cos + DVec3::Y * sin)
    }
}

impl UnitRay {
    fn new(p: DVec3, e: DVec3) -> Self {
        let (p_h, e_h) = (DVec2::new(p.x, p.z), DVec2::new(e.x, e.z));
        let (moment, across2) = (p_h.perp_dot(e_h), e_h.length_squared());
        let nearest = if across2 > 0.0 { -p_h.dot(e_h) / across2 } else { 0.0 };
        Self { p, e, k: moment * moment, across2, nearest }
    }

    fn at(&self, tau: f64) -> DVec3 {
        self.p + self.e * tau
    }

    /// Change of the axis distance `r` along the ray at its point `q`.
    fn r_slope(&self, q: DVec3, r: f64) -> f64 {
        if r > 0.0 { (q.x * self.e.x + q.z * self.e.z) / r } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
