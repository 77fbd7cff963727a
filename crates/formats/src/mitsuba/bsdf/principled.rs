//! `principled` and `principledthin`, as far as they map.
//!
//! A principled finish is a metal with the share `metallic`; of the rest, glass has the share `spec_trans` and plastic
//! what is left:
//!
//! | part | finish |
//! |---|---|
//! | metal | a conductor that reflects everything, tinted with `base_color`, `roughness` |
//! | glass | a dielectric of `roughness` with index `eta` inside and 1 outside; refracted light takes √`base_color` |
//! | plastic | a base of `base_color` under a coat of index `eta`, `roughness` |
//!
//! Mitsuba's `roughness` is ours. Other lobes (clearcoat, sheen, flatness, spec_tint, anisotropy) are noted and left
//! out. The thin one has a pane in place of glass.

use super::super::element::Element;
use super::super::importer::Importer;
use super::{Nesting, Sides, Surface};
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, MaterialKind, Metal, ScalarSource};

/// Lobes that are left out: 0 means that they are not there.
const LEFT_OUT: [&str; 6] = ["clearcoat", "sheen", "flatness", "spec_tint", "anisotropic", "diff_trans"];
/// What changes nothing, or only what is left out anyway.
const WITHOUT_EFFECT: [&str; 6] = [
    "clearcoat_gloss",
    "sheen_tint",
    "main_specular_sampling_rate",
    "clearcoat_sampling_rate",
    "diffuse_reflectance_sampling_rate",
    "diffuse_transmittance_sampling_rate",
];
const WHITE: ColorSource = ColorSource::Constant([1.0; 3]);
const NONE: ScalarSource = ScalarSource::Constant(0.0);
const ALL: ScalarSource = ScalarSource::Constant(1.0);

impl Importer<'_> {
    /// Metal, glass and plastic in shares.
    pub(super) fn principled(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        leave_out(bsdf)?;
        let color = self.color_source(bsdf, "base_color", 0.5)?;
        let roughness = self.scalar_source(bsdf, "roughness", 0.5)?;
        let metallic = self.scalar_source(bsdf, "metallic", 0.0)?;
        let transmission = self.scalar_source(bsdf, "spec_trans", 0.0)?;
        let eta = index(bsdf)?;
        if metallic != NONE || transmission != ALL {
            bsdf.warn(format!("{} is replaced by a blend of plastic, metal and glass", bsdf.title()));
        }
        let tint = (WHITE, self.root_of_color(&color));
        let glass = MaterialKind::Dielectric { roughness: roughness.clone(), tint };
        let glass = Surface::new(glass, Sides::Dielectric { inside: eta, outside: 1.0 }, true);
        let plastic = Surface::new(plastic(&color, eta, &roughness), Sides::Opaque, nesting.two_sided);
        let metal = MaterialKind::Conductor {
            metal: Metal::Indices { eta: [0.0; 3], k: [1.0; 3] },
            roughness,
            tint: color,
        };
        let metal = Surface::new(metal, Sides::Opaque, nesting.two_sided);
        if metallic == ALL {
            return Ok(metal);
        }
        let base = self.joined(bsdf, plastic, glass, transmission);
        Ok(self.joined(bsdf, base, metal, metallic))
    }

    /// A pane and plastic in shares.
    pub(super) fn principled_thin(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        leave_out(bsdf)?;
        let tint = self.color_source(bsdf, "base_color", 0.5)?;
        let roughness = self.scalar_source(bsdf, "roughness", 0.5)?;
        let transmission = self.scalar_source(bsdf, "spec_trans", 0.0)?;
        let eta = index(bsdf)?;
        bsdf.warn(format!("{} is replaced by a blend of plastic and a smooth pane", bsdf.title()));
        let plastic = Surface::new(plastic(&tint, eta, &roughness), Sides::Opaque, nesting.two_sided);
        let pane = MaterialKind::ThinDielectric { ior: eta as f32, tint };
        Ok(self.joined(bsdf, plastic, Surface::new(pane, Sides::Opaque, true), transmission))
    }

    /// The square root of a color, which light that crosses two boundaries takes twice.
    fn root_of_color(&mut self, color: &ColorSource) -> ColorSource {
        let root = |color: [f32; 3]| color.map(|value| value.max(0.0).sqrt());
        match color {
            ColorSource::Constant(color) => ColorSource::Constant(root(*color)),
            ColorSource::Texture(texture) => {
                ColorSource::Texture(self.derived_texture(texture, "root", root))
            }
        }
    }
}

fn plastic(color: &ColorSource, eta: f64, roughness: &ScalarSource) -> MaterialKind {
    MaterialKind::Plastic {
        diffuse: color.clone(),
        specular: WHITE,
        ior: eta as f32,
        roughness: roughness.clone(),
        nonlinear: false,
    }
}

/// `eta`, or the index whose reflectance at normal incidence is 8 % of `specular`.
fn index(bsdf: Element<'_>) -> Result<f64> {
    if bsdf.property("eta").is_some() {
        return bsdf.float("eta", 1.5, Limits::above_to(0.0, 100.0));
    }
    let specular = bsdf.float("specular", 0.5, Limits::FRACTION)?;
    Ok(2.0 / (1.0 - (0.08 * specular).sqrt()) - 1.0)
}

/// Notes the lobes that are there and left out.
fn leave_out(bsdf: Element<'_>) -> Result<()> {
    bsdf.ignore(&WITHOUT_EFFECT);
    for name in LEFT_OUT {
        let Some(property) = bsdf.property(name) else { continue };
        if bsdf.float(name, 0.0, Limits::ANY)? != 0.0 {
            let message = format!("`{name}` of {} is not supported and ignored", bsdf.title());
            bsdf.notes.warn(&property.source, message);
        }
    }
    Ok(())
}
