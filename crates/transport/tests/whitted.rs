//! `whitted` against sums of its branches done by hand, and against `path` where both models mean the same.

mod by_hand;
mod pictures;
mod scene_kit;

use by_hand::{reflected, refracted_cosine};
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::{RenderSettings, Stats};
use pictures::{Shot, assert_same_picture};
use scene_kit::*;
use std::f64::consts::PI;

/// What a single ray of `whitted` from `from` to `to` sees, over some passes.
fn look(kit: &SceneKit, from: DVec3, to: DVec3, settings: RenderSettings, passes: u32) -> (Moments, Stats) {
    let mut kit = kit.clone();
    kit.camera(from, to);
    // So narrow a pixel that all its rays are the same to the last digits.
    kit.description.cameras[0].projection = Projection::Orthographic { height: 1e-6 };
    (kit.description.film.width, kit.description.film.height) = (1, 1);
    let world = kit.world();
    Shot { world: &world, integrator: "whitted", settings, size: (1, 1) }.pixel(passes)
}

/// Settings without any cut but the depth limit.
fn uncut() -> RenderSettings {
    RenderSettings { min_weight: 0.0, ..settings() }
}

fn assert_exact((moments, _): &(Moments, Stats), expected: f64, what: &str) {
    assert!(moments.variance() < 1e-10, "{what}: the passes differ");
    let mean = moments.mean();
    assert!((mean - expected).abs() < 2e-5 * expected.abs().max(1e-3), "{what}: {mean} for {expected}");
}

/// A ball of constant reflection and transmission about the origin, in a sky of radiance 1.
fn simple_ball(k_r: f32, k_t: f32, sigma: f32) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.sky(1.0).absorbing_medium("glass", 1.5, [sigma; 3], 0);
    kit.material("simple", MaterialKind::SimpleTransparent { k_r, k_t, phong: None });
    let boundary = BoundaryDescription::Solid { medium: "glass".into() };
    kit.object("ball", sphere(DVec3::ZERO, 1.0), boundary, "simple");
    kit
}

/// k_r + k_t² a (1 + k_r a + (k_r a)² + ...), the first `terms` of the series: what comes back from the front, and what
/// gets out after 0, 1, 2, ... bounces within; `a` filters each passage. The n² of entering and leaving cancel.
fn series(k_r: f64, k_t: f64, a: f64, terms: u32) -> f64 {
    k_r + (0..terms).map(|j| k_t * k_t * a * (k_r * a).powi(j as i32)).sum::<f64>()
}

const AHEAD: (DVec3, DVec3) = (DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO);

#[test]
fn constant_reflection_and_transmission_add_up_to_their_series() {
    for (k_r, k_t) in [(0.1_f32, 0.8), (0.3, 0.7), (0.0, 1.0), (0.5, 0.0)] {
        let kit = simple_ball(k_r, k_t, 0.0);
        let expected = series(f64::from(k_r), f64::from(k_t), 1.0, 60);
        assert_exact(&look(&kit, AHEAD.0, AHEAD.1, uncut(), 2), expected, &format!("k_r {k_r}, k_t {k_t}"));
    }
}

#[test]
fn every_passage_is_filtered() {
    let sigma = 0.35_f32;
    let a = float::exp(-2.0 * f64::from(sigma));
    let kit = simple_ball(0.2, 0.7, sigma);
    assert_exact(
        &look(&kit, AHEAD.0, AHEAD.1, uncut(), 2),
        series(0.2_f32.into(), 0.7_f32.into(), a, 60),
        "filtered",
    );
}

#[test]
fn the_depth_limit_ends_the_series_and_both_branches_are_counted() {
    let kit = simple_ball(0.2, 0.8, 0.0);
    let (k_r, k_t) = (f64::from(0.2_f32), f64::from(0.8_f32));
    for limit in 1..6_u32 {
        let settings = RenderSettings { max_depth: Some(limit), ..uncut() };
        let seen = look(&kit, AHEAD.0, AHEAD.1, settings, 2);
        assert_exact(&seen, series(k_r, k_t, 1.0, limit - 1), &format!("depth {limit}"));
        assert_eq!(seen.1.branches_cut, 2 * 2, "depth {limit}: one of each kind in each of two passes");
    }
    // Depth 0: both rays of the first surface are cut.
    let settings = RenderSettings { max_depth: Some(0), ..uncut() };
    let (dark, stats) = look(&kit, AHEAD.0, AHEAD.1, settings, 2);
    assert_eq!((dark.mean(), stats.branches_cut), (0.0, 4));
}

