//! Photons in homogeneous media: not the points where they scatter, but their whole ways.
//!
//! A path gathers from all beams that its own way passes within the radius (a kernel in one dimension, across both), so
//! thin fog shows no grain: a photon counts all along its way, and the path gathers all along its own. In media with a
//! grid photons are points, for nobody knows there what a beam carries along its way.
//!
//! Beams are cut in pieces, and a tree of boxes holds them, each box grown by the largest radius in it.
//!
//! Source: Jarosz, Nowrouzezahrai, Thomas, Sloan & Zwicker, Progressive photon beams, ACM TOG 30(6), 2011, eq. 13.

use super::landed::PhotonId;
use super::origin::Origin;
use crate::integrator::eye::radius::GatherRadius;
use hyaline_math::{Bounds, Ray, Vec3};
use hyaline_scattering::MediumId;
use hyaline_scattering::volume::BeamWeight;
use hyaline_spectrum::Spectrum;

/// Pieces per beam, on average: enough to keep boxes slim.
const PIECES: f32 = 6.0;
/// Pieces of one beam, at most.
const MOST_PIECES: f32 = 64.0;
/// Pieces in a leaf.
const LEAF: usize = 4;

/// The way of a photon through a medium.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Beam {
    pub(in crate::integrator) origin: Vec3,
    /// The way it travels, unit.
    pub(in crate::integrator) direction: Vec3,
    pub(in crate::integrator) length: f32,
    pub(in crate::integrator) medium: MediumId,
    /// W, at its origin, over all photons of its sender in the pass.
    pub(in crate::integrator) flux: Spectrum,
    /// What is left of it on the way.
    pub(in crate::integrator) weight: BeamWeight,
    /// Where it comes from, if straight from there.
    pub(in crate::integrator) straight_from: Option<Origin>,
    /// See `LandedPhoton::others`; without sampling the light where the beam comes straight from it.
    pub(in crate::integrator) others: f32,
    /// Scatterings before it started, singular ones not counted.
    pub(in crate::integrator) bounces: u32,
    pub(in crate::integrator) id: PhotonId,
}

/// Where a ray passes a beam.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Passing {
    /// On the ray and on the beam, distances from their origins.
    pub(in crate::integrator) on_ray: f32,
    pub(in crate::integrator) on_beam: f32,
    /// Sine of the angle between the two.
    pub(in crate::integrator) sin: f32,
    /// The radius there.
    pub(in crate::integrator) radius: f32,
}

/// A piece of a beam, with what tells whether it is passed.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Of the beam, like the direction.
    origin: Vec3,
    direction: Vec3,
    /// Distances from the beam's origin.
    from: f32,
    to: f32,
    beam: u32,
}

/// A box about pieces: inner nodes have their two children at `first` and `first + 1`.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    first: u32,
    /// Pieces of a leaf; 0 in inner nodes.
    count: u32,
}

/// All beams of a pass.
pub(super) struct Beams {
    beams: Vec<Beam>,
    pieces: Vec<Piece>,
    nodes: Vec<Node>,
    radius: GatherRadius,
}

impl Beams {
    pub(super) fn new(beams: Vec<Beam>, radius: GatherRadius) -> Self {
        let mut pieces = cut(&beams, &radius);
        let mut nodes = Vec::new();
        if !pieces.is_empty() {
            nodes.push(Node { bounds: Bounds::EMPTY, first: 0, count: 0 });
            split(&mut pieces, 0, 0, &mut nodes);
        }
        let pieces = pieces.into_iter().map(|(_, piece)| piece).collect();
        Self { beams, pieces, nodes, radius }
    }

