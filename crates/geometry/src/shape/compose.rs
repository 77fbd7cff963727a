//! Whole objects put together from shapes: boxes, rounded boxes, cylinders, cones, tori, surfaces of revolution.
//!
//! Closed objects have their normals outward everywhere.

use super::error::{ShapeError, finite, not_negative, positive};
use super::profile::Piece;
use super::{Profile, Rectangle, RevolvedArc, RevolvedSegment, Shape, Sphere, WHOLE_TURN};
use crate::Primitive;
use hyaline_math::{DMat3, DVec2, DVec3, Transform};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Whether discs close an object that would be open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ends {
    /// Left open.
    #[default]
    Open,
    /// Closed by discs, which makes it a solid.
    Capped,
}

/// Rotations that turn the y axis into the x, y and z axis, and z and x into the two that follow it; column c is the
/// image of axis c.
const CYCLIC: [DMat3; 3] = [
    DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y),
    DMat3::IDENTITY,
    DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
];

/// A box with sharp edges, six rectangles.
///
/// # Errors
/// Where a corner is not finite or `max` is not above `min` in each coordinate.
pub fn cuboid(min: DVec3, max: DVec3) -> Result<Vec<Primitive>, ShapeError> {
    rounded_cuboid(min, max, 0.0)
}

/// A box with rounded edges: six rectangles, twelve quarter cylinders, eight octants of a sphere; rectangles and
/// cylinders that the rounding leaves no room for are left out.
///
/// # Errors
/// As `cuboid`; also where the radius is below 0 or above half the shortest edge.
pub fn rounded_cuboid(min: DVec3, max: DVec3, radius: f64) -> Result<Vec<Primitive>, ShapeError> {
    let size = max - min;
    for (low, edge) in min.to_array().into_iter().zip(size.to_array()) {
        finite("lowest corner of a box", low)?;
        positive("edge of a box (highest corner less lowest)", edge)?;
    }
    let room = 0.5 * size.min_element();
    if not_negative("edge radius of a box", radius)? > room * (1.0 + 1e-12) {
        let remedy = format!("it can be at most half the shortest edge, {room}");
        return Err(ShapeError::out_of_range("edge radius of a box", radius, remedy));
    }
    let center = min + 0.5 * size;
    // Half edges of the flat parts.
    let flat = (0.5 * size - radius).max(DVec3::ZERO);
    let flat = DVec3::select(flat.cmpgt(1e-12 * size), flat, DVec3::ZERO);
    let mut parts = Vec::new();
    for axis in 0..3 {
        faces(center, 0.5 * size, flat, axis, &mut parts)?;
        if radius > 0.0 {
            edges(center, flat, radius, axis, &mut parts)?;
        }
    }
    if radius > 0.0 {
        corners(center, flat, radius, &mut parts)?;
    }
    Ok(parts)
}

/// The two faces of a box across `axis`.
fn faces(
    center: DVec3,
    half: DVec3,
    flat: DVec3,
    axis: usize,
    parts: &mut Vec<Primitive>,
) -> Result<(), ShapeError> {
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = (DVec3::AXES[next] * flat[next], DVec3::AXES[last] * flat[last]);
    if flat[next] == 0.0 || flat[last] == 0.0 {
        return Ok(());
    }
    let out = DVec3::AXES[axis] * half[axis];
    parts.push(Primitive::new(Shape::Rectangle(Rectangle::new(center + out, u, v)?)));
    parts.push(Primitive::new(Shape::Rectangle(Rectangle::new(center - out, v, u)?)));
    Ok(())
}

/// The four quarter cylinders along `axis`.
fn edges(
    center: DVec3,
    flat: DVec3,
    radius: f64,
    axis: usize,
    parts: &mut Vec<Primitive>,
) -> Result<(), ShapeError> {
    if flat[axis] == 0.0 {
        return Ok(());
    }
    for (phi, sign_z, sign_x) in QUARTERS {
        let quarter = RevolvedSegment::cylinder(radius, [-flat[axis], flat[axis]], phi)?;
        // The cylinder's y goes to `axis`, so its z and x go to the next two.
        let mut at = center;
        at[(axis + 1) % 3] += sign_z * flat[(axis + 1) % 3];
        at[(axis + 2) % 3] += sign_x * flat[(axis + 2) % 3];
        parts.push(placed(Shape::Segment(quarter), CYCLIC[axis], at)?);
    }
    Ok(())
}

/// The eight octants.
fn corners(center: DVec3, flat: DVec3, radius: f64, parts: &mut Vec<Primitive>) -> Result<(), ShapeError> {
    for (phi, sign_z, sign_x) in QUARTERS {
        for (latitude, sign_y) in [([0.0, FRAC_PI_2], 1.0), ([-FRAC_PI_2, 0.0], -1.0)] {
            let octant = Sphere::between_latitudes(radius, phi, latitude)?;
            let at = center + flat * DVec3::new(sign_x, sign_y, sign_z);
            parts.push(placed(Shape::Sphere(octant), DMat3::IDENTITY, at)?);
        }
    }
    Ok(())
}

