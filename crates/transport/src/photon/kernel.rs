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
