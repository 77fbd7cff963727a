//! How far a picture is from a reference: squared errors, energy, and what an eye would notice.

use crate::flip;
use crate::image::Image;
use serde::Serialize;
use std::fmt;

/// Added to the squared reference, so that black pixels don't count without limit.
pub(crate) const RELATIVE_FLOOR: f64 = 0.01;

/// Share of the pixels that the trimmed error leaves out.
const TRIMMED_SHARE: f64 = 0.001;

/// Errors of a picture A against a reference B. NaN and infinities count as 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Mean of (a - b)² over pixels and channels.
    pub mse: f64,
    /// Mean of (a - b)² / (b² + 0.01) over pixels and channels.
    pub relmse: f64,
    /// The same without the 0.1 % of pixels of largest error: without fireflies.
    pub relmse_trimmed: f64,
    /// Mean of A over mean of B; not finite where B is black.
    pub mean_ratio: f64,
    /// Mean LDR-FLIP, 0…1, of the exposed and clipped pictures.
    pub flip: f64,
    /// Numbers in A and B that are not finite.
    pub nonfinite: u64,
}

/// Two pictures that can't be compared, with their sizes in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeMismatch {
    /// Width and height of the picture.
    pub image: [u32; 2],
    /// Width and height of the reference.
    pub reference: [u32; 2],
}

impl fmt::Display for SizeMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([w, h], [reference_w, reference_h]) = (self.image, self.reference);
        write!(f, "the pictures differ in size: {w}x{h} and {reference_w}x{reference_h}")
    }
}

impl std::error::Error for SizeMismatch {}

/// Compares a picture with a reference.
///
/// - `exposure`: factor on both before FLIP clips them to 0…1; it changes nothing else.
///
/// # Errors
/// If the pictures' windows differ in size.
pub fn compare(image: &Image, reference: &Image, exposure: f32) -> Result<Comparison, SizeMismatch> {
    let [width, height] = check_sizes(image, reference)?;
    let (a, nonfinite_a) = finite_colors(image);
    let (b, nonfinite_b) = finite_colors(reference);
    let mut relative: Vec<f64> = a.iter().zip(&b).map(|(&a, &b)| relative_error(a, b)).collect();
    let relmse = mean(&relative);
    let dropped = (TRIMMED_SHARE * relative.len() as f64).round_ties_even() as usize;
    relative.sort_unstable_by(f64::total_cmp);
    relative.truncate(relative.len() - dropped);
    let total = |colors: &[[f64; 3]]| colors.as_flattened().iter().sum::<f64>();
    let squared: f64 = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b) * (a - b)).sum();
    Ok(Comparison {
        mse: squared / (3 * a.len()).max(1) as f64,
        relmse,
        relmse_trimmed: mean(&relative),
        mean_ratio: total(&a) / total(&b),
        flip: mean(&flip::error_map(&a, &b, width as usize, height as usize, exposure.into())),
        nonfinite: nonfinite_a + nonfinite_b,
    })
}

/// Width and height that both pictures have.
pub(crate) fn check_sizes(image: &Image, reference: &Image) -> Result<[u32; 2], SizeMismatch> {
    let [image, reference] = [image, reference].map(|i| [i.window.width(), i.window.height()]);
    if image == reference { Ok(image) } else { Err(SizeMismatch { image, reference }) }
}

/// The colors with 0 for what is not finite, and how many numbers that were.
pub(crate) fn finite_colors(image: &Image) -> (Vec<[f64; 3]>, u64) {
    let mut nonfinite = 0;
    let mut finite = |v: f32| {
        nonfinite += u64::from(!v.is_finite());
        if v.is_finite() { f64::from(v) } else { 0.0 }
    };
    let colors = image.rgb.iter().map(|rgb| rgb.map(&mut finite)).collect();
    (colors, nonfinite)
}

/// Mean over the channels of the relative squared error of one pixel.
pub(crate) fn relative_error(a: [f64; 3], b: [f64; 3]) -> f64 {
    let channel = |(a, b): (f64, f64)| (a - b) * (a - b) / (b * b + RELATIVE_FLOOR);
    a.into_iter().zip(b).map(channel).sum::<f64>() / 3.0
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_those_worked_out_by_hand() {
        let a = Image::new(2, 1, vec![[1.0, 0.0, 0.5], [2.0, 2.0, 2.0]]);
        let b = Image::new(2, 1, vec![[0.5, 0.1, 0.5], [2.0, 1.0, 2.0]]);
        let result = compare(&a, &b, 1.0).expect("same size");
        assert!((result.mse - (0.25 + 0.01 + 1.0) / 6.0).abs() < 1e-9);
        let relmse = (0.25 / 0.26 + 0.01 / 0.02 + 1.0 / 1.01) / 6.0;
        assert!((result.relmse - relmse).abs() < 1e-7, "{} {relmse}", result.relmse);
        assert_eq!(result.relmse, result.relmse_trimmed);
        assert!((result.mean_ratio - 7.5 / 6.1).abs() < 1e-7);
    }

    #[test]
    fn trimming_drops_one_pixel_in_a_thousand() {
        let reference = Image::new(50, 40, vec![[1.0; 3]; 2000]);
        let mut image = reference.clone();
        image.rgb[7] = [1000.0; 3];
        image.rgb[1234] = [0.0, 500.0, 1.0];
        image.rgb[99] = [1.1; 3];
        let result = compare(&image, &reference, 1.0).expect("same size");
        assert!(result.relmse > 100.0);
        let expected = f64::from(1.1_f32 - 1.0).powi(2) / 1.01 / 1998.0;
        assert!((result.relmse_trimmed / expected - 1.0).abs() < 1e-6, "{}", result.relmse_trimmed);
    }

    #[test]
    fn broken_numbers_count_as_zero_and_are_counted() {
        let a = Image::new(1, 1, vec![[f32::NAN, f32::INFINITY, 1.0]]);
        let b = Image::new(1, 1, vec![[0.0, 0.0, 1.0]]);
        let result = compare(&a, &b, 1.0).expect("same size");
        assert_eq!((result.mse, result.flip, result.nonfinite, result.mean_ratio), (0.0, 0.0, 2, 1.0));
    }

    #[test]
    fn pictures_of_other_sizes_are_refused() {
        let error = compare(&Image::new(2, 1, vec![]), &Image::new(1, 2, vec![]), 1.0).expect_err("sizes");
        assert_eq!(error.to_string(), "the pictures differ in size: 2x1 and 1x2");
    }
}
