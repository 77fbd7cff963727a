//! A render makes the passes it is asked for, each once and whole, whatever the threads, the clock and interruptions.

use hyaline_film::{Film, FilmHeader, PixelSample, Rect, error_estimate};
use hyaline_math::{DVec3, Transform};
use hyaline_render::{Job, Limits, Outcome, Workers, render};
use hyaline_scene::{
    CameraDescription, FovAxis, LightDescription, LightKind, Located, PixelFilter, Projection,
    SceneDescription, Source,
};
use hyaline_transport::{Integrator, Pass, Prepared, RenderSettings, Stats, View};
use hyaline_world::World;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// A picture of 45 x 37 pixels, of which a part is rendered.
const FRAME: (u32, u32) = (45, 37);
const CROP: Rect = Rect { x0: 3, y0: 2, x1: 43, y1: 36 };

/// What the integrator under test and the test share.
#[derive(Default)]
struct Shared {
    /// Asks the render to stop.
    cancel: AtomicBool,
    /// The clock, seconds.
    seconds: AtomicU64,
    /// What a pass adds to the clock, seconds.
    pass_seconds: u64,
}

/// An integrator whose samples tell pixel and pass; it can be made to ask for a stop in the midst of a pass.
struct Counting {
    shared: Arc<Shared>,
    cancel_in: Option<u32>,
}

struct CountingPass<'a> {
    integrator: &'a Counting,
    pass: u32,
}

impl Integrator for Counting {
    fn name(&self) -> &'static str {
        "counting"
    }

    fn prepare<'w>(
        &self,
        _world: &'w World,
        _view: &View,
        _settings: &RenderSettings,
        _cancel: &AtomicBool,
        _stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        Box::new(Counting { shared: Arc::clone(&self.shared), cancel_in: self.cancel_in })
    }
}

impl Prepared for Counting {
    fn begin_pass<'a>(&'a self, pass: u32, stats: &mut Stats) -> Box<dyn Pass + 'a> {
        self.shared.seconds.fetch_add(self.shared.pass_seconds, Ordering::SeqCst);
        stats.photons += 1;
        Box::new(CountingPass { integrator: self, pass })
    }
}

impl Pass for CountingPass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        for ((x, y), sample) in tile.pixels().zip(samples) {
            *sample = sample_of(x, y, self.pass);
            stats.rays += 1;
        }
        if self.integrator.cancel_in == Some(self.pass) {
            self.integrator.shared.cancel.store(true, Ordering::SeqCst);
        }
    }
}

fn sample_of(x: u32, y: u32, pass: u32) -> PixelSample {
    PixelSample { beauty: [x as f32, y as f32, 0.1 * pass as f32], ..PixelSample::default() }
}

/// A world with nothing but a sky.
fn world() -> World {
    let source = Source::built_in();
    let camera = CameraDescription {
        name: "camera".into(),
        placement: Transform::translate(DVec3::ZERO),
        projection: Projection::Perspective { fov: 1.0, fov_axis: FovAxis::Y },
        medium: None,
    };
    let placement = Transform::translate(DVec3::ZERO);
    let sky = LightKind::Environment { radiance: [1.0; 3], image: None, placement, visible_to_camera: true };
    let scene = SceneDescription {
        cameras: vec![Located::new(camera, source.clone())],
        lights: vec![Located::new(LightDescription { name: "sky".into(), kind: sky, medium: None }, source)],
        ..SceneDescription::default()
    };
    World::compile(&scene).expect("a world").0
}

fn empty_film() -> Film {
    let (width, height) = FRAME;
    Film::new(FilmHeader { width, height, crop: CROP, seed: 0, parts: Vec::new() }).expect("a film")
}

/// The film that these passes make.
fn film_of(passes: impl IntoIterator<Item = u32>) -> Film {
    let mut film = empty_film();
    for pass in passes {
        let samples: Vec<PixelSample> = CROP.pixels().map(|(x, y)| sample_of(x, y, pass)).collect();
        film.add_tile(pass, CROP, &samples);
        film.finish_pass(pass).expect("a new pass");
    }
    film
}

/// Options of a run.
struct Run {
    passes: Range<u32>,
    time: Option<u64>,
    error: Option<f64>,
    threads: usize,
    cancel_in: Option<u32>,
    pass_seconds: u64,
}

impl Run {
    fn of(passes: Range<u32>) -> Self {
        Self { passes, time: None, error: None, threads: 2, cancel_in: None, pass_seconds: 1 }
    }

