//! Bsdfs that have no counterpart: the nearest takes their place, and a note says so.

use super::super::element::Element;
use super::super::importer::Importer;
use super::{Sides, matte};
use crate::Result;
use hyaline_scene::{ColorSource, MaterialKind, ScalarSource};

/// Colors that stand for a finish as a whole, the first that is there.
const COLORS: [&str; 6] =
    ["reflectance", "base_color", "diffuse_reflectance", "transmittance", "kd", "specular_reflectance"];

impl Importer<'_> {
    /// Reads a bsdf of a kind that is not rendered as such.
    pub(super) fn replaced(&mut self, bsdf: Element<'_>) -> Result<(MaterialKind, Sides)> {
        match bsdf.kind() {
            "roughdiffuse" => {
                bsdf.ignore(&["use_fast_approx"]);
                let flat = ScalarSource::Constant(0.0);
                if self.scalar_source(bsdf, "alpha", 0.2)? != flat {
                    bsdf.warn("bsdf 'roughdiffuse' is replaced by 'diffuse'");
                }
                Ok((matte(self.color_source(bsdf, "reflectance", 0.5)?), Sides::Opaque))
            }
            "ward" => Ok((self.ward(bsdf)?, Sides::Opaque)),
            "polarizer" | "retarder" | "circular" => {
                bsdf.ignore_all();
                bsdf.warn(format!("{} lets all light through: polarization is not rendered", bsdf.title()));
                Ok((MaterialKind::PassThrough, Sides::PassThrough))
            }
            _ => Ok((matte(self.overall_color(bsdf)?), Sides::Opaque)),
        }
    }

    /// A Phong lobe of about the width of Ward's.
    fn ward(&mut self, bsdf: Element<'_>) -> Result<MaterialKind> {
        bsdf.warn("bsdf 'ward' is replaced by a Phong lobe of about its width");
        bsdf.ignore(&["variant"]);
        let alpha = match self.alpha(bsdf)? {
            ScalarSource::Constant(alpha) => alpha,
            ScalarSource::Texture(_) => {
                bsdf.warn("a texture of the width of bsdf 'ward' is replaced by 0.1");
                0.1
            }
        };
        // A lobe of width alpha about the normal is as wide as a power 2 / alpha² - 2 of its cosine; about the mirror
        // direction the same lobe is twice as wide, which takes a quarter of the power.
        let exponent = (0.5 / (alpha * alpha).max(1e-6) - 0.5).clamp(0.0, 1e6);
        Ok(MaterialKind::Phong {
            diffuse: self.color_source(bsdf, "diffuse_reflectance", 0.5)?,
            specular: self.color_source(bsdf, "specular_reflectance", 0.2)?,
            exponent: ScalarSource::Constant(exponent),
        })
    }

    /// The color that says most about a finish that is not known.
    fn overall_color(&mut self, bsdf: Element<'_>) -> Result<ColorSource> {
        let mut color = ColorSource::Constant([0.5; 3]);
        for name in COLORS {
            if bsdf.property(name).is_some() || bsdf.child_named("texture", name)?.is_some() {
                color = self.color_source(bsdf, name, 0.5)?;
                break;
            }
        }
        bsdf.ignore_all();
        bsdf.warn(format!("{} is not supported and replaced by a matte one", bsdf.title()));
        Ok(color)
    }
}
