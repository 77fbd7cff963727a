//! The bar on stderr; there is none off a terminal.

use hyaline_render::{Progress, Stage};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

/// Steps of a full bar.
const STEPS: u64 = 1000;

/// Shows how far a render is.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// A bar on stderr, or none where that is no terminal.
    pub(crate) fn new() -> Self {
        let bar =
            if std::io::stderr().is_terminal() { ProgressBar::new(STEPS) } else { ProgressBar::hidden() };
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

/// Passes and time left, in words.
fn message(progress: Progress) -> String {
    if progress.stage == Stage::Preparing {
        return "preparing".into();
    }
    let passes = match progress.passes_wanted {
        Some(wanted) => format!("{} of {wanted} passes", progress.passes_done),
        None => format!("{} passes", progress.passes_done),
    };
    match progress.seconds_left {
        Some(seconds) => format!("{passes}, {} left", clock(seconds)),
        None => passes,
    }
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
        };
        assert_eq!(message(progress), "12 of 64 passes, 1:02 left");
        assert_eq!(message(Progress { passes_wanted: None, ..progress }), "12 passes, 1:02 left");
        assert_eq!(clock(3723.0), "1:02:03");
    }
}
