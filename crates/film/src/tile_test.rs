//! Do two noisy pictures show the same? A z-test on the means of tiles.
//!
//! 1. The mean of each tile and channel, and the variance of that mean, for the picture and for the reference.
//! 2. Each variance is raised to what the tiles about it have in proportion to their light, if that is more. A tile
//!    that happens to have seen none of the rare bright samples has too low a mean and far too low a variance: by its
//!    own account it is sure of a wrong value. Its neighbors have seen some. Light that arrives as rare samples of
//!    strength L has a variance of L times its mean, so variance over mean is what carries over.
//! 3. The difference over its standard deviation against the normal distribution, each test at the level that makes
//!    1 % for all together.
//!
//! Raising variances can only make the test miss something, never find something that is not there. What it misses
//! are differences below the noise that the neighborhood shows.

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
    /// Relative difference that the test would find in half of the tiles and channels: how sharp it is.
    pub resolution: f64,
    /// How many tests would fail by the tiles' own variances, not raised to their neighbors'.
    pub failures_by_own_variance: usize,
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
/// - `image_variance`, `reference_variance`: variance of the mean radiance of each pixel and channel; pixels are taken to know
///   nothing of each other, see [`with_shared_noise`](crate::with_shared_noise) for others.
/// - `tile_size`: side of a tile, pixels, ≥ 1; tiles at the right and lower border may be smaller.
///
/// Needs so many samples per tile that their mean is normal.
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
    let size = tile_size.max(1);
    let tiles = tiles(width, height, size);
    let columns = width.div_ceil(size) as usize;
    let [image, reference] = [(image, image_variance), (reference, reference_variance)]
        .map(|(image, variance)| Moments::of_tiles(image, variance, &tiles, width as usize));
    let (pooled_image, pooled_reference) = (pooled(&image, columns), pooled(&reference, columns));
    let threshold = sidak(3 * tiles.len());
    let (mut worst_p, mut failures, mut failures_by_own_variance) = (1.0_f64, Vec::new(), 0);
    let mut relative_errors = Vec::new();
    for (index, &tile) in tiles.iter().enumerate() {
        for channel in 0..3 {
            let (a, b) = (&image[index][channel], &reference[index][channel]);
            // Both should have the light of the brighter one.
            let light = a.mean.max(b.mean).max(0.0) / a.count;
            let variances = [
                a.variance.max(pooled_image[index][channel] * light),
                b.variance.max(pooled_reference[index][channel] * light),
            ];
            let p = p_value(a.mean, b.mean, variances[0] + variances[1]);
            worst_p = worst_p.min(p);
            relative_errors.push((variances[0] + variances[1]).sqrt() / b.mean);
            if p < threshold {
                failures.push(TileFailure { tile, channel, mean: a.mean, reference_mean: b.mean, p });
            }
            failures_by_own_variance +=
                usize::from(p_value(a.mean, b.mean, a.variance + b.variance) < threshold);
        }
    }
    Ok(TileTest {
        worst_p,
        threshold,
        passes: failures.is_empty(),
        tile_count: tiles.len(),
        resolution: quantile(threshold) * median(relative_errors),
        failures_by_own_variance,
        failures,
    })
}

/// The light of one channel of a tile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moments {
    /// Number of pixels.
    count: f64,
    pub(crate) mean: f64,
    /// Variance of the mean.
    pub(crate) variance: f64,
}

impl Moments {
    /// Of all tiles and channels.
    pub(crate) fn of_tiles(image: &Image, variance: &Image, tiles: &[Rect], width: usize) -> Vec<[Self; 3]> {
        let (colors, variances) = (finite_colors(image).0, finite_colors(variance).0);
        let moments = |tile: &Rect, channel: usize| {
            let count = tile.area() as f64;
            let sum = |values: &[[f64; 3]]| {
                tile.pixels().map(|(x, y)| values[y as usize * width + x as usize][channel]).sum::<f64>()
            };
            Self { count, mean: sum(&colors) / count, variance: sum(&variances) / (count * count) }
        };
        tiles.iter().map(|tile| [0, 1, 2].map(|channel| moments(tile, channel))).collect()
    }
}

/// For each tile and channel the variance of a pixel's mean over that mean, of the tile and those about it together.
fn pooled(moments: &[[Moments; 3]], columns: usize) -> Vec<[f64; 3]> {
    let relation = |index: usize, channel: usize| {
        let (mut variance, mut light) = (0.0, 0.0);
        for near in about(index, columns, moments.len()) {
            let tile = &moments[near][channel];
            variance += tile.variance * tile.count * tile.count;
            light += tile.mean.max(0.0) * tile.count;
        }
        if light > 0.0 { variance / light } else { 0.0 }
    };
    (0..moments.len()).map(|index| [0, 1, 2].map(|channel| relation(index, channel))).collect()
}

/// Indices of a tile and those about it, of `count` in rows of `columns`.
pub(crate) fn about(index: usize, columns: usize, count: usize) -> impl Iterator<Item = usize> {
    let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    let columns_near = near(index % columns, columns);
    near(index / columns, count / columns)
        .flat_map(move |y| columns_near.clone().map(move |x| y * columns + x))
}

