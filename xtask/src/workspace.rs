//! Where the workspace lies and what files it holds.

use std::io;
use std::path::{Path, PathBuf};

/// The folder of the root manifest.
pub(crate) fn root() -> PathBuf {
    let xtask = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    xtask.as_deref().and_then(Path::parent).map_or_else(|| PathBuf::from("."), Path::to_owned)
}

/// The folders of the crates below `crates/`, by name.
///
/// # Errors
/// The folder can't be read.
pub(crate) fn crates(root: &Path) -> io::Result<Vec<PathBuf>> {
    let folders = entries(&root.join("crates"))?;
    Ok(folders.into_iter().filter(|path| path.join("Cargo.toml").is_file()).collect())
}

/// All Rust files below a folder, in a fixed order; none where there is no such folder.
///
/// # Errors
/// A folder can't be read.
pub(crate) fn rust_files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    if !folder.is_dir() {
        return Ok(files);
    }
    for path in entries(folder)? {
        if path.is_dir() {
            files.extend(rust_files(&path)?);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

/// What a folder holds, in a fixed order.
///
/// # Errors
/// It can't be read.
pub(crate) fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths: Vec<PathBuf> =
        folder.read_dir()?.map(|entry| entry.map(|entry| entry.path())).collect::<io::Result<_>>()?;
    paths.sort();
    Ok(paths)
}
