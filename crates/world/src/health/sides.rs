//! Interfaces that name different media for one place.
//!
//! Along a line, what an interface says lies behind it must be what the next one says lies before it, unless
//! something opaque or a body comes between. Where they disagree, the one within the other is to blame: glass under
//! water that names air outside.

use super::line::{Line, Mark};
use super::subject::{Scene, at};
use hyaline_math::Vec3;
use hyaline_scattering::{BoundaryKind, Crossing, MediumId, MediumSet, ObjectId, Side};
use hyaline_scene::{Note, Severity};
use std::collections::BTreeMap;

/// Lines that have to find a fault, and their share of those that could.
const FEWEST: usize = 3;
const LEAST_SHARE: f64 = 0.02;

/// What lines found between interfaces.
#[derive(Default)]
pub(super) struct Sides {
    conflicts: BTreeMap<Conflict, (usize, Vec3)>,
    /// How often an interface came next to another: both in the order of their ids.
    neighbors: BTreeMap<(ObjectId, ObjectId), usize>,
    /// How often an interface was crossed within a body, and how often elsewhere.
    crossed: BTreeMap<ObjectId, (usize, usize)>,
}

/// Two interfaces, and the media that they name for the place between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Conflict {
    /// The one to blame, or either.
    blamed: ObjectId,
    /// The side of it that faces the place.
    is_inside: bool,
    named: MediumId,
    other: ObjectId,
    is_inside_other: bool,
    told: MediumId,
}

/// What the last interface said.
#[derive(Clone, Copy)]
struct Told {
    medium: MediumId,
    mark: Mark,
}

impl Sides {
    pub(super) fn look(&mut self, scene: &Scene, line: &Line) {
        let is_body = |object: ObjectId| matches!(scene.kind(object), BoundaryKind::Solid { .. });
        if line.unbalanced.iter().any(|&object| is_body(object)) {
            return;
        }
        let mut told: Option<Told> = None;
        let mut depth = 0;
        for group in groups(&line.marks) {
            let sheets: Vec<&Mark> = group
                .iter()
                .filter(|mark| matches!(scene.kind(mark.object), BoundaryKind::Interface { .. }))
                .collect();
            if depth > 0 {
                sheets.iter().for_each(|mark| self.crossed.entry(mark.object).or_default().0 += 1);
            } else if let [mark] = sheets[..] {
                self.crossed.entry(mark.object).or_default().1 += 1;
                self.compare(scene, told, mark);
            } else {
                sheets.iter().for_each(|mark| self.crossed.entry(mark.object).or_default().1 += 1);
            }
            told = told_after(scene, &sheets, told);
            for mark in group.iter().filter(|mark| is_body(mark.object)) {
                depth += if mark.side == Side::Entering { 1 } else { -1 };
            }
            if group.iter().any(|mark| !scene.is_boundary(mark.object) && !mark.is_thin) {
                told = None;
            }
        }
    }

    /// Compares what was told with what the interface at `mark` names on its near side.
    fn compare(&mut self, scene: &Scene, told: Option<Told>, mark: &Mark) {
        let Some(told) = told.filter(|told| told.mark.object != mark.object) else { return };
        let Some((named, _)) = named(scene, mark) else { return };
        let (first, second) = (told.mark.object, mark.object);
        *self.neighbors.entry((first.min(second), first.max(second))).or_default() += 1;
        if !scene.differ(told.medium, named) {
            return;
        }
        // The place lies inside the first where the line entered it, and inside the second where it leaves it.
        let (in_first, in_second) = (told.mark.side == Side::Entering, mark.side == Side::Leaving);
        let conflict = if in_second && !in_first {
            Conflict {
                blamed: first,
                is_inside: in_first,
                named: told.medium,
                other: second,
                is_inside_other: in_second,
                told: named,
            }
        } else {
            Conflict {
                blamed: second,
                is_inside: in_second,
                named,
                other: first,
                is_inside_other: in_first,
                told: told.medium,
            }
        };
        self.conflicts.entry(conflict).or_insert((0, mark.p)).0 += 1;
    }

