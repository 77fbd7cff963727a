//! Textures computed from others: `scale` of versions 0.5 and 0.6, and what our finishes need in another measure.

use super::super::element::Element;
use super::super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, ImageData, Located, Rgb, Source, TextureDescription, TextureKind};
use std::sync::Arc;

impl Importer<'_> {
    /// `scale`: the texture within, times a factor.
    pub(super) fn scaled_texture(&mut self, texture: Element<'_>, depth: usize) -> Result<ColorSource> {
        let factor = texture.color("scale", Limits::between(-1e9, 1e9))?.unwrap_or([1.0; 3]);
        let scaled = |color: Rgb| std::array::from_fn(|i| color[i] * factor[i]);
        let inner = match texture.child("texture")? {
            Some(inner) => self.nested_texture(inner, depth + 1)?,
            None => ColorSource::Constant(texture.color("value", Limits::ANY)?.unwrap_or([1.0; 3])),
        };
        match inner {
            ColorSource::Constant(color) => Ok(ColorSource::Constant(scaled(color))),
            ColorSource::Texture(name) => match self.changed_texture(&name, scaled) {
                Some(changed) => Ok(self.add_texture_of(texture, changed)),
                None => Ok(ColorSource::Texture(name)),
            },
        }
    }

    /// The texture whose colors are `change` of those of `base`, made at its first use.
    pub(in super::super) fn derived_texture(
        &mut self,
        base: &Located<String>,
        purpose: &str,
        change: impl Fn(Rgb) -> Rgb,
    ) -> Located<String> {
        let name = format!("{}/{purpose}", base.value);
        if self.scene.textures.iter().any(|known| known.name == name && known.source == base.source) {
            return Located::new(name, base.source.clone());
        }
        match self.changed_texture(base, change) {
            Some(changed) => self.add_texture(TextureDescription { name, ..changed }, &base.source),
            None => base.clone(),
        }
    }

    /// Adds a texture, or finds the one that is the same; returns its name, changed where another texture has it.
    pub(in super::super) fn add_texture(
        &mut self,
        mut texture: TextureDescription,
        source: &Source,
    ) -> Located<String> {
        while let Some(known) = self.scene.textures.iter().find(|known| known.name == texture.name) {
            if known.source == *source && known.value == texture {
                break;
            }
            texture.name.push('\'');
        }
        let name = texture.name.clone();
        if !self.scene.textures.iter().any(|known| known.name == name) {
            self.scene.textures.push(Located::new(texture, source.clone()));
        }
        Located::new(name, source.clone())
    }

    /// A texture by name, with its colors changed.
    fn changed_texture(
        &self,
        name: &Located<String>,
        change: impl Fn(Rgb) -> Rgb,
    ) -> Option<TextureDescription> {
        let base = self.scene.textures.iter().find(|known| known.name == name.value)?;
        let kind = match &base.kind {
            TextureKind::Image(image) => {
                let pixels = image.pixels.iter().map(|pixel| change(*pixel)).collect();
                let (width, height) = (image.width, image.height);
                TextureKind::Image(Arc::new(ImageData { width, height, pixels }))
            }
            TextureKind::Checker { even, odd } => {
                TextureKind::Checker { even: change(*even), odd: change(*odd) }
            }
        };
        Some(TextureDescription { kind, ..base.value.clone() })
    }
}
