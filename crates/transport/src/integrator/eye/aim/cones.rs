//! Cones of directions, mixed with those of a finish or phase function.

use super::AIMED;
use crate::walk::Vertex;
use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_sampling::warp;
use hyaline_scattering::{BsdfSample, Transport};
use smallvec::SmallVec;

/// Versine of the narrowest cone: `f32` directions are no finer.
const NARROWEST: f32 = 1e-5;

/// Directions about an axis.
#[derive(Clone, Copy, Debug)]
struct Cone {
    axis: Vec3,
    /// 1 - the cosine of the half-angle.
    versine: f32,
    share: f32,
    /// Density of its directions, sr⁻¹, times its share.
    density: f32,
}

/// Cones of directions, each with a share.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct Cones {
    cones: SmallVec<[Cone; 12]>,
    pub(super) total: f32,
}

impl Cones {
    pub(super) fn push(&mut self, axis: Vec3, versine: f32, share: f32) {
        let versine = versine.max(NARROWEST);
        self.cones.push(Cone { axis, versine, share, density: share * warp::pdf_cone(versine) });
        self.total += share;
    }

    /// Draws a direction from the finish or from the cones; the density is that of the mixture.
    pub(in super::super) fn scatter(
        &self,
        vertex: &Vertex,
        wo: Vec3,
        u_lobe: f32,
        u: Vec2,
    ) -> Option<BsdfSample> {
        let u_lobe = match self.choose(u_lobe, u) {
            Choice::Aimed(wi) => return self.aimed(vertex, wo, wi),
            Choice::Free(u_lobe) => u_lobe,
        };
        let sample = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance)?;
        let pdf = match sample.is_delta {
            true => sample.pdf * (1.0 - AIMED),
            false => self.density(sample.pdf, sample.wi),
        };
        Some(BsdfSample { weight: sample.weight * (sample.pdf / pdf), pdf, ..sample })
    }

    fn aimed(&self, vertex: &Vertex, wo: Vec3, wi: Vec3) -> Option<BsdfSample> {
        let (f, pdf) = vertex.bsdf.eval_with_pdf(wo, wi, Transport::Radiance);
        let pdf = self.density(pdf, wi);
        let weight = f / pdf;
        let is_usable = weight.is_finite() && !weight.is_zero();
        is_usable.then_some(BsdfSample { wi, weight, pdf, is_delta: false, transmits: false, eta_scale: 1.0 })
    }

    /// Whether to aim, and at what.
    ///
    /// - `u_choice`, `u`: uniform in [0, 1).
    pub(in super::super) fn choose(&self, u_choice: f32, u: Vec2) -> Choice {
        if u_choice >= AIMED {
            return Choice::Free((u_choice - AIMED) / (1.0 - AIMED));
        }
        let mut left = u_choice / AIMED * self.total;
        let is_chosen = |cone: &&Cone| {
            left -= cone.share;
            left < 0.0
        };
        // Rounding may leave a little beyond the last one.
        let Cone { axis, versine, .. } =
            self.cones.iter().find(is_chosen).unwrap_or(&self.cones[self.cones.len() - 1]);
        Choice::Aimed(Frame::from_normal(*axis).to_world(warp::sample_cone(u, *versine)).normalize())
    }

    /// Density of the mixture, sr⁻¹, where that of the finish or phase function is `pdf`.
    pub(in super::super) fn density(&self, pdf: f32, wi: Vec3) -> f32 {
        pdf * (1.0 - AIMED) + self.pdf(wi) * AIMED
    }

    fn pdf(&self, wi: Vec3) -> f32 {
        let within = |cone: &&Cone| 0.5 * (wi - cone.axis).length_squared() <= cone.versine;
        let density: f32 = self.cones.iter().filter(within).map(|cone| cone.density).sum();
        density / self.total
    }
}

/// What a mixture has chosen.
pub(in super::super) enum Choice {
    /// A direction from the cones.
    Aimed(Vec3),
    /// The finish or phase function, with what is left of the number that chose: uniform in [0, 1) again.
    Free(f32),
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;
    use std::f32::consts::TAU;

    fn overlapping() -> Cones {
        let mut cones = Cones::default();
        cones.push(Vec3::Z, 0.01, 1.0);
        cones.push(Vec3::new(0.1, 0.0, 1.0).normalize(), 0.03, 0.5);
        cones.push(Vec3::X, 0.2, 2.0);
        cones
    }

    #[test]
    fn directions_come_at_their_density() {
        let cones = overlapping();
        let mut random = Random::from_seed(3);
        let mut found = [0.0_f64; 3];
        let count = 200_000;
        for _ in 0..count {
            let u = Vec2::new(random.uniform_f32(), random.uniform_f32());
            let Choice::Aimed(wi) = cones.choose(random.uniform_f32() * AIMED, u) else {
                panic!("not aimed")
            };
            // A margin keeps the edges' rounding out of it.
            for (solid_angle, Cone { axis, versine, .. }) in found.iter_mut().zip(&cones.cones) {
                let is_in = 0.5 * (wi - *axis).length_squared() <= 0.99 * versine;
                *solid_angle += if is_in { 1.0 / f64::from(cones.pdf(wi)) } else { 0.0 };
            }
        }
        for (solid_angle, Cone { versine, .. }) in found.into_iter().zip(&cones.cones) {
            let expected = f64::from(TAU * 0.99 * versine);
            let mean = solid_angle / f64::from(count);
            assert!((mean / expected - 1.0).abs() < 0.02, "{mean}, not {expected}");
        }
    }

    #[test]
    fn what_is_left_of_the_choice_is_uniform_again() {
        let cones = overlapping();
        let left = |u| match cones.choose(u, Vec2::splat(0.5)) {
            Choice::Free(rest) => Some(rest),
            Choice::Aimed(_) => None,
        };
        assert_eq!(left(AIMED), Some(0.0));
        assert_eq!(left(AIMED + 0.5 * (1.0 - AIMED)), Some(0.5));
        assert_eq!(left(0.99 * AIMED), None);
    }
}
