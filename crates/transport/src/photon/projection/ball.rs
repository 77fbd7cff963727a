//! Balls: what bounds the parts of specular objects and of lights.

use super::neighbors::groups;
use hyaline_math::DVec3;
use rayon::prelude::*;

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ball {
    /// Center, world space.
    pub(super) center: DVec3,
    /// Scene units, ≥ 0.
    pub(super) radius: f64,
}

impl Ball {
    /// About points that are known up to rounding.
    pub(super) fn about(center: DVec3, farthest: f64) -> Self {
        // Points in `f32` are off by half a unit in the last place of each coordinate.
        let rounding = 4e-7 * (center.abs().max_element() + farthest);
        Self { center, radius: farthest * (1.0 + 1e-6) + rounding }
    }

    /// About the balls, its center that of the box about their centers; `None` without a ball.
    pub(super) fn about_balls(balls: &[Self]) -> Option<Self> {
        let first = balls.first()?;
        let low = balls.iter().fold(first.center, |low, ball| low.min(ball.center));
        let high = balls.iter().fold(first.center, |high, ball| high.max(ball.center));
        let center = 0.5 * (low + high);
        let reach = |ball: &Self| ball.center.distance(center) + ball.radius;
        Some(Self { center, radius: balls.iter().map(reach).fold(0.0, f64::max) })
    }

    /// Whether a point lies in it.
    pub(super) fn contains(&self, p: DVec3) -> bool {
        self.center.distance_squared(p) <= self.radius * self.radius
    }
}

/// At most `most` balls that together cover those given: neighbors are put together.
pub(super) fn merged(balls: Vec<Ball>, most: usize) -> Vec<Ball> {
    if balls.len() <= most {
        return balls;
    }
    let about = |group: Vec<u32>| {
        let group: Vec<Ball> = group.into_iter().map(|index| balls[index as usize]).collect();
        Ball::about_balls(&group)
    };
    groups(balls.par_iter().map(|ball| ball.center), most).into_iter().filter_map(about).collect()
}
