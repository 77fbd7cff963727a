//! Flat panes against the sums of their inner reflections.

mod by_hand;
mod following;
mod scene_kit;

use by_hand::{reflected, refracted_cosine, stacked};
use following::{Way, follow, ray};
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray};
use hyaline_scene::{ColorSource, MaterialKind};
use scene_kit::*;

const SAMPLES: u32 = 40_000;

/// Half the width of everything, so large that no edge is met.
const WIDE: f64 = 500.0;

/// Where the light is, seen from a camera at the origin that looks along -z.
#[derive(Clone, Copy, Debug)]
enum Light {
    /// Behind the pane: its radiance of 1 is transmitted.
    Behind,
    /// Behind the camera: its radiance of 1 is reflected.
    Before,
}

/// A ray from the origin, at `angle` radians from -z.
fn tilted(angle: f64) -> Ray {
    let (sin, cos) = float::sin_cos(angle);
    ray(DVec3::ZERO, DVec3::new(sin, 0.0, -cos))
}

fn slab(front: f64, thickness: f64) -> hyaline_scene::ShapeDescription {
    cuboid(DVec3::new(-WIDE, -WIDE, -front - thickness), DVec3::new(WIDE, WIDE, -front))
}

/// Fails unless the light seen along a ray is `expected`.
fn assert_seen(kit: &SceneKit, light: Light, angle: f64, expected: f64, what: &str) {
    let mut kit = kit.clone();
    let (u, v) = (DVec3::X * WIDE, DVec3::Y * WIDE);
    match light {
        Light::Behind => kit.lamp("lamp", rectangle(-DVec3::Z * 20.0, u, v), 1.0),
        Light::Before => kit.lamp("lamp", rectangle(DVec3::Z * 20.0, v, u), 1.0),
    };
    let moments = estimate(&kit.world(), tilted(angle), SAMPLES);
    assert_mean(&moments, expected, &format!("{what}, {light:?}, at {angle}"));
}

/// Fails unless reflectance and transmittance are as expected.
fn assert_pane(kit: &SceneKit, angle: f64, reflectance: f64, transmittance: f64, what: &str) {
    assert_seen(kit, Light::Before, angle, reflectance, what);
    assert_seen(kit, Light::Behind, angle, transmittance, what);
}

#[test]
fn a_pane_passes_and_reflects_the_sums_of_its_inner_bounces() {
    let r: f64 = 0.04;
    assert!(((1.0 - r) / (1.0 + r) - 0.923_077).abs() < 1e-6);
    for n in [1.333, 1.5, 2.42] {
        let mut solid = SceneKit::new();
        solid.medium("glass", n).solid("pane", slab(1.0, 0.25), "glass");
        let mut sheets = SceneKit::new();
        let (u, v) = (DVec3::X * WIDE, DVec3::Y * WIDE);
        sheets
            .medium("glass", n)
            .interface("front", rectangle(-DVec3::Z, u, v), None, Some("glass"))
            .interface("back", rectangle(-1.25 * DVec3::Z, v, u), None, Some("glass"));
        for angle in [0.0, 0.5, 1.0, 1.3] {
            let r = reflected(float::cos(angle), n);
            let (reflectance, transmittance) = (2.0 * r / (1.0 + r), (1.0 - r) / (1.0 + r));
            assert_pane(&solid, angle, reflectance, transmittance, &format!("solid pane, n = {n}"));
            assert_pane(&sheets, angle, reflectance, transmittance, &format!("two sheets, n = {n}"));
        }
    }
}

#[test]
fn an_absorbing_pane_filters_every_passage() {
    let (n, sigma, thickness) = (1.5, 1.3, 0.5);
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", n, [sigma as f32; 3], 0).solid("pane", slab(1.0, thickness), "glass");
    for angle in [0.0, 0.6, 1.2] {
        let cos = float::cos(angle);
        let r = reflected(cos, n);
        let a = float::exp(-f64::from(sigma as f32) * thickness / refracted_cosine(cos, n));
        let transmittance = (1.0 - r).powi(2) * a / (1.0 - r * r * a * a);
        let reflectance = r + (1.0 - r).powi(2) * r * a * a / (1.0 - r * r * a * a);
        assert_pane(&kit, angle, reflectance, transmittance, "absorbing pane");
    }
}

