//! Textures: bitmaps and checkerboards.

use super::element::Element;
use super::importer::Importer;
use crate::image::{ENDINGS, Encoding};
use crate::limits::Limits;
use crate::own::IDENTITY_UV;
use crate::{Result, ending};
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{ColorSource, ImageData, Located, TextureDescription, TextureKind};
use std::path::Path;
use std::sync::Arc;

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

    /// Reads a texture once; what can't be read becomes grey.
    pub(super) fn texture(&mut self, texture: Element<'_>) -> Result<ColorSource> {
        let source = texture.source();
        if let Some(known) = self.scene.textures.iter().find(|known| known.source == *source) {
            return Ok(ColorSource::Texture(Located::new(known.name.clone(), source.clone())));
        }
        let number = format!("texture-{}", self.scene.textures.len() + 1);
        let mut name = texture.id().map_or(number, str::to_owned);
        while self.scene.textures.iter().any(|known| known.name == name) {
            name.push('\'');
        }
        let grey = Ok(ColorSource::Constant([0.5; 3]));
        let (kind, rows_go_down) = match texture.kind() {
            "bitmap" => match self.bitmap(texture)? {
                Some(image) => (TextureKind::Image(image), true),
                None => return grey,
            },
            "checkerboard" => {
                let color = |name: &str, default: f32| {
                    texture.color(name, Limits::NOT_NEGATIVE).map(|color| color.unwrap_or([default; 3]))
                };
                (TextureKind::Checker { even: color("color0", 0.4)?, odd: color("color1", 0.2)? }, false)
            }
            _ => {
                texture.ignore_all();
                texture.warn(format!("{} can't be read and is replaced by grey", texture.title()));
                return grey;
            }
        };
        let uv_transform = uv_transform(texture, rows_go_down)?;
        let description = TextureDescription { uv_transform, ..TextureDescription::new(name.clone(), kind) };
        self.scene.textures.push(Located::new(description, source.clone()));
        Ok(ColorSource::Texture(Located::new(name, source.clone())))
    }

    /// The image of a bitmap or environment; `None`, with a warning, where it is absent or of a foreign format.
    pub(super) fn bitmap(&self, element: Element<'_>) -> Result<Option<Arc<ImageData>>> {
        element.ignore(&["filter_type", "wrap_mode", "format", "cache"]);
        let raw = element.boolean("raw", false)?;
        let Some(name) = element.string("filename")? else {
            return Err(element.error(format!("{} needs `filename`", element.title())));
        };
        let path = self.assets.path(&name);
        let reason = match ending(Path::new(name.as_str())) {
            ending if !ENDINGS.contains(&ending.as_str()) => {
                format!("images ending in '.{ending}' can't be read")
            }
            _ if !path.exists() => "there is no such file".to_owned(),
            _ => {
                let encoding = raw.then_some(Encoding::Linear);
                return self.assets.image(&name.source, &name, encoding).map(Some);
            }
        };
        element.ignore_all();
        element.notes.warn(&name.source, format!("the image '{}' is replaced by grey: {reason}", name.value));
        Ok(None)
    }
}

/// `to_uv`; Mitsuba's bitmaps have v pointing down from the first row, ours up from the last.
fn uv_transform(texture: Element<'_>, rows_go_down: bool) -> Result<[[f32; 3]; 2]> {
    let mut to_uv = texture.transform("to_uv")?;
    for (factor, axis) in [("uscale", DVec3::X), ("vscale", DVec3::Y)] {
        let factor = texture.float(factor, 1.0, Limits::ANY)?;
        let scale = Transform::scale(DVec3::ONE + (factor - 1.0) * axis);
        to_uv = scale.ok_or_else(|| texture.error("a texture's scale is 0"))?.after(&to_uv);
    }
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
