//! Media: from names and colors to indices and coefficients in lanes.

use super::names::nearest;
use hyaline_math::DVec3;
use hyaline_optics::attenuation;
use hyaline_optics::dispersion::{Abbe, Cauchy, IndexModel, Sellmeier};
use hyaline_scattering::volume::{AlbedoGrid, Grid};
use hyaline_scattering::{Medium, Phase};
use hyaline_scene::{
    Absorption, DensityGrid, GridData, IndexDescription, Located, MediumDescription, PhaseDescription, Rgb,
    SceneError,
};
use hyaline_spectrum::{Spectrum, catalogue};
use std::sync::Arc;

/// Most mean free paths through a grid. Beyond it, steps from one possible collision to the next vanish beside the distances
/// that they are added to, and no path ends.
const MOST_FREE_PATHS: f64 = 1e7;
/// Possible collisions on the way through a grid of density 1 that shines: the least that tracking takes there.
const STEPS_OF_LIGHT: f64 = 4.0;

/// Compiles a medium.
///
/// # Errors
/// An index name that the catalogue lacks, coefficients that cannot be, a grid that is too dense to follow light in.
pub(super) fn compile(description: &Located<MediumDescription>) -> Result<Medium, SceneError> {
    let ior = index(description)?;
    if !(ior.is_finite() && ior > 0.0) {
        let message = format!("medium '{}' has index of refraction {ior}", description.name);
        return Err(SceneError::at(&description.source, message).with_remedy("give a number above 0"));
    }
    let sigma_a = absorption(description)?;
    let sigma_s = description.scattering.as_ref().map_or([0.0; 3], |scattering| scattering.sigma_s);
    let is_coefficient = |value: &f32| value.is_finite() && *value >= 0.0;
    for (name, values) in [("sigma_s", sigma_s), ("emission", description.emission)] {
        if !values.iter().all(is_coefficient) {
            let message = format!("medium '{}' has {name} = {values:?}", description.name);
            return Err(
                SceneError::at(&description.source, message).with_remedy("give numbers of at least 0")
            );
        }
    }
    let extinction: Rgb = std::array::from_fn(|i| sigma_a[i] + sigma_s[i]);
    if !extinction.iter().all(|sigma| sigma.is_finite()) {
        let message = format!(
            "medium '{}' has absorption {sigma_a:?} and scattering {sigma_s:?}, whose sum is not finite",
            description.name
        );
        return Err(SceneError::at(&description.source, message).with_remedy("lower its coefficients"));
    }
    let phase = match &description.scattering {
        Some(scattering) => phase(description, &scattering.phase)?,
        None => Phase::Isotropic,
    };
    if let Some(grid) = &description.density {
        check_depth(description, grid, extinction)?;
    }
    let (sigma_a, sigma_s) = (Spectrum::from_rgb(sigma_a), Spectrum::from_rgb(sigma_s));
    let emission = Spectrum::from_rgb(description.emission);
    let grid = description.density.as_ref().map(|density| grid(description, density)).transpose()?;
    Ok(Medium { ior, sigma_a, sigma_s, phase, emission, grid: grid.map(Arc::new) })
}

fn phase(description: &Located<MediumDescription>, phase: &PhaseDescription) -> Result<Phase, SceneError> {
    let check = |g: f32| {
        if g.abs() < 1.0 {
            return Ok(g);
        }
        let message = format!("medium '{}' has a phase function of mean cosine {g}", description.name);
        Err(SceneError::at(&description.source, message).with_remedy("give a number between -1 and 1"))
    };
    Ok(match *phase {
        PhaseDescription::Isotropic => Phase::Isotropic,
        PhaseDescription::HenyeyGreenstein { g } => Phase::HenyeyGreenstein { g: check(g)? },
        PhaseDescription::Rayleigh => Phase::Rayleigh,
        PhaseDescription::DoubleHenyeyGreenstein { g1, g2, weight } => {
            Phase::DoubleHenyeyGreenstein { g: [check(g1)?, check(g2)?], weight: weight.clamp(0.0, 1.0) }
        }
    })
}

