//! How a film file is read: whatever the bytes are, the result is a film or an error.

use crate::encode::{MAGIC, PLANES, VERSION};
use crate::error::FilmError;
use crate::film::Film;
use crate::header::{DigestPart, FilmHeader};
use crate::pass_set::PassSet;
use crate::rect::Rect;
use crate::sums::PixelSums;

/// The film that `bytes` hold.
pub(crate) fn decode(bytes: &[u8]) -> Result<Film, FilmError> {
    let mut reader = Reader { rest: checked_content(bytes)? };
    let header = read_header(&mut reader)?;
    header.check().map_err(|_| FilmError::Damaged("the frame is impossible"))?;
    let nonfinite = reader.u64()?;
    let passes = read_passes(&mut reader)?;
    let pixels = read_pixels(&mut reader, header.crop)?;
    if !reader.rest.is_empty() {
        return Err(FilmError::Damaged("there is more in it than its pixels"));
    }
    Ok(Film { header, passes, nonfinite, pixels })
}

/// What lies between the version and the hash, if all three are right.
fn checked_content(bytes: &[u8]) -> Result<&[u8], FilmError> {
    let after_magic = bytes.strip_prefix(&MAGIC).ok_or(FilmError::NotAFilm)?;
    let (version, _) = after_magic.split_first_chunk().ok_or(TRUNCATED)?;
    let version = u32::from_le_bytes(*version);
    if version != VERSION {
        return Err(FilmError::Version(version));
    }
    let (hashed, hash) = bytes.split_last_chunk::<32>().ok_or(TRUNCATED)?;
    if blake3::hash(hashed) != *hash {
        return Err(FilmError::Damaged("its checksum is wrong; it was cut short or changed"));
    }
    hashed.get(MAGIC.len() + 4..).ok_or(TRUNCATED)
}

fn read_header(reader: &mut Reader<'_>) -> Result<FilmHeader, FilmError> {
    let [width, height] = [reader.u32()?, reader.u32()?];
    let [x0, y0, x1, y1] = [reader.u32()?, reader.u32()?, reader.u32()?, reader.u32()?];
    let seed = reader.u64()?;
    // Not collected with a capacity: the number is only as good as the file.
    let mut parts = Vec::new();
    for _ in 0..reader.u32()? {
        parts.push(DigestPart { name: reader.text()?, value: reader.text()? });
    }
    Ok(FilmHeader { width, height, crop: Rect { x0, y0, x1, y1 }, seed, parts })
}

fn read_passes(reader: &mut Reader<'_>) -> Result<PassSet, FilmError> {
    let mut ranges = Vec::new();
    for _ in 0..reader.u32()? {
        ranges.push((reader.u32()?, reader.u32()?));
    }
    PassSet::from_ranges(ranges).ok_or(FilmError::Damaged("its passes are out of order"))
}

fn read_pixels(reader: &mut Reader<'_>, crop: Rect) -> Result<Vec<PixelSums>, FilmError> {
    // Each value takes at least a byte, so a short file can't ask for much memory.
    if reader.rest.len() / PLANES.len() < crop.area() {
        return Err(FilmError::Damaged("it has too few pixels"));
    }
    let mut pixels = vec![PixelSums::default(); crop.area()];
    for row in pixels.chunks_mut(crop.width() as usize) {
        for plane in 0..PLANES.len() {
            read_row(reader, row, plane)?;
        }
    }
    Ok(pixels)
}

fn read_row(reader: &mut Reader<'_>, row: &mut [PixelSums], plane: usize) -> Result<(), FilmError> {
    let [width] = reader.array()?;
    if !(1..=PLANES[plane]).contains(&width) {
        return Err(FilmError::Damaged("a value is too wide"));
    }
    let width = usize::from(width);
    let values = reader.take(row.len() * width)?;
    for (pixel, value) in row.iter_mut().zip(values.chunks_exact(width)) {
        let mut limbs = [[0; 8]; 3];
        limbs.as_flattened_mut()[..width].copy_from_slice(value);
        pixel.set_word(plane, limbs.map(u64::from_le_bytes));
    }
    Ok(())
}

const TRUNCATED: FilmError = FilmError::Damaged("it ends too early");

/// What is left to read.
struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], FilmError> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or(TRUNCATED)?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], FilmError> {
        let (taken, rest) = self.rest.split_first_chunk().ok_or(TRUNCATED)?;
        self.rest = rest;
        Ok(*taken)
    }

    fn u32(&mut self) -> Result<u32, FilmError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    fn u64(&mut self) -> Result<u64, FilmError> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    fn text(&mut self) -> Result<String, FilmError> {
        let length = self.u32()? as usize;
        let bytes = self.take(length)?.to_vec();
        String::from_utf8(bytes).map_err(|_| FilmError::Damaged("a text in it is not UTF-8"))
    }
}
