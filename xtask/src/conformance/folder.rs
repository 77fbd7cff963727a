//! Which scenes lie below a folder, and what to compare them with.
//!
//! A folder's scene is its `scene.xml` or `scene.toml`; where it has neither, every `.xml` and `.toml` file that holds
//! a scene is one. `reference.exr` (radiance) beside the only scene of a folder is its reference,
//! `reference-variance.exr` the variance of that mean; `references.json` in the folder above may tell an exposure, and
//! how far the reference itself is from the truth.

use crate::workspace;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A scene, and its reference where it has one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scene {
    /// Name in tables: the way from the folder that was searched.
    pub(crate) name: String,
    /// The scene file.
    pub(crate) file: PathBuf,
    /// Radiance to compare with.
    pub(crate) reference: Option<PathBuf>,
    /// Variance of the reference's mean.
    pub(crate) variance: Option<PathBuf>,
    /// Factor on radiance before FLIP.
    pub(crate) exposure: f64,
    /// Error of the reference itself.
    pub(crate) floor: Floor,
}

/// What a perfect picture differs from a reference by; 0 where that isn't known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Floor {
    /// Its relmse.
    pub(crate) relmse: f64,
    /// The same, trimmed.
    pub(crate) trimmed: f64,
}

/// All scenes below a folder, in the order of their names.
///
/// # Errors
/// A folder can't be read.
pub(crate) fn find(folder: &Path) -> Result<Vec<Scene>, String> {
    let mut scenes = Vec::new();
    search(folder, folder, &mut scenes)?;
    Ok(scenes)
}

/// The scenes below some folders, or those of the gallery where there are none, whose names contain one of `only`, if any.
///
/// # Errors
/// A folder can't be read, or there is no such scene.
pub(crate) fn choose(folders: &[PathBuf], only: &[String]) -> Result<Vec<Scene>, String> {
    let gallery = [workspace::root().join("scenes")];
    let folders = if folders.is_empty() { &gallery[..] } else { folders };
    let mut scenes = Vec::new();
    for folder in folders {
        scenes.extend(find(folder)?);
    }
    scenes.retain(|scene| only.is_empty() || only.iter().any(|text| scene.name.contains(text.as_str())));
    if scenes.is_empty() { Err("no scene (.xml, .toml) there or below".into()) } else { Ok(scenes) }
}

fn search(root: &Path, folder: &Path, scenes: &mut Vec<Scene>) -> Result<(), String> {
    let entries = workspace::entries(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let files = scene_files(&entries);
    let is_only = files.len() == 1;
    for file in files {
        scenes.push(scene(root, folder, file, is_only));
    }
    let is_hidden =
        |path: &Path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    for path in entries.iter().filter(|path| path.is_dir() && !is_hidden(path)) {
        search(root, path, scenes)?;
    }
    Ok(())
}

/// The scene files among the entries of a folder.
fn scene_files(entries: &[PathBuf]) -> Vec<PathBuf> {
    for name in ["scene.xml", "scene.toml"] {
        if let Some(file) = entries.iter().find(|path| path.ends_with(name) && path.is_file()) {
            return vec![file.clone()];
        }
    }
    entries.iter().filter(|path| path.is_file() && holds_scene(path)).cloned().collect()
}

/// Whether a file is a scene and not something else with the same ending.
fn holds_scene(path: &Path) -> bool {
    let sign = match path.extension().and_then(|ending| ending.to_str()) {
        Some("xml") => "<scene",
        Some("toml") => "[camera",
        _ => return false,
    };
    std::fs::read_to_string(path).is_ok_and(|text| text.contains(sign))
}

/// - `is_only`: whether it is the only scene of its folder, so that a reference there is its own.
fn scene(root: &Path, folder: &Path, file: PathBuf, is_only: bool) -> Scene {
    let beside = |name: &str| Some(folder.join(name)).filter(|path| is_only && path.is_file());
    let way = folder.strip_prefix(root).unwrap_or(folder);
    let path = if is_only && way != Path::new("") {
        way.to_owned()
    } else {
        way.join(file.with_extension("").file_name().unwrap_or_default())
    };
    let known =
        folder.file_name().and_then(|name| known(folder, &name.to_string_lossy())).unwrap_or_default();
    let number = |key: &str| known[key].as_f64().filter(|number| *number > 0.0);
    Scene {
        name: path.to_string_lossy().replace('\\', "/"),
        file,
        reference: beside("reference.exr"),
        variance: beside("reference-variance.exr"),
        exposure: number("exposure").unwrap_or(1.0),
        floor: Floor {
            relmse: number("relmse_floor").unwrap_or(0.0),
            trimmed: number("relmse_floor_trim").unwrap_or(0.0),
        },
    }
}

/// What `references.json`, in the folder or above it, tells of a folder.
fn known(folder: &Path, name: &str) -> Option<Value> {
    let above = folder.parent().unwrap_or(folder);
    let files = [folder, above].map(|place| place.join("references.json"));
    files.iter().find_map(|file| {
        let text = std::fs::read_to_string(file).ok()?;
        let references: Value = serde_json::from_str(&text).ok()?;
        references.get(name).cloned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Path, name: &str, text: &str) {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    #[test]
    fn scenes_are_found_at_any_depth_with_what_belongs_to_them() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        write(root, "a/scene.xml", "");
        write(root, "a/fragment.xml", "<scene/>");
        write(root, "a/reference.exr", "");
        write(root, "a/reference-variance.exr", "");
        write(root, "deep/b/any.toml", "[camera]");
        write(root, "deep/b/reference.exr", "");
        write(root, "many/one.xml", "<scene version='3'/>");
        write(root, "many/two.toml", "[camera]");
        write(root, "many/reference.exr", "");
        write(root, "other/Cargo.toml", "[package]");
        write(root, ".hidden/scene.xml", "");
        write(root, "references.json", r#"{"a": {"exposure": 2.5, "relmse_floor": 2e-4}}"#);
        let found = find(root).unwrap();
        let names: Vec<&str> = found.iter().map(|scene| scene.name.as_str()).collect();
        assert_eq!(names, ["a", "deep/b", "many/one", "many/two"]);
        let has: Vec<(bool, bool)> =
            found.iter().map(|scene| (scene.reference.is_some(), scene.variance.is_some())).collect();
        assert_eq!(has, [(true, true), (true, false), (false, false), (false, false)]);
        assert_eq!(found.iter().map(|scene| scene.exposure).collect::<Vec<_>>(), [2.5, 1.0, 1.0, 1.0]);
        assert_eq!(found[0].floor, Floor { relmse: 2e-4, trimmed: 0.0 });
        assert_eq!(find(&root.join("deep/b")).unwrap()[0].name, "any");
    }
}
