//! Which items may coincide with others, and which let shadow rays pass.

use super::objects::Parts;
use crate::material::{Composition, Finish, Material};
use crate::world::{ItemInfo, mask};
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
        let has_holes = materials_of(&parts.items[i]).any(|m| materials[m as usize].has_holes());
        // Opaque surfaces are looked for where bodies are met; with holes they look for bodies.
        let met = match kind {
            BoundaryKind::None if !has_holes => Met::default(),
            _ => meets(parts, &bounds, i),
        };
        parts.items[i].may_coincide = if kind == BoundaryKind::None { met.boundary } else { met.anything };
        let ior = |medium: MediumId| media[medium.index()].ior;
        let is_permeable = match kind {
            BoundaryKind::None => false,
            BoundaryKind::Solid { medium, .. } => {
                met.boundary || bases.iter().any(|&base| ior(base) == ior(medium))
            }
            BoundaryKind::Interface { outside, inside } => met.solid || ior(outside) == ior(inside),
        };
        // Where boundaries coincide the finish may be that of the other object.
        let others = met.others.iter().filter(|_| kind != BoundaryKind::None);
        let mut candidates = others.chain([&i]).flat_map(|&j| materials_of(&parts.items[j]));
        if is_permeable || candidates.any(|m| may_pass(materials, m)) {
            parts.geometry[i].mask &= !mask::BLOCKS;
            has_permeable = true;
        }
    }
    has_permeable
}

/// The materials of all faces of an item.
fn materials_of(item: &ItemInfo) -> impl Iterator<Item = u32> {
    item.slot_materials.iter().copied().chain([item.material])
}

/// Whether shadow rays may pass a material straight, where media don't say so.
fn may_pass(materials: &[Material], index: u32) -> bool {
    let material = &materials[index as usize];
    let passes = match &material.composition {
        Composition::Single(Finish::PassThrough) => true,
        Composition::Single(_) => material.straight_shadows,
        Composition::Blend(first, second, _) => may_pass(materials, *first) || may_pass(materials, *second),
    };
    passes || material.has_holes() || material.back.is_some_and(|back| may_pass(materials, back))
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
    /// Items that bound media.
    others: Vec<usize>,
}

/// Looks at the items whose bounds overlap those of item `i`. Surfaces of one closed shape do not count: it is made
/// so that they don't cross.
fn meets(parts: &Parts, bounds: &[Bounds], i: usize) -> Met {
    let mut met = Met::default();
    let of = |j: usize| (parts.items[j].object, parts.pieces[j]);
    for j in (0..bounds.len()).filter(|&j| of(j) != of(i) && bounds[i].overlaps(&bounds[j])) {
        let kind = parts.boundaries[parts.items[j].object.0 as usize];
        met.anything = true;
        if kind != BoundaryKind::None {
            met.boundary = true;
            met.others.push(j);
        }
        met.solid |= matches!(kind, BoundaryKind::Solid { .. });
    }
    met
}

/// Bounds grown by what rounding can hide.
fn padded(bounds: Bounds) -> Bounds {
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    bounds.expanded(largest * 1e-5)
}
