//! PNG: grey, color and palette, 1 to 16 bits; alpha is dropped.

use super::check_size;
use hyaline_scene::ImageData;
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::io::Cursor;

/// Reads a PNG; values are 0…1 as encoded.
pub(super) fn read(bytes: &[u8]) -> Result<ImageData, String> {
    let describe = |error: png::DecodingError| format!("not a sound PNG: {error}");
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 1 << 30 });
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(describe)?;
    let (width, height) = check_size(u64::from(reader.info().width), u64::from(reader.info().height))?;
    // A PNG is packed at most about 1032 times: a header that claims more is not worth its memory.
    if reader.output_buffer_size().is_none_or(|size| size / 1200 > bytes.len()) {
        return Err("not a sound PNG: it is too short for its size".to_owned());
    }
    let mut buffer = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut buffer).map_err(describe)?;
    let samples: Vec<f32> = match frame.bit_depth {
        BitDepth::Sixteen => {
            let pairs = buffer.chunks_exact(2);
            pairs.map(|pair| f32::from(u16::from_be_bytes([pair[0], pair[1]])) / 65535.0).collect()
        }
        _ => buffer.iter().map(|byte| f32::from(*byte) / 255.0).collect(),
    };
    let channels = frame.color_type.samples();
    let is_grey = matches!(frame.color_type, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let color = |pixel: &[f32]| if is_grey { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] };
    let count = width as usize * height as usize;
    let pixels: Vec<_> = samples.chunks_exact(channels).take(count).map(color).collect();
    if pixels.len() < count || (!is_grey && channels < 3) {
        return Err("not a sound PNG: pixels are missing".to_owned());
    }
    Ok(ImageData { width, height, pixels })
}
