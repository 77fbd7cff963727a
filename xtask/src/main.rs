//! Chores of the workspace: `cargo xtask tidy`, `cargo xtask conformance`, `cargo xtask bench`.

mod ablations;
mod bench;
mod binary;
mod conformance;
mod tidy;
mod workspace;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Chores of the workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    chore: Chore,
}

/// What to do.
#[derive(Debug, Subcommand)]
enum Chore {
    /// Format, lints, documentation, imports, lengths and sources
    Tidy,
    /// Render folders of scenes and compare with their references
    Conformance(conformance::Arguments),
    /// Time whole renders, alone or in turn with another binary
    Bench(bench::Arguments),
    /// Render scenes without each part of `merging`, to see what it is worth
    Ablations(ablations::Arguments),
}

fn main() -> ExitCode {
    let result = match Cli::parse().chore {
        Chore::Tidy => tidy::run(),
        Chore::Conformance(arguments) => conformance::run(&arguments),
        Chore::Bench(arguments) => bench::run(&arguments),
        Chore::Ablations(arguments) => ablations::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
