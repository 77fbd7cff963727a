//! `bump`, `normals` and `slopes`: small-scale form that turns the shading normal.
//!
//! - `bump = { image = "waves.png", height = "2 mm" }`: heights; white lies `height` above black.
//! - `normals = { image = "weave.png" }`: normals, 0…1 for -1…1 along u, v and outward.
//! - `slopes = { image = "waves.exr", factor = 1 }`: slopes along u and v in the first two channels.
//!
//! Each takes the keys of a texture in the place of a color, or `{ texture = "NAME" }`. Their images are plain numbers
//! unless `encoding` says "srgb"; a named texture has an `encoding` of its own, which should say "linear".

use super::field::Field;
use super::scene::Reader;
use super::table::Table;
use crate::Result;
use crate::image::Encoding;
use crate::limits::Limits;
use hyaline_scene::Relief;

impl Reader<'_> {
    /// The relief of a material, if it has one.
    pub(super) fn relief(&mut self, table: &mut Table<'_>) -> Result<Option<Relief>> {
        let Some(field) = table.take_one(&["bump", "normals", "slopes"])? else { return Ok(None) };
        let mut table = field.table(format!("`{}`", field.key))?;
        let texture = self.texture_of_table(&mut table, field, Some(Encoding::Linear))?;
        let relief = match field.key {
            "bump" => Relief::Bump { height: texture, scale: self.height(&mut table)? },
            "normals" => Relief::Normals { texture },
            _ => {
                let limits = Limits::between(-1e6, 1e6);
                Relief::Slopes {
                    texture,
                    scale: table.read("factor", 1.0, |field| field.number_f32(limits))?,
                }
            }
        };
        table.finish()?;
        Ok(Some(relief))
    }

    /// Height of white over black, scene units; below 0 white is low.
    fn height(&self, table: &mut Table<'_>) -> Result<f32> {
        let field: Field<'_> = table.require("height", "\"1 mm\"")?;
        Ok(field.length(self.metres, Limits::ANY)? as f32)
    }
}
