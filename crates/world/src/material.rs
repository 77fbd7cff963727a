//! Finishes, ready to be evaluated at a surface point.

use crate::relief::Relief;
use crate::texture::Texture;
use hyaline_math::Vec2;
use hyaline_optics::microfacet::alpha_from_roughness;
use hyaline_scattering::Sides;
use hyaline_scattering::bsdf::{
    Black, Bsdf, CoatTable, GlossySpecular, Matte, Mirror, PassThrough, Phong, SimpleTransparent,
    ThinDielectric,
};
use hyaline_spectrum::Spectrum;

/// A color input: constant, or a texture's index.
#[derive(Clone, Copy, Debug)]
pub enum ColorInput {
    /// The same everywhere.
    Constant(Spectrum),
    /// From a texture, clamped to 0…1: it is a factor.
    Texture(u32),
}

impl ColorInput {
    /// The factor at `uv`.
    pub fn at(&self, textures: &[Texture], uv: Vec2) -> Spectrum {
        match *self {
            ColorInput::Constant(color) => color,
            ColorInput::Texture(index) => {
                let color = textures[index as usize].color(uv);
                Spectrum::from_rgb(color.map(|c| c.clamp(0.0, 1.0)))
            }
        }
    }
}

/// A number input: constant, or the luminance of a texture.
#[derive(Clone, Copy, Debug)]
pub enum ScalarInput {
    /// The same everywhere.
    Constant(f32),
    /// From a texture.
    Texture(u32),
}

impl ScalarInput {
    /// The value at `uv`.
    pub fn at(&self, textures: &[Texture], uv: Vec2) -> f32 {
        match *self {
            ScalarInput::Constant(value) => value,
            ScalarInput::Texture(index) => textures[index as usize].scalar(uv),
        }
    }
}

/// What a surface looks like from either side; finishes are chosen from it ray by ray, see `face.rs`.
#[derive(Clone, Debug)]
pub struct Material {
    /// What it is made up of.
    pub composition: Composition,
    /// Whether an opaque finish works from both sides.
    pub two_sided: bool,
    /// Index of the material of the back.
    pub back: Option<u32>,
    /// Share of the surface that is there, 0…1; the rest is holes.
    pub opacity: ScalarInput,
    /// What turns the shading normal.
    pub relief: Option<Relief>,
    /// Whether shadow rays pass straight, and light straight through comes from them alone. Polished transparent
    /// finishes only.
    pub straight_shadows: bool,
}

/// One finish or several.
#[derive(Clone, Debug)]
pub enum Composition {
    /// One finish.
    Single(Finish),
    /// Part one material, part another: indices, and the share of the second, 0…1.
    Blend(u32, u32, ScalarInput),
}

/// The kinds of finish; see `hyaline_scene::MaterialKind` for what their fields mean.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "the fields are documented in the description they mirror")]
pub enum Finish {
    Matte {
        reflectance: ColorInput,
    },
    Phong {
        diffuse: ColorInput,
        specular: ColorInput,
        exponent: ScalarInput,
    },
    PerfectSpecular {
        reflectance: ColorInput,
    },
    Conductor {
        eta: Spectrum,
        k: Spectrum,
        roughness: ScalarInput,
        tint: ColorInput,
    },
    GlossySpecular {
        reflectance: ColorInput,
        exponent: ScalarInput,
    },
    SimpleTransparent {
        k_r: f32,
        k_t: f32,
        phong: Option<(Spectrum, Spectrum, f32)>,
    },
    Dielectric {
        roughness: ScalarInput,
        reflected: ColorInput,
        transmitted: ColorInput,
    },
    ThinDielectric {
        ior: f32,
        tint: ColorInput,
    },
    Plastic {
        ior: f32,
        coats: CoatTable,
        roughness: ScalarInput,
        diffuse: ColorInput,
        specular: ColorInput,
        nonlinear: bool,
    },
    PassThrough,
    Black,
}

impl Material {
    /// A finish that is the same for every ray.
    pub fn new(finish: Finish) -> Self {
        Self {
            composition: Composition::Single(finish),
            two_sided: true,
            back: None,
            opacity: ScalarInput::Constant(1.0),
            relief: None,
            straight_shadows: false,
        }
    }

    /// The finish, where every ray finds the same one.
    pub fn only_finish(&self) -> Option<&Finish> {
        match &self.composition {
            Composition::Single(finish) if self.back.is_none() && !self.has_holes() => Some(finish),
            Composition::Single(_) | Composition::Blend(..) => None,
        }
    }

    /// Whether part of the surface may not be there.
    pub fn has_holes(&self) -> bool {
        !matches!(self.opacity, ScalarInput::Constant(opacity) if opacity >= 1.0)
    }

