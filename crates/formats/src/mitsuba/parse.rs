//! From XML to a tree of elements: parameters replaced, includes read, names in their present form.
//!
//! Elements with a `type` (shape, bsdf, ...) are plugins, the others properties of the plugin around them. DTDs and
//! with them entities are refused; includes and nesting are limited.

use super::tree::{Child, Plugin, Property, Target, Tree};
use crate::Result;
use crate::assets::{Assets, read_file};
use crate::place::Places;
use hyaline_scene::{SceneError, Source};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Deepest nesting of elements.
const MAX_DEPTH: usize = 32;
/// Most elements in a file.
const MAX_NODES: u32 = 4_000_000;
/// Most files that a scene may include, one another's includes among them.
const MAX_INCLUDES: usize = 64;

/// Elements that hold properties of their own.
const PLUGIN_TAGS: [&str; 12] = [
    "scene",
    "integrator",
    "sensor",
    "sampler",
    "film",
    "rfilter",
    "shape",
    "bsdf",
    "texture",
    "medium",
    "phase",
    "emitter",
];
/// Elements that are a value.
const PROPERTY_TAGS: [&str; 10] =
    ["float", "integer", "boolean", "string", "rgb", "srgb", "spectrum", "point", "vector", "transform"];

/// Parses a scene file.
///
/// # Errors
/// XML that is not well-formed, parameters and includes that are not there, two plugins of one id.
pub(super) fn parse(text: &str, file: &Arc<str>, assets: &Assets) -> Result<Tree> {
    let mut builder = Builder {
        tree: Tree { plugins: Vec::new(), ids: BTreeMap::new(), strange: Vec::new() },
        parameters: BTreeMap::new(),
        assets,
        includes: 0,
    };
    builder.file(text, file, None)?;
    Ok(builder.tree)
}

struct Builder<'a> {
    tree: Tree,
    parameters: BTreeMap<String, String>,
    assets: &'a Assets,
    includes: usize,
}

