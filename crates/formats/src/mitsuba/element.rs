//! A plugin of the tree, with access to its values and to the plugins within it.

use super::names::SPECTRUM_KINDS;
use super::notes::Notes;
use super::spectrum::Meaning;
use super::tree::{Child, Plugin, Property, Target, Tree};
use super::{spectrum_plugin as spectrum, transform};
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{Located, Rgb, SceneError, Source};

/// A plugin being read; copies are the same plugin. What is asked for counts as understood.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element<'a> {
    tree: &'a Tree,
    plugin: &'a Plugin,
    /// Where warnings go.
    pub(super) notes: &'a Notes,
}

impl<'a> Element<'a> {
    /// The scene itself.
    pub(super) fn root(tree: &'a Tree, notes: &'a Notes) -> Option<Self> {
        tree.plugins.first().map(|plugin| Self::visit(tree, plugin, notes))
    }

    fn visit(tree: &'a Tree, plugin: &'a Plugin, notes: &'a Notes) -> Self {
        plugin.visited.set(true);
        Self { tree, plugin, notes }
    }

    /// Its `type`.
    pub(super) fn kind(&self) -> &'a str {
        &self.plugin.kind
    }

    /// Its `id`.
    pub(super) fn id(&self) -> Option<&'a str> {
        self.plugin.id.as_deref()
    }

    /// Place of the element.
    pub(super) fn source(&self) -> &'a Source {
        &self.plugin.source
    }

    /// The major version of the scene: 0, 2 or 3.
    pub(super) fn major_version(&self) -> u32 {
        let version = self.plugin.version.as_deref().and_then(|version| version.split('.').next());
        version.and_then(|major| major.parse().ok()).unwrap_or(3)
    }

    /// What messages call it.
    pub(super) fn title(&self) -> String {
        title(self.plugin)
    }

    /// A fault of this element.
    pub(super) fn error(&self, message: impl Into<String>) -> SceneError {
        SceneError::at(self.source(), message)
    }

    /// What tells this plugin from all others.
    pub(super) fn key(&self) -> usize {
        std::ptr::from_ref(self.plugin) as usize
    }

    /// Adds a remark about this element.
    pub(super) fn info(&self, message: impl Into<String>) {
        self.notes.info(self.source(), message);
    }

    /// Adds a warning about this element.
    pub(super) fn warn(&self, message: impl Into<String>) {
        self.notes.warn(self.source(), message);
    }

    /// A value by name.
    pub(super) fn property(&self, name: &str) -> Option<&'a Property> {
        let property = self.plugin.properties.iter().rev().find(|property| property.name == name)?;
        property.used.set(true);
        Some(property)
    }

    /// Takes note of values that change nothing here.
    pub(super) fn ignore(&self, names: &[&str]) {
        for name in names {
            self.property(name);
        }
    }

    /// Takes note of everything in this element.
    pub(super) fn ignore_all(&self) {
        self.plugin.properties.iter().for_each(|property| property.used.set(true));
        for child in &self.plugin.children {
            child.used.set(true);
        }
    }

    /// A number within limits.
    pub(super) fn float(&self, name: &str, default: f64, limits: Limits) -> Result<f64> {
        let Some(property) = self.property(name) else { return Ok(default) };
        let number = property.parse(property.value()?)?;
        if limits.contain(number) {
            return Ok(number);
        }
        Err(property.error(format!("`{name}` must be {}, not {number}", limits.words())))
    }

    /// A whole number, if it is there.
    pub(super) fn integer(&self, name: &str) -> Result<Option<i64>> {
        let Some(property) = self.property(name) else { return Ok(None) };
        let text = property.value()?.trim();
        let number = text.parse().map_err(|_| {
            let shown: String = text.chars().take(24).collect();
            property.error(format!("`{name}` must be a whole number, not '{shown}'"))
        })?;
        Ok(Some(number))
    }

    /// `true` or `false`.
    pub(super) fn boolean(&self, name: &str, default: bool) -> Result<bool> {
        let Some(property) = self.property(name) else { return Ok(default) };
        match property.value()?.trim() {
            text if text.eq_ignore_ascii_case("true") => Ok(true),
            text if text.eq_ignore_ascii_case("false") => Ok(false),
            other => Err(property.error(format!("`{name}` must be true or false, not '{other}'"))),
        }
    }

    /// A text, if it is there.
    pub(super) fn string(&self, name: &str) -> Result<Option<Located<String>>> {
        let Some(property) = self.property(name) else { return Ok(None) };
        Ok(Some(Located::new(property.value()?.to_owned(), property.source.clone())))
    }

    /// A color within limits, if it is there: a value, or a plugin that is one color.
    pub(super) fn color(&self, name: &str, limits: Limits) -> Result<Option<Rgb>> {
        let meaning = if self.plugin.tag == "emitter" { Meaning::Light } else { Meaning::Factor };
        let (color, source) = match self.property(name) {
            Some(property) => (property.color(meaning)?, &property.source),
            None => match self.spectrum_child(name)? {
                Some(spectrum) => (spectrum::read(spectrum, meaning)?, spectrum.source()),
                None => return Ok(None),
            },
        };
        match color.iter().find(|value| !limits.contain(f64::from(**value))) {
            None => Ok(Some(color)),
            Some(bad) => {
                let message = format!("`{name}` must be {}, not {bad}", limits.words());
                Err(SceneError::at(source, message))
            }
        }
    }

    /// The plugin under `name` if it is a single color.
    fn spectrum_child(&self, name: &str) -> Result<Option<Element<'a>>> {
        for child in self.plugin.children.iter().filter(|child| child.name.as_deref() == Some(name)) {
            let plugin = self.resolve(child)?;
            if plugin.tag == "texture" && SPECTRUM_KINDS.contains(&plugin.kind.as_str()) {
                child.used.set(true);
                return Ok(Some(Self::visit(self.tree, plugin, self.notes)));
            }
        }
        Ok(None)
    }

    /// A point or vector, if it is there.
    pub(super) fn point(&self, name: &str) -> Result<Option<DVec3>> {
        self.property(name).map(|property| property.vector(0.0)).transpose()
    }

    /// A transform; the identity where there is none.
    pub(super) fn transform(&self, name: &str) -> Result<Transform> {
        let Some(property) = self.property(name) else { return Ok(Transform::IDENTITY) };
        if property.tag == "animation" {
            let message = "an animation is not supported; its first transform counts";
            self.notes.warn(&property.source, message);
        }
        transform::read(property)
    }

    /// The plugins within this one, of one tag, with the names under which they are used.
    pub(super) fn children(&self, tag: &str) -> Result<Vec<(Option<&'a str>, Element<'a>)>> {
        let mut found = Vec::new();
        for child in &self.plugin.children {
            let plugin = self.resolve(child)?;
            if plugin.tag == tag {
                child.used.set(true);
                found.push((child.name.as_deref(), Self::visit(self.tree, plugin, self.notes)));
            }
        }
        Ok(found)
    }

    /// Whether there is a plugin of a tag within this one; does not count as asking for it.
    pub(super) fn has_child(&self, tag: &str) -> Result<bool> {
        for child in &self.plugin.children {
            if self.resolve(child)?.tag == tag {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Takes note of the plugins of a tag within this one without reading them.
    pub(super) fn mark_described(&self, tag: &str) -> Result<()> {
        for child in &self.plugin.children {
            if self.resolve(child)?.tag == tag {
                child.used.set(true);
            }
        }
        Ok(())
    }

    /// The first plugin of a tag within this one.
    pub(super) fn child(&self, tag: &str) -> Result<Option<Element<'a>>> {
        Ok(self.children(tag)?.into_iter().next().map(|(_, element)| element))
    }

    /// The plugin of a tag that is used under `name`; others of the tag are left to who asks for them.
    pub(super) fn child_named(&self, tag: &str, name: &str) -> Result<Option<Element<'a>>> {
        for child in self.plugin.children.iter().filter(|child| child.name.as_deref() == Some(name)) {
            let plugin = self.resolve(child)?;
            if plugin.tag == tag {
                child.used.set(true);
                return Ok(Some(Self::visit(self.tree, plugin, self.notes)));
            }
        }
        Ok(None)
    }

    fn resolve(&self, child: &'a Child) -> Result<&'a Plugin> {
        match &child.target {
            Target::Index(index) => Ok(&self.tree.plugins[*index]),
            Target::Id(id) => match self.tree.ids.get(id) {
                Some(index) => Ok(&self.tree.plugins[*index]),
                None => {
                    let error = SceneError::at(&child.source, format!("nothing has the id '{id}'"));
                    let nearest = crate::nearest::nearest(id, self.tree.ids.keys().map(String::as_str));
                    Err(match nearest {
                        Some(candidate) => error.with_remedy(format!("did you mean '{candidate}'?")),
                        None => error.with_remedy("give the element that is meant an `id`"),
                    })
                }
            },
        }
    }
}

/// Warns of everything that no reader asked for, in the order of the file.
pub(super) fn warn_of_leftovers(tree: &Tree, notes: &Notes) {
    for plugin in tree.plugins.iter().filter(|plugin| plugin.visited.get()) {
        for property in plugin.properties.iter().filter(|property| !property.used.get()) {
            let message = format!("{} of {} is not supported and ignored", property.title(), title(plugin));
            notes.warn(&property.source, message);
        }
        for child in plugin.children.iter().filter(|child| !child.used.get()) {
            let what = match &child.target {
                Target::Index(index) => title(&tree.plugins[*index]),
                Target::Id(id) => format!("the reference to '{id}'"),
            };
            let message = format!("{what} in {} is not supported and ignored", title(plugin));
            notes.warn(&child.source, message);
        }
    }
    for (tag, source) in &tree.strange {
        notes.warn(source, format!("the element <{tag}> is not supported and ignored"));
    }
}

fn title(plugin: &Plugin) -> String {
    let kind = if plugin.kind.is_empty() { String::new() } else { format!(" '{}'", plugin.kind) };
    format!("{}{kind}", plugin.tag)
}
