//! Lossless glass in a uniform environment is invisible: every single sample is 1 in air and n² inside a medium.
//!
//! This is so for paths that are not split. Of one that is, total reflection may guide a faint part for thousands of
//! crossings, until roulette decides on what it carries; all others are whole.

mod scene_kit;

use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_scene::{BoundaryDescription, RimKind};
use hyaline_testkit::Random;
use scene_kit::*;

const SAMPLES: u32 = 20_000;
/// Samples with a faint part that is guided for too long, at most; and what such a part may be off by.
const GUIDED: u32 = 2;
const GUIDED_PART: f32 = 0.05;

/// Shoots rays from a ball about the scene towards its middle; every sample must be 1.
fn assert_invisible(kit: &SceneKit, size: f64, what: &str) {
    let mut kit = kit.clone();
    kit.sky(1.0).camera(DVec3::new(0.0, 0.0, 40.0 * size), DVec3::ZERO);
    let world = kit.world();
    let mut random = Random::from_seed(7);
    let direction = |random: &mut Random| Vec3::from_array(random.direction().map(|x| x as f32)).normalize();
    let mut guided = 0;
    for index in 0..SAMPLES {
        let from = direction(&mut random) * 3.0 * size as f32;
        let to = direction(&mut random) * (random.uniform_f32() * size as f32);
        let ray = Ray::new(from, (to - from).normalize());
        let set = &world.camera_media[0];
        let value = unsplit_sample(&world, ray, set.clone(), index);
        assert!((value - 1.0).abs() < 1e-4, "{what}: sample {index} along {ray:?} is {value}");
        let off = (sample(&world, ray, set.clone(), index) - 1.0).abs();
        guided += u32::from(off >= 1e-4);
        assert!(off < GUIDED_PART, "{what}: split sample {index} along {ray:?} is off by {off}");
    }
    assert!(guided <= GUIDED, "{what}: {guided} split samples are not whole");
}

fn media(kit: &mut SceneKit) {
    kit.absorbing_medium("glass", 1.5, [0.0; 3], 3)
        .absorbing_medium("ice", 1.31, [0.0; 3], 2)
        .absorbing_medium("water", 1.333, [0.0; 3], 1)
        .absorbing_medium("oil", 1.47, [0.0; 3], 1)
        .absorbing_medium("air", 1.0, [0.0; 3], 4);
}

#[test]
fn a_ball_a_box_and_a_torus_are_invisible() {
    for (shape, what) in [
        (sphere(DVec3::ZERO, 0.8), "ball"),
        (cuboid(DVec3::splat(-0.5), DVec3::new(0.5, 0.3, 0.4)), "box"),
        (
            hyaline_scene::ShapeDescription::Box {
                min: DVec3::splat(-0.5),
                max: DVec3::splat(0.5),
                radius: 0.12,
            },
            "rounded box",
        ),
        (
            hyaline_scene::ShapeDescription::Torus {
                major_radius: 0.6,
                minor_radius: 0.25,
                phi: [0.0, std::f64::consts::TAU],
                theta: [0.0, std::f64::consts::TAU],
            },
            "torus",
        ),
    ] {
        let mut kit = SceneKit::new();
        media(&mut kit);
        kit.solid("thing", shape, "glass");
        assert_invisible(&kit, 1.0, what);
    }
}

#[test]
fn nested_and_overlapping_solids_are_invisible() {
    let mut kit = SceneKit::new();
    media(&mut kit);
    kit.solid("water", sphere(DVec3::ZERO, 0.9), "water")
        .solid("ice", cuboid(DVec3::new(-0.2, -0.2, -0.2), DVec3::new(1.2, 0.3, 0.3)), "ice")
        .solid("glass", sphere(DVec3::new(-0.5, 0.2, 0.0), 0.45), "glass")
        .solid("bubble", sphere(DVec3::new(-0.4, 0.2, 0.1), 0.15), "air")
        .solid("oil", sphere(DVec3::new(0.0, -0.6, 0.2), 0.5), "oil");
    assert_invisible(&kit, 1.0, "overlapping solids");
}

