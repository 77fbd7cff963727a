//! From sums to pictures: means, and how sure they are.

use crate::film::Film;
use crate::fixed::{from_fixed, from_fixed_unit};
use crate::image::{Channel, Image, Samples};
use crate::sums::PixelSums;

/// The picture of a film: the mean of its passes; black without any.
///
/// Channels: `albedo.R` `.G` `.B` and `normal.X` `.Y` `.Z`, means over all passes; `depth.Z`, scene units, the mean over
/// the passes that hit something, 0 where none did; `object.id`, the object seen by the lowest pass that saw one, counted
/// from 1, 0 for none. Metadata: version, digest, seed, passes.
pub fn develop(film: &Film) -> Image {
    let mean = 1.0 / film.passes.len().max(1) as f64;
    let beauty = |pixel: &PixelSums| pixel.beauty.map(|sum| (from_fixed(sum) * mean) as f32);
    let mut channels = Vec::new();
    for (i, name) in ["albedo.R", "albedo.G", "albedo.B"].into_iter().enumerate() {
        channels.push(channel(film, name, |pixel| from_fixed_unit(pixel.albedo[i]) * mean));
    }
    for (i, name) in ["normal.X", "normal.Y", "normal.Z"].into_iter().enumerate() {
        channels.push(channel(film, name, |pixel| from_fixed_unit(pixel.normal[i]) * mean));
    }
    channels.push(channel(film, "depth.Z", |pixel| from_fixed(pixel.depth) / pixel.hits.max(1) as f64));
    let objects = film.pixels.iter().map(|pixel| pixel.object.id()).collect();
    channels.push(Channel { name: "object.id".to_owned(), samples: Samples::U32(objects) });
    Image { channels, metadata: metadata(film), ..picture(film, beauty) }
}

/// Variance of the mean radiance, per pixel and channel, estimated from the differences between the passes.
///
/// An upper bound where passes are stratified, which independent passes are not. `None` for fewer than two passes.
pub fn variance_of_mean(film: &Film) -> Option<Image> {
    let n = film.passes.len() as f64;
    (n >= 2.0).then(|| picture(film, |pixel| pixel_variance(pixel, n).map(|v| v as f32)))
}

/// Standard error of the mean radiance: the square root of `variance_of_mean`.
pub fn standard_error(film: &Film) -> Option<Image> {
    let n = film.passes.len() as f64;
    (n >= 2.0).then(|| picture(film, |pixel| pixel_variance(pixel, n).map(|v| v.sqrt() as f32)))
}

/// (E[x²] - E[x]²) / (n - 1), for each channel.
pub(crate) fn pixel_variance(pixel: &PixelSums, n: f64) -> [f64; 3] {
    std::array::from_fn(|channel| {
        let mean = from_fixed(pixel.beauty[channel]) / n;
        let mean_square = pixel.squares[channel].to_f64() / n;
        (mean_square - mean * mean).max(0.0) / (n - 1.0)
    })
}

fn picture(film: &Film, rgb: impl Fn(&PixelSums) -> [f32; 3]) -> Image {
    Image {
        width: film.header.width,
        height: film.header.height,
        window: film.header.crop,
        rgb: film.pixels.iter().map(rgb).collect(),
        channels: Vec::new(),
        metadata: Vec::new(),
    }
}

fn channel(film: &Film, name: &str, value: impl Fn(&PixelSums) -> f64) -> Channel {
    let samples = film.pixels.iter().map(|pixel| value(pixel) as f32).collect();
    Channel { name: name.to_owned(), samples: Samples::F32(samples) }
}

fn metadata(film: &Film) -> Vec<(String, String)> {
    let texts = [
        ("version", concat!("hyaline ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("digest", film.header.digest()),
        ("seed", film.header.seed.to_string()),
        ("passes", film.passes.to_string()),
    ];
    texts.into_iter().map(|(name, text)| (name.to_owned(), text)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::tests::film;
    use crate::header::tests::header;
    use crate::sample::PixelSample;

    /// A film of one pixel and the given values of its red channel.
    fn film_of(values: &[f32]) -> Film {
        let mut film = Film::new(header(1, 1)).expect("possible");
        for (pass, &value) in values.iter().enumerate() {
            let hit = PixelSample {
                beauty: [value, 2.0 * value, 0.25],
                albedo: [0.5, 0.25, 1.0],
                normal: [0.0, -1.0, 0.0],
                depth: Some(3.0 * value),
                object: 7,
            };
            film.add_tile(pass as u32, film.header.crop, &[hit]);
            film.finish_pass(pass as u32).expect("new");
        }
        film
    }

    #[test]
    fn pictures_are_means() {
        let image = develop(&film_of(&[1.0, 2.0, 6.0, 3.0]));
        assert_eq!(image.rgb, [[3.0, 6.0, 0.25]]);
        let value = |name: &str| {
            let channel = image.channels.iter().find(|channel| channel.name == name).expect("there");
            channel.samples.clone()
        };
        assert_eq!(value("albedo.G"), Samples::F32(vec![0.25]));
        assert_eq!(value("normal.Y"), Samples::F32(vec![-1.0]));
        assert_eq!(value("depth.Z"), Samples::F32(vec![9.0]));
        assert_eq!(value("object.id"), Samples::U32(vec![7]));
        assert!(image.metadata.contains(&("passes".to_owned(), "0..4".to_owned())));
    }

    #[test]
    fn a_film_without_passes_is_black() {
        let image = develop(&film([]));
        assert!(image.rgb.iter().flatten().all(|&v| v == 0.0));
        assert_eq!(variance_of_mean(&film([0])), None);
    }

    #[test]
    fn variance_is_the_textbook_formula() {
        // Sample variance of 1, 2, 6, 3 is 14/3, that of the mean a quarter of it.
        let film = film_of(&[1.0, 2.0, 6.0, 3.0]);
        let variance = variance_of_mean(&film).expect("enough passes").rgb[0];
        assert!((variance[0] - 14.0 / 12.0).abs() < 1e-6 && (variance[1] - 4.0 * 14.0 / 12.0).abs() < 1e-5);
        assert_eq!(variance[2], 0.0);
        let error = standard_error(&film).expect("enough passes").rgb[0];
        assert!((error[0] * error[0] - variance[0]).abs() < 1e-6);
    }
}
