//! Objects: their surfaces become items of the geometry, their boundaries entries of a table, what shines a light.

use super::faults::Faults;
use super::shapes::{self, Meshes, Surface};
use super::{Library, lanes};
use crate::light::{Light, MeshLight, ShapeLight, ShiningSides};
use crate::material::Material;
use crate::world::{ItemInfo, mask};
use hyaline_geometry::mesh::MeshSampler;
use hyaline_geometry::{Item, ItemGeometry};
use hyaline_math::Bounds;
use hyaline_scattering::{BoundaryKind, MediumId, ObjectId};
use hyaline_scene::{
    BoundaryDescription, Emission, EmissionQuantity, Located, Note, ObjectDescription, SceneError,
    ShapeDescription, VesselDescription,
};
use hyaline_spectrum::Spectrum;
use std::f64::consts::PI;

/// All objects, compiled; `geometry`, `items` and `pieces` go together, and so do the lists by object id.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) geometry: Vec<Item>,
    pub(super) items: Vec<ItemInfo>,
    /// Which part of a compound each item belongs to.
    pub(super) pieces: Vec<u32>,
    pub(super) names: Vec<String>,
    pub(super) object_materials: Vec<u32>,
    pub(super) boundaries: Vec<BoundaryKind>,
    pub(super) lights: Vec<Light>,
}

impl Parts {
    /// The smallest box about everything.
    pub(super) fn bounds(&self) -> Bounds {
        self.geometry.iter().fold(Bounds::EMPTY, |bounds, item| bounds.union(item.geometry.bounds()))
    }

    /// Adds an object without surfaces as yet; its id counts in ties of priority.
    fn add_object(&mut self, name: String, boundary: BoundaryKind, material: u32) -> ObjectId {
        self.names.push(name);
        self.object_materials.push(material);
        self.boundaries.push(boundary);
        ObjectId(self.names.len() as u32 - 1)
    }

    fn add_surface(
        &mut self,
        object: ObjectId,
        piece: u32,
        surface: Surface,
        slot_materials: Vec<u32>,
        emission: Option<Radiating>,
    ) {
        let mut visible = mask::CAMERA | mask::PATH | mask::BLOCKS;
        let mut light = None;
        if let Some(emission) = emission {
            if !emission.visible_to_camera {
                visible &= !mask::CAMERA;
            }
            light = Some(self.lights.len() as u32);
            self.lights.push(emission.light(&surface));
        }
        let material = self.object_materials[object.0 as usize];
        self.pieces.push(piece);
        self.items.push(ItemInfo { object, material, slot_materials, light, may_coincide: false });
        let geometry = match surface {
            Surface::Shape(primitive) => ItemGeometry::Shape(primitive),
            Surface::Mesh { mesh, transform } => ItemGeometry::Mesh { mesh, transform },
        };
        self.geometry.push(Item { geometry, mask: visible });
    }
}

/// Compiles all objects, in order; one that has a fault (a name that nothing bears, a shape that cannot be) is left out.
pub(super) fn compile_all(
    library: &Library,
    materials: &[Material],
    notes: &mut Vec<Note>,
    faults: &mut Faults,
) -> Parts {
    let mut parts = Parts::default();
    let mut meshes = Meshes::new(library.description);
    for object in &library.description.objects {
        faults.keep(compile(library, materials, object, &mut meshes, &mut parts, notes));
    }
    parts
}

fn compile(
    library: &Library,
    materials: &[Material],
    object: &Located<ObjectDescription>,
    meshes: &mut Meshes,
    parts: &mut Parts,
    notes: &mut Vec<Note>,
) -> Result<(), SceneError> {
    let material = library.materials.find(&object.material)? as u32;
    let shape = shapes::resolve_instance(library, object)?;
    if let ShapeDescription::Vessel(vessel) = shape {
        return add_vessel(library, object, vessel, material, parts, notes);
    }
    let boundary = boundary(library, &object.boundary)?;
    let surfaces = shapes::compile(object, shape, &object.placement, meshes, notes)?;
    let slot_materials = slot_materials(library, object, shape, material)?;
    let emission = object.emission.as_ref().map(|emission| {
        let area: f64 = surfaces.iter().map(|(surface, _)| surface.area()).sum();
        Radiating::new(emission, area)
    });
    warn_without_media(object, &materials[material as usize], &boundary, notes);
    if matches!(boundary, BoundaryKind::Solid { .. }) && shapes::is_open(shape) {
        let message = format!(
            "object '{}' is a body of a medium, but its shape is open: paths lose track of where they are; close it, or make it an `interface`",
            object.name
        );
        notes.push(Note::warning(&object.source, message));
    }
    let id = parts.add_object(object.name.clone(), boundary, material);
    for (surface, piece) in surfaces {
        parts.add_surface(id, piece, surface, slot_materials.clone(), emission);
    }
    Ok(())
}

