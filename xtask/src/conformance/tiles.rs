//! The tile test of one render, and whether the render was long enough for it.

use hyaline_film::{
    Film, Image, TileFailure, develop, read_image, tile_test, variance_of_mean, with_shared_noise,
};
use std::collections::BTreeSet;
use std::path::Path;

/// Standard error of the picture's mean, relative to it, below which the test is meant.
const LONG_ENOUGH: f64 = 0.003;

/// The mean of a picture over pixels and channels, and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Noise {
    /// The mean.
    pub(crate) mean: f64,
    /// Its standard error, relative to the mean; infinite where it isn't known.
    pub(crate) relative_error: f64,
}

impl Noise {
    /// - `variance`: of the mean of each pixel; `None` where there was one pass only.
    pub(crate) fn new(image: &Image, variance: Option<&Image>) -> Self {
        let values = |image: &Image| image.rgb.as_flattened().iter().map(|v| f64::from(*v)).sum::<f64>();
        let (sum, count) = (values(image), image.rgb.as_flattened().len().max(1));
        let error = variance.map_or(f64::INFINITY, |variance| values(variance).sqrt());
        // A black picture is as sure as any.
        let relative_error = if error == 0.0 { 0.0 } else { error / sum.max(f64::MIN_POSITIVE) };
        Self { mean: sum / count as f64, relative_error }
    }

    /// Whether the render was long enough for the tile test to be meant.
    pub(crate) fn is_settled(&self) -> bool {
        self.relative_error < LONG_ENOUGH
    }

    /// Samples per pixel after which the error is about small enough, going by that of `spp` now.
    pub(crate) fn wanted_length(&self, spp: u64) -> f64 {
        spp as f64 * (self.relative_error / LONG_ENOUGH).powi(2)
    }

    /// Samples per pixel to go on to; `None` where the error is small enough or `most` is reached.
    pub(crate) fn next_length(&self, spp: u64, most: u64) -> Option<u64> {
        if self.is_settled() || spp >= most || spp == 0 {
            return None;
        }
        // A tenth more than it seems to take; at most four times as much, as the error itself is an estimate.
        let wanted = (1.1 * self.wanted_length(spp)).min(4.0 * spp as f64).ceil() as u64;
        Some(wanted.clamp(spp + 1, most))
    }
}

/// Outcome of a tile test.
pub(crate) struct Tiles {
    /// Whether all tiles agree in all channels.
    pub(crate) passes: bool,
    /// Number of tiles.
    pub(crate) count: usize,
    /// Tiles that disagree in some channel.
    pub(crate) failing: usize,
    /// Tests, three a tile, that would fail by the tiles' own variances.
    pub(crate) failing_by_own_variance: usize,
    /// Relative difference that is found in half of the tests.
    pub(crate) resolution: f64,
    /// Smallest p-value.
    pub(crate) worst_p: f64,
    /// What it must reach.
    pub(crate) threshold: f64,
    /// The tiles that disagree, in words.
    pub(crate) failures: Vec<String>,
}

impl Tiles {
    /// Tests a film against a reference and the variance of its mean.
    ///
    /// - `groups`: films of other passes, as many each, where pixels share photons and so their noise.
    ///
    /// # Errors
    /// A file can't be read, the film holds fewer than two passes, sizes differ.
    pub(crate) fn test(
        film: &Path,
        groups: &[Film],
        reference: &Path,
        variance: &Path,
    ) -> Result<Self, String> {
        let shown = film.display();
        let film = Film::read(film).map_err(|error| format!("{shown}: {error}"))?;
        let variance_of = |film: &Film| variance_of_mean(film).ok_or("the tile test needs two passes");
        let groups = groups.iter().map(|group| Ok((develop(group), variance_of(group)?)));
        let groups = groups.collect::<Result<Vec<_>, String>>()?;
        let (reference, variance) = (read(reference)?, read(variance)?);
        let size = hyaline_film::tile_test::TILE_SIZE;
        let film_variance =
            with_shared_noise(&variance_of(&film)?, &groups, size).map_err(|error| error.to_string())?;
        let test = tile_test(&develop(&film), &film_variance, &reference, &variance, size)
            .map_err(|error| error.to_string())?;
        let failing: BTreeSet<(u32, u32)> = test.failures.iter().map(|f| (f.tile.y0, f.tile.x0)).collect();
        Ok(Self {
            passes: test.passes,
            count: test.tile_count,
            failing: failing.len(),
            failing_by_own_variance: test.failures_by_own_variance,
            resolution: test.resolution,
            worst_p: test.worst_p,
            threshold: test.threshold,
            failures: test.failures.iter().map(words).collect(),
        })
    }
}

fn read(path: &Path) -> Result<Image, String> {
    read_image(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn words(failure: &TileFailure) -> String {
    let channel = ["red", "green", "blue"][failure.channel.min(2)];
    format!(
        "tile at {},{} {channel}: {:.5} and reference {:.5}, p {:.1e}",
        failure.tile.x0, failure.tile.y0, failure.mean, failure.reference_mean, failure.p
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_the_mean_falls_with_the_number_of_pixels() {
        // Mean 2 with variance 4 in each of 300 numbers: an error of sqrt(4 / 300) / 2.
        let (image, variance) =
            (Image::new(10, 10, vec![[2.0; 3]; 100]), Image::new(10, 10, vec![[4.0; 3]; 100]));
        let noise = Noise::new(&image, Some(&variance));
        assert!((noise.mean - 2.0).abs() < 1e-9);
        assert!((noise.relative_error - (4.0_f64 / 300.0).sqrt() / 2.0).abs() < 1e-9);
        assert_eq!(Noise::new(&image, None).relative_error, f64::INFINITY);
    }

    #[test]
    fn rounds_end_when_the_mean_is_settled_or_the_limit_is_reached() {
        let noise = |relative_error| Noise { mean: 1.0, relative_error };
        assert_eq!(noise(0.0029).next_length(64, 1000), None);
        assert_eq!(noise(0.006).next_length(64, 1000), Some(256));
        assert_eq!(noise(0.0033).next_length(1000, 10_000), Some(1331));
        assert_eq!(noise(1.0).next_length(64, 1000), Some(256));
        assert_eq!(noise(1.0).next_length(300, 1000), Some(1000));
        assert_eq!(noise(1.0).next_length(1000, 1000), None);
        assert_eq!(noise(f64::INFINITY).next_length(1, 64), Some(4));
    }
}
