//! Lights without a shape.

use super::{Library, RGB_LANES, lanes};
use crate::light::{
    DirectionalLight, EnvironmentLight, Light, PointLight, ProjectorLight, SceneSphere, SkyImage, Slide,
    SpotLight,
};
use crate::texture::Texture;
use hyaline_math::{Bounds, DVec3};
use hyaline_scene::{ImageData, LightDescription, LightKind, Located, SceneError};
use hyaline_spectrum::Spectrum;

/// Lights without a shape, compiled.
pub(super) struct Shapeless {
    pub(super) lights: Vec<Light>,
    /// Indices of the surroundings that camera rays see.
    pub(super) camera_sky: Vec<u32>,
    /// Sum of the ambient terms.
    pub(super) ambient: Spectrum,
}

/// Compiles all lights without a shape.
///
/// - `bounds`: of everything that can be lit; `shaped_lights`: number of lights that come before these.
///
/// # Errors
/// A direction without length, an environment image that is not there.
pub(super) fn compile_all(
    library: &Library,
    textures: &[Texture],
    bounds: Bounds,
    shaped_lights: usize,
) -> Result<Shapeless, SceneError> {
    let mut result = Shapeless { lights: Vec::new(), camera_sky: Vec::new(), ambient: Spectrum::ZERO };
    let scene = SceneSphere::from_bounds(&bounds);
    for light in &library.description.lights {
        if let LightKind::Ambient { radiance } = light.kind {
            result.ambient += lanes(radiance);
            continue;
        }
        let index = (shaped_lights + result.lights.len()) as u32;
        let compiled = compile(library, textures, scene, light, index, &mut result.camera_sky)?;
        result.lights.push(compiled);
    }
    Ok(result)
}

fn compile(
    library: &Library,
    textures: &[Texture],
    scene: SceneSphere,
    light: &Located<LightDescription>,
    index: u32,
    camera_sky: &mut Vec<u32>,
) -> Result<Light, SceneError> {
    let unit = |direction: DVec3| {
        direction.try_normalize().map(|d| d.as_vec3()).ok_or_else(|| {
            let message = format!("light '{}' has a direction without length", light.name);
            SceneError::at(&light.source, message).with_remedy("aim it at a point other than its own place")
        })
    };
    Ok(match &light.kind {
        LightKind::Point { position, intensity } => {
            Light::Point(PointLight { position: position.as_vec3(), intensity: lanes(*intensity) })
        }
        LightKind::Spot { position, direction, intensity, outer_angle, inner_angle, falloff } => {
            Light::Spot(SpotLight::new(
                position.as_vec3(),
                unit(*direction)?,
                lanes(*intensity),
                *outer_angle as f32,
                *inner_angle as f32,
                *falloff,
            ))
        }
        LightKind::Directional { direction, irradiance } => {
            let (direction, irradiance) = (unit(*direction)?, lanes(*irradiance));
            Light::Directional(DirectionalLight { direction, irradiance, scene })
        }
        LightKind::Environment { radiance, image, placement, visible_to_camera } => {
            if *visible_to_camera {
                camera_sky.push(index);
            }
            Light::Environment(match image {
                None => EnvironmentLight::from_constant(lanes(*radiance), scene),
                Some(name) => {
                    let image = sky_image(library, textures, name, lanes(*radiance))?;
                    EnvironmentLight::from_image(image, placement, RGB_LANES, scene)
                }
            })
        }
        LightKind::Projector { placement, fov, image, irradiance } => {
            let slide = image.as_ref().map(|name| slide(library, textures, name)).transpose()?;
            Light::Projector(ProjectorLight::new(placement, *fov as f32, lanes(*irradiance), slide))
        }
        LightKind::Ambient { .. } => unreachable!("ambient terms are summed, not compiled"),
    })
}

fn sky_image(
    library: &Library,
    textures: &[Texture],
    name: &Located<String>,
    factor: Spectrum,
) -> Result<SkyImage, SceneError> {
    image_from(library, textures, name, "sky", |image| {
        let pixels = image.pixels.iter().map(|&color| lanes(color) * factor).collect();
        SkyImage::new(image.width, image.height, pixels)
    })
}

fn slide(library: &Library, textures: &[Texture], name: &Located<String>) -> Result<Slide, SceneError> {
    image_from(library, textures, name, "slide", |image| {
        let pixels = image.pixels.iter().map(|&color| lanes(color)).collect();
        Slide::new(image.width, image.height, pixels, RGB_LANES)
    })
}

/// What `make` makes of the image of a texture.
///
/// - `use_of`: what messages call it.
fn image_from<T>(
    library: &Library,
    textures: &[Texture],
    name: &Located<String>,
    use_of: &str,
    make: impl FnOnce(&ImageData) -> Option<T>,
) -> Result<T, SceneError> {
    let texture = &textures[library.textures.find(name)?];
    texture.image().and_then(|image| make(image)).ok_or_else(|| {
        let message = format!("texture '{}' is no image, so it can't be a {use_of}", name.value);
        SceneError::at(&name.source, message).with_remedy("name a texture that has a file")
    })
}
