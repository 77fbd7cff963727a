//! Noise that the pixels of a tile share, since they gather the same photons; variances of single pixels don't tell of it.
//!
//! Groups of passes that know nothing of each other scatter by all that there is. How much more their tiles scatter than
//! pixels on their own would is averaged over a tile and those about it, and variances are raised by it.

use crate::compare::{SizeMismatch, check_sizes};
use crate::image::Image;
use crate::tile_test::{Moments, about, tiles};

/// The variance of a picture, raised by what the pixels of each tile scatter together.
///
/// - `variance`: of the mean of each pixel and channel.
/// - `groups`: pictures of as many passes each, and the variance of the mean of their pixels; fewer than two tell nothing.
/// - `tile_size`: side of a tile, pixels, ≥ 1.
///
/// # Errors
/// If any two of the pictures differ in size.
pub fn with_shared_noise(
    variance: &Image,
    groups: &[(Image, Image)],
    tile_size: u32,
) -> Result<Image, SizeMismatch> {
    for (image, own) in groups {
        check_sizes(variance, image)?;
        check_sizes(variance, own)?;
    }
    let (width, size) = (variance.width, tile_size.max(1));
    let tiles = tiles(width, variance.height, size);
    let groups: Vec<_> =
        groups.iter().map(|(image, own)| Moments::of_tiles(image, own, &tiles, width as usize)).collect();
    let columns = width.div_ceil(size) as usize;
    let ratios: Vec<[Option<f64>; 3]> =
        (0..tiles.len()).map(|tile| [0, 1, 2].map(|channel| ratio(&groups, tile, channel))).collect();
    let mut raised = variance.clone();
    for (index, tile) in tiles.iter().enumerate() {
        for channel in 0..3 {
            let factor = mean_about(&ratios, index, columns, channel).max(1.0);
            for (x, y) in tile.pixels() {
                raised.rgb[y as usize * width as usize + x as usize][channel] *= factor as f32;
            }
        }
    }
    Ok(raised)
}

/// Variance of a tile's mean over what it would be if its pixels knew nothing of each other; `None` where it isn't known.
fn ratio(groups: &[Vec<[Moments; 3]>], tile: usize, channel: usize) -> Option<f64> {
    let count = groups.len() as f64;
    let of = |value: fn(&Moments) -> f64| groups.iter().map(move |group| value(&group[tile][channel]));
    let mean = of(|moments| moments.mean).sum::<f64>() / count;
    let squares: f64 = of(|moments| moments.mean).map(|value| (value - mean) * (value - mean)).sum();
    let ratio = squares / (count - 1.0) / (of(|moments| moments.variance).sum::<f64>() / count);
    ratio.is_finite().then_some(ratio)
}

/// Mean of the ratios of a tile and those about it; 1 where none is known.
fn mean_about(ratios: &[[Option<f64>; 3]], index: usize, columns: usize, channel: usize) -> f64 {
    let known = about(index, columns, ratios.len()).filter_map(|near| ratios[near][channel]);
    let (sum, count) = known.fold((0.0, 0.0), |(sum, count), ratio| (sum + ratio, count + 1.0));
    if count > 0.0 { sum / count } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tile_test::tile_test;
    use hyaline_testkit::Random;

    const SIDE: u32 = 96;
    /// Standard deviation of a pixel of a group by what it has on its own.
    const OWN: f32 = 0.05;
    /// The same by what the pixels of a patch have in common.
    const SHARED: f32 = 0.02;
    /// Side of a patch, pixels.
    const PATCH: u32 = 6;

    fn normal(random: &mut Random) -> f32 {
        // The sum of twelve uniform numbers is normal enough.
        (0..12).map(|_| random.uniform_f32()).sum::<f32>() - 6.0
    }

    /// An even picture whose pixels are noisy on their own and by patches; and the variance of pixels.
    fn blotchy(random: &mut Random, scale: f32) -> (Image, Image) {
        let patches: Vec<f32> = (0..(SIDE / PATCH).pow(2)).map(|_| scale * SHARED * normal(random)).collect();
        let pixel = |index: u32| {
            let (x, y) = (index % SIDE / PATCH, index / SIDE / PATCH);
            [0.5 + patches[(y * (SIDE / PATCH) + x) as usize] + scale * OWN * normal(random); 3]
        };
        let rgb = (0..SIDE * SIDE).map(pixel).collect();
        let variance = scale * scale * (OWN * OWN + SHARED * SHARED);
        (Image::new(SIDE, SIDE, rgb), Image::new(SIDE, SIDE, vec![[variance; 3]; (SIDE * SIDE) as usize]))
    }

    /// Pictures of 200 that fail against the truth, by their pixels' variances and by raised ones.
    fn failing(off: f32) -> [usize; 2] {
        let mut random = Random::from_seed(3);
        let pixels = (SIDE * SIDE) as usize;
        let truth = Image::new(SIDE, SIDE, vec![[0.5; 3]; pixels]);
        let certain = Image::new(SIDE, SIDE, vec![[1e-12; 3]; pixels]);
        let mut failing = [0, 0];
        for _ in 0..200 {
            let (mut image, variance) = blotchy(&mut random, 0.25);
            image.rgb.iter_mut().take((SIDE * 24) as usize).flatten().for_each(|value| *value += off);
            let groups: Vec<_> = (0..8).map(|_| blotchy(&mut random, 1.0)).collect();
            let raised = with_shared_noise(&variance, &groups, 12).expect("same size");
            for (failing, variance) in failing.iter_mut().zip([&variance, &raised]) {
                let test = tile_test(&image, variance, &truth, &certain, 12).expect("same size");
                *failing += usize::from(!test.passes);
            }
        }
        failing
    }

    #[test]
    fn right_pictures_that_are_blotchy_pass_and_wrong_ones_fail() {
        let [by_pixels, raised] = failing(0.0);
        assert!(by_pixels > 100 && raised <= 12, "{by_pixels} and {raised} of 200 right ones fail");
        // Six standard deviations of a tile.
        let [_, raised] = failing(6.0 * 0.25 * SHARED / 2.0);
        assert!(raised > 190, "only {raised} of 200 wrong ones fail");
    }

    #[test]
    fn without_groups_variances_are_as_they_were() {
        let (image, variance) = blotchy(&mut Random::from_seed(4), 1.0);
        assert_eq!(with_shared_noise(&variance, &[], 12).expect("same size").rgb, variance.rgb);
        let one = [(image, variance.clone())];
        assert_eq!(with_shared_noise(&variance, &one, 12).expect("same size").rgb, variance.rgb);
        let (small, zero) = (Image::new(4, 4, vec![[0.0; 3]; 16]), Image::new(4, 4, vec![[0.0; 3]; 16]));
        assert!(with_shared_noise(&variance, &[(small, zero)], 12).is_err());
    }
}