/// Chance of a difference at least this large between right means whose difference has this variance.
fn p_value(mean: f64, reference_mean: f64, variance: f64) -> f64 {
    let rounding = ROUNDING * mean.abs().max(reference_mean.abs());
    let difference = (mean - reference_mean).abs();
    if difference == 0.0 {
        1.0
    } else {
        libm::erfc(difference / (2.0 * (variance + rounding * rounding)).sqrt())
    }
}

/// How many standard deviations off a difference is whose p-value is `p`, 0 < p ≤ 1.
fn quantile(p: f64) -> f64 {
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if libm::erfc(middle / 2.0_f64.sqrt()) > p { &mut low } else { &mut high }) = middle;
    }
    low
}

/// The middle one of some numbers, black tiles' infinities among them; 0 where there is none.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.retain(|number| !number.is_nan());
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(0.0)
}

/// Tiles that cover the picture, row by row.
pub(crate) fn tiles(width: u32, height: u32, size: u32) -> Vec<Rect> {
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

    /// A picture of 60 × 60 pixels that is even but for rare samples of strength `bright`, `rate` of them a tile on
    /// average, as a renderer of `samples` samples per pixel would see it; and the variance that it would estimate.
    fn with_rare_samples(random: &mut Random, samples: f64, bright: f64, rate: f64) -> (Image, Image) {
        let (mut colors, mut variances) = (Vec::new(), Vec::new());
        for _ in 0..60 * 60 {
            // At most one such sample a pixel, which is nearly so where they are rare.
            let seen = f64::from(u8::from(random.uniform() < rate / 144.0));
            let base =
                0.5 + 0.1 / samples.sqrt() * (random.uniform() + random.uniform() - 1.0) * 6.0_f64.sqrt();
            colors.push([(base + seen * bright / samples) as f32; 3]);
            variances.push([(0.01 / samples + seen * (bright / samples).powi(2)) as f32; 3]);
        }
        (Image::new(60, 60, colors), Image::new(60, 60, variances))
    }

    /// The reference of such pictures.
    fn without_noise(samples: f64, bright: f64, rate: f64) -> (Image, Image) {
        let mean = 0.5 + rate / 144.0 * bright / samples;
        (Image::new(60, 60, vec![[mean as f32; 3]; 3600]), Image::new(60, 60, vec![[1e-12; 3]; 3600]))
    }

    #[test]
    fn the_resolution_is_the_difference_that_would_just_be_found() {
        assert!((quantile(0.05) - 1.959_964).abs() < 1e-6);
        let constant = |value: f32| Image::new(24, 24, vec![[value; 3]; 576]);
        let zero = Image::new(24, 24, vec![]);
        let test = |value: f32| {
            tile_test(&constant(value), &constant(1e-2), &constant(1.0), &zero, 12).expect("same size")
        };
        let resolution = test(1.0).resolution;
        // A tile's standard error is 0.1 / 12.
        assert!((resolution / (quantile(test(1.0).threshold) * 0.1 / 12.0) - 1.0).abs() < 1e-6);
        assert!(test(1.0 + 0.99 * resolution as f32).passes && !test(1.0 + 1.01 * resolution as f32).passes);
    }

    #[test]
    fn tiles_that_missed_the_rare_samples_do_not_fail_for_it() {
        let mut random = Random::from_seed(5);
        let (mut failed, mut failed_by_own) = (0, 0);
        for _ in 0..100 {
            // One rare sample a tile brings 2 % of its light, so a tile without one is 2 % too dark.
            let (samples, bright, rate) = (256.0, 368.0, 1.0);
            let (a, a_variance) = with_rare_samples(&mut random, samples, bright, rate);
            let (b, b_variance) = without_noise(samples, bright, rate);
            let result = tile_test(&a, &a_variance, &b, &b_variance, 12).expect("same size");
            failed += usize::from(!result.passes);
            failed_by_own += usize::from(result.failures_by_own_variance > 0);
        }
        assert_eq!(failed_by_own, 100);
        assert!(failed <= 10, "{failed} of 100 right pictures failed");
    }

    #[test]
    fn a_tile_that_is_two_percent_off_is_found_at_the_length_that_the_test_is_meant_for() {
        let mut random = Random::from_seed(6);
        // A tile's own standard error of 0.3 %, four times that of this picture's mean.
        for off in [0.98, 1.03] {
            let found = (0..50).filter(|_| {
                let sigma = 0.5 * 0.003 * 12.0;
                let (mut a, a_variance) = noisy(&mut random, 0.5, sigma);
                let (b, b_variance) = noisy(&mut random, 0.5, 0.2 * sigma);
                for (x, y) in (Rect { x0: 12, y0: 12, x1: 24, y1: 24 }).pixels() {
                    a.rgb[(y * 50 + x) as usize].iter_mut().for_each(|value| *value *= off);
                }
                !tile_test(&a, &a_variance, &b, &b_variance, 12).expect("same size").passes
            });
            assert_eq!(found.count(), 50, "{off}");
        }
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
