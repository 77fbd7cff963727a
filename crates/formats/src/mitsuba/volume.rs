//! `<medium>`: what a volume swallows, scatters and sends out, the same everywhere or by a grid.
//!
//! A coefficient or an albedo is a field: one color, or a grid with its placement. One grid of `sigma_t` becomes the
//! density, its hue part of the coefficients; a grid of albedos goes with it where both are placed alike.

use super::element::Element;
use super::field::{self, Field};
use super::importer::Importer;
use super::phase;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::Transform;
use hyaline_scene::measured::{self, Measured};
use hyaline_scene::{
    Absorption, DensityGrid, GridData, MediumDescription, PhaseDescription, Rgb, Scattering,
};
use std::sync::Arc;

/// A volume of the file: everything about a medium but its index.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Volume {
    /// What scenes and messages call it.
    pub(super) name: String,
    absorption: Absorption,
    scattering: Option<Scattering>,
    emission: Rgb,
    density: Option<DensityGrid>,
}

impl Volume {
    /// Whether the two are alike but for their names.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.absorption == other.absorption
            && self.scattering == other.scattering
            && self.emission == other.emission
            && self.density == other.density
    }

    /// The medium of this volume, with the name and index of `clear`.
    pub(super) fn with_index_of(&self, clear: MediumDescription) -> MediumDescription {
        MediumDescription {
            absorption: self.absorption.clone(),
            scattering: self.scattering.clone(),
            emission: self.emission,
            density: self.density.clone(),
            ..clear
        }
    }
}

/// What a medium says of its coefficients, before `scale`.
#[allow(clippy::large_enum_variant, reason = "there is one at a time")]
enum Coefficients {
    /// Absorption and scattering, each by itself.
    Apart(Rgb, Rgb),
    /// Extinction, and the share of it that scatters.
    Together {
        /// Extinction coefficient.
        sigma_t: Field,
        /// Albedo, 0…1.
        albedo: Field,
    },
}

impl Importer<'_> {
    /// Reads a medium; `None`, with a warning, where its type is unknown.
    pub(super) fn read_volume(&mut self, medium: Element<'_>, name: String) -> Result<Option<Volume>> {
        if !matches!(medium.kind(), "homogeneous" | "heterogeneous") {
            medium.warn(format!("{} can't be read; it is taken as empty", medium.title()));
            medium.ignore_all();
            return Ok(None);
        }
        // How Mitsuba samples the medium; it changes nothing of what there is.
        medium.ignore(&["method", "step_size", "strategy", "sample_emitters", "has_spectral_extinction"]);
        medium.ignore(&["max_density", "majorant_resolution_factor", "majorant_factor"]);
        let scale = medium.float("scale", 1.0, Limits::NOT_NEGATIVE)? as f32;
        let phase = phase::read(medium)?;
        let coefficients = self.coefficients(medium, &phase)?;
        let emission = self.field(medium, "emission", Limits::NOT_NEGATIVE)?;
        let (sigma_a, sigma_s, density) = match coefficients {
            Coefficients::Apart(sigma_a, sigma_s) => (sigma_a, sigma_s, None),
            Coefficients::Together { sigma_t, albedo } => {
                let (sigma_t, albedo, density) = resolve(medium, sigma_t, albedo);
                let split = |share: &dyn Fn(f32) -> f32| -> Rgb {
                    std::array::from_fn(|i| sigma_t[i] * share(albedo[i]))
                };
                (split(&|albedo| 1.0 - albedo), split(&|albedo| albedo), density)
            }
        };
        let (sigma_a, sigma_s) = (sigma_a.map(|s| s * scale), sigma_s.map(|s| s * scale));
        let emission = constant_emission(medium, emission, density.as_ref());
        if sigma_a.iter().chain(&sigma_s).any(|value| !value.is_finite()) {
            return Err(medium.error("the coefficients of the medium are too large"));
        }
        let absorption = if sigma_a == [0.0; 3] { Absorption::None } else { Absorption::SigmaA(sigma_a) };
        let scattering = (sigma_s != [0.0; 3]).then_some(Scattering { sigma_s, phase });
        if scattering.is_none() && phase != PhaseDescription::Isotropic {
            medium.info(format!("{} scatters nothing; its phase function has no effect", medium.title()));
        }
        Ok(Some(Volume { name, absorption, scattering, emission, density }))
    }

    /// `sigma_a` and `sigma_s`, a `material` by name, or `sigma_t` (`density` in old files) and `albedo`.
    ///
    /// - `phase`: what a `material` scatters by.
    fn coefficients(&mut self, medium: Element<'_>, phase: &PhaseDescription) -> Result<Coefficients> {
        let sigma_a = medium.color("sigma_a", Limits::NOT_NEGATIVE)?;
        let sigma_s = medium.color("sigma_s", Limits::NOT_NEGATIVE)?;
        if sigma_a.is_some() || sigma_s.is_some() {
            return Ok(Coefficients::Apart(sigma_a.unwrap_or_default(), sigma_s.unwrap_or_default()));
        }
        let sigma_t = match self.field(medium, "sigma_t", Limits::NOT_NEGATIVE)? {
            None => self.field(medium, "density", Limits::NOT_NEGATIVE)?,
            some => some,
        };
        let albedo = self.field(medium, "albedo", Limits::FRACTION)?;
        let material = medium.string("material")?;
        // Version 0.5 takes this skin where a medium says nothing.
        let says_nothing = self.is_old && sigma_t.is_none() && albedo.is_none();
        let name = material.as_ref().map(|name| name.as_str()).or(says_nothing.then_some("skin1"));
        if let Some(name) = name {
            // In 1/mm: `scale` of the medium turns them into 1 / scene unit.
            if let Some(Measured { sigma_s, sigma_a, .. }) = measured::by_name(name).copied() {
                return Ok(Coefficients::Apart(sigma_a, phase.unreduced(sigma_s)));
            }
            medium.warn(format!("the medium material '{name}' is not known; sigma_t and albedo count"));
        }
        Ok(Coefficients::Together {
            sigma_t: sigma_t.unwrap_or(Field::Constant([1.0; 3])),
            albedo: albedo.unwrap_or(Field::Constant([0.75; 3])),
        })
    }
}

