//! The direction in which a path goes on from a wide surface: drawn from its finish, and now and then along the beams of light
//! that caustics throw on it from elsewhere.
//!
//! Whatever may come of it, a direction counts by the density with which both together draw it.

use super::aim::Cones;
use crate::walk::Vertex;
use hyaline_math::{Vec2, Vec3};
use hyaline_scattering::{BsdfSample, Transport};

/// What is drawn more densely than this counts as if it were not: where the finish draws nothing at all, what a path is worth would
/// be no number.
const THINNEST: f32 = 1e-6;

/// How a path draws the direction in which it goes on.
pub(super) struct Onward {
    /// Beams beside the finish; their chance is that of being drawn from.
    beams: Option<Cones>,
}

/// A direction in which a path goes on.
pub(super) struct Drawn {
    pub(super) scattered: BsdfSample,
    /// Density with which the finish alone would have drawn it, over that with which it was drawn. Where light is drawn densely the
    /// throughput falls by this, which says nothing of what the path is worth.
    pub(super) thinned: f32,
}

impl Onward {
    /// - `beams`: none where the finish alone decides.
    pub(super) fn new(beams: Option<Cones>) -> Self {
        Self { beams }
    }

    /// Density of a direction, sr⁻¹; `of_finish` is that of the finish.
    pub(super) fn pdf(&self, of_finish: f32, wi: Vec3) -> f32 {
        match &self.beams {
            None => of_finish,
            Some(beams) => (1.0 - beams.chance()) * of_finish + beams.pdf(wi),
        }
    }

    /// A direction; `None` where the path ends.
    ///
    /// - `wo`: unit, away from the surface.
    /// - `u_lobe`, `u`: uniform in [0, 1).
    pub(super) fn sample(&self, vertex: &Vertex, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<Drawn> {
        let bsdf = &vertex.bsdf;
        let Some(beams) = &self.beams else {
            let scattered = bsdf.sample(wo, u_lobe, u, Transport::Radiance)?;
            return Some(Drawn { scattered, thinned: 1.0 });
        };
        if let Some(wi) = beams.sample(u_lobe, u) {
            let (f, of_finish) = bsdf.eval_with_pdf(wo, wi, Transport::Radiance);
            let pdf = self.pdf(of_finish, wi);
            let weight = f / pdf;
            if !weight.is_finite() || weight.is_zero() {
                return None;
            }
            let scattered = BsdfSample { wi, weight, pdf, is_delta: false, transmits: false, eta_scale: 1.0 };
            return Some(Drawn { scattered, thinned: (of_finish / pdf).max(THINNEST) });
        }
        let chance = 1.0 - beams.chance();
        let scattered = bsdf.sample(wo, (u_lobe - beams.chance()) / chance, u, Transport::Radiance)?;
        if scattered.is_delta {
            let weight = scattered.weight / chance;
            return Some(Drawn { scattered: BsdfSample { weight, ..scattered }, thinned: 1.0 });
        }
        let pdf = self.pdf(scattered.pdf, scattered.wi);
        let thinned = scattered.pdf / pdf;
        let weight = scattered.weight * thinned;
        Some(Drawn { scattered: BsdfSample { weight, pdf, ..scattered }, thinned })
    }
}
