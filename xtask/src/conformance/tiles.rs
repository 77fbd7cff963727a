//! The tile test of one render: do the means of its tiles agree with the reference's?

use hyaline_film::{Film, Image, TileFailure, develop, read_image, tile_test, variance_of_mean};
use std::collections::BTreeSet;
use std::path::Path;

/// Standard error of the picture's mean, relative to it, from which on the test is meant.
const LONG_ENOUGH: f64 = 0.003;

/// Outcome of a tile test.
pub(crate) struct Tiles {
    /// Whether all tiles agree in all channels.
    pub(crate) passes: bool,
    /// Number of tiles.
    pub(crate) count: usize,
    /// Tiles that disagree in some channel.
    pub(crate) failing: usize,
    /// Smallest p-value.
    pub(crate) worst_p: f64,
    /// What it must reach.
    pub(crate) threshold: f64,
    /// Standard error of the picture's mean, relative to the mean.
    pub(crate) mean_error: f64,
    /// The tiles that disagree, in words.
    pub(crate) failures: Vec<String>,
}

impl Tiles {
    /// Tests a film against a reference and the variance of its mean.
    ///
    /// # Errors
    /// A file can't be read, the film holds fewer than two passes, sizes differ.
    pub(crate) fn test(film: &Path, reference: &Path, variance: &Path) -> Result<Self, String> {
        let shown = film.display();
        let film = Film::read(film).map_err(|error| format!("{shown}: {error}"))?;
        let film_variance = variance_of_mean(&film).ok_or("the tile test needs two passes")?;
        let image = develop(&film);
        let (reference, variance) = (read(reference)?, read(variance)?);
        let test =
            tile_test(&image, &film_variance, &reference, &variance, hyaline_film::tile_test::TILE_SIZE)
                .map_err(|error| error.to_string())?;
        let failing: BTreeSet<(u32, u32)> = test.failures.iter().map(|f| (f.tile.y0, f.tile.x0)).collect();
        Ok(Self {
            passes: test.passes,
            count: test.tile_count,
            failing: failing.len(),
            worst_p: test.worst_p,
            threshold: test.threshold,
            mean_error: mean_error(&image, &film_variance),
            failures: test.failures.iter().map(words).collect(),
        })
    }

    /// Whether the render was long enough for the test to be meant.
    pub(crate) fn is_long_enough(&self) -> bool {
        self.mean_error < LONG_ENOUGH
    }
}

fn read(path: &Path) -> Result<Image, String> {
    read_image(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Standard error of the mean over all pixels and channels, over that mean.
fn mean_error(image: &Image, variance: &Image) -> f64 {
    let sum = |image: &Image| image.rgb.as_flattened().iter().map(|v| f64::from(*v)).sum::<f64>();
    sum(variance).sqrt() / sum(image).max(f64::MIN_POSITIVE)
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
        assert!((mean_error(&image, &variance) - (4.0_f64 / 300.0).sqrt() / 2.0).abs() < 1e-9);
    }
}
