//! Where things were said, and what is wrong with them.

use serde::{Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// A place in a file; lines and columns count from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// File as the user named it.
    pub file: Arc<str>,
    /// Line, from 1; 0 where unknown.
    pub line: u32,
    /// Column, from 1; 0 where unknown.
    pub column: u32,
    /// Length in bytes of what is meant, for underlining; at least 1.
    pub length: u32,
}

impl Source {
    /// Place of things that were built in code.
    pub fn built_in() -> Self {
        Self { file: Arc::from("<built-in>"), line: 0, column: 0, length: 1 }
    }

    /// A file as a whole.
    pub fn file(file: impl Into<Arc<str>>) -> Self {
        Self { file: file.into(), line: 0, column: 0, length: 1 }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => write!(f, "{}", self.file),
            (line, 0) => write!(f, "{}:{line}", self.file),
            (line, column) => write!(f, "{}:{line}:{column}", self.file),
        }
    }
}

/// A value with the place where it was said. Serializes as the value alone: a digest does not depend on places.
#[derive(Clone, Debug, PartialEq)]
pub struct Located<T> {
    /// The value.
    pub value: T,
    /// Where it was said.
    pub source: Source,
}

impl<T> Located<T> {
    /// A value said at `source`.
    pub fn new(value: T, source: Source) -> Self {
        Self { value, source }
    }
}

impl<T> From<T> for Located<T> {
    fn from(value: T) -> Self {
        Self { value, source: Source::built_in() }
    }
}

impl From<&str> for Located<String> {
    fn from(value: &str) -> Self {
        Self { value: value.to_owned(), source: Source::built_in() }
    }
}

impl<T> Deref for Located<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> DerefMut for Located<T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.value
    }
}

impl<T: Serialize> Serialize for Located<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

/// How grave a note is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Worth knowing; nothing is lost.
    Info,
    /// A doubt, or something that was asked for and is not honored.
    Warning,
}

/// Something to tell the user about the scene that does not stop it.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// How grave it is.
    pub severity: Severity,
    /// Place; `None` where it concerns the scene as a whole.
    pub source: Option<Source>,
    /// One sentence, with the remedy where there is one.
    pub message: String,
}

impl Note {
    /// A warning about the thing at `source`.
    pub fn warning(source: &Source, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, source: Some(source.clone()), message: message.into() }
    }

    /// A remark about the thing at `source`.
    pub fn info(source: &Source, message: impl Into<String>) -> Self {
        Self { severity: Severity::Info, source: Some(source.clone()), message: message.into() }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.source {
            Some(source) => write!(f, "{source}: {}", self.message),
            None => write!(f, "{}", self.message),
        }
    }
}

/// A scene that can't be used, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// Place of the fault; `None` where it concerns the scene as a whole.
    pub source: Option<Source>,
    /// What is wrong, one sentence.
    pub message: String,
    /// What to do about it.
    pub remedy: Option<String>,
}

impl SceneError {
    /// A fault at `source`.
    pub fn at(source: &Source, message: impl Into<String>) -> Self {
        Self { source: Some(source.clone()), message: message.into(), remedy: None }
    }

    /// A fault of the scene as a whole.
    pub fn general(message: impl Into<String>) -> Self {
        Self { source: None, message: message.into(), remedy: None }
    }

    /// The same fault with advice.
    pub fn with_remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(source) = &self.source {
            write!(f, "{source}: ")?;
        }
        write!(f, "{}", self.message)?;
        match &self.remedy {
            Some(remedy) => write!(f, "; {remedy}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for SceneError {}
