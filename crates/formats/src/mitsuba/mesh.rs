//! `ply`, `obj` and `serialized` shapes: meshes as Mitsuba shades and turns them.
//!
//! 1. Texture coordinates are turned over where the file wants it.
//! 2. A mesh without normals gets smooth ones, unless it is to be faceted.
//! 3. Faces follow the normals: those say where the outside is, not the winding.
//! 4. `flip_normals` turns it inside out. So does a `to_world` that mirrors a mesh without normals of its own, as
//!    Mitsuba transforms vertices before it looks at the winding.

use super::element::Element;
use super::form::Form;
use super::importer::Importer;
use super::names::present_name;
use crate::Result;
use crate::limits::Limits;
use crate::mesh::{FileMesh, normals};
use hyaline_math::Transform;
use hyaline_scene::{MeshData, ShapeDescription};
use std::sync::Arc;

/// How a mesh of a file is to be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Change {
    /// Whether `flip_normals` is said.
    flip: bool,
    /// Whether texture coordinates are upside down.
    flip_v: bool,
    /// Whether `to_world` mirrors.
    mirror: bool,
    /// Whether faces are flat.
    flat: bool,
    /// The only slot that counts.
    slot: Option<u16>,
}

/// Meshes that were changed, by the address of what they were made of, which stays alive beside.
#[derive(Debug, Default)]
pub(super) struct ChangedMeshes(Vec<(Arc<MeshData>, Change, Arc<MeshData>)>);

impl ChangedMeshes {
    fn changed(&mut self, mesh: &Arc<MeshData>, change: Change) -> Arc<MeshData> {
        let known = self.0.iter().find(|(of, by, _)| Arc::ptr_eq(of, mesh) && *by == change);
        if let Some((_, _, changed)) = known {
            return changed.clone();
        }
        let changed = Arc::new(apply(MeshData::clone(mesh), change));
        self.0.push((mesh.clone(), change, changed.clone()));
        changed
    }
}

impl Importer<'_> {
    /// The forms of a mesh: one, or one for each bsdf that names a material of an OBJ file.
    pub(super) fn mesh<'a>(
        &mut self,
        shape: Element<'a>,
        placement: Transform,
        flip: bool,
    ) -> Result<Vec<Form<'a>>> {
        let FileMesh { mesh, flat } = self.file_mesh(shape)?;
        let is_obj = shape.kind() == "obj";
        let flat = shape.boolean("face_normals", flat)?;
        let flip_v = shape.boolean("flip_tex_coords", is_obj)? && !mesh.uvs.is_empty();
        let whole = Change { flip, flip_v, mirror: placement.is_mirroring(), flat, slot: None };
        let slots = self.slots(shape, &mesh)?;
        if slots.is_empty() {
            let mesh = self.meshes.changed(&mesh, whole);
            return Ok(vec![Form::turned(ShapeDescription::Mesh { mesh, flat }, placement)]);
        }
        let part = |(slot, bsdf): (u16, Option<Element<'a>>)| {
            let mesh = self.meshes.changed(&mesh, Change { slot: Some(slot), ..whole });
            Form { bsdf, ..Form::turned(ShapeDescription::Mesh { mesh, flat }, placement) }
        };
        Ok(slots.into_iter().map(part).collect())
    }

    fn file_mesh(&self, shape: Element<'_>) -> Result<FileMesh> {
        let Some(name) = shape.string("filename")? else {
            return Err(shape.error(format!("{} needs `filename`", shape.title())));
        };
        if shape.kind() != "serialized" {
            return Ok(FileMesh { mesh: self.assets.mesh(&name.source, &name)?, flat: false });
        }
        let index = shape.float("shape_index", 0.0, Limits::between(0.0, f64::from(u32::MAX)))?;
        self.assets.serialized_mesh(&name.source, &name, index as u32)
    }

    /// The slots of an OBJ file with the bsdfs of their names; nothing where no bsdf bears the name of a slot.
    fn slots<'a>(&self, shape: Element<'a>, mesh: &MeshData) -> Result<Vec<(u16, Option<Element<'a>>)>> {
        if shape.kind() != "obj" || mesh.slots.is_empty() {
            return Ok(Vec::new());
        }
        let mut named = Vec::new();
        for slot in 0..mesh.slots.len() {
            named.push((slot as u16, shape.child_named("bsdf", &present_name(&mesh.slots[slot]))?));
        }
        if named.iter().any(|(_, bsdf)| bsdf.is_some()) {
            // Slots without faces have no form.
            named.retain(|(slot, _)| mesh.face_slots.contains(slot));
            let others = shape.children("bsdf")?.into_iter().find(|(name, _)| name.is_none());
            for (slot, bsdf) in named.iter_mut().filter(|(_, bsdf)| bsdf.is_none()) {
                *bsdf = others.map(|(_, bsdf)| bsdf);
                if bsdf.is_none() {
                    let name = &mesh.slots[usize::from(*slot)];
                    shape.warn(format!(
                        "no bsdf is named '{name}' as the file's material is; the first counts"
                    ));
                }
            }
            return Ok(named);
        }
        if self.is_old && shape.child("bsdf")?.is_none() {
            shape.warn(
                "the materials of an OBJ file are not read; without a bsdf the shape is matte and grey",
            );
        }
        Ok(Vec::new())
    }
}

/// A mesh without slots, changed.
fn apply(mut mesh: MeshData, change: Change) -> MeshData {
    if let Some(slot) = change.slot {
        mesh = only_slot(&mesh, slot);
    }
    mesh.face_slots = Vec::new();
    mesh.slots = Vec::new();
    if change.flip_v {
        mesh.uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
    }
    let has_normals = !change.flat && !mesh.normals.is_empty();
    if !change.flat {
        if !has_normals {
            normals::smooth(&mut mesh);
        }
        normals::turn_faces(&mut mesh);
    }
    if change.flip != (change.mirror && !has_normals) {
        normals::flip(&mut mesh);
    }
    mesh
}

/// The faces of one slot with their vertices.
fn only_slot(mesh: &MeshData, slot: u16) -> MeshData {
    let mut part = MeshData::default();
    let mut new_index = vec![u32::MAX; mesh.positions.len()];
    for (triangle, _) in mesh.triangles.iter().zip(&mesh.face_slots).filter(|(_, of)| **of == slot) {
        part.triangles.push(triangle.map(|old| {
            let (new, old) = (&mut new_index[old as usize], old as usize);
            if *new == u32::MAX {
                *new = part.positions.len() as u32;
                part.positions.push(mesh.positions[old]);
                part.normals.extend(mesh.normals.get(old));
                part.uvs.extend(mesh.uvs.get(old));
            }
            *new
        }));
    }
    part
}
