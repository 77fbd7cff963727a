//! Lines through a scene and all surfaces along them.
//!
//! Each transparent object is pierced by lines in all directions, and so is each box in which two objects may meet,
//! of which one is transparent. The points and directions are fixed, so the same scene always gets the same notes.

use super::subject::Scene;
use hyaline_geometry::Candidate;
use hyaline_math::ray::offset_distance;
use hyaline_math::{Bounds, Ray, Vec3};
use hyaline_sampling::{Sampler, SamplerKind, warp};
use hyaline_scattering::{ObjectId, Side};

/// Lines sent in all, about: scenes of many objects get fewer for each.
const BUDGET: usize = 100_000;

/// Lines through one object, or through one box where two may meet.
const FEWEST: usize = 16;
const MOST: usize = 256;

/// Objects that may meet are looked at in at most this many pairs.
const MOST_PAIRS: usize = 20_000;

/// A surface on a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    /// Place along the line, scene units.
    pub(super) t: f32,
    pub(super) object: ObjectId,
    /// As the line runs.
    pub(super) side: Side,
    pub(super) p: Vec3,
    /// Unit geometric normal.
    pub(super) ng: Vec3,
    /// Cosine between line and normal, ≥ 0.
    pub(super) cosine: f32,
    /// How far from the surface the next ray starts: what is nearer is crossed together with it.
    pub(super) reach: f32,
    /// Whether light passes it, though it bounds nothing.
    pub(super) is_thin: bool,
}

/// A line and everything on it, in order.
#[derive(Debug)]
pub(super) struct Line {
    pub(super) marks: Vec<Mark>,
    /// Boundaries that the line leaves more often than it has entered, or the other way round.
    pub(super) unbalanced: Vec<ObjectId>,
}

/// Sends all lines.
pub(super) fn send(scene: &Scene, visit: &mut impl FnMut(&Line)) {
    let mut targets: Vec<Bounds> = scene
        .objects()
        .filter(|&object| scene.is_boundary(object))
        .map(|object| scene.bounds(object))
        .collect();
    targets.extend(meetings(scene));
    targets.retain(|bounds| !bounds.is_empty() && bounds.radius().is_finite());
    let count = (BUDGET / targets.len().max(1)).clamp(FEWEST, MOST);
    for (target, bounds) in targets.iter().enumerate() {
        for index in 0..count {
            let mut sampler = Sampler::new(SamplerKind::Sobol, 0, (target as u32, 0), index as u32);
            let (xy, z) = (sampler.next_2d(), sampler.next_1d());
            let through = bounds.min + bounds.size() * Vec3::new(xy.x, xy.y, z);
            // The start lies off the target, but not so far that distances lose their digits.
            let direction = warp::sample_sphere(sampler.next_2d());
            visit(&line(scene, through - direction * (2.2 * bounds.radius()), direction));
        }
    }
}

/// The boxes in which two objects may meet, one of them transparent, grown by what can count as touching.
fn meetings(scene: &Scene) -> Vec<Bounds> {
    let padded: Vec<Bounds> = scene
        .objects()
        .map(|object| scene.bounds(object).expanded(super::contact::NEARNESS * scene.size(object)))
        .collect();
    let mut boxes = Vec::new();
    for a in scene.objects() {
        for b in scene.objects().skip(a.0 as usize + 1) {
            let (box_a, box_b) = (&padded[a.0 as usize], &padded[b.0 as usize]);
            let is_of_interest = scene.is_boundary(a) || scene.is_boundary(b);
            if is_of_interest && box_a.overlaps(box_b) && !scene.belong_together(a, b) {
                boxes.push(Bounds { min: box_a.min.max(box_b.min), max: box_a.max.min(box_b.max) });
                if boxes.len() == MOST_PAIRS {
                    return boxes;
                }
            }
        }
    }
    boxes
}

/// Everything on the line through `origin`, both ways.
fn line(scene: &Scene, origin: Vec3, direction: Vec3) -> Line {
    let mut marks = Vec::new();
    for way in [1.0, -1.0] {
        let ray = Ray::new(origin, direction * way);
        let mut candidates: Vec<Candidate> = Vec::new();
        scene.world.geometry.crossings(&ray, u8::MAX, &mut |candidate| candidates.push(candidate));
        marks.extend(candidates.iter().map(|candidate| mark(scene, &ray, candidate, way)));
    }
    marks.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.object.cmp(&b.object)));
    let unbalanced = unbalanced(scene, &marks);
    Line { marks, unbalanced }
}

/// - `way`: 1 where the ray runs as the line does, -1 where it runs back.
fn mark(scene: &Scene, ray: &Ray, candidate: &Candidate, way: f32) -> Mark {
    let hit = scene.world.geometry.surface(ray, candidate);
    let cosine = way * ray.direction.dot(hit.ng);
    Mark {
        t: way * hit.t,
        object: scene.world.items[hit.item as usize].object,
        side: Side::from_cosine(cosine),
        p: hit.p,
        ng: hit.ng,
        cosine: cosine.abs(),
        reach: offset_distance(hit.p, hit.p_error),
        is_thin: scene.world.is_thin(&hit),
    }
}

/// The boundaries whose crossings don't come in pairs of entering and leaving.
fn unbalanced(scene: &Scene, marks: &[Mark]) -> Vec<ObjectId> {
    let mut objects: Vec<ObjectId> =
        marks.iter().map(|mark| mark.object).filter(|&object| scene.is_boundary(object)).collect();
    objects.sort_unstable();
    objects.dedup();
    objects.retain(|&object| {
        let mut depth = 0;
        let mut is_lost = false;
        for mark in marks.iter().filter(|mark| mark.object == object) {
            depth += if mark.side == Side::Entering { 1 } else { -1 };
            is_lost |= depth < 0;
        }
        is_lost || depth != 0
    });
    objects
}
