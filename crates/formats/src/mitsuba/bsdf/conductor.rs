//! `conductor` and `roughconductor`.
//!
//! A metal is a name, or `eta` and `k` relative to vacuum, which `ext_eta` divides. Without either, version 3 takes
//! a perfect mirror and versions 0.5 and 0.6 copper.

use super::super::element::Element;
use super::super::importer::Importer;
use super::dielectric::ior;
use super::metals::{is_listed, our_name};
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{Located, MaterialKind, Metal, ScalarSource};

/// What stands for metals that the catalogue lacks.
const REPLACEMENT: &str = "aluminium";

impl Importer<'_> {
    /// Reads a metal, smooth or rough.
    pub(super) fn conductor(&mut self, bsdf: Element<'_>) -> Result<MaterialKind> {
        let roughness = match bsdf.kind() {
            "roughconductor" => self.roughness(bsdf)?,
            _ => ScalarSource::Constant(0.0),
        };
        let tint = self.color_source(bsdf, "specular_reflectance", 1.0)?;
        let limits = Limits::between(0.0, 1e6);
        let (eta, k) = (bsdf.color("eta", limits)?, bsdf.color("k", limits)?);
        let outside = ior(bsdf, "ext_eta", 1.0)? as f32;
        let material = bsdf.string("material")?;
        let default = if self.is_old { "Cu" } else { "none" };
        let name = material.as_ref().map_or(default, |material| material.as_str()).trim().to_owned();
        let is_perfect = eta.is_none() && k.is_none() && name.eq_ignore_ascii_case("none");
        if is_perfect && roughness == ScalarSource::Constant(0.0) {
            return Ok(MaterialKind::PerfectSpecular { reflectance: tint });
        }
        let metal = if is_perfect || eta.is_some() || k.is_some() {
            let relative = |color: [f32; 3]| color.map(|value| value / outside);
            Metal::Indices { eta: relative(eta.unwrap_or([0.0; 3])), k: relative(k.unwrap_or([1.0; 3])) }
        } else {
            Metal::Named(named(bsdf, material, &name))
        };
        Ok(MaterialKind::Conductor { metal, roughness, tint })
    }
}

/// Our name of a metal, or that of the one in its place.
fn named(bsdf: Element<'_>, material: Option<Located<String>>, name: &str) -> Located<String> {
    let source = material.map_or_else(|| bsdf.source().clone(), |material| material.source);
    let ours = our_name(name).unwrap_or_else(|| {
        let what = if is_listed(name) { "has no measured values here" } else { "is not known" };
        bsdf.notes.warn(&source, format!("the metal '{name}' {what} and is replaced by {REPLACEMENT}"));
        REPLACEMENT
    });
    Located::new(ours.to_owned(), source)
}
