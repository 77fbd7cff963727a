//! Times whole renders: rays and passes a second, and how this binary compares with another.
//!
//! A first run finds out how many passes fit into the time for a run. Then both binaries make that many in turn, as often
//! as asked; figures are medians, ratios are taken run by run, so that other work on the machine spoils them little.

use crate::binary::{self, last_json};
use crate::conformance::folder::{self, Scene};
use crate::workspace;
use clap::Args;
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Options of bench.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folders with scenes, at any depth [default: the gallery in scenes/]
    folders: Vec<PathBuf>,
    /// Another hyaline to time in turn with this one
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// Time for a run, as the command's
    #[arg(long, value_name = "TIME", default_value = "3")]
    time: String,
    /// Runs of each binary and scene
    #[arg(long, value_name = "N", default_value_t = 3)]
    runs: u32,
    /// Integrator; the command's default where absent
    #[arg(long, value_name = "NAME")]
    integrator: Option<String>,
    /// Threads; one for every processor where absent
    #[arg(long, value_name = "N")]
    threads: Option<u32>,
    /// Only scenes whose name contains this; may be repeated
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
}

/// Times every scene and prints a table.
///
/// # Errors
/// There is no scene, or one can't be rendered.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    let root = workspace::root();
    let scenes = folder::choose(&arguments.folders, &arguments.only)?;
    let this = binary::build(&root)?;
    let output = root.join("target/bench");
    std::fs::create_dir_all(&output).map_err(|error| format!("{}: {error}", output.display()))?;
    print!("{}", head(arguments));
    let mut ratios = Vec::new();
    for scene in scenes {
        let timed = Timed::measure(&scene, arguments, &this, &output)
            .map_err(|error| format!("{}: {error}", scene.name))?;
        println!("{}", timed.row(&scene.name));
        ratios.extend(timed.ratio());
    }
    if let Some(middle) = median(ratios) {
        println!("\nmedian of the ratios: {middle:.3}");
    }
    Ok(())
}

fn head(arguments: &Arguments) -> String {
    match arguments.against {
        None => "| scene | passes | Mray/s | passes/s |\n|---|---|---|---|\n".into(),
        Some(_) => "| scene | passes | Mray/s | passes/s | Mray/s there | passes/s there | passes/s, ratio | same picture |\n\
                    |---|---|---|---|---|---|---|---|\n"
            .into(),
    }
}

/// One run.
#[derive(Clone, Copy, Debug)]
struct Run {
    passes: u64,
    rays: f64,
    /// Preparation and passes.
    seconds: f64,
}

impl Run {
    fn from_report(report: &Value) -> Result<Self, String> {
        let number =
            |value: &Value, name: &str| value.as_f64().ok_or_else(|| format!("the report has no {name}"));
        let seconds = &report["seconds"];
        Ok(Self {
            passes: report["passes"].as_u64().ok_or("the report has no passes")?,
            rays: number(&report["rays"], "rays")?,
            seconds: number(&seconds["prepare"], "prepare")? + number(&seconds["render"], "render")?,
        })
    }
}

/// The runs of a scene.
#[derive(Debug)]
struct Timed {
    here: Vec<Run>,
    there: Vec<Run>,
    same_picture: bool,
}

impl Timed {
    fn measure(scene: &Scene, arguments: &Arguments, this: &Path, output: &Path) -> Result<Self, String> {
        let [here_file, there_file] = ["here.pfm", "there.pfm"].map(|name| output.join(name));
        let render = |binary: &Path, picture: &Path, length: [&str; 2]| {
            let mut command = Command::new(binary);
            command.arg("render").arg(&scene.file).arg("-o").arg(picture).arg("--json").args(length);
            for (option, value) in [
                ("--integrator", arguments.integrator.clone()),
                ("--threads", arguments.threads.map(|threads| threads.to_string())),
            ] {
                command.args(value.map(|value| [option.to_owned(), value]).into_iter().flatten());
            }
            Run::from_report(&last_json(&mut command)?)
        };
        let passes = render(this, &here_file, ["--time", &arguments.time])?.passes.max(1).to_string();
        let mut timed = Self { here: Vec::new(), there: Vec::new(), same_picture: false };
        for _ in 0..arguments.runs.max(1) {
            timed.here.push(render(this, &here_file, ["--spp", &passes])?);
            if let Some(other) = &arguments.against {
                timed.there.push(render(other, &there_file, ["--spp", &passes])?);
            }
        }
        if arguments.against.is_some() {
            let read =
                |file: &Path| std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()));
            timed.same_picture = read(&here_file)? == read(&there_file)?;
        }
        Ok(timed)
    }

    /// How many times as many passes a second this binary makes; `None` without another.
    fn ratio(&self) -> Option<f64> {
        median(self.here.iter().zip(&self.there).map(|(here, there)| there.seconds / here.seconds).collect())
    }

    fn row(&self, name: &str) -> String {
        let rays = |runs: &[Run]| median(runs.iter().map(|run| run.rays / run.seconds / 1e6).collect());
        let pace = |runs: &[Run]| median(runs.iter().map(|run| run.passes as f64 / run.seconds).collect());
        let mut row = format!("| {name} | {} |", self.here.first().map_or(0, |run| run.passes));
        for value in
            [rays(&self.here), pace(&self.here), rays(&self.there), pace(&self.there)].into_iter().flatten()
        {
            // Writing to a string can't fail.
            let _ = write!(row, " {value:.2} |");
        }
        if let Some(ratio) = self.ratio() {
            let _ = write!(row, " {ratio:.3} | {} |", if self.same_picture { "yes" } else { "no" });
        }
        row
    }
}

/// The middle one, or the mean of the two in the middle; `None` of none.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => None,
        count if count % 2 == 1 => Some(values[middle]),
        _ => Some(0.5 * (values[middle - 1] + values[middle])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(vec![]), None);
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), Some(2.5));
    }

    #[test]
    fn rows_tell_the_ratio_of_paired_runs() {
        let run = |seconds| Run { passes: 10, rays: 2e6, seconds };
        let timed =
            Timed { here: vec![run(1.0), run(2.0)], there: vec![run(2.0), run(3.0)], same_picture: true };
        assert_eq!(timed.ratio(), Some(1.75));
        assert_eq!(timed.row("a"), "| a | 10 | 1.50 | 7.50 | 0.83 | 4.17 | 1.750 | yes |");
        let alone = Timed { there: vec![], ..timed };
        assert_eq!(alone.row("a"), "| a | 10 | 1.50 | 7.50 |");
    }

    #[test]
    fn a_report_without_figures_is_an_error() {
        assert!(Run::from_report(&serde_json::json!({ "passes": 3 })).is_err());
    }
}
