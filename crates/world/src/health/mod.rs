//! What is doubtful about a scene: faults of meshes, and of how objects lie in and on each other; each by name, with
//! what the renderer takes it for and what to do about it.
//!
//! 1. Facts about each mesh (`hyaline_geometry::mesh::health`) become notes.
//! 2. Lines are sent through every transparent object, and through every place where it may touch another.
//! 3. Judges look at all surfaces along each line: which coincide, which bodies overlap, whether the media that
//!    neighboring interfaces name agree, whether walls have a thickness, whether what is entered is left.
//!
//! A line is evidence for what it meets and nothing else, so no judge asks for parity to infinity across a hole.

mod contact;
mod line;
mod mesh;
mod overlap;
mod rim;
mod sides;
mod subject;
#[cfg(test)]
mod tests;
mod wall;

use crate::World;
use hyaline_scene::{Note, SceneDescription};
use subject::Scene;

/// Looks for everything doubtful about a scene; may take as long as building its hierarchies.
///
/// - `world`: compiled from `description`.
pub fn examine(description: &SceneDescription, world: &World) -> Vec<Note> {
    let scene = Scene::new(description, world);
    let mut notes = mesh::notes(&scene);
    let (mut contacts, mut overlaps) = (contact::Contacts::default(), overlap::Overlaps::default());
    let (mut sides, mut walls) = (sides::Sides::default(), wall::Walls::default());
    line::send(&scene, &mut |line| {
        contacts.look(&scene, line);
        overlaps.look(&scene, line);
        sides.look(&scene, line);
        walls.look(&scene, line);
    });
    notes.extend(walls.notes(&scene));
    notes.extend(overlaps.notes(&scene));
    notes.extend(contacts.notes(&scene, &overlaps));
    notes.extend(sides.notes(&scene));
    notes
}
