//! `[[light]]`: lamps, and what surrounds the scene.
//!
//! | kind | keys (defaults) |
//! |---|---|
//! | point | position (0); power or radiant_intensity |
//! | spot | position (0), to or direction, outer_angle (30°, half), inner_angle (0.75 of it), falloff ("smooth", "linear"); power or radiant_intensity |
//! | directional | direction in which the light travels; irradiance |
//! | rectangle, disc, sphere, mesh | the keys of the shape; radiance or power; two_sided (false), visible_to_camera (true), material (black), transform |
//! | environment | radiance (1), image (a texture by name) or file, encoding, transform, visible_to_camera (true) |
//! | ambient | radiance (1) |
//!
//! Lights without a shape also have `medium`, the one they stand in.

use super::field::Field;
use super::light_power::{intensity_from_power, per_square_unit, spot_solid_angle};
use super::scene::Reader;
use super::table::Table;
use super::{texture, transform};
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{
    BoundaryDescription, LightDescription, LightKind, Located, MaterialKind, ObjectDescription, Rgb,
    SceneError, SpotFalloff, TextureDescription, TextureKind,
};

const KINDS: [&str; 9] =
    ["point", "spot", "directional", "rectangle", "disc", "sphere", "mesh", "environment", "ambient"];

impl Reader<'_> {
    /// Reads an element of `[[light]]`.
    pub(super) fn light(&mut self, mut table: Table<'_>, name: String) -> Result<()> {
        let kind = table.require("kind", "\"disc\"")?;
        let light = match kind.string()? {
            "rectangle" | "disc" | "sphere" | "mesh" => return self.area_light(kind, table, name),
            "point" => LightKind::Point {
                position: self.point(&mut table, "position")?,
                intensity: self.intensity(&mut table, 4.0 * std::f64::consts::PI)?,
            },
            "spot" => self.spot(&mut table)?,
            "directional" => LightKind::Directional {
                direction: table.require("direction", "[0, -1, 0]")?.direction()?,
                irradiance: table.require("irradiance", "[3, 3, 3]")?.color(Limits::NOT_NEGATIVE)?,
            },
            "environment" => self.environment(&mut table, &name)?,
            "ambient" => LightKind::Ambient { radiance: table.read("radiance", [1.0; 3], radiance)? },
            _ => return Err(kind.no_such_choice(&KINDS)),
        };
        let medium = table.read_some("medium", |field| field.name())?;
        let source = table.source.clone();
        table.finish()?;
        self.scene.lights.push(Located::new(LightDescription { name, kind: light, medium }, source));
        Ok(())
    }

    fn area_light(&mut self, kind: Field<'_>, mut table: Table<'_>, name: String) -> Result<()> {
        if let Some(object) = self.scene.objects.iter().find(|object| object.name == name) {
            let message =
                format!("a light and an object are named '{name}'; the other is at {}", object.source);
            return Err(SceneError::at(table.source, message).with_remedy("rename one of them"));
        }
        let shape = self.shape(kind, &mut table)?;
        let emission = Some(self.emission(&mut table, None)?);
        let source = table.source.clone();
        let material = match table.take("material") {
            Some(field) => self.material(field, &name)?,
            None => self.implicit_material("black", MaterialKind::Black, &source),
        };
        let placement = table.read("transform", Transform::IDENTITY, |f| transform::read(f, self.metres))?;
        table.finish()?;
        let boundary = BoundaryDescription::None;
        let slot_materials = Vec::new();
        let object =
            ObjectDescription { name, shape, placement, boundary, material, slot_materials, emission };
        self.scene.objects.push(Located::new(object, source));
        Ok(())
    }

    fn spot(&self, table: &mut Table<'_>) -> Result<LightKind> {
        let position = self.point(table, "position")?;
        let direction = match table.take_one(&["to", "direction"])? {
            None => -DVec3::Y,
            Some(field) if field.key == "direction" => field.direction()?,
            Some(field) => {
                let direction = field.point(self.metres)? - position;
                direction.try_normalize().ok_or_else(|| field.error("`to` coincides with `position`"))?
            }
        };
        let outer_angle =
            table.read("outer_angle", 30f64.to_radians(), |f| f.angle(Limits::above_to(0.0, 180.0)))?;
        let inner_angle = table.read("inner_angle", 0.75 * outer_angle, |field| {
            let inner = field.angle(Limits::between(0.0, 180.0))?;
            let error = || field.error("`inner_angle` must not exceed `outer_angle`");
            if inner <= outer_angle { Ok(inner) } else { Err(error()) }
        })?;
        let falloffs = [("smooth", SpotFalloff::Smooth), ("linear", SpotFalloff::LinearInAngle)];
        let falloff = table.read("falloff", SpotFalloff::Smooth, |field| field.choice(&falloffs))?;
        let solid_angle = spot_solid_angle(inner_angle, outer_angle, falloff);
        let intensity = self.intensity(table, solid_angle)?;
        Ok(LightKind::Spot { position, direction, intensity, outer_angle, inner_angle, falloff })
    }

    /// Radiant intensity, as given or from the power of a light that shines into `solid_angle`.
    fn intensity(&self, table: &mut Table<'_>, solid_angle: f64) -> Result<Rgb> {
        let Some(field) = table.take_one(&["power", "radiant_intensity"])? else {
            let error =
                SceneError::at(table.source, format!("{} needs `power` or `radiant_intensity`", table.what));
            return Err(
                error.with_remedy("add `power = [r, g, b]` (W) or `radiant_intensity = [r, g, b]` (W/sr)")
            );
        };
        let color = field.color(Limits::NOT_NEGATIVE)?;
        let intensity = if field.key == "power" { intensity_from_power(color, solid_angle) } else { color };
        let intensity = per_square_unit(intensity, self.metres);
        let is_finite = intensity.iter().all(|value| value.is_finite());
        if is_finite { Ok(intensity) } else { Err(field.error(format!("`{}` is too large", field.key))) }
    }

    fn environment(&mut self, table: &mut Table<'_>, name: &str) -> Result<LightKind> {
        let image = match table.take_one(&["image", "file"])? {
            None => None,
            Some(field) if field.key == "image" => Some(field.name()?),
            Some(field) => {
                let encoding = table.read_some("encoding", texture::encoding)?;
                let image = self.assets.image(field.source(), field.string()?, encoding)?;
                let texture = TextureDescription::new(format!("{name}/image"), TextureKind::Image(image));
                let texture_name = texture.name.clone();
                self.scene.textures.push(Located::new(texture, field.source().clone()));
                Some(Located::new(texture_name, field.source().clone()))
            }
        };
        Ok(LightKind::Environment {
            radiance: table.read("radiance", [1.0; 3], radiance)?,
            image,
            placement: table.read("transform", Transform::IDENTITY, |field| {
                transform::read(field, self.metres).map(|turned| turned.inverse())
            })?,
            visible_to_camera: table.read("visible_to_camera", true, |field| field.boolean())?,
        })
    }
}

fn radiance(field: Field<'_>) -> Result<Rgb> {
    field.color(Limits::NOT_NEGATIVE)
}
