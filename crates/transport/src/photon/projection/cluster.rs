//! Parts of a mesh: groups of neighboring faces, and what bounds each.

use super::ball::{Ball, split};
use super::patch::Patch;
use hyaline_geometry::Mesh;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Transform};
use hyaline_world::light::Cone;

/// Faces that lie together.
pub(super) struct Cluster {
    pub(super) faces: Vec<u32>,
    pub(super) patch: Patch,
}

/// Cuts some faces of a mesh into at most `count` clusters of about the same number.
pub(super) fn cut(mesh: &Mesh, transform: Option<&Transform>, faces: Vec<u32>, count: u32) -> Vec<Cluster> {
    let placed = Placed { mesh, transform };
    let mut things: Vec<(u32, DVec3)> = faces.into_iter().map(|face| (face, placed.middle(face))).collect();
    let mut clusters = Vec::new();
    split(&mut things, count.max(1) as usize, &mut |&(_, middle)| middle, &mut |group| {
        if !group.is_empty() {
            let faces: Vec<u32> = group.iter().map(|&(face, _)| face).collect();
            let patch = placed.patch(&faces);
            clusters.push(Cluster { faces, patch });
        }
    });
    clusters
}

/// Area of a face in the world, square scene units.
pub(super) fn area(mesh: &Mesh, transform: Option<&Transform>, face: u32) -> f64 {
    0.5 * Placed { mesh, transform }.doubled_area(face).length()
}

/// A mesh in the world.
struct Placed<'a> {
    mesh: &'a Mesh,
    transform: Option<&'a Transform>,
}

impl Placed<'_> {
    fn corners(&self, face: u32) -> [DVec3; 3] {
        let corners = self.mesh.corners(face).map(|p| p.as_dvec3());
        corners.map(|p| self.transform.map_or(p, |transform| transform.point(p)))
    }

    fn middle(&self, face: u32) -> DVec3 {
        self.corners(face).iter().sum::<DVec3>() / 3.0
    }

    fn doubled_area(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(c - a)
    }

    /// The outward normal, of the length of twice the face's area.
    fn normal(&self, face: u32) -> DVec3 {
        let mirrors = self.transform.is_some_and(|transform| transform.is_mirroring());
        self.doubled_area(face) * if mirrors { -1.0 } else { 1.0 }
    }

    fn patch(&self, faces: &[u32]) -> Patch {
        let corners = || faces.iter().flat_map(|&face| self.corners(face));
        let (low, high) = corners()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let center = 0.5 * (low + high);
        let farthest = corners().map(|p| p.distance(center)).fold(0.0, f64::max);
        Patch { ball: Ball::about(center, farthest), normals: self.normals(faces) }
    }

    fn normals(&self, faces: &[u32]) -> Cone {
        let sum: DVec3 = faces.iter().map(|&face| self.normal(face)).sum();
        let Some(axis) = sum.try_normalize() else { return Cone::ALL };
        let angle_to = |face: &u32| {
            let half_chord = 0.5 * self.normal(*face).normalize_or(-axis).distance(axis);
            2.0 * float::asin(half_chord)
        };
        // Normals are rounded to `f32` when places are drawn.
        Cone { axis, half_angle: faces.iter().map(angle_to).fold(0.0, f64::max) }.widened(1e-6)
    }
}
