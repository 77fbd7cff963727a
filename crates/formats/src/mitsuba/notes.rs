//! Notes of an import, each once.

use hyaline_scene::{Note, Source};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// A growing list of notes.
#[derive(Debug, Default)]
pub(super) struct Notes {
    list: RefCell<(Vec<Note>, BTreeSet<String>)>,
}

impl Notes {
    /// Adds a warning unless a note with this message is there.
    pub(super) fn warn(&self, source: &Source, message: impl Into<String>) {
        self.add(Note::warning(source, message));
    }

    /// Adds a remark, of something that changes nothing or next to nothing.
    pub(super) fn info(&self, source: &Source, message: impl Into<String>) {
        self.add(Note::info(source, message));
    }

    fn add(&self, note: Note) {
        let (list, messages) = &mut *self.list.borrow_mut();
        if messages.insert(note.message.clone()) {
            list.push(note);
        }
    }

    /// All notes, in order.
    pub(super) fn into_list(self) -> Vec<Note> {
        self.list.into_inner().0
    }
}
