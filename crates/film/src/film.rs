//! The accumulator: exact sums of the passes that have been made of one picture.

use crate::error::FilmError;
use crate::header::FilmHeader;
use crate::pass_set::PassSet;
use crate::rect::Rect;
use crate::sample::PixelSample;
use crate::sums::PixelSums;
use rayon::prelude::*;
use std::path::Path;

/// The sum of a set of passes.
///
/// Equal headers and equal passes give equal films, byte for byte, however the passes were grouped and merged. A pass
/// is added by `add_tile` for tiles that cover the crop, each pixel once, then `finish_pass`; a film to which only part
/// of a pass has been added must not be kept, so collect the pass first if it may be interrupted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    pub(crate) header: FilmHeader,
    pub(crate) passes: PassSet,
    pub(crate) nonfinite: u64,
    /// Row by row over the crop.
    pub(crate) pixels: Vec<PixelSums>,
}

impl Film {
    /// A film without passes.
    ///
    /// # Errors
    /// As `FilmHeader::check`.
    pub fn new(header: FilmHeader) -> Result<Self, FilmError> {
        header.check()?;
        let count = header.crop.area();
        let mut pixels = Vec::new();
        if pixels.try_reserve_exact(count).is_err() {
            return Err(FilmError::Frame("there is not enough memory for a picture of this size"));
        }
        pixels.resize(count, PixelSums::default());
        Ok(Self { header, passes: PassSet::new(), nonfinite: 0, pixels })
    }

    /// What the film is a picture of.
    pub fn header(&self) -> &FilmHeader {
        &self.header
    }

    /// The passes that have been added.
    pub fn passes(&self) -> &PassSet {
        &self.passes
    }

    /// Samples that were dropped because a number in them was not finite.
    pub fn nonfinite(&self) -> u64 {
        self.nonfinite
    }

    /// Adds part of a pass.
    ///
    /// - `tile`: inside the crop, in pixels of the full frame.
    /// - `samples`: row by row over the tile.
    ///
    /// Rows are added in parallel, on rayon's current threads.
    /// A sample with a NaN or an infinity anywhere counts as black, hitting nothing, and in `nonfinite`.
    ///
    /// # Panics
    /// If the tile is not inside the crop, or the number of samples is not its number of pixels.
    pub fn add_tile(&mut self, pass: u32, tile: Rect, samples: &[PixelSample]) {
        let crop = self.header.crop;
        let inside = crop.x0 <= tile.x0 && tile.x1 <= crop.x1 && crop.y0 <= tile.y0 && tile.y1 <= crop.y1;
        assert!(inside && samples.len() == tile.area(), "{} samples for {tile:?} of {crop:?}", samples.len());
        let (tile_width, crop_width) = (tile.width() as usize, crop.width() as usize);
        if tile_width == 0 {
            return;
        }
        let start = (tile.x0 - crop.x0) as usize;
        let first = (tile.y0 - crop.y0) as usize;
        let rows = self.pixels.par_chunks_mut(crop_width).skip(first).take(tile.height() as usize);
        let add_row = |(pixels, samples): (&mut [PixelSums], &[PixelSample])| {
            add_samples(&mut pixels[start..start + tile_width], samples, pass)
        };
        self.nonfinite += rows.zip(samples.par_chunks_exact(tile_width)).map(add_row).sum::<u64>();
    }

    /// Declares all tiles of `pass` added.
    ///
    /// # Errors
    /// If the film held the pass already; its sums are then wrong.
    pub fn finish_pass(&mut self, pass: u32) -> Result<(), FilmError> {
        if self.passes.insert(pass) { Ok(()) } else { Err(FilmError::PassTwice(pass)) }
    }

    /// Adds the passes of another film of the same picture.
    ///
    /// # Errors
    /// If it is of another picture (the first difference is named), or holds a pass that this film holds. This film is
    /// then as it was.
    pub fn merge(&mut self, other: &Self) -> Result<(), FilmError> {
        self.header.check_same(&other.header)?;
        if let Some(pass) = self.passes.overlap(&other.passes) {
            return Err(FilmError::PassTwice(pass));
        }
        self.passes = self.passes.union(&other.passes);
        self.nonfinite = self.nonfinite.saturating_add(other.nonfinite);
        self.pixels.iter_mut().zip(&other.pixels).for_each(|(pixel, more)| pixel.merge(more));
        Ok(())
    }

    /// The film as a file's content.
    pub fn to_bytes(&self) -> Vec<u8> {
        crate::encode::encode(self)
    }

    /// The film that a file's content holds.
    ///
    /// # Errors
    /// If the bytes are no film, of another format version, or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, FilmError> {
        crate::decode::decode(bytes)
    }

    /// Reads a film file.
    ///
    /// # Errors
    /// If the file can't be read, and as `from_bytes`.
    pub fn read(path: &Path) -> Result<Self, FilmError> {
        Self::from_bytes(&std::fs::read(path)?)
    }

    /// Writes a film file, whole or not at all.
    ///
    /// # Errors
    /// If the file can't be written.
    pub fn write(&self, path: &Path) -> Result<(), FilmError> {
        Ok(crate::atomic::write_atomically(path, &self.to_bytes())?)
    }
}

/// Adds a row of samples; returns how many were dropped.
fn add_samples(pixels: &mut [PixelSums], samples: &[PixelSample], pass: u32) -> u64 {
    let mut dropped = 0;
    for (pixel, sample) in pixels.iter_mut().zip(samples) {
        if is_finite(sample) {
            pixel.add(pass, sample);
        } else {
            dropped += 1;
        }
    }
    dropped
}

/// Whether every number of a sample is finite.
#[inline]
fn is_finite(sample: &PixelSample) -> bool {
    let vectors = [sample.beauty, sample.albedo, sample.normal];
    vectors.as_flattened().iter().all(|v| v.is_finite()) && sample.depth.is_none_or(f32::is_finite)
}

#[cfg(test)]
pub(crate) mod tests;