    /// Visits every beam of a medium that a ray passes within the radius.
    ///
    /// - `length`: of the ray, scene units.
    pub(super) fn passed(
        &self,
        ray: &Ray,
        length: f32,
        medium: MediumId,
        mut visit: impl FnMut(&Beam, &Passing),
    ) {
        let inverse = ray.direction.recip();
        // A tree of 2³² pieces is 32 deep.
        let mut stack = [0u32; 40];
        let mut depth = usize::from(!self.nodes.is_empty());
        while depth > 0 {
            depth -= 1;
            let index = stack[depth];
            let node = &self.nodes[index as usize];
            if !meets(&node.bounds, ray.origin, inverse, length) {
                continue;
            }
            if node.count == 0 {
                stack[depth..depth + 2].copy_from_slice(&[node.first + 1, node.first]);
                depth += 2;
                continue;
            }
            for piece in &self.pieces[node.first as usize..][..node.count as usize] {
                let Some(passing) = self.passing(ray, length, piece) else { continue };
                let beam = &self.beams[piece.beam as usize];
                if beam.medium == medium {
                    visit(beam, &passing);
                }
            }
        }
    }

    fn passing(&self, ray: &Ray, length: f32, piece: &Piece) -> Option<Passing> {
        let across = ray.direction.cross(piece.direction);
        let sin_squared = across.length_squared();
        if sin_squared < 1e-10 {
            return None;
        }
        let between = piece.origin - ray.origin;
        let on_beam = between.cross(ray.direction).dot(across) / sin_squared;
        if !(on_beam >= piece.from && on_beam < piece.to) {
            return None;
        }
        let on_ray = between.cross(piece.direction).dot(across) / sin_squared;
        if !(on_ray > 0.0 && on_ray < length) {
            return None;
        }
        let radius = self.radius.of_beams(ray.at(on_ray));
        let sin = sin_squared.sqrt();
        (between.dot(across).abs() < radius * sin).then_some(Passing { on_ray, on_beam, sin, radius })
    }
}

/// Beams in pieces of about one length, each with its box.
fn cut(beams: &[Beam], radius: &GatherRadius) -> Vec<(Bounds, Piece)> {
    let total: f32 = beams.iter().map(|beam| beam.length).sum();
    let length = total / (beams.len() as f32 * PIECES);
    let mut pieces = Vec::with_capacity(beams.len() * (PIECES as usize + 1));
    for (index, beam) in beams.iter().enumerate() {
        let count = (beam.length / length).ceil().clamp(1.0, MOST_PIECES);
        for i in 0..count as u32 {
            let end = |i: f32| beam.length * (i / count);
            let (from, to) = (end(i as f32), end(i as f32 + 1.0));
            let bounds = Bounds::from_points([from, to].map(|t| beam.origin + beam.direction * t));
            let bounds = bounds.expanded(radius.of_beams_within(&bounds));
            let Beam { origin, direction, .. } = *beam;
            pieces.push((bounds, Piece { origin, direction, from, to, beam: index as u32 }));
        }
    }
    pieces
}

/// Halves pieces by their middles along the longest axis; `first` is the index of the first of them among all.
fn split(pieces: &mut [(Bounds, Piece)], node: usize, first: u32, nodes: &mut Vec<Node>) {
    let bounds = pieces.iter().fold(Bounds::EMPTY, |bounds, piece| bounds.union(piece.0));
    if pieces.len() <= LEAF {
        nodes[node] = Node { bounds, first, count: pieces.len() as u32 };
        return;
    }
    let middles = Bounds::from_points(pieces.iter().map(|piece| piece.0.center()));
    let axis = middles.size().to_array();
    let axis = (0..3).fold(0, |best, i| if axis[i] > axis[best] { i } else { best });
    let half = pieces.len() / 2;
    let key = |piece: &(Bounds, Piece)| (piece.0.center()[axis], piece.1.beam, piece.1.from);
    pieces.select_nth_unstable_by(half, |a, b| {
        key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal)
    });
    let children = nodes.len() as u32;
    nodes[node] = Node { bounds, first: children, count: 0 };
    nodes.extend([nodes[node]; 2]);
    let (low, high) = pieces.split_at_mut(half);
    split(low, children as usize, first, nodes);
    split(high, children as usize + 1, first + half as u32, nodes);
}

/// Whether a ray of this length meets a box.
fn meets(bounds: &Bounds, origin: Vec3, inverse: Vec3, length: f32) -> bool {
    let (a, b) = ((bounds.min - origin) * inverse, (bounds.max - origin) * inverse);
    let (near, far) = (a.min(b), a.max(b));
    near.max_element().max(0.0) <= far.min_element().min(length)
}
