//! A picture of where two pictures differ.

use crate::compare::{SizeMismatch, check_sizes, finite_colors, relative_error};
use crate::image::Image;

/// Relative squared errors that are shown black and white; between them the scale is logarithmic.
const RANGE: [f64; 2] = [1e-4, 1e1];

/// Colors of the scale at equal steps, linear Rec. 709, of growing luminance: black, violet, red, orange, yellow, white.
const SCALE: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [0.055, 0.002, 0.11],
    [0.30, 0.012, 0.10],
    [0.85, 0.12, 0.015],
    [1.0, 0.58, 0.05],
    [1.0, 1.0, 1.0],
];

/// The relative squared error of every pixel as a color, for looking at as a PNG.
///
/// Black is an error of 1e-4 or less, white of 10 or more, each color between them 10 times the one before.
///
/// # Errors
/// If the pictures' windows differ in size.
pub fn difference_image(image: &Image, reference: &Image) -> Result<Image, SizeMismatch> {
    check_sizes(image, reference)?;
    let pairs = finite_colors(image).0.into_iter().zip(finite_colors(reference).0);
    Ok(reference.with_rgb(pairs.map(|(a, b)| color(relative_error(a, b))).collect()))
}

/// The color of an error.
fn color(error: f64) -> [f32; 3] {
    let decades = libm::log10(error.clamp(RANGE[0], RANGE[1]) / RANGE[0]);
    let position = decades / libm::log10(RANGE[1] / RANGE[0]) * (SCALE.len() - 1) as f64;
    let step = (position as usize).min(SCALE.len() - 2);
    let fraction = position - step as f64;
    std::array::from_fn(|i| {
        let [low, high] = [SCALE[step][i], SCALE[step + 1][i]];
        (low + fraction * (high - low)) as f32
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_spectrum::color::luminance;

    #[test]
    fn larger_errors_are_brighter() {
        let shown: Vec<f32> =
            (0..=60).map(|i| luminance(color(1e-5 * libm::exp10(f64::from(i) * 0.1)))).collect();
        assert_eq!((shown[0], shown[10]), (0.0, 0.0));
        assert!(shown[10..].windows(2).all(|pair| pair[0] < pair[1]), "{shown:?}");
        assert_eq!(color(1e9), [1.0; 3]);
    }

    #[test]
    fn equal_pixels_are_black() {
        let reference = Image::new(2, 1, vec![[1.0; 3], [1.0; 3]]);
        let image = Image::new(2, 1, vec![[1.0; 3], [f32::NAN; 3]]);
        let difference = difference_image(&image, &reference).expect("same size");
        assert_eq!(difference.rgb[0], [0.0; 3]);
        assert!(luminance(difference.rgb[1]) > 0.3);
        assert!(difference_image(&image, &Image::new(1, 1, vec![])).is_err());
    }
}
