//! Parts of a mesh: groups of neighboring pieces of faces, and what bounds each.
//!
//! A face that is large for its mesh is cut into pieces: boxes of the random numbers that its points are drawn with.
//! Pieces that lie together then make a cluster.

use super::ball::Ball;
use super::neighbors::groups;
use super::patch::Patch;
use hyaline_geometry::Mesh;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec2, DVec3, Transform};
use hyaline_sampling::warp;
use hyaline_world::light::{Cone, UnitBox};
use rayon::prelude::*;

/// Pieces along each random number of a face, at most.
const FINEST: f64 = 64.0;

/// A face or a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) face: u32,
    /// Which box of the unit square: column and row of `size` each.
    cell: [u16; 2],
    size: u16,
    /// Share of the area of all faces that were cut.
    pub(super) share: f32,
}

impl Piece {
    /// The random numbers that give its points.
    pub(super) fn unit_box(&self) -> UnitBox {
        let corner = |i: u16| {
            let along = |cell: u16| f64::from(cell + i) / f64::from(self.size);
            DVec2::new(along(self.cell[0]), along(self.cell[1]))
        };
        UnitBox { min: corner(0), max: corner(1) }
    }
}

/// Pieces that lie together.
pub(super) struct Cluster {
    pub(super) pieces: Vec<Piece>,
    pub(super) patch: Patch,
}

/// Cuts some faces of a mesh into at most `count` clusters of about the same number of pieces.
pub(super) fn cut(mesh: &Mesh, transform: Option<&Transform>, faces: &[u32], count: u32) -> Vec<Cluster> {
    let placed = Placed::new(mesh, transform);
    placed.grouped(faces, count, |pieces| Cluster { patch: placed.patch(&pieces), pieces })
}

/// The balls about the clusters that `cut` makes.
pub(super) fn balls(mesh: &Mesh, transform: Option<&Transform>, faces: &[u32], count: u32) -> Vec<Ball> {
    let placed = Placed::new(mesh, transform);
    placed.grouped(faces, count, |pieces| placed.ball(&pieces))
}

/// A mesh in the world.
struct Placed<'a> {
    mesh: &'a Mesh,
    transform: Option<&'a Transform>,
    /// Weights of the corners of a piece that is a whole face: in large meshes all are.
    whole: [DVec3; 4],
}

impl<'a> Placed<'a> {
    fn new(mesh: &'a Mesh, transform: Option<&'a Transform>) -> Self {
        Self { mesh, transform, whole: corner_weights(&UnitBox { min: DVec2::ZERO, max: DVec2::ONE }) }
    }

    /// What becomes of each group of neighboring pieces.
    fn grouped<T: Send>(&self, faces: &[u32], count: u32, make: impl Fn(Vec<Piece>) -> T + Sync) -> Vec<T> {
        let pieces = self.pieces(faces, count);
        let middles = pieces.par_iter().map(|piece| self.corners(piece).iter().sum::<DVec3>() * 0.25);
        let groups = groups(middles, count.max(1) as usize).into_par_iter();
        groups.map(|group| make(group.into_iter().map(|index| pieces[index as usize]).collect())).collect()
    }

    fn vertices(&self, face: u32) -> [DVec3; 3] {
        let vertices = self.mesh.corners(face).map(|p| p.as_dvec3());
        vertices.map(|p| self.transform.map_or(p, |transform| transform.point(p)))
    }

    fn doubled_area(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.vertices(face);
        (b - a).cross(c - a)
    }

    /// The pieces of some faces: each of about the same area where the mesh has few faces.
    fn pieces(&self, faces: &[u32], count: u32) -> Vec<Piece> {
        let areas: Vec<f64> = faces.par_iter().map(|&face| self.doubled_area(face).length()).collect();
        let total: f64 = areas.iter().sum();
        let mut pieces = Vec::with_capacity(faces.len());
        for (&face, area) in faces.iter().zip(areas) {
            let size = (f64::from(count) * area / total).sqrt().round().clamp(1.0, FINEST) as u16;
            let share = (area / total / f64::from(size).powi(2)) as f32;
            for y in 0..size {
                pieces.extend((0..size).map(|x| Piece { face, cell: [x, y], size, share }));
            }
        }
        pieces
    }

    /// Points whose convex hull holds a piece: the map from the square is linear on both sides of its diagonal, and
    /// the diagonal passes boxes from corner to corner.
    fn corners(&self, piece: &Piece) -> [DVec3; 4] {
        let [a, b, c] = self.vertices(piece.face);
        let weights = if piece.size == 1 { self.whole } else { corner_weights(&piece.unit_box()) };
        weights.map(|weights| b * weights.x + c * weights.y + a * weights.z)
    }

    /// The outward normal, of the length of twice the face's area.
    fn normal(&self, face: u32) -> DVec3 {
        let mirrors = self.transform.is_some_and(|transform| transform.is_mirroring());
        self.doubled_area(face) * if mirrors { -1.0 } else { 1.0 }
    }

    fn patch(&self, pieces: &[Piece]) -> Patch {
        Patch { ball: self.ball(pieces), normals: self.normals(pieces) }
    }

    fn ball(&self, pieces: &[Piece]) -> Ball {
        // Kept: neighbors are rarely neighbors in the mesh, so finding their vertices takes longer.
        let corners: Vec<[DVec3; 4]> = pieces.iter().map(|piece| self.corners(piece)).collect();
        let corners = || corners.as_flattened().iter();
        let (low, high) = corners()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let center = 0.5 * (low + high);
        let farthest = corners().map(|p| p.distance(center)).fold(0.0, f64::max);
        Ball::about(center, farthest)
    }

    fn normals(&self, pieces: &[Piece]) -> Cone {
        let sum: DVec3 = pieces.iter().map(|piece| self.normal(piece.face)).sum();
        let Some(axis) = sum.try_normalize() else { return Cone::ALL };
        let angle_to = |piece: &Piece| {
            let half_chord = 0.5 * self.normal(piece.face).normalize_or(-axis).distance(axis);
            2.0 * float::asin(half_chord)
        };
        // Normals are rounded to `f32` when places are drawn.
        Cone { axis, half_angle: pieces.iter().map(angle_to).fold(0.0, f64::max) }.widened(1e-6)
    }
}

/// What the vertices of a face weigh at the corners of a box: the second, the third and the first.
fn corner_weights(unit_box: &UnitBox) -> [DVec3; 4] {
    [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE]
        .map(|u| warp::sample_triangle(unit_box.at(u).as_vec2()).as_dvec3())
}
