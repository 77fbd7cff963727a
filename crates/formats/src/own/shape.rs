//! Shapes of `[[object]]` and `[[light]]`, by `kind`.
//!
//! | kind | keys (defaults) |
//! |---|---|
//! | sphere | center (0), radius (1), phi (\[0, 360\]), theta (\[0, 180\], from +y) |
//! | disc | center (0), radius (1), normal (+y) or `to` |
//! | annulus | the same, and inner_radius (half of radius) |
//! | rectangle | center (0), size (1), normal (+y) or `to`, up (+y); or corner and edges |
//! | box | center (0) and size (1), or min and max; radius of the edges (0) |
//! | cylinder | radius (1), y (\[0, 1\]), phi, capped (true for a whole turn) |
//! | cone | radius (1), height (1), capped (true) |
//! | torus | major_radius (1), minor_radius (0.25), phi, theta |
//! | mesh | file (.ply, .obj), flat (false) |
//! | generated | form: "knot", "ball" or "shells"; triangles (100000) |
//! | revolution | profile, curve ("lines", "smooth") |
//! | compound | parts: an array of shapes with `transform` |
//! | instance | of: the name of an object |

use super::field::Field;
use super::scene::Reader;
use super::table::Table;
use super::transform;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{GeneratedForm, ProfileCurve, ShapeDescription, ShapePart};
use std::f64::consts::{PI, TAU};

/// All kinds of objects.
pub(super) const KINDS: [&str; 14] = [
    "sphere",
    "disc",
    "annulus",
    "rectangle",
    "box",
    "cylinder",
    "cone",
    "torus",
    "mesh",
    "generated",
    "revolution",
    "compound",
    "instance",
    "vessel",
];

