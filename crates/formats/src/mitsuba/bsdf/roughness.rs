//! Widths of microfacet lobes: Mitsuba's `alpha` is the square of our roughness.

use super::super::element::Element;
use super::super::importer::Importer;
use super::super::texture::luminance;
use crate::Result;
use hyaline_scene::{Located, ScalarSource};

/// Width where a file gives none.
const DEFAULT_ALPHA: f32 = 0.1;

impl Importer<'_> {
    /// Our roughness of `alpha`, or of the mean of `alpha_u` and `alpha_v`.
    pub(super) fn roughness(&mut self, bsdf: Element<'_>) -> Result<ScalarSource> {
        distribution(bsdf)?;
        bsdf.ignore(&["sample_visible"]);
        Ok(match self.alpha(bsdf)? {
            ScalarSource::Constant(alpha) => ScalarSource::Constant(alpha.sqrt()),
            ScalarSource::Texture(alpha) => ScalarSource::Texture(self.root_of(&alpha)),
        })
    }

    /// Width of the lobe, 0…1.
    pub(super) fn alpha(&mut self, bsdf: Element<'_>) -> Result<ScalarSource> {
        let has =
            |name: &str| Ok(bsdf.property(name).is_some() || bsdf.child_named("texture", name)?.is_some());
        if !has("alpha_u")? && !has("alpha_v")? {
            return self.scalar_source(bsdf, "alpha", DEFAULT_ALPHA);
        }
        let along_u = self.scalar_source(bsdf, "alpha_u", DEFAULT_ALPHA)?;
        let along_v = self.scalar_source(bsdf, "alpha_v", DEFAULT_ALPHA)?;
        if along_u == along_v {
            return Ok(along_u);
        }
        match (along_u, along_v) {
            (ScalarSource::Constant(u), ScalarSource::Constant(v)) => {
                bsdf.warn("anisotropic roughness is not supported and replaced by its mean");
                Ok(ScalarSource::Constant(0.5 * (u + v)))
            }
            (texture @ ScalarSource::Texture(_), _) | (_, texture) => {
                bsdf.warn("anisotropic roughness is not supported; one texture counts for both directions");
                Ok(texture)
            }
        }
    }

    /// The texture whose values are the square roots of the luminance of another's.
    fn root_of(&mut self, texture: &Located<String>) -> Located<String> {
        self.derived_texture(texture, "roughness", |color| [luminance(color).clamp(0.0, 1.0).sqrt(); 3])
    }
}

/// Notes a microfacet distribution that is not ours.
fn distribution(bsdf: Element<'_>) -> Result<()> {
    let distribution = bsdf.string("distribution")?;
    let name = distribution.as_ref().map_or("beckmann", |name| name.as_str().trim());
    if name != "ggx" {
        let source = distribution.as_ref().map_or(bsdf.source(), |name| &name.source);
        let message = format!("the microfacet distribution '{name}' is replaced by 'ggx'");
        bsdf.notes.warn(source, message);
    }
    Ok(())
}
