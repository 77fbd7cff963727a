//! Phase functions of a medium, sampled and evaluated between directions.

use hyaline_math::{Frame, Vec2, Vec3, float};
use hyaline_optics::phase;
use std::f32::consts::TAU;

/// Where a medium sends the light that it scatters; see `hyaline_optics::phase` for the laws.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Phase {
    /// Alike in all directions.
    #[default]
    Isotropic,
    /// Henyey and Greenstein's.
    HenyeyGreenstein {
        /// Mean cosine, -1…1 exclusive; positive scatters forward.
        g: f32,
    },
    /// Of particles much smaller than the wavelength.
    Rayleigh,
    /// Two of Henyey and Greenstein's together.
    DoubleHenyeyGreenstein {
        /// Mean cosines, -1…1 exclusive.
        g: [f32; 2],
        /// Share of the second, 0…1.
        weight: f32,
    },
}

impl Phase {
    /// The phase function, sr⁻¹, which is the density of `sample` as well.
    ///
    /// - `wo`: unit, back along the path; `wi`: unit, where the path goes on.
    pub fn value(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.of_cosine(-wo.dot(wi))
    }

    /// Draws the direction in which a path goes on, with the density `value`.
    ///
    /// - `wo`: unit, back along the path.
    /// - `u`: uniform in [0, 1)².
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let (cos_theta, u_phi) = self.sample_cosine(u);
        let sin_theta = (1.0 - cos_theta * cos_theta).max(0.0).sqrt();
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u_phi);
        Frame::from_normal(-wo).to_world(Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta))
    }

    /// Mean cosine of the scattering angle, -1…1.
    pub fn mean_cosine(&self) -> f32 {
        match *self {
            Self::Isotropic | Self::Rayleigh => 0.0,
            Self::HenyeyGreenstein { g } => g,
            Self::DoubleHenyeyGreenstein { g, weight } => g[0] + weight * (g[1] - g[0]),
        }
    }

    fn of_cosine(&self, cos_theta: f32) -> f32 {
        match *self {
            Self::Isotropic => phase::ISOTROPIC,
            Self::HenyeyGreenstein { g } => phase::henyey_greenstein(cos_theta, g),
            Self::Rayleigh => phase::rayleigh(cos_theta),
            Self::DoubleHenyeyGreenstein { g, weight } => {
                let [first, second] = g.map(|g| phase::henyey_greenstein(cos_theta, g));
                first + weight * (second - first)
            }
        }
    }

    /// A cosine, and the second random number or what is left of it.
    fn sample_cosine(&self, u: Vec2) -> (f32, f32) {
        match *self {
            Self::Isotropic => (1.0 - 2.0 * u.x, u.y),
            Self::HenyeyGreenstein { g } => (phase::sample_henyey_greenstein(g, u.x), u.y),
            Self::Rayleigh => (phase::sample_rayleigh(u.x), u.y),
            Self::DoubleHenyeyGreenstein { g, weight } => {
                let (g, u_phi) =
                    if u.y < weight { (g[1], u.y / weight) } else { (g[0], (u.y - weight) / (1.0 - weight)) };
                (phase::sample_henyey_greenstein(g, u.x), u_phi.min(float::ONE_MINUS_EPSILON))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{Random, chi_square_sphere, integrate_sphere};

    fn all() -> [Phase; 5] {
        [
            Phase::Isotropic,
            Phase::HenyeyGreenstein { g: 0.6 },
            Phase::HenyeyGreenstein { g: -0.3 },
            Phase::Rayleigh,
            Phase::DoubleHenyeyGreenstein { g: [0.7, -0.4], weight: 0.3 },
        ]
    }

    #[test]
    fn directions_follow_the_density_about_the_way_the_light_travels() {
        let wo = Vec3::new(0.48, -0.6, 0.64);
        for phase in all() {
            let mut random = Random::from_seed(3);
            let sample = || {
                let wi = phase.sample(wo, Vec2::new(random.uniform_f32(), random.uniform_f32()));
                Some(wi.as_dvec3().to_array())
            };
            let density =
                |w: [f64; 3]| f64::from(phase.value(wo, hyaline_math::DVec3::from_array(w).as_vec3()));
            let result = chi_square_sphere(sample, density, 100_000, 16, 32);
            assert!(result.p_value > 1e-3, "{phase:?}: {result:?}");
        }
    }

    #[test]
    fn light_is_conserved_and_its_mean_cosine_is_as_stated() {
        let wo = Vec3::new(0.0, 0.6, 0.8);
        let direction = |w: [f64; 3]| hyaline_math::DVec3::from_array(w).as_vec3();
        for phase in all() {
            let total = integrate_sphere(|w| f64::from(phase.value(wo, direction(w))), 200, 200);
            assert!((total - 1.0).abs() < 1e-3, "{phase:?}: {total}");
            let mean = |w| f64::from(phase.value(wo, direction(w)) * -wo.dot(direction(w)));
            let mean = integrate_sphere(mean, 200, 200);
            assert!((mean - f64::from(phase.mean_cosine())).abs() < 1e-3, "{phase:?}: {mean}");
        }
    }

    #[test]
    fn both_directions_count_alike() {
        let (a, b) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -1.0, 0.0));
        for phase in all() {
            assert_eq!(phase.value(a, b), phase.value(b, a));
        }
    }
}