#[test]
fn solids_that_share_a_face_are_invisible() {
    let mut kit = SceneKit::new();
    media(&mut kit);
    kit.solid("left", cuboid(DVec3::new(-0.6, -0.5, -0.5), DVec3::new(0.0, 0.5, 0.5)), "glass")
        .solid("right", cuboid(DVec3::new(0.0, -0.5, -0.5), DVec3::new(0.6, 0.5, 0.5)), "water")
        .solid("top", cuboid(DVec3::new(-0.6, 0.5, -0.5), DVec3::new(0.6, 0.8, 0.5)), "glass");
    assert_invisible(&kit, 1.0, "solids face to face");
}

#[test]
fn interfaces_are_invisible() {
    let mut kit = SceneKit::new();
    media(&mut kit);
    kit.interface("outer", sphere(DVec3::ZERO, 0.9), None, Some("water"))
        .interface("inner", sphere(DVec3::new(0.1, 0.0, 0.2), 0.6), Some("water"), Some("glass"))
        .interface("core", ball_mesh(Vec3::new(0.1, 0.0, 0.2), 0.3, 12), Some("glass"), None);
    assert_invisible(&kit, 1.0, "interfaces");
}

#[test]
fn meshes_with_smooth_normals_are_invisible() {
    let mut kit = SceneKit::new();
    media(&mut kit);
    kit.solid("mesh", ball_mesh(Vec3::ZERO, 0.9, 10), "glass");
    assert_invisible(&kit, 1.0, "mesh");
}

#[test]
fn a_vessel_with_two_liquids_is_invisible() {
    for rim in [RimKind::Round, RimKind::Flat] {
        for unit in [1e-2, 10.0, 1e4] {
            let mut kit = SceneKit::new();
            media(&mut kit);
            kit.object(
                "tumbler",
                tumbler(rim, &[("water", 0.5, 0.001), ("oil", 0.75, 0.001)], unit),
                BoundaryDescription::None,
                "dielectric",
            );
            kit.solid("ice", cuboid(DVec3::splat(0.0), DVec3::new(0.012, 0.07, 0.012) * unit), "ice");
            assert_invisible(&kit, 0.12 * unit, "vessel");
        }
    }
}

/// Radiance inside a medium of index n is n² in every direction that gets out.
fn assert_n_squared(kit: &SceneKit, from: DVec3, ior: f64, what: &str) {
    let mut kit = kit.clone();
    kit.sky(1.0).camera(from, from + DVec3::X);
    let world = kit.world();
    let medium = world.camera_media[0].active();
    assert_eq!(world.ior(medium), ior as f32, "{what}: the camera is in the wrong medium");
    let mut random = Random::from_seed(11);
    let mut seen = 0;
    for index in 0..2_000 {
        let direction = Vec3::from_array(random.direction().map(|x| x as f32)).normalize();
        let ray = Ray::new(from.as_vec3(), direction);
        let value = f64::from(sample(&world, ray, world.camera_media[0].clone(), index));
        if value != 0.0 {
            seen += 1;
            assert!((value / (ior * ior) - 1.0).abs() < 1e-4, "{what}: {value} is not {ior}²");
        }
    }
    assert!(seen > 500, "{what}: only {seen} directions got out");
}

#[test]
fn radiance_inside_a_medium_is_n_squared() {
    let mut balls = SceneKit::new();
    media(&mut balls);
    balls
        .solid("outer", sphere(DVec3::ZERO, 1.0), "water")
        .solid("middle", sphere(DVec3::ZERO, 0.7), "ice")
        .solid("inner", sphere(DVec3::ZERO, 0.4), "glass");
    assert_n_squared(&balls, DVec3::new(0.05, 0.1, 0.0), 1.5, "inner ball");
    assert_n_squared(&balls, DVec3::new(0.5, 0.1, 0.0), 1.31, "middle ball");
    assert_n_squared(&balls, DVec3::new(0.8, 0.1, 0.0), 1.333, "outer ball");

    let mut vessel = SceneKit::new();
    media(&mut vessel);
    let fill = [("water", 0.5, 0.001), ("oil", 0.75, 0.001)];
    vessel.object("tumbler", tumbler(RimKind::Round, &fill, 10.0), BoundaryDescription::None, "dielectric");
    assert_n_squared(&vessel, DVec3::new(0.05, 0.3, 0.02), 1.333, "water");
    assert_n_squared(&vessel, DVec3::new(0.05, 0.65, 0.02), 1.47, "oil");
    assert_n_squared(&vessel, DVec3::new(0.05, 0.04, 0.02), 1.5, "base");
    assert_n_squared(&vessel, DVec3::new(0.05, 0.95, 0.02), 1.0, "air above");
}
