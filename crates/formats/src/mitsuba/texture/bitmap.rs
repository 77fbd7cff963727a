//! `bitmap`: an image file with how its values, edges and the places between its pixels are taken.

use super::super::element::Element;
use super::super::importer::Importer;
use super::{GREY, uv_transform};
use crate::image::{ENDINGS, Encoding};
use crate::limits::Limits;
use crate::{Result, ending};
use hyaline_math::float;
use hyaline_scene::{ColorSource, ImageData, TextureDescription, TextureFilter, TextureKind, Wrap};
use std::path::Path;
use std::sync::Arc;

/// What says nothing about the picture: how it is stored, cached and filtered while it is far away.
const WITHOUT_EFFECT: [&str; 4] = ["format", "cache", "accel", "max_anisotropy"];

impl Importer<'_> {
    /// The texture of an image file; grey, with a warning, where that can't be used.
    pub(super) fn bitmap_texture(&mut self, texture: Element<'_>) -> Result<ColorSource> {
        let (wrap, filter) = (wrap(texture)?, filter(texture)?);
        let Some(image) = self.bitmap(texture)? else { return Ok(GREY) };
        let image = one_channel(texture, image)?;
        let uv_transform = uv_transform(texture, true)?;
        let kind = TextureKind::Image(image);
        let description =
            TextureDescription { uv_transform, wrap, filter, ..TextureDescription::new("", kind) };
        Ok(self.add_texture_of(texture, description))
    }

    /// The image of a bitmap or environment; `None`, with a warning, where it is absent or of a foreign format.
    pub(in super::super) fn bitmap(&self, element: Element<'_>) -> Result<Option<Arc<ImageData>>> {
        element.ignore(&["filter_type", "wrap_mode"]);
        element.ignore(&WITHOUT_EFFECT);
        let gamma = gamma(element)?;
        let encoding = match gamma {
            Gamma::OfFile => None,
            Gamma::Power(_) => Some(Encoding::Linear),
        };
        let image = self.image(element, encoding)?;
        Ok(match (image, gamma) {
            (Some(image), Gamma::Power(power)) if power != 1.0 => {
                let mut image = ImageData::clone(&image);
                let decoded = |value: f32| float::powf(value.max(0.0), power);
                image.pixels.iter_mut().for_each(|pixel| *pixel = pixel.map(decoded));
                Some(Arc::new(image))
            }
            (image, _) => image,
        })
    }

    /// The image that an element names, with its values taken as told.
    pub(in super::super) fn image(
        &self,
        element: Element<'_>,
        encoding: Option<Encoding>,
    ) -> Result<Option<Arc<ImageData>>> {
        let Some(name) = element.string("filename")? else {
            return Err(element.error(format!("{} needs `filename`", element.title())));
        };
        let path = self.assets.path(&name);
        let reason = match ending(Path::new(name.as_str())) {
            ending if !ENDINGS.contains(&ending.as_str()) => {
                format!("images ending in '.{ending}' can't be read")
            }
            _ if !path.exists() => "there is no such file".to_owned(),
            _ => return self.assets.image(&name.source, &name, encoding).map(Some),
        };
        element.ignore_all();
        element.notes.warn(&name.source, format!("the image '{}' is replaced by grey: {reason}", name.value));
        Ok(None)
    }

    /// Whether the numbers of a bitmap are not those of its file, but decoded from sRGB.
    pub(in super::super) fn is_decoded(&self, texture: Element<'_>) -> Result<bool> {
        let name = texture.string("filename")?;
        let has_bytes = name.is_some_and(|name| crate::image::has_bytes(&name));
        Ok(has_bytes && gamma(texture)? != Gamma::Power(1.0))
    }
}

/// How values of a file become light.
#[derive(Clone, Copy, PartialEq)]
enum Gamma {
    /// As its format implies.
    OfFile,
    /// By a power.
    Power(f32),
}

/// `raw` of versions 2 and 3, `gamma` of 0.5 and 0.6, where -1 stands for what the file implies.
fn gamma(element: Element<'_>) -> Result<Gamma> {
    if element.boolean("raw", false)? {
        return Ok(Gamma::Power(1.0));
    }
    let gamma = element.float("gamma", -1.0, Limits::between(-1.0, 100.0))? as f32;
    Ok(if gamma > 0.0 { Gamma::Power(gamma) } else { Gamma::OfFile })
}

/// `wrap_mode`, or one for each direction in versions 0.5 and 0.6.
fn wrap(texture: Element<'_>) -> Result<Wrap> {
    let (u, v) = (texture.string("wrap_mode_u")?, texture.string("wrap_mode_v")?);
    if let (Some(u), Some(v)) = (&u, &v)
        && u.value != v.value
    {
        texture.notes.warn(&v.source, "`wrap_mode_v` other than `wrap_mode_u` is not supported and ignored");
    }
    let Some(mode) = texture.string("wrap_mode")?.or(u).or(v) else { return Ok(Wrap::Repeat) };
    match mode.as_str() {
        "repeat" => Ok(Wrap::Repeat),
        "mirror" => Ok(Wrap::Mirror),
        "clamp" => Ok(Wrap::Clamp),
        other => {
            texture.notes.warn(&mode.source, format!("the wrap mode '{other}' is replaced by 'clamp'"));
            Ok(Wrap::Clamp)
        }
    }
}

/// `filter_type`: those that average over pixels far away are bilinear, as the samples of a pixel average by themselves.
fn filter(texture: Element<'_>) -> Result<TextureFilter> {
    let Some(filter) = texture.string("filter_type")? else { return Ok(TextureFilter::Bilinear) };
    match filter.as_str() {
        "nearest" => Ok(TextureFilter::Nearest),
        "bilinear" | "trilinear" | "ewa" => Ok(TextureFilter::Bilinear),
        other => {
            texture.notes.warn(&filter.source, format!("the filter '{other}' is replaced by 'bilinear'"));
            Ok(TextureFilter::Bilinear)
        }
    }
}

/// `channel` of versions 0.5 and 0.6: one of the colors as a grey.
fn one_channel(texture: Element<'_>, image: Arc<ImageData>) -> Result<Arc<ImageData>> {
    let Some(channel) = texture.string("channel")? else { return Ok(image) };
    let index = match channel.as_str() {
        "r" => 0,
        "g" => 1,
        "b" => 2,
        other => {
            texture.notes.warn(&channel.source, format!("the channel '{other}' of an image is not read"));
            return Ok(image);
        }
    };
    let mut image = ImageData::clone(&image);
    image.pixels.iter_mut().for_each(|pixel| *pixel = [pixel[index]; 3]);
    Ok(Arc::new(image))
}
