//! How far a film's picture is from the truth, as far as the film itself can tell.
//!
//! What `compare` measures against a perfect reference, relmse = mean of (a - b)² / (b² + 0.01), has the mean of
//! Var(a) / (b² + 0.01) for pictures that are right in the mean. The film knows the spread of its passes, hence Var(a),
//! but not b, and its own a must not stand in for it: where a pixel has caught a firefly, both its variance and its
//! value are large, and their quotient looks harmless. So b is taken for the larger of two numbers that fireflies do not
//! lift: what 3 × 3 pixels show together, less what noise adds to the square of their mean; and the mean of what each of
//! them shows for sure, by its own variance.
//!
//! It errs on the side of too much: passes of a stratified sampler differ more than their mean errs. It does not see what no
//! pass has met, so short films may look better than they are, nor what is wrong in the mean (blur by a gather
//! radius, which passes share; it shrinks as passes grow).

use crate::compare::RELATIVE_FLOOR;
use crate::convolution::{Kernel, Plane};
use crate::develop::pixel_variance;
use crate::film::Film;
use crate::fixed::from_fixed;

/// Pixels whose mean stands for the truth.
const NEIGHBORS: f64 = 9.0;
/// How much more than that of independent pixels the variance of their mean is taken for: they share photons, and so
/// fireflies.
const SHARED_NOISE: f64 = 2.5;
/// How much of its own variance a pixel's square must exceed to show anything: one firefly alone makes them equal.
const OWN_NOISE: f64 = 1.5;
/// Factor for what neighbors, standing in for a pixel, leave out: up to a tenth on caustics with independent noise.
const RESERVE: f64 = 1.1;

/// Estimate of the relmse of a film's picture against the truth, as `compare` would find it.
///
/// Returns a number ≥ 0; `None` for fewer than two passes. It depends on the sums of the film alone.
pub fn error_estimate(film: &Film) -> Option<f64> {
    let passes = film.passes.len() as f64;
    if passes < 2.0 {
        return None;
    }
    let variances: Vec<[f64; 3]> = film.pixels.iter().map(|pixel| pixel_variance(pixel, passes)).collect();
    let channel = |c: usize| {
        let mean = plane(film, film.pixels.iter().map(|pixel| from_fixed(pixel.beauty[c]) / passes));
        let variance = plane(film, variances.iter().map(|variance| variance[c]));
        channel_error(&mean, &variance)
    };
    Some(RESERVE * (0..3).map(channel).sum::<f64>() / 3.0)
}

/// One channel's mean of variance over what is taken for the truth.
fn channel_error(mean: &Plane, variance: &Plane) -> f64 {
    let third = Kernel::new(1, |_| 1.0).normalized();
    let near = |plane: &Plane| plane.convolved(&third, &third).values;
    let pairs = mean.values.iter().zip(&variance.values);
    let sure = pairs.map(|(mean, variance)| (mean * mean - OWN_NOISE * variance).max(0.0).sqrt());
    let sure = near(&Plane { values: sure.collect(), ..*mean });
    let (means, noises) = (near(mean), near(variance));
    let truths = means.iter().zip(&noises).zip(&sure).map(|((mean, noise), sure)| {
        let together = mean * mean - SHARED_NOISE / NEIGHBORS * noise;
        together.max(sure * sure)
    });
    let errors =
        variance.values.iter().zip(truths).map(|(variance, truth)| variance / (truth + RELATIVE_FLOOR));
    errors.sum::<f64>() / variance.values.len().max(1) as f64
}

fn plane(film: &Film, values: impl Iterator<Item = f64>) -> Plane {
    let (width, height) = (film.header.crop.width() as usize, film.header.crop.height() as usize);
    Plane { width, height, values: values.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::header::tests::header;
    use crate::{Image, PixelSample, compare, develop};
    use hyaline_testkit::Random;

    const SIDE: u32 = 48;

    /// A film of a picture that is brighter from left to right, its samples given by `noise` with a mean of 1.
    fn film_of(passes: u32, seed: u64, noise: impl Fn(&mut Random) -> f64) -> (Film, Image) {
        let mut random = Random::from_seed(seed);
        let truth = |x: u32| 0.02 + 1.5 * f64::from(x) / f64::from(SIDE);
        let mut film = Film::new(header(SIDE, SIDE)).expect("possible");
        for pass in 0..passes {
            let mut sample = |x: u32| {
                let value = (truth(x) * noise(&mut random)) as f32;
                PixelSample { beauty: [value; 3], ..PixelSample::default() }
            };
            let samples: Vec<PixelSample> = film.header.crop.pixels().map(|(x, _)| sample(x)).collect();
            film.add_tile(pass, film.header.crop, &samples);
            film.finish_pass(pass).expect("new");
        }
        let pixels = film.header.crop.pixels().map(|(x, _)| [truth(x) as f32; 3]);
        (film.clone(), Image::new(SIDE, SIDE, pixels.collect()))
    }

    /// Estimate over true relmse, both summed over some films.
    fn ratio(passes: u32, noise: impl Fn(&mut Random) -> f64) -> f64 {
        let (mut estimated, mut actual) = (0.0, 0.0);
        for seed in 0..12 {
            let (film, truth) = film_of(passes, seed, &noise);
            estimated += error_estimate(&film).expect("two passes");
            actual += compare(&develop(&film), &truth, 1.0).expect("same size").relmse;
        }
        estimated / actual
    }

    #[test]
    fn mild_noise_is_estimated_well() {
        for passes in [4, 16, 64] {
            let ratio = ratio(passes, |random| 2.0 * random.uniform());
            assert!((1.0..1.25).contains(&ratio), "{passes} passes: {ratio}");
        }
    }

    #[test]
    fn fireflies_do_not_hide_behind_their_own_brightness() {
        // One sample in 400 carries half of the light.
        let firefly = |random: &mut Random| if random.uniform() < 0.0025 { 200.5 } else { 0.5 };
        for passes in [8, 32, 128] {
            let ratio = ratio(passes, firefly);
            assert!(ratio > 0.9, "{passes} passes: {ratio}");
        }
        // Once all pixels have met them, they are noise like any other.
        let ratio = ratio(2048, firefly);
        assert!((1.0..1.5).contains(&ratio), "2048 passes: {ratio}");
    }

    #[test]
    fn one_pass_tells_nothing_and_a_still_picture_has_no_error() {
        assert_eq!(error_estimate(&film_of(1, 0, |_| 1.0).0), None);
        assert_eq!(error_estimate(&film_of(3, 0, |_| 1.0).0), Some(0.0));
    }

    #[test]
    fn the_estimate_falls_as_passes_grow() {
        let estimate = |passes| {
            error_estimate(&film_of(passes, 3, |random| 2.0 * random.uniform()).0).expect("two passes")
        };
        let slope = libm::log2(estimate(256) / estimate(16)) / 4.0;
        assert!((slope + 1.0).abs() < 0.05, "{slope}");
    }
}