/// Constant coefficients, and the grid that they are multiplied by.
fn resolve(medium: Element<'_>, sigma_t: Field, albedo: Field) -> (Rgb, Rgb, Option<DensityGrid>) {
    match (sigma_t, albedo) {
        (Field::Constant(sigma_t), Field::Constant(albedo)) => (sigma_t, albedo, None),
        (Field::Grid { data, placement }, Field::Constant(albedo)) => {
            let (hue, density) = density_of(medium, &data);
            (hue, albedo, Some(DensityGrid { density, albedo: None, placement }))
        }
        (Field::Constant(sigma_t), Field::Grid { data, placement }) => {
            let one = Arc::new(GridData { size: [1; 3], channels: 1, values: vec![1.0] });
            let mean = field::mean(&data);
            (sigma_t, mean, Some(DensityGrid { density: one, albedo: Some(data), placement }))
        }
        (Field::Grid { data, placement }, Field::Grid { data: albedo, placement: other }) => {
            let (hue, density) = density_of(medium, &data);
            let mean = field::mean(&albedo);
            let albedo = if is_same_place(&placement, &other) {
                Some(albedo)
            } else {
                medium.warn("the grid of `albedo` lies elsewhere than that of `sigma_t`; its mean counts");
                None
            };
            (hue, mean, Some(DensityGrid { density, albedo, placement }))
        }
    }
}

fn is_same_place(a: &Transform, b: &Transform) -> bool {
    let difference = (a.linear() - b.linear()).to_cols_array().iter().map(|d| d.abs()).fold(0.0, f64::max);
    let size = a.linear().to_cols_array().iter().map(|d| d.abs()).fold(0.0, f64::max);
    difference.max((a.translation() - b.translation()).abs().max_element()) <= 1e-6 * size
}

/// One number per cell, and the color that all of them are multiplied by.
fn density_of(medium: Element<'_>, data: &Arc<GridData>) -> (Rgb, Arc<GridData>) {
    if data.channels == 1 {
        return ([1.0; 3], data.clone());
    }
    let mean = field::mean(data);
    let grey = (mean[0] + mean[1] + mean[2]) / 3.0;
    if grey <= 0.0 {
        return (
            [1.0; 3],
            Arc::new(GridData { channels: 1, values: vec![0.0; data.values.len() / 3], ..**data }),
        );
    }
    let hue = mean.map(|value| value / grey);
    let values: Vec<f32> = data.values.chunks_exact(3).map(|cell| cell.iter().sum::<f32>() / 3.0).collect();
    let strays = |(cell, density): (&[f32], &f32)| {
        cell.iter().zip(hue).any(|(value, hue)| (value - hue * density).abs() > 0.01 * density * hue.max(1.0))
    };
    if data.values.chunks_exact(3).zip(&values).any(strays) {
        medium.warn("the grid of `sigma_t` has cells of different hues; all take the mean of them");
    }
    (hue, Arc::new(GridData { channels: 1, values, ..**data }))
}

/// Emission as one color, which the density multiplies.
fn constant_emission(medium: Element<'_>, emission: Option<Field>, density: Option<&DensityGrid>) -> Rgb {
    match (emission, density) {
        (None, _) => [0.0; 3],
        (Some(Field::Constant(color)), None) => color,
        (Some(Field::Constant(color)), Some(_)) => {
            if color != [0.0; 3] {
                medium.warn("`emission` of a medium with a grid follows its density");
            }
            color
        }
        (Some(Field::Grid { data, placement }), Some(density))
            if Arc::ptr_eq(&data, &density.density) && is_same_place(&placement, &density.placement) =>
        {
            [1.0; 3]
        }
        (Some(Field::Grid { data, .. }), _) => {
            medium.warn("a grid of `emission` other than that of `sigma_t` is replaced by its mean");
            field::mean(&data)
        }
    }
}
