//! Textures, and what takes a constant or a texture.

mod bitmap;
mod derived;

#[cfg(test)]
mod tests;

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use crate::own::IDENTITY_UV;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{ColorSource, Located, Rgb, ScalarSource, TextureDescription, TextureKind};

/// Most textures within each other.
const MAX_DEPTH: usize = 16;
/// What stands for a texture that can't be read.
const GREY: ColorSource = ColorSource::Constant([0.5; 3]);

/// Luminance of a linear Rec. 709 color (ITU-R BT.709-6, §3.2).
pub(super) fn luminance([r, g, b]: Rgb) -> f32 {
    if r == g && g == b { r } else { 0.2126 * r + 0.7152 * g + 0.0722 * b }
}

impl Importer<'_> {
    /// A reflectance: a constant or a texture by name.
    pub(super) fn color_source(
        &mut self,
        owner: Element<'_>,
        name: &str,
        default: f32,
    ) -> Result<ColorSource> {
        if let Some(color) = owner.color(name, Limits::NOT_NEGATIVE)? {
            if color.iter().any(|value| *value > 1.0) {
                owner.warn(format!("`{name}` of {} is above 1 and cut to 1", owner.title()));
            }
            return Ok(ColorSource::Constant(color.map(|value| value.min(1.0))));
        }
        match owner.child_named("texture", name)? {
            Some(texture) => self.texture(texture),
            None => Ok(ColorSource::Constant([default; 3])),
        }
    }

    /// A share or width, 0…1: a constant, or the luminance of a texture.
    pub(super) fn scalar_source(
        &mut self,
        owner: Element<'_>,
        name: &str,
        default: f32,
    ) -> Result<ScalarSource> {
        match self.color_source(owner, name, default)? {
            ColorSource::Constant(color) => Ok(ScalarSource::Constant(luminance(color))),
            ColorSource::Texture(texture) => Ok(ScalarSource::Texture(texture)),
        }
    }

    /// A number of any size from a texture: its luminance.
    pub(super) fn scalar_texture(&mut self, texture: Element<'_>) -> Result<ScalarSource> {
        match self.texture(texture)? {
            ColorSource::Constant(color) => Ok(ScalarSource::Constant(luminance(color))),
            ColorSource::Texture(texture) => Ok(ScalarSource::Texture(texture)),
        }
    }

    /// Reads a texture once; what can't be read becomes grey.
    pub(super) fn texture(&mut self, texture: Element<'_>) -> Result<ColorSource> {
        self.nested_texture(texture, 0)
    }

    fn nested_texture(&mut self, texture: Element<'_>, depth: usize) -> Result<ColorSource> {
        if depth > MAX_DEPTH {
            let message = format!("more than {MAX_DEPTH} textures within each other, or one within itself");
            return Err(texture.error(message));
        }
        let source = texture.source();
        if let Some(known) = self.scene.textures.iter().find(|known| known.source == *source) {
            return Ok(ColorSource::Texture(Located::new(known.name.clone(), source.clone())));
        }
        match texture.kind() {
            "bitmap" => self.bitmap_texture(texture),
            "checkerboard" => self.checkerboard(texture),
            "scale" => self.scaled_texture(texture, depth),
            "uniform" | "constant" | "srgb" | "rgb" => constant(texture),
            _ => {
                texture.ignore_all();
                texture.warn(format!("{} can't be read and is replaced by grey", texture.title()));
                Ok(GREY)
            }
        }
    }

    fn checkerboard(&mut self, texture: Element<'_>) -> Result<ColorSource> {
        let color = |name: &str, default: f32| {
            if let Some(color) = texture.color(name, Limits::NOT_NEGATIVE)? {
                return Ok(color);
            }
            if texture.child_named("texture", name)?.is_some() {
                texture.warn(format!("`{name}` of a checkerboard can't be a texture and keeps its default"));
            }
            Ok([default; 3])
        };
        let kind = TextureKind::Checker { even: color("color0", 0.4)?, odd: color("color1", 0.2)? };
        let uv_transform = uv_transform(texture, false)?;
        Ok(self.add_texture_of(
            texture,
            TextureDescription { uv_transform, ..TextureDescription::new("", kind) },
        ))
    }

    /// Adds the texture of an element, named by its id or a number.
    fn add_texture_of(&mut self, element: Element<'_>, texture: TextureDescription) -> ColorSource {
        let number = || format!("texture-{}", self.scene.textures.len() + 1);
        let name = element.id().map_or_else(number, str::to_owned);
        ColorSource::Texture(self.add_texture(TextureDescription { name, ..texture }, element.source()))
    }
}

/// A spectrum that is the same everywhere: `value` or `color`.
fn constant(texture: Element<'_>) -> Result<ColorSource> {
    let limits = Limits::NOT_NEGATIVE;
    let color = match texture.color("value", limits)? {
        Some(color) => Some(color),
        None => texture.color("color", limits)?,
    };
    Ok(ColorSource::Constant(color.unwrap_or([1.0; 3])))
}

/// `to_uv`, or scales and offsets; Mitsuba's bitmaps have v pointing down from the first row, ours up from the last.
fn uv_transform(texture: Element<'_>, rows_go_down: bool) -> Result<[[f32; 3]; 2]> {
    let mut to_uv = texture.transform("to_uv")?;
    let number = |name: &str, default: f64| texture.float(name, default, Limits::between(-1e6, 1e6));
    let factors = DVec3::new(number("uscale", 1.0)?, number("vscale", 1.0)?, 1.0);
    let scale = Transform::scale(factors).ok_or_else(|| texture.error("a texture's scale is 0"))?;
    let offset = Transform::translate(DVec3::new(number("uoffset", 0.0)?, number("voffset", 0.0)?, 0.0));
    to_uv = offset.after(&scale).after(&to_uv);
    if rows_go_down {
        let flip = Transform::scale(DVec3::new(1.0, -1.0, 1.0)).unwrap_or_default();
        to_uv = Transform::translate(DVec3::Y).after(&flip).after(&to_uv);
    }
    let (u, v, origin) = (to_uv.vector(DVec3::X), to_uv.vector(DVec3::Y), to_uv.point(DVec3::ZERO));
    let rows = [[u.x as f32, v.x as f32, origin.x as f32], [u.y as f32, v.y as f32, origin.y as f32]];
    match rows.iter().flatten().all(|value| value.is_finite()) {
        true if rows == IDENTITY_UV => Ok(IDENTITY_UV),
        true => Ok(rows),
        false => Err(texture.error("a texture's transform leaves the range of numbers")),
    }
}
