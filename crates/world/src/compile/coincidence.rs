//! Which items may coincide with others, and which let shadow rays pass.

use super::objects::Parts;
use crate::material::{Finish, Material};
use crate::world::mask;
use hyaline_math::Bounds;
use hyaline_scattering::{BoundaryKind, Medium, MediumId};
use std::collections::BTreeSet;

/// Marks items whose surfaces may lie on those of other objects, and takes `mask::BLOCKS` from items that light may
/// cross straight. Returns whether there are such items.
///
/// - `bases`: media that paths may start in outside of all solids.
///
/// Judged by bounds alone, so it errs on the side of caution: a mark costs a little time, a missing one would be wrong.
/// A single mesh whose own shells overlap is taken for one closed shape.
pub(super) fn mark(parts: &mut Parts, media: &[Medium], materials: &[Material], bases: &[MediumId]) -> bool {
    let bounds: Vec<Bounds> = parts.geometry.iter().map(|item| padded(item.geometry.bounds())).collect();
    let bases = with_sheets(parts, bases);
    let mut has_permeable = false;
    for i in 0..parts.items.len() {
        let kind = parts.boundaries[parts.items[i].object.0 as usize];
        let met = if kind == BoundaryKind::None { Met::default() } else { meets(parts, &bounds, i) };
        parts.items[i].may_coincide = met.anything;
        let ior = |medium: MediumId| media[medium.index()].ior;
        let is_permeable = match kind {
            BoundaryKind::None => false,
            BoundaryKind::Solid { medium, .. } => {
                met.boundary || bases.iter().any(|&base| ior(base) == ior(medium))
            }
            BoundaryKind::Interface { outside, inside } => met.solid || ior(outside) == ior(inside),
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

/// The media that solids may stand in: the given ones, and both sides of every sheet.
fn with_sheets(parts: &Parts, bases: &[MediumId]) -> BTreeSet<MediumId> {
    let sides = parts.boundaries.iter().flat_map(|kind| match *kind {
        BoundaryKind::Interface { outside, inside } => [Some(outside), Some(inside)],
        BoundaryKind::None | BoundaryKind::Solid { .. } => [None, None],
    });
    bases.iter().copied().chain(sides.flatten()).collect()
}

/// What the surfaces of an item may touch or cross.
#[derive(Default)]
struct Met {
    anything: bool,
    boundary: bool,
    solid: bool,
}

/// Looks at the items whose bounds overlap those of item `i`. Surfaces of one closed shape do not count: it is made
/// so that they don't cross.
fn meets(parts: &Parts, bounds: &[Bounds], i: usize) -> Met {
    let mut met = Met::default();
    let of = |j: usize| (parts.items[j].object, parts.pieces[j]);
    for j in (0..bounds.len()).filter(|&j| of(j) != of(i) && bounds[i].overlaps(&bounds[j])) {
        let kind = parts.boundaries[parts.items[j].object.0 as usize];
        met.anything = true;
        met.boundary |= kind != BoundaryKind::None;
        met.solid |= matches!(kind, BoundaryKind::Solid { .. });
    }
    met
}

/// Bounds grown by what rounding can hide.
fn padded(bounds: Bounds) -> Bounds {
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    bounds.expanded(largest * 1e-5)
}
