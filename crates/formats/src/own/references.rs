//! What a description refers to without having described it: implicit materials, measured liquids, air and vacuum.

use super::medium;
use crate::Result;
use hyaline_scene::measured::is_same_name;
use hyaline_scene::{
    BoundaryDescription, IndexDescription, Located, MaterialDescription, MediumDescription, SceneDescription,
    SceneError, ShapeDescription, Source,
};
use std::collections::BTreeMap;

/// Names of a clear medium of index 1 that need no description.
const VACUUM: [&str; 2] = ["air", "vacuum"];

/// Adds a material unless it is there already; returns the name that it got, which differs from the wanted one
/// where another material has that.
pub(crate) fn add_material(
    materials: &mut Vec<Located<MaterialDescription>>,
    mut wanted: MaterialDescription,
    source: &Source,
) -> String {
    let base = wanted.name.clone();
    for count in 2.. {
        match materials.iter().find(|material| material.name == wanted.name) {
            None => break,
            Some(same) if same.value == wanted => return wanted.name,
            Some(_) => wanted.name = format!("{base} ({count})"),
        }
    }
    let name = wanted.name.clone();
    materials.push(Located::new(wanted, source.clone()));
    name
}

/// Describes the media that a scene names without describing them and that bear the name of a measured liquid. A name
/// that differs from a described one by its spelling alone is left as it is: it is a slip.
///
/// - `metres`: length of a scene unit.
pub(super) fn describe_liquids(scene: &mut SceneDescription, metres: f64) {
    let mut added: Vec<Located<MediumDescription>> = Vec::new();
    for name in named_media(scene) {
        let mut described = scene.media.iter().chain(&added);
        if !described.any(|medium| is_same_name(&medium.name, name)) {
            let liquid = medium::by_liquid_name(name, metres);
            added.extend(liquid.map(|liquid| Located::new(liquid, name.source.clone())));
        }
    }
    scene.media.extend(added);
}

/// Every name of a medium that is said outside of the descriptions of media.
fn named_media(scene: &SceneDescription) -> Vec<&Located<String>> {
    let mut names: Vec<&Located<String>> = scene.surrounding.iter().collect();
    for object in &scene.objects {
        match &object.boundary {
            BoundaryDescription::Interface { outside, inside } => names.extend(outside.iter().chain(inside)),
            BoundaryDescription::Solid { medium } => names.push(medium),
            BoundaryDescription::None => {}
        }
        if let ShapeDescription::Vessel(vessel) = &object.shape {
            names.push(&vessel.medium);
            names.extend(vessel.fill.iter().map(|layer| &layer.medium));
        }
    }
    names.extend(scene.cameras.iter().filter_map(|camera| camera.medium.as_ref()));
    names.extend(scene.lights.iter().filter_map(|light| light.medium.as_ref()));
    names
}

/// Resolves `air` and `vacuum` where the scene does not describe them: as the world's medium where that is vacuum
/// and may be left out, else as a medium of index 1 that is added. Describes measured liquids.
///
/// - `metres`: length of a scene unit.
///
/// # Errors
/// An object named like another.
pub(super) fn complete(scene: &mut SceneDescription, metres: f64) -> Result<()> {
    describe_liquids(scene, metres);
    let described: Vec<String> = scene.media.iter().map(|medium| medium.name.clone()).collect();
    let is_vacuum = |name: &str| VACUUM.contains(&name) && !described.iter().any(|medium| medium == name);
    if scene.surrounding.as_ref().is_some_and(|name| is_vacuum(name)) {
        scene.surrounding = None;
    }
    let may_be_left_out = scene.surrounding.is_none();
    let mut missing: BTreeMap<String, Source> = BTreeMap::new();
    let mut need = |name: &Located<String>| {
        if is_vacuum(name) {
            missing.entry(name.value.clone()).or_insert_with(|| name.source.clone());
        }
    };
    let mut settle = |side: &mut Option<Located<String>>| match side {
        Some(name) if is_vacuum(name) && may_be_left_out => *side = None,
        Some(name) => need(name),
        None => {}
    };
    for object in &mut scene.objects {
        if let BoundaryDescription::Interface { outside, inside } = &mut object.boundary {
            settle(outside);
            settle(inside);
        }
    }
    for camera in &mut scene.cameras {
        settle(&mut camera.medium);
    }
    for light in &mut scene.lights {
        settle(&mut light.medium);
    }
    for object in &scene.objects {
        if let BoundaryDescription::Solid { medium } = &object.boundary {
            need(medium);
        }
        if let ShapeDescription::Vessel(vessel) = &object.shape {
            need(&vessel.medium);
            vessel.fill.iter().for_each(|layer| need(&layer.medium));
        }
    }
    for (name, source) in missing {
        let medium = MediumDescription::clear(name, IndexDescription::Constant(1.0));
        scene.media.push(Located::new(medium, source));
    }
    require_distinct_names(scene)
}

/// Lights with a shape are objects: their names must differ from those of the others.
fn require_distinct_names(scene: &SceneDescription) -> Result<()> {
    let mut places: BTreeMap<&str, &Source> = BTreeMap::new();
    for object in &scene.objects {
        if let Some(first) = places.insert(&object.name, &object.source) {
            let message = format!("two objects are named '{}'; the other is at {first}", object.name);
            return Err(SceneError::at(&object.source, message).with_remedy("rename one of them"));
        }
    }
    Ok(())
}
