//! Colors and numbers that may come from a texture: a table in their place.

use super::document::Value;
use super::field::Field;
use super::scene::Reader;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, Located, ScalarSource};

impl Reader<'_> {
    /// A color within limits, or a texture.
    pub(super) fn color_source(&mut self, field: Field<'_>, limits: Limits) -> Result<ColorSource> {
        Ok(match self.texture_reference(field)? {
            Some(texture) => ColorSource::Texture(texture),
            None => ColorSource::Constant(field.color(limits)?),
        })
    }

    /// A number within limits, or a texture.
    pub(super) fn scalar_source(&mut self, field: Field<'_>, limits: Limits) -> Result<ScalarSource> {
        Ok(match self.texture_reference(field)? {
            Some(texture) => ScalarSource::Texture(texture),
            None => ScalarSource::Constant(field.number_f32(limits)?),
        })
    }

    fn texture_reference(&mut self, field: Field<'_>) -> Result<Option<Located<String>>> {
        if !matches!(field.node.value, Value::Table(_)) {
            return Ok(None);
        }
        self.inline_texture(field).map(Some)
    }
}
