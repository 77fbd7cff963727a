//! `<emitter>`: lights without a shape, and what shapes emit.

use super::element::Element;
use super::importer::Importer;
use super::sensor::camera_placement;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{
    ColorSource, Emission, EmissionQuantity, ImageData, LightDescription, LightKind, Located, Rgb,
    SpotFalloff, TextureDescription, TextureKind,
};
use std::sync::Arc;

/// What says how often a light is sampled, not what it is.
pub(super) const WITHOUT_EFFECT: [&str; 4] = ["sampling_weight", "samples", "mis_compensation", "cache"];

impl Importer<'_> {
    /// Reads an emitter that is not part of a shape.
    pub(super) fn emitter(&mut self, emitter: Element<'_>) -> Result<()> {
        emitter.ignore(&WITHOUT_EFFECT);
        let kind = match emitter.kind() {
            // Described for shapes to refer to.
            "area" => return Ok(()),
            "constant" => Some(LightKind::Environment {
                radiance: scaled(emitter, &["radiance", "intensity"])?,
                image: None,
                placement: Transform::IDENTITY,
                visible_to_camera: true,
            }),
            "envmap" => self.environment(emitter)?,
            "point" => Some(point(emitter)?),
            "spot" => Some(spot(emitter)?),
            "directional" => Some(directional(emitter)?),
            "projector" => Some(self.projector(emitter)?),
            _ => {
                emitter.warn(format!("{} is not supported and left out", emitter.title()));
                emitter.ignore_all();
                None
            }
        };
        let Some(kind) = kind else { return Ok(()) };
        let name = emitter.id().map_or_else(|| emitter.kind().to_owned(), str::to_owned);
        let name = self.names.unique(name);
        let medium = match emitter.child("medium")? {
            Some(medium) => {
                let volume = self.volume(medium, &name)?;
                self.medium_of_volume(volume, emitter.source())
            }
            None => None,
        };
        let light = LightDescription { name, kind, medium };
        self.scene.lights.push(Located::new(light, emitter.source().clone()));
        Ok(())
    }

    /// Mitsuba's image centers on +z and runs towards -x; ours on -z and towards +x: half a turn about y.
    fn environment(&mut self, emitter: Element<'_>) -> Result<Option<LightKind>> {
        let scale = emitter.float("scale", 1.0, Limits::NOT_NEGATIVE)? as f32;
        let to_world = emitter.transform("to_world")?;
        let Some(image) = self.bitmap(emitter)? else {
            emitter.warn("an environment without its image is left out");
            return Ok(None);
        };
        let image = self.image_of(emitter, image);
        let turned = Transform::from_parts(to_world.linear(), DVec3::ZERO);
        let half_turn = Transform::rotate(DVec3::Y, std::f64::consts::PI);
        let (Some(turned), Some(half_turn)) = (turned, half_turn) else {
            return Err(emitter.error("the transform of the environment can't be inverted"));
        };
        Ok(Some(LightKind::Environment {
            radiance: [scale; 3],
            image: Some(image),
            placement: half_turn.after(&turned.inverse()),
            visible_to_camera: true,
        }))
    }

    /// Adds an image that a light takes as it is, without the coordinates of a surface.
    fn image_of(&mut self, emitter: Element<'_>, image: Arc<ImageData>) -> Located<String> {
        let mut name = format!("{}/image", emitter.id().unwrap_or(emitter.kind()));
        while self.scene.textures.iter().any(|texture| texture.name == name) {
            name.push('\'');
        }
        let texture = TextureDescription::new(name.clone(), TextureKind::Image(image));
        self.scene.textures.push(Located::new(texture, emitter.source().clone()));
        Located::new(name, emitter.source().clone())
    }

    /// Mitsuba's value is the radiance that a white matte plane shows: an irradiance π times as large.
    fn projector(&mut self, emitter: Element<'_>) -> Result<LightKind> {
        let (mut color, mut image, mut aspect) = (scaled(emitter, &["irradiance"])?, None, 1.0);
        if let Some(texture) = emitter.child_named("texture", "irradiance")? {
            if texture.kind() == "bitmap" {
                if let Some(pixels) = self.bitmap(texture)? {
                    aspect = f64::from(pixels.width) / f64::from(pixels.height);
                    image = Some(self.image_of(emitter, pixels));
                }
            } else {
                match self.texture(texture)? {
                    ColorSource::Texture(name) => image = Some(name),
                    ColorSource::Constant(grey) => color = std::array::from_fn(|i| color[i] * grey[i]),
                }
            }
        }
        let (fov, axis) = super::sensor::field_of_view(emitter)?;
        Ok(LightKind::Projector {
            placement: camera_placement(emitter, &emitter.transform("to_world")?)?,
            fov: super::sensor::across_width(fov, axis, aspect),
            image,
            irradiance: color.map(|value| value * std::f32::consts::PI),
        })
    }

    /// What a shape with this emitter sends out.
    pub(super) fn area(&mut self, emitter: Element<'_>) -> Result<Option<Emission>> {
        emitter.ignore(&WITHOUT_EFFECT);
        if emitter.kind() != "area" {
            emitter.warn(format!("{} in a shape is not supported and left out", emitter.title()));
            emitter.ignore_all();
            return Ok(None);
        }
        let mut color = scaled(emitter, &["radiance", "intensity"])?;
        let mut texture = None;
        if let Some(element) = emitter.child_named("texture", "radiance")? {
            match self.texture(element)? {
                ColorSource::Texture(name) => texture = Some(name),
                ColorSource::Constant(grey) => color = std::array::from_fn(|i| color[i] * grey[i]),
            }
        }
        Ok(Some(Emission {
            color,
            quantity: EmissionQuantity::Radiance,
            two_sided: false,
            visible_to_camera: true,
            texture,
            medium: None,
        }))
    }
}

