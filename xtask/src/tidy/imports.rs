//! Imports point down: the layers of ARCHITECTURE.md as data.

use crate::workspace;
use std::io;
use std::path::Path;

/// A crate, its layer, and the crates of the workspace that it may import.
struct Rule {
    name: &'static str,
    layer: u8,
    may_import: &'static [&'static str],
}

/// The import table. `world` and `transport` never see file readers; `transport` never sees a description.
const RULES: [Rule; 14] = [
    Rule { name: "math", layer: 0, may_import: &[] },
    Rule { name: "optics", layer: 1, may_import: &["math"] },
    Rule { name: "sampling", layer: 1, may_import: &["math"] },
    Rule { name: "scene", layer: 1, may_import: &["math"] },
    Rule { name: "spectrum", layer: 2, may_import: &["math", "optics"] },
    Rule { name: "geometry", layer: 2, may_import: &["math", "sampling"] },
    Rule { name: "formats", layer: 2, may_import: &["math", "scene"] },
    Rule { name: "scattering", layer: 3, may_import: &["math", "sampling", "optics", "spectrum"] },
    Rule { name: "film", layer: 3, may_import: &["math", "spectrum"] },
    Rule {
        name: "world",
        layer: 4,
        may_import: &["math", "optics", "sampling", "scene", "spectrum", "geometry", "scattering", "film"],
    },
    Rule {
        name: "transport",
        layer: 5,
        may_import: &[
            "math",
            "optics",
            "sampling",
            "scene",
            "spectrum",
            "geometry",
            "scattering",
            "film",
            "world",
        ],
    },
    Rule {
        name: "render",
        layer: 6,
        may_import: &["math", "sampling", "scene", "film", "world", "transport"],
    },
    Rule {
        name: "hyaline",
        layer: 7,
        may_import: &["math", "scene", "formats", "film", "world", "transport", "render"],
    },
    Rule { name: "testkit", layer: 0, may_import: &[] },
];

/// What tests may import besides.
const TESTS_MAY_IMPORT: [&str; 2] = ["testkit", "scene"];

/// Every import that the table does not allow, and every crate that it does not know.
///
/// # Errors
/// A manifest can't be read.
pub(crate) fn check(root: &Path) -> io::Result<Vec<String>> {
    let mut findings = rules_that_point_up();
    for folder in workspace::crates(root)? {
        let manifest = folder.join("Cargo.toml");
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        findings.extend(check_manifest(&name, &std::fs::read_to_string(&manifest)?));
    }
    Ok(findings)
}

/// Rules that contradict the layers.
fn rules_that_point_up() -> Vec<String> {
    let layer = |name: &str| RULES.iter().find(|rule| rule.name == name).map(|rule| rule.layer);
    let mut findings = Vec::new();
    for rule in &RULES {
        for import in rule.may_import {
            if layer(import).is_none_or(|below| below >= rule.layer) {
                findings
                    .push(format!("import table: {} may not import {import}: it is not below", rule.name));
            }
        }
    }
    findings
}

/// What is wrong with the manifest of the crate in folder `name`.
fn check_manifest(name: &str, text: &str) -> Vec<String> {
    let Some(rule) = RULES.iter().find(|rule| rule.name == name) else {
        return vec![format!("crates/{name}: not in the import table")];
    };
    let manifest: toml::Table = match text.parse() {
        Ok(manifest) => manifest,
        Err(error) => return vec![format!("crates/{name}/Cargo.toml: {error}")],
    };
    let mut findings = Vec::new();
    for section in ["dependencies", "build-dependencies", "dev-dependencies"] {
        let tests_too: &[&str] = if section == "dev-dependencies" { &TESTS_MAY_IMPORT } else { &[] };
        for import in imports(&manifest, section) {
            if !rule.may_import.contains(&import) && !tests_too.contains(&import) {
                findings.push(format!("crates/{name}/Cargo.toml: [{section}] may not name hyaline-{import}"));
            }
        }
    }
    findings
}

/// The crates of the workspace in a section of a manifest.
fn imports<'a>(manifest: &'a toml::Table, section: &str) -> Vec<&'a str> {
    let table = manifest.get(section).and_then(toml::Value::as_table);
    table.into_iter().flat_map(|table| table.keys()).filter_map(|key| key.strip_prefix("hyaline-")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_points_down() {
        assert_eq!(rules_that_point_up(), Vec::<String>::new());
    }

    #[test]
    fn an_import_that_points_up_is_found() {
        let bad = "[dependencies]\nhyaline-world.workspace = true\nserde.workspace = true\n";
        assert_eq!(check_manifest("film", bad).len(), 1);
        let good = "[dependencies]\nhyaline-math.workspace = true\n[dev-dependencies]\nhyaline-testkit.workspace = true\n";
        assert!(check_manifest("film", good).is_empty());
    }

    #[test]
    fn testkit_is_for_tests_only() {
        assert_eq!(check_manifest("film", "[dependencies]\nhyaline-testkit.workspace = true\n").len(), 1);
    }

    #[test]
    fn an_unknown_crate_is_found() {
        assert_eq!(check_manifest("misc", "[dependencies]\n").len(), 1);
    }
}