#[test]
fn light_branches_are_cut_and_counted() {
    let kit = simple_ball(0.1, 0.8, 0.0);
    let (k_r, k_t) = (f64::from(0.1_f32), f64::from(0.8_f32));
    // Weights: back 0.1; out 0.64; on within 0.08, then out 0.064, on 0.008, then out 0.0064, on 0.0008.
    for (min_weight, terms, cut) in [(0.05, 2, 1), (0.007, 2, 2), (0.0065, 2, 2), (0.001, 3, 1)] {
        let settings = RenderSettings { min_weight, ..settings() };
        let seen = look(&kit, AHEAD.0, AHEAD.1, settings, 2);
        assert_exact(&seen, series(k_r, k_t, 1.0, terms), &format!("min_weight {min_weight}"));
        assert_eq!(seen.1.branches_cut, 2 * cut, "min_weight {min_weight}");
    }
    assert_eq!(RenderSettings::default().min_weight, 1.0 / 512.0);
}

#[test]
fn mirrors_face_to_face_end_at_depth_64() {
    let mut kit = SceneKit::new();
    kit.material("mirror", MaterialKind::PerfectSpecular { reflectance: ColorSource::Constant([1.0; 3]) });
    kit.surface("front", rectangle(-DVec3::Z, DVec3::X, DVec3::Y), "mirror");
    kit.surface("back", rectangle(DVec3::Z, DVec3::X, DVec3::Y), "mirror");
    let (moments, stats) = look(&kit, DVec3::ZERO, -DVec3::Z, settings(), 2);
    assert_eq!((moments.mean(), stats.branches_cut, stats.rays), (0.0, 2, 2 * 65));
}

#[test]
fn a_pane_is_the_sum_of_its_bounces_in_every_sample() {
    let (sigma, thickness) = (0.8_f32, 0.5);
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", 1.5, [sigma; 3], 0);
    let wide = DVec3::new(500.0, 500.0, 0.0);
    kit.solid("pane", cuboid(-wide - DVec3::Z * thickness, wide), "glass");
    kit.lamp("lamp", rectangle(-DVec3::Z * 9.0, DVec3::X * 500.0, DVec3::Y * 500.0), 1.0);
    for angle in [0.0, 0.7, 1.2] {
        let (sin, cos) = float::sin_cos(angle);
        let r = reflected(cos, 1.5);
        let a = float::exp(-f64::from(sigma) * thickness / refracted_cosine(cos, 1.5));
        let expected = (1.0 - r).powi(2) * a / (1.0 - r * r * a * a);
        let from = DVec3::new(-sin, 0.0, cos) * 2.0;
        assert_exact(&look(&kit, from, DVec3::ZERO, uncut(), 2), expected, &format!("pane at {angle}"));
    }
}

#[test]
fn glass_throws_an_opaque_shadow_and_only_the_ambient_term_is_left() {
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).matte("matte", 0.6).surface("floor", floor(0.0, 5.0), "matte");
    kit.solid("ball", sphere(DVec3::Y, 0.5), "glass");
    kit.light(LightKind::Point { position: DVec3::Y * 3.0, intensity: [9.0; 3] });
    let from = DVec3::new(4.0, 1.0, 0.0);
    let in_shadow = look(&kit, from, DVec3::ZERO, settings(), 2);
    assert_eq!(in_shadow.0.mean(), 0.0);
    let albedo = f64::from(0.6_f32);
    let beside = DVec3::new(0.0, 0.0, 4.0);
    let lit = albedo / PI * 9.0 * 3.0 / 125.0;
    assert_exact(&look(&kit, from, beside, settings(), 2), lit, "beside the shadow");
    kit.light(LightKind::Ambient { radiance: [0.25; 3] });
    assert_exact(&look(&kit, from, DVec3::ZERO, settings(), 2), 0.25 * albedo, "ambient in the shadow");
    assert_exact(&look(&kit, from, beside, settings(), 2), lit + 0.25 * albedo, "ambient beside it");
}

#[test]
fn a_transparent_ball_shows_the_highlight_of_its_local_term() {
    let (diffuse, specular, exponent) = (0.1_f32, 0.3_f32, 20.0_f32);
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5)
        .light(LightKind::Point { position: DVec3::new(0.0, 0.5, 3.0), intensity: [2.0; 3] });
    let phong = Some(([diffuse; 3], [specular; 3], exponent));
    kit.material("simple", MaterialKind::SimpleTransparent { k_r: 0.0, k_t: 0.0, phong });
    let boundary = BoundaryDescription::Solid { medium: "glass".into() };
    kit.object("ball", sphere(DVec3::ZERO, 1.0), boundary, "simple");
    // The camera looks along the axis at (0, 0, 1), where the mirror direction is its own.
    let to_light = DVec3::new(0.0, 0.5, 2.0);
    let cos = to_light.z / to_light.length();
    let lobe = f64::from(specular) * f64::from(exponent + 2.0) / (2.0 * PI) * cos.powi(20);
    let expected = (f64::from(diffuse) / PI + lobe) * 2.0 * cos / to_light.length_squared();
    assert_exact(&look(&kit, AHEAD.0, AHEAD.1, settings(), 2), expected, "highlight");
}

