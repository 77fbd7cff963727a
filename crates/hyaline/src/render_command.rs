//! `hyaline render`: from a scene to pictures, within limits, with a film that can be resumed.

use crate::cli::RenderArguments;
use crate::digest;
use crate::failure::Failure;
use crate::film_file::FilmFiles;
use crate::message::{self, Warnings};
use crate::output::{self, Output};
use crate::plan::{self, Plan};
use crate::progress_bar::Bar;
use crate::report::{Report, Seconds};
use crate::signal::Signals;
use crate::{inventory, memory, picture, scene_source, used_settings};
use hyaline_film::Film;
use hyaline_render::{Job, Outcome, Workers};
use hyaline_world::World;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Renders; returns the exit code: 0, or that of the signal that ended it.
///
/// # Errors
/// Wrong usage, a scene that can't be used, a result that can't be written.
pub(crate) fn run(arguments: &RenderArguments) -> Result<u8, Failure> {
    let files = Files::new(arguments)?;
    let signals = Signals::listen().map_err(Failure::working)?;
    let workers = Workers::new(arguments.threads).map_err(|error| {
        Failure::usage(format!("--threads: {error}")).with_remedy("ask for fewer threads")
    })?;
    let mut warnings = Warnings::default();
    let Ready { world, plan, film, start, load_time, build_time } =
        make_ready(arguments, &files, &workers, &mut warnings)?;
    let job = Job {
        view: plan.view,
        settings: plan.settings,
        crop: plan.crop,
        limits: plan.limits.clone(),
        workers: &workers,
        elapsed: &|| start.elapsed(),
        watches_error: Bar::is_seen(),
        cancel: &signals.cancel,
    };
    let outcome = render(&world, &plan, &job, film, &files, &mut warnings);
    workers.run(|| files.write(&outcome.film, plan.exposure))?;
    tell_faults(&outcome, &world, &mut warnings);
    tell(arguments, &files, &outcome, [load_time, build_time], warnings)?;
    Ok(signals.exit_code().unwrap_or(0))
}

/// All that a render starts from.
struct Ready {
    world: World,
    plan: Plan,
    film: Film,
    /// When the scene's files had been read: a time limit counts from here.
    start: Instant,
    load_time: Duration,
    build_time: Duration,
}

/// Reads and compiles the scene, and opens the film.
fn make_ready(
    arguments: &RenderArguments,
    files: &Files,
    workers: &Workers,
    warnings: &mut Warnings,
) -> Result<Ready, Failure> {
    let load_start = Instant::now();
    let mut scene = workers.run(|| scene_source::load(arguments.scene.as_deref(), &arguments.set))?;
    let load_time = load_start.elapsed();

    let start = Instant::now();
    let plan = plan::plan(arguments, &mut scene)?;
    let film = files.film.open(digest::film_header(&scene, &plan))?;
    for line in used_settings::idle(plan.integrator.name(), &scene.settings, &plan.settings) {
        message::print(&format!("note: {line}"));
    }
    warnings.tell_notes(&scene.notes);
    if let Some(warning) = used_settings::unseen_light(plan.integrator.name(), &scene.media) {
        warnings.tell(warning);
    }
    if let Some(file) = scene.settings.file_integrator.as_ref().filter(|_| !arguments.as_file) {
        message::print(&format!("note: the file asks for {}", inventory::file_integrator(file)));
    }
    let (world, notes) = workers.run(|| World::compile(&scene))?;
    warnings.tell_notes(&notes);
    Ok(Ready { world, plan, film, start, load_time, build_time: start.elapsed() })
}

/// Makes the passes, with a progress bar, keeping the film now and then.
fn render(
    world: &World,
    plan: &Plan,
    job: &Job<'_>,
    film: Film,
    files: &Files,
    warnings: &mut Warnings,
) -> Outcome {
    let bar = Bar::new();
    let mut failure = None;
    let mut checkpoint = |film: &Film| {
        if let Err(error) = files.write_film(film) {
            // Disks are emptied: the next checkpoint may succeed, and the last must.
            failure.get_or_insert(error.message);
        }
    };
    let integrator = plan.integrator.as_ref();
    let outcome = hyaline_render::render(
        world,
        integrator,
        job,
        film,
        &mut |progress| bar.show(progress),
        &mut checkpoint,
    );
    bar.clear();
    if let Some(failure) = failure {
        warnings.tell(format!("a checkpoint failed: {failure}"));
    }
    outcome
}

/// Rays among which one that loses track of its medium is rounding's doing, and harmless: at an edge two faces swap.
const RAYS_PER_ROUNDING: u64 = 1_000_000;

