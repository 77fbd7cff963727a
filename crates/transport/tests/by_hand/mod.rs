//! Hand calculations in f64, written from the textbooks and not from the renderer.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part, and a test exports nothing")]

use hyaline_math::float::f64 as float;
use hyaline_testkit::integrate;

/// Fraction of unpolarized light that a smooth boundary reflects, by Fresnel's equations.
///
/// - `cos_i`: cosine on the side the light comes from; `eta`: index beyond over index there.
pub fn reflected(cos_i: f64, eta: f64) -> f64 {
    let sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2_t).sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// Cosine of the refracted ray where there is one.
pub fn refracted_cosine(cos_i: f64, eta: f64) -> f64 {
    (1.0 - (1.0 - cos_i * cos_i) / (eta * eta)).sqrt()
}

/// Share of Lambertian light that is reflected by a medium of index `n`, the light coming from outside:
/// 2 ∫ R(c) c dc over the cosine.
pub fn reflected_from_outside(n: f64) -> f64 {
    2.0 * integrate(|c| reflected(c, n) * c, 0.0, 1.0, 64)
}

/// The same for light from inside. Of what comes at a solid angle from inside as much gets out as gets in, shrunk by
/// n²: 1 - F_in = (1 - F_out) / n².
pub fn reflected_from_inside(n: f64) -> f64 {
    1.0 - (1.0 - reflected_from_outside(n)) / (n * n)
}

/// Reflectance of lossless boundaries one behind the other, all orders of reflection summed without interference.
///
/// Two of them make R = R1 + T1² R2 / (1 - R1 R2); with T = 1 - R this says that R / T simply adds up.
pub fn stacked(boundaries: &[f64]) -> f64 {
    let ratio: f64 = boundaries.iter().map(|r| r / (1.0 - r)).sum();
    ratio / (1.0 + ratio)
}

/// Irradiance at distance `h` straight below a corner of an `a` × `b` rectangle of radiance 1.
///
/// Source: Siegel & Howell, Thermal Radiation Heat Transfer, 4th ed., configuration factor of a plane element to a
/// parallel rectangle.
pub fn below_corner(a: f64, b: f64, h: f64) -> f64 {
    let (x, y) = (a / h, b / h);
    let (rx, ry) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    0.5 * (x / rx * float::atan2(y, rx) + y / ry * float::atan2(x, ry))
}
