//! `--set KEY=VALUE`: changes to a document before it is read.
//!
//! A key is a dotted path as in the file: `camera.fov`, `media.water.ior`, `object.glass.wall`. Elements of an array
//! are named by their `name` or counted from 0; an array of one element needs neither. `medium`, `material` and
//! `texture` stand for `media`, `materials` and `textures` at the start of a path, and `objects`, `lights`,
//! `cameras` for `object`, `light`, `camera`. A value is TOML where it can be, else a string.

use super::document::{self, Entry, Node, Value};
use crate::Result;
use crate::nearest::nearest;
use hyaline_scene::{SceneError, Source};

/// Applies overrides in order to the root table of a document.
///
/// # Errors
/// A path that leads through something that is no table or array, or to an element that is not there.
pub(crate) fn apply(root: &mut Node, overrides: &[(String, String)]) -> Result<()> {
    overrides.iter().try_for_each(|(path, text)| {
        let source = Source::file(format!("--set {path}={text}"));
        let segments = split_path(path).ok_or_else(|| {
            SceneError::at(&source, format!("'{path}' is no path of keys"))
                .with_remedy("write it as in camera.fov=30")
        })?;
        let value = document::parse_value(text, &source)?
            .unwrap_or_else(|| Node { value: Value::String(text.clone()), source: source.clone() });
        Setter { path, source: &source }.set(root, "", &segments, value)
    })
}

/// Splits a dotted path; segments may be quoted. `None` where a segment is empty.
fn split_path(path: &str) -> Option<Vec<String>> {
    let mut segments = vec![String::new()];
    let mut quote = None;
    for c in path.chars() {
        match (quote, c) {
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            (None, '.') => segments.push(String::new()),
            _ => segments.last_mut()?.push(c),
        }
    }
    let last = segments.len() - 1;
    for (i, segment) in segments.iter_mut().enumerate() {
        *segment = segment.trim().to_owned();
        let full_name = FULL_NAMES.iter().find(|(short, _)| *short == segment);
        if let (0, true, Some((_, full))) = (i, last > 0, full_name) {
            *segment = (*full).to_owned();
        }
    }
    let is_usable = quote.is_none() && segments.len() <= 16 && segments.iter().all(|s| !s.is_empty());
    is_usable.then_some(segments)
}

/// Other names for the first segment of a path.
const FULL_NAMES: [(&str, &str); 6] = [
    ("medium", "media"),
    ("material", "materials"),
    ("texture", "textures"),
    ("objects", "object"),
    ("lights", "light"),
    ("cameras", "camera"),
];

struct Setter<'a> {
    path: &'a str,
    source: &'a Source,
}

impl Setter<'_> {
    /// Sets what `segments` lead to from `node`, which stands under `key`.
    fn set(&self, node: &mut Node, key: &str, segments: &[String], value: Node) -> Result<()> {
        let Some((segment, rest)) = segments.split_first() else {
            *node = value;
            return Ok(());
        };
        match &mut node.value {
            Value::Table(entries) => {
                let index = entries.iter().position(|entry| entry.key == *segment).unwrap_or_else(|| {
                    let node = Node::empty_table(self.source.clone());
                    entries.push(Entry { key: segment.clone(), source: self.source.clone(), node });
                    entries.len() - 1
                });
                if rest.is_empty() {
                    entries[index].source = self.source.clone();
                }
                self.set(&mut entries[index].node, segment, rest, value)
            }
            Value::Array(items) => match self.element(items, key, segments)? {
                Element::At(index) => self.set(&mut items[index], segment, rest, value),
                Element::Only => self.set(&mut items[0], key, segments, value),
            },
            other => {
                let kind = other.kind();
                Err(SceneError::at(
                    self.source,
                    format!("{}: there is no '{segment}' within {kind}", self.path),
                ))
            }
        }
    }

    /// Which element of the array under `key` a path means.
    fn element(&self, items: &[Node], key: &str, segments: &[String]) -> Result<Element> {
        let segment = &segments[0];
        let names: Vec<String> =
            items.iter().enumerate().map(|(i, item)| element_name(item, key, i)).collect();
        if let Some(index) = names.iter().position(|name| name == segment) {
            return Ok(Element::At(index));
        }
        if let Ok(index) = segment.parse::<usize>() {
            let message = format!("{}: index {index} is out of range, there are {}", self.path, items.len());
            return if index < items.len() {
                Ok(Element::At(index))
            } else {
                Err(SceneError::at(self.source, message))
            };
        }
        if let [Node { value: Value::Table(entries), .. }] = items
            && (segments.len() == 1 || entries.iter().any(|entry| entry.key == *segment))
        {
            return Ok(Element::Only);
        }
        let error = SceneError::at(self.source, format!("{}: no element is named '{segment}'", self.path));
        Err(match nearest(segment, names.iter().map(String::as_str)) {
            Some(name) => error.with_remedy(format!("the nearest is '{name}'; there are {}", items.len())),
            None => error.with_remedy("the array is empty"),
        })
    }
}

