//! One scene: rendered, compared, tested.

use super::tiles::Tiles;
use crate::workspace;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A scene and its reference.
pub(crate) struct SceneFolder {
    /// Name of the folder.
    pub(crate) name: String,
    scene: PathBuf,
    reference: PathBuf,
    variance: PathBuf,
}

/// What was measured of a scene.
pub(crate) struct Measured {
    /// Samples per pixel.
    pub(crate) spp: u64,
    /// What `hyaline compare --json` tells.
    pub(crate) figures: Value,
    /// Tiles against the reference's.
    pub(crate) tiles: Tiles,
    /// Build, preparation and passes.
    pub(crate) seconds: f64,
    /// What the render warned of.
    pub(crate) warnings: Vec<String>,
}

/// Scenes with references directly below a folder.
///
/// # Errors
/// The folder can't be read.
pub(crate) fn find(folder: &Path) -> Result<Vec<SceneFolder>, String> {
    let entries = workspace::entries(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(entries.iter().filter_map(|path| SceneFolder::at(path)).collect())
}

impl SceneFolder {
    fn at(folder: &Path) -> Option<Self> {
        let scene =
            ["scene.xml", "scene.toml"].map(|name| folder.join(name)).into_iter().find(|p| p.is_file())?;
        let [reference, variance] = ["reference.exr", "reference-variance.exr"].map(|name| folder.join(name));
        let name = folder.file_name()?.to_string_lossy().into_owned();
        (reference.is_file() && variance.is_file()).then_some(Self { name, scene, reference, variance })
    }

    /// Renders with `words` into the folder `output`, and compares.
    ///
    /// # Errors
    /// The command fails, or its results can't be read.
    pub(crate) fn measure(&self, binary: &Path, output: &Path, words: &[String]) -> Result<Measured, String> {
        let [image, film, diff] =
            [".exr", ".film", "-error.png"].map(|ending| output.join(format!("{}{ending}", self.name)));
        remove(&film)?;
        let mut render = Command::new(binary);
        render
            .arg("render")
            .arg(&self.scene)
            .arg("-o")
            .arg(&image)
            .arg("--film")
            .arg(&film)
            .arg("--json")
            .args(words);
        let report = last_json(render)?;
        let mut compare = Command::new(binary);
        compare.arg("compare").arg(&image).arg(&self.reference).arg("--json").arg("--diff").arg(&diff);
        let figures = last_json(compare)?;
        let tiles = Tiles::test(&film, &self.reference, &self.variance)?;
        let warnings = report["warnings"].as_array().into_iter().flatten();
        Ok(Measured {
            spp: report["spp"].as_u64().unwrap_or(0),
            figures,
            tiles,
            seconds: ["build", "prepare", "render"]
                .iter()
                .filter_map(|key| report["seconds"][key].as_f64())
                .sum(),
            warnings: warnings.filter_map(|text| text.as_str().map(str::to_owned)).collect(),
        })
    }
}

/// Removes a file of an earlier run, if there is one.
fn remove(path: &Path) -> Result<(), String> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(format!("{}: {error}", path.display()))
        }
        _ => Ok(()),
    }
}

/// Runs a command; returns the last line on its stdout as JSON, or the first on its stderr as an error.
fn last_json(mut command: Command) -> Result<Value, String> {
    let output = command.output().map_err(|error| error.to_string())?;
    if !output.status.success() {
        let messages = String::from_utf8_lossy(&output.stderr);
        let error = messages.lines().find(|line| line.starts_with("error")).unwrap_or("no message");
        return Err(format!("{} ({error})", output.status));
    }
    let results = String::from_utf8_lossy(&output.stdout);
    let line = results.lines().last().unwrap_or_default();
    serde_json::from_str(line).map_err(|error| format!("not JSON: {line} ({error})"))
}
