//! What a description refers to without having described it: implicit materials, air and vacuum.

use crate::Result;
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

/// Resolves `air` and `vacuum` where the scene does not describe them: as the world's medium where that is vacuum
/// and may be left out, else as a medium of index 1 that is added.
///
/// # Errors
/// An object named like another.
pub(super) fn complete(scene: &mut SceneDescription) -> Result<()> {
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
