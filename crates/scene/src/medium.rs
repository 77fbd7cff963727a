//! What volumes are made of.

use crate::{Located, Rgb};
use serde::Serialize;

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
    /// Where solids overlap, the highest priority wins.
    pub priority: i32,
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
    /// Mean cosine of the Henyey-Greenstein phase function, -1…1 exclusive.
    pub g: f32,
}
