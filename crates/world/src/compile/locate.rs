//! What a camera or light is in, found by looking around.
//!
//! Rays in fixed directions go straight through every boundary and stop at the first opaque surface. For each solid a
//! ray votes by how often it leaves the solid before it has entered it; the majority counts. The base medium is
//! told by the first interface met: it faces the place with one of its sides. Where nothing tells, the declared medium
//! holds. Parity to infinity is never asked: one hole in a mesh would turn everything inside out.
//!
//! A lamp is not a point: its rays start at several places just off its surface in turn, and vote together. Where what
//! it faces tells nothing, they look through the lamp itself at what is behind it.

use crate::World;
use crate::world::mask;
use hyaline_geometry::{Candidate, SurfaceHit};
use hyaline_math::{Ray, Vec3, float};
use hyaline_scattering::{BoundaryKind, MediumId, MediumSet, ObjectId};
use hyaline_scene::{Note, Source};
use std::collections::BTreeMap;

/// Rays sent out; odd, so that votes seldom tie.
const RAY_COUNT: usize = 61;

/// The medium set at `places`, which are taken for one; without a place that of the declared medium.
///
/// - `lamp`: item that the places lie on, if any.
/// - `declared`: base medium where no interface tells another.
/// - `name`: what warnings call the thing at `places`.
pub(super) fn locate(
    world: &World,
    places: &[Vec3],
    lamp: Option<u32>,
    declared: MediumId,
    name: &str,
    source: &Source,
    notes: &mut Vec<Note>,
) -> MediumSet {
    let mut set = MediumSet::new(declared);
    if (0..world.object_names.len() as u32).all(|o| world.boundaries.of(ObjectId(o)) == BoundaryKind::None) {
        return set;
    }
    let look_around = |through: Option<u32>| -> Vec<View> {
        let starts = places.iter().cycle().zip(0..RAY_COUNT);
        starts.map(|(&place, i)| look(world, place, direction(i), through)).collect()
    };
    let mut views = look_around(None);
    if lamp.is_some() && views.iter().all(View::tells_nothing) {
        views = look_around(lamp);
    }
    let bases = count(views.iter().filter_map(|view| view.base));
    if let Some((&base, &votes)) = bases.iter().max_by_key(|&(_, &votes)| votes) {
        let total: usize = bases.values().sum();
        warn_if_split(name, "which medium it is in", votes, total, source, notes);
        set = MediumSet::new(base);
    }
    let solids: Vec<ObjectId> = {
        let seen: BTreeMap<ObjectId, ()> =
            views.iter().flat_map(|v| v.depths.keys().map(|&o| (o, ()))).collect();
        seen.into_keys().collect()
    };
    for solid in solids {
        let depths = count(views.iter().filter_map(|view| view.depths.get(&solid).copied()));
        let total: usize = depths.values().sum();
        if let Some((&depth, &votes)) = depths.iter().max_by_key(|&(_, &votes)| votes) {
            let what = format!("whether it is inside '{}'", world.object_names[solid.0 as usize]);
            warn_if_split(name, &what, votes, total, source, notes);
            for _ in 0..depth {
                set.enter(&world.boundaries, solid);
            }
        }
    }
    set
}

/// What one ray saw.
#[derive(Default)]
struct View {
    /// The medium on the facing side of the first interface.
    base: Option<MediumId>,
    /// For each solid seen: how many of its shells the place lies in.
    depths: BTreeMap<ObjectId, u32>,
}

impl View {
    fn tells_nothing(&self) -> bool {
        self.base.is_none() && self.depths.is_empty()
    }
}

/// - `through`: item that is looked through.
fn look(world: &World, place: Vec3, direction: Vec3, through: Option<u32>) -> View {
    let mut view = View::default();
    let mut net: BTreeMap<ObjectId, i32> = BTreeMap::new();
    let ray = Ray::new(place, direction);
    for hit in all_hits(world, &ray) {
        let object = world.items[hit.item as usize].object;
        let leaves = hit.ng.dot(direction) > 0.0;
        match world.boundaries.of(object) {
            BoundaryKind::None if through != Some(hit.item) && !world.is_thin(&hit) => break,
            BoundaryKind::None => {}
            BoundaryKind::Solid { .. } => {
                let net = net.entry(object).or_default();
                *net += if leaves { 1 } else { -1 };
                let depth = view.depths.entry(object).or_default();
                *depth = (*depth).max((*net).max(0) as u32);
            }
            BoundaryKind::Interface { outside, inside } => {
                view.base.get_or_insert(if leaves { inside } else { outside });
            }
        }
    }
    view
}

/// All surfaces along a ray, the nearest first. Asked for at once: walking on from each to the next would pass over
/// those that coincide with it.
fn all_hits(world: &World, ray: &Ray) -> impl Iterator<Item = SurfaceHit> {
    let mut candidates: Vec<Candidate> = Vec::new();
    world.geometry.crossings(ray, mask::PATH, &mut |candidate| candidates.push(candidate));
    let bounds_nothing = |candidate: &Candidate| {
        let object = world.items[candidate.item as usize].object;
        world.boundaries.of(object) == BoundaryKind::None
    };
    // What touches an opaque thing is seen before it.
    candidates.sort_by(|a, b| {
        let key = |c: &Candidate| (bounds_nothing(c), c.item, c.primitive);
        a.t.total_cmp(&b.t).then_with(|| key(a).cmp(&key(b)))
    });
    candidates.into_iter().map(|candidate| world.geometry.surface(ray, &candidate))
}

fn count<T: Ord>(votes: impl Iterator<Item = T>) -> BTreeMap<T, usize> {
    votes.fold(BTreeMap::new(), |mut counts, vote| {
        *counts.entry(vote).or_default() += 1;
        counts
    })
}

/// Warns where more than one ray in five disagrees.
fn warn_if_split(name: &str, what: &str, votes: usize, total: usize, source: &Source, notes: &mut Vec<Note>) {
    if votes * 5 < total * 4 {
        let message = format!(
            "{name}: {what} is in doubt ({votes} of {total} directions agree); close the meshes about it or name its medium"
        );
        notes.push(Note::warning(source, message));
    }
}

/// Direction `i` of an even spread over the sphere.
///
/// Source: Swinbank & Purser, Fibonacci grids, Q. J. R. Meteorol. Soc. 132, 2006.
fn direction(i: usize) -> Vec3 {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let y = 1.0 - (2.0 * i as f32 + 1.0) / RAY_COUNT as f32;
    let radius = (1.0 - y * y).max(0.0).sqrt();
    let (sin, cos) = float::sin_cos(GOLDEN_ANGLE * i as f32 + 0.3);
    Vec3::new(radius * cos, y, radius * sin)
}
