//! `[film]`: the picture's size, crop, pixel filter and exposure.
//!
//! `size = [640, 480]` or `width` and `height`; `crop = [x0, y0, x1, y1]` from the top left, ends exclusive;
//! `filter` = "box", "tent", "gaussian", or a table with `kind` and `radius` (and `sigma`), pixels; `exposure`.

use super::field::Field;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{FilmDescription, PixelFilter};

/// Largest width and height, pixels.
pub(crate) const MAX_SIDE: u32 = 65_536;
/// Most pixels of a picture.
pub(crate) const MAX_PIXELS: u64 = 1 << 28;
/// Radius of a tent that nobody sized, pixels.
pub(crate) const TENT_RADIUS: f32 = 1.0;
/// Standard deviation and cut-off of a bell that nobody sized, pixels.
const GAUSSIAN: (f32, f32) = (0.5, 1.5);

/// Changes `film` to what the table says.
pub(super) fn read(mut table: Table<'_>, film: &mut FilmDescription) -> Result<()> {
    let side = |field: Field<'_>| field.integer(1, i64::from(MAX_SIDE)).map(|side| side as u32);
    let size = table.take("size");
    let (width, height) = (table.take("width"), table.take("height"));
    if let Some(size) = size {
        if let Some(other) = width.or(height) {
            return Err(other.error(format!("`{}` and `size` exclude each other; keep one", other.key)));
        }
        [film.width, film.height] = size.array(side)?;
    }
    film.width = width.map_or(Ok(film.width), side)?;
    film.height = height.map_or(Ok(film.height), side)?;
    if let Some(field) = size.or(width).or(height)
        && u64::from(film.width) * u64::from(film.height) > MAX_PIXELS
    {
        return Err(field.error(format!("a film of {} x {} pixels is too large", film.width, film.height)));
    }
    match (table.take("crop"), film.crop, size.or(width).or(height)) {
        (Some(field), _, _) => film.crop = Some(crop(field, film)?),
        (None, Some([_, _, x1, y1]), Some(field)) if x1 > film.width || y1 > film.height => {
            let error = field.error("the film's crop lies outside of the new size");
            return Err(error.with_remedy("set film.crop too"));
        }
        _ => {}
    }
    film.filter = table.read("filter", film.filter, filter)?;
    film.exposure = table.read("exposure", film.exposure, |field| field.number_f32(Limits::POSITIVE))?;
    table.finish()
}

fn crop(field: Field<'_>, film: &FilmDescription) -> Result<[u32; 4]> {
    let [x0, y0, x1, y1] = field.array(|item| item.count(0))?;
    if x0 < x1 && y0 < y1 && x1 <= film.width && y1 <= film.height {
        return Ok([x0, y0, x1, y1]);
    }
    let message = format!("`crop` must be [x0, y0, x1, y1] within the {} x {} film", film.width, film.height);
    Err(field.error(message).with_remedy("x1 and y1 are exclusive and above x0 and y0"))
}

fn filter(field: Field<'_>) -> Result<PixelFilter> {
    let (sigma, radius) = GAUSSIAN;
    let kinds = [
        ("box", PixelFilter::Box),
        ("tent", PixelFilter::Tent(TENT_RADIUS)),
        ("gaussian", PixelFilter::Gaussian { sigma, radius }),
    ];
    if field.string().is_ok() {
        return field.choice(&kinds);
    }
    let mut table = field.table("filter")?;
    let kind = table.require("kind", "\"gaussian\"")?.choice(&kinds)?;
    let pixels = |field: Field<'_>| field.number_f32(Limits::above_to(0.0, 16.0));
    let filter = match kind {
        PixelFilter::Box => PixelFilter::Box,
        PixelFilter::Tent(radius) => PixelFilter::Tent(table.read("radius", radius, pixels)?),
        PixelFilter::Gaussian { sigma, .. } => {
            let sigma = table.read("sigma", sigma, pixels)?;
            PixelFilter::Gaussian { sigma, radius: table.read("radius", 3.0 * sigma, pixels)? }
        }
    };
    table.finish()?;
    Ok(filter)
}
