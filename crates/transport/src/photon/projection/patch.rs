//! Parts of a shape: boxes of the random numbers that its points are drawn with, and what bounds each.
//!
//! On a parallelogram a box is a parallelogram. On all other shapes, which are turned about an axis, the first random
//! number is the azimuth and the second walks along the profile, a line or an arc; so a box is a part of the profile
//! turned by some angle.

use super::ball::Ball;
use hyaline_geometry::{Primitive, Shape};
use hyaline_math::float::f64 as float;
use hyaline_math::{DMat3, DVec2, DVec3};
use hyaline_world::light::{Cone, UnitBox};
use std::f64::consts::PI;

/// A part of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Patch {
    /// Holds all its points.
    pub(super) ball: Ball,
    /// Holds all its outward normals.
    pub(super) normals: Cone,
}

/// Cuts a shape into about `count` parts.
pub(super) fn cut(primitive: &Primitive, count: u32) -> Vec<(UnitBox, Patch)> {
    let [columns, rows] = columns_and_rows(primitive, count);
    let edge = |i: u32, n: u32| f64::from(i) / f64::from(n);
    let boxes = (0..rows).flat_map(|y| {
        (0..columns).map(move |x| UnitBox {
            min: DVec2::new(edge(x, columns), edge(y, rows)),
            max: DVec2::new(edge(x + 1, columns), edge(y + 1, rows)),
        })
    });
    boxes.map(|unit_box| (unit_box, bound(primitive, &unit_box))).collect()
}

/// A ball about a whole sphere, which is better than balls about its parts.
pub(super) fn whole_ball(primitive: &Primitive) -> Option<Ball> {
    let Shape::Sphere(sphere) = &primitive.shape else { return None };
    let scale = similarity_scale(&primitive.transform.linear())?;
    Some(Ball::about(primitive.transform.translation(), sphere.radius() * scale))
}

/// Numbers of parts along both random numbers that make the parts about as wide as long.
fn columns_and_rows(primitive: &Primitive, count: u32) -> [u32; 2] {
    let at = |u: f64, v: f64| primitive.transform.point(primitive.shape.sample_area(DVec2::new(u, v)).0);
    let along = |f: &dyn Fn(f64) -> DVec3| -> f64 {
        (0..4).map(|i| f(f64::from(i) / 4.0).distance(f(f64::from(i + 1) / 4.0))).sum()
    };
    let widths = [0.0, 0.5, 1.0].map(|v| along(&|u| at(u, v)));
    let (width, height) = (widths.into_iter().fold(0.0, f64::max), along(&|v| at(0.5, v)));
    let ratio = if height > 0.0 && width > 0.0 { width / height } else { 1.0 };
    let columns = ((f64::from(count) * ratio).sqrt().round()).clamp(1.0, f64::from(count)) as u32;
    [columns, (count / columns).max(1)]
}

/// What bounds the part of a shape that a box gives.
fn bound(primitive: &Primitive, unit_box: &UnitBox) -> Patch {
    let n = primitive.sample_area(unit_box.center().as_vec2()).n.as_dvec3();
    match &primitive.shape {
        Shape::Rectangle(_) => {
            let corner = |x: f64, y: f64| {
                let u = unit_box.at(DVec2::new(x, y));
                primitive.transform.point(primitive.shape.sample_area(u).0)
            };
            let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0)];
            let center = corners.iter().sum::<DVec3>() * 0.25;
            let farthest = corners.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
            Patch { ball: Ball::about(center, farthest), normals: Cone::of_direction(n) }
        }
        Shape::Sphere(_) | Shape::Segment(_) | Shape::Arc(_) => bound_turned(primitive, unit_box, n),
    }
}