impl Reader<'_> {
    /// Reads a shape; `kind` is the field that names it.
    pub(super) fn shape(&self, kind: Field<'_>, table: &mut Table<'_>) -> Result<ShapeDescription> {
        match kind.string()? {
            "sphere" => self.sphere(table),
            "disc" => self.disc(table, None),
            "annulus" => self.disc(table, Some(0.5)),
            "rectangle" => self.rectangle(table),
            "box" => self.cuboid(table),
            "cylinder" => self.cylinder(table),
            "cone" => Ok(ShapeDescription::Cone {
                radius: self.positive(table, "radius", 1.0)?,
                height: self.positive(table, "height", 1.0)?,
                capped: table.read("capped", true, |field| field.boolean())?,
            }),
            "torus" => Ok(ShapeDescription::Torus {
                major_radius: self.positive(table, "major_radius", 1.0)?,
                minor_radius: self.positive(table, "minor_radius", 0.25)?,
                phi: angles(table, "phi", TAU)?,
                theta: angles(table, "theta", TAU)?,
            }),
            "mesh" => {
                let file = table.require("file", "\"model.ply\"")?;
                let flat = table.read("flat", false, |field| field.boolean())?;
                Ok(ShapeDescription::Mesh { mesh: self.assets.mesh(file.source(), file.string()?)?, flat })
            }
            "generated" => generated(table),
            "revolution" => Ok(ShapeDescription::Revolution {
                profile: self.profile(table.require("profile", "[[0, 0], [1, 0], [0.5, 2]]")?)?,
                curve: curve(table)?,
            }),
            "compound" => self.compound(table),
            "instance" => Ok(ShapeDescription::Instance { of: table.require("of", "\"NAME\"")?.name()? }),
            "vessel" => self.vessel(table),
            _ => Err(kind.no_such_choice(&KINDS)),
        }
    }

    /// A length above 0.
    pub(super) fn positive(&self, table: &mut Table<'_>, key: &'static str, default: f64) -> Result<f64> {
        table.read(key, default, |field| field.length(self.metres, Limits::POSITIVE))
    }

    /// A point, by default the origin.
    pub(super) fn point(&self, table: &mut Table<'_>, key: &'static str) -> Result<DVec3> {
        table.read(key, DVec3::ZERO, |field| field.point(self.metres))
    }

    fn sphere(&self, table: &mut Table<'_>) -> Result<ShapeDescription> {
        Ok(ShapeDescription::Sphere {
            center: self.point(table, "center")?,
            radius: self.positive(table, "radius", 1.0)?,
            phi: angles(table, "phi", TAU)?,
            theta: angles(table, "theta", PI)?,
        })
    }

    fn cuboid(&self, table: &mut Table<'_>) -> Result<ShapeDescription> {
        let ends = (table.take("min"), table.take("max"));
        let (center, size) = (table.take("center"), table.take("size"));
        let (min, max) = match ends {
            (Some(min_field), Some(max_field)) => {
                if let Some(other) = center.or(size) {
                    return Err(
                        other.error(format!("`{}` and `min` exclude each other; keep one", other.key))
                    );
                }
                let (min, max) = (min_field.point(self.metres)?, max_field.point(self.metres)?);
                if !min.cmplt(max).all() {
                    return Err(max_field.error("`max` must be above `min` in each coordinate"));
                }
                (min, max)
            }
            (Some(one), None) | (None, Some(one)) => {
                return Err(one.error("`min` and `max` go together; or give `center` and `size`"));
            }
            (None, None) => {
                let center = center.map_or(Ok(DVec3::ZERO), |field| field.point(self.metres))?;
                let length = |field: Field<'_>| field.length(self.metres, Limits::POSITIVE);
                let size = size.map_or(Ok(DVec3::ONE), |field| match field.items() {
                    Ok(_) => field.array(length).map(DVec3::from_array),
                    Err(_) => length(field).map(DVec3::splat),
                })?;
                (center - 0.5 * size, center + 0.5 * size)
            }
        };
        let half = 0.5 * (max - min).min_element();
        let radius = table.read("radius", 0.0, |field| {
            let radius = field.length(self.metres, Limits::NOT_NEGATIVE)?;
            let error = || field.error(format!("`radius` must be at most half of the shortest edge, {half}"));
            if radius <= half { Ok(radius) } else { Err(error()) }
        })?;
        Ok(ShapeDescription::Box { min, max, radius })
    }

    fn cylinder(&self, table: &mut Table<'_>) -> Result<ShapeDescription> {
        let radius = self.positive(table, "radius", 1.0)?;
        let y = table.read("y", [0.0, 1.0], |field| {
            let [low, high] = field.array(|item| item.length(self.metres, Limits::ANY))?;
            let error = || field.error("`y` must be [lower end, upper end]");
            if low < high { Ok([low, high]) } else { Err(error()) }
        })?;
        let phi = angles(table, "phi", TAU)?;
        let is_whole = phi == [0.0, TAU];
        let capped = table.read("capped", is_whole, |field| match field.boolean()? {
            true if !is_whole => Err(field.error("a part of a cylinder can't be capped")),
            capped => Ok(capped),
        })?;
        Ok(ShapeDescription::Cylinder { radius, y, phi, capped })
    }

    fn compound(&self, table: &mut Table<'_>) -> Result<ShapeDescription> {
        let field = table.require("parts", "[{ kind = \"box\" }, { kind = \"sphere\" }]")?;
        let mut parts = Vec::new();
        for item in field.items()? {
            let mut table = item.table("part of a compound")?;
            let kind = table.require("kind", "\"box\"")?;
            if matches!(kind.string()?, "vessel" | "instance") {
                return Err(kind.error(format!("a {} can't be part of a compound", kind.string()?)));
            }
            let shape = self.shape(kind, &mut table)?;
            let placement =
                table.read("transform", Transform::IDENTITY, |f| transform::read(f, self.metres))?;
            table.finish()?;
            parts.push(ShapePart { shape, placement });
        }
        if parts.is_empty() {
            Err(field.error("`parts` is empty"))
        } else {
            Ok(ShapeDescription::Compound { parts })
        }
    }

    /// Points (radius, height) of a profile.
    pub(super) fn profile(&self, field: Field<'_>) -> Result<Vec<[f64; 2]>> {
        let points = field.items()?;
        if points.len() < 2 {
            return Err(field.error(format!("`{}` needs at least two points [radius, height]", field.key)));
        }
        let mut profile: Vec<[f64; 2]> = Vec::with_capacity(points.len());
        for item in points {
            let point: [f64; 2] = item.array(|coordinate| coordinate.length(self.metres, Limits::ANY))?;
            if point[0] < 0.0 {
                return Err(item.error(format!("the radius of a point must be 0 or more, not {}", point[0])));
            }
            if profile.last() == Some(&point) {
                return Err(item.error("the same point twice in a row"));
            }
            profile.push(point);
        }
        Ok(profile)
    }
}

/// A mesh made in code.
fn generated(table: &mut Table<'_>) -> Result<ShapeDescription> {
    let forms =
        [("knot", GeneratedForm::Knot), ("ball", GeneratedForm::Ball), ("shells", GeneratedForm::Shells)];
    let form = table.require("form", "\"knot\"")?.choice(&forms)?;
    let most = 100_000_000;
    let triangles = table.read("triangles", 100_000, |field| field.integer(8, most))? as u32;
    Ok(ShapeDescription::Generated { form, triangles })
}

/// How the points of a profile are joined.
pub(super) fn curve(table: &mut Table<'_>) -> Result<ProfileCurve> {
    let curves = [("lines", ProfileCurve::Lines), ("smooth", ProfileCurve::Smooth)];
    table.read("curve", ProfileCurve::Lines, |field| field.choice(&curves))
}

/// A range of angles in degrees, from 0 to `whole` radians by default.
fn angles(table: &mut Table<'_>, key: &'static str, whole: f64) -> Result<[f64; 2]> {
    table.read(key, [0.0, whole], |field| {
        let limits = if whole == TAU {
            Limits::between(-360.0, 720.0)
        } else {
            Limits::between(0.0, whole.to_degrees())
        };
        let [from, to] = field.array(|item| item.angle(limits))?;
        let is_range = from < to && to - from <= whole * (1.0 + 1e-12);
        if is_range {
            return Ok([from, to]);
        }
        Err(field.error(format!(
            "`{key}` must be [from, to] in degrees, rising, and at most {} apart",
            whole.to_degrees()
        )))
    })
}
