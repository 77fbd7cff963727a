//! One piece of a profile: a line or a circular arc.

use hyaline_math::DVec2;
use hyaline_math::float::f64::{asin, atan2, sin_cos};
use std::f64::consts::{PI, TAU};

/// Height of an arc over its chord, in units of the chord, below which it is taken as a line.
const STRAIGHT: f64 = 1e-6;

/// A line or a circular arc with a direction of walk; its outside is on the right hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piece {
    /// A straight line.
    Line {
        /// First point, (radius, height).
        from: DVec2,
        /// Last point.
        to: DVec2,
    },
    /// A circular arc.
    Arc {
        /// Center, (radius, height); it may lie beyond the axis.
        center: DVec2,
        /// Radius, > 0.
        radius: f64,
        /// Angle of the first point about the center, radians from +r towards +y.
        start: f64,
        /// Angle to the last point, radians; above 0 counter-clockwise, which has the center inside.
        sweep: f64,
    },
}

impl Piece {
    /// A line between two points (radius, height).
    pub fn line(from: DVec2, to: DVec2) -> Self {
        Self::Line { from, to }
    }

    /// An arc about `center`, radians; `sweep` above 0 is counter-clockwise.
    pub fn arc(center: DVec2, radius: f64, start: f64, sweep: f64) -> Self {
        Self::Arc { center, radius, start, sweep }
    }

    /// The arc that leaves `from` along the unit vector `tangent` and reaches `to`; a line where nearly straight.
    pub fn tangent_arc(from: DVec2, tangent: DVec2, to: DVec2) -> Self {
        let chord = to - from;
        let (sine, cosine) = (tangent.perp_dot(chord), tangent.dot(chord));
        // The chord deviates from the tangent by half the sweep; an arc of sweep s rises s/8 over a unit chord.
        let sweep = 2.0 * atan2(sine, cosine);
        if sweep.abs() < 8.0 * STRAIGHT {
            return Self::line(from, to);
        }
        let radius = chord.length_squared() / (2.0 * sine);
        let toward_center = tangent.perp() * radius;
        let start = atan2(-toward_center.y, -toward_center.x);
        Self::arc(from + toward_center, radius.abs(), start, sweep)
    }

    /// First point.
    pub fn from(&self) -> DVec2 {
        self.at(0.0)
    }

    /// Last point.
    pub fn to(&self) -> DVec2 {
        self.at(1.0)
    }

    /// The point a fraction `s` of the way along; other values continue the line or circle.
    pub fn at(&self, s: f64) -> DVec2 {
        match *self {
            // Exact at both ends, and level or upright where the line is.
            Self::Line { to, .. } if s == 1.0 => to,
            Self::Line { from, to } => from + (to - from) * s,
            Self::Arc { center, radius, start, sweep } => center + unit(start + s * sweep) * radius,
        }
    }

    /// Unit vector along the walk at the fraction `s`.
    pub fn tangent_at(&self, s: f64) -> DVec2 {
        match *self {
            Self::Line { from, to } => (to - from).normalize_or_zero(),
            Self::Arc { start, sweep, .. } => unit(start + s * sweep).perp() * sweep.signum(),
        }
    }

    /// Unit vector to the outside, the right hand of the walk, at the fraction `s`.
    pub fn normal_at(&self, s: f64) -> DVec2 {
        -self.tangent_at(s).perp()
    }

