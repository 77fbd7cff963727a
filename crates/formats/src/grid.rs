//! Numbers on a regular grid from files: Mitsuba's `.vol`, and bare little-endian `f32`.
//!
//! A `.vol` file: `VOL`, the version (3), the encoding (1: `f32`, 2: `f16`, 3: bytes for 0…1), cells along x, y, z,
//! channels, a box (six `f32`), then the values: channels together, then x, then y, then z. All of it little-endian.
//! Source: documentation of `gridvolume` in Mitsuba 0.6 and 3.

use hyaline_math::DVec3;
use hyaline_scene::GridData;
use std::sync::Arc;

/// Bytes before the values of a `.vol` file.
const HEADER: usize = 48;
/// Most values of a grid.
const MAX_VALUES: u64 = 1 << 31;

/// A grid with the box that its file gives it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BoxedGrid {
    /// The values.
    pub(crate) data: Arc<GridData>,
    /// Lowest and highest corner as the file has them: not checked.
    pub(crate) bounds: [DVec3; 2],
}

/// Reads a `.vol` file.
///
/// # Errors
/// What is wrong with it, in words.
pub(crate) fn read_vol(bytes: &[u8]) -> Result<BoxedGrid, String> {
    if bytes.len() < HEADER || &bytes[..3] != b"VOL" {
        return Err("not a volume file: it must begin with 'VOL'".to_owned());
    }
    if bytes[3] != 3 {
        return Err(format!("version {} of the volume format can't be read, only 3", bytes[3]));
    }
    let word = |at: usize| <[u8; 4]>::try_from(&bytes[at..at + 4]).unwrap_or_default();
    let whole = |at: usize| u32::from_le_bytes(word(at));
    let size = [whole(8), whole(12), whole(16)];
    let channels = whole(20);
    let corner =
        |at: usize| DVec3::from_array([0, 4, 8].map(|i| f64::from(f32::from_le_bytes(word(at + i)))));
    let values = decode(&bytes[HEADER..], whole(4), count(size, channels)?)?;
    let data = GridData { size, channels, values };
    check(&data)?;
    Ok(BoxedGrid { data: Arc::new(data), bounds: [corner(24), corner(36)] })
}

/// Reads bare little-endian `f32` values.
///
/// - `size`, `channels`: as of [`GridData`].
///
/// # Errors
/// Another number of values than that, values that are not finite.
pub(crate) fn read_raw(bytes: &[u8], size: [u32; 3], channels: u32) -> Result<GridData, String> {
    let values = decode(bytes, 1, count(size, channels)?)?;
    let data = GridData { size, channels, values };
    check(&data)?;
    Ok(data)
}

/// Number of values of a grid.
fn count(size: [u32; 3], channels: u32) -> Result<usize, String> {
    let [x, y, z] = size;
    if !matches!(channels, 1 | 3) {
        return Err(format!("a grid of {channels} channels can't be read, only 1 or 3"));
    }
    let factors = [x, y, z, channels].map(u64::from);
    let count = factors.iter().try_fold(1u64, |product, factor| product.checked_mul(*factor));
    match count {
        Some(count @ 1..=MAX_VALUES) => Ok(count as usize),
        _ => Err(format!("a grid of {x} x {y} x {z} cells can't be read")),
    }
}

/// Values in an encoding; their number is checked against that of the bytes before anything is allocated.
fn decode(bytes: &[u8], encoding: u32, count: usize) -> Result<Vec<f32>, String> {
    let width = match encoding {
        1 => 4,
        2 => 2,
        3 => 1,
        4 => return Err("a grid of directions can't be read".to_owned()),
        other => return Err(format!("the encoding {other} of the volume format is not known")),
    };
    if bytes.len() != count * width {
        let found = bytes.len();
        return Err(format!(
            "{count} values of {width} bytes are {} bytes, but there are {found}",
            count * width
        ));
    }
    Ok(match encoding {
        1 => bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect(),
        2 => bytes.chunks_exact(2).map(|b| from_half(u16::from_le_bytes([b[0], b[1]]))).collect(),
        _ => bytes.iter().map(|byte| f32::from(*byte) / 255.0).collect(),
    })
}

