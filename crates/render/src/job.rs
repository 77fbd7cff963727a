//! What is asked of a render, and what comes of it.

use crate::workers::Workers;
use hyaline_film::{Film, Rect};
use hyaline_transport::photon::maps::PhotonStatistics;
use hyaline_transport::{RenderSettings, Stats, View};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// What is asked of a render.
pub struct Job<'a> {
    /// Which picture is taken.
    pub view: View,
    /// What the integrator is told.
    pub settings: RenderSettings,
    /// Pixels to render, those of the film.
    pub crop: Rect,
    /// When it ends.
    pub limits: Limits,
    /// The threads to render with.
    pub workers: &'a Workers,
    /// Time since the scene's files were read: what a time limit counts.
    pub elapsed: &'a dyn Fn() -> Duration,
    /// Whether progress tells the error: where nobody watches, it is not worked out.
    pub watches_error: bool,
    /// Set from outside to stop soon: the pass in progress is given up, finished passes are kept.
    pub cancel: &'a AtomicBool,
}

/// When a render ends: at the first of these.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Passes to make; those that the film holds already are skipped.
    pub passes: Range<u32>,
    /// Time by [`Job::elapsed`]. At least one pass is made; none is started that is expected to end after 1.1 times
    /// this.
    pub time: Option<Duration>,
    /// The error that is small enough, by `hyaline_film::error_estimate`. It is looked at when the film holds 8 passes, and
    /// again each time it has grown by an eighth: how many passes that takes depends on the picture alone.
    pub error: Option<f64>,
}

impl Limits {
    /// Whether nothing but time or error ends the render.
    pub(crate) fn are_open(&self) -> bool {
        self.passes.end == u32::MAX && (self.time.is_some() || self.error.is_some())
    }
}

/// What comes of a render.
#[derive(Debug)]
pub struct Outcome {
    /// The film with the new passes added.
    pub film: Film,
    /// Passes made by this run.
    pub passes_made: u32,
    /// What this run did and ran into.
    pub stats: Stats,
    /// What the integrator's photon stage did, where it has one.
    pub photons: Option<PhotonStatistics>,
    /// How long the integrator prepared.
    pub prepare_time: Duration,
    /// How long passes and checkpoints took.
    pub render_time: Duration,
    /// Whether it was stopped from outside.
    pub was_canceled: bool,
}
