//! `--set` on scenes of other formats: what can be changed after reading.
//!
//! `settings.*`, `film.*`, `camera.*` (or `camera.NAME.*`), `media.NAME.*` and, of `object.NAME`, `material` (a name),
//! `medium`, `interface`, `emission.*`.

use super::document::Node;
use super::field::Field;
use super::overrides;
use super::scene::Reader;
use super::table::Table;
use super::{camera, film, medium, object, references, settings};
use crate::Result;
use crate::assets::Assets;
use crate::nearest::nearest;
use hyaline_scene::{Located, SceneDescription, SceneError, Source};
use std::path::Path;

/// Applies overrides to a scene that was read from another format.
///
/// # Errors
/// A path that such a scene has not; faults of the values.
pub(crate) fn override_imported(scene: &mut SceneDescription, overrides: &[(String, String)]) -> Result<()> {
    let mut root = Node::empty_table(Source::file("--set"));
    overrides::apply(&mut root, overrides)?;
    let mut table = Table::root(&root)?;
    if let Some(field) = table.take("settings") {
        settings::read(field.table("settings")?, 1.0, &mut scene.settings)?;
    }
    if let Some(field) = table.take("film") {
        film::read(field.table("film")?, &mut scene.film)?;
    }
    if let Some(field) = table.take("camera") {
        cameras(scene, field)?;
    }
    if let Some(field) = table.take("media") {
        let assets = Assets::new(Path::new(""));
        for (field, source) in field.entries()? {
            let names = scene.media.iter().map(|medium| medium.name.as_str());
            let index = position("medium", field.key, source, names)?;
            let mut table = field.table(format!("medium '{}'", field.key))?;
            let old = scene.media[index].value.clone();
            scene.media[index].value = medium::read(&mut table, 1.0, old, &assets, &mut scene.notes)?;
            table.finish()?;
        }
    }
    if let Some(field) = table.take("object") {
        for (field, source) in field.entries()? {
            let names = scene.objects.iter().map(|object| object.name.as_str());
            let index = position("object", field.key, source, names)?;
            override_object(scene, index, field)?;
        }
    }
    table.finish()?;
    references::describe_liquids(scene, 1.0);
    Ok(())
}

fn position<'a>(
    what: &str,
    name: &str,
    source: &Source,
    names: impl Iterator<Item = &'a str>,
) -> Result<usize> {
    let names: Vec<&str> = names.collect();
    names.iter().position(|candidate| *candidate == name).ok_or_else(|| {
        let error = SceneError::at(source, format!("no {what} is named '{name}'"));
        match nearest(name, names.iter().copied()) {
            Some(candidate) => error.with_remedy(format!("did you mean '{candidate}'?")),
            None => error.with_remedy(format!("the scene has no {what}")),
        }
    })
}

/// `camera.KEY` means the first camera, `camera.NAME.KEY` the one of that name.
fn cameras(scene: &mut SceneDescription, field: Field<'_>) -> Result<()> {
    let entries = field.entries()?;
    let named = entries.iter().find_map(|(entry, _)| {
        let index = scene.cameras.iter().position(|camera| camera.name == entry.key)?;
        Some((index, *entry))
    });
    let (index, field) = named.unwrap_or((0, field));
    let Some(old) = scene.cameras.get(index).map(|camera| camera.value.clone()) else {
        return Err(field.error("the scene has no camera"));
    };
    let mut table = field.table(format!("camera '{}'", old.name))?;
    scene.cameras[index].value = camera::read(&mut table, 1.0, old.name.clone(), Some(&old))?;
    table.finish()
}

fn override_object(scene: &mut SceneDescription, index: usize, field: Field<'_>) -> Result<()> {
    let object = &mut scene.objects[index].value;
    let mut table = field.table(format!("object '{}'", object.name))?;
    if let Some(material) = table.take("material") {
        let name: Located<String> = material.name()?;
        let names = scene.materials.iter().map(|material| material.name.as_str());
        position("material", &name, &name.source, names)?;
        object.material = name;
    }
    if let Some(boundary) = object::boundary(&mut table)? {
        object.boundary = boundary;
    }
    if let Some(field) = table.take("emission") {
        let mut table = field.table("emission")?;
        let assets = Assets::new(Path::new(""));
        object.emission = Some(Reader::new(&assets).emission(&mut table, object.emission.as_ref())?);
        table.finish()?;
    }
    table.finish()
}
