//! `<emitter>`: lights without a shape, and what shapes emit.

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{
    Emission, EmissionQuantity, LightDescription, LightKind, Located, Rgb, SpotFalloff, TextureDescription,
    TextureKind,
};

impl Importer<'_> {
    /// Reads an emitter that is not part of a shape.
    pub(super) fn emitter(&mut self, emitter: Element<'_>) -> Result<()> {
        emitter.ignore(&["sampling_weight", "samples"]);
        let kind = match emitter.kind() {
            "constant" => LightKind::Environment {
                radiance: scaled(emitter, "radiance")?,
                image: None,
                placement: Transform::IDENTITY,
                visible_to_camera: true,
            },
            "envmap" => match self.environment(emitter)? {
                Some(kind) => kind,
                None => return Ok(()),
            },
            "point" => {
                let position = match emitter.point("position")? {
                    Some(position) => position,
                    None => emitter.transform("to_world")?.translation(),
                };
                LightKind::Point { position, intensity: scaled(emitter, "intensity")? }
            }
            "spot" => spot(emitter)?,
            "directional" => {
                let direction = match emitter.point("direction")? {
                    Some(direction) => direction,
                    None => emitter.transform("to_world")?.vector(DVec3::Z),
                };
                if direction.try_normalize().is_none() {
                    return Err(emitter.error("`direction` must not be zero"));
                }
                LightKind::Directional { direction, irradiance: scaled(emitter, "irradiance")? }
            }
            _ => {
                emitter.warn(format!("{} is not supported and left out", emitter.title()));
                emitter.ignore_all();
                return Ok(());
            }
        };
        let name = emitter.id().map_or_else(|| emitter.kind().to_owned(), str::to_owned);
        let name = self.object_name(name);
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
        emitter.ignore(&["mis_compensation"]);
        let Some(image) = self.bitmap(emitter)? else {
            emitter.warn("an environment without its image is left out");
            return Ok(None);
        };
        let name = self.object_name(emitter.id().unwrap_or("envmap").to_owned()) + "/image";
        let texture = TextureDescription::new(name.clone(), TextureKind::Image(image));
        self.scene.textures.push(Located::new(texture, emitter.source().clone()));
        let turned = Transform::from_parts(to_world.linear(), DVec3::ZERO);
        let half_turn = Transform::rotate(DVec3::Y, std::f64::consts::PI);
        let (Some(turned), Some(half_turn)) = (turned, half_turn) else {
            return Err(emitter.error("the transform of the environment can't be inverted"));
        };
        Ok(Some(LightKind::Environment {
            radiance: [scale; 3],
            image: Some(Located::new(name, emitter.source().clone())),
            placement: half_turn.after(&turned.inverse()),
            visible_to_camera: true,
        }))
    }
}

/// What a shape with this emitter sends out.
pub(super) fn area(emitter: Element<'_>) -> Result<Option<Emission>> {
    emitter.ignore(&["sampling_weight", "samples"]);
    if emitter.kind() != "area" {
        emitter.warn(format!("{} in a shape is not supported and left out", emitter.title()));
        emitter.ignore_all();
        return Ok(None);
    }
    if emitter.child_named("texture", "radiance")?.is_some() {
        emitter.warn("a texture of radiance is replaced by 1");
    }
    Ok(Some(Emission {
        color: scaled(emitter, "radiance")?,
        quantity: EmissionQuantity::Radiance,
        two_sided: false,
        visible_to_camera: true,
        texture: None,
        medium: None,
    }))
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
        intensity: scaled(emitter, "intensity")?,
        outer_angle: cutoff.to_radians(),
        inner_angle: beam.min(cutoff).to_radians(),
        falloff: SpotFalloff::LinearInAngle,
    })
}

/// A color, by default 1, times `scale`.
fn scaled(emitter: Element<'_>, name: &str) -> Result<Rgb> {
    let scale = emitter.float("scale", 1.0, Limits::NOT_NEGATIVE)? as f32;
    let color = emitter.color(name, Limits::NOT_NEGATIVE)?.unwrap_or([1.0; 3]).map(|value| value * scale);
    match color.iter().all(|value| value.is_finite()) {
        true => Ok(color),
        false => Err(emitter.error(format!("`{name}` is too large"))),
    }
}
