//! Finding things by the names that descriptions use.

use hyaline_scene::{Located, SceneError};
use std::collections::HashMap;

/// Names of one kind of thing, and their indices.
pub(super) struct Names<'a> {
    kind: &'static str,
    indices: HashMap<&'a str, usize>,
    /// Names that the reader of the scene would have known without a description.
    implicit: Vec<&'static str>,
}

impl<'a> Names<'a> {
    /// Collects names in order; `kind` is what messages call such a thing.
    pub(super) fn new(kind: &'static str, names: impl Iterator<Item = &'a str>) -> Self {
        Self { kind, indices: names.enumerate().map(|(i, name)| (name, i)).collect(), implicit: Vec::new() }
    }

    /// The same, suggesting these names, too.
    pub(super) fn suggesting(self, implicit: impl Iterator<Item = &'static str>) -> Self {
        Self { implicit: implicit.collect(), ..self }
    }

    /// The index of the thing named `name`.
    ///
    /// # Errors
    /// Nothing has that name; the message suggests the nearest one.
    pub(super) fn find(&self, name: &Located<String>) -> Result<usize, SceneError> {
        if let Some(&index) = self.indices.get(name.as_str()) {
            return Ok(index);
        }
        let error = SceneError::at(&name.source, format!("no {} is named '{}'", self.kind, name.value));
        Err(match nearest(&name.value, self.indices.keys().copied().chain(self.implicit.iter().copied())) {
            Some(candidate) => error.with_remedy(format!("did you mean '{candidate}'?")),
            None => error.with_remedy(format!("the scene has no {} at all: add one", self.kind)),
        })
    }
}

/// The candidate most like `name`; ties go to the alphabetically first.
pub(super) fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let distance =
        |candidate: &str| strsim::damerau_levenshtein(&name.to_lowercase(), &candidate.to_lowercase());
    candidates.min_by_key(|candidate| (distance(candidate), *candidate))
}
