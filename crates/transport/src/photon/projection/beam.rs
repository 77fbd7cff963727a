//! All rays that the photons of a cell may take, and whether one of them can reach a ball.

use super::ball::Ball;
use hyaline_math::float::f64 as float;
use hyaline_world::light::Cone;
use std::f64::consts::PI;

/// Half-lines from a ball of origins into a cone of directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    origins: Ball,
    directions: Cone,
    sin: f64,
    cos: f64,
}

impl Beam {
    pub(super) fn new(origins: Ball, directions: Cone) -> Self {
        let (sin, cos) = float::sin_cos(directions.half_angle);
        Self { origins, directions, sin, cos }
    }

    /// Whether a ray of the beam may meet the ball; never wrongly false.
    ///
    /// A ray from `o + e` meets a ball exactly if the ray from `o` meets that ball moved by `-e`; so all origins
    /// are drawn together into one, and the ball grows by what they lie apart.
    pub(super) fn may_meet(&self, target: &Ball) -> bool {
        let to_target = target.center - self.origins.center;
        let radius = target.radius + self.origins.radius;
        // Sine and cosine of the target's half-angle are radius and tangent over the distance. All that follows is
        // multiplied by it, so that a target costs one square root and no division.
        let tangent2 = to_target.length_squared() - radius * radius;
        if tangent2 <= 0.0 || self.directions.half_angle >= PI {
            return true;
        }
        let tangent = tangent2.sqrt();
        // Both angles add up to more than a half turn where the sine of the sum is negative.
        if self.sin * tangent + self.cos * radius < 0.0 {
            return true;
        }
        let cos_sum = self.cos * tangent - self.sin * radius;
        self.directions.axis.dot(to_target) >= cos_sum - 1e-12 * (tangent + radius)
    }
}
