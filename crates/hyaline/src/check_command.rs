//! `hyaline check`: what a scene holds, and every fault or doubt about it, without rendering.

use crate::cli::CheckArguments;
use crate::failure::Failure;
use crate::message::{self, Warnings};
use crate::{inventory, scene_source};
use hyaline_scene::SceneError;
use hyaline_world::{World, health};

/// Reads and compiles the scene; prints what was read to stdout, notes and warnings to stderr.
///
/// Returns the exit code: 1 where there are warnings and `--strict` was given.
///
/// # Errors
/// The scene can't be used: all faults but the last are printed, the last is returned.
pub(crate) fn run(arguments: &CheckArguments) -> Result<u8, Failure> {
    let scene = scene_source::load_or_all_faults(&arguments.scene, &arguments.set).map_err(all_but_last)?;
    for line in inventory::lines(&scene) {
        message::print_result(&line).map_err(Failure::working)?;
    }
    let mut warnings = Warnings::default();
    warnings.tell_notes(&scene.notes);
    let (world, notes) = World::compile_or_all_faults(&scene).map_err(all_but_last)?;
    warnings.tell_notes(&notes);
    warnings.tell_notes(&health::examine(&scene, &world));
    Ok(u8::from(arguments.strict && warnings.count() > 0))
}

/// Prints faults in the order of the file, all but the last, which is returned.
fn all_but_last(mut faults: Vec<SceneError>) -> Failure {
    // The sort is stable: faults without a place stay in the order in which they were found.
    faults.sort_by_key(|fault| {
        fault.source.as_ref().map(|place| (place.file.clone(), place.line, place.column))
    });
    let last = faults.pop().unwrap_or_else(|| SceneError::general("the scene can't be used"));
    faults.into_iter().for_each(|fault| Failure::from(fault).print());
    Failure::from(last)
}