    pub(super) fn notes(&self, scene: &Scene) -> Vec<Note> {
        let mut notes = Vec::new();
        let mut pairs: Vec<(ObjectId, ObjectId)> = Vec::new();
        let mut conflicts: Vec<(&Conflict, &(usize, Vec3))> = self.conflicts.iter().collect();
        // Of interfaces that overlap each other's insides that is what there is to tell.
        conflicts.sort_by_key(|(conflict, _)| !(conflict.is_inside && conflict.is_inside_other));
        for (conflict, &(count, place)) in conflicts {
            let pair = (conflict.blamed.min(conflict.other), conflict.blamed.max(conflict.other));
            let possible = self.neighbors.get(&pair).copied().unwrap_or(0);
            let is_fault = count >= FEWEST && count as f64 >= LEAST_SHARE * possible as f64;
            // One place seen from both sides is one fault.
            if is_fault && !pairs.contains(&pair) {
                pairs.push(pair);
                notes.push(scene.note(Severity::Warning, conflict.blamed, conflict.words(scene, place)));
            }
        }
        for (&object, &(hidden, seen)) in &self.crossed {
            if seen == 0 && hidden > 8 {
                let message = format!(
                    "interface '{}' lies within a body, which decides what is there: it is not seen; make it a body of its own, with a higher `priority`",
                    scene.name(object)
                );
                notes.push(scene.note(Severity::Warning, object, message));
            }
        }
        notes
    }
}

impl Conflict {
    fn words(&self, scene: &Scene, place: Vec3) -> String {
        let side = |is_inside| if is_inside { "inside" } else { "outside" };
        let (blamed, other) = (scene.name(self.blamed), scene.name(self.other));
        let (named, told) = (scene.medium_name(self.named), scene.medium_name(self.told));
        let place = at(place);
        if !self.is_inside && self.is_inside_other {
            return format!(
                "interface '{blamed}' names {named} as the medium outside of it, but there, at {place}, is {told}, which is inside of '{other}': light is bent as the file says; name {told} as its outside"
            );
        }
        format!(
            "interfaces '{blamed}' and '{other}' name different media for one place, at {place}: {named} {} of the first and {told} {} of the second: each is believed at its own surface; {}",
            side(self.is_inside),
            side(self.is_inside_other),
            if self.is_inside {
                "they overlap: pull them apart, or make bodies with a `priority` of them"
            } else {
                "name the same medium"
            }
        )
    }
}

/// The media that an interface names on the near and on the far side of a line.
fn named(scene: &Scene, mark: &Mark) -> Option<(MediumId, MediumId)> {
    match (scene.kind(mark.object), mark.side) {
        (BoundaryKind::Interface { outside, inside }, Side::Entering) => Some((outside, inside)),
        (BoundaryKind::Interface { outside, inside }, Side::Leaving) => Some((inside, outside)),
        (BoundaryKind::None | BoundaryKind::Solid { .. }, _) => None,
    }
}

/// What is known of the medium behind some interfaces that are crossed together.
fn told_after(scene: &Scene, sheets: &[&Mark], before: Option<Told>) -> Option<Told> {
    match sheets {
        [] => before,
        [mark] => named(scene, mark).map(|(_, medium)| Told { medium, mark: **mark }),
        several => {
            let mut set = MediumSet::new(before.map_or(MediumId(0), |told| told.medium));
            let surfaces: Vec<_> = several.iter().map(|mark| (mark.object, mark.side)).collect();
            let crossing = set.crossing(&scene.world.boundaries, &surfaces, &mut |_| {});
            let Crossing::Boundary { to, owner, .. } = crossing else { return None };
            let mark = several.iter().find(|mark| mark.object == owner)?;
            Some(Told { medium: to, mark: **mark })
        }
    }
}

/// The marks of a line, those together that a ray crosses together.
fn groups(marks: &[Mark]) -> impl Iterator<Item = &[Mark]> {
    marks.chunk_by(|a, b| (b.t - a.t) * a.cosine.max(1e-3) <= a.reach.max(b.reach))
}
