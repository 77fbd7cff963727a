//! PFM: portable float maps, color (`PF`) and grey (`Pf`), rows from the bottom.

use super::check_size;
use hyaline_scene::ImageData;

/// Reads a PFM.
pub(super) fn read(bytes: &[u8]) -> Result<ImageData, String> {
    let mut offset = 0;
    let mut word = || -> Option<&str> {
        let start = offset + bytes[offset..].iter().position(|byte| !byte.is_ascii_whitespace())?;
        let length = bytes[start..].iter().position(u8::is_ascii_whitespace)?;
        // One white space ends the header; the numbers follow at once.
        offset = start + length + 1;
        std::str::from_utf8(&bytes[start..start + length]).ok()
    };
    let channels = match word() {
        Some("PF") => 3,
        Some("Pf") => 1,
        _ => return Err("not a PFM: it must begin with PF or Pf".to_owned()),
    };
    let mut number = |what: &str| {
        word()
            .and_then(|text| text.parse::<f64>().ok())
            .ok_or_else(|| format!("not a PFM: no {what} in its header"))
    };
    let (width, height, scale) = (number("width")?, number("height")?, number("scale")?);
    let (width, height) = check_size(width as u64, height as u64)?;
    let (row, count) = (width as usize * channels * 4, height as usize);
    let body = &bytes[offset.min(bytes.len())..];
    if body.len() < row * count {
        return Err(format!("the PFM ends after {} of {} bytes of pixels", body.len(), row * count));
    }
    let decode = |value: &[u8]| {
        let value = [value[0], value[1], value[2], value[3]];
        if scale < 0.0 { f32::from_le_bytes(value) } else { f32::from_be_bytes(value) }
    };
    let mut pixels = Vec::with_capacity(width as usize * count);
    for row in body[..row * count].chunks_exact(row).rev() {
        for pixel in row.chunks_exact(4 * channels) {
            let first = decode(pixel);
            let is_grey = channels == 1;
            pixels.push(if is_grey { [first; 3] } else { [first, decode(&pixel[4..]), decode(&pixel[8..])] });
        }
    }
    Ok(ImageData { width, height, pixels })
}
