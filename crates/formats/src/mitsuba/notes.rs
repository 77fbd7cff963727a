//! Warnings of an import, each once.

use hyaline_scene::{Note, Source};
use std::cell::RefCell;

/// A growing list of warnings.
#[derive(Debug, Default)]
pub(super) struct Notes {
    list: RefCell<Vec<Note>>,
}

impl Notes {
    /// Adds a warning unless one with this message is there.
    pub(super) fn warn(&self, source: &Source, message: impl Into<String>) {
        let note = Note::warning(source, message);
        let mut list = self.list.borrow_mut();
        if !list.iter().any(|other| other.message == note.message) {
            list.push(note);
        }
    }

    /// All warnings.
    pub(super) fn into_list(self) -> Vec<Note> {
        self.list.into_inner()
    }
}
