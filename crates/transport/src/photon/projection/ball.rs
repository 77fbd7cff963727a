//! Balls: what bounds the parts of specular objects and of lights.

use hyaline_math::DVec3;

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
pub(super) fn merged(mut balls: Vec<Ball>, most: usize) -> Vec<Ball> {
    if balls.len() <= most {
        return balls;
    }
    let mut result = Vec::with_capacity(most);
    split(&mut balls, most, &mut |ball| ball.center, &mut |group| result.extend(Ball::about_balls(group)));
    result
}

/// Splits things into at most `most` groups of neighbors: in halves along the widest axis, again and again.
pub(super) fn split<T>(
    things: &mut [T],
    most: usize,
    center: &mut impl FnMut(&T) -> DVec3,
    group: &mut impl FnMut(&[T]),
) {
    if most <= 1 || things.len() <= 1 {
        return group(things);
    }
    let (low, high) = things.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), thing| {
        let p = center(thing);
        (low.min(p), high.max(p))
    });
    let size = high - low;
    let axis = (0..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest });
    // A stable sort, so that ties are the same on every machine.
    things.sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
    let (lower, upper) = things.split_at_mut(things.len() / 2);
    split(lower, most / 2, center, group);
    split(upper, most - most / 2, center, group);
}
