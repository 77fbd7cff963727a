//! Materials: names become indices, metals become indices of refraction.

use super::faults::Faults;
use super::names::nearest;
use super::{Library, blends, lanes};
use crate::material::{ColorInput, Composition, Finish, Material, ScalarInput};
use crate::relief::Relief;
use hyaline_optics::microfacet::alpha_from_roughness;
use hyaline_scattering::bsdf::{CoatTable, MIN_ALPHA};
use hyaline_scene::{
    ColorSource, Located, MaterialDescription, MaterialKind, Metal, Note, Rgb, ScalarSource, SceneError,
};
use hyaline_spectrum::catalogue;

const MORE_LIGHT: &str = "a surface can't give more light than it gets: keep it within 0…1";

/// Compiles all materials, in order; one that has a fault (a texture, metal or material that is not there, a number that
/// cannot be) is black, so that the others keep their places.
///
/// # Errors
/// A material that is made of itself.
pub(super) fn compile_all(
    library: &Library,
    notes: &mut Vec<Note>,
    faults: &mut Faults,
) -> Result<Vec<Material>, Vec<SceneError>> {
    let stand_in = Material {
        composition: Composition::Single(Finish::Black),
        two_sided: true,
        back: None,
        opacity: ScalarInput::Constant(1.0),
        relief: None,
        straight_shadows: false,
    };
    let described = library.description.materials.iter();
    let materials: Vec<Material> = described
        .map(|m| faults.keep(compile(library, m, notes)).unwrap_or_else(|| stand_in.clone()))
        .collect();
    // Whatever follows blends would run in circles with these.
    blends::check(library, &materials).map_err(|fault| vec![fault])?;
    Ok(materials)
}

fn compile(
    library: &Library,
    description: &Located<MaterialDescription>,
    notes: &mut Vec<Note>,
) -> Result<Material, SceneError> {
    let material = |name: &Located<String>| Ok::<u32, SceneError>(library.materials.find(name)? as u32);
    let composition = match &description.kind {
        MaterialKind::Blend { first, second, weight } => {
            let weight = share(library, description, "weight", weight)?;
            Composition::Blend(material(first)?, material(second)?, weight)
        }
        _ => Composition::Single(finish(library, description)?),
    };
    Ok(Material {
        straight_shadows: description.straight_shadows && can_cast_straight(description, &composition, notes),
        composition,
        two_sided: description.two_sided,
        back: description.back.as_ref().map(material).transpose()?,
        opacity: share(library, description, "opacity", &description.opacity)?,
        relief: description.relief.as_ref().map(|r| relief(library, r)).transpose()?,
    })
}

/// Whether shadow rays may pass the finish straight: a rough one has no straight way, an opaque one none at all.
fn can_cast_straight(
    description: &Located<MaterialDescription>,
    composition: &Composition,
    notes: &mut Vec<Note>,
) -> bool {
    let can = match composition {
        Composition::Single(Finish::Dielectric { roughness, .. }) => {
            matches!(roughness, ScalarInput::Constant(r) if alpha_from_roughness(*r) < MIN_ALPHA)
        }
        Composition::Single(finish) => finish.is_transparent(),
        Composition::Blend(..) => false,
    };
    if !can {
        let message = format!(
            "material '{}' has straight_shadows, which only polished transparent finishes can have: ignored",
            description.name
        );
        notes.push(Note::warning(&description.source, message));
    }
    can
}

/// A number that must lie within 0…1.
fn share(
    library: &Library,
    material: &Located<MaterialDescription>,
    what: &str,
    source: &ScalarSource,
) -> Result<ScalarInput, SceneError> {
    match source {
        ScalarSource::Constant(value) if !(0.0..=1.0).contains(value) => {
            let message = format!("material '{}' has {what} = {value}", material.name);
            Err(SceneError::at(&material.source, message).with_remedy("give a number within 0…1"))
        }
        ScalarSource::Constant(_) | ScalarSource::Texture(_) => scalar_input(library, source),
    }
}

fn relief(library: &Library, description: &hyaline_scene::Relief) -> Result<Relief, SceneError> {
    use hyaline_scene::Relief as Described;
    let texture = |name: &Located<String>| Ok::<u32, SceneError>(library.textures.find(name)? as u32);
    Ok(match description {
        Described::Bump { height, scale } => Relief::Bump { texture: texture(height)?, scale: *scale },
        Described::Normals { texture: name } => Relief::Normals { texture: texture(name)? },
        Described::Slopes { texture: name, scale } => {
            Relief::Slopes { texture: texture(name)?, scale: *scale }
        }
    })
}

/// A finish by itself.
fn finish(library: &Library, description: &Located<MaterialDescription>) -> Result<Finish, SceneError> {
    let color = |source: &ColorSource| color_input(library, description, source);
    let scalar = |source: &ScalarSource| scalar_input(library, source);
    Ok(match &description.kind {
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
        MaterialKind::Plastic { diffuse, specular, ior, roughness, nonlinear } => Finish::Plastic {
            ior: coat_index(description, *ior)?,
            coats: match roughness {
                ScalarSource::Constant(r) => CoatTable::uniform(*ior, alpha_from_roughness(*r)),
                ScalarSource::Texture(_) => CoatTable::varying(*ior),
            },
            roughness: scalar(roughness)?,
            diffuse: color(diffuse)?,
            specular: color(specular)?,
            nonlinear: *nonlinear,
        },
        MaterialKind::PassThrough => Finish::PassThrough,
        MaterialKind::Blend { .. } | MaterialKind::Black => Finish::Black,
    })
}

/// Index of a coat over that of its surroundings.
fn coat_index(material: &Located<MaterialDescription>, ior: f32) -> Result<f32, SceneError> {
    if ior.is_finite() && ior > 0.0 {
        return Ok(ior);
    }
    let message = format!("material '{}' has a coat of index {ior}", material.name);
    Err(SceneError::at(&material.source, message).with_remedy("give a number above 0; lacquer has about 1.5"))
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
