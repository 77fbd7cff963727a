//! `[settings]`: how to render.
//!
//! `integrator` (whitted, path, photon-map, merging, debug), `passes`, `seed`, `sampler` (sobol, independent),
//! `min_weight`, `max_depth`, `light_samples`, `march` ("adaptive", `{ adaptive = stations on a mean free path }` or the length of a
//! step), `without` (parts of `path` and `merging` to leave out), `debug` (what that integrator shows), and the table `photon_map`. Each has a default that the renderer chooses.

use super::document::Value;
use super::field::Field;
use super::photon_map;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{DebugView, MarchStep, SamplerKind, Settings, Techniques};

/// Most places on a mean free path where a march may ask for light.
const MOST_STATIONS: f64 = 1000.0;

const INTEGRATORS: [(&str, &str); 5] = [
    ("whitted", "whitted"),
    ("path", "path"),
    ("photon-map", "photon-map"),
    ("merging", "merging"),
    ("debug", "debug"),
];

const DEBUG_VIEWS: [(&str, DebugView); 15] = [
    ("normals", DebugView::Normal),
    ("geometric-normals", DebugView::GeometricNormal),
    ("depth", DebugView::Depth),
    ("uv", DebugView::Uv),
    ("media", DebugView::Medium),
    ("objects", DebugView::Object),
    ("albedo", DebugView::Albedo),
    ("crossings", DebugView::Crossings),
    ("photon-power", DebugView::PhotonPower),
    ("photon-depth", DebugView::PhotonDepth),
    ("photon-maps", DebugView::PhotonMap),
    ("irradiance", DebugView::Irradiance),
    ("caustic-irradiance", DebugView::CausticIrradiance),
    ("photons-found", DebugView::PhotonsFound),
    ("photon-radius", DebugView::PhotonRadius),
];

/// Changes `settings` to what the table says. `metres` is the length of a scene unit.
pub(super) fn read(mut table: Table<'_>, metres: f64, settings: &mut Settings) -> Result<()> {
    if let Some(name) = table.read_some("integrator", |field| field.choice(&INTEGRATORS))? {
        settings.integrator = Some(name.to_owned());
    }
    if let Some(passes) = table.read_some("passes", |field| field.count(1))? {
        settings.passes = Some(passes);
    }
    if let Some(seed) = table.read_some("seed", |field| field.integer(0, i64::MAX))? {
        settings.seed = seed as u64;
    }
    let samplers = [("sobol", SamplerKind::Sobol), ("independent", SamplerKind::Independent)];
    settings.sampler = table.read("sampler", settings.sampler, |field| field.choice(&samplers))?;
    if let Some(weight) = table.read_some("min_weight", |field| field.number_f32(Limits::FRACTION))? {
        settings.min_weight = Some(weight);
    }
    if let Some(depth) = table.read_some("max_depth", |field| field.count(1))? {
        settings.max_depth = Some(depth);
    }
    if let Some(samples) = table.read_some("light_samples", |field| field.count(1))? {
        settings.light_samples = Some(samples);
    }
    settings.march = table.read("march", settings.march, |field| march(field, metres))?;
    if let Some(field) = table.take("without") {
        without(field, &mut settings.techniques)?;
    }
    settings.debug = table.read("debug", settings.debug, |field| field.choice(&DEBUG_VIEWS))?;
    if let Some(field) = table.take("photon_map") {
        photon_map::read(field.table("settings.photon_map")?, metres, &mut settings.photon_map)?;
    }
    table.finish()
}

/// Parts of `path` and `merging` that are left out.
fn without(field: Field<'_>, techniques: &mut Techniques) -> Result<()> {
    for part in field.items_or_one()? {
        if !techniques.leave_out(part.string()?) {
            return Err(part.no_such_choice(&Techniques::names().collect::<Vec<_>>()));
        }
    }
    Ok(())
}

/// "adaptive", `{ adaptive = stations on a mean free path }`, or the length of a step.
fn march(field: Field<'_>, metres: f64) -> Result<MarchStep> {
    if matches!(field.node.value, Value::Table(_)) {
        let mut table = field.table("settings.march")?;
        let stations = table.require("adaptive", "4")?.number_f32(Limits::between(1.0, MOST_STATIONS))?;
        table.finish()?;
        return Ok(MarchStep::Adaptive { stations });
    }
    match field.string() {
        Ok("adaptive") => Ok(MarchStep::default()),
        Ok(word) if word.starts_with(char::is_alphabetic) => Err(field
            .error(format!("`{}` is '{word}', which is no length", field.key))
            .with_remedy("write \"adaptive\", { adaptive = 4 }, or a length such as \"5 cm\"")),
        _ => Ok(MarchStep::Fixed { length: field.length(metres, Limits::POSITIVE)? }),
    }
}
