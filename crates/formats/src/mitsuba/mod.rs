//! Mitsuba 3 scenes in XML, and the older names of versions 0.5 and 0.6.
//!
//! The text becomes a tree of elements with properties; readers take from it what they understand, and what nobody
//! took is noted as a warning. A dielectric boundary names the media on both sides: a side's medium is its volume
//! together with that side's index of refraction. Without volume and with index 1 it is the world's.

mod backs;
mod bsdf;
mod element;
mod emitter;
mod field;
mod form;
mod group;
mod importer;
mod include;
mod media;
mod mesh;
mod names;
mod notes;
mod object_names;
mod parameters;
mod parse;
mod phase;
mod sensor;
mod shape;
mod spectrum;
mod spectrum_plugin;
mod texture;
mod transform;
mod tree;
mod value;
mod volume;

#[cfg(test)]
mod fault_tests;
#[cfg(test)]
mod tests;

use crate::Result;
use crate::assets::Assets;
use crate::own::override_imported;
use hyaline_scene::{SceneDescription, SceneError, Source};
use std::path::Path;
use std::sync::Arc;

/// The key of `--set` that makes all finishes two-sided.
const TWO_SIDED: &str = "import.two_sided";

/// Reads a scene from its text.
///
/// # Errors
/// The first fault, with its place.
pub(crate) fn read(
    text: &str,
    file: &Arc<str>,
    base_dir: &Path,
    overrides: &[(String, String)],
) -> Result<SceneDescription> {
    let assets = Assets::new(base_dir);
    let (parameters, overrides) = parameters::Parameters::from_overrides(overrides);
    let (two_sided, overrides) = take_two_sided(overrides)?;
    let tree = parse::parse(text, file, &assets, parameters)?;
    let mut scene = importer::Importer::new(&tree, &assets, two_sided).read()?;
    override_imported(&mut scene, &overrides)?;
    Ok(scene)
}

/// Takes `import.two_sided` out of a list of overrides.
fn take_two_sided(mut overrides: Vec<(String, String)>) -> Result<(bool, Vec<(String, String)>)> {
    let mut two_sided = false;
    while let Some(index) = overrides.iter().position(|(key, _)| key == TWO_SIDED) {
        let (_, value) = overrides.remove(index);
        two_sided = value.trim().parse().map_err(|_| {
            let message = format!("{TWO_SIDED} must be true or false, not '{value}'");
            SceneError::at(&Source::file("--set"), message)
        })?;
    }
    Ok((two_sided, overrides))
}
