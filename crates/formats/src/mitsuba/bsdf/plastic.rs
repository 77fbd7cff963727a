//! `plastic`, `roughplastic` and `pplastic`, and `phong` of versions 0.5 and 0.6.

use super::super::element::Element;
use super::super::importer::Importer;
use super::dielectric::relative_ior;
use super::indices::POLYPROPYLENE;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{MaterialKind, ScalarSource};

/// Exponents of Phong lobes: beyond, a mirror is meant.
const EXPONENT: Limits = Limits::between(0.0, 1e6);

impl Importer<'_> {
    /// A matte base under a clear coat.
    pub(super) fn plastic(&mut self, bsdf: Element<'_>) -> Result<MaterialKind> {
        if bsdf.kind() == "pplastic" {
            bsdf.warn("bsdf 'pplastic' is read as 'roughplastic': polarization is not rendered");
        }
        let roughness = match bsdf.kind() {
            "plastic" => ScalarSource::Constant(0.0),
            _ => self.roughness(bsdf)?,
        };
        Ok(MaterialKind::Plastic {
            diffuse: self.color_source(bsdf, "diffuse_reflectance", 0.5)?,
            specular: self.color_source(bsdf, "specular_reflectance", 1.0)?,
            ior: relative_ior(bsdf, POLYPROPYLENE)?,
            roughness,
            nonlinear: bsdf.boolean("nonlinear", false)?,
        })
    }

    /// Lambert plus a Phong lobe.
    pub(super) fn phong(&mut self, bsdf: Element<'_>) -> Result<MaterialKind> {
        let exponent = match bsdf.child_named("texture", "exponent")? {
            Some(texture) => self.scalar_texture(texture)?,
            None => ScalarSource::Constant(bsdf.float("exponent", 30.0, EXPONENT)? as f32),
        };
        Ok(MaterialKind::Phong {
            diffuse: self.color_source(bsdf, "diffuse_reflectance", 0.5)?,
            specular: self.color_source(bsdf, "specular_reflectance", 0.2)?,
            exponent,
        })
    }
}
