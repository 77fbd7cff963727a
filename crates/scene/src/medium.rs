//! What volumes are made of.

use crate::{Located, Rgb};
use hyaline_math::Transform;
use serde::{Serialize, Serializer};
use std::sync::Arc;

/// Everything about a volume.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MediumDescription {
    /// Name that objects refer to.
    pub name: String,
    /// Index of refraction.
    pub index: IndexDescription,
    /// What it swallows.
    pub absorption: Absorption,
    /// What it scatters.
    pub scattering: Option<Scattering>,
    /// Light that it sends out by itself, W sr⁻¹ m⁻³.
    pub emission: Rgb,
    /// Where it is how dense; `None` is density 1 everywhere.
    pub density: Option<DensityGrid>,
    /// Where solids overlap, the highest priority wins.
    pub priority: i32,
}

impl MediumDescription {
    /// A medium that neither swallows nor scatters.
    pub fn clear(name: impl Into<String>, index: IndexDescription) -> Self {
        Self {
            name: name.into(),
            index,
            absorption: Absorption::None,
            scattering: None,
            emission: [0.0; 3],
            density: None,
            priority: 0,
        }
    }
}

/// An index of refraction, as given.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum IndexDescription {
    /// The same at all wavelengths.
    Constant(f64),
    /// From the catalogue.
    Named(Located<String>),
    /// Index at the d line and Abbe number.
    Abbe {
        /// Index at 587.6 nm.
        nd: f64,
        /// V_d = (n_d - 1) / (n_F - n_C).
        abbe: f64,
    },
    /// n = a + b / λ² + c / λ⁴, λ in micrometres.
    Cauchy {
        /// Constant term.
        a: f64,
        /// µm².
        b: f64,
        /// µm⁴.
        c: f64,
    },
    /// n² = 1 + Σ b λ² / (λ² - c), λ in micrometres.
    Sellmeier {
        /// Strengths.
        b: [f64; 3],
        /// Squared resonances, µm².
        c: [f64; 3],
    },
}

/// Absorption in one of its three spellings.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub enum Absorption {
    /// Clear.
    #[default]
    None,
    /// Filter color c_f per scene unit, 0 < c_f ≤ 1.
    Filter(Rgb),
    /// Absorption coefficient, 1 / scene unit.
    SigmaA(Rgb),
    /// Color left after a distance.
    ColorAt {
        /// Transmittance at `distance`, 0 < c ≤ 1.
        color: Rgb,
        /// Distance, scene units, > 0; may be infinite.
        distance: f64,
    },
}

/// Scattering in a volume.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scattering {
    /// Scattering coefficient, 1 / scene unit.
    pub sigma_s: Rgb,
    /// Where scattered light goes.
    pub phase: PhaseDescription,
}

/// Phase functions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub enum PhaseDescription {
    /// Alike in all directions.
    #[default]
    Isotropic,
    /// Henyey and Greenstein's.
    HenyeyGreenstein {
        /// Mean cosine, -1…1 exclusive; positive scatters forward.
        g: f32,
    },
    /// Of particles much smaller than the wavelength.
    Rayleigh,
    /// Two of Henyey and Greenstein's together.
    DoubleHenyeyGreenstein {
        /// Mean cosine of the first, -1…1 exclusive.
        g1: f32,
        /// Mean cosine of the second, -1…1 exclusive.
        g2: f32,
        /// Share of the second, 0…1.
        weight: f32,
    },
}

impl PhaseDescription {
    /// Henyey and Greenstein's of this mean cosine; isotropic where it is 0.
    pub fn from_mean_cosine(g: f32) -> Self {
        if g == 0.0 { Self::Isotropic } else { Self::HenyeyGreenstein { g } }
    }

    /// Mean cosine of the scattering angle, -1…1.
    pub fn mean_cosine(&self) -> f32 {
        match *self {
            Self::Isotropic | Self::Rayleigh => 0.0,
            Self::HenyeyGreenstein { g } => g,
            Self::DoubleHenyeyGreenstein { g1, g2, weight } => g1 + weight * (g2 - g1),
        }
    }

    /// The scattering coefficient of which a *reduced* one is the measure: light that scatters so goes as far as with
    /// `reduced` and no preferred direction.
    pub fn unreduced(&self, reduced: Rgb) -> Rgb {
        reduced.map(|sigma| sigma / (1.0 - self.mean_cosine()))
    }
}

/// A factor on absorption, scattering and emission that varies over space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DensityGrid {
    /// Densities, ≥ 0; trilinear between the centers of the cells, 0 outside of the grid.
    pub density: Arc<GridData>,
    /// Scattering albedo by place, 0…1; `None` is that of the coefficients everywhere.
    pub albedo: Option<Arc<GridData>>,
    /// Grid space, the unit cube, to world.
    pub placement: Transform,
}

/// Numbers on a regular grid that fills the unit cube.
#[derive(Clone, Debug, PartialEq)]
pub struct GridData {
    /// Cells along x, y and z, ≥ 1 each.
    pub size: [u32; 3],
    /// 1, or 3 for linear Rec. 709 colors.
    pub channels: u32,
    /// `size.x × size.y × size.z × channels` numbers: channels together, then x, then y, then z.
    pub values: Vec<f32>,
}

/// Serializes as a digest of size and content.
impl Serialize for GridData {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut hasher = blake3::Hasher::new();
        for number in self.size.iter().chain([&self.channels]) {
            hasher.update(&number.to_le_bytes());
        }
        hasher.update(bytemuck::cast_slice(&self.values));
        hasher.finalize().as_bytes().serialize(serializer)
    }
}
