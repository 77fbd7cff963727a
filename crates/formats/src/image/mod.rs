//! Image files, to linear Rec. 709 colors.

mod exr;
mod hdr;
mod jpeg;
mod pfm;
mod png;

#[cfg(test)]
mod tests;

use crate::color::linear_from_srgb;
use crate::{Result, ending};
use hyaline_scene::{ImageData, SceneError, Source};
use std::path::Path;

/// Most pixels of an image.
const MAX_PIXELS: u64 = 1 << 28;

/// Formats that can be read, by ending.
pub(crate) const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "exr", "pfm", "hdr"];

/// How the values of a file are to be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Encoding {
    /// As light.
    Linear,
    /// As sRGB.
    Srgb,
}

/// Reads the content of an image file; the ending of its name tells the format.
///
/// - `encoding`: how to take the values; by default integers are sRGB and floats linear.
///
/// # Errors
/// The format is unknown, the content damaged or empty.
pub(crate) fn read(path: &Path, bytes: &[u8], encoding: Option<Encoding>) -> Result<ImageData> {
    let source = Source::file(path.display().to_string());
    let ending = ending(path);
    let (decoded, native) = match ending.as_str() {
        "png" => (png::read(bytes), Encoding::Srgb),
        "jpg" | "jpeg" => (jpeg::read(bytes), Encoding::Srgb),
        "exr" => (exr::read(bytes), Encoding::Linear),
        "pfm" => (pfm::read(bytes), Encoding::Linear),
        "hdr" => (hdr::read(bytes), Encoding::Linear),
        _ => {
            let error = SceneError::at(&source, format!("images ending in '.{ending}' can't be read"));
            return Err(error.with_remedy(format!("the formats are .{}", ENDINGS.join(", ."))));
        }
    };
    let mut image = decoded.map_err(|message| SceneError::at(&source, message))?;
    if encoding.unwrap_or(native) == Encoding::Srgb {
        for pixel in &mut image.pixels {
            *pixel = pixel.map(linear_from_srgb);
        }
    }
    match image.pixels.iter().flatten().any(|value| !value.is_finite()) {
        true => Err(SceneError::at(&source, "the image has pixels that are not finite")),
        false => Ok(image),
    }
}

/// Whether images of this file name are of integers, which are sRGB unless told otherwise.
pub(crate) fn has_bytes(name: &str) -> bool {
    matches!(ending(Path::new(name)).as_str(), "png" | "jpg" | "jpeg")
}

/// Checks a size before anything is allocated for it.
fn check_size(width: u64, height: u64) -> std::result::Result<(u32, u32), String> {
    match (u32::try_from(width), u32::try_from(height), width.checked_mul(height)) {
        (Ok(w), Ok(h), Some(pixels)) if pixels > 0 && pixels <= MAX_PIXELS => Ok((w, h)),
        _ => Err(format!("an image of {width} x {height} pixels can't be read")),
    }
}