impl Builder<'_> {
    /// Reads a file into the plugin `parent`, or as the scene itself.
    fn file(&mut self, text: &str, file: &Arc<str>, parent: Option<usize>) -> Result<()> {
        let places = Places::new(file.clone(), text);
        let options =
            roxmltree::ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, ..Default::default() };
        let document = roxmltree::Document::parse_with_options(text, options).map_err(|error| {
            let position = error.pos();
            let source = Source { file: file.clone(), line: position.row, column: position.col, length: 1 };
            SceneError::at(&source, format!("not valid XML: {}", without_position(&error.to_string())))
        })?;
        let root = document.root_element();
        if parent.is_none() && root.tag_name().name() != "scene" {
            let error = SceneError::at(&places.source(name_range(root)), "not a Mitsuba scene");
            return Err(error.with_remedy("the outermost element must be <scene version=\"3.0.0\">"));
        }
        match parent {
            Some(parent) if root.tag_name().name() != "scene" => self.element(root, &places, parent, 1),
            Some(parent) => self.children(root, &places, parent, 1),
            None => {
                let scene = self.plugin(root, &places)?;
                self.children(root, &places, scene, 1)
            }
        }
    }

    fn children(
        &mut self,
        node: roxmltree::Node<'_, '_>,
        places: &Places<'_>,
        parent: usize,
        depth: usize,
    ) -> Result<()> {
        node.children()
            .filter(|child| child.is_element())
            .try_for_each(|child| self.element(child, places, parent, depth))
    }

    /// Reads an element within the plugin `parent`.
    fn element(
        &mut self,
        node: roxmltree::Node<'_, '_>,
        places: &Places<'_>,
        parent: usize,
        depth: usize,
    ) -> Result<()> {
        let source = places.source(name_range(node));
        if depth > MAX_DEPTH {
            return Err(too_deep(&source));
        }
        let tag = present_tag(node.tag_name().name());
        match tag {
            "default" => {
                let (name, value) =
                    (self.required(node, "name", places)?, self.required(node, "value", places)?);
                self.parameters.entry(name).or_insert(value);
            }
            "include" => self.include(node, places, parent)?,
            // Says nothing about the scene in any version.
            "mode" => {}
            "ref" => {
                let target = Target::Id(self.required(node, "id", places)?);
                let name = self.attribute(node, "name", places)?.map(|name| present_name(&name));
                let child = Child { name, target, source, used: Cell::new(false) };
                self.tree.plugins[parent].children.push(child);
            }
            _ if PLUGIN_TAGS.contains(&tag) || node.has_attribute("type") => {
                let index = self.plugin(node, places)?;
                let name = self.attribute(node, "name", places)?.map(|name| present_name(&name));
                let child = Child { name, target: Target::Index(index), source, used: Cell::new(false) };
                self.tree.plugins[parent].children.push(child);
                self.children(node, places, index, depth + 1)?;
            }
            _ if PROPERTY_TAGS.contains(&tag) => {
                let property = self.property(node, places, depth)?;
                self.tree.plugins[parent].properties.push(property);
            }
            _ => self.tree.strange.push((tag.to_owned(), source)),
        }
        Ok(())
    }

    /// Adds a plugin without its children.
    fn plugin(&mut self, node: roxmltree::Node<'_, '_>, places: &Places<'_>) -> Result<usize> {
        let index = self.tree.plugins.len();
        let source = places.source(name_range(node));
        let tag = match (present_tag(node.tag_name().name()), node.has_attribute("type")) {
            // Version 2 writes textures as <spectrum type="bitmap">.
            ("spectrum" | "rgb" | "volume", true) => "texture",
            (tag, _) => tag,
        };
        let id = self.attribute(node, "id", places)?;
        if let Some(id) = &id
            && let Some(first) = self.tree.ids.insert(id.clone(), index)
        {
            let first = &self.tree.plugins[first].source;
            let message = format!("two elements have the id '{id}'; the other is at {first}");
            return Err(SceneError::at(&source, message).with_remedy("rename one of them"));
        }
        self.tree.plugins.push(Plugin {
            tag: tag.to_owned(),
            kind: self.attribute(node, "type", places)?.unwrap_or_default(),
            id,
            version: self.attribute(node, "version", places)?,
            source,
            properties: Vec::new(),
            children: Vec::new(),
            visited: Cell::new(false),
        });
        Ok(index)
    }

    /// Reads a value, or a step of a transform.
    fn property(
        &mut self,
        node: roxmltree::Node<'_, '_>,
        places: &Places<'_>,
        depth: usize,
    ) -> Result<Property> {
        let mut attributes = Vec::new();
        for attribute in node.attributes() {
            let value = self.substituted(attribute.value(), &places.source(attribute.range_value()))?;
            attributes.push((attribute.name().to_owned(), value));
        }
        let name = attributes.iter().find(|(key, _)| key == "name").map(|(_, name)| present_name(name));
        let source = places.source(name_range(node));
        if depth > MAX_DEPTH {
            return Err(too_deep(&source));
        }
        let mut steps = Vec::new();
        for child in node.children().filter(|child| child.is_element()) {
            steps.push(self.property(child, places, depth + 1)?);
        }
        Ok(Property {
            tag: present_tag(node.tag_name().name()).to_owned(),
            name: name.unwrap_or_default(),
            attributes,
            steps,
            source,
            used: Cell::new(false),
        })
    }

    fn include(&mut self, node: roxmltree::Node<'_, '_>, places: &Places<'_>, parent: usize) -> Result<()> {
        let name = self.required(node, "filename", places)?;
        let source = places.source(name_range(node));
        self.includes += 1;
        if self.includes > MAX_INCLUDES {
            return Err(SceneError::at(&source, format!("more than {MAX_INCLUDES} includes")));
        }
        let path = self.assets.path(&name);
        let bytes = read_file(&source, &name, &path)?;
        let text =
            String::from_utf8(bytes).map_err(|_| SceneError::at(&source, format!("'{name}' is no text")))?;
        self.file(&text, &Arc::from(path.display().to_string()), Some(parent))
    }

    fn attribute(
        &self,
        node: roxmltree::Node<'_, '_>,
        key: &str,
        places: &Places<'_>,
    ) -> Result<Option<String>> {
        let Some(attribute) = node.attribute_node(key) else { return Ok(None) };
        self.substituted(attribute.value(), &places.source(attribute.range_value())).map(Some)
    }

    fn required(&self, node: roxmltree::Node<'_, '_>, key: &str, places: &Places<'_>) -> Result<String> {
        self.attribute(node, key, places)?.ok_or_else(|| {
            let source = places.source(name_range(node));
            SceneError::at(&source, format!("<{}> needs the attribute `{key}`", node.tag_name().name()))
        })
    }

    /// A text with `$name` replaced by what `<default>` gave.
    fn substituted(&self, text: &str, source: &Source) -> Result<String> {
        let mut parts = text.split('$');
        let mut result = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let length = part.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(part.len());
            let (name, rest) = part.split_at(length);
            let Some(value) = self.parameters.get(name) else {
                let error = SceneError::at(source, format!("the parameter '${name}' has no value"));
                return Err(error.with_remedy(format!("add <default name=\"{name}\" value=\"...\"/>")));
            };
            result.push_str(value);
            result.push_str(rest);
        }
        Ok(result)
    }
}

fn too_deep(source: &Source) -> SceneError {
    SceneError::at(source, format!("elements are nested more than {MAX_DEPTH} deep"))
}

/// Bytes of an element's start, for underlining.
fn name_range(node: roxmltree::Node<'_, '_>) -> std::ops::Range<usize> {
    let start = node.range().start;
    start..start + 1 + node.tag_name().name().len()
}

/// The XML reader's message without its own " at line:column".
fn without_position(message: &str) -> &str {
    message.rsplit_once(" at ").map_or(
        message,
        |(text, position)| {
            if position.contains(':') { text } else { message }
        },
    )
}

/// Names of elements that changed between versions.
fn present_tag(tag: &str) -> &str {
    match tag {
        "camera" => "sensor",
        "luminaire" => "emitter",
        "lookAt" => "lookat",
        other => other,
    }
}

/// A name as version 3 writes it: `toWorld` becomes `to_world`, `intIOR` `int_ior`.
fn present_name(name: &str) -> String {
    let mut result = String::with_capacity(name.len() + 4);
    let mut previous_is_small = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && previous_is_small {
            result.push('_');
        }
        previous_is_small = c.is_ascii_lowercase() || c.is_ascii_digit();
        result.push(c.to_ascii_lowercase());
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn older_names_become_present_ones() {
        for (old, new) in [
            ("toWorld", "to_world"),
            ("intIOR", "int_ior"),
            ("fovAxis", "fov_axis"),
            ("sigmaS", "sigma_s"),
            ("cropOffsetX", "crop_offset_x"),
            ("to_world", "to_world"),
            ("k", "k"),
        ] {
            assert_eq!(present_name(old), new);
        }
    }
}
