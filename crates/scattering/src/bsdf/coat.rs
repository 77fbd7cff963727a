//! What a clear coat does to light on its way to a matte base and back, prepared once for a finish.
//!
//! 1. From a direction above, part of the light gets through the coat: `transmittance`.
//! 2. The base scatters it evenly, and the coat sends part of that back to the base: `internal_reflectance`, again
//!    and again: a geometric series.
//! 3. The rest leaves, through the coat once more.
//!
//! A polished coat has closed forms. For a rough one the transmittance is computed at a few angles, and a polynomial
//! joins them.
//!
//! Source: Weidlich & Wilkie, Arbitrarily Layered Micro-Facet Surfaces, GRAPHITE 2007, for the model; Jakob et al.,
//! Mitsuba 3, plugins `plastic` and `roughplastic`, for what is taken as the base's color.

use super::local::MIN_ALPHA;
use hyaline_math::{Vec3, float};
use hyaline_optics::{Ggx, diffuse_fresnel, fresnel_dielectric, reflect, refract};
use hyaline_spectrum::Spectrum;
use std::f32::consts::PI;

/// Coefficients of the polynomial.
const ORDER: usize = 8;

/// Points along either axis of the grid over which facets are summed.
const FACETS: [usize; 2] = [48, 24];

/// Angles over which the light that is sent back to the base is summed: it jumps where total reflection begins.
const INTERNAL_ANGLES: usize = 48;

/// Steps of roughness between the coats of a table.
const STEPS: usize = 12;

/// A rough coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughCoat {
    /// Chebyshev coefficients of the transmittance over the cosine.
    transmittance: [f32; ORDER],
    /// Fraction of evenly scattered light that the coat sends back to the base, 0…1.
    internal_reflectance: f32,
}

impl RoughCoat {
    /// Sums over the facets.
    ///
    /// - `eta`: index of the coat over that of its surroundings, > 0.
    /// - `alpha`: GGX width, `MIN_ALPHA`…1.
    pub fn new(eta: f32, alpha: f32) -> Self {
        let ggx = Ggx::isotropic(alpha);
        let cosines = (0..INTERNAL_ANGLES).map(|i| (i as f32 + 0.5) / INTERNAL_ANGLES as f32);
        let internal: f32 = cosines.map(|cos| 2.0 * cos * passed(&ggx, cos, 1.0 / eta)[0]).sum();
        Self {
            transmittance: chebyshev(nodes().map(|cos| passed(&ggx, cos, eta)[1])),
            internal_reflectance: internal / INTERNAL_ANGLES as f32,
        }
    }

    /// The coat between two, for roughness that varies: `self` at 0, `other` at 1.
    fn lerp(&self, other: &Self, t: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * t;
        Self {
            transmittance: std::array::from_fn(|i| mix(self.transmittance[i], other.transmittance[i])),
            internal_reflectance: mix(self.internal_reflectance, other.internal_reflectance),
        }
    }

    /// Fraction of light at the cosine `cos`, 0…1, that reaches the base.
    pub(super) fn transmittance(&self, cos: f32) -> f32 {
        // [Clenshaw, A note on the summation of Chebyshev series, 1955]
        let x = 2.0 * cos - 1.0;
        let (mut b1, mut b2) = (0.0, 0.0);
        for &c in self.transmittance[1..].iter().rev() {
            (b1, b2) = (2.0 * x * b1 - b2 + c, b1);
        }
        (x * b1 - b2 + self.transmittance[0]).clamp(0.0, 1.0)
    }

    /// Factor of the base; see [`base_factor`].
    pub(super) fn base_factor(&self, reflectance: Spectrum, eta: f32, nonlinear: bool) -> Spectrum {
        base_factor(reflectance, eta, self.internal_reflectance, nonlinear)
    }
}

/// The coats of a finish, for every roughness that it may have.
#[derive(Clone, Debug)]
pub struct CoatTable {
    /// One, or one for every step of √alpha.
    coats: Vec<RoughCoat>,
}

impl CoatTable {
    /// For the same roughness everywhere.
    ///
    /// - `eta`: index of the coat over that of its surroundings, > 0.
    /// - `alpha`: GGX width, 0…1.
    pub fn uniform(eta: f32, alpha: f32) -> Self {
        Self { coats: vec![RoughCoat::new(eta, alpha.max(MIN_ALPHA))] }
    }

    /// For roughness that varies over the surface.
    pub fn varying(eta: f32) -> Self {
        let alpha = |i: usize| (i as f32 / STEPS as f32).powi(2).max(MIN_ALPHA);
        Self { coats: (0..=STEPS).map(|i| RoughCoat::new(eta, alpha(i))).collect() }
    }

    /// The coat of width `alpha`, 0…1.
    pub(super) fn at(&self, alpha: f32) -> RoughCoat {
        if let [only] = self.coats[..] {
            return only;
        }
        let position = alpha.clamp(0.0, 1.0).sqrt() * STEPS as f32;
        let below = (position as usize).min(STEPS - 1);
        self.coats[below].lerp(&self.coats[below + 1], position - below as f32)
    }
}

