//! Which items may coincide with others, and which let shadow rays pass.

use super::objects::Parts;
use crate::material::{Finish, Material};
use crate::world::mask;
use hyaline_math::Bounds;
use hyaline_scattering::{BoundaryKind, Medium, MediumId};

/// Marks items whose surfaces may lie on those of other objects, and takes `mask::BLOCKS` from items that light may
/// cross straight. Returns whether there are such items.
///
/// Judged by bounds alone, so it errs on the side of caution: a mark costs a little time, a missing one would be wrong.
pub(super) fn mark(
    parts: &mut Parts,
    media: &[Medium],
    materials: &[Material],
    surrounding: MediumId,
) -> bool {
    let bounds: Vec<Bounds> = parts.geometry.iter().map(|item| padded(item.geometry.bounds())).collect();
    let mut has_permeable = false;
    for i in 0..parts.items.len() {
        let object = parts.items[i].object;
        let kind = parts.boundaries[object.0 as usize];
        let neighbors: Vec<BoundaryKind> = (0..bounds.len())
            .filter(|&j| parts.items[j].object != object && bounds[i].overlaps(&bounds[j]))
            .map(|j| parts.boundaries[parts.items[j].object.0 as usize])
            .collect();
        parts.items[i].may_coincide = !matches!(kind, BoundaryKind::None) && !neighbors.is_empty();
        let meets_solid = neighbors.iter().any(|k| matches!(k, BoundaryKind::Solid { .. }));
        let meets_boundary = neighbors.iter().any(|k| !matches!(k, BoundaryKind::None));
        let ior = |medium: MediumId| media[medium.0 as usize].ior;
        let is_permeable = match kind {
            BoundaryKind::None => false,
            BoundaryKind::Solid { medium, .. } => meets_boundary || ior(medium) == ior(surrounding),
            BoundaryKind::Interface { outside, inside } => meets_solid || ior(outside) == ior(inside),
        };
        let passes = |material: u32| matches!(materials[material as usize].finish, Finish::PassThrough);
        let item = &parts.items[i];
        if is_permeable || passes(item.material) || item.slot_materials.iter().any(|&m| passes(m)) {
            parts.geometry[i].mask &= !mask::BLOCKS;
            has_permeable = true;
        }
    }
    has_permeable
}

/// Bounds grown by what rounding can hide.
fn padded(bounds: Bounds) -> Bounds {
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    bounds.expanded(largest * 1e-5)
}
