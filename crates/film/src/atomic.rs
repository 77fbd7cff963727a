//! Files that are replaced as a whole or not at all.

use std::io::{self, Write};
use std::path::Path;

/// Puts `bytes` into the file at `path`: written beside it, flushed to the disk, then renamed over it.
///
/// Whatever happens on the way, the file holds either its old content or the new.
///
/// # Errors
/// If the folder is missing or can't be written to, or the disk is full.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut file = new_file_beside(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// A file of its own in `folder`, which disappears unless it is renamed, with the permissions of any new file.
fn new_file_beside(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".hyaline-").suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_replaced_and_nothing_is_left_beside_them() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let path = folder.path().join("a.film");
        for content in [&b"first"[..], b"second, longer", b""] {
            write_atomically(&path, content).expect("written");
            assert_eq!(std::fs::read(&path).expect("read"), content);
        }
        assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 1);
    }

    #[test]
    fn a_failed_write_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let taken = folder.path().join("taken");
        std::fs::create_dir(&taken).expect("made");
        assert!(write_atomically(&taken, b"x").is_err());
        assert!(write_atomically(&folder.path().join("missing/a.film"), b"x").is_err());
        assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 1);
    }
}
