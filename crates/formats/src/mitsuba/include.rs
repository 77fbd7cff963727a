//! `<include>`, `<path>` and spectra in files: what a scene reads besides itself while it is parsed.
//!
//! A name is looked for in the folder of the file that says it, then as for meshes and images. Files that include
//! themselves, directly or by way of others, are named with the whole round; their number, depth and size are limited.

use super::parse::Builder;
use crate::Result;
use crate::assets::{read_file, reason};
use hyaline_scene::{SceneError, Source};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Most files that a scene may include, one another's includes among them.
const MAX_INCLUDES: usize = 256;
/// Most files within each other.
const MAX_DEPTH: usize = 16;
/// Most text in all included files together, bytes.
const MAX_BYTES: u64 = 1 << 28;
/// Longest file of a spectrum, bytes.
const MAX_SPECTRUM: usize = 1 << 20;

/// The files that are being read, and how much has been.
#[derive(Debug, Default)]
pub(super) struct Includes {
    /// From the scene inwards: the path without detours where the file is there, and the name in messages.
    open: Vec<(Option<PathBuf>, String)>,
    count: usize,
    bytes: u64,
}

impl Includes {
    /// Starts with the scene itself.
    pub(super) fn new(file: &str, base_dir: &Path) -> Self {
        let path = Path::new(file).file_name().map(|name| base_dir.join(name));
        let path = path.and_then(|path| std::fs::canonicalize(path).ok());
        Self { open: vec![(path, file.to_owned())], ..Self::default() }
    }

    /// Checks a file before it is read.
    fn enter(&mut self, path: &Path, shown: &str, source: &Source) -> Result<()> {
        self.count += 1;
        if self.count > MAX_INCLUDES {
            return Err(SceneError::at(source, format!("more than {MAX_INCLUDES} includes")));
        }
        let unreadable = |error: std::io::Error| {
            let error = SceneError::at(source, format!("can't read '{shown}': {}", reason(&error)));
            error.with_remedy(format!("looked for {}", path.display()))
        };
        let canonical = std::fs::canonicalize(path).map_err(unreadable)?;
        if let Some(first) = self.open.iter().position(|(open, _)| open.as_ref() == Some(&canonical)) {
            let round: Vec<&str> = self.open[first..].iter().map(|(_, name)| name.as_str()).collect();
            let round = round.join(" includes ");
            return Err(SceneError::at(
                source,
                format!("a file includes itself: {round} includes '{shown}'"),
            )
            .with_remedy("remove one of these includes"));
        }
        if self.open.len() > MAX_DEPTH {
            return Err(SceneError::at(source, format!("more than {MAX_DEPTH} includes within each other")));
        }
        self.bytes = self.bytes.saturating_add(std::fs::metadata(&canonical).map_err(unreadable)?.len());
        if self.bytes > MAX_BYTES {
            return Err(SceneError::at(
                source,
                format!("the included files have more than {MAX_BYTES} bytes"),
            ));
        }
        self.open.push((Some(canonical), shown.to_owned()));
        Ok(())
    }

    /// The folder of the file that is being read.
    fn folder(&self) -> Option<&Path> {
        self.open.last().and_then(|(path, _)| path.as_deref()).and_then(Path::parent)
    }
}

impl Builder<'_> {
    /// Reads another file in the place of an include.
    pub(super) fn include(&mut self, name: &str, source: &Source, parent: usize) -> Result<()> {
        let path = self.path(name);
        self.includes.enter(&path, name, source)?;
        let bytes = read_file(source, name, &path)?;
        let text = String::from_utf8(bytes);
        let text = text.map_err(|_| SceneError::at(source, format!("'{name}' is not a text in UTF-8")))?;
        if let Some(folder) = path.parent() {
            self.assets.look_last_in(folder.to_owned());
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        self.file(text, &Arc::from(path.display().to_string()), Some(parent))?;
        self.includes.open.pop();
        Ok(())
    }

    /// Adds a folder in which files are looked for before all others.
    pub(super) fn search_folder(&mut self, name: &str, source: &Source) -> Result<()> {
        let path = self.path(name);
        if !path.is_dir() {
            let error = SceneError::at(source, format!("<path>: there is no folder '{name}'"));
            return Err(error.with_remedy(format!("looked for {}", path.display())));
        }
        self.assets.look_first_in(path);
        Ok(())
    }

    /// The values of a spectrum in a file of two columns, as the attribute `value` would have them.
    pub(super) fn spectrum_file(&self, name: &str, source: &Source) -> Result<String> {
        let bytes = read_file(source, name, &self.path(name))?;
        let text = std::str::from_utf8(&bytes).ok().filter(|text| text.len() <= MAX_SPECTRUM);
        let Some(text) = text else {
            return Err(SceneError::at(
                source,
                format!("'{name}' is no spectrum: it is too long or no text"),
            ));
        };
        let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
        let pairs = lines.map(|line| {
            let mut words = line.split_ascii_whitespace();
            match (words.next(), words.next(), words.next()) {
                (Some(wavelength), Some(value), None) => Ok(format!("{wavelength}:{value}")),
                _ => Err(SceneError::at(source, format!("'{name}' must have two numbers in each line"))),
            }
        });
        Ok(pairs.collect::<Result<Vec<String>>>()?.join(","))
    }

    /// A name relative to the file that says it, if there is such a file; else as assets are found.
    fn path(&self, name: &str) -> PathBuf {
        let beside = self.includes.folder().map(|folder| folder.join(name));
        beside.filter(|path| path.exists()).unwrap_or_else(|| self.assets.path(name))
    }
}
