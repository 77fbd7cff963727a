//! How the radius of progressive photon maps shrinks from pass to pass, in closed form.
//!
//! With the radius of pass p at R √S_p, S_p = Γ(p + 1 + α) / (Γ(1 + α) Γ(p + 2)), the mean over passes converges: its
//! variance falls as the passes grow, and so does its bias. Any pass can be made alone.
//! Source: Knaus & Zwicker, Progressive photon mapping: a probabilistic approach, ACM TOG 30(3), 2011, eqs. 15 and 20,
//! the recursion S_{p+1} / S_p = (p + 1 + α) / (p + 2) summed.

use hyaline_math::float;

/// Share of new photons that is kept, on surfaces.
const ALPHA_SURFACE: f64 = 2.0 / 3.0;
/// The same in volumes.
const ALPHA_VOLUME: f64 = 4.0 / 7.0;
/// The same for beams, whose radius itself takes the share.
const ALPHA_BEAM: f64 = 4.0 / 5.0;
/// Passes whose product is taken factor by factor; beyond, Stirling's series is exact to f32.
const EXACT: u32 = 64;

/// Factors on the radius in one pass, 0…1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shrink {
    /// On surfaces.
    pub surface: f32,
    /// In volumes, of points.
    pub volume: f32,
    /// In volumes, of beams.
    pub beam: f32,
}

impl Shrink {
    /// The factors of a pass, counted from 0, where they are 1.
    pub fn of_pass(pass: u32) -> Self {
        Self {
            surface: share(pass, ALPHA_SURFACE).sqrt() as f32,
            volume: float::f64::cbrt(share(pass, ALPHA_VOLUME)) as f32,
            beam: share(pass, ALPHA_BEAM) as f32,
        }
    }
}

/// S_p: the measure (area or volume) that photons are gathered from, as a share of that of pass 0.
fn share(pass: u32, alpha: f64) -> f64 {
    let factor = |i: u32| (f64::from(i) + alpha) / (f64::from(i) + 1.0);
    let exact: f64 = (1..=pass.min(EXACT)).map(factor).product();
    if pass <= EXACT {
        return exact;
    }
    let tail = |p: f64| {
        // ln of Γ(p + 1 + α) / Γ(p + 2), by Stirling's series about p + 1.
        let ln_gamma =
            |x: f64| (x - 0.5) * float::f64::ln(x) - x + 1.0 / (12.0 * x) - 1.0 / (360.0 * x * x * x);
        ln_gamma(p + 1.0 + alpha) - ln_gamma(p + 2.0)
    };
    exact * float::f64::exp(tail(f64::from(pass)) - tail(f64::from(EXACT)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::special::ln_gamma;

    #[test]
    fn shares_are_the_ratio_of_gamma_functions() {
        assert!((share(9, ALPHA_SURFACE) - 0.508_516).abs() < 1e-6, "{}", share(9, ALPHA_SURFACE));
        for alpha in [ALPHA_SURFACE, ALPHA_VOLUME, ALPHA_BEAM] {
            assert_eq!(share(0, alpha), 1.0);
            for pass in [1, 5, 63, 64, 65, 100, 1000, 1_000_000] {
                let p = f64::from(pass);
                let expected =
                    float::f64::exp(ln_gamma(p + 1.0 + alpha) - ln_gamma(1.0 + alpha) - ln_gamma(p + 2.0));
                let got = share(pass, alpha);
                assert!((got / expected - 1.0).abs() < 1e-6, "{pass}: {got} is not {expected}");
            }
        }
    }

    #[test]
    fn the_last_pass_of_all_still_has_a_radius() {
        let last = Shrink::of_pass(u32::MAX);
        assert!(last.surface > 0.0 && last.surface < 1e-1 && last.volume > 0.0);
    }
}
