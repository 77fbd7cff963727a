//! The film of a render: where it is read from and where it is kept.

use crate::failure::Failure;
use crate::message;
use crate::output;
use hyaline_film::{Film, FilmError, FilmHeader};
use std::path::{Path, PathBuf};

/// Which films a render reads and writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FilmFiles {
    /// Film to go on with.
    resume: Option<PathBuf>,
    /// Where to keep the film.
    pub(crate) keep: Option<PathBuf>,
}

impl FilmFiles {
    /// `--resume` reads and writes again; with `--film` it is written there instead, where no other film may be.
    ///
    /// # Errors
    /// A film that is not resumed would be overwritten, or nothing can be written there.
    pub(crate) fn new(film: Option<&Path>, resume: Option<&Path>) -> Result<Self, Failure> {
        if let Some(film) = film
            && film.exists()
            && !resume.is_some_and(|resume| is_same_file(film, resume))
        {
            return Err(Failure::usage(format!("{}: there is a film already", film.display()))
                .with_remedy("go on with it by --resume, or give another name"));
        }
        let keep = film.or(resume).map(Path::to_owned);
        if let Some(keep) = &keep {
            output::check_writable(keep)?;
        }
        Ok(Self { resume: resume.map(Path::to_owned), keep })
    }

    /// The film to add passes to: the one to resume, or a fresh one.
    ///
    /// # Errors
    /// The film to resume can't be read, or is of another picture.
    pub(crate) fn open(&self, header: FilmHeader) -> Result<Film, Failure> {
        let fresh = Film::new(header).map_err(Failure::usage)?;
        match &self.resume {
            None => Ok(fresh),
            Some(path) if !path.exists() => {
                message::print(&format!(
                    "note: {}: there is no such film yet; starting afresh",
                    path.display()
                ));
                Ok(fresh)
            }
            Some(path) => {
                let film = read(path)?;
                film.header().check_same(fresh.header()).map_err(|error| {
                    Failure::usage(format!("{}: can't be resumed: {}", path.display(), difference(&error)))
                        .with_remedy("resume with the scene and the options that the film was begun with")
                })?;
                Ok(film)
            }
        }
    }
}

/// Whether two names are those of one file that is there.
fn is_same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Reads a film.
///
/// # Errors
/// The file is absent, or no film, or damaged.
pub(crate) fn read(path: &Path) -> Result<Film, Failure> {
    Film::read(path).map_err(|error| Failure::usage(format!("{}: {error}", path.display())))
}

/// What tells a film from the render that would resume it.
fn difference(error: &FilmError) -> String {
    match error {
        FilmError::Mismatch { what, ours, theirs } => {
            format!("its {what} is {ours}, that of this render is {theirs}")
        }
        other => other.to_string(),
    }
}
