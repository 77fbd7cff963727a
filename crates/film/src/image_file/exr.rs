//! OpenEXR: linear f32 colors without alpha, further named channels, the crop as data window, and metadata as text
//! attributes whose names start with `hyaline.`.

use super::ImageError;
use crate::image::{Image, Samples};
use crate::rect::Rect;
use ::exr::image as exr_image;
use ::exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Layer};
use ::exr::math::Vec2;
use ::exr::meta::MetaData;
use ::exr::meta::attribute::{AttributeValue, Chromaticities, IntegerBounds, LineOrder, Text};
use ::exr::meta::header::{ImageAttributes, LayerAttributes};
use ::exr::prelude::{Compression, ReadChannels, ReadLayers, WritableImage, read};
use std::io::Cursor;

/// More pixels per byte than any compression reaches; a file that claims more is damaged.
const MAX_PIXELS_PER_BYTE: usize = 1024;

type FlatLayer = Layer<AnyChannels<FlatSamples>>;

/// The content of an EXR file: one part, 16 rows a block, ZIP.
pub(super) fn encode(image: &Image) -> Result<Vec<u8>, ImageError> {
    let window = image.window;
    let mut attributes = LayerAttributes { layer_position: position(window), ..LayerAttributes::default() };
    let texts =
        image.metadata.iter().map(|(name, value)| (attribute_name(name), AttributeValue::Text(text(value))));
    attributes.other = texts.collect();
    let encoding = Encoding {
        compression: Compression::ZIP16,
        line_order: LineOrder::Increasing,
        ..Encoding::FAST_LOSSLESS
    };
    let size = Vec2(window.width() as usize, window.height() as usize);
    let layer = Layer::new(size, attributes, encoding, AnyChannels::sort(channels(image).collect()));
    let display = IntegerBounds::new(Vec2(0, 0), Vec2(image.width as usize, image.height as usize));
    let shared = ImageAttributes { chromaticities: Some(REC_709), ..ImageAttributes::new(display) };
    let mut bytes = Vec::new();
    exr_image::Image::new(shared, layer).write().to_buffered(Cursor::new(&mut bytes)).map_err(failed)?;
    sort_attributes(&mut bytes)
        .ok_or_else(|| ImageError::Content("the EXR header is not as expected".to_owned()))?;
    Ok(bytes)
}

/// The colors of an EXR file: the channels R, G and B (half or float) of its first layer that has them, or else Y as
/// gray.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, ImageError> {
    check_size(bytes)?;
    let file = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(failed)?;
    let colors = file.layer_data.iter().find_map(|layer: &FlatLayer| Some((layer, layer_colors(layer)?)));
    let (layer, rgb) = colors
        .ok_or_else(|| ImageError::Content("the EXR file has no channels R, G and B, nor Y".to_owned()))?;
    let display = file.attributes.display_window;
    // The window counted from the corner of the full frame, where it lies inside; else the frame is the window.
    let offset = layer.attributes.layer_position - display.position;
    let size = Vec2(layer.size.0 as i64, layer.size.1 as i64);
    let fits = |start: i32, size: i64, all: usize| start >= 0 && i64::from(start) + size <= all as i64;
    if fits(offset.0, size.0, display.size.0) && fits(offset.1, size.1, display.size.1) {
        let (x0, y0) = (offset.0 as u32, offset.1 as u32);
        let window = Rect { x0, y0, x1: x0 + size.0 as u32, y1: y0 + size.1 as u32 };
        let (width, height) = (display.size.0 as u32, display.size.1 as u32);
        return Ok(Image { width, height, window, rgb, channels: Vec::new(), metadata: Vec::new() });
    }
    Ok(Image::new(size.0 as u32, size.1 as u32, rgb))
}

/// Primaries and white point of Rec. 709.
const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.3, 0.6),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.329),
};

fn channels(image: &Image) -> impl Iterator<Item = AnyChannel<FlatSamples>> {
    let color = |(i, name): (usize, &str)| {
        AnyChannel::new(text(name), FlatSamples::F32(image.rgb.iter().map(|rgb| rgb[i]).collect()))
    };
    let colors = ["R", "G", "B"].into_iter().enumerate().map(color);
    let others = image.channels.iter().map(|channel| {
        let samples = match &channel.samples {
            Samples::F32(values) => FlatSamples::F32(values.clone()),
            Samples::U32(values) => FlatSamples::U32(values.clone()),
        };
        AnyChannel::new(text(&channel.name), samples)
    });
    let all: Vec<_> = colors.chain(others).collect();
    all.into_iter()
}

fn layer_colors(layer: &FlatLayer) -> Option<Vec<[f32; 3]>> {
    let find = |name: &str| {
        let channel = layer.channel_data.list.iter().find(|channel| channel.name.eq(name))?;
        // A subsampled channel holds fewer numbers than there are pixels.
        (channel.sample_data.len() == layer.size.area()).then(|| channel.sample_data.values_as_f32())
    };
    match (find("R"), find("G"), find("B")) {
        (Some(r), Some(g), Some(b)) => Some(r.zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect()),
        _ => Some(find("Y")?.map(|y| [y; 3]).collect()),
    }
}

/// That the pixels which the header promises can be in a file of this length.
fn check_size(bytes: &[u8]) -> Result<(), ImageError> {
    let meta = MetaData::read_from_buffered(bytes, false).map_err(failed)?;
    let area = |size: Vec2<usize>| size.0.saturating_mul(size.1);
    let pixels = meta.headers.iter().map(|header| area(header.layer_size)).fold(0, usize::saturating_add);
    if pixels > bytes.len().saturating_mul(MAX_PIXELS_PER_BYTE) {
        return Err(ImageError::Content("the EXR file is too short for its size".to_owned()));
    }
    Ok(())
}

/// Brings the header's attributes into the order of their names: the library keeps them in a hash map, and the same
/// picture shall be the same file. The header keeps its length, so no offset changes.
fn sort_attributes(bytes: &mut [u8]) -> Option<()> {
    const START: usize = 8; // Magic number and version.
    let mut attributes: Vec<Vec<u8>> = Vec::new();
    let mut at = START;
    while *bytes.get(at)? != 0 {
        let rest = &bytes[at..];
        let name = rest.iter().position(|&byte| byte == 0)? + 1;
        let kind = rest[name..].iter().position(|&byte| byte == 0)? + 1;
        let (size, _) = rest[name + kind..].split_first_chunk()?;
        let length = name + kind + 4 + u32::from_le_bytes(*size) as usize;
        attributes.push(rest.get(..length)?.to_vec());
        at += length;
    }
    attributes.sort_unstable();
    bytes[START..at].copy_from_slice(&attributes.concat());
    Some(())
}

/// Name of a text in the file; the plain name may be an attribute of the standard, as `version` is.
fn attribute_name(name: &str) -> Text {
    text(&format!("hyaline.{name}"))
}

fn position(window: Rect) -> Vec2<i32> {
    Vec2(window.x0 as i32, window.y0 as i32)
}

/// Text as UTF-8, which is what OpenEXR's strings hold.
fn text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

fn failed(error: ::exr::error::Error) -> ImageError {
    ImageError::Content(format!("EXR: {error}"))
}

#[cfg(test)]
mod tests;