/// Quarters of azimuth with the signs of z and x in them.
const QUARTERS: [([f64; 2], f64, f64); 4] = [
    ([0.0, FRAC_PI_2], 1.0, 1.0),
    ([FRAC_PI_2, PI], -1.0, 1.0),
    ([PI, 1.5 * PI], -1.0, -1.0),
    ([1.5 * PI, TAU], 1.0, -1.0),
];

/// A shape moved into place by a rotation and a shift.
fn placed(shape: Shape, linear: DMat3, at: DVec3) -> Result<Primitive, ShapeError> {
    let transform = Transform::from_parts(linear, at)
        .ok_or_else(|| ShapeError::out_of_range("position of a part", at.length(), "give finite numbers"))?;
    Ok(Primitive { transform, ..Primitive::new(shape) })
}

/// A cylinder about y between two heights.
///
/// # Errors
/// Where a number is not finite, the radius is not above 0, or the heights coincide.
pub fn cylinder(radius: f64, y: [f64; 2], ends: Ends) -> Result<Vec<Primitive>, ShapeError> {
    let (low, high) = (y[0].min(y[1]), y[0].max(y[1]));
    let wall = Profile::lines(&[[positive("radius", radius)?, low], [radius, high]])?;
    revolution(&wall, WHOLE_TURN, ends)
}

/// A cone about y, its base at y = 0, its apex at y = `height`.
///
/// # Errors
/// Where the radius or the height is not finite and above 0.
pub fn cone(radius: f64, height: f64, ends: Ends) -> Result<Vec<Primitive>, ShapeError> {
    let wall = Profile::lines(&[[positive("radius", radius)?, 0.0], [0.0, positive("height", height)?]])?;
    revolution(&wall, WHOLE_TURN, ends)
}

/// A torus about y, its center at the origin, or a part of one; `RevolvedArc::torus` tells what the numbers mean.
///
/// # Errors
/// As `RevolvedArc::torus`.
pub fn torus(
    major_radius: f64,
    minor_radius: f64,
    theta: [f64; 2],
    phi: [f64; 2],
) -> Result<Vec<Primitive>, ShapeError> {
    let arc = RevolvedArc::torus(major_radius, minor_radius, theta, phi)?;
    Ok(vec![Primitive::new(Shape::Arc(arc))])
}

/// A profile turned about y through the azimuths `phi`; the outside is on the right hand of the walk.
///
/// `Ends::Capped` joins the first and the last point to the axis by discs; a profile that starts and ends on the axis,
/// or returns to its start, needs none.
///
/// # Errors
/// Where the range of azimuth is empty or too long, or where caps would cross the profile.
pub fn revolution(profile: &Profile, phi: [f64; 2], ends: Ends) -> Result<Vec<Primitive>, ShapeError> {
    let capped;
    let profile = match ends {
        Ends::Open => profile,
        Ends::Capped => {
            capped = capped_profile(profile)?;
            &capped
        }
    };
    let axis = 1e-12 * profile.size();
    profile.pieces().iter().filter_map(|piece| turned(piece, phi, axis).transpose()).collect()
}

/// The profile continued level to the axis at both ends.
fn capped_profile(profile: &Profile) -> Result<Profile, ShapeError> {
    let axis = 1e-12 * profile.size();
    let (start, end) = (profile.start(), profile.end());
    let mut pieces = profile.pieces().to_vec();
    if start.distance(end) > 1e-9 * profile.size() {
        if start.x > axis {
            pieces.insert(0, Piece::line(DVec2::new(0.0, start.y), start));
        }
        if end.x > axis {
            pieces.push(Piece::line(end, DVec2::new(0.0, end.y)));
        }
    }
    Profile::named("the profile with its caps", "leave the ends open or move them apart", pieces)
}

/// One piece turned about y; `None` where it runs along the axis.
fn turned(piece: &Piece, phi: [f64; 2], axis: f64) -> Result<Option<Primitive>, ShapeError> {
    match *piece {
        Piece::Line { from, to } => {
            if from.x.max(to.x) <= axis {
                return Ok(None);
            }
            let on_axis_or = |p: DVec2| [if p.x <= axis { 0.0 } else { p.x }, p.y];
            let segment = RevolvedSegment::new(on_axis_or(from), on_axis_or(to), phi)?;
            Ok(Some(Primitive::new(Shape::Segment(segment))))
        }
        Piece::Arc { center, radius, start, sweep } => {
            let theta = [start.min(start + sweep), start.max(start + sweep)];
            // Walked clockwise, the outside is towards the arc's center.
            let flipped = sweep < 0.0;
            let part = if center.x.abs() <= axis {
                let turns = ((start + 0.5 * sweep) / TAU).round() * TAU;
                let latitude = theta.map(|angle| angle - turns);
                let sphere = Sphere::between_latitudes(radius, phi, latitude)?;
                placed(Shape::Sphere(sphere), DMat3::IDENTITY, DVec3::Y * center.y)?
            } else {
                Primitive::new(Shape::Arc(RevolvedArc::new(center.into(), radius, theta, phi)?))
            };
            Ok(Some(Primitive { flipped, ..part }))
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