/// Warns of what should not have happened while rendering.
fn tell_faults(outcome: &Outcome, world: &World, warnings: &mut Warnings) {
    for (&object, count) in &outcome.stats.never_entered {
        let name = world.object_names.get(object as usize).map_or("without a name", String::as_str);
        let rays = outcome.stats.rays;
        if count.saturating_mul(RAYS_PER_ROUNDING) < rays {
            continue;
        }
        warnings.tell(format!(
            "boundary left that was never entered: object {name}, {count} of {rays} rays; is it closed, and the camera in the medium it seems to be in?"
        ));
    }
    match outcome.film.nonfinite() {
        0 => {}
        count => warnings.tell(format!("{count} samples were not finite and count as black")),
    }
}

/// Tells what was done: for programs on stdout, for people on stderr.
fn tell(
    arguments: &RenderArguments,
    files: &Files,
    outcome: &Outcome,
    [load_time, build_time]: [Duration; 2],
    warnings: Warnings,
) -> Result<(), Failure> {
    let passes = outcome.film.passes().len();
    let report = Report {
        passes,
        spp: passes,
        seconds: Seconds {
            load: load_time.as_secs_f64(),
            build: build_time.as_secs_f64(),
            prepare: outcome.prepare_time.as_secs_f64(),
            render: outcome.render_time.as_secs_f64(),
        },
        rays: outcome.stats.rays,
        photons: outcome.stats.photons,
        error: hyaline_film::error_estimate(&outcome.film),
        photon_maps: outcome.photons.map(Into::into),
        branches_cut: outcome.stats.branches_cut,
        peak_memory_bytes: memory::peak_bytes(),
        warnings: warnings.into_texts(),
    };
    if outcome.was_canceled {
        message::print("interrupted");
    }
    message::print(&report.to_text());
    if passes == 0 {
        message::print("nothing is written: there is no whole pass");
    } else {
        files.tell(arguments.scene.is_none());
    }
    if arguments.json {
        message::print_result(&report.to_json()).map_err(Failure::working)?;
    }
    Ok(())
}

/// All files that a render writes.
struct Files {
    pictures: Vec<Output>,
    film: FilmFiles,
}

impl Files {
    /// # Errors
    /// An ending that is not known, a place that can't be written to, a place given twice.
    fn new(arguments: &RenderArguments) -> Result<Self, Failure> {
        let film = FilmFiles::new(arguments.film.as_deref(), arguments.resume.as_deref())?;
        let paths = if arguments.output.is_empty() {
            let stem = scene_source::stem(arguments.scene.as_deref());
            ["png", "exr"].map(|ending| with_ending(&stem, ending)).to_vec()
        } else {
            arguments.output.clone()
        };
        output::check_distinct(paths.iter().chain(&film.keep).map(PathBuf::as_path))?;
        let pictures = paths.iter().map(|path| Output::picture(path)).collect::<Result<_, _>>()?;
        Ok(Self { pictures, film })
    }

    fn write_film(&self, film: &Film) -> Result<(), Failure> {
        match &self.film.keep {
            Some(path) => film.write(path).map_err(|error| picture::unwritten(path, error)),
            None => Ok(()),
        }
    }

    /// Writes film and pictures; nothing where there is no pass to show. A file that can't be written keeps none of
    /// the others from being written.
    fn write(&self, film: &Film, exposure: f32) -> Result<(), Failure> {
        if film.passes().is_empty() {
            return Ok(());
        }
        let film_written = self.write_film(film);
        let image = picture::develop(film)?;
        let write = |output: &Output| picture::write(&image, &output.path, exposure);
        let pictures_written: Vec<Result<(), Failure>> = self.pictures.iter().map(write).collect();
        std::iter::once(film_written).chain(pictures_written).collect()
    }

    /// Says where the files are, and after the built-in scene what to try next.
    fn tell(&self, is_built_in: bool) {
        for path in self.pictures.iter().map(|output| &output.path).chain(&self.film.keep) {
            message::print(&format!("wrote {}", path.display()));
        }
        if is_built_in {
            message::print(TRY_NEXT);
        }
    }
}

/// What to try after the built-in scene.
const TRY_NEXT: &str = "\
try next:
  cargo run --release -- scenes/glass-of-beer.toml      another scene
  cargo run --release -- --size 1280x960 --time 5m      a larger, finer picture
  cargo run --release -- check scenes/fishbowl.toml     what a scene holds
  cargo run --release -- --help                         everything else";

/// `stem.ending`, dots in the stem left alone.
fn with_ending(stem: &std::path::Path, ending: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}
