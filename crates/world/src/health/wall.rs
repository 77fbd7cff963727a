//! Walls without a thickness, and bodies that are entered but not left.

use super::line::Line;
use super::subject::{Scene, at};
use hyaline_geometry::ItemGeometry;
use hyaline_math::Vec3;
use hyaline_scattering::{BoundaryKind, ObjectId};
use hyaline_scene::{Note, Severity};
use std::collections::{BTreeMap, BTreeSet};

/// Walls thinner than this fraction of the object's size have no thickness.
const THIN: f32 = 1e-6;

/// Cosine between the normals of the two faces of a wall: opposite but for little.
const OPPOSITE: f32 = -0.9;

/// Lines that have to find a fault, and their share of those that meet the object.
const FEWEST: usize = 2;
const LEAST_SHARE: f64 = 0.02;

/// What lines found at each object where media meet.
#[derive(Default)]
pub(super) struct Walls(BTreeMap<ObjectId, Tally>);

#[derive(Default)]
struct Tally {
    lines: usize,
    thin: Found,
    unbalanced: Found,
}

#[derive(Default)]
struct Found {
    count: usize,
    place: Option<Vec3>,
}

impl Found {
    fn add(&mut self, place: Option<Vec3>) {
        self.count += 1;
        self.place = self.place.or(place);
    }

    /// Where the fault is, if it is one.
    fn place(&self, lines: usize) -> Option<Vec3> {
        let is_fault = self.count >= FEWEST && self.count as f64 >= LEAST_SHARE * lines as f64;
        self.place.filter(|_| is_fault)
    }
}

impl Walls {
    pub(super) fn look(&mut self, scene: &Scene, line: &Line) {
        let met: BTreeSet<ObjectId> =
            line.marks.iter().map(|mark| mark.object).filter(|&object| scene.is_boundary(object)).collect();
        for object in met {
            let tally = self.0.entry(object).or_default();
            tally.lines += 1;
            let marks: Vec<_> = line.marks.iter().filter(|mark| mark.object == object).collect();
            let thin = marks.windows(2).find(|pair| {
                pair[0].ng.dot(pair[1].ng) < OPPOSITE
                    && (pair[1].p - pair[0].p).dot(pair[0].ng).abs() < THIN * scene.size(object)
            });
            if let Some(pair) = thin {
                tally.thin.add(Some(pair[0].p));
            }
            if line.unbalanced.contains(&object) {
                tally.unbalanced.add(marks.first().map(|mark| mark.p));
            }
        }
    }

    pub(super) fn notes(&self, scene: &Scene) -> Vec<Note> {
        let mut notes = Vec::new();
        for (&object, tally) in &self.0 {
            let name = scene.name(object);
            if let Some(place) = tally.thin.place(tally.lines) {
                let message = format!(
                    "object '{name}' has walls without thickness, at {}: their two faces cancel, and light passes as if nothing were there; give them a thickness, or make the object one sheet with the finish `thin-dielectric` and no medium",
                    at(place)
                );
                notes.push(scene.note(Severity::Warning, object, message));
            } else if let Some(place) = tally.unbalanced.place(tally.lines)
                && matches!(scene.kind(object), BoundaryKind::Solid { .. })
                && !has_mesh(scene, object)
            {
                let message = format!(
                    "object '{name}' is a body of a medium, but of {} lines through it {} don't leave it as often as they enter it, one of them at {}: paths lose track of where they are; close it, or make it an `interface`",
                    tally.lines,
                    tally.unbalanced.count,
                    at(place)
                );
                notes.push(scene.note(Severity::Warning, object, message));
            }
        }
        notes
    }
}

/// Whether the object has a mesh, whose holes are told of as open edges, or is of a kind that says by itself that
/// it is open.
fn has_mesh(scene: &Scene, object: ObjectId) -> bool {
    let items = scene.world.items.iter().zip(scene.world.geometry.items());
    let is_mesh = items
        .filter(|(info, _)| info.object == object)
        .any(|(_, item)| matches!(item.geometry, ItemGeometry::Mesh { .. }));
    let is_known = scene.described(object).is_some_and(|described| crate::compile::is_open(&described.shape));
    is_mesh || is_known
}
