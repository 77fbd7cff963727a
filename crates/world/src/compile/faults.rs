//! Faults, gathered: one of them doesn't hide the next.

use hyaline_scene::SceneError;

/// What was found wrong so far.
#[derive(Debug, Default)]
pub(super) struct Faults(Vec<SceneError>);

impl Faults {
    /// The value; `None`, and the fault kept, where there is none. A fault that is known already is not kept twice.
    pub(super) fn keep<T>(&mut self, result: Result<T, SceneError>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(fault) => {
                if !self.0.contains(&fault) {
                    self.0.push(fault);
                }
                None
            }
        }
    }

    /// Goes on only where nothing was wrong.
    ///
    /// # Errors
    /// All faults, in the order in which they were found.
    pub(super) fn none(&mut self) -> Result<(), Vec<SceneError>> {
        if self.0.is_empty() { Ok(()) } else { Err(std::mem::take(&mut self.0)) }
    }
}
