//! Renders folders of scenes and measures how far they are from independently made references.
//!
//! A folder counts when it holds `scene.xml` or `scene.toml`, `reference.exr` (radiance) and `reference-variance.exr`
//! (the variance of that mean). Each is rendered with the release binary, by default with independent samples, as the
//! tile test needs them.

mod scene;
mod table;
mod tiles;

use crate::workspace;
use clap::Args;
use scene::{Measured, SceneFolder};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Options of conformance.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder with one folder for each scene
    folder: PathBuf,
    /// Samples per pixel
    #[arg(long, value_name = "N", conflicts_with = "time")]
    spp: Option<u32>,
    /// Time for each scene, as the command's
    #[arg(long, value_name = "TIME")]
    time: Option<String>,
    /// Integrator; the command's default where absent
    #[arg(long, value_name = "NAME")]
    integrator: Option<String>,
    /// Sampler: independent or sobol
    #[arg(long, value_name = "NAME", default_value = "independent")]
    sampler: String,
    /// Only scenes whose name contains this; may be repeated
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
    /// No scene whose name contains this; may be repeated
    #[arg(long, value_name = "TEXT")]
    skip: Vec<String>,
    /// Fail where a tile test fails
    #[arg(long)]
    strict: bool,
}

impl Arguments {
    /// Words for the command that say how to render.
    fn words(&self) -> Vec<String> {
        let mut words = vec!["--set".to_owned(), format!("settings.sampler={}", self.sampler)];
        match (&self.time, self.spp) {
            (Some(time), _) => words.extend(["--time".to_owned(), time.clone()]),
            (None, spp) => words.extend(["--spp".to_owned(), spp.unwrap_or(64).to_string()]),
        }
        if let Some(integrator) = &self.integrator {
            words.extend(["--integrator".to_owned(), integrator.clone()]);
        }
        words
    }

    fn wants(&self, name: &str) -> bool {
        let is_skipped = self.skip.iter().any(|text| name.contains(text.as_str()));
        let is_chosen = self.only.is_empty() || self.only.iter().any(|text| name.contains(text.as_str()));
        is_chosen && !is_skipped
    }
}

/// Renders and measures every scene; prints a table and writes it to `target/conformance.md` and `.json`.
///
/// # Errors
/// There is no scene, one can't be rendered or measured, or, if asked for, a tile test fails.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    let root = workspace::root();
    let folder =
        arguments.folder.canonicalize().map_err(|e| format!("{}: {e}", arguments.folder.display()))?;
    let scenes: Vec<SceneFolder> =
        scene::find(&folder)?.into_iter().filter(|scene| arguments.wants(&scene.name)).collect();
    if scenes.is_empty() {
        return Err(format!("{}: no folder with a scene and its reference", folder.display()));
    }
    let binary = build(&root)?;
    let output = root.join("target/conformance");
    std::fs::create_dir_all(&output).map_err(|e| format!("{}: {e}", output.display()))?;

    let words = arguments.words();
    let mut results = Vec::new();
    for scene in scenes {
        eprintln!("conformance: {}", scene.name);
        let result = scene.measure(&binary, &output, &words);
        results.push((scene.name, result));
    }
    let text = table::markdown(&words, &results);
    print!("{text}");
    write(&root.join("target/conformance.md"), &text)?;
    write(&root.join("target/conformance.json"), &table::json(&words, &results))?;
    verdict(arguments.strict, &results)
}

/// Builds the release binary; returns its path.
fn build(root: &Path) -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .args(["build", "--release", "--quiet", "--package", "hyaline"])
        .current_dir(root)
        .status()
        .map_err(|error| format!("cargo build: {error}"))?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    if status.success() {
        Ok(target.join("release/hyaline"))
    } else {
        Err("the release binary does not build".into())
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Fails where a scene could not be measured, or where `strict` and a tile test failed.
fn verdict(strict: bool, results: &[(String, Result<Measured, String>)]) -> Result<(), String> {
    let is_bad = |result: &Result<Measured, String>| match result {
        Ok(measured) => strict && !measured.tiles.passes,
        Err(_) => true,
    };
    let bad: Vec<&str> =
        results.iter().filter(|(_, result)| is_bad(result)).map(|(name, _)| name.as_str()).collect();
    if bad.is_empty() { Ok(()) } else { Err(format!("failed: {}", bad.join(", "))) }
}