    /// Runs on `film`; returns the outcome and the number of passes at each checkpoint.
    fn on(&self, film: Film) -> (Outcome, Vec<u64>) {
        let shared = Arc::new(Shared { pass_seconds: self.pass_seconds, ..Shared::default() });
        let integrator = Counting { shared: Arc::clone(&shared), cancel_in: self.cancel_in };
        let workers = Workers::new(NonZeroUsize::new(self.threads)).expect("threads");
        let (width, height) = FRAME;
        let filter = hyaline_world::camera::PixelFilter::new(&PixelFilter::Box);
        let job = Job {
            view: View { camera: 0, width, height, filter },
            settings: RenderSettings::default(),
            crop: CROP,
            limits: Limits {
                passes: self.passes.clone(),
                time: self.time.map(Duration::from_secs),
                error: self.error,
            },
            workers: &workers,
            elapsed: &|| Duration::from_secs(shared.seconds.load(Ordering::SeqCst)),
            watches_error: false,
            cancel: &shared.cancel,
        };
        let mut checkpoints = Vec::new();
        let mut checkpoint = |film: &Film| checkpoints.push(film.passes().len());
        let outcome = render(&world(), &integrator, &job, film, &mut |_| {}, &mut checkpoint);
        (outcome, checkpoints)
    }
}

#[test]
fn the_passes_asked_for_are_made_on_any_number_of_threads() {
    for threads in [1, 2, 7] {
        let (outcome, _) = Run { threads, ..Run::of(3..50) }.on(empty_film());
        assert_eq!(outcome.film, film_of(3..50));
        assert_eq!(outcome.passes_made, 47);
        assert_eq!(outcome.stats.photons, 47);
        assert_eq!(outcome.stats.rays, 47 * CROP.area() as u64);
        assert!(!outcome.was_canceled);
    }
}

#[test]
fn passes_that_the_film_holds_are_not_made_again() {
    let (outcome, _) = Run::of(0..9).on(film_of([2, 3, 7, 30]));
    assert_eq!(outcome.film, film_of((0..9).chain([30])));
    assert_eq!(outcome.passes_made, 6);
}

#[test]
fn a_render_with_nothing_left_to_do_ends() {
    let (outcome, checkpoints) = Run::of(0..4).on(film_of(0..4));
    assert_eq!(outcome.film, film_of(0..4));
    assert_eq!((outcome.passes_made, checkpoints.len()), (0, 0));
}

#[test]
fn a_canceled_render_keeps_whole_passes_only() {
    let (outcome, _) = Run { threads: 1, cancel_in: Some(5), ..Run::of(0..20) }.on(empty_film());
    assert!(outcome.was_canceled);
    assert_eq!(outcome.film, film_of(0..5));
}

#[test]
fn a_render_canceled_amid_many_passes_has_made_the_first_of_them() {
    for threads in [1, 2, 7] {
        let run = Run { threads, cancel_in: Some(40), pass_seconds: 0, ..Run::of(0..60) };
        let (outcome, _) = run.on(empty_film());
        assert!(outcome.was_canceled && outcome.passes_made <= 40);
        assert_eq!(outcome.film, film_of(0..outcome.passes_made));
    }
}

#[test]
fn a_time_limit_ends_the_render_before_it_runs_over() {
    let (outcome, _) = Run { time: Some(30), ..Run::of(0..u32::MAX) }.on(empty_film());
    assert_eq!(outcome.film, film_of(0..30));
    let (outcome, _) = Run { time: Some(30), ..Run::of(0..8) }.on(empty_film());
    assert_eq!(outcome.film, film_of(0..8));
}

#[test]
fn an_error_limit_is_reached_at_the_same_pass_however_the_render_is_run() {
    let error = 0.0053;
    let is_small = |passes: u32| error_estimate(&film_of(0..passes)).is_some_and(|found| found < error);
    // Looks at 8, 9, ..., 16, 18, 20, 22, 24, 27, ... passes.
    let wanted = [16, 18, 20, 22, 24, 27, 30].into_iter().find(|&passes| is_small(passes)).expect("in reach");
    assert!(wanted > 16 && !is_small(wanted - 2));
    for (threads, pass_seconds) in [(1, 1), (2, 0), (7, 0)] {
        let run = || Run { error: Some(error), threads, pass_seconds, ..Run::of(0..u32::MAX) };
        assert_eq!(run().on(empty_film()).0.film, film_of(0..wanted));
        assert_eq!(run().on(film_of(0..wanted - 3)).0.film, film_of(0..wanted));
        assert_eq!(run().on(film_of(0..wanted)).0.passes_made, 0);
    }
    let first_of_several = Run { error: Some(error), ..Run::of(0..11) };
    assert_eq!(first_of_several.on(empty_film()).0.film, film_of(0..11));
}

#[test]
fn checkpoints_come_after_the_first_pass_and_then_every_ten_seconds() {
    let (_, checkpoints) = Run::of(0..35).on(empty_film());
    assert_eq!(checkpoints, [1, 10, 19, 28]);
}
