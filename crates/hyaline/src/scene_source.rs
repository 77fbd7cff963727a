//! Where a scene comes from: a file, or the glass of water that is built in.

use crate::failure::Failure;
use hyaline_scene::{SceneDescription, SceneError};
use std::path::{Path, PathBuf};

/// Name of the built-in scene in messages.
const BUILT_IN_NAME: &str = "built-in glass-of-water.toml";
/// The built-in scene.
const BUILT_IN_TEXT: &str = include_str!("../../../scenes/glass-of-water.toml");

/// Reads the scene, with settings overridden; `None` is the built-in scene.
///
/// # Errors
/// The file is absent, can't be read, or is no scene; an override names nothing.
pub(crate) fn load(
    scene: Option<&Path>,
    overrides: &[(String, String)],
) -> Result<SceneDescription, Failure> {
    let description = match scene {
        Some(path) => hyaline_formats::load(path, overrides)?,
        None => hyaline_formats::load_toml_text(BUILT_IN_TEXT, BUILT_IN_NAME, Path::new("."), overrides)?,
    };
    Ok(description)
}

/// Reads a scene file as `load` does, but tells everything that is wrong with it.
///
/// # Errors
/// All faults, at least one.
pub(crate) fn load_or_all_faults(
    scene: &Path,
    overrides: &[(String, String)],
) -> Result<SceneDescription, Vec<SceneError>> {
    hyaline_formats::load_or_all_faults(scene, overrides)
}

/// Text of a scene file by the name that messages use; `None` where it can't be read as text.
pub(crate) fn text_of(file: &str) -> Option<String> {
    if file == BUILT_IN_NAME {
        return Some(BUILT_IN_TEXT.to_owned());
    }
    std::fs::read_to_string(file).ok()
}

/// Name of the scene's pictures without the ending.
pub(crate) fn stem(scene: Option<&Path>) -> PathBuf {
    let stem = scene.and_then(Path::file_stem);
    stem.map_or_else(|| PathBuf::from("glass-of-water"), PathBuf::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_named_after_the_scene() {
        assert_eq!(stem(Some(Path::new("../a/pool.v2.xml"))), Path::new("pool.v2"));
        assert_eq!(stem(None), Path::new("glass-of-water"));
    }

    #[test]
    fn the_built_in_scene_can_be_read() {
        let description = load(None, &[]).expect("the built-in scene is a scene");
        assert!(!description.cameras.is_empty() && !description.objects.is_empty());
    }
}
