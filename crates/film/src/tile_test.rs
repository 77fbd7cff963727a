//! Do two noisy pictures show the same? A z-test on the means of tiles.

use crate::compare::{SizeMismatch, check_sizes, finite_colors};
use crate::image::Image;
use crate::rect::Rect;

/// Side of a tile in conformance tests, pixels.
pub const TILE_SIZE: u32 = 12;

/// Chance that a right picture fails.
const FAMILY_LEVEL: f64 = 0.01;

/// Relative difference of two means that is put down to f32 rounding, as a standard deviation.
const ROUNDING: f64 = 1e-6;

/// Outcome of a tile test.
#[derive(Clone, Debug, PartialEq)]
pub struct TileTest {
    /// Smallest p-value of all tiles and channels, 0…1.
    pub worst_p: f64,
    /// What each p-value must reach, so that a right picture passes with 99 %.
    pub threshold: f64,
    /// Whether all do.
    pub passes: bool,
    /// Number of tiles.
    pub tile_count: usize,
    /// The tiles and channels that don't.
    pub failures: Vec<TileFailure>,
}

/// A tile whose means differ by more than noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileFailure {
    /// Where it is, pixels of the pictures' window.
    pub tile: Rect,
    /// 0, 1 or 2: red, green or blue.
    pub channel: usize,
    /// Mean of the picture.
    pub mean: f64,
    /// Mean of the reference.
    pub reference_mean: f64,
    /// Chance of a difference at least this large between right pictures.
    pub p: f64,
}

/// Compares the tiles of two pictures whose variances are known.
///
/// - `image_variance`, `reference_variance`: variance of the mean radiance of each pixel and channel.
/// - `tile_size`: side of a tile, pixels, ≥ 1; tiles at the right and lower border may be smaller.
///
/// The difference of two means of a tile, over its standard deviation, is compared with the normal distribution; the
/// level of each test makes 1 % for all together. Needs so many samples per tile that their mean is normal.
///
/// # Errors
/// If any two of the pictures differ in size.
///
/// Source: Šidák, Rectangular confidence regions for the means of multivariate normal distributions, JASA 62, 1967.
pub fn tile_test(
    image: &Image,
    image_variance: &Image,
    reference: &Image,
    reference_variance: &Image,
    tile_size: u32,
) -> Result<TileTest, SizeMismatch> {
    check_sizes(image, image_variance)?;
    check_sizes(reference, reference_variance)?;
    let [width, height] = check_sizes(image, reference)?;
    let colors = [image, image_variance, reference, reference_variance].map(|image| finite_colors(image).0);
    let tiles = tiles(width, height, tile_size.max(1));
    let threshold = sidak(3 * tiles.len());
    let (mut worst_p, mut failures) = (1.0_f64, Vec::new());
    for &tile in &tiles {
        for channel in 0..3 {
            let result = test_tile(&colors, width as usize, tile, channel);
            worst_p = worst_p.min(result.p);
            failures.extend((result.p < threshold).then_some(result));
        }
    }
    Ok(TileTest { worst_p, threshold, passes: failures.is_empty(), tile_count: tiles.len(), failures })
}

/// The z-test of one channel of one tile. `colors`: picture, its variance, reference, its variance.
fn test_tile(colors: &[Vec<[f64; 3]>; 4], width: usize, tile: Rect, channel: usize) -> TileFailure {
    let count = tile.area() as f64;
    let [sum, variance, reference_sum, reference_variance] = [0, 1, 2, 3].map(|i| {
        tile.pixels().map(|(x, y)| colors[i][y as usize * width + x as usize][channel]).sum::<f64>()
    });
    let (mean, reference_mean) = (sum / count, reference_sum / count);
    let rounding = ROUNDING * mean.abs().max(reference_mean.abs());
    let variance = (variance + reference_variance) / (count * count) + rounding * rounding;
    let difference = (mean - reference_mean).abs();
    let p = if difference == 0.0 { 1.0 } else { libm::erfc(difference / (2.0 * variance).sqrt()) };
    TileFailure { tile, channel, mean, reference_mean, p }
}

