//! LDR-FLIP: the difference that an eye sees when it flips between two pictures on a screen.
//!
//! Both pictures are blurred as the eye blurs them (contrast sensitivity), compared in a perceptually uniform color
//! space, and the color difference is amplified where edges or points differ.
//! Source: Andersson et al., FLIP: a difference evaluator for alternating images, PACMCGIT 3(2), HPG 2020.

use crate::convolution::{Kernel, Plane};
use hyaline_math::float::f64::{cbrt, exp, powf};
use hyaline_math::{DMat3, DVec3};
use std::f64::consts::PI;

/// Pixels per degree of a 0.7 m wide screen of 3840 pixels seen from 0.7 m: 3840 · π / 180.
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// Exponent of the color difference [§4.1].
const COLOR_EXPONENT: f64 = 0.7;

/// Exponent of the feature difference [§4.2].
const FEATURE_EXPONENT: f64 = 0.5;

/// Width of the edge and point detectors, degrees [§4.2].
const FEATURE_WIDTH: f64 = 0.082;

/// Amplitudes and widths (degrees²) of the Gaussians that make up the contrast sensitivity of the achromatic, red-green
/// and blue-yellow channel.
const SENSITIVITY: [&[[f64; 2]]; 3] = [&[[1.0, 0.0047]], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]];

/// The error of every pixel, 0…1.
///
/// - `image`, `reference`: linear Rec. 709, finite, row by row; `[width × height]`.
/// - `exposure`: factor on both before they are clipped to 0…1.
///
/// The pictures are taken to be seen at `PIXELS_PER_DEGREE`.
pub fn error_map(
    image: &[[f64; 3]],
    reference: &[[f64; 3]],
    width: usize,
    height: usize,
    exposure: f64,
) -> Vec<f64> {
    let space = ColorSpace::rec_709();
    let [image, reference] =
        [image, reference].map(|colors| Opponent::new(&space, colors, width, height, exposure));
    let color = color_differences(&space, &image, &reference);
    let feature = feature_differences(&image, &reference);
    color.iter().zip(feature).map(|(&color, feature)| powf(color, 1.0 - feature)).collect()
}

/// Rec. 709 and its white in CIE XYZ.
struct ColorSpace {
    xyz_from_rgb: DMat3,
    rgb_from_xyz: DMat3,
    white: DVec3,
}

impl ColorSpace {
    /// From the primaries of ITU-R BT.709 and the white D65 with the chromaticity (0.31271, 0.32902) of CIE 15:2004.
    fn rec_709() -> Self {
        let xyz = |x: f64, y: f64| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
        let primaries = DMat3::from_cols(xyz(0.64, 0.33), xyz(0.3, 0.6), xyz(0.15, 0.06));
        let white = xyz(0.312_71, 0.329_02);
        let xyz_from_rgb = primaries * DMat3::from_diagonal(primaries.inverse() * white);
        Self { xyz_from_rgb, rgb_from_xyz: xyz_from_rgb.inverse(), white }
    }

    /// CIELAB with Hunt's adjustment: chroma fades with luminance. Source: Andersson 2020, §4.1.
    fn hunt_lab(&self, rgb: DVec3) -> DVec3 {
        // CIE 15:2004, §8.2.1.
        let f =
            |t: f64| if t > DELTA * DELTA * DELTA { cbrt(t) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
        const DELTA: f64 = 6.0 / 29.0;
        let xyz = self.xyz_from_rgb * rgb / self.white;
        let [x, y, z] = xyz.to_array().map(f);
        let lightness = 116.0 * y - 16.0;
        let hunt = 0.01 * lightness;
        DVec3::new(lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z))
    }
}

/// A picture in the linearized opponent space YCxCz: achromatic, red-green, blue-yellow.
struct Opponent {
    planes: [Plane; 3],
}

