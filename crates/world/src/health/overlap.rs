//! Bodies that overlap without a priority that says which of them is there.

use super::line::{Line, Mark};
use super::subject::{Scene, at};
use hyaline_math::Vec3;
use hyaline_scattering::{BoundaryKind, ObjectId, Side};
use hyaline_scene::{Note, Severity};
use std::collections::BTreeMap;

/// Bodies that reach into each other by less than this fraction of the smaller one's size touch.
const DEPTH: f32 = 1e-4;

/// Lines that have to find the overlap.
const FEWEST: usize = 2;

/// Overlapping bodies of equal priority and different media.
#[derive(Default)]
pub(super) struct Overlaps(BTreeMap<(ObjectId, ObjectId), (usize, Vec3)>);

impl Overlaps {
    pub(super) fn look(&mut self, scene: &Scene, line: &Line) {
        let mut within: BTreeMap<ObjectId, i32> = BTreeMap::new();
        let mut found: BTreeMap<(ObjectId, ObjectId), Vec3> = BTreeMap::new();
        let is_judged = |mark: &&Mark| {
            matches!(scene.kind(mark.object), BoundaryKind::Solid { .. })
                && !line.unbalanced.contains(&mark.object)
        };
        let marks: Vec<&Mark> = line.marks.iter().filter(is_judged).collect();
        for (mark, next) in marks.iter().zip(marks.iter().skip(1)) {
            *within.entry(mark.object).or_default() += if mark.side == Side::Entering { 1 } else { -1 };
            let entered: Vec<ObjectId> =
                within.iter().filter(|&(_, &depth)| depth > 0).map(|(&object, _)| object).collect();
            for (i, &a) in entered.iter().enumerate() {
                for &b in &entered[i + 1..] {
                    let deep = DEPTH * scene.size(a).min(scene.size(b));
                    if next.t - mark.t > deep && is_undecided(scene, a, b) {
                        found.entry((a, b)).or_insert(0.5 * (mark.p + next.p));
                    }
                }
            }
        }
        for (pair, place) in found {
            self.0.entry(pair).or_insert((0, place)).0 += 1;
        }
    }

    /// Whether the two overlap without a decision.
    pub(super) fn holds(&self, a: ObjectId, b: ObjectId) -> bool {
        self.0.get(&(a.min(b), a.max(b))).is_some_and(|&(count, _)| count >= FEWEST)
    }

    pub(super) fn notes(&self, scene: &Scene) -> Vec<Note> {
        let found = self.0.iter().filter(|&(_, &(count, _))| count >= FEWEST);
        found
            .map(|(&(a, b), &(_, place))| {
                let message = format!(
                    "bodies '{}' and '{}' overlap, at {}, and their media have the same priority: '{}', the later one, is taken to be there; give the medium that is there a higher `priority`",
                    scene.name(a),
                    scene.name(b),
                    at(place),
                    scene.name(b)
                );
                scene.note(Severity::Warning, b, message)
            })
            .collect()
    }
}

/// Whether it matters which of the two is there, and nothing but their order says so.
fn is_undecided(scene: &Scene, a: ObjectId, b: ObjectId) -> bool {
    match (scene.kind(a), scene.kind(b)) {
        (BoundaryKind::Solid { medium: m, priority: p }, BoundaryKind::Solid { medium: n, priority: q }) => {
            p == q && scene.differ(m, n) && !scene.belong_together(a, b)
        }
        _ => false,
    }
}
