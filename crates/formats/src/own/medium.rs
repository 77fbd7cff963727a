//! `[media.NAME]`: what volumes are made of.
//!
//! `ior` is a number (default 1), a name of the catalogue, `{ nd, abbe }`, `{ cauchy = [a, b, c] }` or
//! `{ sellmeier = { b = [..], c = [..] } }` (micrometres). Absorption is one of `color = { rgb = .., at = "20 cm" }`,
//! `filter` (per scene unit, above 0 and at most 1) and `sigma_a` (1 / scene unit). `sigma_s` scatters with mean
//! cosine `g` or by `phase`: "isotropic", "rayleigh", `{ hg = g }` or `{ double = [g1, g2, share of the second] }`.
//! `measured` names a liquid whose coefficients are known, `concentration` thins it (1); its index is that of water. What
//! is known of it is (1 - g) σ_s, so that σ_s grows with `g`. `scale` multiplies absorption and scattering (1).
//! `emission` is what the volume sends out by itself (W sr⁻¹ m⁻³), `grid` where it is how dense; `priority` decides
//! where solids overlap.

use super::field::Field;
use super::grid;
use super::table::Table;
use crate::Result;
use crate::assets::Assets;
use crate::limits::Limits;
use crate::nearest::nearest;
use hyaline_scene::measured::{self, Measured};
use hyaline_scene::{
    Absorption, IndexDescription, Located, MediumDescription, Note, PhaseDescription, Rgb, Scattering, Source,
};

/// Indices of refraction that exist or are worth trying.
const IOR: Limits = Limits::above_to(0.0, 100.0);

/// Reads a medium; keys that are absent keep what `base` has. Doubts go to `notes`.
///
/// # Errors
/// Numbers that no volume has, names that nothing bears, coefficients beyond `f32`.
pub(super) fn read(
    table: &mut Table<'_>,
    metres: f64,
    base: MediumDescription,
    assets: &Assets,
    notes: &mut Vec<Note>,
) -> Result<MediumDescription> {
    let measured = table.take("measured");
    let base = match measured {
        Some(field) => of_liquid(field, table.take("concentration"), metres, base)?,
        None => base,
    };
    let index = table.read("ior", base.index, index)?;
    let absorption = match table.take_one(&["color", "filter", "sigma_a"])? {
        None => base.absorption,
        Some(field) => absorption(field, metres)?,
    };
    let isotropic = Scattering { sigma_s: [0.0; 3], phase: PhaseDescription::Isotropic };
    let old = base.scattering.clone().unwrap_or(isotropic);
    let phase_field = table.take_one(&["g", "phase"])?;
    let phase = phase_field.map_or(Ok(old.phase), phase)?;
    let default = if measured.is_some() { phase.unreduced(old.sigma_s) } else { old.sigma_s };
    let sigma_s = table.read("sigma_s", default, |field| field.color(Limits::NOT_NEGATIVE))?;
    let (absorption, sigma_s) = match table.take("scale") {
        Some(field) => scaled(field, absorption, sigma_s)?,
        None => (absorption, sigma_s),
    };
    let emission = table.read("emission", base.emission, |field| field.color(Limits::NOT_NEGATIVE))?;
    let density = match table.take("grid") {
        Some(field) => Some(grid::read(field, metres, assets)?),
        None => base.density,
    };
    // A grid of albedos scatters even where the coefficient is 0.
    let has_albedo = density.as_ref().is_some_and(|grid| grid.albedo.is_some());
    let scattering = (sigma_s != [0.0; 3] || has_albedo).then_some(Scattering { sigma_s, phase });
    if let (Some(field), None) = (phase_field, &scattering) {
        let message = format!(
            "{} scatters nothing, so that its `{}` has no effect; give it `sigma_s`",
            table.what, field.key
        );
        notes.push(Note::warning(field.source(), message));
    }
    let priorities = (i64::from(i32::MIN), i64::from(i32::MAX));
    let priority =
        table.read("priority", i64::from(base.priority), |f| f.integer(priorities.0, priorities.1))?;
    let priority = priority as i32;
    Ok(MediumDescription { index, absorption, scattering, emission, density, priority, ..base })
}

