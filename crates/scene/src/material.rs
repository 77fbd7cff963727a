//! Finishes of boundaries. What a body is made of is its medium, not its material.

use crate::{Located, Rgb};
use serde::Serialize;

/// The finish of a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MaterialDescription {
    /// Name that objects refer to.
    pub name: String,
    /// What it is.
    pub kind: MaterialKind,
    /// Whether an opaque finish works from both sides; if not, the back is black.
    pub two_sided: bool,
}

/// The kinds of finish.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum MaterialKind {
    /// Lambert's law.
    Matte {
        /// Diffuse reflectance, 0…1.
        reflectance: ColorSource,
    },
    /// Lambert plus a Phong lobe about the mirror direction.
    Phong {
        /// Diffuse reflectance, 0…1.
        diffuse: ColorSource,
        /// Reflectance of the lobe, 0…1.
        specular: ColorSource,
        /// Exponent of the lobe, ≥ 0.
        exponent: ScalarSource,
    },
    /// A perfect mirror of constant reflectance.
    PerfectSpecular {
        /// Reflectance, 0…1.
        reflectance: ColorSource,
    },
    /// A metal, smooth or rough (GGX).
    Conductor {
        /// Its indices.
        metal: Metal,
        /// Roughness 0…1; 0 is a mirror.
        roughness: ScalarSource,
        /// Factor on the reflected light, 0…1.
        tint: ColorSource,
    },
    /// Suffern's glossy reflector: a Phong lobe about the mirror direction and nothing else.
    GlossySpecular {
        /// Reflectance of the lobe, 0…1.
        reflectance: ColorSource,
        /// Exponent of the lobe, ≥ 0.
        exponent: ScalarSource,
    },
    /// Suffern ch. 27: constant fractions are reflected and transmitted; the index is that of the media.
    SimpleTransparent {
        /// Constant fraction reflected, 0…1.
        k_r: f32,
        /// Constant fraction transmitted, 0…1.
        k_t: f32,
        /// Local term for highlights of lights, in `whitted` only: diffuse, specular, exponent.
        phong: Option<(Rgb, Rgb, f32)>,
    },
    /// A boundary of two clear media under Fresnel's equations, smooth or rough (GGX).
    Dielectric {
        /// Roughness 0…1; 0 is polished.
        roughness: ScalarSource,
        /// Factors on reflected and transmitted light, 0…1; 1 is physical.
        tint: (ColorSource, ColorSource),
    },
    /// A pane too thin to bend or to measure: all its inner reflections at once.
    ThinDielectric {
        /// Index of refraction, relative to its surroundings.
        ior: f32,
        /// Factor on the transmitted light, 0…1.
        tint: ColorSource,
    },
    /// Nothing: light goes straight through. Bounds a medium without refraction where indices agree.
    PassThrough,
    /// Black; what emitters without another finish have.
    Black,
}

/// Which metal.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Metal {
    /// From the catalogue: gold, silver, copper, aluminium, ...
    Named(Located<String>),
    /// Index and extinction, per linear Rec. 709 channel.
    Indices {
        /// Index of refraction.
        eta: Rgb,
        /// Extinction index.
        k: Rgb,
    },
}

/// A color, constant or from a texture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum ColorSource {
    /// The same everywhere.
    Constant(Rgb),
    /// From the texture of that name.
    Texture(Located<String>),
}

/// A number, constant or from a texture (its luminance).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum ScalarSource {
    /// The same everywhere.
    Constant(f32),
    /// From the texture of that name.
    Texture(Located<String>),
}
