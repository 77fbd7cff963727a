//! The words of the command line.

use crate::argument;
use clap::{Args, Parser, Subcommand};
use std::num::{NonZeroU32, NonZeroUsize};
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Renders realistic transparency: glass, liquids, colored glass.
///
/// Without a scene it renders the built-in one, a glass of water.
#[derive(Debug, Parser)]
#[command(name = "hyaline", version, args_conflicts_with_subcommands = true, allow_negative_numbers = true)]
pub(crate) struct Cli {
    /// What to do; rendering where no word is given.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    /// Options of rendering.
    #[command(flatten)]
    pub(crate) render: RenderArguments,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene (the word may be left out)
    Render(Box<RenderArguments>),
    /// Add up films of one scene into a film or a picture
    Merge(MergeArguments),
    /// Make a picture of a film
    Develop(DevelopArguments),
    /// Measure how far a picture is from a reference
    Compare(CompareArguments),
    /// Say what a scene file holds and what is doubtful about it
    Check(CheckArguments),
    /// Live preview in a browser (not yet)
    View(ViewArguments),
}

/// Options of rendering.
#[derive(Clone, Debug, Args)]
pub(crate) struct RenderArguments {
    /// Scene file (.toml, .xml); without it, the built-in glass of water
    pub(crate) scene: Option<PathBuf>,
    /// Picture to write: .exr, .png or .pfm; may be repeated [default: the scene's stem .png and .exr, here]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// How light is carried: merging, path, whitted, photon-map, or debug to look at the scene [default: the scene's, else merging]
    #[arg(long, value_name = "NAME")]
    pub(crate) integrator: Option<String>,
    /// Samples per pixel in all
    #[arg(long, value_name = "N")]
    pub(crate) spp: Option<NonZeroU32>,
    /// Time from after reading the scene to the last pass: 30, 30s, 2m, 1h
    #[arg(long, value_name = "TIME", value_parser = argument::duration)]
    pub(crate) time: Option<Duration>,
    /// Stop when the picture's estimated relmse is below E: its mean squared relative error, as `compare` measures it
    #[arg(long, value_name = "E", value_parser = argument::error)]
    pub(crate) error: Option<f64>,
    /// Passes A, ..., B-1
    #[arg(long, value_name = "A..B", value_parser = argument::passes)]
    pub(crate) passes: Option<Range<u32>>,
    /// Size of the whole picture in pixels
    #[arg(long, value_name = "WxH", value_parser = argument::size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Camera of the scene [default: its first]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,
    /// Seed of all random numbers
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Threads [default: all]
    #[arg(long, value_name = "N", value_parser = argument::threads)]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Render these pixels only; x1, y1 exclusive, from the top left
    #[arg(long, value_name = "x0,y0,x1,y1", value_parser = argument::crop)]
    pub(crate) crop: Option<[u32; 4]>,
    /// Factor on radiance in PNG [default: the scene's, else 1]
    #[arg(long, value_name = "F", value_parser = argument::exposure)]
    pub(crate) exposure: Option<f32>,
    /// Set anything of the scene file by its path: settings.sampler=independent; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = argument::assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Keep the film, to be resumed or merged
    #[arg(long, value_name = "FILE")]
    pub(crate) film: Option<PathBuf>,
    /// Go on with this film, and write it again
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    /// One line of JSON as the last line on stdout
    #[arg(long)]
    pub(crate) json: bool,
    /// Obey the integrator and the sample count of an imported file
    #[arg(long)]
    pub(crate) as_file: bool,
}

/// Options of merging.
#[derive(Debug, Args)]
pub(crate) struct MergeArguments {
    /// Films with disjoint passes of one render
    #[arg(required = true, value_name = "FILM")]
    pub(crate) films: Vec<PathBuf>,
    /// Film (.film) or picture (.exr, .png, .pfm); may be repeated
    #[arg(short, long, required = true, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Factor on radiance in PNG
    #[arg(long, value_name = "F", value_parser = argument::exposure)]
    pub(crate) exposure: Option<f32>,
}

/// Options of developing.
#[derive(Debug, Args)]
pub(crate) struct DevelopArguments {
    /// Film to make a picture of
    pub(crate) film: PathBuf,
    /// Picture to write: .exr, .png or .pfm; may be repeated
    #[arg(short, long, required = true, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Factor on radiance in PNG
    #[arg(long, value_name = "F", value_parser = argument::exposure)]
    pub(crate) exposure: Option<f32>,
}

/// Options of comparing.
#[derive(Debug, Args)]
pub(crate) struct CompareArguments {
    /// Picture to judge: .exr or .pfm
    pub(crate) image: PathBuf,
    /// Picture to judge it by
    pub(crate) reference: PathBuf,
    /// Write a picture of the error
    #[arg(long, value_name = "FILE")]
    pub(crate) diff: Option<PathBuf>,
    /// Factor on radiance before FLIP
    #[arg(long, value_name = "F", value_parser = argument::exposure, default_value = "1")]
    pub(crate) exposure: f32,
    /// One line of JSON on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

/// Options of checking.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Scene file
    pub(crate) scene: PathBuf,
    /// Exit with 1 where there are warnings
    #[arg(long)]
    pub(crate) strict: bool,
    /// Set anything of the scene file by its path; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = argument::assignment)]
    pub(crate) set: Vec<(String, String)>,
}

/// Options of the preview.
#[derive(Debug, Args)]
pub(crate) struct ViewArguments {
    /// Scene file
    pub(crate) scene: Option<PathBuf>,
    /// Port to serve at
    #[arg(long, value_name = "N")]
    pub(crate) port: Option<u16>,
}
