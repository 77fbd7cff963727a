//! `bumpmap` and `normalmap`.
//!
//! A normal map is a texture within (0.5, 0.6 and 3), or a `filename` of its own (the research branch of specular
//! manifold sampling, Zeltner et al. 2020). The latter's `use_slopes`, on by default, makes slopes of the normals
//! *before* they are interpolated; the file holds normals all the same.

use super::super::element::Element;
use super::super::importer::Importer;
use super::{Nesting, Surface};
use crate::Result;
use crate::image::Encoding;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, Located, Relief, Rgb, TextureDescription, TextureKind};

/// Steepest slope that a normal may mean; steeper ones lie in the surface.
const STEEPEST: f32 = 1000.0;

impl Importer<'_> {
    /// Heights, whose gradient turns the normal.
    pub(super) fn bump_map(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let mut surface = self.wrapped(bsdf, nesting)?;
        let scale = bsdf.float("scale", 1.0, Limits::between(-1e9, 1e9))? as f32;
        let Some(texture) = bsdf.child("texture")? else {
            return Err(bsdf.error(format!("{} has no texture within", bsdf.title())));
        };
        // Heights that are the same everywhere turn nothing.
        if let ColorSource::Texture(height) = self.texture(texture)? {
            set_relief(bsdf, &mut surface, Relief::Bump { height, scale });
        }
        Ok(surface)
    }

    /// Normals in the frame of the surface.
    pub(super) fn normal_map(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let mut surface = self.wrapped(bsdf, nesting)?;
        bsdf.ignore(&["use_shadowing_function", "flip_invalid_normals"]);
        if bsdf.property("filename").is_some() {
            if let Some(relief) = self.relief_of_file(bsdf)? {
                set_relief(bsdf, &mut surface, relief);
            }
            return Ok(surface);
        }
        let Some(texture) = bsdf.child("texture")? else {
            return Err(bsdf.error(format!("{} has no texture within", bsdf.title())));
        };
        if let ColorSource::Texture(normals) = self.texture(texture)? {
            if texture.kind() == "bitmap" && self.is_decoded(texture)? {
                let message = "a normal map is taken as sRGB, as the file says";
                texture.warn(format!("{message}; it hardly means that: set `raw` to true"));
            }
            set_relief(bsdf, &mut surface, Relief::Normals { texture: normals });
        }
        Ok(surface)
    }

    /// The relief of a normal map that names its own file.
    fn relief_of_file(&mut self, bsdf: Element<'_>) -> Result<Option<Relief>> {
        let use_slopes = bsdf.boolean("use_slopes", true)?;
        let tiles = bsdf.float("tiles", 1.0, Limits::POSITIVE)? as f32;
        let Some(image) = self.image(bsdf, Some(Encoding::Linear))? else { return Ok(None) };
        let mut image = image.as_ref().clone();
        if use_slopes {
            image.pixels.iter_mut().for_each(|pixel| *pixel = slopes(*pixel));
        }
        let name = bsdf.id().map_or("normalmap".to_owned(), |id| format!("{id}/normalmap"));
        let texture = TextureDescription {
            uv_transform: [[tiles, 0.0, 0.0], [0.0, -tiles, 1.0]],
            ..TextureDescription::new(name, TextureKind::Image(image.into()))
        };
        let texture: Located<String> = self.add_texture(texture, bsdf.source());
        Ok(Some(match use_slopes {
            true => Relief::Slopes { texture, scale: 1.0 },
            false => Relief::Normals { texture },
        }))
    }
}

/// Slopes along u and v of the surface whose encoded normal this is.
fn slopes(encoded: Rgb) -> Rgb {
    let [x, y, z] = encoded.map(|value| 2.0 * value - 1.0);
    let slope = |along: f32| (-along / z.max(1e-6)).clamp(-STEEPEST, STEEPEST);
    [slope(x), slope(y), 0.0]
}

fn set_relief(bsdf: Element<'_>, surface: &mut Surface, relief: Relief) {
    match surface.material.relief {
        None => surface.material.relief = Some(relief),
        Some(_) => bsdf.warn("of bump and normal maps within each other only the inner one counts"),
    }
}
