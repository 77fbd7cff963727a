//! Shapes: from the words of a description to surfaces placed in the world.

use super::{Library, orientation};
use hyaline_geometry::bvh::MeshBvh;
use hyaline_geometry::mesh::{self, Mesh, Shading, generate};
use hyaline_geometry::shape::compose::{self, Ends};
use hyaline_geometry::shape::{Profile, Rectangle, RevolvedSegment, ShapeError, Sphere, WHOLE_TURN};
use hyaline_geometry::vessel::{FillSpec, Level, Rim, Vessel, VesselSpec};
use hyaline_geometry::{Primitive, Shape};
use hyaline_math::{DVec3, Transform, Vec2, Vec3};
use hyaline_scene::{
    BoundaryDescription, GeneratedForm, Located, MeshData, Note, ObjectDescription, ProfileCurve, RimKind,
    SceneDescription, SceneError, ShapeDescription, ShapePart, VesselDescription, VesselProfile,
};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Instances that refer to instances, at most.
const DEEPEST_INSTANCE: usize = 16;

/// One surface in the world.
pub(super) enum Surface {
    /// Solved exactly.
    Shape(Primitive),
    /// Triangles; `transform` is absent where they are in world space.
    Mesh { mesh: Arc<MeshBvh>, transform: Option<Transform> },
}

impl Surface {
    /// Area in the world.
    pub(super) fn area(&self) -> f64 {
        match self {
            Surface::Shape(primitive) => primitive.area(),
            Surface::Mesh { mesh, transform } => mesh::MeshSampler::new(mesh.clone(), *transform).area(),
        }
    }
}

/// The shape that an object has: its own, or that of the object it repeats.
///
/// # Errors
/// The object repeated is not there, or instances repeat each other in a circle.
pub(super) fn resolve_instance<'a>(
    library: &Library<'a>,
    object: &'a Located<ObjectDescription>,
) -> Result<&'a ShapeDescription, SceneError> {
    let mut shape = &object.shape;
    for _ in 0..DEEPEST_INSTANCE {
        let ShapeDescription::Instance { of } = shape else { return Ok(shape) };
        shape = &library.description.objects[library.objects.find(of)?].shape;
    }
    let message = format!("object '{}' repeats an object that repeats it in turn", object.name);
    Err(SceneError::at(&object.source, message)
        .with_remedy("let instances name an object with a shape of its own"))
}

/// Meshes with their hierarchies, built once for all objects that share them.
pub(super) struct Meshes {
    /// How many objects have a mesh, by its address in the description.
    uses: HashMap<*const MeshData, usize>,
    /// By address, whether normals are ignored, and whether it is of a body, which may have turned it.
    shared: HashMap<(*const MeshData, bool, bool), Arc<MeshBvh>>,
}

impl Meshes {
    pub(super) fn new(description: &SceneDescription) -> Self {
        let mut uses: HashMap<_, usize> = HashMap::new();
        let names: HashMap<&str, &ShapeDescription> =
            description.objects.iter().map(|o| (o.name.as_str(), &o.shape)).collect();
        for object in &description.objects {
            let mut shape = &object.shape;
            for _ in 0..DEEPEST_INSTANCE {
                let ShapeDescription::Instance { of } = shape else { break };
                let Some(next) = names.get(of.as_str()) else { break };
                shape = next;
            }
            count_meshes(shape, &mut uses);
        }
        Self { uses, shared: HashMap::new() }
    }

    /// A mesh placed in the world: moved there if nobody shares it, else with its transform.
    fn surface(
        &mut self,
        object: &Located<ObjectDescription>,
        data: &Arc<MeshData>,
        flat: bool,
        placement: &Transform,
        notes: &mut Vec<Note>,
    ) -> Result<Surface, SceneError> {
        let key = Arc::as_ptr(data);
        if self.uses.get(&key).copied().unwrap_or(1) <= 1 {
            let mesh = build(object, moved(taken(data), placement), flat, notes)?;
            return Ok(Surface::Mesh { mesh, transform: None });
        }
        let key = (key, flat, matches!(object.boundary, BoundaryDescription::Solid { .. }));
        let mesh = match self.shared.get(&key) {
            Some(mesh) => mesh.clone(),
            None => {
                let mesh = build(object, taken(data), flat, notes)?;
                self.shared.insert(key, mesh.clone());
                mesh
            }
        };
        Ok(Surface::Mesh { mesh, transform: Some(*placement) })
    }
}

fn count_meshes(shape: &ShapeDescription, uses: &mut HashMap<*const MeshData, usize>) {
    match shape {
        ShapeDescription::Mesh { mesh, .. } => *uses.entry(Arc::as_ptr(mesh)).or_default() += 1,
        ShapeDescription::Compound { parts } => parts.iter().for_each(|part| count_meshes(&part.shape, uses)),
        _ => {}
    }
}

