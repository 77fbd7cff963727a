//! Pictures of films, with the command that made them among their metadata.

use crate::failure::Failure;
use hyaline_film::{Film, Image};
use std::fmt::Display;
use std::path::Path;

/// The picture of a film.
///
/// # Errors
/// The film holds no pass.
pub(crate) fn develop(film: &Film) -> Result<Image, Failure> {
    if film.passes().is_empty() {
        return Err(Failure::usage("the film holds no pass: there is no picture of it"));
    }
    let mut image = hyaline_film::develop(film);
    let words: Vec<String> =
        std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    image.metadata.push(("command".to_owned(), format!("hyaline {}", words.join(" "))));
    Ok(image)
}

/// Writes a picture by the ending of its name, whole or not at all.
///
/// # Errors
/// The file can't be written.
pub(crate) fn write(image: &Image, path: &Path, exposure: f32) -> Result<(), Failure> {
    hyaline_film::write_image(path, image, exposure).map_err(|error| unwritten(path, error))
}

/// The failure to write a result.
pub(crate) fn unwritten(path: &Path, error: impl Display) -> Failure {
    Failure::working(format!("{}: can't be written: {error}", path.display()))
}
