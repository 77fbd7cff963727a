//! Points drawn uniformly by area on a mesh.

use super::doubled_area;
use crate::bvh::MeshBvh;
use crate::primitive::AreaSample;
use hyaline_math::{Transform, Vec2};
use std::sync::Arc;

/// Draws points uniformly by area on a mesh; built where a mesh is a light.
///
/// A face is found by bisection of the running sum of areas, which keeps neighboring random numbers on neighboring
/// faces, so a stratified sequence stays stratified.
#[derive(Clone, Debug)]
pub struct MeshSampler {
    mesh: Arc<MeshBvh>,
    transform: Option<Transform>,
    /// Fraction of the area in the faces up to and including each one.
    cumulative: Vec<f64>,
    area: f64,
}

impl MeshSampler {
    /// Adds up the areas of the faces as they lie in the world.
    ///
    /// - `transform`: from the mesh to the world; `None` where the mesh is in world space.
    pub fn new(mesh: Arc<MeshBvh>, transform: Option<Transform>) -> Self {
        let mut cumulative: Vec<f64> = Vec::with_capacity(mesh.mesh().face_count());
        let mut area = 0.0;
        for face in 0..mesh.mesh().face_count() as u32 {
            let local = mesh.mesh().corners(face).map(|p| p.as_dvec3());
            let corners = local.map(|p| transform.as_ref().map_or(p, |t| t.point(p)));
            area += 0.5 * doubled_area(corners).length();
            cumulative.push(area);
        }
        for sum in &mut cumulative {
            *sum /= area;
        }
        Self { mesh, transform, cumulative, area }
    }

    /// Area in the world, square scene units.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// A point on the mesh, uniform by area.
    ///
    /// - `u2`: uniform in [0, 1)².
    pub fn sample(&self, u2: Vec2) -> AreaSample {
        let (face, rest) = self.choose_face(u2.x);
        self.sample_face(face, Vec2::new(rest, u2.y))
    }

    /// A point of one face, uniform by area; `pdf_a` is the density of all points of the mesh.
    ///
    /// - `u2`: uniform in [0, 1)².
    ///
    /// # Panics
    /// Where there is no such face.
    pub fn sample_face(&self, face: u32, u2: Vec2) -> AreaSample {
        let point = self.mesh.mesh().point(face, square_to_triangle(u2.x, u2.y), self.transform.as_ref());
        AreaSample { p: point.p, p_error: point.p_error, n: point.ng, pdf_a: (1.0 / self.area) as f32 }
    }

    /// The face that `u` falls in, and where in it, 0…1.
    fn choose_face(&self, u: f32) -> (u32, f32) {
        let u = f64::from(u);
        let face = self.cumulative.partition_point(|&sum| sum <= u).min(self.cumulative.len() - 1);
        let start = if face == 0 { 0.0 } else { self.cumulative[face - 1] };
        let rest = (u - start) / (self.cumulative[face] - start);
        (face as u32, rest.clamp(0.0, 1.0) as f32)
    }
}

/// Uniform barycentric coordinates of the second and third vertex.
///
/// Source: Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
fn square_to_triangle(x: f32, y: f32) -> Vec2 {
    if y > x {
        let half = 0.5 * x;
        Vec2::new(half, y - half)
    } else {
        let half = 0.5 * y;
        Vec2::new(x - half, half)
    }
}
