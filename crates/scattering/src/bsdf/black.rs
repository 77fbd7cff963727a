//! No reflection at all.

/// A surface that swallows all light; what emitters without another finish have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Black;
