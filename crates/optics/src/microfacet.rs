//! The GGX distribution of microscopic normals on a rough surface, with masking, shadowing and sampling.
//!
//! Directions are in the local frame of the surface: unit, z along the normal. Masking and shadowing are Smith's, so
//! they depend on a direction's distance from the surface alone, and both sides of the surface look alike.

use hyaline_math::{Vec3, float};
use std::f32::consts::{PI, TAU};

/// GGX width of a roughness.
///
/// - `roughness`: what the user sets, 0 (smooth) … 1.
///
/// Returns `roughness²`, 0…1, which looks evenly spaced to the eye.
/// Source: Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course, §5.4.
pub fn alpha_from_roughness(roughness: f32) -> f32 {
    roughness * roughness
}

/// A GGX (Trowbridge-Reitz) distribution of microfacet normals.
///
/// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007; for two widths Heitz,
/// Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// Width along local x, > 0.
    pub alpha_x: f32,
    /// Width along local y, > 0.
    pub alpha_y: f32,
}

impl Ggx {
    /// The same width in all directions.
    pub const fn isotropic(alpha: f32) -> Self {
        Self { alpha_x: alpha, alpha_y: alpha }
    }

    /// Density D of microfacet normals: area of facets per solid angle of their normals, per area of the surface.
    ///
    /// - `h`: unit microfacet normal.
    ///
    /// Returns ≥ 0, sr⁻¹; 0 below the surface. ∫ D(h) cos(h) dh = 1.
    /// Source: Walter et al. 2007, eq. 33; with two widths Heitz 2014, §5.3.
    pub fn d(&self, h: Vec3) -> f32 {
        if h.z <= 0.0 {
            return 0.0;
        }
        let (x, y) = (h.x / self.alpha_x, h.y / self.alpha_y);
        let stretched = x * x + y * y + h.z * h.z;
        1.0 / (PI * self.alpha_x * self.alpha_y * stretched * stretched)
    }

    /// Smith's Λ: mean area hidden per area seen from `w`, from either side of the surface.
    ///
    /// Returns ≥ 0; infinite at grazing angles.
    /// Source: Heitz 2014, §5.3.
    pub fn lambda(&self, w: Vec3) -> f32 {
        let cos = w.z.abs();
        // The usual (√(1 + t) - 1) / 2, t = slope² / cos², without its cancellation near the normal.
        let slope_squared = self.slope_squared(w);
        slope_squared / (2.0 * cos * (cos + (cos * cos + slope_squared).sqrt()))
    }

    /// Masking G1: the fraction of facets facing `w` that are seen from there, from either side of the surface.
    ///
    /// Returns 0…1; 0 at grazing angles. Facets that do not face `w` are not seen; that is the caller's to check.
    /// Source: Heitz 2014, eq. 43.
    pub fn g1(&self, w: Vec3) -> f32 {
        let cos = w.z.abs();
        2.0 * cos / (cos + self.projected_area(w))
    }

    /// Masking and shadowing G2, correlated by height: the fraction of facets seen from both directions.
    ///
    /// - `wo`, `wi`: unit; on one side of the surface or, for transmission, on both.
    ///
    /// Returns 0…1; never more than `g1` of either.
    /// Source: Heitz 2014, eq. 99: 1 / (1 + Λ(wo) + Λ(wi)); for transmission as Pharr, Jakob, Humphreys, Physically
    /// Based Rendering, 4th ed., §9.7.
    pub fn g2(&self, wo: Vec3, wi: Vec3) -> f32 {
        let (cos_o, cos_i) = (wo.z.abs(), wi.z.abs());
        // Both Λ over a common denominator, so that grazing directions give 0 and not infinity over infinity.
        let denominator = cos_i * self.projected_area(wo) + cos_o * self.projected_area(wi);
        if denominator > 0.0 { 2.0 * cos_o * cos_i / denominator } else { 0.0 }
    }

    /// Density of `sample_visible_normal`.
    ///
    /// - `wo`: unit, z ≥ 0.
    /// - `h`: unit microfacet normal.
    ///
    /// Returns ≥ 0, sr⁻¹: D(h) G1(wo) max(0, wo·h) / cos(wo); 0 for facets that do not face `wo`.
    /// Source: Heitz 2014, eq. 16.
    pub fn pdf_visible_normal(&self, wo: Vec3, h: Vec3) -> f32 {
        // G1 / cos, finite at grazing angles.
        let g1_over_cos = 2.0 / (wo.z.abs() + self.projected_area(wo));
        self.d(h) * g1_over_cos * wo.dot(h).max(0.0)
    }

