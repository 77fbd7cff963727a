//! Bounds of the directions that a box of random numbers leads to.
//!
//! A projection map asks of each box of the unit square which way the light goes that starts with random numbers in
//! it. Here are the answers for the maps that lights use, each a little too wide rather than too narrow.

use hyaline_math::float::f64 as float;
use hyaline_math::{DVec2, DVec3, Frame};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// Added to all angles: more than directions in `f32` are off, radians.
const SLACK: f64 = 1e-5;

/// A box of the unit square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitBox {
    /// Lowest corner, 0…1.
    pub min: DVec2,
    /// Highest corner, 0…1.
    pub max: DVec2,
}

impl UnitBox {
    /// The whole square.
    pub const WHOLE: Self = Self { min: DVec2::ZERO, max: DVec2::ONE };

    /// The point in the middle.
    pub fn center(&self) -> DVec2 {
        0.5 * (self.min + self.max)
    }

    /// The point at `u` of this box, 0…1 each.
    pub fn at(&self, u: DVec2) -> DVec2 {
        self.min + (self.max - self.min) * u
    }
}

/// All directions within an angle of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit.
    pub axis: DVec3,
    /// Radians, 0…π.
    pub half_angle: f64,
}

impl Cone {
    /// All directions.
    pub const ALL: Self = Self { axis: DVec3::Z, half_angle: PI };

    /// One direction, unit.
    pub fn of_direction(axis: DVec3) -> Self {
        Self { axis, half_angle: 0.0 }
    }

    /// The cone with its half-angle widened by some radians.
    pub fn widened(self, angle: f64) -> Self {
        Self { half_angle: (self.half_angle + angle).min(PI), ..self }
    }

    /// About all directions within a range of polar angles and one of azimuths, radians; the pole is the frame's
    /// normal.
    pub fn about_patch(frame: &Frame, theta: [f64; 2], phi: [f64; 2]) -> Self {
        let half_width = 0.5 * (phi[1] - phi[0]);
        if half_width > FRAC_PI_2 {
            let is_upper = theta[1] <= PI - theta[0];
            let (sign, angle) = if is_upper { (1.0, theta[1]) } else { (-1.0, PI - theta[0]) };
            return Self { axis: frame.n.as_dvec3() * sign, half_angle: (angle + SLACK).min(PI) };
        }
        // With at most a quarter turn to either side no point is farther from the middle than a corner.
        let middle = 0.5 * (theta[0] + theta[1]);
        let (sin_middle, cos_middle) = float::sin_cos(middle);
        let cos_width = float::cos(half_width);
        let cos_to_corner = |theta: f64| {
            let (sin, cos) = float::sin_cos(theta);
            (cos * cos_middle + sin * sin_middle * cos_width).clamp(-1.0, 1.0)
        };
        let farthest = cos_to_corner(theta[0]).min(cos_to_corner(theta[1]));
        let (sin_phi, cos_phi) = float::sin_cos(0.5 * (phi[0] + phi[1]));
        let (s, t, n) = (frame.s.as_dvec3(), frame.t.as_dvec3(), frame.n.as_dvec3());
        let axis = s * (sin_middle * cos_phi) + t * (sin_middle * sin_phi) + n * cos_middle;
        Self { axis, half_angle: (float::acos(farthest) + SLACK).min(PI) }
    }

    /// About the directions that `warp::sample_cone` and its kin give a box: `x` tells 1 - cos θ, `y` the azimuth.
    ///
    /// - `versine`: 1 - cos θ at the lower and the upper end of the box, 0…2.
    pub(super) fn about_turned(frame: &Frame, versine: [f64; 2], unit_box: &UnitBox) -> Self {
        let theta = versine.map(|h| 2.0 * float::asin((0.5 * h).clamp(0.0, 1.0).sqrt()));
        Self::about_patch(frame, theta, [TAU * unit_box.min.y, TAU * unit_box.max.y])
    }

    /// About the directions that `warp::sample_cosine_hemisphere` gives a box.
    ///
    /// - `side`: 1 for the hemisphere of the frame's normal, -1 for its mirror image.
    pub(super) fn about_cosine(frame: &Frame, side: f64, unit_box: &UnitBox) -> Self {
        let patch = DiscPatch::of_box(unit_box);
        let theta = patch.radius.map(|r| float::asin(r.min(1.0)));
        let theta = if side > 0.0 { theta } else { [PI - theta[1], PI - theta[0]] };
        Self::about_patch(frame, theta, patch.angle)
    }
}

/// A part of the unit disc in polar coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscPatch {
    /// Smallest and largest distance from the center.
    pub radius: [f64; 2],
    /// Smallest and largest angle, radians.
    pub angle: [f64; 2],
}

impl DiscPatch {
    /// The image of a box under `warp::sample_disc`; exact where the box lies in one quarter of the square, else a
    /// disc about the image.
    pub fn of_box(unit_box: &UnitBox) -> Self {
        let (a, b) = (unit_box.min * 2.0 - 1.0, unit_box.max * 2.0 - 1.0);
        let quarter = match (a.x >= 0.0, b.x <= 0.0, a.y >= 0.0, b.y <= 0.0) {
            (true, _, true, _) => 0,
            (_, true, true, _) => 1,
            (_, true, _, true) => 2,
            (true, _, _, true) => 3,
            _ => {
                let farthest = a.abs().max(b.abs()).max_element();
                return Self { radius: [0.0, farthest], angle: [0.0, TAU] };
            }
        };
        // Turned into the first quarter: lower and upper ends of x and y.
        let [x, y] = match quarter {
            0 => [[a.x, b.x], [a.y, b.y]],
            1 => [[a.y, b.y], [-b.x, -a.x]],
            2 => [[-b.x, -a.x], [-b.y, -a.y]],
            _ => [[-b.y, -a.y], [a.x, b.x]],
        };
        let start = FRAC_PI_2 * f64::from(quarter);
        Self {
            radius: [x[0].max(y[0]), x[1].max(y[1])],
            angle: [start + square_angle(x[1], y[0]), start + square_angle(x[0], y[1])],
        }
    }

    /// A disc about the patch: center and radius.
    pub fn disc(&self) -> (DVec2, f64) {
        let half_width = 0.5 * (self.angle[1] - self.angle[0]);
        if half_width > FRAC_PI_2 {
            return (DVec2::ZERO, self.radius[1] + SLACK);
        }
        let middle = 0.5 * (self.radius[0] + self.radius[1]);
        let cos_width = float::cos(half_width);
        let to_corner =
            |r: f64| (r * r + middle * middle - 2.0 * r * middle * cos_width).max(0.0).sqrt() + SLACK;
        let (sin, cos) = float::sin_cos(0.5 * (self.angle[0] + self.angle[1]));
        (DVec2::new(cos, sin) * middle, to_corner(self.radius[0]).max(to_corner(self.radius[1])))
    }
}

/// The angle that the concentric map gives a point of the first quarter: grows with y, falls with x.
fn square_angle(x: f64, y: f64) -> f64 {
    if x > y {
        FRAC_PI_4 * (y / x)
    } else if y > 0.0 {
        FRAC_PI_2 - FRAC_PI_4 * (x / y)
    } else {
        0.0
    }
}
