//! The elements of a scene file, with their properties and places.

use hyaline_scene::Source;
use std::cell::Cell;
use std::collections::BTreeMap;

/// A scene file as a tree.
#[derive(Debug)]
pub(super) struct Tree {
    /// All plugins; the first is the scene.
    pub(super) plugins: Vec<Plugin>,
    /// Plugins by id.
    pub(super) ids: BTreeMap<String, usize>,
    /// Elements that are neither plugin nor property.
    pub(super) strange: Vec<(String, Source)>,
}

/// An element with properties and children.
#[derive(Debug)]
pub(super) struct Plugin {
    /// Name of the element: shape, bsdf, ...
    pub(super) tag: String,
    /// Its `type`.
    pub(super) kind: String,
    /// Its `id`.
    pub(super) id: Option<String>,
    /// The scene's `version`.
    pub(super) version: Option<String>,
    /// Place of the element.
    pub(super) source: Source,
    /// Its values.
    pub(super) properties: Vec<Property>,
    /// The plugins within it.
    pub(super) children: Vec<Child>,
    /// Whether a reader has looked at it.
    pub(super) visited: Cell<bool>,
}

/// A value of a plugin, or a step of a transform.
#[derive(Debug)]
pub(super) struct Property {
    /// Name of the element: float, rgb, ...
    pub(super) tag: String,
    /// Its `name`.
    pub(super) name: String,
    /// Its other attributes.
    pub(super) attributes: Vec<(String, String)>,
    /// Steps of a transform.
    pub(super) steps: Vec<Property>,
    /// Place of the element.
    pub(super) source: Source,
    /// Whether a reader has asked for it.
    pub(super) used: Cell<bool>,
}

/// A plugin within another, or a reference to one.
#[derive(Debug)]
pub(super) struct Child {
    /// Its `name`: what it is for.
    pub(super) name: Option<String>,
    /// Which plugin.
    pub(super) target: Target,
    /// Place of the element.
    pub(super) source: Source,
    /// Whether a reader has asked for it.
    pub(super) used: Cell<bool>,
}

/// Which plugin a child is.
#[derive(Debug)]
pub(super) enum Target {
    /// One described on the spot.
    Index(usize),
    /// One with an id.
    Id(String),
}
