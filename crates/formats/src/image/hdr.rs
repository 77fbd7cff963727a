//! Radiance HDR: shared-exponent colors, plain or run-length encoded, rows from the top.
//!
//! Source: Ward, Real Pixels, Graphics Gems II, 1991, §II.5.

use super::check_size;
use hyaline_scene::{ImageData, Rgb};

/// Reads a Radiance picture in the usual orientation (`-Y height +X width`).
pub(super) fn read(bytes: &[u8]) -> Result<ImageData, String> {
    if !bytes.starts_with(b"#?") {
        return Err("not a Radiance HDR image: it must begin with #?".to_owned());
    }
    let mut cursor = Cursor { bytes, offset: 0 };
    let mut is_rgbe = true;
    loop {
        let line = cursor.line()?;
        if line.is_empty() {
            break;
        }
        if let Some(format) = line.strip_prefix("FORMAT=") {
            is_rgbe = format.trim() == "32-bit_rle_rgbe";
        }
    }
    if !is_rgbe {
        return Err("a Radiance image in another format than 32-bit_rle_rgbe can't be read".to_owned());
    }
    let line = cursor.line()?;
    let size = match line.split_ascii_whitespace().collect::<Vec<_>>().as_slice() {
        ["-Y", height, "+X", width] => width.parse().ok().zip(height.parse().ok()),
        _ => None,
    };
    let (width, height) = size.ok_or_else(|| format!("a Radiance image of size '{line}' can't be read"))?;
    let (width, height) = check_size(width, height)?;
    // A run of at most 127 bytes takes two.
    if u64::from(width) * u64::from(height) * 4 / 64 > bytes.len() as u64 {
        return Err("the HDR image is too short for its size".to_owned());
    }
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    let mut row = vec![[0u8; 4]; width as usize];
    for _ in 0..height {
        cursor.row(&mut row)?;
        pixels.extend(row.iter().map(|rgbe| color(*rgbe)));
    }
    Ok(ImageData { width, height, pixels })
}

fn color([r, g, b, exponent]: [u8; 4]) -> Rgb {
    if exponent == 0 {
        return [0.0; 3];
    }
    let scale = 2f64.powi(i32::from(exponent) - (128 + 8));
    [r, g, b].map(|mantissa| (f64::from(mantissa) * scale) as f32)
}

struct Cursor<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl<'a> Cursor<'a> {
    fn line(&mut self) -> Result<&'a str, String> {
        let rest = &self.bytes[self.offset..];
        let length =
            rest.iter().take(4096).position(|byte| *byte == b'\n').ok_or("the HDR header has no end")?;
        self.offset += length + 1;
        std::str::from_utf8(&rest[..length])
            .map(str::trim_end)
            .map_err(|_| "not a text in an HDR header".to_owned())
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let taken = self.bytes[self.offset..].first_chunk().copied();
        self.offset += N;
        taken.ok_or_else(|| "the HDR image ends before its last pixel".to_owned())
    }

    fn row(&mut self, row: &mut [[u8; 4]]) -> Result<(), String> {
        let start = self.offset;
        let is_packed = matches!(self.take()?, [2, 2, high, low]
            if high < 128 && usize::from(high) * 256 + usize::from(low) == row.len());
        if !is_packed {
            self.offset = start;
            return row.iter_mut().try_for_each(|pixel| {
                *pixel = self.take()?;
                Ok(())
            });
        }
        for channel in 0..4 {
            let mut x = 0;
            while x < row.len() {
                let [count] = self.take()?;
                let (count, run) = if count > 128 { (count - 128, true) } else { (count, false) };
                let end = x + usize::from(count);
                if count == 0 || end > row.len() {
                    return Err("a run of the HDR image is longer than its row".to_owned());
                }
                let [mut value] = self.take()?;
                for (i, pixel) in row[x..end].iter_mut().enumerate() {
                    if i > 0 && !run {
                        [value] = self.take()?;
                    }
                    pixel[channel] = value;
                }
                x = end;
            }
        }
        Ok(())
    }
}
