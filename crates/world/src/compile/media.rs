//! Media: from names and colors to indices and coefficients in lanes.

use super::names::nearest;
use hyaline_optics::attenuation;
use hyaline_optics::dispersion::{Abbe, Cauchy, IndexModel, Sellmeier};
use hyaline_scattering::Medium;
use hyaline_scene::{Absorption, IndexDescription, Located, MediumDescription, Note, Rgb, SceneError};
use hyaline_spectrum::{Spectrum, catalogue};

/// Compiles a medium.
///
/// # Errors
/// An index name that the catalogue lacks, coefficients that cannot be.
pub(super) fn compile(
    description: &Located<MediumDescription>,
    notes: &mut Vec<Note>,
) -> Result<Medium, SceneError> {
    let ior = index(description)?;
    if !(ior.is_finite() && ior > 0.0) {
        let message = format!("medium '{}' has index of refraction {ior}", description.name);
        return Err(SceneError::at(&description.source, message).with_remedy("give a number above 0"));
    }
    let sigma_a = absorption(description)?;
    let mut sigma_s = [0.0; 3];
    if let Some(scattering) = &description.scattering
        && scattering.sigma_s != [0.0; 3]
    {
        sigma_s = scattering.sigma_s;
        let message = format!(
            "medium '{}' scatters light; only its extinction is rendered, scattered light is missing",
            description.name
        );
        notes.push(Note::warning(&description.source, message));
    }
    let g = description.scattering.as_ref().map_or(0.0, |s| s.phase.mean_cosine());
    Ok(Medium { ior, sigma_a: Spectrum::from_rgb(sigma_a), sigma_s: Spectrum::from_rgb(sigma_s), g })
}

fn index(description: &Located<MediumDescription>) -> Result<f32, SceneError> {
    let model = match &description.index {
        IndexDescription::Constant(index) => IndexModel::Constant(*index),
        IndexDescription::Named(name) => catalogue::index_by_name(name).ok_or_else(|| unknown_index(name))?,
        IndexDescription::Abbe { nd, abbe } => IndexModel::Abbe(Abbe { nd: *nd, abbe: *abbe }),
        IndexDescription::Cauchy { a, b, c } => IndexModel::Cauchy(Cauchy { a: *a, b: *b, c: *c }),
        IndexDescription::Sellmeier { b, c } => IndexModel::Sellmeier(Sellmeier { b: *b, c: *c }),
    };
    Ok(catalogue::rgb_index(&model))
}

fn unknown_index(name: &Located<String>) -> SceneError {
    let error = SceneError::at(&name.source, format!("no glass or liquid is named '{}'", name.value));
    match nearest(name, catalogue::index_names()) {
        Some(candidate) => error.with_remedy(format!("did you mean '{candidate}'? A number works too")),
        None => error,
    }
}

/// Absorption coefficients, 1 / scene unit.
fn absorption(description: &MediumDescription) -> Result<Rgb, SceneError> {
    Ok(match &description.absorption {
        Absorption::None => [0.0; 3],
        Absorption::SigmaA(sigma_a) => *sigma_a,
        Absorption::Filter(filter) => filter.map(attenuation::sigma_from_filter),
        Absorption::ColorAt { color, distance } => {
            color.map(|c| attenuation::sigma_from_color_at_distance(c, *distance as f32))
        }
    })
}
