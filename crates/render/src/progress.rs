//! What a render tells while it runs.

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What it is doing.
    pub stage: Stage,
    /// Passes finished by this run.
    pub passes_done: u32,
    /// Passes that this run is to make; `None` where only time or error ends it.
    pub passes_wanted: Option<u32>,
    /// Part of the work that is done, 0…1.
    pub fraction: f64,
    /// Expected time to the end, seconds; `None` before anything is known.
    pub seconds_left: Option<f64>,
    /// Estimated error of the film, when last looked at.
    pub error: Option<f64>,
}

/// What a render is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Learning what all passes share.
    Preparing,
    /// Making passes.
    Rendering,
}