    /// Draws a microfacet normal among those seen from `wo`.
    ///
    /// - `wo`: unit, z ≥ 0.
    /// - `u2`: uniform in [0, 1)².
    ///
    /// Returns a unit normal with z > 0.
    /// Source: Dupuy & Benyoub, Sampling Visible GGX Normals with Spherical Caps, HPG 2023.
    pub fn sample_visible_normal(&self, wo: Vec3, u2: [f32; 2]) -> Vec3 {
        debug_assert!(wo.z >= 0.0, "wo must lie above the surface, got {wo}");
        let stretched = Vec3::new(self.alpha_x * wo.x, self.alpha_y * wo.y, wo.z).normalize();
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u2[0]);
        // A uniform point of the cap of the unit sphere above -stretched.z; its z is not formed by a difference, so
        // that the sum below keeps z > 0 and a length.
        let z_above_rim = (1.0 - u2[1]) * (1.0 + stretched.z);
        let z = z_above_rim - stretched.z;
        let r = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        let h = Vec3::new(r * cos_phi + stretched.x, r * sin_phi + stretched.y, z_above_rim);
        Vec3::new(self.alpha_x * h.x, self.alpha_y * h.y, h.z).normalize()
    }

    /// Area of facets facing `w` as seen from there, times two, less the cosine: √(cos² + αx² x² + αy² y²).
    fn projected_area(&self, w: Vec3) -> f32 {
        (w.z * w.z + self.slope_squared(w)).sqrt()
    }

    fn slope_squared(&self, w: Vec3) -> f32 {
        let (x, y) = (self.alpha_x * w.x, self.alpha_y * w.y);
        x * x + y * y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{Random, chi_square_sphere, integrate_sphere, sidak};

    const DISTRIBUTIONS: [Ggx; 4] =
        [Ggx::isotropic(0.1), Ggx::isotropic(0.5), Ggx::isotropic(1.0), Ggx { alpha_x: 0.15, alpha_y: 0.6 }];

    fn vector(d: [f64; 3]) -> Vec3 {
        Vec3::from_array(d.map(|c| c as f32))
    }

    fn views() -> [Vec3; 5] {
        [(0.0, 0.0), (0.5, 1.0), (1.0, 2.5), (1.4, 4.0), (1.55, 0.3)].map(|(theta, phi)| {
            let (sin_theta, cos_theta) = float::sin_cos(theta);
            let (sin_phi, cos_phi) = float::sin_cos(phi);
            Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
        })
    }

    #[test]
    fn facets_project_to_the_area_of_the_surface() {
        for ggx in DISTRIBUTIONS {
            let area = integrate_sphere(|d| f64::from(ggx.d(vector(d))) * d[2].max(0.0), 200, 60);
            assert!((area - 1.0).abs() < 1e-4, "{ggx:?}: {area}");
        }
    }

    #[test]
    fn facets_seen_project_to_the_area_seen() {
        // The weak white furnace test of Heitz 2014, per view.
        for ggx in DISTRIBUTIONS {
            for wo in views() {
                let seen = integrate_sphere(|d| f64::from(ggx.pdf_visible_normal(wo, vector(d))), 200, 60);
                assert!((seen - 1.0).abs() < 2e-3, "{ggx:?} from {wo}: {seen}");
            }
        }
    }

    #[test]
    fn visible_normals_follow_their_density() {
        let mut random = Random::from_seed(7);
        let level = sidak(0.01, DISTRIBUTIONS.len() * views().len());
        for ggx in DISTRIBUTIONS {
            for wo in views() {
                let sample = || {
                    let u2 = [random.uniform_f32(), random.uniform_f32()];
                    Some(ggx.sample_visible_normal(wo, u2).to_array().map(f64::from))
                };
                let pdf = |d: [f64; 3]| f64::from(ggx.pdf_visible_normal(wo, vector(d)));
                let result = chi_square_sphere(sample, pdf, 100_000, 40, 32);
                assert!(result.p_value > level, "{ggx:?} from {wo}: {result:?}");
            }
        }
    }

    #[test]
    fn the_smith_functions_agree_with_each_other() {
        for ggx in DISTRIBUTIONS {
            for wo in views() {
                assert!((ggx.g1(wo) - 1.0 / (1.0 + ggx.lambda(wo))).abs() < 1e-5);
                assert_eq!(ggx.g1(wo), ggx.g1(-wo));
                for wi in views() {
                    let g2 = ggx.g2(wo, wi);
                    assert!((g2 - 1.0 / (1.0 + ggx.lambda(wo) + ggx.lambda(wi))).abs() < 1e-5);
                    assert_eq!(g2, ggx.g2(wi, wo));
                    assert!(g2 <= ggx.g1(wo).min(ggx.g1(wi)) + 1e-6);
                    assert!(g2 >= ggx.g1(wo) * ggx.g1(wi) - 1e-6);
                }
            }
        }
    }

    #[test]
    fn extreme_numbers_and_grazing_views_stay_finite() {
        for ggx in [Ggx::isotropic(1e-4), Ggx::isotropic(1.0)] {
            for wo in [Vec3::Z, Vec3::X, Vec3::new(1.0, 0.0, 1e-6).normalize()] {
                for u in [0.0, 0.25, 0.5, float::ONE_MINUS_EPSILON] {
                    for v in [0.0, 0.5, float::ONE_MINUS_EPSILON] {
                        let h = ggx.sample_visible_normal(wo, [u, v]);
                        assert!((h.length() - 1.0).abs() < 1e-5 && h.z >= 0.0, "{ggx:?} {wo} {u} {v}: {h}");
                        assert!(ggx.pdf_visible_normal(wo, h).is_finite());
                    }
                }
                assert!((0.0..=1.0).contains(&ggx.g1(wo)) && ggx.g2(wo, wo).is_finite());
            }
        }
    }

    #[test]
    fn roughness_maps_to_width_evenly_for_the_eye() {
        assert_eq!([0.0, 0.5, 1.0].map(alpha_from_roughness), [0.0, 0.25, 1.0]);
    }
}
