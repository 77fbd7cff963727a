//! What can go wrong with a film.

use std::fmt;

/// Why a film could not be made, read, written or merged. Messages don't name the file: the caller knows it.
#[derive(Debug)]
pub enum FilmError {
    /// The file could not be read or written.
    Io(std::io::Error),
    /// The bytes are no film.
    NotAFilm,
    /// The film is of a format version that this program doesn't read.
    Version(u32),
    /// The film's content contradicts itself; the text says what is wrong.
    Damaged(&'static str),
    /// The frame or the crop is impossible; the text says why.
    Frame(&'static str),
    /// Two films are of different pictures.
    Mismatch {
        /// The first thing they differ in.
        what: String,
        /// Its value in this film.
        ours: String,
        /// Its value in the other.
        theirs: String,
    },
    /// A pass would be counted twice.
    PassTwice(u32),
}

impl fmt::Display for FilmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::NotAFilm => write!(f, "this is not a film of hyaline"),
            Self::Version(version) => {
                write!(f, "the film has format version {version}, and this program reads version 1 only")
            }
            Self::Damaged(what) => write!(f, "the film is damaged: {what}"),
            Self::Frame(what) => write!(f, "{what}"),
            Self::Mismatch { what, ours, theirs } => {
                write!(
                    f,
                    "the films are of different pictures: {what} is {ours} in one and {theirs} in the other"
                )
            }
            Self::PassTwice(pass) => write!(f, "pass {pass} would be counted twice"),
        }
    }
}

impl std::error::Error for FilmError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io(error) => Some(error),
            Self::NotAFilm
            | Self::Version(_)
            | Self::Damaged(_)
            | Self::Frame(_)
            | Self::Mismatch { .. }
            | Self::PassTwice(_) => None,
        }
    }
}

impl From<std::io::Error> for FilmError {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}
