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
    /// Material of the back of an opaque finish, by name; `None` leaves it to `two_sided`.
    pub back: Option<Located<String>>,
    /// Share of the surface that is there, 0…1; through the rest light goes straight, as through holes.
    pub opacity: ScalarSource,
    /// Small-scale form that turns the shading normal.
    pub relief: Option<Relief>,
    /// The architect's glass: shadow rays pass a transparent finish straight, dimmed by Fresnel's equations and the
    /// media; light straight through it then comes from shadow rays only. Biased; off by default.
    pub straight_shadows: bool,
}

impl MaterialDescription {
    /// A material of this kind without relief, holes or a back of its own.
    pub fn new(name: impl Into<String>, kind: MaterialKind) -> Self {
        Self {
            name: name.into(),
            kind,
            two_sided: true,
            back: None,
            opacity: ScalarSource::Constant(1.0),
            relief: None,
            straight_shadows: false,
        }
    }
}

/// Small-scale form that turns the shading normal and nothing else.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Relief {
    /// Heights above the surface.
    Bump {
        /// Texture whose luminance is the height.
        height: Located<String>,
        /// Factor on the heights, scene units.
        scale: f32,
    },
    /// Normals in the frame of the surface's parameters: 0…1 in the texture are -1…1 along u, v and outward.
    Normals {
        /// The texture, read as plain numbers.
        texture: Located<String>,
    },
    /// Slopes of the surface along u and v in the first two channels: the normal is (-s_u, -s_v, 1), normalized.
    Slopes {
        /// The texture, read as plain numbers.
        texture: Located<String>,
        /// Factor on the slopes.
        scale: f32,
    },
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
    /// A matte base under a clear coat, smooth or rough (GGX): plastic, varnish, glazed clay.
    Plastic {
        /// Reflectance of the base, 0…1.
        diffuse: ColorSource,
        /// Factor on the light that the coat reflects, 0…1; 1 is physical.
        specular: ColorSource,
        /// Index of the coat relative to its surroundings, > 0.
        ior: f32,
        /// Roughness of the coat, 0…1; 0 is polished.
        roughness: ScalarSource,
        /// Whether light that the base sends back and forth below the coat takes its color each time.
        nonlinear: bool,
    },
    /// Part one finish, part another, mixed too finely to see.
    Blend {
        /// Name of the first material.
        first: Located<String>,
        /// Name of the second.
        second: Located<String>,
        /// Share of the second, 0…1.
        weight: ScalarSource,
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
