//! Materials: texture names become indices, metals become indices of refraction.

use super::faults::Faults;
use super::names::nearest;
use super::{Library, lanes};
use crate::material::{ColorInput, Finish, Material, ScalarInput};
use hyaline_scene::{
    ColorSource, Located, MaterialDescription, MaterialKind, Metal, Rgb, ScalarSource, SceneError,
};
use hyaline_spectrum::catalogue;

const MORE_LIGHT: &str = "a surface can't give more light than it gets: keep it within 0…1";

/// Compiles all materials, in order; one that has a fault (a texture or metal that is not there, a reflectance outside
/// 0…1) is black, so that the others keep their places.
pub(super) fn compile_all(library: &Library, faults: &mut Faults) -> Vec<Material> {
    let stand_in = Material { finish: Finish::Black, two_sided: true };
    let materials = library.description.materials.iter();
    materials.map(|m| faults.keep(compile(library, m)).unwrap_or(stand_in.clone())).collect()
}

fn compile(library: &Library, description: &Located<MaterialDescription>) -> Result<Material, SceneError> {
    let color = |source: &ColorSource| color_input(library, description, source);
    let scalar = |source: &ScalarSource| scalar_input(library, source);
    let finish = match &description.kind {
        MaterialKind::Matte { reflectance } => Finish::Matte { reflectance: color(reflectance)? },
        MaterialKind::Phong { diffuse, specular, exponent } => {
            if let (ColorSource::Constant(diffuse), ColorSource::Constant(specular)) = (diffuse, specular)
                && diffuse.iter().zip(specular).any(|(d, s)| d + s > 1.0 + f32::EPSILON)
            {
                let message = format!("material '{}' has color + specular above 1", description.name);
                return Err(SceneError::at(&description.source, message).with_remedy(MORE_LIGHT));
            }
            Finish::Phong {
                diffuse: color(diffuse)?,
                specular: color(specular)?,
                exponent: scalar(exponent)?,
            }
        }
        MaterialKind::PerfectSpecular { reflectance } => {
            Finish::PerfectSpecular { reflectance: color(reflectance)? }
        }
        MaterialKind::Conductor { metal, roughness, tint } => {
            let (eta, k) = metal_indices(metal)?;
            let (eta, k) = (lanes(eta), lanes(k));
            Finish::Conductor { eta, k, roughness: scalar(roughness)?, tint: color(tint)? }
        }
        MaterialKind::GlossySpecular { reflectance, exponent } => {
            Finish::GlossySpecular { reflectance: color(reflectance)?, exponent: scalar(exponent)? }
        }
        MaterialKind::SimpleTransparent { k_r, k_t, phong } => {
            let is_fraction = |k: f32| (0.0..=1.0).contains(&k);
            if !(is_fraction(*k_r) && is_fraction(*k_t) && k_r + k_t <= 1.0 + f32::EPSILON) {
                let message = format!("material '{}' has k_r = {k_r} and k_t = {k_t}", description.name);
                return Err(SceneError::at(&description.source, message).with_remedy(MORE_LIGHT));
            }
            let phong =
                phong.map(|(diffuse, specular, exponent)| (lanes(diffuse), lanes(specular), exponent));
            Finish::SimpleTransparent { k_r: *k_r, k_t: *k_t, phong }
        }
        MaterialKind::Dielectric { roughness, tint: (reflected, transmitted) } => Finish::Dielectric {
            roughness: scalar(roughness)?,
            reflected: color(reflected)?,
            transmitted: color(transmitted)?,
        },
        MaterialKind::ThinDielectric { ior, tint } => {
            Finish::ThinDielectric { ior: *ior, tint: color(tint)? }
        }
        MaterialKind::Plastic { .. } | MaterialKind::Blend { .. } => {
            let message = format!("material '{}' can't be rendered yet", description.name);
            return Err(SceneError::at(&description.source, message).with_remedy("use another kind"));
        }
        MaterialKind::PassThrough => Finish::PassThrough,
        MaterialKind::Black => Finish::Black,
    };
    Ok(Material { finish, two_sided: description.two_sided })
}

fn color_input(
    library: &Library,
    material: &Located<MaterialDescription>,
    source: &ColorSource,
) -> Result<ColorInput, SceneError> {
    match source {
        ColorSource::Texture(name) => Ok(ColorInput::Texture(library.textures.find(name)? as u32)),
        ColorSource::Constant(color) if color.iter().all(|c| (0.0..=1.0).contains(c)) => {
            Ok(ColorInput::Constant(lanes(*color)))
        }
        ColorSource::Constant(color) => {
            let message = format!("material '{}' has a color of {color:?}", material.name);
            Err(SceneError::at(&material.source, message).with_remedy(MORE_LIGHT))
        }
    }
}

fn scalar_input(library: &Library, source: &ScalarSource) -> Result<ScalarInput, SceneError> {
    Ok(match source {
        ScalarSource::Constant(value) => ScalarInput::Constant(*value),
        ScalarSource::Texture(name) => ScalarInput::Texture(library.textures.find(name)? as u32),
    })
}

fn metal_indices(metal: &Metal) -> Result<(Rgb, Rgb), SceneError> {
    match metal {
        Metal::Indices { eta, k } => Ok((*eta, *k)),
        Metal::Named(name) => match catalogue::conductor_by_name(name) {
            Some(conductor) => Ok((conductor.eta, conductor.k)),
            None => {
                let error = SceneError::at(&name.source, format!("no metal is named '{}'", name.value));
                Err(match nearest(name, catalogue::conductor_names()) {
                    Some(candidate) => error.with_remedy(format!("did you mean '{candidate}'?")),
                    None => error,
                })
            }
        },
    }
}
