//! Failures: what is printed and with which code the command ends.

use crate::excerpt;
use hyaline_scene::{SceneError, Source};
use std::fmt::Display;
use std::io::Write;

/// Why the command ends without having done what was asked.
#[derive(Debug)]
pub(crate) struct Failure {
    /// Exit code: 1 failed while working, 2 wrong usage or an unusable scene.
    pub(crate) code: u8,
    /// Place of the fault in a scene file.
    pub(crate) source: Option<Source>,
    /// What is wrong, one line.
    pub(crate) message: String,
    /// What to do about it.
    pub(crate) remedy: Option<String>,
}

impl Failure {
    /// Wrong usage, or a file that can't be used: exit code 2.
    pub(crate) fn usage(message: impl Display) -> Self {
        Self { code: 2, source: None, message: one_line(message), remedy: None }
    }

    /// Something went wrong while working: exit code 1.
    pub(crate) fn working(message: impl Display) -> Self {
        Self { code: 1, ..Self::usage(message) }
    }

    /// Something that is planned: exit code 2.
    pub(crate) fn not_yet(what: &str) -> Self {
        Self::usage(format!("{what}: not yet"))
    }

    /// The same failure with advice.
    pub(crate) fn with_remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }

    /// The whole message: a plain first line, the excerpt, the remedy.
    pub(crate) fn text(&self) -> String {
        let mut text = match &self.source {
            Some(source) => format!("error: {source}: {}\n", self.message),
            None => format!("error: {}\n", self.message),
        };
        if let Some(excerpt) = self.source.as_ref().and_then(excerpt::underlined) {
            text.push_str(&excerpt);
        }
        if let Some(remedy) = &self.remedy {
            text.push_str(&format!("help: {remedy}\n"));
        }
        text
    }

    /// Prints the message to stderr.
    pub(crate) fn print(&self) {
        // Nobody is left to tell when stderr is closed.
        let _ = std::io::stderr().write_all(self.text().as_bytes());
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self { code: 2, source: error.source, message: one_line(error.message), remedy: error.remedy }
    }
}

/// A message without line breaks: an error's first line must say all.
fn one_line(message: impl Display) -> String {
    message
        .to_string()
        .split(['\n', '\r'])
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_holds_the_place_and_the_whole_message() {
        let source = Source { file: "absent.toml".into(), line: 3, column: 7, length: 2 };
        let failure = Failure::from(SceneError::at(&source, "bad\n  thing").with_remedy("mend it"));
        assert_eq!(failure.text(), "error: absent.toml:3:7: bad thing\nhelp: mend it\n");
        assert_eq!(failure.code, 2);
    }
}
