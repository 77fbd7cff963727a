//! Which items throw caustics: the one rule for what photons are aimed at.

use crate::World;
use crate::material::{ColorInput, Finish, Material, ScalarInput};
use hyaline_geometry::ItemGeometry;

/// Roughness up to which a finish counts as nearly polished.
pub const NEARLY_POLISHED: f32 = 0.5;

impl Material {
    /// Whether the finish may send light on in a narrow lobe, so that caustics come of it.
    ///
    /// In doubt it does: what varies with a texture counts, and so does every finish that is not known to scatter
    /// widely. Light that photons are not aimed at would be missing from the caustics.
    pub fn may_throw_caustics(&self) -> bool {
        match &self.finish {
            Finish::Matte { .. } | Finish::Black | Finish::PassThrough => false,
            Finish::Phong { diffuse, .. } => match diffuse {
                ColorInput::Constant(diffuse) => diffuse.is_zero(),
                ColorInput::Texture(_) => true,
            },
            Finish::Conductor { roughness, .. } | Finish::Dielectric { roughness, .. } => match roughness {
                ScalarInput::Constant(roughness) => *roughness <= NEARLY_POLISHED,
                ScalarInput::Texture(_) => true,
            },
            _ => true,
        }
    }
}

impl World {
    /// Indices of the items with a surface that may throw caustics.
    pub fn specular_items(&self) -> Vec<u32> {
        (0..self.items.len() as u32).filter(|&item| self.is_specular_item(item)).collect()
    }

    fn is_specular_item(&self, item: u32) -> bool {
        match &self.geometry.items()[item as usize].geometry {
            ItemGeometry::Mesh { mesh, .. } if !self.items[item as usize].slot_materials.is_empty() => {
                (0..mesh.mesh().face_count() as u32).any(|face| self.is_specular_face(item, face))
            }
            ItemGeometry::Mesh { .. } | ItemGeometry::Shape(_) => self.is_specular_face(item, 0),
        }
    }

    /// Whether a face of an item may throw caustics; shapes have face 0 alone.
    ///
    /// # Panics
    /// Where there is no such item or face.
    pub fn is_specular_face(&self, item: u32, face: u32) -> bool {
        let info = &self.items[item as usize];
        let own = || match &self.geometry.items()[item as usize].geometry {
            ItemGeometry::Mesh { mesh, .. } => mesh.mesh().face_slot(face) as usize,
            ItemGeometry::Shape(_) => usize::MAX,
        };
        let slot = if info.slot_materials.is_empty() { None } else { info.slot_materials.get(own()) };
        let material = slot.copied().unwrap_or(info.material);
        // Where boundaries coincide, the finish of either object may be the one in force; both are items.
        self.materials[material as usize].may_throw_caustics()
    }
}
