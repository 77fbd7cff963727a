//! Weights of photons by their distance, each divided by its mean, so that an even field of photons gives the same
//! estimate with all of them.
//!
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, §7.2, with norms corrected: the Gaussian filter
//! as printed there does not keep energy.

use hyaline_math::float;
use hyaline_scene::PhotonKernel;
use std::f32::consts::PI;

/// Weight of a photon by its distance from the place of an estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kernel {
    /// The same for all.
    Constant,
    /// 1 - d / (k r).
    Cone {
        /// Slope, ≥ 1.
        k: f32,
    },
    /// Jensen's Gaussian filter.
    Gaussian,
    /// 1 - d² / r².
    Epanechnikov,
}

/// Height of the Gaussian filter.
const GAUSSIAN_A: f32 = 0.918;

/// Steepness of the Gaussian filter.
const GAUSSIAN_B: f32 = 1.953;

/// e^-b.
const GAUSSIAN_EDGE: f32 = 0.141_847_98;

/// Mean of the Gaussian filter over a disc: a (1 - (1 - 2 (1 - e^(-b/2)) / b) / (1 - e^-b)).
const GAUSSIAN_DISC_MEAN: f32 = 0.531_154_93;

/// Mean of the Gaussian filter over a ball, by quadrature.
const GAUSSIAN_BALL_MEAN: f32 = 0.463_939_68;

impl From<PhotonKernel> for Kernel {
    fn from(kernel: PhotonKernel) -> Self {
        match kernel {
            PhotonKernel::Constant => Self::Constant,
            PhotonKernel::Cone { k } => Self::Cone { k },
            PhotonKernel::Gaussian => Self::Gaussian,
            PhotonKernel::Epanechnikov => Self::Epanechnikov,
        }
    }
}

impl Kernel {
    /// Weight before it is divided by its mean, 0…1.
    ///
    /// - `d2`: distance of the photon squared, 0…`r2`.
    /// - `r2`: radius squared, > 0.
    #[inline]
    pub fn weight(self, d2: f32, r2: f32) -> f32 {
        let ratio = d2 / r2;
        match self {
            Self::Constant => 1.0,
            Self::Cone { k } => 1.0 - ratio.sqrt() / k,
            Self::Gaussian => {
                let fall = 1.0 - float::exp(-0.5 * GAUSSIAN_B * ratio);
                GAUSSIAN_A * (1.0 - fall / (1.0 - GAUSSIAN_EDGE))
            }
            Self::Epanechnikov => 1.0 - ratio,
        }
    }

    /// Factor on a sum of weights in a disc, m⁻²: 1 over the area and the mean weight.
    ///
    /// - `r2`: radius squared, > 0.
    pub fn disc_norm(self, r2: f32) -> f32 {
        1.0 / (self.disc_mean() * PI * r2)
    }

    /// Factor on a sum of weights in a ball, m⁻³: 1 over the volume and the mean weight.
    ///
    /// - `r2`: radius squared, > 0.
    pub fn ball_norm(self, r2: f32) -> f32 {
        1.0 / (self.ball_mean() * (4.0 / 3.0) * PI * (r2 * r2.sqrt()))
    }

    /// Share of the weight in a ball that lies within a fraction of its radius, 0…1.
    ///
    /// - `x`: the fraction, 0…1.
    pub fn ball_share(self, x: f32) -> f32 {
        // ∫ w 3 s² ds from 0 to x.
        let sum = match self {
            Self::Constant => x * x * x,
            Self::Cone { k } => x * x * x * (1.0 - 0.75 * x / k),
            Self::Gaussian => gaussian_sum(x),
            Self::Epanechnikov => x * x * x * (1.0 - 0.6 * x * x),
        };
        sum / self.ball_mean()
    }

    /// Mean weight over a disc.
    fn disc_mean(self) -> f32 {
        match self {
            Self::Constant => 1.0,
            Self::Cone { k } => 1.0 - 2.0 / (3.0 * k),
            Self::Gaussian => GAUSSIAN_DISC_MEAN,
            Self::Epanechnikov => 0.5,
        }
    }

