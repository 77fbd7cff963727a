//! Which medium a path is in, and which media meet where it crosses a boundary.
//!
//! A path carries the solids it has entered, as a multiset, over a *base* medium. The solid of highest rank, that is
//! (priority, object id), is the medium it is in; never the one entered last, because a path and the same path walked
//! backwards would then disagree. Three steps at a hit:
//!
//! 1. gather the hits that lie within the ray's error bound of each other: they are crossed together;
//! 2. `MediumSet::crossing` tells whether there is a boundary, of which media, with whose finish;
//! 3. if the path goes on beyond, `MediumSet::commit`; a reflected path stays in the set it had.

mod boundary;
mod sheet;
#[cfg(test)]
mod tests;

pub use boundary::{Boundaries, BoundaryKind, Crossing, ObjectId, Side, SurfaceCrossing};

use crate::MediumId;
use boundary::{Solid, highest, net_crossings, net_side};
use smallvec::SmallVec;
use std::cmp::Reverse;

/// The media about a point of a path: a base, and the solids entered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MediumSet {
    base: MediumId,
    /// Solids with the number of times each was entered, ≥ 1, highest rank first.
    entered: SmallVec<[(Solid, u32); 4]>,
}

impl MediumSet {
    /// Within no solid.
    pub fn new(base: MediumId) -> Self {
        Self { base, entered: SmallVec::new() }
    }

    /// The medium the path is in.
    pub fn active(&self) -> MediumId {
        self.top().map_or(self.base, |solid| solid.medium)
    }

    /// The medium outside all solids.
    pub fn base(&self) -> MediumId {
        self.base
    }

    /// Adds a solid, for a path that starts inside it; other objects change nothing.
    pub fn enter(&mut self, boundaries: &Boundaries, object: ObjectId) {
        if let Some(solid) = boundaries.solid(object) {
            self.add(solid);
        }
    }

    /// Whether the solid `object` has been entered.
    pub fn holds(&self, object: ObjectId) -> bool {
        self.entered.iter().any(|(solid, _)| solid.object == object)
    }

    /// What the path meets where it crosses `surfaces`, which coincide within its error bound, in any order.
    ///
    /// Of one object, hits of the same side count once (a ray through an edge that two faces share reports both),
    /// and opposite ones cancel. A solid that is left but was never entered is added to the set, as if it had been,
    /// and reported to `never_entered`. Nothing else changes before `commit`.
    pub fn crossing(
        &mut self,
        boundaries: &Boundaries,
        surfaces: &[SurfaceCrossing],
        never_entered: &mut impl FnMut(ObjectId),
    ) -> Crossing {
        self.repair(boundaries, surfaces, never_entered);
        let sheet = sheet::joined(boundaries, surfaces, self.base);
        let before = self.top();
        let after = self.top_after(boundaries, surfaces);
        let from = medium_of(before, sheet.map_or(self.base, |sheet| sheet.from));
        let to = medium_of(after, sheet.map_or(self.base, |sheet| sheet.to));
        let bare = highest(surfaces, |object| boundaries.of(object) == BoundaryKind::None);
        // The higher ranking one of two different solids is the one that begins or ends here. Where neither side
        // is in a solid, the sheet is what there is to see.
        let change = if before != after { before.max(after).map(|solid| solid.object) } else { None };
        let seen_sheet = if before.is_none() { sheet.map(|sheet| sheet.object) } else { None };
        match bare.or(change).or(seen_sheet) {
            Some(owner) => Crossing::Boundary { from, to, owner },
            None => Crossing::Hidden,
        }
    }

    /// Takes the path to the far side of `surfaces`, for which `crossing` has been asked.
    pub fn commit(&mut self, boundaries: &Boundaries, surfaces: &[SurfaceCrossing]) {
        if let Some(sheet) = sheet::joined(boundaries, surfaces, self.base) {
            self.base = sheet.to;
        }
        for (object, side) in net_crossings(surfaces) {
            if let Some(solid) = boundaries.solid(object) {
                match side {
                    Side::Entering => self.add(solid),
                    Side::Leaving => self.remove(solid),
                }
            }
        }
    }

    fn top(&self) -> Option<Solid> {
        self.entered.first().map(|&(solid, _)| solid)
    }

    /// The highest solid that remains or begins when `surfaces` have been crossed.
    fn top_after(&self, boundaries: &Boundaries, surfaces: &[SurfaceCrossing]) -> Option<Solid> {
        let is_left = |&&(solid, count): &&(Solid, u32)| {
            count == 1 && net_side(surfaces, solid.object) == Some(Side::Leaving)
        };
        let remaining = self.entered.iter().find(|entry| !is_left(entry)).map(|&(solid, _)| solid);
        let begun = net_crossings(surfaces)
            .filter(|&(_, side)| side == Side::Entering)
            .filter_map(|(object, _)| boundaries.solid(object))
            .max();
        remaining.max(begun)
    }

    fn repair(
        &mut self,
        boundaries: &Boundaries,
        surfaces: &[SurfaceCrossing],
        never_entered: &mut impl FnMut(ObjectId),
    ) {
        for (object, side) in net_crossings(surfaces) {
            if let (Side::Leaving, Some(solid)) = (side, boundaries.solid(object))
                && !self.holds(object)
            {
                never_entered(object);
                self.add(solid);
            }
        }
    }

    fn add(&mut self, solid: Solid) {
        match self.entered.binary_search_by_key(&Reverse(solid), |&(solid, _)| Reverse(solid)) {
            Ok(i) => self.entered[i].1 = self.entered[i].1.saturating_add(1),
            Err(i) => self.entered.insert(i, (solid, 1)),
        }
    }

    fn remove(&mut self, solid: Solid) {
        if let Ok(i) = self.entered.binary_search_by_key(&Reverse(solid), |&(solid, _)| Reverse(solid)) {
            match self.entered[i].1 {
                0 | 1 => drop(self.entered.remove(i)),
                count => self.entered[i].1 = count - 1,
            }
        }
    }
}

fn medium_of(solid: Option<Solid>, base: MediumId) -> MediumId {
    solid.map_or(base, |solid| solid.medium)
}
