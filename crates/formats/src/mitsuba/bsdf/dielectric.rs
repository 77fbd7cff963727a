//! `dielectric`, `roughdielectric` and `thindielectric`.
//!
//! `int_ior` and `ext_ior` are numbers or names; by default BK7 in air.

use super::super::element::Element;
use super::super::importer::Importer;
use super::Sides;
use super::indices::{AIR, BK7, by_name};
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, MaterialKind, ScalarSource};

impl Importer<'_> {
    /// A boundary between two clear media, polished or rough.
    pub(super) fn dielectric(&mut self, bsdf: Element<'_>) -> Result<(MaterialKind, Sides)> {
        let roughness = match bsdf.kind() {
            "roughdielectric" => self.roughness(bsdf)?,
            _ => ScalarSource::Constant(0.0),
        };
        let (inside, outside) = (ior(bsdf, "int_ior", BK7)?, ior(bsdf, "ext_ior", AIR)?);
        let tint = (
            self.color_source(bsdf, "specular_reflectance", 1.0)?,
            self.color_source(bsdf, "specular_transmittance", 1.0)?,
        );
        Ok((MaterialKind::Dielectric { roughness, tint }, Sides::Dielectric { inside, outside }))
    }

    /// A pane too thin to bend light.
    pub(super) fn thin_dielectric(&mut self, bsdf: Element<'_>) -> Result<MaterialKind> {
        let ior = relative_ior(bsdf, BK7)?;
        if self.color_source(bsdf, "specular_reflectance", 1.0)? != ColorSource::Constant([1.0; 3]) {
            bsdf.warn("`specular_reflectance` of bsdf 'thindielectric' is not supported and taken as 1");
        }
        let tint = self.color_source(bsdf, "specular_transmittance", 1.0)?;
        Ok(MaterialKind::ThinDielectric { ior, tint })
    }
}

/// `int_ior` over `ext_ior`, by default `inside` over air.
pub(super) fn relative_ior(bsdf: Element<'_>, inside: f64) -> Result<f32> {
    Ok((ior(bsdf, "int_ior", inside)? / ior(bsdf, "ext_ior", AIR)?) as f32)
}

/// An index of refraction: a number or one of Mitsuba's names.
pub(super) fn ior(bsdf: Element<'_>, name: &str, default: f64) -> Result<f64> {
    let Some(property) = bsdf.property(name) else { return Ok(default) };
    if property.tag != "string" {
        return bsdf.float(name, default, Limits::above_to(0.0, 100.0));
    }
    let text = property.value()?;
    by_name(text).map_err(|nearest| {
        let error = property.error(format!("no index of refraction is named '{text}'"));
        error.with_remedy(format!("did you mean '{nearest}'? A number in a <float> works too"))
    })
}
