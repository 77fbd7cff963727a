//! Cameras, and what they are in.

use super::{Library, locate};
use crate::World;
use crate::camera::Camera;
use hyaline_math::DVec3;
use hyaline_scene::{Note, SceneError};

/// Adds all cameras to the world.
///
/// # Errors
/// There is none, or one declares a medium that is not there.
pub(super) fn compile_all(
    library: &Library,
    world: &mut World,
    notes: &mut Vec<Note>,
) -> Result<(), SceneError> {
    if library.description.cameras.is_empty() {
        let remedy = "add a [camera] with `from`, `to` and `fov`";
        return Err(SceneError::general("the scene has no camera").with_remedy(remedy));
    }
    let film = &library.description.film;
    let surrounding = library.surrounding()?;
    for camera in &library.description.cameras {
        let base = library.medium_or(&camera.medium, surrounding)?;
        let place = camera.placement.point(DVec3::ZERO).as_vec3();
        let name = format!("camera '{}'", camera.name);
        let set = locate::locate(world, &[place], None, base, &name, &camera.source, notes);
        world.cameras.push(Camera::new(camera, film.width, film.height));
        world.camera_names.push(camera.name.clone());
        world.camera_media.push(set);
    }
    Ok(())
}
