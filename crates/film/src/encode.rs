//! The film file, version 1, and how it is written.
//!
//! Little endian throughout: the magic bytes; the format version (u32); the header (six u32 of frame and crop, the seed,
//! the number of parts, and each part's name and value as length and UTF-8); samples dropped (u64); the number of
//! ranges of passes (u32), and first and last pass of each (u32); then for every row of the crop the fifteen planes of
//! `PLANES`, one after the other: the number of bytes per pixel (u8, at least 1, at most the plane's limit), and the
//! pixels' values in so many bytes. The width is the smallest that holds the row's largest value, so that equal films
//! are equal files. Signed values are zigzag coded: 0, -1, 1, -2, … Last the BLAKE3 hash of all the bytes before it.

use crate::film::Film;
use crate::fixed::SquareSum;
use crate::sums::{FirstObject, PixelSums};

/// First bytes of a film file; the line end shows whether a transfer took it for text.
pub(crate) const MAGIC: [u8; 8] = *b"hyaline\n";

/// Version of the format.
pub(crate) const VERSION: u32 = 1;

/// Most bytes per pixel of each plane: radiance, its squares, albedo, normal, depth, hits, object.
pub(crate) const PLANES: [u8; 15] = [16, 16, 16, 24, 24, 24, 8, 8, 8, 8, 8, 8, 16, 8, 8];

/// A value of any plane: 192 bits, lowest limb first.
pub(crate) type Word = [u64; 3];

/// The content of a film file.
pub(crate) fn encode(film: &Film) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(1024 + 100 * film.pixels.len());
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(film.header.to_bytes());
    bytes.extend(film.nonfinite.to_le_bytes());
    bytes.extend((film.passes.ranges().len() as u32).to_le_bytes());
    for (first, last) in film.passes.ranges() {
        bytes.extend(first.to_le_bytes());
        bytes.extend(last.to_le_bytes());
    }
    for row in film.pixels.chunks(film.header.crop.width() as usize) {
        (0..PLANES.len()).for_each(|plane| encode_row(row, plane, &mut bytes));
    }
    let hash = blake3::hash(&bytes);
    bytes.extend(hash.as_bytes());
    bytes
}

/// Appends one plane of a row.
fn encode_row(row: &[PixelSums], plane: usize, bytes: &mut Vec<u8>) {
    let words = row.iter().map(|pixel| pixel.word(plane));
    let union =
        words.clone().fold([0; 3], |union, word| std::array::from_fn(|limb| union[limb] | word[limb]));
    let width = significant_bytes(union);
    bytes.push(width as u8);
    for word in words {
        let limbs = word.map(u64::to_le_bytes);
        bytes.extend(&limbs.as_flattened()[..width]);
    }
}

/// Bytes that hold a word without its leading zeros, at least 1.
fn significant_bytes(word: Word) -> usize {
    let used = |limb: usize| 8 * limb + 8 - word[limb].leading_zeros() as usize / 8;
    (0..3).rev().find(|&limb| word[limb] != 0).map_or(1, used)
}

impl PixelSums {
    /// The value of a plane of `PLANES`.
    #[inline]
    fn word(&self, plane: usize) -> Word {
        match plane {
            0..3 => zigzag(self.beauty[plane]),
            3..6 => self.squares[plane - 3].0,
            6..9 => zigzag(self.albedo[plane - 6].into()),
            9..12 => zigzag(self.normal[plane - 9].into()),
            12 => zigzag(self.depth),
            13 => [self.hits, 0, 0],
            _ => [self.object.to_code(), 0, 0],
        }
    }

    /// Sets the value of a plane, the inverse of `word`; bits beyond the plane's limit are cut off.
    #[inline]
    pub(crate) fn set_word(&mut self, plane: usize, word: Word) {
        match plane {
            0..3 => self.beauty[plane] = from_zigzag(word),
            3..6 => self.squares[plane - 3] = SquareSum(word),
            6..9 => self.albedo[plane - 6] = from_zigzag(word) as i64,
            9..12 => self.normal[plane - 9] = from_zigzag(word) as i64,
            12 => self.depth = from_zigzag(word),
            13 => self.hits = word[0],
            _ => self.object = FirstObject::from_code(word[0]),
        }
    }
}

/// Small numbers of either sign as small numbers: 0, -1, 1, -2, … become 0, 1, 2, 3, …
fn zigzag(value: i128) -> Word {
    let code = (value << 1 ^ value >> 127) as u128;
    [code as u64, (code >> 64) as u64, 0]
}

fn from_zigzag(word: Word) -> i128 {
    let code = u128::from(word[1]) << 64 | u128::from(word[0]);
    (code >> 1) as i128 ^ -((code & 1) as i128)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zigzag_codes_are_small_and_reversible() {
        assert_eq!([0, -1, 1, -2].map(|v| zigzag(v)[0]), [0, 1, 2, 3]);
        for value in [0, 1, -1, 1 << 64, -(1 << 100), i128::MAX, i128::MIN, i64::MIN.into()] {
            assert_eq!(from_zigzag(zigzag(value)), value);
        }
    }

    #[test]
    fn widths_are_the_smallest_that_hold_the_value() {
        assert_eq!(significant_bytes([0, 0, 0]), 1);
        assert_eq!(significant_bytes([255, 0, 0]), 1);
        assert_eq!(significant_bytes([256, 0, 0]), 2);
        assert_eq!(significant_bytes([0, 1, 0]), 9);
        assert_eq!(significant_bytes([0, 0, u64::MAX]), 24);
    }
}
