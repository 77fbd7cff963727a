//! From XML to a tree of elements: parameters replaced, includes read, names in their present form.
//!
//! Elements with a `type` (shape, bsdf, ...) are plugins, the others properties of the plugin around them. DTDs and
//! with them entities are refused, so that none can be blown up; the number of elements and their nesting are limited.

use super::include::Includes;
use super::names::{PLUGIN_TAGS, PROPERTY_TAGS, present_name, present_tag};
use super::parameters::Parameters;
use super::tree::{Child, Plugin, Property, Target, Tree};
use crate::Result;
use crate::assets::Assets;
use crate::place::Places;
use hyaline_scene::{SceneError, Source};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Deepest nesting of elements.
const MAX_DEPTH: usize = 32;
/// Most elements, attributes and texts in all files together.
const MAX_NODES: u32 = 4_000_000;

/// Parses a scene file.
///
/// # Errors
/// XML that is not well-formed, parameters and includes that are not there, two plugins of one id.
pub(super) fn parse(text: &str, file: &Arc<str>, assets: &Assets, parameters: Parameters) -> Result<Tree> {
    let mut builder = Builder {
        tree: Tree { plugins: Vec::new(), ids: BTreeMap::new(), strange: Vec::new() },
        parameters,
        assets,
        includes: Includes::new(file, assets.base_dir()),
        nodes: 0,
    };
    builder.file(text, file, None)?;
    builder.parameters.check_used()?;
    Ok(builder.tree)
}

/// Makes the tree, file by file.
pub(super) struct Builder<'a> {
    tree: Tree,
    parameters: Parameters,
    /// Where files are looked for.
    pub(super) assets: &'a Assets,
    /// The files that are being read.
    pub(super) includes: Includes,
    nodes: u32,
}

impl Builder<'_> {
    /// Reads a file into the plugin `parent`, or as the scene itself.
    pub(super) fn file(&mut self, text: &str, file: &Arc<str>, parent: Option<usize>) -> Result<()> {
        let places = Places::new(file.clone(), text);
        let nodes_limit = MAX_NODES - self.nodes;
        let options = roxmltree::ParsingOptions { allow_dtd: false, nodes_limit, ..Default::default() };
        let document = roxmltree::Document::parse_with_options(text, options);
        let document = document.map_err(|error| not_well_formed(&error, file))?;
        self.nodes = self.nodes.saturating_add(saturated(document.descendants().count())).min(MAX_NODES);
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
                self.parameters.define(name, value);
            }
            "include" => self.include(&self.required(node, "filename", places)?, &source, parent)?,
            "path" => self.search_folder(&self.required(node, "value", places)?, &source)?,
            "alias" => self.alias(node, places)?,
            // Say nothing about the scene in any version.
            "mode" | "null" => {}
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
        if let Some(id) = &id {
            self.identify(id.clone(), index, &source)?;
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
            let value_source = places.source(attribute.range_value());
            let value = self.parameters.replace(attribute.value(), &value_source)?;
            if attribute.name() == "filename" && node.tag_name().name() == "spectrum" {
                attributes.push(("value".to_owned(), self.spectrum_file(&value, &value_source)?));
            }
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

    /// Another name for a plugin that stands before it.
    fn alias(&mut self, node: roxmltree::Node<'_, '_>, places: &Places<'_>) -> Result<()> {
        let (id, new) = (self.required(node, "id", places)?, self.required(node, "as", places)?);
        let source = places.source(name_range(node));
        let Some(index) = self.tree.ids.get(&id).copied() else {
            let error = SceneError::at(&source, format!("nothing above has the id '{id}'"));
            return Err(error.with_remedy("move the alias below what it names"));
        };
        self.identify(new, index, &source)
    }

    /// Gives a plugin an id that nobody else has.
    fn identify(&mut self, id: String, index: usize, source: &Source) -> Result<()> {
        if let Some(first) = self.tree.ids.get(&id) {
            let first = &self.tree.plugins[*first].source;
            let message = format!("two elements have the id '{id}'; the other is at {first}");
            return Err(SceneError::at(source, message).with_remedy("rename one of them"));
        }
        self.tree.ids.insert(id, index);
        Ok(())
    }

    fn attribute(
        &self,
        node: roxmltree::Node<'_, '_>,
        key: &str,
        places: &Places<'_>,
    ) -> Result<Option<String>> {
        let Some(attribute) = node.attribute_node(key) else { return Ok(None) };
        let source = places.source(attribute.range_value());
        self.parameters.replace(attribute.value(), &source).map(Some)
    }

    fn required(&self, node: roxmltree::Node<'_, '_>, key: &str, places: &Places<'_>) -> Result<String> {
        self.attribute(node, key, places)?.ok_or_else(|| {
            let source = places.source(name_range(node));
            SceneError::at(&source, format!("<{}> needs the attribute `{key}`", node.tag_name().name()))
        })
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

/// The XML reader's complaint, with its place.
fn not_well_formed(error: &roxmltree::Error, file: &Arc<str>) -> SceneError {
    let position = error.pos();
    let source = Source { file: file.clone(), line: position.row, column: position.col, length: 1 };
    match error {
        roxmltree::Error::DtdDetected => {
            let error = SceneError::at(&source, "a DTD is not read, nor the entities that it may define");
            error.with_remedy("remove <!DOCTYPE ...> and write entities out")
        }
        roxmltree::Error::NodesLimitReached => {
            SceneError::at(&source, format!("the scene has more than {MAX_NODES} elements"))
        }
        _ => SceneError::at(&source, format!("not valid XML: {}", without_position(&error.to_string()))),
    }
}

fn saturated(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
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
