//! Spectra as linear Rec. 709 colors.
//!
//! What shines is seen as it is: spectral values per nm times the color matching functions. What is a factor on light
//! (a reflectance, a coefficient) is seen in D65, so that a constant one is a grey.

use hyaline_math::float::f64::exp;
use hyaline_scene::Rgb;

/// What the values of a spectrum are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Light, per nm.
    Light,
    /// A factor on light, or a coefficient.
    Factor,
}

/// First wavelength of the integrals, nm.
const FIRST: f64 = 380.0;
/// Distance of their wavelengths, nm, and how many they are.
const STEP: f64 = 2.0;
const STEPS: usize = 201;

/// Relative power of daylight D65 from 380 nm on, every 10 nm. Source: ISO/CIE 11664-2:2022, table 1.
const D65: [f64; 41] = [
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
    108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
    74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828,
];

/// A spectrum of (wavelength in nm, value), straight between them and 0 beyond.
pub(super) fn color_of(samples: &[(f64, f64)], meaning: Meaning) -> Rgb {
    let value = |wavelength: f64| {
        let next = samples.partition_point(|(at, _)| *at < wavelength);
        match (next.checked_sub(1).and_then(|last| samples.get(last)), samples.get(next)) {
            (_, Some((at, value))) if *at == wavelength => *value,
            (Some((a, from)), Some((b, to))) => from + (to - from) * (wavelength - a) / (b - a),
            _ => 0.0,
        }
    };
    match meaning {
        Meaning::Light => light(value),
        Meaning::Factor => {
            let daylight = |wavelength: f64| interpolated(&D65, (wavelength - FIRST) / 10.0);
            let (seen, white) = (light(|at| daylight(at) * value(at)), light(daylight));
            std::array::from_fn(|i| seen[i] / white[i])
        }
    }
}

/// The radiance of a black body, W sr⁻¹ m⁻² nm⁻¹, times `scale`.
///
/// - `temperature`: K, > 0.
///
/// Source: Planck's law with the constants of CODATA 2018.
pub(super) fn black_body(temperature: f64, scale: f64) -> Rgb {
    const H: f64 = 6.626_070_15e-34;
    const C: f64 = 299_792_458.0;
    const K: f64 = 1.380_649e-23;
    light(|nanometres| {
        let wavelength = nanometres * 1e-9;
        let exponent = (H * C / (wavelength * K * temperature)).min(700.0);
        let square = wavelength * wavelength;
        // Per metre of wavelength; 1e-9 of that per nm.
        scale * 1e-9 * 2.0 * H * C * C / (square * square * wavelength * (exp(exponent) - 1.0))
    })
}

/// Linear Rec. 709 of light per nm, negative parts cut; luminance is the mean weighed by the eye's sensitivity.
///
/// Source: ITU-R BT.709-6, §1 (primaries and white) for the matrix.
fn light(spectrum: impl Fn(f64) -> f64) -> Rgb {
    let (mut xyz, mut unit) = ([0.0; 3], 0.0);
    for i in 0..STEPS {
        let wavelength = FIRST + STEP * i as f64;
        let (matching, value) = (matching(wavelength), spectrum(wavelength));
        unit += matching[1];
        xyz = std::array::from_fn(|j| xyz[j] + matching[j] * value);
    }
    let [x, y, z] = xyz.map(|sum| sum / unit);
    let rgb = [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266_0 * x + 1.876_010_8 * y + 0.041_556_0 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ];
    rgb.map(|value| value.max(0.0) as f32)
}

/// The CIE 1931 color matching functions at a wavelength in nm.
///
/// Source: Wyman, Sloan & Shirley, Simple Analytic Approximations to the CIE XYZ Color Matching Functions, JCGT 2(2),
/// 2013, eq. 4.
fn matching(wavelength: f64) -> [f64; 3] {
    let lobe = |height: f64, center: f64, below: f64, above: f64| {
        let t = (wavelength - center) / if wavelength < center { below } else { above };
        height * exp(-0.5 * t * t)
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

fn interpolated(table: &[f64], position: f64) -> f64 {
    let index = (position as usize).min(table.len() - 2);
    let fraction = position - index as f64;
    table[index] + (table[index + 1] - table[index]) * fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Rgb, b: Rgb, error: f32) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= error)
    }

    #[test]
    fn a_constant_factor_is_a_grey() {
        let flat = [(300.0, 0.4), (900.0, 0.4)];
        assert!(close(color_of(&flat, Meaning::Factor), [0.4; 3], 1e-6));
    }

    #[test]
    fn daylight_is_white_and_equal_energy_is_reddish() {
        let daylight: Vec<_> = D65.iter().enumerate().map(|(i, v)| (FIRST + 10.0 * i as f64, *v)).collect();
        let [r, g, b] = color_of(&daylight, Meaning::Light);
        assert!(close([r / g, 1.0, b / g], [1.0; 3], 0.02), "{r} {g} {b}");
        // Illuminant E in linear Rec. 709, from its XYZ of (1, 1, 1).
        let equal = color_of(&[(300.0, 2.0), (900.0, 2.0)], Meaning::Light).map(|value| value / 2.0);
        assert!(close(equal, [1.2048, 0.9483, 0.9089], 0.01), "{equal:?}");
    }

    #[test]
    fn a_band_of_long_waves_is_red() {
        let [r, g, b] = color_of(&[(599.0, 0.0), (600.0, 1.0), (700.0, 1.0), (701.0, 0.0)], Meaning::Factor);
        assert!(r > 0.5 && g < 0.1 && b < 0.05, "{r} {g} {b}");
    }

    #[test]
    fn black_bodies_have_their_radiance_and_color() {
        // CIE: a Planckian radiator of 6504 K lies at x = 0.3135, y = 0.3237: close to white, a little pinkish.
        let [r, g, b] = black_body(6504.0, 1.0);
        assert!(close([r / g, 1.0, b / g], [1.04, 1.0, 1.02], 0.04), "{r} {g} {b}");
        // Planck's law at 555 nm and 5000 K: 1.2 kW per sr, cm² and µm, as tables have it.
        let luminance = |[r, g, b]: Rgb| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let warm = black_body(5000.0, 1e-3);
        assert!((luminance(warm) - 12.0).abs() < 0.6, "{warm:?}");
        assert!(warm[0] > 1.5 * warm[2], "{warm:?}");
    }
}
