//! One scene: rendered, as long as wanted, and compared with its reference.

use super::folder::Scene;
use super::tiles::{Noise, Tiles};
use crate::binary::last_json;
use hyaline_film::{Film, develop, variance_of_mean};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Groups of passes that tell what noise pixels share, and the part of the picture's passes that each has.
const GROUPS: u64 = 8;
const GROUP_PART: u64 = 16;

/// How long to render a scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Length {
    /// Samples per pixel.
    Samples(u32),
    /// Time, as the command takes it.
    Time(String),
    /// Until the standard error of the picture's mean is small enough for the tile test.
    Settled {
        /// Samples per pixel of the first round.
        first: u32,
        /// Samples per pixel at most.
        most: u32,
    },
}

/// How to render.
#[derive(Debug)]
pub(crate) struct Renderer<'a> {
    /// The command.
    pub(crate) binary: &'a Path,
    /// Folder for pictures and films.
    pub(crate) output: &'a Path,
    /// Words for the command: sampler, integrator.
    pub(crate) words: Vec<String>,
    /// How long.
    pub(crate) length: Length,
}

/// What was measured of a scene.
pub(crate) struct Measured {
    /// Samples per pixel.
    pub(crate) spp: u64,
    /// Build, preparation and passes, of all rounds.
    pub(crate) seconds: f64,
    /// What the render warned of.
    pub(crate) warnings: Vec<String>,
    /// The error that the render itself estimates.
    pub(crate) estimate: Option<f64>,
    /// Mean of the picture and its error.
    pub(crate) noise: Noise,
    /// What `hyaline compare --json` tells; `None` without a reference.
    pub(crate) figures: Option<Value>,
    /// Tiles against the reference's; `None` where its variance isn't known.
    pub(crate) tiles: Option<Tiles>,
}

/// Files that a scene's render leaves.
struct Files {
    image: PathBuf,
    film: PathBuf,
    diff: PathBuf,
}

impl Renderer<'_> {
    /// Renders a scene and compares it.
    ///
    /// # Errors
    /// The command fails, or its results can't be read.
    pub(crate) fn measure(&self, scene: &Scene) -> Result<Measured, String> {
        let files = self.files(scene);
        let mut measured = self.render(scene, &files)?;
        if let Some(reference) = &scene.reference {
            measured.figures = Some(self.compare(scene, reference, &files)?);
            if let Some(variance) = &scene.variance {
                let groups = self.groups(scene, &files, measured.spp)?;
                measured.tiles = Some(Tiles::test(&files.film, &groups, reference, variance)?);
            }
        }
        Ok(measured)
    }

    /// Renders a scene on to each of these numbers of passes in turn, and compares it after each.
    ///
    /// # Errors
    /// The scene has no reference, and as `measure`.
    pub(crate) fn series(&self, scene: &Scene, lengths: &[u32]) -> Result<Vec<Measured>, String> {
        let reference = scene.reference.as_ref().ok_or("there is no reference")?;
        let files = self.files(scene);
        remove(&files.film)?;
        let measure = |passes: &u32| {
            let measured = self.round(scene, &files, &["--spp".into(), passes.to_string()])?;
            Ok(Measured { figures: Some(self.compare(scene, reference, &files)?), ..measured })
        };
        lengths.iter().map(measure).collect()
    }

    fn files(&self, scene: &Scene) -> Files {
        let stem = scene.name.replace('/', "-");
        let [image, film, diff] =
            [".exr", ".film", "-error.png"].map(|ending| self.output.join(format!("{stem}{ending}")));
        Files { image, film, diff }
    }

    /// Renders in as many rounds as it takes.
    fn render(&self, scene: &Scene, files: &Files) -> Result<Measured, String> {
        remove(&files.film)?;
        let first: Vec<String> = match &self.length {
            Length::Samples(spp) | Length::Settled { first: spp, .. } => {
                vec!["--spp".into(), spp.to_string()]
            }
            Length::Time(time) => vec!["--time".into(), time.clone()],
        };
        let mut measured = self.round(scene, files, &first)?;
        let Length::Settled { most, .. } = self.length else { return Ok(measured) };
        while let Some(spp) = measured.noise.next_length(measured.spp, most.into()) {
            eprintln!("  error of the mean {:.2} %, on to {spp} spp", 100.0 * measured.noise.relative_error);
            let next = self.round(scene, files, &["--spp".into(), spp.to_string()])?;
            measured = Measured { seconds: measured.seconds + next.seconds, ..next };
        }
        Ok(measured)
    }

    /// Films of passes after the first `spp`, where the pixels of a pass share photons; else none.
    fn groups(&self, scene: &Scene, files: &Files, spp: u64) -> Result<Vec<Film>, String> {
        let film = Film::read(&files.film).map_err(|error| format!("{}: {error}", files.film.display()))?;
        if !film.header().parts.iter().any(|part| part.name == "integrator" && part.value == "merging") {
            return Ok(Vec::new());
        }
        let passes = (spp / GROUP_PART).max(2);
        let (image, film) = (files.film.with_extension("group.exr"), files.film.with_extension("group.film"));
        let group = |number: u64| {
            let first = spp + number * passes;
            remove(&film)?;
            let mut render = Command::new(self.binary);
            render.arg("render").arg(&scene.file).arg("-o").arg(&image).arg("--film").arg(&film);
            render.arg("--passes").arg(format!("{first}..{}", first + passes));
            last_json(render.arg("--json").args(&self.words))?;
            let read = Film::read(&film).map_err(|error| format!("{}: {error}", film.display()))?;
            remove(&film)?;
            remove(&image)?;
            Ok(read)
        };
        (0..GROUPS).map(group).collect()
    }

    /// Renders once, going on with what is there.
    fn round(&self, scene: &Scene, files: &Files, length: &[String]) -> Result<Measured, String> {
        let mut render = Command::new(self.binary);
        render.arg("render").arg(&scene.file).arg("-o").arg(&files.image);
        render.arg(if files.film.is_file() { "--resume" } else { "--film" }).arg(&files.film);
        let report = last_json(render.arg("--json").args(&self.words).args(length))?;
        let seconds = ["build", "prepare", "render"].iter();
        let warnings = report["warnings"].as_array().into_iter().flatten();
        Ok(Measured {
            spp: report["spp"].as_u64().unwrap_or(0),
            seconds: seconds.filter_map(|key| report["seconds"][key].as_f64()).sum(),
            warnings: warnings.filter_map(|text| text.as_str().map(str::to_owned)).collect(),
            estimate: report["error"].as_f64(),
            noise: noise(&files.film)?,
            figures: None,
            tiles: None,
        })
    }

    fn compare(&self, scene: &Scene, reference: &Path, files: &Files) -> Result<Value, String> {
        let mut compare = Command::new(self.binary);
        compare.arg("compare").arg(&files.image).arg(reference).arg("--json").arg("--diff").arg(&files.diff);
        last_json(compare.arg("--exposure").arg(scene.exposure.to_string()))
    }
}

/// The mean of a film's picture, and its error where the film has two passes.
fn noise(path: &Path) -> Result<Noise, String> {
    let film = Film::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Noise::new(&develop(&film), variance_of_mean(&film).as_ref()))
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