fn grid(description: &Located<MediumDescription>, grid: &DensityGrid) -> Result<Grid, SceneError> {
    check_grid(description, "density", &grid.density, f32::MAX)?;
    let channels = grid.density.channels as usize;
    // A colored density counts by its first channel times the coefficients: readers write one channel.
    let density = grid.density.values.chunks_exact(channels).map(|cell| cell[0]).collect();
    let albedo = match &grid.albedo {
        None => None,
        Some(data) => {
            check_grid(description, "albedo", data, 1.0)?;
            Some(AlbedoGrid { size: data.size, values: colors(data) })
        }
    };
    Ok(Grid::new(grid.density.size, density, albedo, &grid.placement))
}

/// # Errors
/// More mean free paths along the diagonal of the grid's box than tracking can take.
fn check_depth(
    description: &Located<MediumDescription>,
    grid: &DensityGrid,
    extinction: Rgb,
) -> Result<(), SceneError> {
    let densest = grid.density.values.iter().fold(0.0_f32, |a, &b| a.max(b));
    let strongest = extinction.into_iter().fold(0.0, f32::max);
    let diagonal = diagonal(grid);
    let shines = description.emission != [0.0; 3];
    let least = if shines { STEPS_OF_LIGHT } else { 0.0 };
    let free_paths = f64::from(densest) * (f64::from(strongest) * diagonal).max(least);
    if (densest * strongest).is_finite() && free_paths <= MOST_FREE_PATHS {
        return Ok(());
    }
    let message = format!(
        "the grid of medium '{}' is too dense to follow light in: {free_paths:.1e} mean free paths along the diagonal of its \
         box ({diagonal:.3e}), where the density is {densest:e} and the coefficients add up to {strongest:e}; at most \
         {MOST_FREE_PATHS:e} can be",
        description.name
    );
    Err(SceneError::at(&description.source, message).with_remedy(
        "lower the densities, the coefficients or `scale`, or make what is that dense a solid with a surface",
    ))
}

/// Longest diagonal of the box of a grid, scene units.
fn diagonal(grid: &DensityGrid) -> f64 {
    let length = |y: f64, z: f64| grid.placement.vector(DVec3::new(1.0, y, z)).length();
    [length(1.0, 1.0), length(1.0, -1.0), length(-1.0, 1.0), length(-1.0, -1.0)]
        .into_iter()
        .fold(0.0, f64::max)
}

/// # Errors
/// The wrong count of values, or one that is no number from 0 to `largest`.
fn check_grid(
    description: &Located<MediumDescription>,
    what: &str,
    data: &GridData,
    largest: f32,
) -> Result<(), SceneError> {
    let cells: u64 = data.size.iter().map(|&n| u64::from(n)).product();
    let error = |message: String| {
        SceneError::at(
            &description.source,
            format!("the {what} grid of medium '{}' {message}", description.name),
        )
    };
    let wanted = cells.saturating_mul(u64::from(data.channels));
    if cells == 0 || !matches!(data.channels, 1 | 3) || data.values.len() as u64 != wanted {
        let [x, y, z] = data.size;
        return Err(error(format!(
            "is to have {x} x {y} x {z} cells of {} values, but has {} values",
            data.channels,
            data.values.len()
        )));
    }
    let is_wrong = |value: &f32| !(*value >= 0.0 && *value <= largest);
    match data.values.iter().position(is_wrong) {
        Some(index) => Err(error(format!("has {} as value number {index}", data.values[index]))
            .with_remedy(format!("values are numbers from 0 to {largest}"))),
        None => Ok(()),
    }
}

/// One or three channels as lanes.
fn colors(data: &GridData) -> Vec<Spectrum> {
    let cells = data.values.chunks_exact(data.channels as usize);
    cells
        .map(|cell| Spectrum::from_rgb(if let [r, g, b] = *cell { [r, g, b] } else { [cell[0]; 3] }))
        .collect()
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

#[cfg(test)]
#[path = "media_tests.rs"]
mod tests;