/// The data of a file as geometry takes it.
fn taken(data: &MeshData) -> mesh::MeshData {
    mesh::MeshData {
        positions: data.positions.iter().map(|&p| Vec3::from(p)).collect(),
        normals: (!data.normals.is_empty()).then(|| data.normals.iter().map(|&n| Vec3::from(n)).collect()),
        uvs: (!data.uvs.is_empty()).then(|| data.uvs.iter().map(|&uv| Vec2::from(uv)).collect()),
        triangles: data.triangles.clone(),
        face_slots: (!data.face_slots.is_empty()).then(|| data.face_slots.clone()),
        shading: Shading::Smooth,
    }
}

/// A mesh after `placement`; a mirror turns the winding, so that the outside stays outside.
fn moved(mut data: mesh::MeshData, placement: &Transform) -> mesh::MeshData {
    if *placement == Transform::IDENTITY {
        return data;
    }
    for p in &mut data.positions {
        *p = placement.point(p.as_dvec3()).as_vec3();
    }
    for n in data.normals.iter_mut().flatten() {
        *n = placement.normal(n.as_dvec3()).normalize_or_zero().as_vec3();
    }
    if placement.is_mirroring() {
        data.triangles.iter_mut().for_each(|face| face.swap(1, 2));
    }
    data
}

fn build(
    object: &Located<ObjectDescription>,
    mut data: mesh::MeshData,
    flat: bool,
    notes: &mut Vec<Note>,
) -> Result<Arc<MeshBvh>, SceneError> {
    data.shading = if flat { Shading::Flat } else { Shading::Smooth };
    let mesh = Mesh::new(data).map_err(|error| {
        SceneError::at(&object.source, format!("mesh of object '{}': {error}", object.name))
    })?;
    if mesh.dropped_faces() > 0 {
        let message = format!(
            "mesh of object '{}': {} faces without area were dropped",
            object.name,
            mesh.dropped_faces()
        );
        notes.push(Note::info(&object.source, message));
    }
    Ok(Arc::new(MeshBvh::new(orientation::settle(object, mesh, notes))))
}

/// The surfaces of a shape, each with the number of the part of a compound that it belongs to.
///
/// - `shape`: no vessel, no instance.
/// - `placement`: object space to world.
///
/// # Errors
/// Numbers out of range, profiles that cross themselves, meshes that can't be.
pub(super) fn compile(
    object: &Located<ObjectDescription>,
    shape: &ShapeDescription,
    placement: &Transform,
    meshes: &mut Meshes,
    notes: &mut Vec<Note>,
) -> Result<Vec<(Surface, u32)>, SceneError> {
    let ShapeDescription::Compound { parts } = shape else {
        let surfaces = compile_one(object, shape, placement, meshes, notes)?;
        return Ok(surfaces.into_iter().map(|surface| (surface, 0)).collect());
    };
    let mut surfaces: Vec<(Surface, u32)> = Vec::new();
    for ShapePart { shape, placement: inner } in parts {
        let next = surfaces.last().map_or(0, |(_, piece)| piece + 1);
        let part = compile(object, shape, &placement.after(inner), meshes, notes)?;
        surfaces.extend(part.into_iter().map(|(surface, piece)| (surface, next + piece)));
    }
    Ok(surfaces)
}

/// The surfaces of a shape that is no compound.
fn compile_one(
    object: &Located<ObjectDescription>,
    shape: &ShapeDescription,
    placement: &Transform,
    meshes: &mut Meshes,
    notes: &mut Vec<Note>,
) -> Result<Vec<Surface>, SceneError> {
    match shape {
        ShapeDescription::Mesh { mesh, flat } => {
            Ok(vec![meshes.surface(object, mesh, *flat, placement, notes)?])
        }
        ShapeDescription::Generated { form, triangles } => {
            let data = moved(generated(*form, *triangles as usize), placement);
            Ok(vec![Surface::Mesh { mesh: build(object, data, false, notes)?, transform: None }])
        }
        ShapeDescription::Vessel(_) | ShapeDescription::Instance { .. } => {
            let message = format!("object '{}': a compound can't hold a vessel or an instance", object.name);
            Err(SceneError::at(&object.source, message).with_remedy("make it an object of its own"))
        }
        _ => {
            let primitives = primitives(shape).map_err(|error| fault(object, &error))?;
            Ok(placed(primitives, placement).into_iter().map(Surface::Shape).collect())
        }
    }
}

/// Size of generated meshes: of the order of one scene unit.
fn generated(form: GeneratedForm, triangles: usize) -> mesh::MeshData {
    match form {
        GeneratedForm::Knot => generate::torus_knot(Vec3::ZERO, 1.0, triangles, 0.03),
        GeneratedForm::Ball => generate::displaced_sphere(Vec3::ZERO, 1.0, triangles, 0.05),
        GeneratedForm::Shells => generate::hollow_balls(Vec3::ZERO, 1.0, 27, triangles),
    }
}

