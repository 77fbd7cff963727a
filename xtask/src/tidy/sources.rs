//! Every law names its source: each public type and free function of `optics` that holds one has a `Source:` line;
//! methods have that of their type, or their own.

use crate::workspace;
use std::io;
use std::path::Path;

/// Every public free function of `optics` without a source.
///
/// # Errors
/// A file can't be read.
pub(crate) fn check(root: &Path) -> io::Result<Vec<String>> {
    let mut findings = Vec::new();
    for file in workspace::rust_files(&root.join("crates/optics/src"))? {
        let shown = file.strip_prefix(root).unwrap_or(&file).display().to_string();
        let text = std::fs::read_to_string(&file)?;
        findings.extend(
            functions_without_source(&text)
                .into_iter()
                .map(|(line, name)| format!("{shown}:{line}: `{name}` has no `Source:` line")),
        );
    }
    Ok(findings)
}

/// Line and name of each public free function without a source, tests left out.
fn functions_without_source(text: &str) -> Vec<(usize, String)> {
    let mut findings = Vec::new();
    let mut has_source = false;
    for (index, whole) in text.lines().enumerate() {
        let line = whole.trim();
        if line == "#[cfg(test)]" {
            break;
        }
        if let Some(name) = public_function(whole)
            && !has_source
        {
            findings.push((index + 1, name.to_owned()));
        }
        // An item's documentation ends with the item: at an empty line, or at what closes or begins one.
        let is_boundary = line.is_empty() || line.ends_with('}') || line.ends_with('{');
        has_source = !is_boundary && (has_source || line.starts_with("/// Source:"));
    }
    findings
}

/// Name of the public function that a line begins; methods are indented, and not meant.
fn public_function(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("pub ")?;
    let rest = rest.strip_prefix("const ").unwrap_or(rest).strip_prefix("fn ")?;
    rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_without_a_source_is_found() {
        let text = "/// A law.\n/// Source: a book.\n#[inline]\npub fn a() {}\n\n/// Another.\npub const fn b() {}\nfn c() {}\n\nimpl T {\n    pub fn d() {}\n}\n";
        assert_eq!(functions_without_source(text), [(7, "b".to_owned())]);
    }
}
