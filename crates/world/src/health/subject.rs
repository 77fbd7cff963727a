//! The scene as the judges see it: objects of the world with their names and places in the file.

use crate::World;
use hyaline_math::{Bounds, Vec3};
use hyaline_scattering::{BoundaryKind, MediumId, ObjectId};
use hyaline_scene::{
    IndexDescription, MediumDescription, Note, ObjectDescription, SceneDescription, Severity,
};
use std::collections::HashMap;

/// A compiled scene and what it was compiled from.
pub(super) struct Scene<'a> {
    pub(super) world: &'a World,
    pub(super) description: &'a SceneDescription,
    /// By object id.
    subjects: Vec<Subject>,
}

/// An object of the world.
struct Subject {
    /// Index in the description. A vessel is several objects of the world and one of the description.
    described: Option<usize>,
    bounds: Bounds,
}

impl<'a> Scene<'a> {
    pub(super) fn new(description: &'a SceneDescription, world: &'a World) -> Self {
        let indices: HashMap<&str, usize> =
            description.objects.iter().enumerate().map(|(i, object)| (object.name.as_str(), i)).collect();
        let described = |name: &str| {
            // The liquids of a vessel are named 'vessel: liquid'.
            let vessel = || name.rsplit_once(": ").and_then(|(vessel, _)| indices.get(vessel));
            indices.get(name).or_else(vessel).copied()
        };
        let names = world.object_names.iter();
        let mut subjects: Vec<Subject> =
            names.map(|name| Subject { described: described(name), bounds: Bounds::EMPTY }).collect();
        for (info, item) in world.items.iter().zip(world.geometry.items()) {
            let bounds = &mut subjects[info.object.0 as usize].bounds;
            *bounds = bounds.union(item.geometry.bounds());
        }
        Self { world, description, subjects }
    }

    /// All objects.
    pub(super) fn objects(&self) -> impl Iterator<Item = ObjectId> + use<> {
        (0..self.subjects.len() as u32).map(ObjectId)
    }

    pub(super) fn name(&self, object: ObjectId) -> &str {
        &self.world.object_names[object.0 as usize]
    }

    pub(super) fn kind(&self, object: ObjectId) -> BoundaryKind {
        self.world.boundaries.of(object)
    }

    /// Whether media meet at the object.
    pub(super) fn is_boundary(&self, object: ObjectId) -> bool {
        self.kind(object) != BoundaryKind::None
    }

    pub(super) fn bounds(&self, object: ObjectId) -> Bounds {
        self.subjects[object.0 as usize].bounds
    }

    /// Diagonal of the object's box, scene units.
    pub(super) fn size(&self, object: ObjectId) -> f32 {
        2.0 * self.bounds(object).radius()
    }

    /// Whether both are parts of one object of the file, which are made to fit.
    pub(super) fn belong_together(&self, a: ObjectId, b: ObjectId) -> bool {
        let described = |object: ObjectId| self.subjects[object.0 as usize].described;
        a == b || (described(a).is_some() && described(a) == described(b))
    }

    pub(super) fn described(&self, object: ObjectId) -> Option<&'a ObjectDescription> {
        let index = self.subjects[object.0 as usize].described?;
        Some(&self.description.objects[index].value)
    }

    /// A note at the place in the file where the object is described.
    pub(super) fn note(&self, severity: Severity, object: ObjectId, message: String) -> Note {
        let index = self.subjects[object.0 as usize].described;
        let source = index.map(|index| self.description.objects[index].source.clone());
        Note { severity, source, message }
    }

    /// A medium in words.
    pub(super) fn medium_name(&self, medium: MediumId) -> String {
        match self.medium(medium) {
            Some(description) => format!("'{}'", description.name),
            None => "vacuum".into(),
        }
    }

    /// Whether two media differ by more than their names. Air and vacuum are told apart by some files; nobody sees
    /// the difference.
    pub(super) fn differ(&self, a: MediumId, b: MediumId) -> bool {
        const INVISIBLE: f32 = 1e-3;
        let rest = |medium: MediumId| {
            let clear = || MediumDescription::clear("", IndexDescription::Constant(1.0));
            let description = self.medium(medium).cloned().unwrap_or_else(clear);
            let (name, index) = (String::new(), IndexDescription::Constant(1.0));
            MediumDescription { name, index, priority: 0, ..description }
        };
        a != b && ((self.world.ior(a) - self.world.ior(b)).abs() > INVISIBLE || rest(a) != rest(b))
    }

    /// The description of a medium; `None` for the vacuum that every world has.
    fn medium(&self, medium: MediumId) -> Option<&MediumDescription> {
        self.description.media.get(medium.index().checked_sub(1)?).map(|located| &located.value)
    }
}

/// A place in words.
pub(super) fn at(p: Vec3) -> String {
    // What is tiny beside the other coordinates is rounding.
    let tiny = 1e-6 * p.abs().max_element();
    let [x, y, z] = p.to_array().map(|x| number(if x.abs() < tiny { 0.0 } else { x }));
    format!("({x}, {y}, {z})")
}

/// A length with four digits.
pub(super) fn number(x: f32) -> String {
    // Rounded by way of its text, which keeps the digits that count whatever the size.
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(f64::NAN);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}
