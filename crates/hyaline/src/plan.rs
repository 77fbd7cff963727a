//! What to render, from the scene and the options: options win over the scene.

use crate::argument::MAX_SIDE;
use crate::cli::RenderArguments;
use crate::failure::Failure;
use crate::limit;
use hyaline_film::Rect;
use hyaline_render::{Limits, render_settings};
use hyaline_scene::{FilmDescription, SceneDescription};
use hyaline_transport::integrator;
use hyaline_transport::{Integrator, RenderSettings, View};
use hyaline_world::camera::PixelFilter;

/// Most pixels of a picture: beyond that sums would need tens of gigabytes.
const MAX_PIXELS: u64 = 1 << 28;

/// Everything that decides on the picture but the scene itself.
pub(crate) struct Plan {
    /// How light is carried.
    pub(crate) integrator: Box<dyn Integrator>,
    /// Which picture is taken.
    pub(crate) view: View,
    /// What the integrator is told.
    pub(crate) settings: RenderSettings,
    /// Pixels to render.
    pub(crate) crop: Rect,
    /// Which passes, and how long.
    pub(crate) limits: Limits,
    /// Factor on radiance in 8-bit pictures.
    pub(crate) exposure: f32,
}

/// Puts the options into the description, and settles everything else.
///
/// # Errors
/// An unknown integrator or camera, a crop outside of the picture, a picture of no or too many pixels.
pub(crate) fn plan(arguments: &RenderArguments, scene: &mut SceneDescription) -> Result<Plan, Failure> {
    apply_options(arguments, scene);
    let integrator = choose_integrator(arguments, scene)?;
    let FilmDescription { width, height, filter, exposure, .. } = scene.film;
    let crop = choose_crop(&scene.film)?;
    let camera = choose_camera(arguments.camera.as_deref(), scene)?;
    let view = View { camera, width, height, filter: PixelFilter::new(&filter) };
    let limits = limit::limits(arguments, &scene.settings);
    Ok(Plan { integrator, view, settings: render_settings(&scene.settings), crop, limits, exposure })
}

/// Options that stand for keys of the scene.
fn apply_options(arguments: &RenderArguments, scene: &mut SceneDescription) {
    if let Some((width, height)) = arguments.size {
        (scene.film.width, scene.film.height) = (width, height);
    }
    scene.film.crop = arguments.crop.or(scene.film.crop);
    scene.film.exposure = arguments.exposure.unwrap_or(scene.film.exposure);
    scene.settings.seed = arguments.seed.unwrap_or(scene.settings.seed);
    if arguments.as_file
        && let Some(depth) = scene.settings.file_integrator.as_ref().and_then(|file| file.max_depth)
    {
        // Importers count segments, the first of which ends at the first surface; we count bounces.
        scene.settings.max_depth = Some(depth.saturating_sub(1));
    }
}

/// The option's integrator, else the file's where it is to be obeyed, else the scene's, else the first there is.
fn choose_integrator(
    arguments: &RenderArguments,
    scene: &SceneDescription,
) -> Result<Box<dyn Integrator>, Failure> {
    let of_file = scene.settings.file_integrator.as_ref().filter(|_| arguments.as_file);
    let name = match (&arguments.integrator, of_file) {
        (Some(name), _) => name,
        (None, Some(file)) => our_name(&file.name)?,
        (None, None) => scene.settings.integrator.as_deref().unwrap_or(integrator::NAMES[0]),
    };
    if let Some(integrator) = integrator::by_name(name) {
        return Ok(integrator);
    }
    Err(Failure::usage(format!("there is no integrator '{name}'"))
        .with_remedy(format!("there are: {}", integrator::NAMES.join(", "))))
}

/// Our integrator that does what another renderer's does.
fn our_name(name: &str) -> Result<&'static str, Failure> {
    match name {
        "path" | "volpath" | "volpathmis" | "volpath_simple" | "simplepath" | "simplevolpath" => Ok("path"),
        "whitted" => Ok("whitted"),
        "photonmapper" => Ok("photon-map"),
        "sppm" | "ppm" | "vcm" => Ok("merging"),
        _ => Err(Failure::usage(format!("the file's integrator '{name}' has no counterpart here"))
            .with_remedy("leave --as-file away, or choose one with --integrator")),
    }
}

/// The pixels to render.
fn choose_crop(film: &FilmDescription) -> Result<Rect, Failure> {
    let FilmDescription { width, height, .. } = *film;
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
        return Err(Failure::usage(format!("a picture of {width}x{height} pixels can't be rendered"))
            .with_remedy(format!("each side must have 1 to {MAX_SIDE} pixels")));
    }
    let [x0, y0, x1, y1] = film.crop.unwrap_or([0, 0, width, height]);
    if x0 >= x1 || y0 >= y1 || x1 > width || y1 > height {
        return Err(Failure::usage(format!(
            "the crop {x0},{y0},{x1},{y1} does not lie within the picture of {width}x{height} pixels"
        ))
        .with_remedy("give --crop x0,y0,x1,y1 with x0 < x1 <= width and y0 < y1 <= height"));
    }
    if u64::from(x1 - x0) * u64::from(y1 - y0) > MAX_PIXELS {
        return Err(Failure::usage(format!("more than {MAX_PIXELS} pixels at once"))
            .with_remedy("render it in parts with --crop"));
    }
    Ok(Rect { x0, y0, x1, y1 })
}

/// Index of the camera of that name, or of the first.
fn choose_camera(name: Option<&str>, scene: &SceneDescription) -> Result<usize, Failure> {
    let Some(name) = name else { return Ok(0) };
    let found = scene.cameras.iter().position(|camera| camera.name == name);
    found.ok_or_else(|| {
        let names: Vec<&str> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
        Failure::usage(format!("the scene has no camera '{name}'"))
            .with_remedy(format!("it has: {}", names.join(", ")))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::Parser;

    fn plan_of(words: &str, scene: &mut SceneDescription) -> Result<Plan, Failure> {
        let words = std::iter::once("hyaline").chain(words.split_whitespace());
        plan(&Cli::parse_from(words).render, scene)
    }

    #[test]
    fn options_win_over_the_scene() {
        let mut scene = SceneDescription::default();
        let plan = plan_of("--size 20x10 --seed 7 --crop 1,2,3,4 --exposure 2", &mut scene).unwrap();
        assert_eq!((plan.view.width, plan.view.height), (20, 10));
        assert_eq!(plan.settings.seed, 7);
        assert_eq!(plan.crop, Rect { x0: 1, y0: 2, x1: 3, y1: 4 });
        assert_eq!(plan.exposure, 2.0);
        assert_eq!(plan.integrator.name(), "merging");
    }

    #[test]
    fn a_crop_must_lie_within_the_picture() {
        let mut scene = SceneDescription::default();
        assert!(plan_of("--size 20x10 --crop 0,0,20,11", &mut scene).is_err());
        assert!(plan_of("--size 20x10 --crop 0,0,20,10", &mut scene).is_ok());
    }

    #[test]
    fn what_is_unknown_is_named() {
        let refusal = |words: &str| plan_of(words, &mut SceneDescription::default()).err().map(|f| f.message);
        assert!(refusal("--integrator nonsense").unwrap().contains("no integrator"));
        assert!(refusal("--camera nobody").unwrap().contains("no camera"));
    }
}
