//! Where results go: endings and folders are looked at before anything is rendered.

use crate::failure::Failure;
use std::path::{Path, PathBuf};

/// What a file can be, by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OutputKind {
    /// Linear, 32 bits a channel, with layers.
    Exr,
    /// Developed to 8 bits.
    Png,
    /// Linear, 32 bits a channel.
    Pfm,
    /// The sums themselves.
    Film,
}

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Output {
    /// Where.
    pub(crate) path: PathBuf,
    /// What.
    pub(crate) kind: OutputKind,
}

impl Output {
    /// A picture at `path`, by its ending.
    ///
    /// # Errors
    /// The ending is none that can be written, or nothing can be written there.
    pub(crate) fn picture(path: &Path) -> Result<Self, Failure> {
        let output = Self::picture_or_film(path)?;
        match output.kind {
            OutputKind::Exr | OutputKind::Png | OutputKind::Pfm => Ok(output),
            OutputKind::Film => Err(Failure::usage(format!("{}: this is a film's ending", path.display()))
                .with_remedy("a picture ends in .exr, .png or .pfm; --film keeps the film")),
        }
    }

    /// A picture or a film at `path`, by its ending.
    ///
    /// # Errors
    /// As [`Output::picture`].
    pub(crate) fn picture_or_film(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let kind = match ending.as_deref() {
            Some("exr") => OutputKind::Exr,
            Some("png") => OutputKind::Png,
            Some("pfm") => OutputKind::Pfm,
            Some("film") => OutputKind::Film,
            _ => {
                return Err(Failure::usage(format!("{}: no known ending of a picture", path.display()))
                    .with_remedy("use .exr (linear), .png (developed) or .pfm (linear)"));
            }
        };
        check_writable(path)?;
        Ok(Self { path: path.to_owned(), kind })
    }
}

/// Finds out whether a file can be written at `path`, without touching what is there.
///
/// # Errors
/// `path` is a folder, or its folder is absent or can't be written to.
pub(crate) fn check_writable(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::usage(format!("{}: is a folder", path.display())));
    }
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(Failure::usage(format!("{}: there is no folder {}", path.display(), folder.display())));
    }
    tempfile::Builder::new()
        .prefix(".hyaline-")
        .tempfile_in(folder)
        .map(drop)
        .map_err(|error| Failure::usage(format!("{}: can't be written: {error}", path.display())))
}

/// Makes sure that no two results go to one file.
///
/// # Errors
/// Names the path that was given twice.
pub(crate) fn check_distinct<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    let mut seen: Vec<&Path> = Vec::new();
    for path in paths {
        if seen.contains(&path) {
            return Err(Failure::usage(format!("{}: given twice as a place to write to", path.display())));
        }
        seen.push(path);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_decide_what_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let kind =
            |name: &str| Output::picture_or_film(&folder.path().join(name)).map(|output| output.kind).ok();
        assert_eq!(kind("a.exr"), Some(OutputKind::Exr));
        assert_eq!(kind("a.b.PNG"), Some(OutputKind::Png));
        assert_eq!(kind("a.pfm"), Some(OutputKind::Pfm));
        assert_eq!(kind("a.film"), Some(OutputKind::Film));
        assert_eq!(kind("a.jpg"), None);
        assert_eq!(kind("exr"), None);
        assert!(Output::picture(&folder.path().join("a.film")).is_err());
    }

    #[test]
    fn an_absent_folder_is_found_before_rendering_and_nothing_is_left_behind() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Output::picture(&folder.path().join("absent/a.png")).is_err());
        assert!(Output::picture(&folder.path().join("a.png")).is_ok());
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
    }

    #[test]
    fn one_file_is_not_written_twice() {
        assert!(check_distinct([Path::new("a.png"), Path::new("a.exr")]).is_ok());
        assert!(check_distinct([Path::new("a.png"), Path::new("a.png")]).is_err());
    }
}
