//! The forms of shapes, in the measures and poses that Mitsuba gives them.

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::{LARGEST_LENGTH, Limits, SMALLEST_LENGTH};
use hyaline_math::{DVec3, Transform};
use hyaline_scene::ShapeDescription;
use std::f64::consts::{PI, TAU};

/// Radii that count.
const RADIUS: Limits = Limits::between(SMALLEST_LENGTH, LARGEST_LENGTH);

/// A form with its placement.
#[derive(Clone, Debug)]
pub(super) struct Form<'a> {
    /// What it looks like.
    pub(super) shape: ShapeDescription,
    /// Object space to world.
    pub(super) placement: Transform,
    /// Whether the normals of `shape` are already turned as the file wants them.
    pub(super) is_turned: bool,
    /// The finish of this part, where the shape has several.
    pub(super) bsdf: Option<Element<'a>>,
}

impl Form<'_> {
    /// A form whose normals point out.
    pub(super) fn new(shape: ShapeDescription, placement: Transform) -> Self {
        Self { shape, placement, is_turned: false, bsdf: None }
    }

    /// A form whose normals are as the file wants them.
    pub(super) fn turned(shape: ShapeDescription, placement: Transform) -> Self {
        Self { is_turned: true, ..Self::new(shape, placement) }
    }
}

impl Importer<'_> {
    /// The forms of a shape, several where its parts differ in finish; none where its type is unknown.
    pub(super) fn forms<'a>(&mut self, shape: Element<'a>, flip: bool) -> Result<Vec<Form<'a>>> {
        let placement = shape.transform("to_world")?;
        let half_u = if flip { -DVec3::X } else { DVec3::X };
        let normal = if flip { -DVec3::Z } else { DVec3::Z };
        Ok(vec![match shape.kind() {
            "sphere" => {
                let center = shape.point("center")?.unwrap_or(DVec3::ZERO);
                let radius = shape.float("radius", 1.0, RADIUS)?;
                let whole = ShapeDescription::Sphere { center, radius, phi: [0.0, TAU], theta: [0.0, PI] };
                Form::new(whole, placement)
            }
            "rectangle" => Form::turned(
                ShapeDescription::Rectangle { center: DVec3::ZERO, half_u, half_v: DVec3::Y },
                placement,
            ),
            "disk" => Form::turned(
                ShapeDescription::Disc { center: DVec3::ZERO, normal, radius: 1.0, inner_radius: 0.0 },
                placement,
            ),
            "cube" => {
                Form::new(ShapeDescription::Box { min: -DVec3::ONE, max: DVec3::ONE, radius: 0.0 }, placement)
            }
            "cylinder" => cylinder(shape, &placement)?,
            "ply" | "obj" | "serialized" => return self.mesh(shape, placement, flip),
            _ => return Ok(Vec::new()),
        }])
    }
}

/// An open cylinder from p0 to p1; ours stands on the origin along y.
fn cylinder<'a>(shape: Element<'_>, to_world: &Transform) -> Result<Form<'a>> {
    let p0 = shape.point("p0")?.unwrap_or(DVec3::ZERO);
    let axis = shape.point("p1")?.unwrap_or(DVec3::Z) - p0;
    let radius = shape.float("radius", 1.0, RADIUS)?;
    let length = axis.length();
    match Transform::from_y_axis(p0, axis, DVec3::X) {
        Some(upright) if RADIUS.contain(length) => {
            let y = [0.0, length];
            let open = ShapeDescription::Cylinder { radius, y, phi: [0.0, TAU], capped: false };
            Ok(Form::new(open, to_world.after(&upright)))
        }
        _ => Err(shape.error("the ends `p0` and `p1` of the cylinder coincide")),
    }
}