fn point(emitter: Element<'_>) -> Result<LightKind> {
    let position = match emitter.point("position")? {
        Some(position) => position,
        None => emitter.transform("to_world")?.translation(),
    };
    Ok(LightKind::Point { position, intensity: scaled(emitter, &["intensity"])? })
}

fn directional(emitter: Element<'_>) -> Result<LightKind> {
    let direction = match emitter.point("direction")? {
        Some(direction) => direction,
        None => emitter.transform("to_world")?.vector(DVec3::Z),
    };
    if direction.try_normalize().is_none() {
        return Err(emitter.error("`direction` must not be zero"));
    }
    Ok(LightKind::Directional { direction, irradiance: scaled(emitter, &["irradiance", "intensity"])? })
}

fn spot(emitter: Element<'_>) -> Result<LightKind> {
    let to_world = emitter.transform("to_world")?;
    let cutoff = emitter.float("cutoff_angle", 20.0, Limits::above_to(0.0, 180.0))?;
    let beam = emitter.float("beam_width", 0.75 * cutoff, Limits::between(0.0, 180.0))?;
    if emitter.child("texture")?.is_some() {
        emitter.warn("the texture of a spot is left out");
    }
    Ok(LightKind::Spot {
        position: to_world.translation(),
        direction: to_world.vector(DVec3::Z),
        intensity: scaled(emitter, &["intensity"])?,
        outer_angle: cutoff.to_radians(),
        inner_angle: beam.min(cutoff).to_radians(),
        falloff: SpotFalloff::LinearInAngle,
    })
}

/// A color by the first of some names that is there, by default 1, times `scale`.
fn scaled(emitter: Element<'_>, names: &[&str]) -> Result<Rgb> {
    let scale = emitter.float("scale", 1.0, Limits::NOT_NEGATIVE)? as f32;
    let mut color = None;
    for name in names {
        color = color.map_or_else(|| emitter.color(name, Limits::NOT_NEGATIVE), |color| Ok(Some(color)))?;
    }
    let color = color.unwrap_or([1.0; 3]).map(|value| value * scale);
    match color.iter().all(|value| value.is_finite()) {
        true => Ok(color),
        false => Err(emitter.error(format!("`{}` is too large", names[0]))),
    }
}
