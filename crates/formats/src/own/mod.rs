//! hyaline's own scene format: TOML.
//!
//! One file per section; each value is checked where it is read, keys that nobody asks for are refused. Lengths are
//! numbers in scene units or strings with a unit, colors linear Rec. 709 or `"#rrggbb"`, angles in degrees.

mod camera;
mod document;
mod field;
mod film;
mod flat;
mod grid;
mod imported;
mod light;
mod light_power;
mod material;
mod medium;
mod object;
mod overrides;
mod photon_map;
mod references;
mod relief;
mod scene;
mod settings;
mod shape;
mod sources;
mod table;
mod texture;
mod transform;
mod vessel;

#[cfg(test)]
mod material_tests;
#[cfg(test)]
mod medium_tests;
#[cfg(test)]
mod tests;

pub(crate) use film::{MAX_PIXELS, MAX_SIDE, TENT_RADIUS};
pub(crate) use imported::override_imported;
pub(crate) use references::add_material;
pub(crate) use texture::IDENTITY_UV;

use crate::assets::Assets;
use hyaline_scene::{SceneDescription, SceneError};
use std::path::Path;
use std::sync::Arc;

/// Reads a scene from its text.
///
/// # Errors
/// All faults, with their places: of each section, object, light and so on the first; at least one.
pub(crate) fn read(
    text: &str,
    file: &Arc<str>,
    base_dir: &Path,
    overrides: &[(String, String)],
) -> std::result::Result<SceneDescription, Vec<SceneError>> {
    let mut root = document::parse(text, file).map_err(|fault| vec![fault])?;
    overrides::apply(&mut root, overrides).map_err(|fault| vec![fault])?;
    let assets = Assets::new(base_dir);
    scene::Reader::new(&assets).read(&root)
}
