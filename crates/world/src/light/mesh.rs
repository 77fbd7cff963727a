//! A mesh that shines, sampled by area.

use super::surface::{ShiningSides, SurfaceEmission};
use super::{Cone, DirectSample, EmissionPdf, EmissionSample, UnitBox};
use hyaline_geometry::mesh::MeshSampler;
use hyaline_geometry::{AreaSample, SurfaceHit};
use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_spectrum::Spectrum;

/// Diffuse light from all faces of a mesh.
#[derive(Clone, Debug)]
pub struct MeshLight {
    sampler: MeshSampler,
    emission: SurfaceEmission,
}

impl MeshLight {
    /// A mesh of the given radiance, W sr⁻¹ m⁻².
    pub fn new(sampler: MeshSampler, radiance: Spectrum, sides: ShiningSides) -> Self {
        Self { sampler, emission: SurfaceEmission { radiance, sides } }
    }

    pub(super) fn sample_direct(&self, p: Vec3, u: Vec2) -> Option<DirectSample> {
        self.emission.direct_by_area(p, &self.sampler.sample(u))
    }

    pub(super) fn pdf_direct(&self, p: Vec3, wi: Vec3, hit: &SurfaceHit) -> f32 {
        self.emission.pdf_by_area(p, wi, (hit.p, hit.ng), self.pdf_a())
    }

    pub(super) fn radiance_from(&self, hit: &SurfaceHit, w: Vec3) -> Spectrum {
        self.emission.radiance_toward(hit.ng, w)
    }

    pub(super) fn sample_emission(&self, u_position: Vec2, u_direction: Vec2) -> Option<EmissionSample> {
        let sample = self.sampler.sample(u_position);
        self.emission.emission(&sample, &Frame::from_normal(sample.n), u_direction)
    }

    pub(super) fn emission_at(&self, sample: &AreaSample, frame: &Frame, u: Vec2) -> Option<EmissionSample> {
        self.emission.emission(sample, frame, u)
    }

    pub(super) fn cone_at(&self, frame: &Frame, unit_box: &UnitBox) -> Cone {
        self.emission.cone(frame, unit_box)
    }

    /// A point of one face, uniform by area; its density is that of all points of the mesh.
    ///
    /// # Panics
    /// Where there is no such face.
    pub fn sample_face(&self, face: u32, u: Vec2) -> AreaSample {
        self.sampler.sample_face(face, u)
    }

    pub(super) fn pdf_emission(&self, n: Vec3, direction: Vec3) -> EmissionPdf {
        EmissionPdf { position: self.pdf_a(), direction: self.emission.pdf_of_direction(n, direction) }
    }

    pub(super) fn is_two_sided(&self) -> bool {
        self.emission.sides == ShiningSides::Both
    }

    pub(super) fn power(&self) -> Spectrum {
        self.emission.power(self.sampler.area() as f32)
    }

    /// Density of all points, m⁻².
    fn pdf_a(&self) -> f32 {
        (1.0 / self.sampler.area()) as f32
    }
}
