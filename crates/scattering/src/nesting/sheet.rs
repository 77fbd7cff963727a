//! Interfaces as a ray sees them, several coinciding ones as one.

use super::boundary::{Boundaries, BoundaryKind, ObjectId, Side, SurfaceCrossing, net_crossings};
use crate::MediumId;

/// An interface as a ray sees it, or several as one.
#[derive(Clone, Copy)]
pub(super) struct Sheet {
    pub(super) object: ObjectId,
    pub(super) from: MediumId,
    pub(super) to: MediumId,
}

/// The interfaces among `surfaces` as one.
///
/// Several are a walk from medium to medium in unknown order. Where they join, the media at which the walk starts
/// and ends are those named once more on the near than on the far side, or once less. A walk in a ring (the two faces
/// of a film thinner than the error bound) ends where it starts: in `base`. Where they don't join, the highest object
/// id decides alone. None of it depends on the direction of the walk.
pub(super) fn joined(boundaries: &Boundaries, surfaces: &[SurfaceCrossing], base: MediumId) -> Option<Sheet> {
    let sheets = || net_crossings(surfaces).filter_map(|surface| sheet(boundaries, surface));
    let winner = sheets().max_by_key(|sheet| sheet.object)?;
    if surfaces.len() == 1 {
        return Some(winner);
    }
    let is_named = |medium: MediumId| sheets().any(|sheet| sheet.from == medium || sheet.to == medium);
    let excess = |medium: MediumId| {
        sheets().map(|s| i32::from(s.from == medium) - i32::from(s.to == medium)).sum::<i32>()
    };
    let surplus: i32 = sheets()
        .enumerate()
        .map(|(i, sheet)| {
            let is_new = sheets().take(i).all(|earlier| earlier.from != sheet.from);
            if is_new { excess(sheet.from).max(0) } else { 0 }
        })
        .sum();
    match surplus {
        0 => {
            let medium = if is_named(base) { base } else { winner.from.min(winner.to) };
            Some(Sheet { from: medium, to: medium, ..winner })
        }
        1 => {
            let from = sheets().map(|sheet| sheet.from).find(|&medium| excess(medium) == 1)?;
            let to = sheets().map(|sheet| sheet.to).find(|&medium| excess(medium) == -1)?;
            Some(Sheet { from, to, ..winner })
        }
        _ => Some(winner),
    }
}

fn sheet(boundaries: &Boundaries, (object, side): SurfaceCrossing) -> Option<Sheet> {
    match (boundaries.of(object), side) {
        (BoundaryKind::Interface { outside, inside }, Side::Entering) => {
            Some(Sheet { object, from: outside, to: inside })
        }
        (BoundaryKind::Interface { outside, inside }, Side::Leaving) => {
            Some(Sheet { object, from: inside, to: outside })
        }
        (BoundaryKind::None | BoundaryKind::Solid { .. }, _) => None,
    }
}