enum Element {
    At(usize),
    Only,
}

/// Name of an element of the array under `key`: what it says, else what the reader will call it.
fn element_name(item: &Node, key: &str, index: usize) -> String {
    let Value::Table(entries) = &item.value else { return index.to_string() };
    let text = |key: &str| {
        entries.iter().find(|entry| entry.key == key).and_then(|entry| match &entry.node.value {
            Value::String(text) => Some(text.as_str()),
            _ => None,
        })
    };
    match text("name") {
        Some(name) => name.to_owned(),
        None => default_name(key, text("kind").unwrap_or_default(), index),
    }
}

/// What an element of the array `key` is called that has no name; `index` counts from 0.
pub(crate) fn default_name(key: &str, kind: &str, index: usize) -> String {
    match key {
        "camera" if index == 0 => "camera".to_owned(),
        "camera" => format!("camera-{}", index + 1),
        "light" => format!("{kind}-light-{}", index + 1),
        _ => format!("{kind}-{}", index + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[camera]\nfov = 20\n[[object]]\nkind = 'sphere'\n[[object]]\nkind = 'vessel'\nname = 'glass'\n\
                        wall = 1\nouter = [[1, 2], [3, 4]]\n[[light]]\nkind = 'point'\n";

    fn set(path: &str, value: &str) -> Result<String> {
        let mut root = document::parse(TEXT, &"a.toml".into())?;
        apply(&mut root, &[(path.to_owned(), value.to_owned())])?;
        Ok(format!("{:?}", root.value))
    }

    #[test]
    fn values_are_toml_or_else_strings() {
        assert!(set("camera.fov", "30").unwrap().contains("Integer(30)"));
        assert!(set("camera.name", "front view").unwrap().contains("String(\"front view\")"));
        assert!(set("camera.name", "").unwrap().contains("String(\"\")"));
        assert!(set("film.size", "[3, 4]").unwrap().contains("Integer(4)"));
        assert!(set("medium.water.ior", "1.4").unwrap().contains("\"media\""));
    }

    #[test]
    fn elements_are_found_by_name_by_default_name_by_index_and_alone() {
        for path in ["object.glass.wall", "objects.1.wall", "object.\"glass\".wall"] {
            assert!(set(path, "77").unwrap().contains("Integer(77)"), "{path}");
        }
        assert!(set("object.sphere-1.radius", "77").unwrap().contains("Integer(77)"));
        assert!(set("light.kind", "77").unwrap().contains("Integer(77)"), "the only light needs no name");
        assert!(set("light.radius", "77").unwrap().contains("Integer(77)"), "nor the key that is set");
        assert!(set("light.point-light-1.kind", "77").unwrap().contains("Integer(77)"));
        assert!(set("object.glass.outer.1.0", "77").unwrap().contains("Integer(77)"));
    }

    #[test]
    fn paths_to_nowhere_are_errors_that_name_the_path() {
        let error = set("object.glas.wall", "1").unwrap_err().to_string();
        assert!(error.contains("object.glas.wall") && error.contains("nearest is 'glass'"), "{error}");
        assert!(set("object.7.wall", "1").unwrap_err().to_string().contains("out of range"));
        assert!(set("camera.fov.x", "1").unwrap_err().to_string().contains("no 'x' within a whole number"));
        for path in ["", ".", "a..b", "a.\"b"] {
            assert!(set(path, "1").is_err(), "{path}");
        }
    }
}
