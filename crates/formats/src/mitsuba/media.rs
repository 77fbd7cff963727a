//! Media: volumes of the file joined with indices of refraction.

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{
    Absorption, IndexDescription, Located, MediumDescription, PhaseDescription, Rgb, Scattering, Source,
};

/// A volume of the file: what it swallows and scatters, without an index.
#[derive(Clone, Debug)]
pub(super) struct Volume {
    name: String,
    absorption: Absorption,
    scattering: Option<Scattering>,
}

/// The media made so far.
#[derive(Debug, Default)]
pub(super) struct Media {
    volumes: Vec<Volume>,
    made: Vec<(Option<usize>, f64, String)>,
}

impl Importer<'_> {
    /// Number of a volume; those of equal content are one.
    pub(super) fn volume(&mut self, element: Element<'_>, owner: &str) -> Result<Option<usize>> {
        if element.kind() != "homogeneous" {
            element.warn(format!("{} can't be read; it is taken as empty", element.title()));
            element.ignore_all();
            return Ok(None);
        }
        let (absorption, scattering) = coefficients(element)?;
        let same = |volume: &Volume| volume.absorption == absorption && volume.scattering == scattering;
        if let Some(index) = self.media.volumes.iter().position(same) {
            return Ok(Some(index));
        }
        let name = element.id().map_or_else(|| format!("{owner}/medium"), str::to_owned);
        self.media.volumes.push(Volume { name, absorption, scattering });
        Ok(Some(self.media.volumes.len() - 1))
    }

    /// Name of the medium of a side: its volume with its index. `None` is the world's: no volume, index 1.
    pub(super) fn medium(
        &mut self,
        volume: Option<usize>,
        index: f64,
        source: &Source,
    ) -> Option<Located<String>> {
        if volume.is_none() && index == 1.0 {
            return None;
        }
        let made = self.media.made.iter().find(|(v, i, _)| (*v, *i) == (volume, index));
        if let Some((_, _, name)) = made {
            return Some(Located::new(name.clone(), source.clone()));
        }
        let (base, absorption, scattering) = match volume.map(|volume| self.media.volumes[volume].clone()) {
            Some(volume) => (volume.name, volume.absorption, volume.scattering),
            None => (format!("index {index}"), Absorption::None, None),
        };
        let mut name = base.clone();
        if self.scene.media.iter().any(|medium| medium.name == name) {
            name = format!("{base} @ {index}");
        }
        while self.scene.media.iter().any(|medium| medium.name == name) {
            name.push('\'');
        }
        let medium = MediumDescription {
            absorption,
            scattering,
            ..MediumDescription::clear(name.clone(), IndexDescription::Constant(index))
        };
        self.scene.media.push(Located::new(medium, source.clone()));
        self.media.made.push((volume, index, name.clone()));
        Some(Located::new(name, source.clone()))
    }

    /// The medium of a volume that was named without an index: the only index it was used with, else 1.
    pub(super) fn medium_of_volume(
        &mut self,
        volume: Option<usize>,
        source: &Source,
    ) -> Option<Located<String>> {
        let mut indices = self.media.made.iter().filter(|(v, _, _)| *v == volume).map(|(_, index, _)| *index);
        let index = match (volume, indices.next(), indices.next()) {
            (Some(_), Some(only), None) => only,
            _ => 1.0,
        };
        self.medium(volume, index, source)
    }

    /// The world is filled with air where boundaries say so and none says vacuum: 1.000277 is Mitsuba's default.
    pub(super) fn settle_surrounding(&mut self) {
        let is_air = |index: f64| index > 1.0 && index < 1.001;
        let airs = self.media.made.iter().filter(|(volume, index, _)| volume.is_none() && is_air(*index));
        let airs: Vec<&String> = airs.map(|(_, _, name)| name).collect();
        if let ([air], false) = (airs.as_slice(), self.world_is_vacuum) {
            self.scene.surrounding = Some((*air).as_str().into());
        }
    }
}

/// Absorption and scattering: `sigma_t` and `albedo`, or `sigma_a` and `sigma_s`; `scale` multiplies them.
fn coefficients(element: Element<'_>) -> Result<(Absorption, Option<Scattering>)> {
    let scale = element.float("scale", 1.0, Limits::NOT_NEGATIVE)? as f32;
    let sigma_a = spectrum(element, "sigma_a", Limits::NOT_NEGATIVE)?;
    let sigma_s = spectrum(element, "sigma_s", Limits::NOT_NEGATIVE)?;
    let sigma_t = spectrum(element, "sigma_t", Limits::NOT_NEGATIVE)?;
    let albedo = spectrum(element, "albedo", Limits::FRACTION)?;
    if let Some(material) = element.string("material")? {
        let message =
            format!("the medium preset '{}' is not known; sigma_t and albedo count", material.value);
        element.notes.warn(&material.source, message);
    }
    let (sigma_a, sigma_s) = if sigma_a.is_some() || sigma_s.is_some() {
        (sigma_a.unwrap_or_default(), sigma_s.unwrap_or_default())
    } else {
        let (sigma_t, albedo) = (sigma_t.unwrap_or([1.0; 3]), albedo.unwrap_or([0.75; 3]));
        let product = |factor: &dyn Fn(f32) -> f32| std::array::from_fn(|i| sigma_t[i] * factor(albedo[i]));
        (product(&|albedo| 1.0 - albedo), product(&|albedo| albedo))
    };
    let (sigma_a, sigma_s) = (sigma_a.map(|s: f32| s * scale), sigma_s.map(|s: f32| s * scale));
    if sigma_a.iter().chain(&sigma_s).any(|value| !value.is_finite()) {
        return Err(element.error("the coefficients of the medium are too large"));
    }
    let g = phase(element)?;
    let absorption = if sigma_a == [0.0; 3] { Absorption::None } else { Absorption::SigmaA(sigma_a) };
    Ok((
        absorption,
        (sigma_s != [0.0; 3]).then_some(Scattering { sigma_s, phase: PhaseDescription::from_mean_cosine(g) }),
    ))
}

/// A coefficient, which may be wrapped into a constant volume.
fn spectrum(element: Element<'_>, name: &str, limits: Limits) -> Result<Option<Rgb>> {
    if let Some(color) = element.color(name, limits)? {
        return Ok(Some(color));
    }
    match element.child_named("texture", name)? {
        Some(volume) if volume.kind() == "constvolume" => volume.color("value", limits),
        Some(volume) => {
            volume.ignore_all();
            volume.warn(format!("`{name}` as {} can't be read; its default counts", volume.title()));
            Ok(None)
        }
        None => Ok(None),
    }
}

/// Mean cosine of the phase function.
fn phase(element: Element<'_>) -> Result<f32> {
    let Some(phase) = element.child("phase")? else { return Ok(0.0) };
    match phase.kind() {
        "hg" => Ok(phase.float("g", 0.8, Limits::inside(-1.0, 1.0))? as f32),
        "isotropic" => Ok(0.0),
        _ => {
            phase.ignore_all();
            phase.warn(format!("{} is replaced by an isotropic one", phase.title()));
            Ok(0.0)
        }
    }
}
