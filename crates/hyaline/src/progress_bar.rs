//! The bar on stderr; there is none off a terminal.

use hyaline_render::{Progress, Stage};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

/// Steps of a full bar.
const STEPS: u64 = 1000;

/// Shows how far a render is.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// Whether anyone sees the bar.
    pub(crate) fn is_seen() -> bool {
        std::io::stderr().is_terminal()
    }

    /// A bar on stderr, or none where that is no terminal.
    pub(crate) fn new() -> Self {
        let bar = if Self::is_seen() { ProgressBar::new(STEPS) } else { ProgressBar::hidden() };
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Shows `progress`.
    pub(crate) fn show(&self, progress: Progress) {
        self.0.set_position((progress.fraction * STEPS as f64) as u64);
        self.0.set_message(message(progress));
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        self.0.finish_and_clear();
    }
}

/// Passes, time left and error, in words.
fn message(progress: Progress) -> String {
    if progress.stage == Stage::Preparing {
        return "preparing".into();
    }
    let passes = match progress.passes_wanted {
        Some(wanted) => format!("{} of {wanted} passes", progress.passes_done),
        None => format!("{} passes", progress.passes_done),
    };
    let left = progress.seconds_left.map(|seconds| format!(", {} left", clock(seconds)));
    let error = progress.error.map(|error| format!(", error {error:.1e}"));
    [Some(passes), left, error].into_iter().flatten().collect()
}

/// A time as `m:ss` or `h:mm:ss`.
fn clock(seconds: f64) -> String {
    let seconds = seconds.ceil() as u64;
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_tells_passes_and_time_left() {
        let progress = Progress {
            stage: Stage::Rendering,
            passes_done: 12,
            passes_wanted: Some(64),
            fraction: 0.2,
            seconds_left: Some(61.2),
            error: None,
        };
        assert_eq!(message(progress), "12 of 64 passes, 1:02 left");
        assert_eq!(message(Progress { passes_wanted: None, ..progress }), "12 passes, 1:02 left");
        let progress = Progress { error: Some(1.24e-3), ..progress };
        assert_eq!(message(progress), "12 of 64 passes, 1:02 left, error 1.2e-3");
        assert_eq!(message(Progress { seconds_left: None, ..progress }), "12 of 64 passes, error 1.2e-3");
        assert_eq!(clock(3723.0), "1:02:03");
    }
}
