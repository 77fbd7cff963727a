//! A lamp in a glass shell lights a room, though no shadow ray gets out of it.

mod scene_kit;

use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_testkit::{Moments, welch_t};
use scene_kit::*;
use std::f64::consts::PI;

const DARK: f32 = 0.01;

/// Irradiance at distance 1 from the center of a spherical lamp of radius `radius` and radiance 5, made of `finish`.
fn irradiance(radius: f64, finish: &str, shell: Option<[f64; 2]>) -> Moments {
    let mut kit = SceneKit::new();
    kit.matte("dark", DARK).matte("white", 1.0);
    kit.absorbing_medium("glass", 1.5, [0.0; 3], 1).absorbing_medium("air", 1.0, [0.0; 3], 2);
    kit.surface("receiver", floor(0.0, 0.02), "dark");
    kit.lamp("lamp", sphere(DVec3::Y, radius), 5.0);
    kit.description.objects.last_mut().unwrap().material = finish.into();
    if let Some([inner, outer]) = shell {
        kit.solid("shell", sphere(DVec3::Y, outer), "glass").solid("hollow", sphere(DVec3::Y, inner), "air");
    }
    kit.camera(DVec3::Y * 0.1, DVec3::ZERO);
    let world = kit.world();
    let moments = estimate(&world, Ray::new(Vec3::Y * 0.1, -Vec3::Y), 150_000);
    assert!(moments.mean() > 0.0, "no light gets out");
    moments
}

/// What the receiver sends back for an irradiance.
fn seen(irradiance: f64) -> f64 {
    irradiance * f64::from(DARK) / PI
}

#[test]
fn a_white_lamp_in_a_clear_shell_lights_as_a_bare_one_does() {
    // Nothing swallows light, so that all power gets out, alike to all sides: E = 4 π a² π L / (4 π d²).
    let expected = seen(PI * 5.0 * 0.25 * 0.25);
    let (bare, wrapped) = (irradiance(0.25, "white", None), irradiance(0.25, "white", Some([0.3, 0.32])));
    assert_mean(&bare, expected, "bare lamp");
    assert_mean(&wrapped, expected, "lamp in a shell");
    let p = welch_t(
        bare.mean(),
        bare.variance_of_mean(),
        bare.count(),
        wrapped.mean(),
        wrapped.variance_of_mean(),
        wrapped.count(),
    );
    let error = wrapped.variance_of_mean().sqrt() / wrapped.mean();
    assert!(p > 1e-3 && error < 0.03, "p = {p}, error {error}");
}

#[test]
fn a_black_lamp_takes_back_what_the_shell_reflects() {
    // A shell much larger than the lamp is met head on; what it reflects returns to the lamp: (1 - R) / (1 + R).
    let wrapped = irradiance(0.1, "black", Some([0.6, 0.61]));
    let expected = seen(PI * 5.0 * 0.1 * 0.1) * 0.96 / 1.04;
    let error = wrapped.variance_of_mean().sqrt();
    assert!(
        error < 0.04 * expected && (wrapped.mean() - expected).abs() < 4.0 * error,
        "{} ± {error}, {expected}",
        wrapped.mean()
    );
}