impl Opponent {
    /// Source: Andersson 2020, §4.1.
    fn new(space: &ColorSpace, colors: &[[f64; 3]], width: usize, height: usize, exposure: f64) -> Self {
        let mut planes = [0, 1, 2].map(|_| Plane::black(width, height));
        for (i, &rgb) in colors.iter().enumerate() {
            let rgb = (DVec3::from_array(rgb) * exposure).clamp(DVec3::ZERO, DVec3::ONE);
            let [x, y, z] = (space.xyz_from_rgb * rgb / space.white).to_array();
            let opponent = [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)];
            planes.iter_mut().zip(opponent).for_each(|(plane, value)| plane.values[i] = value);
        }
        Self { planes }
    }

    /// The picture as the eye blurs it, in adjusted CIELAB.
    fn seen(&self, space: &ColorSpace) -> Vec<DVec3> {
        let [y, cx, cz] = [0, 1, 2].map(|channel| blurred(&self.planes[channel], SENSITIVITY[channel]));
        let pixels = y.values.iter().zip(&cx.values).zip(&cz.values);
        let to_lab = |((y, cx), cz): ((&f64, &f64), &f64)| {
            let y = (y + 16.0) / 116.0;
            let xyz = DVec3::new(y + cx / 500.0, y, y - cz / 200.0) * space.white;
            space.hunt_lab((space.rgb_from_xyz * xyz).clamp(DVec3::ZERO, DVec3::ONE))
        };
        pixels.map(to_lab).collect()
    }
}

/// A plane under a sum of Gaussians a √(π/b) exp(-π² r² / b), r in degrees, normalized. Source: Andersson 2020, §4.1.
fn blurred(plane: &Plane, gaussians: &[[f64; 2]]) -> Plane {
    // Three standard deviations of the widest Gaussian of all, √(b / 2π²).
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let terms = gaussians.iter().map(|&[a, b]| {
        let kernel = Kernel::new(radius, |pixels| {
            let degrees = pixels / PIXELS_PER_DEGREE;
            exp(-PI * PI * degrees * degrees / b)
        });
        let amplitude = a * (PI / b).sqrt() * kernel.sum() * kernel.sum();
        (amplitude, plane.convolved(&kernel.normalized(), &kernel.normalized()))
    });
    let terms: Vec<(f64, Plane)> = terms.collect();
    let total: f64 = terms.iter().map(|(amplitude, _)| amplitude).sum();
    let mut sum = Plane::black(plane.width, plane.height);
    for (amplitude, term) in &terms {
        sum.values.iter_mut().zip(&term.values).for_each(|(sum, value)| *sum += amplitude / total * value);
    }
    sum
}

/// Color difference of every pixel, 0…1. Source: Andersson 2020, §4.1.
fn color_differences(space: &ColorSpace, image: &Opponent, reference: &Opponent) -> Vec<f64> {
    // The largest difference in the space is that of its green and its blue.
    let largest = powf(hyab(space.hunt_lab(DVec3::Y), space.hunt_lab(DVec3::Z)), COLOR_EXPONENT);
    let pairs = image.seen(space).into_iter().zip(reference.seen(space));
    pairs.map(|(a, b)| redistributed(powf(hyab(a, b), COLOR_EXPONENT), largest)).collect()
}

/// Distance in CIELAB for large differences: city block between lightness and chroma. Source: Andersson 2020, §4.1.
fn hyab(a: DVec3, b: DVec3) -> f64 {
    let d = a - b;
    d.x.abs() + (d.y * d.y + d.z * d.z).sqrt()
}

/// Errors below 40 % of the largest take 95 % of the scale. Source: Andersson 2020, §4.1.
fn redistributed(error: f64, largest: f64) -> f64 {
    const CUT: f64 = 0.4;
    const CUT_VALUE: f64 = 0.95;
    let cut = CUT * largest;
    if error < cut {
        CUT_VALUE / cut * error
    } else {
        CUT_VALUE + (error - cut) / (largest - cut) * (1.0 - CUT_VALUE)
    }
}