/// Absorption and scattering, both multiplied by `scale`.
fn scaled(scale: Field<'_>, absorption: Absorption, sigma_s: Rgb) -> Result<(Absorption, Rgb)> {
    let factor = scale.number_f32(Limits::NOT_NEGATIVE)?;
    let times = |sigma: Rgb| sigma.map(|sigma| sigma * factor);
    let absorption = match absorption {
        _ if factor == 0.0 => Absorption::None,
        Absorption::None => Absorption::None,
        Absorption::SigmaA(sigma_a) => Absorption::SigmaA(times(sigma_a)),
        // The same color after a shorter way.
        Absorption::Filter(color) => Absorption::ColorAt { color, distance: 1.0 / f64::from(factor) },
        Absorption::ColorAt { color, distance } => {
            Absorption::ColorAt { color, distance: distance / f64::from(factor) }
        }
    };
    let sigma_s = times(sigma_s);
    let sigma_a = if let Absorption::SigmaA(sigma_a) = absorption { sigma_a } else { [0.0; 3] };
    if sigma_a.iter().chain(&sigma_s).any(|sigma| !sigma.is_finite()) {
        let error = scale.error(format!("`scale` = {factor} makes the coefficients too large"));
        return Err(error.with_remedy("lower `scale`, `sigma_a` or `sigma_s`"));
    }
    Ok((absorption, sigma_s))
}

/// A medium of nothing but a measured liquid, named like it; `None` where nothing is known of the name.
///
/// - `metres`: length of a scene unit.
pub(super) fn by_liquid_name(name: &Located<String>, metres: f64) -> Option<MediumDescription> {
    let liquid = measured::by_name(name)?;
    let clear = MediumDescription::clear(name.value.clone(), IndexDescription::Constant(1.0));
    Some(with_coefficients(liquid, 1.0, metres, &name.source, clear))
}

/// The coefficients of a liquid by its name.
///
/// - `concentration`: share of it in water that absorbs nothing.
fn of_liquid(
    field: Field<'_>,
    concentration: Option<Field<'_>>,
    metres: f64,
    base: MediumDescription,
) -> Result<MediumDescription> {
    let name = field.string()?;
    let Some(liquid) = measured::by_name(name) else {
        let nearest = nearest(name, measured::names()).unwrap_or_default();
        return Err(field
            .error(format!("nothing is known of '{name}'"))
            .with_remedy(format!("the nearest is '{nearest}'; docs/scene-format.md lists them all")));
    };
    let share = concentration.map_or(Ok(1.0), |field| field.number(Limits::above_to(0.0, 1.0)))?;
    Ok(with_coefficients(liquid, share, metres, field.source(), base))
}

/// What is known of a liquid, and the rest of `base`.
fn with_coefficients(
    liquid: &Measured,
    share: f64,
    metres: f64,
    source: &Source,
    base: MediumDescription,
) -> MediumDescription {
    // The table is in 1/mm.
    let factor = (share * metres / 1e-3) as f32;
    let times = |sigma: Rgb| sigma.map(|sigma| sigma * factor);
    MediumDescription {
        index: IndexDescription::Named(Located::new("water".to_owned(), source.clone())),
        absorption: Absorption::SigmaA(times(liquid.sigma_a)),
        // Reduced coefficients go with an isotropic phase function.
        scattering: Some(Scattering { sigma_s: times(liquid.sigma_s), phase: PhaseDescription::Isotropic }),
        ..base
    }
}

