//! Shapes that are solved exactly: spheres, parallelograms, and lines and arcs turned about the y axis.
//!
//! Everything curved is built of these four. Cylinders, cones, discs and annuli are lines of a profile turned about
//! y, tori and rims are arcs of one; `compose` puts whole objects together.
//!
//! Conventions, in object space:
//! - y is the axis of revolution. A point lies at radius r ≥ 0 from it, height y and azimuth φ, counted from +z
//!   towards +x: `x = r sin φ`, `z = r cos φ`.
//! - A profile is walked in the (r, y) half-plane; the normal points to the right hand of the walk, so a walk up
//!   has its outside away from the axis. The normal of an arc points away from the arc's center.
//! - `uv.x` is the fraction of the azimuth range, `uv.y` the fraction of the way along the profile.
//! - Ends of part shapes belong to the shape, and so does a margin of 1e-9 of its size about them, so that pieces
//!   that share an end leave no gap.

mod angle;
mod arc;
pub mod compose;
mod crossings;
mod error;
pub mod profile;
mod rectangle;
mod segment;
mod sphere;

pub use angle::AngleRange;
pub use arc::RevolvedArc;
pub use crossings::Crossings;
pub use error::ShapeError;
pub use profile::Profile;
pub use rectangle::Rectangle;
pub use segment::RevolvedSegment;
pub use sphere::Sphere;

use hyaline_math::{DVec2, DVec3};

/// Azimuth range of a whole turn, radians.
pub const WHOLE_TURN: [f64; 2] = [0.0, std::f64::consts::TAU];

/// Margin about the ends of part shapes, relative to the size of the shape.
const RANGE_SLACK: f64 = 1e-9;

/// A surface in object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A sphere about the origin or a part of one.
    Sphere(Sphere),
    /// A line turned about y: cylinder, cone, disc or annulus.
    Segment(RevolvedSegment),
    /// A circular arc turned about y: torus or part torus.
    Arc(RevolvedArc),
    /// A parallelogram.
    Rectangle(Rectangle),
}

/// A point of a surface and the surface about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapePoint {
    /// Point on the surface.
    pub p: DVec3,
    /// Unit normal, to the outside.
    pub n: DVec3,
    /// Surface coordinates, 0…1 each.
    pub uv: DVec2,
    /// Derivative of the point by `uv.x`; some unit tangent where that vanishes.
    pub dpdu: DVec3,
    /// Derivative of the point by `uv.y`.
    pub dpdv: DVec3,
}

impl Shape {
    /// The largest value of `v · p` over the points p of the surface, margins left out.
    pub fn support(&self, v: DVec3) -> f64 {
        match self {
            Self::Sphere(shape) => shape.support(v),
            Self::Segment(shape) => shape.support(v),
            Self::Arc(shape) => shape.support(v),
            Self::Rectangle(shape) => shape.support(v),
        }
    }

