//! The release binary: built, run, and its report read.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds the release binary; returns its path.
///
/// # Errors
/// It does not build.
pub(crate) fn build(root: &Path) -> Result<PathBuf, String> {
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

/// Runs a command; returns the last line on its stdout as JSON, or the first error on its stderr as an error.
///
/// # Errors
/// The command fails, or its last line is no JSON.
pub(crate) fn last_json(command: &mut Command) -> Result<Value, String> {
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
