//! The house rules that a machine can check, as one command.

mod imports;
mod lengths;
mod sources;

use crate::workspace;
use std::io;
use std::path::Path;
use std::process::Command;

/// Runs all checks, even after one has failed.
///
/// # Errors
/// Tells how many checks failed; each has printed what it found.
pub(crate) fn run() -> Result<(), String> {
    let root = workspace::root();
    let cargo = |words: &str| run_cargo(&root, words);
    let results = [
        ("format", cargo("fmt --all --check")),
        ("imports", report(imports::check(&root))),
        ("lengths", report(lengths::check(&root))),
        ("sources of laws", report(sources::check(&root))),
        ("lints", cargo("clippy --quiet --workspace --all-targets -- -D warnings")),
        ("documentation", cargo("doc --quiet --workspace --no-deps")),
    ];
    for (name, passed) in &results {
        eprintln!("tidy: {name}: {}", if *passed { "ok" } else { "FAILED" });
    }
    match results.iter().filter(|(_, passed)| !passed).count() {
        0 => Ok(()),
        failures => Err(format!("{failures} of {} checks failed", results.len())),
    }
}

/// Runs cargo with these words; whether it succeeded.
fn run_cargo(root: &Path, words: &str) -> bool {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .args(words.split_whitespace())
        .env("RUSTDOCFLAGS", "-D warnings")
        .current_dir(root)
        .status();
    match status {
        Ok(status) => status.success(),
        Err(error) => {
            eprintln!("tidy: cargo {words}: {error}");
            false
        }
    }
}

/// Prints what a check found; whether it found nothing.
fn report(findings: io::Result<Vec<String>>) -> bool {
    match findings {
        Ok(findings) => {
            for finding in &findings {
                eprintln!("{finding}");
            }
            findings.is_empty()
        }
        Err(error) => {
            eprintln!("{error}");
            false
        }
    }
}
