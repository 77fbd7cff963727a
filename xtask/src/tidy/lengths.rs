//! No file above 400 lines: one idea each.

use crate::workspace;
use std::io;
use std::path::Path;

/// Most lines of a file.
const MOST_LINES: usize = 400;

/// Every Rust file that is too long.
///
/// # Errors
/// A file can't be read.
pub(crate) fn check(root: &Path) -> io::Result<Vec<String>> {
    let mut findings = Vec::new();
    for folder in ["crates", "xtask"] {
        for file in workspace::rust_files(&root.join(folder))? {
            let lines = std::fs::read_to_string(&file)?.lines().count();
            if lines > MOST_LINES {
                let shown = file.strip_prefix(root).unwrap_or(&file).display();
                findings.push(format!("{shown}: {lines} lines, more than {MOST_LINES}"));
            }
        }
    }
    Ok(findings)
}
