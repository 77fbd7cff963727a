//! Balls about things to aim at, and how they look from a point.

use super::BENDS;
use hyaline_geometry::{ItemGeometry, Shape};
use hyaline_math::float::gamma;
use hyaline_math::{Bounds, Vec3};

/// Objects, at most: neighbors are put together where there are more.
pub(super) const MOST_OBJECTS: usize = 8;

/// A ball about something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ball {
    pub(super) center: Vec3,
    pub(super) radius: f32,
}

/// A ball as it is seen from a point.
pub(super) struct View {
    pub(super) axis: Vec3,
    distance: f32,
    /// Sine of the half-angle; ≥ 1 from inside.
    pub(super) sin: f32,
}

impl View {
    pub(super) fn new(ball: &Ball, p: Vec3) -> Self {
        let offset = ball.center - p;
        let distance = offset.length();
        if distance > ball.radius {
            Self { axis: offset / distance, distance, sin: ball.radius / distance }
        } else {
            Self { axis: Vec3::Z, distance, sin: 1.0 }
        }
    }

    /// 1 - the cosine of the half-angle.
    pub(super) fn versine(&self) -> f32 {
        let sin2 = (self.sin * self.sin).min(1.0);
        sin2 / (1.0 + (1.0 - sin2).sqrt())
    }

    /// Whether any of it is above the surface of the normal `n`.
    pub(super) fn rises_over(&self, n: Vec3) -> bool {
        self.axis.dot(n) > -self.sin || self.sin >= 1.0
    }

    /// Whether it may be before a lamp.
    pub(super) fn may_hide(&self, lamp: &View) -> bool {
        let widest = BENDS[BENDS.len() - 1];
        self.sin >= 1.0
            || self.distance < lamp.distance
                && 0.5 * (self.axis - lamp.axis).length_squared()
                    < versine_of(self.sin * 1.2 + lamp.sin + widest)
    }
}

/// About 1 - cos of an angle, radians: where a cone ends is a matter of taste.
pub(super) fn versine_of(angle: f32) -> f32 {
    let a2 = angle.min(2.0) * angle.min(2.0);
    0.5 * a2 * (1.0 - a2 / 12.0)
}

pub(super) fn ball_about(geometry: &ItemGeometry) -> Ball {
    let about = |bounds: Bounds| Ball { center: bounds.center(), radius: bounds.radius() };
    match geometry {
        ItemGeometry::Shape(primitive) => match &primitive.shape {
            // The ball that touches the box is a sphere's own, where the map is a similarity; else it is about it.
            Shape::Sphere(_) => {
                let bounds = primitive.bounds();
                Ball { center: bounds.center(), radius: 0.5 * bounds.size().max_element() * (1.0 + gamma(8)) }
            }
            Shape::Segment(_) | Shape::Arc(_) | Shape::Rectangle(_) => about(primitive.bounds()),
        },
        ItemGeometry::Mesh { mesh, transform: None } => {
            let center = mesh.mesh().bounds().center();
            let reach2 = |p: &Vec3| p.distance_squared(center);
            Ball { center, radius: mesh.mesh().positions().iter().map(reach2).fold(0.0, f32::max).sqrt() }
        }
        ItemGeometry::Mesh { transform: Some(_), .. } => about(geometry.bounds()),
    }
}

/// Balls that hold each other's centers are one thing to aim at; beyond `MOST_OBJECTS` nearest ones are put together.
pub(super) fn merged(mut balls: Vec<Ball>) -> Vec<Ball> {
    balls.retain(|ball| ball.radius.is_finite() && ball.center.is_finite());
    let mut result: Vec<Ball> = Vec::new();
    for ball in balls {
        match result.iter_mut().find(|other| {
            let distance = other.center.distance(ball.center);
            distance < other.radius || distance < ball.radius
        }) {
            Some(other) => *other = other.union(&ball),
            None => result.push(ball),
        }
    }
    while result.len() > MOST_OBJECTS {
        let last = result.pop().expect("more than the most");
        let nearest = (0..result.len())
            .min_by(|&a, &b| {
                let reach = |i: usize| result[i].union(&last).radius;
                reach(a).total_cmp(&reach(b))
            })
            .expect("there are others");
        result[nearest] = result[nearest].union(&last);
    }
    result
}

impl Ball {
    /// A ball about both.
    fn union(&self, other: &Self) -> Self {
        let offset = other.center - self.center;
        let distance = offset.length();
        if distance + other.radius <= self.radius {
            return *self;
        }
        if distance + self.radius <= other.radius {
            return *other;
        }
        let radius = 0.5 * (distance + self.radius + other.radius);
        Self { center: self.center + offset * ((radius - self.radius) / distance), radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_that_hold_each_others_centers_become_one_and_the_many_become_few() {
        let ball = |x: f32, radius| Ball { center: Vec3::X * x, radius };
        assert_eq!(merged(vec![ball(0.0, 1.0), ball(0.5, 1.0)]), [ball(0.25, 1.25)]);
        assert_eq!(merged(vec![ball(0.0, 3.0), ball(0.5, 1.0)]), [ball(0.0, 3.0)]);
        let many: Vec<Ball> = (0..20).map(|i| ball(3.0 * i as f32, 1.0)).collect();
        let few = merged(many.clone());
        assert_eq!(few.len(), MOST_OBJECTS);
        for ball in many {
            let is_covered =
                |other: &Ball| other.center.distance(ball.center) + ball.radius <= other.radius * 1.001;
            assert!(few.iter().any(is_covered), "{ball:?}");
        }
    }
}