fn boundary(library: &Library, description: &BoundaryDescription) -> Result<BoundaryKind, SceneError> {
    let surrounding = library.surrounding()?;
    Ok(match description {
        BoundaryDescription::None => BoundaryKind::None,
        BoundaryDescription::Solid { medium } => {
            let index = library.media.find(medium)?;
            let priority = library.description.media[index].priority;
            BoundaryKind::Solid { medium: MediumId(index as u32 + 1), priority }
        }
        BoundaryDescription::Interface { outside, inside } => BoundaryKind::Interface {
            outside: library.medium_or(outside, surrounding)?,
            inside: library.medium_or(inside, surrounding)?,
        },
    })
}

/// A finish that refracts needs two media to refract between.
fn warn_without_media(
    object: &Located<ObjectDescription>,
    material: &Material,
    boundary: &BoundaryKind,
    notes: &mut Vec<Note>,
) {
    if material.needs_media() && matches!(boundary, BoundaryKind::None) {
        let message = format!(
            "object '{}' has a transparent finish but no medium: it bends no light; give it `medium = \"...\"`",
            object.name
        );
        notes.push(Note::warning(&object.source, message));
    }
}

/// Material of each slot of a mesh, where the slots have materials of their own.
fn slot_materials(
    library: &Library,
    object: &ObjectDescription,
    shape: &ShapeDescription,
    default: u32,
) -> Result<Vec<u32>, SceneError> {
    let ShapeDescription::Mesh { mesh, .. } = shape else { return Ok(Vec::new()) };
    if object.slot_materials.is_empty() {
        return Ok(Vec::new());
    }
    let material_of = |slot: &String| match object.slot_materials.iter().find(|(name, _)| name == slot) {
        Some((_, material)) => Ok(library.materials.find(material)? as u32),
        None => Ok(default),
    };
    mesh.slots.iter().map(material_of).collect()
}

/// Adds the solids of a vessel: liquids first, the lowest of them last, then the glass, so that ties of priority go to
/// the glass and then to the lower liquid.
fn add_vessel(
    library: &Library,
    object: &Located<ObjectDescription>,
    vessel: &VesselDescription,
    material: u32,
    parts: &mut Parts,
    notes: &mut Vec<Note>,
) -> Result<(), SceneError> {
    if object.emission.is_some() {
        let error = SceneError::at(&object.source, format!("object '{}': a vessel can't shine", object.name));
        return Err(error.with_remedy("put a lamp of its own into it"));
    }
    let built = shapes::vessel(object, vessel)?;
    let glass = library.media.find(&vessel.medium)?;
    let glass_priority = library.description.media[glass].priority;
    let fill: Vec<usize> =
        vessel.fill.iter().map(|l| library.media.find(&l.medium)).collect::<Result<_, _>>()?;
    // Glass must win in the overlap, and the liquids must rank alike, or the layers would eat into each other.
    let lowest = fill.iter().map(|&medium| library.description.media[medium].priority).min();
    let liquid_priority = lowest.map_or(glass_priority, |p| p.min(glass_priority.saturating_sub(1)));
    if fill.iter().any(|&medium| library.description.media[medium].priority >= glass_priority.max(1)) {
        let message = format!(
            "object '{}': a liquid has the priority of the glass or a higher one; the glass wins all the same",
            object.name
        );
        notes.push(Note::warning(&object.source, message));
    }
    for (layer, (&medium, primitives)) in fill.iter().zip(built.liquids).enumerate().rev() {
        let boundary = BoundaryKind::Solid { medium: MediumId(medium as u32 + 1), priority: liquid_priority };
        let name = format!("{}: {}", object.name, vessel.fill[layer].medium.value);
        let id = parts.add_object(name, boundary, material);
        for primitive in primitives {
            parts.add_surface(id, 0, Surface::Shape(primitive), Vec::new(), None);
        }
    }
    let boundary = BoundaryKind::Solid { medium: MediumId(glass as u32 + 1), priority: glass_priority };
    let id = parts.add_object(object.name.clone(), boundary, material);
    for primitive in built.glass {
        parts.add_surface(id, 0, Surface::Shape(primitive), Vec::new(), None);
    }
    Ok(())
}

/// An emission as radiance.
#[derive(Clone, Copy)]
struct Radiating {
    radiance: Spectrum,
    sides: ShiningSides,
    visible_to_camera: bool,
}

impl Radiating {
    /// - `area`: of all surfaces of the object together, which share its power evenly.
    fn new(emission: &Emission, area: f64) -> Self {
        let color = lanes(emission.color);
        let side_count = if emission.two_sided { 2.0 } else { 1.0 };
        let radiance = match emission.quantity {
            EmissionQuantity::Radiance => color,
            // A Lambertian emitter sends out π times its radiance per unit of area and side.
            EmissionQuantity::Power => color * (1.0 / (PI * area * side_count)) as f32,
        };
        let sides = if emission.two_sided { ShiningSides::Both } else { ShiningSides::Outer };
        Self { radiance, sides, visible_to_camera: emission.visible_to_camera }
    }

    fn light(&self, surface: &Surface) -> Light {
        match surface {
            Surface::Shape(primitive) => Light::Shape(ShapeLight::new(*primitive, self.radiance, self.sides)),
            Surface::Mesh { mesh, transform } => Light::Mesh(MeshLight::new(
                MeshSampler::new(mesh.clone(), *transform),
                self.radiance,
                self.sides,
            )),
        }
    }
}