#[test]
fn a_thin_pane_does_at_once_what_a_thick_one_does_in_many_bounces() {
    let mut kit = SceneKit::new();
    let tint = ColorSource::Constant([1.0; 3]);
    kit.material("thin", MaterialKind::ThinDielectric { ior: 1.5, tint });
    kit.surface("pane", rectangle(-DVec3::Z, DVec3::X * WIDE, DVec3::Y * WIDE), "thin");
    for angle in [0.0, 0.5, 1.0, 1.3] {
        let r = reflected(float::cos(angle), 1.5);
        assert_pane(&kit, angle, 2.0 * r / (1.0 + r), (1.0 - r) / (1.0 + r), "thin pane");
    }
}

#[test]
fn panes_one_behind_the_other_reflect_into_each_other() {
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5);
    for i in 0..3 {
        kit.solid(&format!("pane {i}"), slab(1.0 + 0.5 * f64::from(i), 0.25), "glass");
    }
    for angle in [0.0, 1.0] {
        let r = reflected(float::cos(angle), 1.5);
        // Six alike boundaries: R / T is six times that of one.
        let reflectance = stacked(&[r; 6]);
        assert!((1.0 - reflectance - (1.0 - r) / (1.0 + 5.0 * r)).abs() < 1e-12);
        assert_pane(&kit, angle, reflectance, 1.0 - reflectance, "three panes");
    }
}

#[test]
fn panes_in_contact_have_one_boundary_between_them_or_none() {
    let mut one = SceneKit::new();
    one.medium("glass", 1.5).solid("front", slab(1.0, 0.25), "glass").solid("back", slab(1.25, 0.5), "glass");
    let mut two = SceneKit::new();
    two.medium("glass", 1.5).medium("water", 1.333).solid("front", slab(1.0, 0.25), "glass").solid(
        "back",
        slab(1.25, 0.5),
        "water",
    );
    for angle in [0.0, 1.0] {
        let cos = float::cos(angle);
        let air_glass = reflected(cos, 1.5);
        let alone = stacked(&[air_glass; 2]);
        assert_pane(&one, angle, alone, 1.0 - alone, "glass on glass");
        let glass_water = reflected(refracted_cosine(cos, 1.5), 1.333 / 1.5);
        let wet = stacked(&[air_glass, glass_water, reflected(cos, 1.333)]);
        assert_pane(&two, angle, wet, 1.0 - wet, "glass on water");
    }
}

#[test]
fn a_slab_shifts_a_ray_sideways_and_does_not_turn_it() {
    let (n, thickness) = (1.5, 0.75);
    let mut kit = SceneKit::new();
    kit.medium("glass", n).solid("slab", slab(1.0, thickness), "glass");
    let world = kit.world();
    for degrees in [1.0_f64, 10.0, 30.0, 45.0, 60.0, 75.0, 85.0] {
        let incoming = tilted(degrees.to_radians());
        let direction = incoming.direction.as_dvec3();
        let out = follow(&world, incoming, &[Way::Transmit, Way::Transmit]).unwrap();
        assert!((out.direction - direction).length() < 1e-6, "{degrees}°: turned to {}", out.direction);
        let (sin, cos) = float::sin_cos(degrees.to_radians());
        let expected = thickness * sin * (1.0 - cos / (n * n - sin * sin).sqrt());
        let aside = out.points[1] - direction * out.points[1].dot(direction);
        // Roundings of the hit points, which lie up to 1 / cos away.
        assert!(
            (aside.length() - expected).abs() < 1e-6 / cos,
            "{degrees}°: {} for {expected}",
            aside.length()
        );
        let r = reflected(cos, n);
        assert!((out.weight - (1.0 - r).powi(2)).abs() < 1e-5);
    }
}
