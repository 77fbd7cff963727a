//! `[[object]]`: a shape, what it bounds, its finish, and what it emits.
//!
//! `medium` makes a solid of that medium, `interface = { outside, inside }` a boundary of two; both have a polished
//! dielectric finish unless `material` says otherwise, other objects are matte and grey, emitters black.
//! `emission = { radiance | power, two_sided, visible_to_camera }`; `slots` gives materials to the face groups of a
//! mesh; `transform` places it all. An instance takes over what it does not say itself.

use super::field::Field;
use super::light_power::per_square_unit;
use super::scene::Reader;
use super::table::Table;
use super::transform;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::Transform;
use hyaline_scene::{
    BoundaryDescription, ColorSource, Emission, EmissionQuantity, Located, MaterialKind, ObjectDescription,
    ScalarSource, SceneError, ShapeDescription, Source,
};

/// What a dielectric is that nobody described: polished, without tint.
pub(crate) fn polished() -> MaterialKind {
    let white = || ColorSource::Constant([1.0; 3]);
    MaterialKind::Dielectric { roughness: ScalarSource::Constant(0.0), tint: (white(), white()) }
}

impl Reader<'_> {
    /// Reads an element of `[[object]]`.
    pub(super) fn object(&mut self, mut table: Table<'_>, name: String) -> Result<()> {
        let kind = table.require("kind", "\"sphere\"")?;
        let shape = self.shape(kind, &mut table)?;
        let given = match shape {
            ShapeDescription::Vessel(_) => None,
            _ => boundary(&mut table)?,
        };
        let material = table.take("material").map(|field| self.material(field, &name)).transpose()?;
        let emission = table.read_some("emission", |field| {
            let mut table = field.table("emission")?;
            let emission = self.emission(&mut table, None)?;
            table.finish()?;
            Ok(emission)
        })?;
        let slot_materials = match shape {
            ShapeDescription::Mesh { .. } => self.slots(table.take("slots"), &name)?,
            _ => Vec::new(),
        };
        let placement = table.read("transform", Transform::IDENTITY, |f| transform::read(f, self.metres))?;
        let source = table.source.clone();
        table.finish()?;
        let object = match &shape {
            ShapeDescription::Instance { of } => {
                let original = self.original(of)?.clone();
                ObjectDescription {
                    boundary: given.unwrap_or(original.boundary),
                    material: material.unwrap_or(original.material),
                    slot_materials: original.slot_materials,
                    emission: emission.or(original.emission),
                    name,
                    shape,
                    placement,
                }
            }
            _ => {
                let boundary = given.unwrap_or_default();
                let material = material
                    .unwrap_or_else(|| self.default_material(&shape, &boundary, emission.is_some(), &source));
                ObjectDescription { name, shape, placement, boundary, material, slot_materials, emission }
            }
        };
        self.scene.objects.push(Located::new(object, source));
        Ok(())
    }

    /// The object that an instance repeats.
    fn original(&self, of: &Located<String>) -> Result<&ObjectDescription> {
        let Some(original) = self.scene.objects.iter().find(|object| object.name == of.value) else {
            let error =
                SceneError::at(&of.source, format!("no object before this one is named '{}'", of.value));
            let names = self.scene.objects.iter().map(|object| object.name.as_str());
            let nearest = crate::nearest::nearest(&of.value, names);
            return Err(error.with_remedy(match nearest {
                Some(name) => format!("did you mean '{name}'?"),
                None => "give the original a `name` and put it first".to_owned(),
            }));
        };
        match &original.shape {
            ShapeDescription::Instance { of: first } => {
                let error = SceneError::at(&of.source, format!("'{}' is an instance itself", of.value));
                Err(error.with_remedy(format!("name '{}', which it repeats", first.value)))
            }
            _ => Ok(original),
        }
    }

    fn default_material(
        &mut self,
        shape: &ShapeDescription,
        boundary: &BoundaryDescription,
        is_emitter: bool,
        source: &Source,
    ) -> Located<String> {
        let is_vessel = matches!(shape, ShapeDescription::Vessel(_));
        if is_vessel || *boundary != BoundaryDescription::None {
            self.implicit_material("dielectric", polished(), source)
        } else if is_emitter {
            self.implicit_material("black", MaterialKind::Black, source)
        } else {
            let reflectance = ColorSource::Constant([0.5; 3]);
            self.implicit_material("matte", MaterialKind::Matte { reflectance }, source)
        }
    }

    /// Materials of the face groups of a mesh.
    fn slots(&mut self, field: Option<Field<'_>>, owner: &str) -> Result<Vec<(String, Located<String>)>> {
        let Some(field) = field else { return Ok(Vec::new()) };
        let entries = field.entries()?;
        entries.iter().map(|(field, _)| Ok((field.key.to_owned(), self.material(*field, owner)?))).collect()
    }

    /// What a surface emits; the table is that of an emission or of a light. Absent keys keep what `base` has.
    pub(super) fn emission(&self, table: &mut Table<'_>, base: Option<&Emission>) -> Result<Emission> {
        let (color, quantity) = match (table.take_one(&["radiance", "power"])?, base) {
            (Some(field), _) if field.key == "radiance" => {
                (field.color(Limits::NOT_NEGATIVE)?, EmissionQuantity::Radiance)
            }
            (Some(field), _) => {
                let watts = per_square_unit(field.color(Limits::NOT_NEGATIVE)?, self.metres);
                if !watts.iter().all(|value| value.is_finite()) {
                    return Err(field.error("`power` is too large"));
                }
                (watts, EmissionQuantity::Power)
            }
            (None, Some(base)) => (base.color, base.quantity),
            (None, None) => {
                let error =
                    SceneError::at(table.source, format!("{} needs `radiance` or `power`", table.what));
                let remedy = "add `radiance = [r, g, b]` (W/sr/m²) or `power = [r, g, b]` (W)";
                return Err(error.with_remedy(remedy));
            }
        };
        let (two_sided, visible) =
            base.map_or((false, true), |base| (base.two_sided, base.visible_to_camera));
        Ok(Emission {
            color,
            quantity,
            two_sided: table.read("two_sided", two_sided, |field| field.boolean())?,
            visible_to_camera: table.read("visible_to_camera", visible, |field| field.boolean())?,
            texture: base.and_then(|base| base.texture.clone()),
            medium: base.and_then(|base| base.medium.clone()),
        })
    }
}

/// The media that meet at a surface, where the table says so.
pub(super) fn boundary(table: &mut Table<'_>) -> Result<Option<BoundaryDescription>> {
    let Some(field) = table.take_one(&["medium", "interface"])? else { return Ok(None) };
    if field.key == "medium" {
        return Ok(Some(BoundaryDescription::Solid { medium: field.name()? }));
    }
    let mut table = field.table("interface")?;
    let outside = table.read_some("outside", |field| field.name())?;
    let inside = table.read_some("inside", |field| field.name())?;
    table.finish()?;
    if outside.is_none() && inside.is_none() {
        return Err(
            field.error("an interface needs `outside` or `inside`; what is left out is the world's medium")
        );
    }
    Ok(Some(BoundaryDescription::Interface { outside, inside }))
}