/// The exact shapes, in object space.
fn primitives(shape: &ShapeDescription) -> Result<Vec<Primitive>, ShapeError> {
    let ends = |capped: bool| if capped { Ends::Capped } else { Ends::Open };
    match shape {
        ShapeDescription::Sphere { center, radius, phi, theta } => {
            let sphere = Primitive::new(Shape::Sphere(Sphere::part(*radius, *phi, *theta)?));
            Ok(placed(vec![sphere], &Transform::translate(*center)))
        }
        ShapeDescription::Disc { center, normal, radius, inner_radius } => {
            let disc = RevolvedSegment::disc(*radius, *inner_radius, 0.0, WHOLE_TURN)?;
            let placement = Transform::from_y_axis(*center, *normal, DVec3::Z).ok_or_else(|| {
                ShapeError::out_of_range("length of a disc's normal", 0.0, "give it a direction")
            })?;
            Ok(placed(vec![Primitive::new(Shape::Segment(disc))], &placement))
        }
        ShapeDescription::Rectangle { center, half_u, half_v } => {
            Ok(vec![Primitive::new(Shape::Rectangle(Rectangle::new(*center, *half_u, *half_v)?))])
        }
        ShapeDescription::Box { min, max, radius } => compose::rounded_cuboid(*min, *max, *radius),
        ShapeDescription::Cylinder { radius, y, phi, capped } => {
            if *capped {
                return compose::cylinder(*radius, *y, Ends::Capped);
            }
            let wall = RevolvedSegment::cylinder(*radius, [y[0].min(y[1]), y[0].max(y[1])], *phi)?;
            Ok(vec![Primitive::new(Shape::Segment(wall))])
        }
        ShapeDescription::Cone { radius, height, capped } => compose::cone(*radius, *height, ends(*capped)),
        ShapeDescription::Torus { major_radius, minor_radius, phi, theta } => {
            compose::torus(*major_radius, *minor_radius, *theta, *phi)
        }
        ShapeDescription::Revolution { profile, curve } => {
            compose::revolution(&joined(profile, *curve)?, WHOLE_TURN, Ends::Open)
        }
        ShapeDescription::Mesh { .. }
        | ShapeDescription::Generated { .. }
        | ShapeDescription::Compound { .. }
        | ShapeDescription::Instance { .. }
        | ShapeDescription::Vessel(_) => Ok(Vec::new()),
    }
}

/// Whether a shape that is no mesh surely has no inside.
pub(crate) fn is_open(shape: &ShapeDescription) -> bool {
    let is_part = |range: &[f64; 2], whole: f64| range[1] - range[0] < whole * (1.0 - 1e-9);
    match shape {
        ShapeDescription::Disc { .. } | ShapeDescription::Rectangle { .. } => true,
        ShapeDescription::Sphere { phi, theta, .. } => is_part(phi, TAU) || is_part(theta, PI),
        ShapeDescription::Torus { phi, theta, .. } => is_part(phi, TAU) || is_part(theta, TAU),
        ShapeDescription::Cylinder { capped, .. } | ShapeDescription::Cone { capped, .. } => !capped,
        ShapeDescription::Box { .. }
        | ShapeDescription::Mesh { .. }
        | ShapeDescription::Generated { .. }
        | ShapeDescription::Revolution { .. }
        | ShapeDescription::Compound { .. }
        | ShapeDescription::Instance { .. }
        | ShapeDescription::Vessel(_) => false,
    }
}

fn joined(points: &[[f64; 2]], curve: ProfileCurve) -> Result<Profile, ShapeError> {
    match curve {
        ProfileCurve::Lines => Profile::lines(points),
        ProfileCurve::Smooth => Profile::smooth(points),
    }
}

fn placed(primitives: Vec<Primitive>, placement: &Transform) -> Vec<Primitive> {
    primitives.iter().map(|primitive| primitive.placed(placement)).collect()
}

/// The solids of a vessel, placed in the world.
///
/// # Errors
/// Measures that no glass can have.
pub(super) fn vessel(
    object: &Located<ObjectDescription>,
    description: &VesselDescription,
) -> Result<Vessel, SceneError> {
    let build = || -> Result<Vessel, ShapeError> {
        let outer = match &description.profile {
            VesselProfile::Points { outer, curve } => joined(outer, *curve)?,
            VesselProfile::Bowl { radius, foot, opening } => Profile::sphere_bowl(*radius, *foot, *opening)?,
        };
        let rim = match description.rim {
            RimKind::Round => Rim::Round,
            RimKind::Flat => Rim::Flat,
        };
        let fill = description
            .fill
            .iter()
            .map(|layer| FillSpec { level: Level::Fraction(layer.level), meniscus: layer.meniscus })
            .collect();
        VesselSpec { outer, wall: description.wall, base: description.base, rim, fill }.build()
    };
    let vessel = build().map_err(|error| fault(object, &error))?;
    let place = |primitives| placed(primitives, &object.placement);
    let (glass, liquids) = (place(vessel.glass), vessel.liquids.into_iter().map(place).collect());
    Ok(Vessel { glass, liquids, ..vessel })
}

fn fault(object: &Located<ObjectDescription>, error: &ShapeError) -> SceneError {
    SceneError::at(&object.source, format!("object '{}': {error}", object.name))
}
