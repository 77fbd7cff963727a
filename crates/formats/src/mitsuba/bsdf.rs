//! `<bsdf>`: finishes, and the indices that a dielectric gives to the two sides of its shape.

use super::conductor::white;
use super::element::Element;
use super::importer::Importer;
use super::indices::{AIR, BK7, POLYPROPYLENE, by_name};
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, Located, MaterialKind, ScalarSource};

/// Most wrappers around a BSDF.
const MAX_DEPTH: usize = 16;

/// What a BSDF says about the media at its shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sides {
    /// Nothing: it lets no light through, or is thin.
    Opaque,
    /// They differ in index.
    Dielectric {
        /// Index on the side that normals point away from.
        inside: f64,
        /// Index on the side that normals point to.
        outside: f64,
    },
    /// They have one index.
    PassThrough,
}

/// A finish and what it says about the sides.
pub(super) struct Finish {
    /// Name of the material.
    pub(super) material: Located<String>,
    /// What it says about the media.
    pub(super) sides: Sides,
}

impl Importer<'_> {
    /// Reads a BSDF and adds its material.
    pub(super) fn bsdf(&mut self, bsdf: Element<'_>) -> Result<Finish> {
        let mut inner = bsdf;
        let mut two_sided = false;
        let mut id = bsdf.id();
        let mut wraps_nothing = false;
        for _ in 0..MAX_DEPTH {
            match inner.kind() {
                "twosided" => two_sided = true,
                "bumpmap" | "normalmap" | "mask" | "blendbsdf" => {
                    inner.warn(format!("{} is not supported; what it wraps counts alone", inner.title()));
                    inner.ignore_all();
                }
                _ => {
                    wraps_nothing = true;
                    break;
                }
            }
            let Some((_, next)) = inner.children("bsdf")?.into_iter().next() else {
                return Err(inner.error(format!("{} has no bsdf within", inner.title())));
            };
            inner = next;
            id = id.or(inner.id());
        }
        if !wraps_nothing {
            return Err(
                bsdf.error(format!("more than {MAX_DEPTH} bsdfs within each other, or one within itself"))
            );
        }
        let (kind, sides) = self.bsdf_kind(inner)?;
        let name = id.unwrap_or(match kind {
            MaterialKind::Matte { .. } => "matte",
            MaterialKind::Phong { .. } => "phong",
            MaterialKind::PerfectSpecular { .. } => "mirror",
            MaterialKind::Conductor { .. } => "conductor",
            MaterialKind::Dielectric { .. } => "dielectric",
            MaterialKind::ThinDielectric { .. } => "thin-dielectric",
            MaterialKind::PassThrough => "pass-through",
            MaterialKind::Black => "black",
            MaterialKind::Plastic { .. } => "plastic",
            MaterialKind::Blend { .. } => "blend",
            MaterialKind::GlossySpecular { .. } | MaterialKind::SimpleTransparent { .. } => "finish",
        });
        // The two sides of these do not differ.
        let two_sided =
            two_sided || sides != Sides::Opaque || matches!(kind, MaterialKind::ThinDielectric { .. });
        let material = self.add_material(name, kind, two_sided, bsdf.source());
        Ok(Finish { material, sides })
    }

    fn bsdf_kind(&mut self, bsdf: Element<'_>) -> Result<(MaterialKind, Sides)> {
        let opaque = |kind: MaterialKind| Ok((kind, Sides::Opaque));
        match bsdf.kind() {
            "diffuse" | "roughdiffuse" => {
                if bsdf.kind() == "roughdiffuse" {
                    bsdf.warn("bsdf 'roughdiffuse' is replaced by 'diffuse'");
                    bsdf.ignore_all();
                }
                let reflectance = self.color_source(bsdf, "reflectance", 0.5)?;
                opaque(match reflectance {
                    ColorSource::Constant([0.0, 0.0, 0.0]) => MaterialKind::Black,
                    reflectance => MaterialKind::Matte { reflectance },
                })
            }
            "dielectric" => self.dielectric(bsdf, 0.0),
            "roughdielectric" => {
                let roughness = roughness(bsdf)?;
                self.dielectric(bsdf, roughness)
            }
            "thindielectric" => {
                let index = self.ior(bsdf, "int_ior", BK7)? / self.ior(bsdf, "ext_ior", AIR)?;
                bsdf.ignore(&["specular_reflectance"]);
                let tint = self.color_source(bsdf, "specular_transmittance", 1.0)?;
                opaque(MaterialKind::ThinDielectric { ior: index as f32, tint })
            }
            "conductor" => self.conductor(bsdf, 0.0).and_then(opaque),
            "roughconductor" => {
                let roughness = roughness(bsdf)?;
                self.conductor(bsdf, roughness).and_then(opaque)
            }
            "plastic" => self.plastic(bsdf, 0.02).and_then(opaque),
            "roughplastic" => {
                let roughness = roughness(bsdf)?;
                self.plastic(bsdf, roughness * roughness).and_then(opaque)
            }
            "phong" => opaque(MaterialKind::Phong {
                diffuse: self.color_source(bsdf, "diffuse_reflectance", 0.5)?,
                specular: self.color_source(bsdf, "specular_reflectance", 0.2)?,
                exponent: ScalarSource::Constant(
                    bsdf.float("exponent", 30.0, Limits::between(0.0, 1e6))? as f32
                ),
            }),
            "null" => Ok((MaterialKind::PassThrough, Sides::PassThrough)),
            _ => {
                bsdf.warn(format!("{} is not supported and replaced by a matte one", bsdf.title()));
                bsdf.ignore_all();
                opaque(MaterialKind::Matte { reflectance: self.color_source(bsdf, "base_color", 0.5)? })
            }
        }
    }

    fn dielectric(&mut self, bsdf: Element<'_>, roughness: f32) -> Result<(MaterialKind, Sides)> {
        let (inside, outside) = (self.ior(bsdf, "int_ior", BK7)?, self.ior(bsdf, "ext_ior", AIR)?);
        let tint = (
            self.color_source(bsdf, "specular_reflectance", 1.0)?,
            self.color_source(bsdf, "specular_transmittance", 1.0)?,
        );
        let kind = MaterialKind::Dielectric { roughness: ScalarSource::Constant(roughness), tint };
        Ok((kind, Sides::Dielectric { inside, outside }))
    }

    /// The nearest that we have: a matte base under a Phong lobe as bright as the coat at normal incidence.
    fn plastic(&mut self, bsdf: Element<'_>, alpha: f32) -> Result<MaterialKind> {
        bsdf.warn(format!("{} is replaced by a matte base with a Phong lobe", bsdf.title()));
        bsdf.ignore(&["nonlinear"]);
        let eta = self.ior(bsdf, "int_ior", POLYPROPYLENE)? / self.ior(bsdf, "ext_ior", AIR)?;
        let r = (eta - 1.0) / (eta + 1.0);
        let coat = (r * r) as f32;
        let scaled = |color: ColorSource, factor: f32| match color {
            ColorSource::Constant(rgb) => ColorSource::Constant(rgb.map(|value| value * factor)),
            texture @ ColorSource::Texture(_) => texture,
        };
        let diffuse = self.color_source(bsdf, "diffuse_reflectance", 0.5)?;
        let specular = match self.color_source(bsdf, "specular_reflectance", 1.0)? {
            ColorSource::Texture(_) => white(),
            constant => constant,
        };
        // A Phong lobe of exponent 2 / alpha² - 2 is about as wide as a microfacet one of width alpha.
        let exponent = (2.0 / (alpha * alpha).max(1e-6) - 2.0).clamp(0.0, 1e6);
        Ok(MaterialKind::Phong {
            diffuse: scaled(diffuse, 1.0 - coat),
            specular: scaled(specular, coat),
            exponent: ScalarSource::Constant(exponent),
        })
    }

    /// An index of refraction: a number or one of Mitsuba's names.
    pub(super) fn ior(&self, bsdf: Element<'_>, name: &str, default: f64) -> Result<f64> {
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
}

/// Our roughness of Mitsuba's `alpha`, which is its square.
fn roughness(bsdf: Element<'_>) -> Result<f32> {
    let distribution = bsdf.string("distribution")?;
    if distribution.as_ref().is_none_or(|name| name.as_str() != "ggx") {
        let name = distribution.map_or("beckmann".to_owned(), |name| name.value);
        bsdf.warn(format!("the microfacet distribution '{name}' is replaced by 'ggx'"));
    }
    bsdf.ignore(&["sample_visible"]);
    let limits = Limits::between(0.0, 1.0);
    let alpha = match (bsdf.property("alpha_u"), bsdf.property("alpha_v")) {
        (None, None) => bsdf.float("alpha", 0.1, limits)?,
        _ => {
            bsdf.warn("anisotropic roughness is replaced by its mean");
            0.5 * (bsdf.float("alpha_u", 0.1, limits)? + bsdf.float("alpha_v", 0.1, limits)?)
        }
    };
    if bsdf.child_named("texture", "alpha")?.is_some() {
        bsdf.warn("a texture of roughness is replaced by 0.1");
    }
    Ok((alpha as f32).sqrt())
}