/// `g`, or a phase function by name or as a table.
fn phase(field: Field<'_>) -> Result<PhaseDescription> {
    let cosine = |field: Field<'_>| field.number_f32(Limits::inside(-1.0, 1.0));
    if field.key == "g" {
        return cosine(field).map(PhaseDescription::from_mean_cosine);
    }
    if field.string().is_ok() {
        let names = [("isotropic", PhaseDescription::Isotropic), ("rayleigh", PhaseDescription::Rayleigh)];
        return field.choice(&names);
    }
    let mut table = field.table("phase")?;
    let form = table.take_one(&["hg", "double"])?;
    table.finish()?;
    match form {
        None => Err(field.error("`phase` as a table needs `hg` or `double`")),
        Some(form) if form.key == "hg" => cosine(form).map(PhaseDescription::from_mean_cosine),
        Some(form) => {
            let [g1, g2, weight] = form.array(Ok)?;
            let (g1, g2, weight) = (cosine(g1)?, cosine(g2)?, weight.number_f32(Limits::FRACTION)?);
            Ok(PhaseDescription::DoubleHenyeyGreenstein { g1, g2, weight })
        }
    }
}

fn index(field: Field<'_>) -> Result<IndexDescription> {
    if field.string().is_ok() {
        return Ok(IndexDescription::Named(field.name()?));
    }
    if field.entries().is_err() {
        return field.number(IOR).map(IndexDescription::Constant).map_err(|error| {
            error.with_remedy("an index is a number, a name, { nd, abbe }, { cauchy } or { sellmeier }")
        });
    }
    let mut table = field.table("ior")?;
    let form = table.take_one(&["nd", "cauchy", "sellmeier"])?;
    let abbe = table.take("abbe");
    table.finish()?;
    let Some(form) = form else {
        return Err(field.error("`ior` needs `nd` and `abbe`, `cauchy` or `sellmeier`"));
    };
    if let (Some(abbe), true) = (abbe, form.key != "nd") {
        return Err(abbe.error("`abbe` goes with `nd` only"));
    }
    match (form.key, abbe) {
        ("nd", None) => Err(form.error("`nd` needs `abbe`; for an index without dispersion write ior = 1.5")),
        ("nd", Some(abbe)) => {
            Ok(IndexDescription::Abbe { nd: form.number(IOR)?, abbe: abbe.number(Limits::POSITIVE)? })
        }
        ("cauchy", _) => cauchy(form),
        _ => sellmeier(form),
    }
}

fn cauchy(field: Field<'_>) -> Result<IndexDescription> {
    let terms = field.items()?;
    if !(1..=3).contains(&terms.len()) {
        return Err(field.error(format!("`cauchy` must be [a, b] or [a, b, c], not {} numbers", terms.len())));
    }
    let term = |i: usize| terms.get(i).map_or(Ok(0.0), |term| term.number(Limits::between(-100.0, 100.0)));
    Ok(IndexDescription::Cauchy { a: terms[0].number(IOR)?, b: term(1)?, c: term(2)? })
}

fn sellmeier(field: Field<'_>) -> Result<IndexDescription> {
    let mut table = field.table("sellmeier")?;
    let number = |item: Field<'_>| item.number(Limits::between(-1e6, 1e6));
    let b = table.require("b", "[1.04, 0.23, 1.01]")?.array(number)?;
    let c = table.require("c", "[0.006, 0.02, 103.6]")?.array(number)?;
    table.finish()?;
    Ok(IndexDescription::Sellmeier { b, c })
}

fn absorption(field: Field<'_>, metres: f64) -> Result<Absorption> {
    let remedy = "a channel that lets nothing through is best written as a small number, such as 0.001";
    match field.key {
        "filter" => {
            let filter = field.color(Limits::TRANSMITTANCE).map_err(|error| error.with_remedy(remedy))?;
            Ok(Absorption::Filter(filter))
        }
        "sigma_a" => Ok(Absorption::SigmaA(field.color(Limits::NOT_NEGATIVE)?)),
        _ => {
            let mut table = field.table("color of a medium: { rgb, at }")?;
            let rgb = table.require("rgb", "[0.8, 0.95, 1]")?;
            let distance = table.require("at", "\"10 cm\"")?.length(metres, Limits::POSITIVE)?;
            table.finish()?;
            let color = rgb.color(Limits::TRANSMITTANCE).map_err(|error| error.with_remedy(remedy))?;
            Ok(Absorption::ColorAt { color, distance })
        }
    }
}