/// The same for a turned profile.
fn bound_turned(primitive: &Primitive, unit_box: &UnitBox, n: DVec3) -> Patch {
    let profile = Profile::of(&primitive.shape, unit_box);
    let Profile { middle, reach, .. } = profile;
    let linear = primitive.transform.linear();
    // No range of azimuths exceeds a whole turn, so a share of it is at most that share of a whole turn.
    let half_width = PI * (unit_box.max.x - unit_box.min.x);
    let center = primitive.transform.point(profile.away * middle.x + DVec3::Y * middle.y);
    // The square of the distance to a point at radius r, azimuth a off, is (r - m)² + Δy² + 2 r m (1 - cos a).
    let chord2 = 2.0 * (middle.x + reach) * middle.x * (1.0 - float::cos(half_width));
    let farthest = (reach * reach + chord2).sqrt() * stretch(&linear);
    // From the middle around the axis, then along the profile.
    let spread = profile.turning + half_width * profile.cosine;
    // An uneven placement bends normals apart.
    let is_even = spread < 1e-9 || similarity_scale(&linear).is_some();
    let normals = if is_even { Cone { axis: n, half_angle: spread.min(PI) } } else { Cone::ALL };
    Patch { ball: Ball::about(center, farthest), normals }
}

/// A part of a profile.
struct Profile {
    /// Radius and height of a point near it.
    middle: DVec2,
    /// Holds all of it, about `middle`.
    reach: f64,
    /// Unit direction from the axis at the azimuth of the middle of the box.
    away: DVec3,
    /// Largest angle between its normals and that at the middle of the box.
    turning: f64,
    /// Cosine of the one at the middle to the horizontal.
    cosine: f64,
}

impl Profile {
    fn of(shape: &Shape, unit_box: &UnitBox) -> Self {
        let samples = [0.0, 0.25, 0.5, 0.75, 1.0].map(|v| shape.sample_area(unit_box.at(DVec2::new(0.5, v))));
        // All have the same azimuth; that of a point on the axis can't be told.
        let radius = |p: DVec3| (p.x * p.x + p.z * p.z).sqrt();
        let outermost =
            samples.iter().fold(DVec3::ZERO, |a, &(p, _)| if radius(p) > radius(a) { p } else { a });
        let away = DVec3::new(outermost.x, 0.0, outermost.z).normalize_or(DVec3::Z);
        let points = samples.map(|(p, n)| (DVec2::new(radius(p), p.y), DVec2::new(away.dot(n), n.y)));
        // On a profile that is uniform by area no quarter of a box turns by more than a half turn without the others
        // having less area than they do; so each angle is the short way round.
        let angle = |i: usize, j: usize| {
            let (a, b) = (points[i].1, points[j].1);
            float::atan2(a.perp_dot(b).abs(), a.dot(b))
        };
        let (lower, upper) = (angle(0, 1) + angle(1, 2), angle(2, 3) + angle(3, 4));
        // An arc of at most a half turn lies in the disc that its chord is the diameter of.
        let disc = |i: usize, j: usize| {
            let (a, b) = (points[i].0, points[j].0);
            (0.5 * (a + b), 0.5 * a.distance(b))
        };
        let (middle, half_chord) = disc(0, 4);
        let quarters = (0..4).map(|i| disc(i, i + 1)).map(|(center, r)| center.distance(middle) + r);
        let reach = if lower + upper <= PI { half_chord } else { quarters.fold(0.0, f64::max) };
        Self { middle, reach, away, turning: lower.max(upper), cosine: points[2].1.x.abs() }
    }
}

/// The factor by which a map scales, if it scales alike in all directions.
fn similarity_scale(linear: &DMat3) -> Option<f64> {
    let gram = linear.transpose() * *linear;
    let scale2 = gram.x_axis.x;
    gram.abs_diff_eq(DMat3::IDENTITY * scale2, 1e-9 * scale2).then(|| scale2.sqrt() * (1.0 + 1e-9))
}

/// A bound on the factor by which a map stretches any vector.
fn stretch(linear: &DMat3) -> f64 {
    // No eigenvalue of a matrix exceeds its largest sum of absolute values in a column.
    let gram = linear.transpose() * *linear;
    let columns = [gram.x_axis, gram.y_axis, gram.z_axis];
    columns.iter().map(|column| column.abs().element_sum()).fold(0.0, f64::max).sqrt()
}
