//! Absorption on the way: Beer-Lambert's law in its three spellings, inside things and around them.

mod by_hand;
mod following;
mod scene_kit;

use by_hand::reflected;
use following::ray;
use hyaline_math::DVec3;
use hyaline_math::float::f64 as float;
use hyaline_scene::*;
use scene_kit::*;

/// A medium of index `ior` that absorbs as told.
fn add_medium(kit: &mut SceneKit, name: &str, ior: f64, absorption: Absorption) {
    let index = IndexDescription::Constant(ior);
    let medium = MediumDescription { absorption, ..MediumDescription::clear(name, index) };
    kit.description.media.push(medium.into());
}

/// The three spellings of the coefficients `sigma`.
fn spellings(sigma: Rgb) -> [(Absorption, &'static str); 3] {
    let after = |distance: f32| sigma.map(|s| hyaline_math::float::exp(-s * distance));
    [
        (Absorption::SigmaA(sigma), "sigma_a"),
        (Absorption::Filter(after(1.0)), "filter"),
        (Absorption::ColorAt { color: after(0.4), distance: 0.4 }, "color at a distance"),
    ]
}

/// A lamp of radiance 1 at z = `-distance` that faces a camera at the origin.
fn lamp_ahead(distance: f64) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.lamp("lamp", rectangle(-DVec3::Z * distance, DVec3::X, DVec3::Y), 1.0);
    kit
}

/// The radiance ahead: all samples alike.
fn ahead(kit: &SceneKit) -> f64 {
    let moments = estimate(&kit.world(), ray(DVec3::ZERO, -DVec3::Z), 8);
    assert!(moments.variance() < 1e-12, "the samples differ");
    moments.mean()
}

fn mean_transmittance(sigma: Rgb, distance: f64) -> f64 {
    sigma.iter().map(|&s| float::exp(-f64::from(s) * distance)).sum::<f64>() / 3.0
}

#[test]
fn a_world_full_of_dye_filters_by_the_exponential_of_the_distance() {
    let sigma = [0.1, 0.7, 2.0];
    for distance in [0.01, 0.5, 3.0] {
        for (absorption, what) in spellings(sigma) {
            let mut kit = lamp_ahead(distance);
            add_medium(&mut kit, "dye", 1.0, absorption);
            kit.description.surrounding = Some("dye".into());
            let (got, expected) = (ahead(&kit), mean_transmittance(sigma, distance));
            assert!((got - expected).abs() < 2e-6, "{what}, {distance}: {got} for {expected}");
        }
    }
}

#[test]
fn a_body_filters_inside_and_the_world_filters_outside() {
    let (inner, outer) = ([1.5, 0.3, 0.0], [0.2, 0.4, 0.05]);
    for (index, (absorption, what)) in spellings(inner).into_iter().enumerate() {
        let mut kit = lamp_ahead(5.0);
        add_medium(&mut kit, "dye", 1.0, absorption);
        add_medium(&mut kit, "haze", 1.0, spellings(outer)[index].0.clone());
        kit.description.surrounding = Some("haze".into());
        kit.solid("ball", sphere(-DVec3::Z * 2.0, 0.6), "dye");
        // 1.2 through the ball, 3.8 around it.
        let factor = |i: usize| float::exp(-f64::from(inner[i]) * 1.2 - f64::from(outer[i]) * 3.8);
        let expected = (factor(0) + factor(1) + factor(2)) / 3.0;
        let got = ahead(&kit);
        assert!((got - expected).abs() < 2e-6, "{what}: {got} for {expected}");
    }
}

#[test]
fn shadow_rays_are_filtered_as_camera_rays_are() {
    // A matte patch under a point light, through a matched ball of dye: the camera looks past the ball.
    let sigma = [0.9, 0.2, 2.5];
    for (absorption, what) in spellings(sigma) {
        let mut kit = SceneKit::new();
        add_medium(&mut kit, "dye", 1.0, absorption);
        kit.matte("matte", 0.5).surface("floor", floor(0.0, 3.0), "matte");
        kit.light(LightKind::Point { position: DVec3::Y * 3.0, intensity: [9.0; 3] });
        kit.solid("ball", sphere(DVec3::Y * 1.5, 0.5), "dye");
        let from = DVec3::new(2.5, 0.5, 0.0);
        kit.camera(from, DVec3::ZERO);
        let moments = estimate(&kit.world(), ray(from, -from), 8);
        let expected = 0.5 / std::f64::consts::PI * mean_transmittance(sigma, 1.0);
        assert!((moments.mean() - expected).abs() < 1e-6, "{what}: {} for {expected}", moments.mean());
    }
}

#[test]
fn a_ball_of_colored_glass_filters_every_passage_between_its_walls() {
    // Along the axis light bounces to and fro between the walls, always 2 r long: the pane's sum with d = 2 r.
    let (n, r, sigma) = (1.5, 0.8, 0.6_f32);
    let reflectance = reflected(1.0, n);
    let a = float::exp(-f64::from(sigma) * 2.0 * r);
    let expected = (1.0 - reflectance).powi(2) * a / (1.0 - (reflectance * a).powi(2));
    for (absorption, what) in spellings([sigma; 3]) {
        let mut kit = lamp_ahead(5.0);
        add_medium(&mut kit, "glass", n, absorption);
        kit.solid("ball", sphere(-DVec3::Z * 2.0, r), "glass");
        let moments = estimate(&kit.world(), ray(DVec3::ZERO, -DVec3::Z), 100_000);
        assert_mean(&moments, expected, what);
    }
}