    /// Length; NaN or infinite where a number of the piece is.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Line { from, to } => from.distance(to),
            Self::Arc { center, radius, start, sweep } => {
                let is_finite = center.is_finite() && start.is_finite() && radius > 0.0 && sweep.abs() <= TAU;
                if is_finite { radius * sweep.abs() } else { f64::NAN }
            }
        }
    }

    /// The same piece walked backward.
    pub fn reversed(&self) -> Self {
        match *self {
            Self::Line { from, to } => Self::line(to, from),
            Self::Arc { center, radius, start, sweep } => Self::arc(center, radius, start + sweep, -sweep),
        }
    }

    /// The part between two fractions; values outside 0…1 continue the piece.
    pub fn trimmed(&self, first: f64, last: f64) -> Self {
        match *self {
            Self::Line { .. } => Self::line(self.at(first), self.at(last)),
            Self::Arc { center, radius, start, sweep } => {
                Self::arc(center, radius, start + first * sweep, (last - first) * sweep)
            }
        }
    }

    /// The parallel piece at `distance` to the inside, the left hand of the walk; `None` where an arc would vanish.
    pub fn inset(&self, distance: f64) -> Option<Self> {
        match *self {
            Self::Line { from, to } => {
                let shift = self.normal_at(0.0) * -distance;
                Some(Self::line(from + shift, to + shift))
            }
            Self::Arc { center, radius, start, sweep } => {
                let radius = radius - distance * sweep.signum();
                (radius > 0.0).then_some(Self::arc(center, radius, start, sweep))
            }
        }
    }

    /// Least radius of its points.
    pub fn least_radius(&self) -> f64 {
        let ends = self.from().x.min(self.to().x);
        match *self {
            Self::Line { .. } => ends,
            Self::Arc { center, radius, .. } => {
                let has_leftmost = self.fraction_of_angle(PI).is_some_and(|s| s <= 1.0);
                if has_leftmost { center.x - radius } else { ends }
            }
        }
    }

    /// The fraction, 0…1, of the piece's point nearest to `p`.
    pub fn nearest(&self, p: DVec2) -> f64 {
        match *self {
            Self::Line { from, to } => {
                let along = to - from;
                ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0)
            }
            Self::Arc { center, .. } => {
                let offset = p - center;
                match self.fraction_of_angle(atan2(offset.y, offset.x)) {
                    Some(s) if s <= 1.0 => s,
                    _ if self.from().distance_squared(p) <= self.to().distance_squared(p) => 0.0,
                    _ => 1.0,
                }
            }
        }
    }

    /// Distance of `p` from the piece.
    pub fn distance(&self, p: DVec2) -> f64 {
        self.at(self.nearest(p)).distance(p)
    }

    /// The fractions within 0…1 at which the piece has height `y`, ascending.
    pub fn at_height(&self, y: f64) -> Vec<f64> {
        self.at_level(DVec2::Y, y)
    }

    /// The fractions within 0…1 at which the piece has radius `r`, ascending.
    pub fn at_radius(&self, r: f64) -> Vec<f64> {
        self.at_level(DVec2::X, r)
    }

    /// The fractions within 0…1 at which `axis · p = level`, ascending; `axis` is a coordinate axis.
    fn at_level(&self, axis: DVec2, level: f64) -> Vec<f64> {
        let mut fractions = match *self {
            Self::Line { from, to } => vec![(level - axis.dot(from)) / axis.dot(to - from)],
            Self::Arc { center, radius, .. } => {
                let sine = (level - axis.dot(center)) / radius;
                if sine.abs() > 1.0 {
                    return Vec::new();
                }
                let base = atan2(axis.y, axis.x) - 0.5 * PI;
                let angles = [base + asin(sine), base + PI - asin(sine)];
                angles.iter().filter_map(|&angle| self.fraction_of_angle(angle)).collect()
            }
        };
        fractions.retain(|s| (0.0..=1.0).contains(s));
        fractions.sort_by(f64::total_cmp);
        fractions
    }

    /// The fraction at which the continued line or circle is nearest to `p`; on a circle the one nearest to `guess`.
    pub(super) fn unclamped(&self, p: DVec2, guess: f64) -> f64 {
        match *self {
            Self::Line { from, to } => (p - from).dot(to - from) / from.distance_squared(to),
            Self::Arc { center, start, sweep, .. } => {
                let offset = p - center;
                let past = atan2(offset.y, offset.x) - start - guess * sweep;
                guess + (past - TAU * (past / TAU).round()) / sweep
            }
        }
    }

    /// How far along an arc the direction `angle` about its center comes, ≥ 0, above 1 past its end; `None` on a
    /// line.
    fn fraction_of_angle(&self, angle: f64) -> Option<f64> {
        match *self {
            Self::Line { .. } => None,
            Self::Arc { start, sweep, .. } => {
                let past = ((angle - start) * sweep.signum()).rem_euclid(TAU);
                // A hair before the start counts as the start.
                let past = if past > TAU - 1e-12 { 0.0 } else { past };
                Some(past / sweep.abs())
            }
        }
    }
}

fn unit(angle: f64) -> DVec2 {
    let (sin, cos) = sin_cos(angle);
    DVec2::new(cos, sin)
}
