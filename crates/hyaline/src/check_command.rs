//! `hyaline check`: what a scene holds, and every fault or doubt about it, without rendering.

use crate::cli::CheckArguments;
use crate::failure::Failure;
use crate::message::{self, Warnings};
use crate::{inventory, scene_source};
use hyaline_world::World;

/// Reads and compiles the scene; prints what was read to stdout, notes and warnings to stderr.
///
/// Returns the exit code: 1 where there are warnings and `--strict` was given.
///
/// # Errors
/// The scene can't be used.
pub(crate) fn run(arguments: &CheckArguments) -> Result<u8, Failure> {
    let scene = scene_source::load(Some(&arguments.scene), &arguments.set)?;
    for line in inventory::lines(&scene) {
        message::print_result(&line).map_err(Failure::working)?;
    }
    let mut warnings = Warnings::default();
    warnings.tell_notes(&scene.notes);
    let (_, notes) = World::compile(&scene)?;
    warnings.tell_notes(&notes);
    Ok(u8::from(arguments.strict && warnings.count() > 0))
}
