//! Faces of two objects that lie on each other, or so near that they seem to be meant to.

use super::line::{Line, Mark};
use super::overlap::Overlaps;
use super::subject::{Scene, at, number};
use hyaline_math::Vec3;
use hyaline_scattering::{BoundaryKind, ObjectId};
use hyaline_scene::{Note, Severity};
use std::collections::BTreeMap;

/// Faces nearer than this fraction of the smaller object's size seem to be meant to coincide.
pub(super) const NEARNESS: f32 = 1e-5;

/// Cosine of the largest angle between faces that lie on each other.
const PARALLEL: f32 = 0.9999;

/// Lines that have to meet the faces: a ball that touches a plane in a point is no contact.
const FEWEST: usize = 3;

/// Which faces lie on each other, by pair of objects.
#[derive(Default)]
pub(super) struct Contacts(BTreeMap<(ObjectId, ObjectId), Contact>);

/// Where two objects lie on each other.
struct Contact {
    /// Lines that met faces within each other's error.
    together: usize,
    /// Lines that met faces farther apart than that.
    apart: usize,
    /// The widest gap, scene units.
    gap: f32,
    /// How many of the faces look the same way.
    alike: usize,
    place: Vec3,
}

impl Contacts {
    pub(super) fn look(&mut self, scene: &Scene, line: &Line) {
        for (i, first) in line.marks.iter().enumerate() {
            for second in &line.marks[i + 1..] {
                let size = scene.size(first.object).min(scene.size(second.object));
                if (second.t - first.t) * first.cosine > NEARNESS * scene.size(first.object) {
                    break;
                }
                if is_contact(scene, first, second, NEARNESS * size) {
                    self.add(first, second);
                }
            }
        }
    }

    fn add(&mut self, first: &Mark, second: &Mark) {
        let key = (first.object.min(second.object), first.object.max(second.object));
        let gap = distance(first, second);
        let empty = Contact { together: 0, apart: 0, gap: 0.0, alike: 0, place: first.p };
        let contact = self.0.entry(key).or_insert(empty);
        *(if gap <= first.reach { &mut contact.together } else { &mut contact.apart }) += 1;
        contact.gap = contact.gap.max(gap);
        contact.alike += usize::from(first.side == second.side);
    }

    /// - `overlaps`: bodies that overlap are told of as such.
    pub(super) fn notes(self, scene: &Scene, overlaps: &Overlaps) -> Vec<Note> {
        let contacts = self.0.into_iter().filter(|(_, contact)| contact.together + contact.apart >= FEWEST);
        let contacts = contacts.filter(|&((a, b), _)| !overlaps.holds(a, b));
        contacts.filter_map(|((a, b), contact)| contact.note(scene, a, b)).collect()
    }
}

fn is_contact(scene: &Scene, first: &Mark, second: &Mark, nearness: f32) -> bool {
    let (a, b) = (first.object, second.object);
    (scene.is_boundary(a) || scene.is_boundary(b))
        && !scene.belong_together(a, b)
        && first.ng.dot(second.ng).abs() > PARALLEL
        && distance(first, second) <= nearness.max(first.reach)
}

/// Distance of two faces along the normal.
fn distance(first: &Mark, second: &Mark) -> f32 {
    (second.p - first.p).dot(first.ng).abs()
}

impl Contact {
    fn note(&self, scene: &Scene, a: ObjectId, b: ObjectId) -> Option<Note> {
        let names = format!("faces of '{}' and '{}'", scene.name(a), scene.name(b));
        let place = at(self.place);
        if self.apart > self.together {
            let gap = number(self.gap);
            let are_both_clear = scene.is_boundary(a) && scene.is_boundary(b);
            let severity = if are_both_clear { Severity::Warning } else { Severity::Info };
            let message = format!(
                "{names} lie {gap} apart, at {place}: the gap is rendered as a film with two surfaces that reflect; let them coincide or overlap if they are meant to touch"
            );
            return Some(scene.note(severity, b, message));
        }
        let (severity, assumption) = self.assumption(scene, a, b)?;
        let message = format!("{names} coincide, at {place}: {assumption}");
        Some(scene.note(severity, b, message))
    }

    /// What the renderer takes coinciding faces for, and the remedy.
    fn assumption(&self, scene: &Scene, a: ObjectId, b: ObjectId) -> Option<(Severity, String)> {
        use BoundaryKind::{Interface, None as Opaque, Solid};
        let name = |object| scene.name(object);
        Some(match (scene.kind(a), scene.kind(b)) {
            (Opaque, Opaque) => return None,
            (Opaque, _) | (_, Opaque) => {
                let (bare, clear) = if scene.is_boundary(b) { (a, b) } else { (b, a) };
                let text = format!(
                    "rendered as in optical contact, without air between; move '{}' off '{}' if there is air",
                    name(clear),
                    name(bare)
                );
                (Severity::Info, text)
            }
            (Solid { medium: m, priority: p }, Solid { medium: n, priority: q }) => {
                let winner = if (p, a) > (q, b) { a } else { b };
                // Bodies of one medium, or side by side: nothing depends on which of them wins but the finish.
                let is_clear = p != q || !scene.differ(m, n) || self.alike == 0;
                let severity = if is_clear { Severity::Info } else { Severity::Warning };
                let text = format!(
                    "they are crossed together, as one boundary with the finish of '{}'; a higher `priority` of one medium says which wins, letting one body reach into the other leaves no doubt",
                    name(winner)
                );
                (severity, text)
            }
            (Interface { .. }, Interface { .. }) => self.sheets(scene, a, b),
            (Solid { .. }, Interface { .. }) | (Interface { .. }, Solid { .. }) => {
                let body = if matches!(scene.kind(a), Solid { .. }) { a } else { b };
                let text = format!(
                    "they are crossed together, and '{}', being a body, decides what is inside of it; let the body reach through the interface, or the interface end at the body",
                    name(body)
                );
                (Severity::Info, text)
            }
        })
    }

    fn sheets(&self, scene: &Scene, a: ObjectId, b: ObjectId) -> (Severity, String) {
        let media = |object| match scene.kind(object) {
            BoundaryKind::Interface { outside, inside } => Some((outside, inside)),
            BoundaryKind::None | BoundaryKind::Solid { .. } => None,
        };
        let (Some((a_out, a_in)), Some((b_out, b_in))) = (media(a), media(b)) else {
            return (Severity::Info, String::new());
        };
        let is_alike = 2 * self.alike > self.together;
        // Crossed one after the other, the medium behind the first must be the one before the second.
        let joins = if is_alike {
            !scene.differ(a_in, b_out) || !scene.differ(b_in, a_out)
        } else {
            !scene.differ(a_in, b_in) || !scene.differ(a_out, b_out)
        };
        if joins {
            return (
                Severity::Info,
                "they are crossed together, from the outermost medium to the innermost".into(),
            );
        }
        let text = format!(
            "the media they name don't join, so '{}', the later one, decides alone; leave one of them out, or name the same medium between them",
            scene.name(a.max(b))
        );
        (Severity::Warning, text)
    }
}
