//! `conductor` and `roughconductor`.

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, Located, MaterialKind, Metal, ScalarSource};

/// Mitsuba's material names that the catalogue has.
const METALS: [(&str, &str); 6] = [
    ("au", "gold"),
    ("ag", "silver"),
    ("cu", "copper"),
    ("al", "aluminium"),
    ("cu_palik", "copper"),
    ("ag_palik", "silver"),
];

impl Importer<'_> {
    /// Reads a conductor of the given roughness.
    pub(super) fn conductor(&mut self, bsdf: Element<'_>, roughness: f32) -> Result<MaterialKind> {
        let tint = self.color_source(bsdf, "specular_reflectance", 1.0)?;
        let limits = Limits::between(0.0, 1e6);
        let (eta, k) = (bsdf.color("eta", limits)?, bsdf.color("k", limits)?);
        let outside = self.ior(bsdf, "ext_eta", 1.0)? as f32;
        let material = bsdf.string("material")?;
        // Without eta, k and name, version 3 takes a perfect mirror, older ones copper.
        let default = if self.is_old { "cu" } else { "none" };
        let name = material.as_ref().map_or(default, |material| material.as_str()).to_lowercase();
        if eta.is_none() && k.is_none() && name == "none" && roughness == 0.0 {
            return Ok(MaterialKind::PerfectSpecular { reflectance: tint });
        }
        let metal = if eta.is_some() || k.is_some() || name == "none" {
            let relative = |color: [f32; 3]| color.map(|value| value / outside);
            Metal::Indices { eta: relative(eta.unwrap_or([0.0; 3])), k: relative(k.unwrap_or([1.0; 3])) }
        } else {
            Metal::Named(named(bsdf, material, &name))
        };
        Ok(MaterialKind::Conductor { metal, roughness: ScalarSource::Constant(roughness), tint })
    }
}

/// Our name of a metal; aluminium stands for those that the catalogue lacks.
fn named(bsdf: Element<'_>, material: Option<Located<String>>, name: &str) -> Located<String> {
    let source = material.as_ref().map_or_else(|| bsdf.source().clone(), |material| material.source.clone());
    let known = METALS.iter().find(|(theirs, _)| *theirs == name).map(|(_, ours)| *ours);
    let ours = known.unwrap_or_else(|| {
        bsdf.notes.warn(&source, format!("the metal '{name}' is not known and replaced by aluminium"));
        "aluminium"
    });
    Located::new(ours.to_owned(), source)
}

/// The tint of plain white.
pub(super) fn white() -> ColorSource {
    ColorSource::Constant([1.0; 3])
}
