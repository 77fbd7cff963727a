//! Flat shapes: disc, annulus, rectangle.

use super::field::Field;
use super::scene::Reader;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::DVec3;
use hyaline_scene::ShapeDescription;

impl Reader<'_> {
    /// A disc, or an annulus whose hole is by default a fraction `hole` of its radius.
    pub(super) fn disc(&self, table: &mut Table<'_>, hole: Option<f64>) -> Result<ShapeDescription> {
        let center = self.point(table, "center")?;
        let normal = self.normal(table, center)?;
        let radius = self.positive(table, "radius", 1.0)?;
        let Some(hole) = hole else {
            return Ok(ShapeDescription::Disc { center, normal, radius, inner_radius: 0.0 });
        };
        let inner = table.take("inner_radius");
        let inner_radius =
            inner.map_or(Ok(hole * radius), |field| field.length(self.metres, Limits::NOT_NEGATIVE))?;
        match inner {
            Some(field) if inner_radius >= radius => {
                Err(field.error(format!("`inner_radius` must be below `radius`, which is {radius}")))
            }
            _ => Ok(ShapeDescription::Disc { center, normal, radius, inner_radius }),
        }
    }

    /// `normal`, or the direction from the center `to` a point; +y by default.
    fn normal(&self, table: &mut Table<'_>, center: DVec3) -> Result<DVec3> {
        match table.take_one(&["normal", "to"])? {
            None => Ok(DVec3::Y),
            Some(field) if field.key == "normal" => field.direction(),
            Some(field) => {
                let direction = field.point(self.metres)? - center;
                let error = || field.error("`to` coincides with the center").with_remedy("aim elsewhere");
                direction.try_normalize().ok_or_else(error)
            }
        }
    }

    /// A rectangle by center and size, or a parallelogram by corner and edges.
    pub(super) fn rectangle(&self, table: &mut Table<'_>) -> Result<ShapeDescription> {
        if let Some(corner) = table.take("corner") {
            let corner = corner.point(self.metres)?;
            let field = table.require("edges", "[[1, 0, 0], [0, 1, 0]]")?;
            let [edge_u, edge_v] = field.array(|item| item.point(self.metres))?;
            if edge_u.cross(edge_v).try_normalize().is_none() {
                return Err(field.error("the edges are parallel or have no length"));
            }
            let (half_u, half_v) = (0.5 * edge_u, 0.5 * edge_v);
            return Ok(ShapeDescription::Rectangle { center: corner + half_u + half_v, half_u, half_v });
        }
        let center = self.point(table, "center")?;
        let size = |field: Field<'_>| field.length(self.metres, Limits::POSITIVE);
        let [width, height] = table.read("size", [1.0; 2], |field| match field.items() {
            Ok(_) => field.array(size),
            Err(_) => size(field).map(|size| [size; 2]),
        })?;
        let normal = self.normal(table, center)?.normalize();
        let up = table.take("up");
        let u = match up {
            None => DVec3::Y.cross(normal).try_normalize().unwrap_or(DVec3::X),
            Some(field) => {
                let u = field.direction()?.normalize().cross(normal).try_normalize();
                u.ok_or_else(|| field.error("`up` is parallel to the normal"))?
            }
        };
        let v = normal.cross(u);
        Ok(ShapeDescription::Rectangle { center, half_u: 0.5 * width * u, half_v: 0.5 * height * v })
    }
}
