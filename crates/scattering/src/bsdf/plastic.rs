//! A matte base under a polished clear coat: a mirror direction over an even glow.

use super::coat::polished_base_factor;
use super::local::{LocalBranch, LocalSample, mirrored};
use hyaline_math::{Vec2, Vec3};
use hyaline_optics::{diffuse_fresnel, fresnel_dielectric};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;

/// A matte base under a polished clear coat, seen and lit from +z. One part of it is a single direction, the other an
/// even lobe: f = base T(wo) T(wi) / π, T = 1 - F.
///
/// Over a white base it gives back all light, from every direction.
/// Source: see [`super::coat`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    eta: f32,
    specular: Spectrum,
    /// Factor of the base; see `base_factor`.
    base: Spectrum,
    /// Mean of T over evenly spread directions.
    mean_transmittance: f32,
}

impl Plastic {
    /// - `eta`: index of the coat over that of its surroundings, > 0.
    /// - `diffuse`: reflectance of the base, 0…1.
    /// - `specular`: factor on what the coat reflects, 0…1.
    /// - `nonlinear`: whether light between base and coat takes the color of the base each time.
    pub fn new(eta: f32, diffuse: Spectrum, specular: Spectrum, nonlinear: bool) -> Self {
        let base = polished_base_factor(diffuse, eta, nonlinear);
        Self { eta, specular, base, mean_transmittance: 1.0 - diffuse_fresnel(eta) }
    }

    fn transmittance(&self, cos: f32) -> f32 {
        1.0 - fresnel_dielectric(cos.min(1.0), self.eta)
    }

    /// The mirror direction of the coat.
    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        let fraction = fresnel_dielectric(wo.z.clamp(0.0, 1.0), self.eta);
        let branch = LocalBranch { wi: mirrored(wo), fraction, tint: self.specular, transmits: false };
        [(wo.z > 0.0).then_some(branch), None]
    }

    pub(super) fn sample(&self, wo: Vec3, u_lobe: f32, u2: Vec2, lanes: usize) -> Option<LocalSample> {
        let chance = self.chance_of_coat(wo, lanes)?;
        if u_lobe < chance {
            let branch = self.branches(wo)[0]?;
            let weight = branch.weight() / chance;
            return Some(LocalSample {
                wi: branch.wi,
                weight,
                pdf: chance,
                is_delta: true,
                transmits: false,
            });
        }
        let wi = warp::sample_cosine_hemisphere(u2);
        let pdf = (1.0 - chance) * warp::pdf_cosine_hemisphere(wi.z);
        let weight = self.eval(wo, wi) / pdf;
        (pdf > 0.0).then_some(LocalSample { wi, weight, pdf, is_delta: false, transmits: false })
    }

    /// The even part.
    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Spectrum::ZERO;
        }
        self.base * (self.transmittance(wo.z) * self.transmittance(wi.z) * warp::pdf_cosine_hemisphere(wi.z))
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3, lanes: usize) -> f32 {
        self.chance_of_coat(wo, lanes)
            .map_or(0.0, |chance| (1.0 - chance) * warp::pdf_cosine_hemisphere(wi.z))
    }

    pub(super) fn albedo_estimate(&self) -> Spectrum {
        let through = self.transmittance(1.0);
        self.base * (through * self.mean_transmittance) + self.specular * (1.0 - through)
    }

    /// Probability of the mirror direction, in proportion to the power; `None` where nothing is reflected.
    fn chance_of_coat(&self, wo: Vec3, lanes: usize) -> Option<f32> {
        if wo.z <= 0.0 {
            return None;
        }
        let through = self.transmittance(wo.z);
        let coat = self.specular.mean(lanes) * (1.0 - through);
        let base = self.base.mean(lanes) * through * self.mean_transmittance;
        (coat + base > 0.0).then(|| coat / (coat + base))
    }
}
