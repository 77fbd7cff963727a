//! `blendbsdf`, and `mixturebsdf` of versions 0.5 and 0.6.

use super::super::element::Element;
use super::super::importer::Importer;
use super::{Nesting, Sides, Surface};
use crate::Result;
use hyaline_scene::{MaterialKind, ScalarSource};

impl Importer<'_> {
    /// Part one finish, part the other; `weight` is the share of the second.
    pub(super) fn blend(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let parts = in_order(bsdf)?;
        let [first, second] = parts.as_slice() else {
            let message = format!("{} needs two bsdfs within, not {}", bsdf.title(), parts.len());
            return Err(bsdf.error(message));
        };
        let weight = self.scalar_source(bsdf, "weight", 0.5)?;
        let first = self.surface_finish(*first, nesting.deeper())?;
        let second = self.surface_finish(*second, nesting.deeper())?;
        Ok(self.joined(bsdf, first, second, weight))
    }

    /// Shares of any number of finishes; what they lack to 1 is black.
    pub(super) fn mixture(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let parts = in_order(bsdf)?;
        let weights = self.mixture_weights(bsdf, parts.len())?;
        let mut total = 0.0;
        let mut mixed: Option<Surface> = None;
        for (part, weight) in parts.into_iter().zip(weights) {
            let part = self.surface_finish(part, nesting.deeper())?;
            total += weight;
            mixed = Some(match mixed {
                None => part,
                Some(before) => {
                    let share = if total > 0.0 { weight / total } else { 0.0 };
                    self.joined(bsdf, before, part, ScalarSource::Constant(share))
                }
            });
        }
        let Some(mixed) = mixed else {
            return Err(bsdf.error(format!("{} has no bsdf within", bsdf.title())));
        };
        if total >= 1.0 - 1e-4 {
            return Ok(mixed);
        }
        let black = Surface::new(MaterialKind::Black, Sides::Opaque, nesting.two_sided);
        Ok(self.joined(bsdf, mixed, black, ScalarSource::Constant(1.0 - total)))
    }

    /// `weights` of a mixture, as many as it has parts, together at most 1.
    fn mixture_weights(&self, bsdf: Element<'_>, count: usize) -> Result<Vec<f32>> {
        let Some(property) = bsdf.property("weights") else {
            return Err(bsdf.error(format!("{} needs `weights`", bsdf.title())));
        };
        let weights: Vec<f32> = property.numbers(property.value()?)?.iter().map(|w| *w as f32).collect();
        if weights.len() != count {
            let message = format!("`weights` has {} numbers for {count} bsdfs", weights.len());
            return Err(property.error(message));
        }
        if let Some(bad) = weights.iter().find(|weight| **weight < 0.0) {
            return Err(property.error(format!("`weights` must be 0 or more, not {bad}")));
        }
        let total: f32 = weights.iter().sum();
        if total <= 1.0 + 1e-4 {
            return Ok(weights);
        }
        bsdf.notes.warn(&property.source, "`weights` are together above 1 and scaled to 1");
        Ok(weights.iter().map(|weight| weight / total).collect())
    }

    /// A blend of two finishes, which become materials of their own; where one has no share, the other alone.
    pub(super) fn joined(
        &mut self,
        bsdf: Element<'_>,
        first: Surface,
        second: Surface,
        weight: ScalarSource,
    ) -> Surface {
        match weight {
            ScalarSource::Constant(weight) if weight <= 0.0 => return first,
            ScalarSource::Constant(weight) if weight >= 1.0 => return second,
            _ => {}
        }
        let sides = common_sides(bsdf, first.sides, second.sides);
        // Each part knows by itself what it does to light on its back.
        let two_sided = first.material.two_sided || second.material.two_sided;
        let first = self.add_surface(first, bsdf.source()).material;
        let second = self.add_surface(second, bsdf.source()).material;
        Surface::new(MaterialKind::Blend { first, second, weight }, sides, two_sided)
    }
}

/// The bsdfs within a blend; Mitsuba sorts them by name, and those without are named `_arg_0`, `_arg_1`, ...
fn in_order<'a>(bsdf: Element<'a>) -> Result<Vec<Element<'a>>> {
    let mut parts = bsdf.children("bsdf")?;
    parts.sort_by_key(|(name, _)| name.unwrap_or("_arg_"));
    Ok(parts.into_iter().map(|(_, part)| part).collect())
}

/// What two finishes on one surface say about its sides.
fn common_sides(bsdf: Element<'_>, first: Sides, second: Sides) -> Sides {
    match (first, second) {
        (Sides::Opaque, sides) | (sides, Sides::Opaque) => sides,
        (Sides::PassThrough, sides) | (sides, Sides::PassThrough) => sides,
        (first, second) if first == second => first,
        _ => {
            bsdf.warn(format!(
                "{} has dielectrics of different indices; those of the first count",
                bsdf.title()
            ));
            first
        }
    }
}