/// A floor under a disc lamp whose one half is hidden by a card that ends on the lamp's axis, and the lamp's irradiance
/// on the axis without the card.
fn half_hidden(light_samples: u32) -> (Moments, f64) {
    let (radiance, radius, h) = (5.0, 0.6, 1.2);
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.5).surface("floor", floor(0.0, 4.0), "matte");
    let disc = ShapeDescription::Disc { center: DVec3::Y * h, normal: -DVec3::Y, radius, inner_radius: 0.0 };
    kit.lamp("lamp", disc, radiance as f32);
    kit.surface("card", rectangle(DVec3::new(-1.0, 0.6, 0.0), DVec3::X, DVec3::Z), "black");
    let settings = RenderSettings { light_samples, ..settings() };
    let (moments, _) = look(&kit, DVec3::new(3.0, 0.4, 0.0), DVec3::ZERO, settings, 4000);
    (moments, PI * radiance * radius * radius / (radius * radius + h * h))
}

#[test]
fn shadows_of_area_lights_are_soft_and_right() {
    let (one, irradiance) = half_hidden(1);
    let expected = 0.5 / PI * 0.5 * irradiance;
    assert_mean(&one, expected, "one shadow ray");
    let (many, _) = half_hidden(16);
    assert_mean(&many, expected, "16 shadow rays");
    // 16 independent shadow rays instead of one.
    let ratio = one.variance() / many.variance();
    assert!((ratio / 16.0 - 1.0).abs() < 0.25, "the variance falls by {ratio}");
}

/// A floor lit by a lamp that faces along +x, with a black ball that throws a soft shadow; behind the lamp, an upright
/// mirror and an upright pane before a part of it, through which the camera looks back at the floor.
///
/// Light that leaves the floor towards mirror and pane goes up, and both only turn it about: it meets neither the floor
/// again nor the lamp's bright side. So there is direct light alone, and no caustic, and both models mean the same.
fn coinciding() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).matte("matte", 0.6);
    let silver = MaterialKind::PerfectSpecular { reflectance: ColorSource::Constant([0.9; 3]) };
    kit.material("mirror", silver);
    kit.surface("floor", rectangle(DVec3::new(2.5, 0.0, 0.0), DVec3::Z * 3.0, DVec3::X * 2.5), "matte");
    kit.surface("ball", sphere(DVec3::new(1.2, 0.35, 0.2), 0.3), "black");
    kit.lamp("lamp", rectangle(DVec3::new(-1.0, 1.3, 0.0), DVec3::Y * 0.4, DVec3::Z * 0.4), 10.0);
    kit.surface("mirror", rectangle(-DVec3::X * 2.0, DVec3::Y * 40.0, DVec3::Z * 40.0), "mirror");
    kit.solid("pane", cuboid(DVec3::new(-1.8, -40.0, 0.0), DVec3::new(-1.6, 40.0, 40.0)), "glass");
    let placement =
        Transform::look_at(DVec3::new(5.5, 2.6, 0.3), DVec3::new(-0.4, 0.3, 0.0), DVec3::Y).unwrap();
    kit.camera(DVec3::new(5.5, 2.6, 0.3), DVec3::ZERO);
    kit.description.cameras[0].placement = placement;
    kit.description.cameras[0].projection = Projection::Perspective { fov: 0.8, fov_axis: FovAxis::Y };
    (kit.description.film.width, kit.description.film.height) = (32, 32);
    kit
}

#[test]
fn whitted_and_path_agree_where_their_models_do() {
    let mut kit = coinciding();
    for what in ["area light", "area light and point light"] {
        let world = kit.world();
        let shot = |integrator, settings| Shot { world: &world, integrator, settings, size: (32, 32) };
        // Between mirror and pane branches double again and again; what is cut here is less than the test can see.
        let settings = RenderSettings { min_weight: 1e-4, ..settings() };
        let whitted = shot("whitted", settings).tiles(4, 0..200);
        let path = shot("path", RenderSettings { seed: 5, ..settings }).tiles(4, 0..400);
        assert_same_picture(&whitted, &path, 0.01, what);
        kit.light(LightKind::Point { position: DVec3::new(-0.5, 1.0, -0.8), intensity: [1.0; 3] });
    }
}