/// A half-precision number. Source: IEEE 754-2008, §3.4.
fn from_half(bits: u16) -> f32 {
    let sign = u32::from(bits >> 15) << 31;
    let (exponent, fraction) = (u32::from(bits >> 10) & 31, u32::from(bits) & 1023);
    match (exponent, fraction) {
        // Multiples of 2⁻²⁴, which `f32` holds exactly.
        (0, _) => f32::from_bits(sign | (fraction as f32 * f32::from_bits(103 << 23)).to_bits()),
        (31, 0) => f32::from_bits(sign | 0x7f80_0000),
        (31, _) => f32::NAN,
        _ => f32::from_bits(sign | (exponent + 112) << 23 | fraction << 13),
    }
}

/// Every value must be finite and at least 0.
fn check(data: &GridData) -> Result<(), String> {
    let is_wrong = |value: &f32| !(value.is_finite() && *value >= 0.0);
    let Some(index) = data.values.iter().position(is_wrong) else { return Ok(()) };
    let cell = index / data.channels as usize;
    let [nx, ny] = [data.size[0] as usize, data.size[1] as usize];
    let (x, y, z) = (cell % nx, cell / nx % ny, cell / (nx * ny));
    let value = data.values[index];
    Err(format!("the grid has {value} in the cell ({x}, {y}, {z}); values must be finite and 0 or more"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of the given encoding; `values` are its bytes.
    fn vol(encoding: u32, size: [u32; 3], channels: u32, values: &[u8]) -> Vec<u8> {
        let mut bytes = b"VOL\x03".to_vec();
        bytes.extend([encoding, size[0], size[1], size[2], channels].iter().flat_map(|n| n.to_le_bytes()));
        bytes.extend([-1f32, -2.0, -3.0, 1.0, 2.0, 3.0].iter().flat_map(|n| n.to_le_bytes()));
        bytes.extend(values);
        bytes
    }

    fn floats(values: &[f32]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_le_bytes()).collect()
    }

    #[test]
    fn every_encoding_is_read() {
        let grid = read_vol(&vol(1, [2, 1, 1], 3, &floats(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.5]))).unwrap();
        assert_eq!((grid.data.size, grid.data.channels), ([2, 1, 1], 3));
        assert_eq!(grid.data.values, [0.0, 1.0, 2.0, 3.0, 4.0, 5.5]);
        assert_eq!(grid.bounds, [DVec3::new(-1.0, -2.0, -3.0), DVec3::new(1.0, 2.0, 3.0)]);
        let bytes = read_vol(&vol(3, [1, 2, 1], 1, &[255, 51])).unwrap();
        assert_eq!(bytes.data.values, [1.0, 0.2]);
        // 1, 65504, the smallest above 0, a third.
        let halves =
            [0x3c00u16, 0x7bff, 1, 0x3555].iter().flat_map(|half| half.to_le_bytes()).collect::<Vec<_>>();
        let halves = read_vol(&vol(2, [1, 1, 4], 1, &halves)).unwrap();
        assert_eq!(halves.data.values, [1.0, 65504.0, 1.0 / 16_777_216.0, 0.333_251_95]);
    }

    #[test]
    fn damaged_grids_are_refused_in_words() {
        let sound = floats(&[1.0, 2.0]);
        for (bytes, message) in [
            (b"VOX\x03".to_vec(), "begin with 'VOL'"),
            (vol(1, [2, 1, 1], 1, &sound)[..40].to_vec(), "begin with 'VOL'"),
            (vol(1, [3, 1, 1], 1, &sound), "are 12 bytes, but there are 8"),
            (vol(1, [1, 1, 1], 2, &sound), "2 channels"),
            (vol(4, [2, 1, 1], 1, &sound), "directions"),
            (vol(9, [2, 1, 1], 1, &sound), "encoding 9"),
            (vol(1, [0, 1, 1], 1, &[]), "0 x 1 x 1"),
            (vol(1, [u32::MAX; 3], 3, &sound), "can't be read"),
            (vol(1, [1, 2, 1], 1, &floats(&[1.0, f32::NAN])), "NaN in the cell (0, 1, 0)"),
            (vol(1, [2, 1, 1], 1, &floats(&[-1.0, 0.0])), "-1 in the cell (0, 0, 0)"),
        ] {
            let error = read_vol(&bytes).unwrap_err();
            assert!(error.contains(message), "{error}");
        }
        let mut other = vol(1, [2, 1, 1], 1, &sound);
        other[3] = 4;
        assert!(read_vol(&other).unwrap_err().contains("version 4"));
        assert!(read_raw(&sound, [1, 1, 1], 1).unwrap_err().contains("are 4 bytes"));
        assert_eq!(read_raw(&sound, [1, 2, 1], 1).unwrap().values, [1.0, 2.0]);
    }
}
