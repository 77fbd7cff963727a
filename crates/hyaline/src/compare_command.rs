//! `hyaline compare`: how far a picture is from a reference.

use crate::cli::CompareArguments;
use crate::failure::Failure;
use crate::message;
use crate::output::{self, Output};
use crate::picture;
use hyaline_film::{Comparison, Image};
use std::path::Path;

/// Measures the first picture by the second; prints the figures to stdout.
///
/// # Errors
/// A picture can't be read, the sizes differ, or the picture of the error can't be written.
pub(crate) fn run(arguments: &CompareArguments) -> Result<u8, Failure> {
    let diff = arguments.diff.as_deref().map(Output::picture).transpose()?;
    if let Some(diff) = &diff {
        // The picture of the error must not take the place of what it is about.
        for path in [&arguments.image, &arguments.reference] {
            output::check_distinct([diff.path.as_path(), path.as_path()])?;
        }
    }
    let (image, reference) = (read(&arguments.image)?, read(&arguments.reference)?);
    let figures = hyaline_film::compare(&image, &reference, arguments.exposure).map_err(Failure::usage)?;
    if let Some(diff) = diff {
        let difference = hyaline_film::difference_image(&image, &reference).map_err(Failure::usage)?;
        picture::write(&difference, &diff.path, 1.0)?;
    }
    let text = if arguments.json { json(&figures) } else { table(&figures) };
    message::print_result(&text).map_err(Failure::working)?;
    Ok(0)
}

/// Reads a picture of radiance.
fn read(path: &Path) -> Result<Image, Failure> {
    hyaline_film::read_image(path).map_err(|error| Failure::usage(format!("{}: {error}", path.display())))
}

/// One line for programs; a ratio that is no number is `null`.
fn json(figures: &Comparison) -> String {
    // Numbers alone: nothing that could fail to be written.
    serde_json::to_string(figures).unwrap_or_default()
}

/// Lines for people.
fn table(figures: &Comparison) -> String {
    let Comparison { mse, relmse, relmse_trimmed, mean_ratio, flip, nonfinite } = figures;
    format!(
        "mse             {mse:.6e}\n\
         relmse          {relmse:.6e}\n\
         relmse trimmed  {relmse_trimmed:.6e}\n\
         mean ratio      {mean_ratio:.6}\n\
         FLIP            {flip:.6}\n\
         not finite      {nonfinite}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_for_programs_has_the_agreed_keys() {
        let image = Image::new(2, 1, vec![[1.0; 3], [0.5; 3]]);
        let figures = hyaline_film::compare(&image, &image, 1.0).expect("same size");
        let value: serde_json::Value = serde_json::from_str(&json(&figures)).expect("JSON");
        let keys: Vec<&str> = value.as_object().expect("an object").keys().map(String::as_str).collect();
        assert_eq!(keys.len(), 6);
        for key in ["mse", "relmse", "relmse_trimmed", "mean_ratio", "flip", "nonfinite"] {
            assert!(keys.contains(&key), "{key}");
        }
    }
}