/// What the base sends up below the coat, over what arrives there: the value of the finish is this times both
/// transmittances over π.
///
/// - `reflectance`: of the base, 0…1.
/// - `nonlinear`: whether the light that goes back and forth takes the color of the base each time.
pub(super) fn base_factor(
    reflectance: Spectrum,
    eta: f32,
    internal_reflectance: f32,
    nonlinear: bool,
) -> Spectrum {
    reflectance.map(|r| {
        let returned = if nonlinear { r * internal_reflectance } else { internal_reflectance };
        // Going in, directions draw together; coming out they spread again: 1 / eta² of the radiance is left.
        r / ((1.0 - returned) * eta * eta)
    })
}

/// `base_factor` below a polished coat.
pub(super) fn polished_base_factor(reflectance: Spectrum, eta: f32, nonlinear: bool) -> Spectrum {
    base_factor(reflectance, eta, diffuse_fresnel(1.0 / eta), nonlinear)
}

/// Cosines at which the polynomial is the transmittance: Chebyshev's points.
fn nodes() -> [f32; ORDER] {
    std::array::from_fn(|j| 0.5 + 0.5 * float::cos(PI * (j as f32 + 0.5) / ORDER as f32))
}

/// Coefficients of the polynomial through the values at the nodes.
fn chebyshev(values: [f32; ORDER]) -> [f32; ORDER] {
    std::array::from_fn(|k| {
        let scale = if k == 0 { 1.0 } else { 2.0 } / ORDER as f32;
        let theta = |j: usize| PI * (j as f32 + 0.5) / ORDER as f32;
        values.iter().enumerate().map(|(j, v)| v * float::cos(k as f32 * theta(j))).sum::<f32>() * scale
    })
}

/// Fractions of light at the cosine `cos` that rough facets reflect and transmit, single scattering.
fn passed(ggx: &Ggx, cos: f32, eta: f32) -> [f32; 2] {
    let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
    let g1 = ggx.g1(wo);
    let mut sums = [0.0_f32; 2];
    for i in 0..FACETS[0] * FACETS[1] {
        let (column, row) = (i % FACETS[0], i / FACETS[0]);
        let u = [(column as f32 + 0.5) / FACETS[0] as f32, (row as f32 + 0.5) / FACETS[1] as f32];
        let h = ggx.sample_visible_normal(wo, u);
        let fresnel = fresnel_dielectric(wo.dot(h).clamp(0.0, 1.0), eta);
        let mirrored = reflect(wo, h);
        if mirrored.z > 0.0 {
            sums[0] += fresnel * ggx.g2(wo, mirrored) / g1;
        }
        if let Some(refracted) = refract(wo, h, eta).filter(|w| w.z < 0.0) {
            sums[1] += (1.0 - fresnel) * ggx.g2(wo, refracted) / g1;
        }
    }
    sums.map(|sum| sum / (FACETS[0] * FACETS[1]) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_polynomial_follows_the_facets_between_its_nodes() {
        for (eta, alpha) in [(1.5, 0.02), (1.5, 0.1), (1.5, 0.3), (1.5, 1.0), (1.33, 0.2), (2.4, 0.2)] {
            let (coat, ggx) = (RoughCoat::new(eta, alpha), Ggx::isotropic(alpha));
            for i in 1..=50 {
                let cos = i as f32 / 50.0;
                let (got, want) = (coat.transmittance(cos), passed(&ggx, cos, eta)[1]);
                // What is lost at grazing angles weighs little: it is multiplied by the cosine.
                assert!(((got - want) * cos).abs() < 2e-3, "{eta} {alpha} {cos}: {got} not {want}");
            }
        }
    }

    #[test]
    fn a_table_joins_coats_of_neighboring_roughness() {
        let table = CoatTable::varying(1.5);
        for alpha in [MIN_ALPHA, 0.05, 0.13, 0.5, 1.0] {
            let (got, want) = (table.at(alpha), RoughCoat::new(1.5, alpha));
            for cos in [0.1, 0.5, 0.9] {
                let difference = (got.transmittance(cos) - want.transmittance(cos)) * cos;
                assert!(difference.abs() < 3e-3, "{alpha} {cos}: {difference}");
            }
            assert!((got.internal_reflectance - want.internal_reflectance).abs() < 3e-3);
        }
        assert_eq!(CoatTable::uniform(1.5, 0.3).at(0.7), RoughCoat::new(1.5, 0.3));
    }

    #[test]
    fn a_coat_of_vanishing_roughness_is_a_polished_one() {
        for eta in [1.333, 1.5, 2.0, 1.0 / 1.5] {
            let coat = RoughCoat::new(eta, 2e-3);
            let internal = diffuse_fresnel(1.0 / eta);
            assert!(
                (coat.internal_reflectance - internal).abs() < 1e-2,
                "{eta}: {} {internal}",
                coat.internal_reflectance
            );
            for cos in [0.2, 0.5, 0.8, 1.0] {
                let want = 1.0 - fresnel_dielectric(cos, eta);
                assert!(eta < 1.0 || (coat.transmittance(cos) - want).abs() < 2e-3, "{eta} {cos}");
            }
        }
    }
}