/// Tiles that cover the picture, row by row.
fn tiles(width: u32, height: u32, size: u32) -> Vec<Rect> {
    let starts = |length: u32| (0..length).step_by(size as usize);
    let tile = |x0: u32, y0: u32| {
        let (x1, y1) = (x0.saturating_add(size).min(width), y0.saturating_add(size).min(height));
        Rect { x0, y0, x1, y1 }
    };
    starts(height).flat_map(|y0| starts(width).map(move |x0| tile(x0, y0))).collect()
}

/// Level of each of `count` tests: 1 - (1 - level)^(1 / count).
fn sidak(count: usize) -> f64 {
    -libm::expm1(libm::log1p(-FAMILY_LEVEL) / count.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;

    /// A picture of the given mean with normal noise of the given standard deviation, and its variance.
    fn noisy(random: &mut Random, mean: f32, sigma: f32) -> (Image, Image) {
        // The sum of twelve uniform numbers is normal enough.
        let mut normal = || (0..12).map(|_| random.uniform_f32()).sum::<f32>() - 6.0;
        let rgb = (0..50 * 30).map(|_| [0, 1, 2].map(|_| mean + sigma * normal())).collect();
        (Image::new(50, 30, rgb), Image::new(50, 30, vec![[sigma * sigma; 3]; 50 * 30]))
    }

    #[test]
    fn tiles_cover_every_pixel_once() {
        let tiles = tiles(50, 30, 12);
        assert_eq!((tiles.len(), tiles[4]), (15, Rect { x0: 48, y0: 0, x1: 50, y1: 12 }));
        assert_eq!(tiles.iter().map(|tile| tile.area()).sum::<usize>(), 50 * 30);
    }

    #[test]
    fn right_pictures_fail_at_the_level_of_the_test() {
        let mut random = Random::from_seed(1);
        let failed = (0..2000)
            .filter(|_| {
                let (a, a_variance) = noisy(&mut random, 0.5, 0.1);
                let (b, b_variance) = noisy(&mut random, 0.5, 0.05);
                !tile_test(&a, &a_variance, &b, &b_variance, 12).expect("same size").passes
            })
            .count();
        // 1 % of 2000, give or take four standard deviations.
        assert!((3..=38).contains(&failed), "{failed} of 2000 failed");
    }

    #[test]
    fn a_wrong_patch_is_found_and_named() {
        let mut random = Random::from_seed(2);
        let (mut a, a_variance) = noisy(&mut random, 0.5, 0.1);
        let (b, b_variance) = noisy(&mut random, 0.5, 0.1);
        for (x, y) in (Rect { x0: 14, y0: 13, x1: 22, y1: 22 }).pixels() {
            a.rgb[(y * 50 + x) as usize][1] += 0.15;
        }
        let result = tile_test(&a, &a_variance, &b, &b_variance, 12).expect("same size");
        assert!(!result.passes && result.worst_p < 1e-6);
        assert_eq!(result.failures.len(), 1);
        let failure = result.failures[0];
        assert_eq!((failure.tile, failure.channel), (Rect { x0: 12, y0: 12, x1: 24, y1: 24 }, 1));
    }

    #[test]
    fn constants_agree_up_to_rounding() {
        let zero = Image::new(12, 12, vec![]);
        let constant = |value: f32| Image::new(12, 12, vec![[value; 3]; 144]);
        let p = |a: f32, b: f32| {
            tile_test(&constant(a), &zero, &constant(b), &zero, 12).expect("same size").worst_p
        };
        assert_eq!(p(0.3, 0.3), 1.0);
        assert!(p(0.3, 0.3_f32.next_up()) > 0.5);
        assert!(p(0.3, 0.3001) < 1e-9);
        assert_eq!(p(0.0, 1e-30), 1.0 * libm::erfc(1e6 / 2.0_f64.sqrt()));
    }
}
