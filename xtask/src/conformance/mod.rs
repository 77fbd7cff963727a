//! Renders folders of scenes and measures how far they are from independently made references.
//!
//! Each scene below the folder is rendered with the release binary, by default with independent samples, as the tile
//! test needs them. Scenes without a reference are rendered and listed all the same; one that fails is a row with its
//! error.

pub(crate) mod folder;
mod measure;
mod slope;
mod table;
mod tiles;

use crate::{binary, workspace};
use clap::Args;
use measure::{Length, Renderer};
use std::path::{Path, PathBuf};
use table::Row;

/// Samples per pixel where nothing is said.
const DEFAULT_SPP: u32 = 64;

/// Options of conformance.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder with scenes, at any depth
    folder: PathBuf,
    /// Samples per pixel [default: 64]
    #[arg(long, value_name = "N", conflicts_with = "time")]
    spp: Option<u32>,
    /// Time for each scene, as the command's
    #[arg(long, value_name = "TIME")]
    time: Option<String>,
    /// Go on until the standard error of the picture's mean is below 0.3 %, as the tile test wants
    #[arg(long, conflicts_with = "time")]
    until_settled: bool,
    /// Samples per pixel at which --until-settled gives up
    #[arg(long, value_name = "N", default_value_t = 16384)]
    most_spp: u32,
    /// Render on to 8, 16, ... passes (up to --spp, else 512), and tell how fast the error falls and whether the render's own
    /// estimate of it is true
    #[arg(long, conflicts_with_all = ["time", "until_settled"])]
    slope: bool,
    /// Integrator; the command's default where absent
    #[arg(long, value_name = "NAME")]
    integrator: Option<String>,
    /// Sampler: independent or sobol [default: independent; with --slope the command's]
    #[arg(long, value_name = "NAME")]
    sampler: Option<String>,
    /// Only scenes whose name contains this; may be repeated
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
    /// No scene whose name contains this; may be repeated
    #[arg(long, value_name = "TEXT")]
    skip: Vec<String>,
    /// Folder for the table, pictures and films [default: target/conformance]
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Fail where a tile test fails, or a slope is too flat
    #[arg(long)]
    strict: bool,
}

impl Arguments {
    /// Words for the command that say how to render.
    fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        let usual = (!self.slope).then_some("independent");
        if let Some(sampler) = self.sampler.as_deref().or(usual) {
            words.extend(["--set".to_owned(), format!("settings.sampler={sampler}")]);
        }
        if let Some(integrator) = &self.integrator {
            words.extend(["--integrator".to_owned(), integrator.clone()]);
        }
        words
    }

    fn length(&self) -> Length {
        let spp = self.spp.unwrap_or(DEFAULT_SPP);
        match &self.time {
            Some(time) => Length::Time(time.clone()),
            None if self.until_settled => Length::Settled { first: spp, most: self.most_spp },
            None => Length::Samples(spp),
        }
    }

    /// The way of rendering in words, for the head of the table.
    fn summary(&self) -> String {
        let length = match self.length() {
            Length::Samples(spp) => format!("--spp {spp}"),
            Length::Time(time) => format!("--time {time}"),
            Length::Settled { most, .. } => format!("until settled, at most {most} spp"),
        };
        format!("{} {length}", self.words().join(" "))
    }

    fn wants(&self, name: &str) -> bool {
        let is_skipped = self.skip.iter().any(|text| name.contains(text.as_str()));
        let is_chosen = self.only.is_empty() || self.only.iter().any(|text| name.contains(text.as_str()));
        is_chosen && !is_skipped
    }
}

/// Renders and measures every scene; prints a table and writes it as `conformance.md` and `conformance.json`.
///
/// # Errors
/// There is no scene, one can't be rendered or measured (after all others were), or, if asked for, a tile test fails.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    let root = workspace::root();
    let folder =
        arguments.folder.canonicalize().map_err(|e| format!("{}: {e}", arguments.folder.display()))?;
    let mut scenes = folder::find(&folder)?;
    scenes.retain(|scene| arguments.wants(&scene.name));
    if scenes.is_empty() {
        return Err(format!("{}: no scene (.xml, .toml) in it or below", folder.display()));
    }
    let binary = binary::build(&root)?;
    let output = arguments.out.clone().unwrap_or_else(|| root.join("target/conformance"));
    std::fs::create_dir_all(&output).map_err(|e| format!("{}: {e}", output.display()))?;

    let renderer =
        Renderer { binary: &binary, output: &output, words: arguments.words(), length: arguments.length() };
    if arguments.slope {
        return slope::run(&renderer, &scenes, arguments);
    }
    let mut rows: Vec<Row> = Vec::new();
    for scene in scenes {
        eprintln!("conformance: {}", scene.name);
        let result = renderer.measure(&scene);
        rows.push((scene.name, result));
    }
    let text = table::markdown(&arguments.summary(), &rows);
    print!("{text}");
    write(&output.join("conformance.md"), &text)?;
    write(&output.join("conformance.json"), &table::json(&arguments.summary(), &rows))?;
    verdict(arguments.strict, &rows)
}

pub(crate) fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Fails where a scene could not be measured, or where `strict` and a tile test failed.
fn verdict(strict: bool, rows: &[Row]) -> Result<(), String> {
    let is_bad = |row: &&Row| match &row.1 {
        Ok(measured) => strict && measured.tiles.as_ref().is_some_and(|tiles| !tiles.passes),
        Err(_) => true,
    };
    let bad: Vec<&str> = rows.iter().filter(is_bad).map(|(name, _)| name.as_str()).collect();
    if bad.is_empty() { Ok(()) } else { Err(format!("failed: {}", bad.join(", "))) }
}
