//! `[camera]` or `[[camera]]`: where it stands and how it sees.
//!
//! `from`, `to` (the origin), `up` ([0, 1, 0]) or `transform` place it; `kind` is perspective (default), thin-lens,
//! orthographic, fisheye or spherical. `fov` is the full angle in degrees along `fov_axis` ("y"). A thin lens has
//! `lens_radius` and `focus`, the distance in focus along the view (default: that of `to`). `height` is what an
//! orthographic camera sees (default: what 40 degrees see at `to`); a spherical one has `longitude` and `latitude`.

use super::field::Field;
use super::table::Table;
use super::transform;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform, float};
use hyaline_scene::{CameraDescription, FovAxis, Projection, SceneError};

/// Angle of view that needs no tuning, degrees.
const DEFAULT_FOV: f64 = 40.0;
const KINDS: [&str; 5] = ["perspective", "thin-lens", "orthographic", "fisheye", "spherical"];

/// Reads a camera; keys that are absent keep what `base` has.
pub(super) fn read(
    table: &mut Table<'_>,
    metres: f64,
    name: String,
    base: Option<&CameraDescription>,
) -> Result<CameraDescription> {
    let (placement, distance) = placement(table, metres, base)?;
    let projection = projection(table, metres, distance, base.map(|camera| &camera.projection))?;
    let medium = table.read_some("medium", |field| field.name())?;
    let medium = medium.or_else(|| base.and_then(|camera| camera.medium.clone()));
    Ok(CameraDescription { name, placement, projection, medium })
}

/// The placement, and the distance of what is looked at.
fn placement(
    table: &mut Table<'_>,
    metres: f64,
    base: Option<&CameraDescription>,
) -> Result<(Transform, f64)> {
    let (from, to, up) = (table.take("from"), table.take("to"), table.take("up"));
    let transform = table.take("transform");
    if let Some(transform) = transform {
        if let Some(other) = from.or(to).or(up) {
            return Err(other.error(format!("`{}` and `transform` exclude each other; keep one", other.key)));
        }
        return Ok((rigid(transform, metres)?, 1.0));
    }
    if let (None, None, None, Some(base)) = (from, to, up, base) {
        return Ok((base.placement, 1.0));
    }
    let old = base.map(|camera| camera.placement);
    let point = |field: Field<'_>| field.point(metres);
    let eye = match (from, old) {
        (Some(from), _) => from.point(metres)?,
        (None, Some(old)) => old.translation(),
        (None, None) => table.require("from", "[0, 1, 4]")?.point(metres)?,
    };
    let target = to.map_or(Ok(old.map_or(DVec3::ZERO, |old| old.point(-DVec3::Z))), point)?;
    let placement = match up {
        Some(up) => Transform::look_at(eye, target, up.direction()?),
        None => Transform::look_at(eye, target, old.map_or(DVec3::Y, |old| old.vector(DVec3::Y)))
            .or_else(|| Transform::look_at(eye, target, -DVec3::Z)),
    };
    let placement = placement.ok_or_else(|| {
        let source = up.or(to).or(from).map_or(table.source, |field| field.source());
        SceneError::at(source, "`from` and `to` coincide, or `up` is parallel to the view")
            .with_remedy("move `to` away from `from`, or turn `up`")
    })?;
    Ok((placement, (target - eye).length()))
}

/// A transform that only turns and moves.
fn rigid(field: Field<'_>, metres: f64) -> Result<Transform> {
    let transform = transform::read(field, metres)?;
    let linear = transform.linear();
    let gram = linear.transpose() * linear;
    if gram.abs_diff_eq(hyaline_math::DMat3::IDENTITY, 1e-6) && !transform.is_mirroring() {
        return Ok(transform);
    }
    Err(field.error("a camera's transform may turn and move, but neither scale nor mirror"))
}

fn projection(
    table: &mut Table<'_>,
    metres: f64,
    distance: f64,
    base: Option<&Projection>,
) -> Result<Projection> {
    let kind = match table.take("kind") {
        Some(field) => {
            let kind = field.string()?;
            if !KINDS.contains(&kind) {
                return Err(field.no_such_choice(&KINDS));
            }
            kind
        }
        None => base.map_or("perspective", kind_of),
    };
    Ok(match kind {
        "thin-lens" => {
            let (fov, fov_axis) = field_of_view(table, base)?;
            let (radius, focus) = match base {
                Some(Projection::ThinLens { lens_radius, focus_distance, .. }) => {
                    (*lens_radius, *focus_distance)
                }
                _ => (0.01 / metres, distance),
            };
            Projection::ThinLens {
                fov,
                fov_axis,
                lens_radius: table
                    .read("lens_radius", radius, |field| field.length(metres, Limits::NOT_NEGATIVE))?,
                focus_distance: table.read("focus", focus, |field| field.length(metres, Limits::POSITIVE))?,
            }
        }
        "orthographic" => {
            let default = match base {
                Some(Projection::Orthographic { height }) => *height,
                _ => 2.0 * distance * float::f64::tan(0.5 * DEFAULT_FOV.to_radians()),
            };
            let height = table.read("height", default, |field| field.length(metres, Limits::POSITIVE))?;
            Projection::Orthographic { height }
        }
        "fisheye" => {
            let default = match base {
                Some(Projection::Fisheye { fov }) => *fov,
                _ => std::f64::consts::PI,
            };
            Projection::Fisheye {
                fov: table.read("fov", default, |f| f.angle(Limits::above_to(0.0, 360.0)))?,
            }
        }
        "spherical" => {
            let (longitude, latitude) = match base {
                Some(Projection::Spherical { longitude, latitude }) => (*longitude, *latitude),
                _ => (std::f64::consts::TAU, std::f64::consts::PI),
            };
            Projection::Spherical {
                longitude: table.read("longitude", longitude, |f| f.angle(Limits::above_to(0.0, 360.0)))?,
                latitude: table.read("latitude", latitude, |f| f.angle(Limits::above_to(0.0, 180.0)))?,
            }
        }
        _ => {
            let (fov, fov_axis) = field_of_view(table, base)?;
            Projection::Perspective { fov, fov_axis }
        }
    })
}

fn kind_of(projection: &Projection) -> &'static str {
    match projection {
        Projection::Perspective { .. } => "perspective",
        Projection::ThinLens { .. } => "thin-lens",
        Projection::Orthographic { .. } => "orthographic",
        Projection::Fisheye { .. } => "fisheye",
        Projection::Spherical { .. } => "spherical",
    }
}

fn field_of_view(table: &mut Table<'_>, base: Option<&Projection>) -> Result<(f64, FovAxis)> {
    let (fov, axis) = match base {
        Some(Projection::Perspective { fov, fov_axis } | Projection::ThinLens { fov, fov_axis, .. }) => {
            (*fov, *fov_axis)
        }
        _ => (DEFAULT_FOV.to_radians(), FovAxis::Y),
    };
    let axes = [
        ("x", FovAxis::X),
        ("y", FovAxis::Y),
        ("diagonal", FovAxis::Diagonal),
        ("smaller", FovAxis::Smaller),
        ("larger", FovAxis::Larger),
    ];
    let fov = table.read("fov", fov, |field| field.angle(Limits::inside(0.0, 180.0)))?;
    Ok((fov, table.read("fov_axis", axis, |field| field.choice(&axes))?))
}
