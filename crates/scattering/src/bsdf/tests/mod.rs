//! Every finish against the laws that bind all of them.

mod delta;
mod energy;
mod plastic;
mod sampling;
mod shading_normal;

use super::*;
use hyaline_math::float;
use hyaline_testkit::Random;

const WHITE: Spectrum = Spectrum::ONE;
const LANES: usize = 3;

fn spectrum(r: f32, g: f32, b: f32) -> Spectrum {
    Spectrum::from_lanes([r, g, b, 0.0])
}

/// Finishes that scatter into whole solid angles, with a name for messages.
fn examples() -> Vec<(&'static str, Bsdf)> {
    let orange = spectrum(0.8, 0.4, 0.1);
    let gray = spectrum(0.15, 0.2, 0.18);
    let (eta, k) = (spectrum(0.2, 0.4, 1.4), spectrum(3.9, 2.4, 1.6));
    vec![
        ("matte", Bsdf::Matte(Matte { reflectance: orange })),
        ("phong", Bsdf::Phong(Phong { diffuse: orange, specular: gray, exponent: 20.0 })),
        ("wide phong", Bsdf::Phong(Phong { diffuse: gray, specular: orange, exponent: 0.0 })),
        ("glossy", Bsdf::GlossySpecular(GlossySpecular { reflectance: orange, exponent: 7.0 })),
        ("gold", Bsdf::conductor(eta, k, WHITE, 0.25)),
        ("dull gold", Bsdf::conductor(eta, k, orange, 1.0)),
        ("ground glass", Bsdf::dielectric(1.5, WHITE, WHITE, 0.3)),
        ("ground glass from within", Bsdf::dielectric(1.0 / 1.5, WHITE, WHITE, 0.3)),
        ("tinted ice in water", Bsdf::dielectric(1.31 / 1.333, gray, orange, 0.5)),
        ("dull diamond", Bsdf::dielectric(2.42, WHITE, orange, 1.0)),
        ("varnish", plastic(1.5, WHITE, WHITE, 0.1)),
        ("dull varnish", plastic(1.9, orange, gray, 0.7)),
        ("a rough coat over nothing", plastic(1.5, Spectrum::ZERO, orange, 0.3)),
    ]
}

/// A coated finish in which light takes the color of the base each time it is sent back.
fn plastic(eta: f32, diffuse: Spectrum, specular: Spectrum, alpha: f32) -> Bsdf {
    Bsdf::plastic(eta, &CoatTable::uniform(eta, alpha), diffuse, specular, true, alpha)
}

/// A finish on a flat surface with its normals along +z, arrived at from there.
fn flat(bsdf: Bsdf) -> SurfaceBsdf {
    SurfaceBsdf::new(bsdf, Vec3::Z, Vec3::Z, Vec3::Z, Sides::Both, LANES)
}

fn direction(theta: f32, phi: f32) -> Vec3 {
    let (sin_theta, cos_theta) = float::sin_cos(theta);
    let (sin_phi, cos_phi) = float::sin_cos(phi);
    Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

/// Directions from which a finish is looked at: from above, and from below where light crosses.
fn views(bsdf: &Bsdf) -> Vec<Vec3> {
    let above = [(0.0, 0.0), (0.6, 1.0), (1.1, 3.5), (1.4, 5.0)].map(|(theta, phi)| direction(theta, phi));
    let below = above.map(|w| -w);
    if bsdf.is_opaque() { above.to_vec() } else { above.into_iter().chain(below).collect() }
}

fn vector(d: [f64; 3]) -> Vec3 {
    Vec3::from_array(d.map(|c| c as f32))
}

fn random_direction(random: &mut Random) -> Vec3 {
    vector(random.direction()).normalize()
}

fn random_pair(random: &mut Random) -> Vec2 {
    Vec2::new(random.uniform_f32(), random.uniform_f32())
}

/// A draw with fresh random numbers.
fn draw(surface: &SurfaceBsdf, wo: Vec3, random: &mut Random, transport: Transport) -> Option<BsdfSample> {
    surface.sample(wo, random.uniform_f32(), random_pair(random), transport)
}

fn assert_close(got: Spectrum, want: Spectrum, tolerance: f32, what: &str) {
    for (got, want) in got.to_lanes().into_iter().zip(want.to_lanes()) {
        assert!((got - want).abs() <= tolerance * want.abs().max(1.0), "{what}: {got} is not {want}");
    }
}
