//! Lines on stderr: warnings, remarks, where files are.

use hyaline_scene::{Note, Severity};
use std::io::Write;

/// Prints a line to stderr. A closed stderr is nobody's fault.
pub(crate) fn print(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints a line to stdout.
///
/// # Errors
/// stdout is closed or full.
pub(crate) fn print_result(line: &str) -> std::io::Result<()> {
    let mut stdout = std::io::stdout().lock();
    writeln!(stdout, "{line}")?;
    stdout.flush()
}

/// The warnings of a run, each told once.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    told: Vec<String>,
}

impl Warnings {
    /// Tells what is noted about a scene: remarks only on stderr, warnings also in the report.
    pub(crate) fn tell_notes(&mut self, notes: &[Note]) {
        let mut remarks: Vec<String> = Vec::new();
        for note in notes {
            let text = note.to_string();
            match note.severity {
                Severity::Warning => self.tell(text),
                Severity::Info if remarks.contains(&text) => {}
                Severity::Info => {
                    print(&format!("note: {text}"));
                    remarks.push(text);
                }
            }
        }
    }

    /// Tells a warning, unless it was told before.
    pub(crate) fn tell(&mut self, text: String) {
        if !self.told.contains(&text) {
            print(&format!("warning: {text}"));
            self.told.push(text);
        }
    }

    /// All that was told, in order.
    pub(crate) fn into_texts(self) -> Vec<String> {
        self.told
    }

    /// How many were told.
    pub(crate) fn count(&self) -> usize {
        self.told.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_scene::Source;

    #[test]
    fn a_warning_is_told_once_and_remarks_are_no_warnings() {
        let mut warnings = Warnings::default();
        let source = Source::file("a.toml");
        warnings.tell_notes(&[
            Note::warning(&source, "odd"),
            Note::info(&source, "known"),
            Note::warning(&source, "odd"),
        ]);
        assert_eq!(warnings.into_texts(), ["a.toml: odd"]);
    }
}
