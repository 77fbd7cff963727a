//! What each part of `merging` is worth: scenes rendered without it, for the same time.
//!
//! A scene with a reference is compared with that; any other with a picture of its own, by all parts with another seed
//! and so many times longer. Figures are errors over that of the whole, so 2 is a picture twice as wrong.

use crate::binary::{self, last_json};
use crate::conformance::folder::{self, Scene};
use crate::workspace;
use clap::Args;
use hyaline_scene::Techniques;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;

/// Seconds that a picture of its own is rendered for, over those of a run.
const LONGER: f64 = 16.0;

/// Options of ablations.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folders with scenes, at any depth [default: the gallery in scenes/]
    folders: Vec<PathBuf>,
    /// Time for a run, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 8.0)]
    time: f64,
    /// Size of the pictures, as the command's; the scene's own where absent
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Only scenes whose name contains this; may be repeated
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
}

/// Renders every scene without each part and prints a table.
///
/// # Errors
/// There is no scene, or one can't be rendered.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    let root = workspace::root();
    let scenes = folder::choose(&arguments.folders, &arguments.only)?;
    let ablation =
        Ablation { arguments, binary: binary::build(&root)?, output: root.join("target/ablations") };
    std::fs::create_dir_all(&ablation.output)
        .map_err(|error| format!("{}: {error}", ablation.output.display()))?;
    let parts: Vec<&str> = Techniques::names().collect();
    println!("| scene | relmse of the whole | without {} |", parts.join(" | "));
    println!("|---|---|{}", "---|".repeat(parts.len()));
    for scene in scenes {
        let row = ablation.row(&scene).map_err(|error| format!("{}: {error}", scene.name))?;
        println!("{row}");
    }
    Ok(())
}

struct Ablation<'a> {
    arguments: &'a Arguments,
    binary: PathBuf,
    output: PathBuf,
}

impl Ablation<'_> {
    fn row(&self, scene: &Scene) -> Result<String, String> {
        let (reference, floor) = match &scene.reference {
            Some(reference) if self.arguments.size.is_none() => (reference.clone(), scene.floor.trimmed),
            Some(_) | None => (self.render(scene, None, 1, LONGER)?, 0.0),
        };
        let error = |part| -> Result<f64, String> {
            let picture = self.render(scene, part, 0, 1.0)?;
            let figures = last_json(
                Command::new(&self.binary).arg("compare").args([&picture, &reference]).arg("--json"),
            )?;
            let relmse =
                figures.get("relmse_trimmed").and_then(Value::as_f64).ok_or("compare tells no relmse")?;
            Ok((relmse - floor).max(0.0))
        };
        let whole = error(None)?;
        let mut row = format!("| {} | {whole:.1e} |", scene.name);
        for part in Techniques::names() {
            row.push_str(&format!(" {:.2} |", error(Some(part))? / whole));
        }
        Ok(row)
    }

    /// Renders for so many times the time of a run; returns the picture.
    fn render(&self, scene: &Scene, without: Option<&str>, seed: u32, times: f64) -> Result<PathBuf, String> {
        let name = scene.name.replace(['/', '\\'], "-");
        let picture = self.output.join(format!("{name}-{}-{seed}.exr", without.unwrap_or("whole")));
        let mut command = Command::new(&self.binary);
        command.arg("render").arg(&scene.file).args(["--integrator", "merging", "--json"]);
        command.args(["--time", &format!("{}", self.arguments.time * times), "--seed", &seed.to_string()]);
        command.args(["--output".as_ref(), picture.as_os_str()]);
        if let Some(part) = without {
            command.args(["--set", &format!("settings.without={part}")]);
        }
        if let Some(size) = &self.arguments.size {
            command.args(["--size", size]);
        }
        last_json(&mut command)?;
        Ok(picture)
    }
}