    /// Suffern's local term of a simple transparent surface: the highlights of lamps.
    pub fn local_term(&self) -> Option<Bsdf> {
        match self.composition {
            Composition::Single(Finish::SimpleTransparent {
                phong: Some((diffuse, specular, exponent)),
                ..
            }) => Some(Bsdf::Phong(Phong { diffuse, specular, exponent })),
            Composition::Single(_) | Composition::Blend(..) => None,
        }
    }

    /// From where an opaque finish works.
    pub fn sides(&self) -> Sides {
        if self.two_sided { Sides::Both } else { Sides::Front }
    }

    /// Whether the finish bends light between two media, and so needs them.
    pub fn needs_media(&self) -> bool {
        matches!(
            self.composition,
            Composition::Single(Finish::Dielectric { .. } | Finish::SimpleTransparent { .. })
        )
    }

    /// Whether light passes without a change of medium.
    pub fn is_thin(&self) -> bool {
        matches!(self.composition, Composition::Single(Finish::ThinDielectric { .. } | Finish::PassThrough))
    }
}

impl Finish {
    /// Fraction of light that goes straight through; `None` where the finish does more than that.
    ///
    /// - `is_matched`: whether media of the same index meet at the surface.
    pub fn straight_through(&self, textures: &[Texture], uv: Vec2, is_matched: bool) -> Option<Spectrum> {
        match self {
            Finish::PassThrough => Some(Spectrum::ONE),
            Finish::Dielectric { transmitted, .. } if is_matched => Some(transmitted.at(textures, uv)),
            Finish::Dielectric { .. }
            | Finish::SimpleTransparent { .. }
            | Finish::ThinDielectric { .. }
            | Finish::Matte { .. }
            | Finish::Phong { .. }
            | Finish::PerfectSpecular { .. }
            | Finish::Conductor { .. }
            | Finish::GlossySpecular { .. }
            | Finish::Plastic { .. }
            | Finish::Black => None,
        }
    }

    /// The finish at a point, for light that arrives in a medium of index `ior`.
    ///
    /// - `eta`: index on the far side over `ior`; 1 where no media meet.
    pub fn bsdf(&self, textures: &[Texture], uv: Vec2, ior: f32, eta: f32) -> Bsdf {
        match self {
            Finish::Matte { reflectance } => Bsdf::Matte(Matte { reflectance: reflectance.at(textures, uv) }),
            Finish::Phong { diffuse, specular, exponent } => Bsdf::Phong(Phong {
                diffuse: diffuse.at(textures, uv),
                specular: specular.at(textures, uv),
                exponent: exponent.at(textures, uv),
            }),
            Finish::PerfectSpecular { reflectance } => {
                Bsdf::Mirror(Mirror { reflectance: reflectance.at(textures, uv) })
            }
            Finish::Conductor { eta, k, roughness, tint } => {
                let alpha = alpha_from_roughness(roughness.at(textures, uv));
                Bsdf::conductor(*eta / ior, *k / ior, tint.at(textures, uv), alpha)
            }
            Finish::GlossySpecular { reflectance, exponent } => Bsdf::GlossySpecular(GlossySpecular {
                reflectance: reflectance.at(textures, uv),
                exponent: exponent.at(textures, uv),
            }),
            Finish::SimpleTransparent { k_r, k_t, .. } => {
                Bsdf::SimpleTransparent(SimpleTransparent { k_r: *k_r, k_t: *k_t, eta })
            }
            Finish::Dielectric { roughness, reflected, transmitted } => {
                let alpha = alpha_from_roughness(roughness.at(textures, uv));
                Bsdf::dielectric(eta, reflected.at(textures, uv), transmitted.at(textures, uv), alpha)
            }
            Finish::ThinDielectric { ior: pane, tint } => {
                Bsdf::ThinDielectric(ThinDielectric { eta: pane / ior, tint: tint.at(textures, uv) })
            }
            Finish::Plastic { ior, coats, roughness, diffuse, specular, nonlinear } => {
                let alpha = alpha_from_roughness(roughness.at(textures, uv));
                let (diffuse, specular) = (diffuse.at(textures, uv), specular.at(textures, uv));
                Bsdf::plastic(*ior, coats, diffuse, specular, *nonlinear, alpha)
            }
            Finish::PassThrough => Bsdf::PassThrough(PassThrough),
            Finish::Black => Bsdf::Black(Black),
        }
    }

    /// Whether light may cross.
    pub fn is_transparent(&self) -> bool {
        match self {
            Finish::Dielectric { .. }
            | Finish::ThinDielectric { .. }
            | Finish::SimpleTransparent { .. }
            | Finish::PassThrough => true,
            Finish::Matte { .. }
            | Finish::Phong { .. }
            | Finish::PerfectSpecular { .. }
            | Finish::Conductor { .. }
            | Finish::GlossySpecular { .. }
            | Finish::Plastic { .. }
            | Finish::Black => false,
        }
    }
}