    /// Mean weight over a ball.
    fn ball_mean(self) -> f32 {
        match self {
            Self::Constant => 1.0,
            Self::Cone { k } => 1.0 - 3.0 / (4.0 * k),
            Self::Gaussian => GAUSSIAN_BALL_MEAN,
            Self::Epanechnikov => 0.4,
        }
    }
}

/// ∫ w 3 s² ds from 0 to x of the Gaussian filter, by the series of its exponential.
fn gaussian_sum(x: f32) -> f32 {
    let (mut factor, mut sum) = (1.0, 0.0);
    for n in 0..10 {
        sum += factor * 3.0 / (2 * n + 3) as f32;
        factor *= -0.5 * GAUSSIAN_B * x * x / (n + 1) as f32;
    }
    x * x * x * GAUSSIAN_A * (sum - GAUSSIAN_EDGE) / (1.0 - GAUSSIAN_EDGE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::integrate;

    const KERNELS: [Kernel; 6] = [
        Kernel::Constant,
        Kernel::Cone { k: 1.0 },
        Kernel::Cone { k: 1.1 },
        Kernel::Cone { k: 3.0 },
        Kernel::Gaussian,
        Kernel::Epanechnikov,
    ];

    #[test]
    fn weights_and_norms_make_one_on_discs_and_in_balls() {
        let pi = f64::from(PI);
        for kernel in KERNELS {
            for r in [0.01_f64, 1.0, 30.0] {
                let r2 = (r * r) as f32;
                let weight = |d: f64| f64::from(kernel.weight((d * d) as f32, r2));
                let disc = integrate(|d| 2.0 * pi * d * weight(d), 0.0, r, 200);
                let ball = integrate(|d| 4.0 * pi * d * d * weight(d), 0.0, r, 200);
                assert!((disc * f64::from(kernel.disc_norm(r2)) - 1.0).abs() < 1e-5, "{kernel:?} {r}");
                assert!((ball * f64::from(kernel.ball_norm(r2)) - 1.0).abs() < 1e-5, "{kernel:?} {r}");
                let inner = integrate(|d| 4.0 * pi * d * d * weight(d), 0.0, 0.6 * r, 200);
                let share = f64::from(kernel.ball_share(0.6));
                assert!((inner / ball - share).abs() < 1e-5, "{kernel:?} {r}: {share}");
                assert!((kernel.ball_share(1.0) - 1.0).abs() < 1e-5, "{kernel:?}");
            }
        }
    }

    #[test]
    fn mean_weights_are_the_known_ones() {
        let b = f64::from(GAUSSIAN_B);
        let edge = |x: f64| 1.0 - f64::from(float::exp(-x as f32));
        let by_formula = f64::from(GAUSSIAN_A) * (1.0 - (1.0 - 2.0 * edge(b / 2.0) / b) / edge(b));
        assert!((f64::from(Kernel::Gaussian.disc_mean()) - by_formula).abs() < 1e-6);
        assert!((1.0 - f64::from(GAUSSIAN_EDGE) - edge(b)).abs() < 1e-7);
        assert_eq!(Kernel::Gaussian.disc_mean(), 0.531_154_93);
        assert_eq!(Kernel::Gaussian.ball_mean(), 0.463_939_68);
        assert_eq!(Kernel::Cone { k: 1.0 }.ball_mean(), 0.25);
        assert!((Kernel::Cone { k: 2.0 }.disc_mean() - 2.0 / 3.0).abs() < 1e-7);
    }

    #[test]
    fn weights_fall_with_distance_and_are_never_negative() {
        for kernel in KERNELS {
            let weights: Vec<f32> = (0..=100).map(|i| kernel.weight(i as f32 * 0.04, 4.0)).collect();
            assert!(weights.windows(2).all(|pair| pair[0] >= pair[1]), "{kernel:?}");
            assert!(weights.iter().all(|weight| (-1e-6..=1.0).contains(weight)), "{kernel:?}");
        }
    }
}
