//! `[textures.NAME]`: colors that vary over a surface.
//!
//! `kind = "image"` with `file` and `encoding` ("srgb" or "linear"; by default what the kind of file implies), or
//! `kind = "checker"` with `even` and `odd` colors. An image also has `wrap` ("repeat", "mirror" or "clamp"), what lies
//! beyond its edges, and `filter` ("bilinear" or "nearest"), what lies between its pixels. `scale` (a number or a pair) says how often the texture fits into
//! one unit of u and v, `degrees` turns it, `offset` moves it, in this order.
//! In the place of a color, `{ checker = [even, odd], .. }` and `{ image = "FILE", .. }` say the same more briefly.

use super::field::Field;
use super::scene::Reader;
use super::table::Table;
use crate::Result;
use crate::image::Encoding;
use crate::limits::Limits;
use hyaline_math::float;
use hyaline_scene::{Located, TextureDescription, TextureFilter, TextureKind, Wrap};

/// Texture coordinates unchanged.
pub(crate) const IDENTITY_UV: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

impl Reader<'_> {
    /// Reads an entry of `[textures]`.
    pub(super) fn texture_entry(&mut self, mut table: Table<'_>, name: Located<String>) -> Result<()> {
        let kind = table.require("kind", "\"image\"")?;
        let texture = match kind.string()? {
            "image" => {
                let file = table.require("file", "\"wood.png\"")?;
                self.image_texture(&mut table, file, None)?
            }
            "checker" => {
                let color = |field: Field<'_>| field.color(Limits::NOT_NEGATIVE);
                let (even, odd) = (table.read("even", [0.8; 3], color)?, table.read("odd", [0.2; 3], color)?);
                TextureDescription::new("", TextureKind::Checker { even, odd })
            }
            _ => return Err(kind.no_such_choice(&["image", "checker"])),
        };
        let uv_transform = uv_transform(&mut table)?;
        table.finish()?;
        let texture = TextureDescription { name: name.value, uv_transform, ..texture };
        self.scene.textures.push(Located::new(texture, name.source));
        Ok(())
    }

    /// What stands in the place of a color as a table: a reference, a checkerboard or an image.
    pub(super) fn inline_texture(&mut self, field: Field<'_>) -> Result<Located<String>> {
        let mut table = field.table(format!("`{}`", field.key))?;
        let name = self.texture_of_table(&mut table, field, None)?;
        table.finish()?;
        Ok(name)
    }

    /// The texture that a table describes, which may have further keys; `native` overrides what the kind of an image's
    /// file implies.
    pub(super) fn texture_of_table(
        &mut self,
        table: &mut Table<'_>,
        field: Field<'_>,
        native: Option<Encoding>,
    ) -> Result<Located<String>> {
        let Some(form) = table.take_one(&["texture", "checker", "image"])? else {
            let error =
                field.error(format!("`{}` as a table needs `texture`, `checker` or `image`", field.key));
            return Err(error.with_remedy("a plain color is [r, g, b], \"#rrggbb\" or a number"));
        };
        let texture = match form.key {
            "texture" => return form.name(),
            "checker" => {
                let [even, odd] = form.array(|color| color.color(Limits::FRACTION))?;
                TextureDescription::new("", TextureKind::Checker { even, odd })
            }
            _ => self.image_texture(table, form, native)?,
        };
        let uv_transform = uv_transform(table)?;
        let mut name = format!("{}-{}", form.key, self.scene.textures.len() + 1);
        while self.scene.textures.iter().any(|texture| texture.name == name) {
            name.push('\'');
        }
        let name = Located::new(name, field.source().clone());
        let texture = TextureDescription { name: name.value.clone(), uv_transform, ..texture };
        self.scene.textures.push(Located::new(texture, name.source.clone()));
        Ok(name)
    }

    /// An image with how it is read, without name and layout.
    fn image_texture(
        &self,
        table: &mut Table<'_>,
        file: Field<'_>,
        native: Option<Encoding>,
    ) -> Result<TextureDescription> {
        let encoding = table.read_some("encoding", encoding)?.or(native);
        let wraps = [("repeat", Wrap::Repeat), ("mirror", Wrap::Mirror), ("clamp", Wrap::Clamp)];
        let filters = [("bilinear", TextureFilter::Bilinear), ("nearest", TextureFilter::Nearest)];
        let wrap = table.read("wrap", Wrap::default(), |field| field.choice(&wraps))?;
        let filter = table.read("filter", TextureFilter::default(), |field| field.choice(&filters))?;
        let image = self.assets.image(file.source(), file.string()?, encoding)?;
        Ok(TextureDescription { wrap, filter, ..TextureDescription::new("", TextureKind::Image(image)) })
    }
}

/// How the values of an image file are to be taken.
pub(super) fn encoding(field: Field<'_>) -> Result<Encoding> {
    field.choice(&[("srgb", Encoding::Srgb), ("linear", Encoding::Linear)])
}

fn uv_transform(table: &mut Table<'_>) -> Result<[[f32; 3]; 2]> {
    let limits = Limits::between(-1e6, 1e6);
    let number = |item: Field<'_>| item.number_f32(limits);
    let [scale_u, scale_v] = table.read("scale", [1.0; 2], |field| match field.items() {
        Ok(_) => field.array(number),
        Err(_) => number(field).map(|scale| [scale; 2]),
    })?;
    let angle = table.read("degrees", 0.0, |field| field.angle(limits))?;
    let [offset_u, offset_v] = table.read("offset", [0.0; 2], |field| field.array(number))?;
    if (scale_u, scale_v, angle, offset_u, offset_v) == (1.0, 1.0, 0.0, 0.0, 0.0) {
        return Ok(IDENTITY_UV);
    }
    let (sin, cos) = float::f64::sin_cos(angle);
    let (sin, cos) = (sin as f32, cos as f32);
    Ok([[cos * scale_u, -sin * scale_v, offset_u], [sin * scale_u, cos * scale_v, offset_v]])
}
