//! `<phase>`: where a medium sends the light that it scatters.

use super::element::Element;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::PhaseDescription;

/// The phase function of a medium; isotropic where it has none.
///
/// # Errors
/// Numbers out of range, a blend of fewer than two.
pub(super) fn read(medium: Element<'_>) -> Result<PhaseDescription> {
    let Some(phase) = medium.child("phase")? else { return Ok(PhaseDescription::Isotropic) };
    match phase.kind() {
        "blendphase" | "mixturephase" => blend(phase),
        _ => single(phase),
    }
}

fn single(phase: Element<'_>) -> Result<PhaseDescription> {
    match phase.kind() {
        "isotropic" => Ok(PhaseDescription::Isotropic),
        "rayleigh" => Ok(PhaseDescription::Rayleigh),
        "hg" => {
            let g = phase.float("g", 0.8, Limits::inside(-1.0, 1.0))?;
            Ok(PhaseDescription::from_mean_cosine(g as f32))
        }
        "tabphase" => tabulated(phase),
        _ => {
            phase.ignore_all();
            phase.warn(format!("{} is replaced by an isotropic one", phase.title()));
            Ok(PhaseDescription::Isotropic)
        }
    }
}

/// Values at even steps of the cosine from -1 to 1: Henyey and Greenstein's of the same mean cosine is the nearest.
fn tabulated(phase: Element<'_>) -> Result<PhaseDescription> {
    let Some(property) = phase.property("values") else {
        return Err(phase.error("phase 'tabphase' needs `values`"));
    };
    let values = property.numbers(property.value()?)?;
    if values.len() < 2 || values.iter().any(|value| *value < 0.0) {
        return Err(property.error("`values` must be two numbers of at least 0, or more"));
    }
    let step = 2.0 / (values.len() - 1) as f64;
    // Integrals of straight pieces from (x, a) to (x + step, b): of the function, and of the function times x.
    let (mut sum, mut moment) = (0.0, 0.0);
    for (i, pair) in values.windows(2).enumerate() {
        let (x, a, b) = (step * i as f64 - 1.0, pair[0], pair[1]);
        sum += 0.5 * step * (a + b);
        moment += 0.5 * step * (a + b) * x + step * step * (a + 2.0 * b) / 6.0;
    }
    let g = if sum > 0.0 { (moment / sum).clamp(-0.99, 0.99) } else { 0.0 };
    phase.warn(format!("{} is replaced by 'hg' of the same mean cosine", phase.title()));
    Ok(PhaseDescription::from_mean_cosine(g as f32))
}

/// Two phase functions: `weight` is the share of the second; in versions 0.5 and 0.6 `weights` are the shares of all.
fn blend(phase: Element<'_>) -> Result<PhaseDescription> {
    let mut children = phase.children("phase")?;
    // Version 3 goes by the alphabetic order of the names, where they have some.
    if children.iter().all(|(name, _)| name.is_some()) {
        children.sort_by_key(|(name, _)| *name);
    }
    let [(_, first), (_, second), rest @ ..] = children.as_slice() else {
        return Err(phase.error(format!("{} needs two phase functions within", phase.title())));
    };
    if !rest.is_empty() {
        phase.warn(format!("{} counts by its first two phase functions", phase.title()));
        rest.iter().for_each(|(_, other)| other.ignore_all());
    }
    let weight = share(phase)?;
    let (first, second) = (single(*first)?, single(*second)?);
    if first == second || weight == 0.0 {
        return Ok(first);
    }
    if weight == 1.0 {
        return Ok(second);
    }
    let mean_cosine = |phase: PhaseDescription| match phase {
        PhaseDescription::Isotropic | PhaseDescription::HenyeyGreenstein { .. } => Some(phase.mean_cosine()),
        PhaseDescription::Rayleigh | PhaseDescription::DoubleHenyeyGreenstein { .. } => None,
    };
    match (mean_cosine(first), mean_cosine(second)) {
        (Some(g1), Some(g2)) => Ok(PhaseDescription::DoubleHenyeyGreenstein { g1, g2, weight }),
        _ => {
            phase.warn(format!("{} of 'rayleigh' and another counts by the heavier of them", phase.title()));
            Ok(if weight > 0.5 { second } else { first })
        }
    }
}

/// Share of the second phase function, 0…1.
fn share(phase: Element<'_>) -> Result<f32> {
    if let Some(weights) = phase.property("weights") {
        let numbers = weights.numbers(weights.value()?)?;
        return match numbers.as_slice() {
            [a, b, ..] if *a >= 0.0 && *b >= 0.0 && a + b > 0.0 => Ok((b / (a + b)) as f32),
            _ => Err(weights.error("`weights` must be two numbers of at least 0")),
        };
    }
    if phase.child_named("texture", "weight")?.is_some() {
        phase.warn("a `weight` that varies over space is replaced by 0.5");
    }
    Ok(phase.float("weight", 0.5, Limits::FRACTION)? as f32)
}
