//! `hyaline merge` and `hyaline develop`: films to films and to pictures.

use crate::cli::{DevelopArguments, MergeArguments};
use crate::failure::Failure;
use crate::output::{self, Output, OutputKind};
use crate::{film_file, picture};
use hyaline_film::Film;
use std::path::{Path, PathBuf};

/// Adds up films of one render; writes films and pictures by their endings.
///
/// # Errors
/// A film can't be read, films are of different renders or hold the same pass, a result can't be written.
pub(crate) fn merge(arguments: &MergeArguments) -> Result<u8, Failure> {
    let outputs = outputs(&arguments.output, Output::picture_or_film)?;
    let mut films = arguments.films.iter();
    let Some(first) = films.next() else { return Err(Failure::usage("no film to merge")) };
    let mut sum = film_file::read(first)?;
    for path in films {
        let film = film_file::read(path)?;
        sum.merge(&film)
            .map_err(|error| Failure::usage(format!("{}: can't be merged: {error}", path.display())))?;
    }
    write_all(&sum, &outputs, arguments.exposure)
}

/// Makes pictures of a film.
///
/// # Errors
/// The film can't be read or holds no pass, a picture can't be written.
pub(crate) fn develop(arguments: &DevelopArguments) -> Result<u8, Failure> {
    let outputs = outputs(&arguments.output, Output::picture)?;
    let film = film_file::read(&arguments.film)?;
    write_all(&film, &outputs, arguments.exposure)
}

/// The files to write, each looked at.
fn outputs(
    paths: &[PathBuf],
    check: impl Fn(&Path) -> Result<Output, Failure>,
) -> Result<Vec<Output>, Failure> {
    output::check_distinct(paths.iter().map(PathBuf::as_path))?;
    paths.iter().map(|path| check(path)).collect()
}

fn write_all(film: &Film, outputs: &[Output], exposure: Option<f32>) -> Result<u8, Failure> {
    let has_pictures = outputs.iter().any(|output| output.kind != OutputKind::Film);
    let image = has_pictures.then(|| picture::develop(film)).transpose()?;
    for output in outputs {
        match &image {
            Some(image) if output.kind != OutputKind::Film => {
                picture::write(image, &output.path, exposure.unwrap_or(1.0))?;
            }
            _ => film.write(&output.path).map_err(|error| picture::unwritten(&output.path, error))?,
        }
    }
    Ok(0)
}
