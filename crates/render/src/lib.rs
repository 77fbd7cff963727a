//! Passes over threads: limits, progress, checkpoints.
//!
//! [`render`] makes numbered passes until a limit is reached and adds them to a film. Which passes were made is all
//! that the film depends on; threads, batches and clocks decide only on their number.

mod batch;
mod job;
mod pace;
mod progress;
mod render;
mod settings;
mod tile;
mod watch;
mod workers;

pub use job::{Job, Limits, Outcome};
pub use progress::{Progress, Stage};
pub use render::render;
pub use settings::render_settings;
pub use workers::Workers;

/// Version of all that decides on pictures, part of a film's digest; raised whenever a picture changes.
pub const ALGORITHM_VERSION: u32 = 17;