/// Difference in edges and points of every pixel, 0…1. Source: Andersson 2020, §4.2.
fn feature_differences(image: &Opponent, reference: &Opponent) -> Vec<f64> {
    let pairs = features(&image.planes[0]).into_iter().zip(features(&reference.planes[0]));
    let difference = |(a, b): ([f64; 2], [f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    pairs.map(|pair| powf(difference(pair) / 2.0_f64.sqrt(), FEATURE_EXPONENT)).collect()
}

/// Strength of edges and of points at every pixel of the achromatic plane.
fn features(achromatic: &Plane) -> Vec<[f64; 2]> {
    let mut plane = Plane::black(achromatic.width, achromatic.height);
    plane.values.iter_mut().zip(&achromatic.values).for_each(|(value, y)| *value = (y + 16.0) / 116.0);
    let sigma = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as usize;
    let gauss = |x: f64| exp(-x * x / (2.0 * sigma * sigma));
    let smooth = Kernel::new(radius, gauss).normalized();
    let magnitude = |detector: &Kernel| {
        let (dx, dy) = (plane.convolved(detector, &smooth), plane.convolved(&smooth, detector));
        let pairs = dx.values.into_iter().zip(dy.values);
        pairs.map(|(x, y)| (x * x + y * y).sqrt()).collect::<Vec<f64>>()
    };
    let edges = magnitude(&Kernel::new(radius, |x| -x * gauss(x)).sides_normalized());
    let points =
        magnitude(&Kernel::new(radius, |x| (x * x / (sigma * sigma) - 1.0) * gauss(x)).sides_normalized());
    edges.into_iter().zip(points).map(|(edge, point)| [edge, point]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(image: &[[f64; 3]], reference: &[[f64; 3]], width: usize) -> f64 {
        let map = error_map(image, reference, width, image.len() / width, 1.0);
        assert!(map.iter().all(|e| (0.0..=1.0 + 1e-12).contains(e)));
        map.iter().sum::<f64>() / map.len() as f64
    }

    /// A colored pattern with edges.
    fn pattern(shift: f64) -> Vec<[f64; 3]> {
        let at = |i: usize| ((i % 48) as f64, (i / 48) as f64);
        let stripe = |(x, y): (f64, f64)| if (x + y * 0.3) % 9.0 < 4.0 { 0.8 } else { 0.1 };
        let color =
            |p: (f64, f64)| [stripe(p) + shift * p.0 / 48.0, 0.02 * p.1, 0.4 + 0.5 * stripe(p) - shift];
        (0..48 * 32).map(|i| color(at(i))).collect()
    }

    #[test]
    fn equal_pictures_have_no_error() {
        assert_eq!(mean(&pattern(0.0), &pattern(0.0), 48), 0.0);
    }

    #[test]
    fn black_against_white_is_close_to_one() {
        let error = mean(&[[0.0; 3]; 400], &[[1.0; 3]; 400], 20);
        assert!((0.95..=1.0).contains(&error), "{error}");
    }

    #[test]
    fn green_against_blue_is_exactly_one() {
        let error = mean(&[[0.0, 1.0, 0.0]; 400], &[[0.0, 0.0, 1.0]; 400], 20);
        assert!((error - 1.0).abs() < 1e-9, "{error}");
    }

    #[test]
    fn error_is_symmetric_and_grows_with_the_difference() {
        let small = mean(&pattern(0.05), &pattern(0.0), 48);
        let large = mean(&pattern(0.2), &pattern(0.0), 48);
        assert!((mean(&pattern(0.0), &pattern(0.05), 48) - small).abs() < 1e-12);
        assert!(0.0 < small && 1.5 * small < large && large < 1.0, "{small}, {large}");
    }

    #[test]
    fn exposure_brings_out_dark_differences() {
        let (a, b) = (vec![[0.001; 3]; 100], vec![[0.002; 3]; 100]);
        let error = |exposure| error_map(&a, &b, 10, 10, exposure)[0];
        assert!(error(100.0) > 4.0 * error(1.0));
    }

    #[test]
    fn white_has_the_lightness_of_white() {
        let lab = ColorSpace::rec_709().hunt_lab(DVec3::ONE);
        assert!((lab - DVec3::new(100.0, 0.0, 0.0)).length() < 1e-9, "{lab}");
    }
}
