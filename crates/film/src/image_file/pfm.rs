//! Portable float map: a text header, then rows of f32 triples from the bottom up.
//!
//! Source: Debevec's PFM, <https://www.pauldebevec.com/Research/HDR/PFM/>.

use super::ImageError;
use crate::image::Image;

/// The content of a PFM file; it knows no window, so a crop has its own size.
pub(super) fn encode(image: &Image) -> Vec<u8> {
    let (width, height) = (image.window.width(), image.window.height());
    // A negative scale says little endian.
    let mut bytes = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    for row in image.rgb.chunks(width.max(1) as usize).rev() {
        row.as_flattened().iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    }
    bytes
}

/// The picture of a PFM file, colored (`PF`) or gray (`Pf`), of either byte order.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, ImageError> {
    let mut rest = bytes;
    let channels = match next_word(&mut rest) {
        Some("PF") => 3,
        Some("Pf") => 1,
        _ => return Err(damaged("this is not a PFM file")),
    };
    let width: u32 = next_number(&mut rest)?;
    let height: u32 = next_number(&mut rest)?;
    let scale: f32 = next_number(&mut rest)?;
    let row_bytes = u64::from(width) * channels * 4;
    if row_bytes == 0 || row_bytes.checked_mul(height.into()) != Some(rest.len() as u64) {
        return Err(damaged("the PFM file's size does not fit its header"));
    }
    let read = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let (values, _) = rest.as_chunks::<4>();
    let values: Vec<f32> = values.iter().map(|&bytes| read(bytes)).collect();
    let rows = values.chunks((width as usize) * channels as usize).rev().flatten().copied();
    let rgb = if channels == 3 {
        let values: Vec<f32> = rows.collect();
        values.as_chunks::<3>().0.to_vec()
    } else {
        rows.map(|value| [value; 3]).collect()
    };
    Ok(Image::new(width, height, rgb))
}

fn next_number<T: std::str::FromStr>(rest: &mut &[u8]) -> Result<T, ImageError> {
    let number = next_word(rest).and_then(|word| word.parse().ok());
    number.ok_or_else(|| damaged("the PFM file's header is damaged"))
}

/// The next word, and the one space or line end behind it, are taken from `rest`.
fn next_word<'a>(rest: &mut &'a [u8]) -> Option<&'a str> {
    let end = rest.iter().take(32).position(u8::is_ascii_whitespace)?;
    let word = std::str::from_utf8(&rest[..end]).ok()?;
    *rest = &rest[end + 1..];
    Some(word)
}

fn damaged(text: &str) -> ImageError {
    ImageError::Content(text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_go_from_the_bottom_up() {
        let image = Image::new(1, 2, vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        let bytes = encode(&image);
        assert!(bytes.starts_with(b"PF\n1 2\n-1.0\n"));
        assert_eq!(bytes[12..16], 4.0_f32.to_le_bytes());
        assert_eq!(decode(&bytes).expect("read"), image);
    }

    #[test]
    fn gray_and_big_endian_files_are_read() {
        let mut bytes = b"Pf 2 1 1.0\n".to_vec();
        bytes.extend([0.5_f32.to_be_bytes(), 2.0_f32.to_be_bytes()].as_flattened());
        assert_eq!(decode(&bytes).expect("read").rgb, [[0.5; 3], [2.0; 3]]);
    }

    #[test]
    fn damaged_files_are_refused() {
        let bytes = encode(&Image::new(3, 2, vec![[1.0; 3]; 6]));
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length]).is_err());
        }
        for header in [
            "PF\n0 0\n-1\n",
            "PF\n4294967295 4294967295\n-1\n",
            "PF\n-1 1\n-1\n",
            "P6\n1 1\n255\n",
            "PF\n1 x\n-1\n",
        ] {
            assert!(decode(header.as_bytes()).is_err(), "{header}");
        }
    }
}
