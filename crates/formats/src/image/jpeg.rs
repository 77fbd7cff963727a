//! JPEG: grey and color, baseline and progressive; decoded by integer arithmetic without SIMD, so to the same bits on
//! every machine.

use super::check_size;
use hyaline_scene::ImageData;
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

/// Reads a JPEG; values are 0…1 as encoded.
pub(super) fn read(bytes: &[u8]) -> Result<ImageData, String> {
    let describe = |error: zune_jpeg::errors::DecodeErrors| format!("not a sound JPEG: {error}");
    let options = DecoderOptions::new_safe()
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX))
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(describe)?;
    let info = decoder.info().ok_or("not a sound JPEG: it has no header")?;
    let (width, height) = check_size(u64::from(info.width), u64::from(info.height))?;
    // A block of 64 pixels takes a bit at the least: a header that claims more is not worth its memory.
    let count = width as usize * height as usize;
    if count / 1024 > bytes.len() {
        return Err("not a sound JPEG: it is too short for its size".to_owned());
    }
    let samples = decoder.decode().map_err(describe)?;
    if samples.len() != 3 * count {
        return Err("not a sound JPEG: pixels are missing".to_owned());
    }
    let pixels = samples.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]].map(|v| f32::from(v) / 255.0));
    Ok(ImageData { width, height, pixels: pixels.collect() })
}
