//! `kind = "vessel"`: a drinking glass, bowl or bottle with what is in it.
//!
//! `outer` is the profile from the base's edge up to the rim, (radius, height), and `curve` joins its points ("lines",
//! "smooth"); or `sphere = { radius, foot, opening }` makes a bowl. `wall` (6 % of the largest radius) and `base`
//! (twice the wall) are thicknesses; `rim` is "round" or "flat"; `medium` is that of the walls; `fill` lists the
//! liquids from the lowest up, each with `medium`, `level` (fraction of the inner height) and `meniscus` (0).

use super::field::Field;
use super::scene::Reader;
use super::shape::curve;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{FillLayer, RimKind, ShapeDescription, VesselDescription, VesselProfile};

impl Reader<'_> {
    /// Reads the shape of a vessel.
    pub(super) fn vessel(&self, table: &mut Table<'_>) -> Result<ShapeDescription> {
        let (profile, widest) = match table.take("sphere") {
            Some(sphere) => self.bowl(sphere)?,
            None => self.points(table)?,
        };
        let wall = self.positive(table, "wall", 0.06 * widest)?;
        let rims = [("round", RimKind::Round), ("flat", RimKind::Flat)];
        Ok(ShapeDescription::Vessel(VesselDescription {
            profile,
            wall,
            base: self.positive(table, "base", 2.0 * wall)?,
            rim: table.read("rim", RimKind::Round, |field| field.choice(&rims))?,
            medium: table.require("medium", "\"glass\"")?.name()?,
            fill: table.take("fill").map_or(Ok(Vec::new()), |field| self.fill(field))?,
        }))
    }

    /// A profile of points, and its largest radius.
    fn points(&self, table: &mut Table<'_>) -> Result<(VesselProfile, f64)> {
        let field = table.require("outer", "[[0.03, 0], [0.036, 0.1]]")?;
        let outer = self.profile(field)?;
        let widest = outer.iter().map(|point| point[0]).fold(0.0, f64::max);
        if widest <= 0.0 {
            return Err(field.error("`outer` has no width").with_remedy("points are [radius, height]"));
        }
        Ok((VesselProfile::Points { outer, curve: curve(table)? }, widest))
    }

    /// A part of a sphere, by default with a foot of half and an opening of 0.7 of its radius.
    fn bowl(&self, field: Field<'_>) -> Result<(VesselProfile, f64)> {
        let mut table = field.table("sphere of a vessel")?;
        let radius = table.require("radius", "0.1")?.length(self.metres, Limits::POSITIVE)?;
        let part = |field: Field<'_>| {
            let part = field.length(self.metres, Limits::NOT_NEGATIVE)?;
            let error =
                || field.error(format!("`{}` must be below the radius of the sphere, {radius}", field.key));
            if part < radius { Ok(part) } else { Err(error()) }
        };
        let foot = table.read("foot", 0.5 * radius, part)?;
        let opening = table.read("opening", 0.7 * radius, part)?;
        table.finish()?;
        Ok((VesselProfile::Bowl { radius, foot, opening }, radius))
    }

    fn fill(&self, field: Field<'_>) -> Result<Vec<FillLayer>> {
        let mut layers: Vec<FillLayer> = Vec::new();
        for item in field.items_or_one()? {
            let mut table = item.table("fill")?;
            let level_field = table.require("level", "0.75")?;
            let layer = FillLayer {
                medium: table.require("medium", "\"water\"")?.name()?,
                level: level_field.number(Limits::above_to(0.0, 1.0))?,
                meniscus: table.read("meniscus", 0.0, |f| f.length(self.metres, Limits::NOT_NEGATIVE))?,
            };
            table.finish()?;
            if let Some(below) = layers.last()
                && layer.level <= below.level
            {
                let message = format!("`level` must be above that of the layer below, {}", below.level);
                return Err(level_field.error(message).with_remedy("list the liquids from the lowest up"));
            }
            layers.push(layer);
        }
        Ok(layers)
    }
}