    /// Lowest and highest corner of the smallest box about the surface.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let low = DVec3::AXES.map(|axis| -self.support(-axis));
        let high = DVec3::AXES.map(|axis| self.support(axis));
        (low.into(), high.into())
    }

    /// Collects the places where a line meets the surface.
    ///
    /// - `direction`: of any length but 0; `t` counts in units of it.
    /// - `t_min`, `t_max`: only crossings with `t_min < t < t_max` are kept; `t_max` may be infinite.
    /// - `out`: takes them in ascending order; it is cleared first.
    ///
    /// A tangential touch gives two crossings or none.
    pub fn crossings(&self, origin: DVec3, direction: DVec3, t_min: f64, t_max: f64, out: &mut Crossings) {
        out.restart(t_min, t_max);
        match self {
            Self::Sphere(shape) => shape.crossings(origin, direction, out),
            Self::Segment(shape) => shape.crossings(origin, direction, out),
            Self::Arc(shape) => shape.crossings(origin, direction, out),
            Self::Rectangle(shape) => shape.crossings(origin, direction, out),
        }
    }

    /// The surface at `p`, a point on or next to it: `p` is moved onto the surface, continued past its ends.
    pub fn surface_at(&self, p: DVec3) -> ShapePoint {
        match self {
            Self::Sphere(shape) => shape.surface_at(p),
            Self::Segment(shape) => shape.surface_at(p),
            Self::Arc(shape) => shape.surface_at(p),
            Self::Rectangle(shape) => shape.surface_at(p),
        }
    }

    /// Area, square units.
    pub fn area(&self) -> f64 {
        match self {
            Self::Sphere(shape) => shape.area(),
            Self::Segment(shape) => shape.area(),
            Self::Arc(shape) => shape.area(),
            Self::Rectangle(shape) => shape.area(),
        }
    }

    /// A point, uniform by area, and the unit outward normal there.
    ///
    /// - `u`: uniform in [0, 1)².
    pub fn sample_area(&self, u: DVec2) -> (DVec3, DVec3) {
        match self {
            Self::Sphere(shape) => shape.sample_area(u),
            Self::Segment(shape) => shape.sample_area(u),
            Self::Arc(shape) => shape.sample_area(u),
            Self::Rectangle(shape) => shape.sample_area(u),
        }
    }

    /// The largest length that enters the shape's equations; rounding errors are proportional to it.
    pub fn extent(&self) -> f64 {
        match self {
            Self::Sphere(shape) => shape.radius(),
            Self::Segment(shape) => shape.extent(),
            Self::Arc(shape) => shape.extent(),
            Self::Rectangle(shape) => shape.extent(),
        }
    }
}

/// How far outside its ends a point still counts as one of the shape: a margin for the shape's own rounding and one
/// for a ray that comes from afar.
fn end_slack(extent: f64, origin: DVec3) -> f64 {
    RANGE_SLACK * extent + 8.0 * f64::EPSILON * origin.abs().max_element()
}

/// Distance of `p` from the y axis. Not `hypot`, which the system's libm rounds as it likes.
fn axis_distance(p: DVec3) -> f64 {
    (p.x * p.x + p.z * p.z).sqrt()
}

/// The point at radius `r`, height `y` and azimuth `phi`, and the unit direction away from the axis there.
fn revolved_point(r: f64, y: f64, phi: f64) -> (DVec3, DVec3) {
    let (sin, cos) = hyaline_math::float::f64::sin_cos(phi);
    (DVec3::new(r * sin, y, r * cos), DVec3::new(sin, 0.0, cos))
}

/// Unit direction from the axis to `p`; on the axis itself towards the start of the azimuth range.
fn away_from_axis(p: DVec3, phi: &AngleRange) -> DVec3 {
    let r = axis_distance(p);
    if r > 0.0 { DVec3::new(p.x / r, 0.0, p.z / r) } else { DVec3::new(phi.from().y, 0.0, phi.from().x) }
}

/// Assembles the surface point of a revolved shape.
///
/// - `profile`: (r, y) on the profile, r ≥ 0; `normal`: (r, y) components of the unit normal.
/// - `away`: unit direction from the axis.
/// - `v`, `length`: fraction of the way along the profile, and the whole way.
fn revolved_surface(
    profile: DVec2,
    normal: DVec2,
    away: DVec3,
    phi: &AngleRange,
    v: f64,
    length: f64,
) -> ShapePoint {
    let around = DVec3::new(away.z, 0.0, -away.x);
    let speed = phi.span() * profile.x;
    ShapePoint {
        p: away * profile.x + DVec3::Y * profile.y,
        n: away * normal.x + DVec3::Y * normal.y,
        uv: DVec2::new(phi.fraction(DVec2::new(away.z, away.x)), v),
        dpdu: if speed > 0.0 { around * speed } else { around },
        // The normal points to the right hand of the walk.
        dpdv: (DVec3::Y * normal.x - away * normal.y) * length,
    }
}

/// Support of a ring sector of azimuths about the axis: the weight of the radius r in `max v · p`.
fn ring_support(v: DVec3, phi: &AngleRange) -> f64 {
    phi.support(DVec2::new(v.z, v.x))
}

#[cfg(test)]
mod tests;
