//! Lossless scattering solids of every kind in a uniform environment are invisible in every channel; and a lamp within one
//! loses nothing.

mod fog_kit;
mod scene_kit;

use fog_kit::*;
use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scene::*;
use hyaline_testkit::{Moments, Random};
use hyaline_transport::Stats;
use hyaline_transport::integrator::radiance;
use hyaline_world::World;
use scene_kit::*;
use std::f64::consts::TAU;
use std::sync::Arc;

const LOSSLESS: Rgb = [0.0; 3];
/// Scattering coefficients that differ by channel: not by so much that the noise of colors hides what is lost.
const COLORED: Rgb = [1.8, 2.0, 2.25];

/// One sample of each channel of each ray.
fn channels(world: &World, rays: impl Iterator<Item = Ray>) -> [Moments; 3] {
    let settings = settings();
    let mut moments = [Moments::new(), Moments::new(), Moments::new()];
    for (index, ray) in (0..).zip(rays) {
        let mut sampler = Sampler::new(settings.sampler, settings.seed, (index % 4096, index / 4096), 0);
        let set = world.camera_media[0].clone();
        let value = radiance(world, &settings, ray, set, &mut sampler, &mut Stats::default(), None);
        for (moments, value) in moments.iter_mut().zip(value.to_lanes()) {
            moments.push(f64::from(value));
        }
    }
    moments
}

fn direction(random: &mut Random) -> Vec3 {
    Vec3::from_array(random.direction().map(|x| x as f32)).normalize()
}

/// Fails unless rays from everywhere in the air see 1 in every channel: within 0.2 % and three standard errors, each of which
/// is below 0.1 %.
///
/// - `size`: radius of a ball about the origin that holds the scene.
fn assert_invisible(kit: &mut SceneKit, size: f32, count: usize, what: &str) {
    kit.sky(1.0).camera(DVec3::new(0.0, 0.0, 40.0), DVec3::ZERO);
    let world = kit.world();
    let mut random = Random::from_seed(77);
    let mut ray = || {
        let (from, to) = (direction(&mut random) * 3.0 * size, direction(&mut random) * random.uniform_f32());
        Ray::new(from, (to * size - from).normalize())
    };
    let moments = channels(&world, std::iter::repeat_with(&mut ray).take(count));
    for (channel, moments) in moments.iter().enumerate() {
        let (mean, error) = (moments.mean(), moments.variance_of_mean().sqrt());
        assert!(error < 1e-3, "{what}, channel {channel}: too noisy to tell, {mean} ± {error}");
        assert!((mean - 1.0).abs() < 2e-3 + 3.0 * error, "{what}, channel {channel}: {mean} ± {error}");
    }
}

#[test]
fn a_scattering_torus_is_invisible() {
    let mut kit = SceneKit::new();
    volume(&mut kit, "milk", 1.333, LOSSLESS, COLORED, 0.3);
    let shape =
        ShapeDescription::Torus { major_radius: 0.6, minor_radius: 0.25, phi: [0.0, TAU], theta: [0.0, TAU] };
    kit.solid("torus", shape, "milk");
    assert_invisible(&mut kit, 0.9, 100_000, "torus");
}

#[test]
fn a_scattering_mesh_is_invisible() {
    let mut kit = SceneKit::new();
    volume(&mut kit, "wax", 1.4, LOSSLESS, COLORED, 0.0);
    kit.solid("mesh", ball_mesh(Vec3::ZERO, 0.9, 10), "wax");
    assert_invisible(&mut kit, 1.0, 150_000, "mesh");
}

#[test]
fn a_scattering_liquid_in_a_vessel_is_invisible() {
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", 1.5, LOSSLESS, 1);
    volume(&mut kit, "milk", 1.333, LOSSLESS, [4.5, 5.0, 5.6], 0.2);
    let shape = tumbler(RimKind::Round, &[("milk", 0.7, 0.001)], 10.0);
    kit.object("tumbler", shape, BoundaryDescription::None, "dielectric");
    assert_invisible(&mut kit, 1.0, 100_000, "milk in a tumbler");
}

#[test]
fn a_scattering_ball_in_a_scattering_ball_is_invisible() {
    for (outer, inner) in [(1.333, 1.5), (1.5, 1.2)] {
        let mut kit = SceneKit::new();
        volume(&mut kit, "outer", outer, LOSSLESS, COLORED, 0.4);
        volume(&mut kit, "inner", inner, LOSSLESS, [2.25, 2.0, 1.8], -0.3);
        kit.description.media.last_mut().unwrap().priority = 1;
        kit.solid("outer", sphere(DVec3::ZERO, 0.9), "outer");
        kit.solid("inner", sphere(DVec3::new(0.2, 0.1, -0.1), 0.5), "inner");
        assert_invisible(&mut kit, 1.0, 100_000, &format!("balls of index {outer} and {inner}"));
    }
}

#[test]
fn a_grid_of_albedo_one_swallows_nothing_whatever_the_coefficients_say() {
    for (ior, count) in [(1.0, 450_000), (1.333, 200_000)] {
        let mut kit = SceneKit::new();
        volume(&mut kit, "smoke", ior, [2.0, 0.5, 0.0], [0.0, 2.0, 3.0], 0.3);
        let (min, max) = (DVec3::new(-0.6, -0.5, -0.4), DVec3::new(0.6, 0.5, 0.4));
        grid(&mut kit, min, max, uneven);
        let white = GridData { size: [2, 3, 2], channels: 3, values: vec![1.0; 36] };
        let medium = kit.description.media.last_mut().unwrap();
        medium.density.as_mut().unwrap().albedo = Some(Arc::new(white));
        kit.solid("box", cuboid(min, max), "smoke");
        assert_invisible(&mut kit, 0.9, count, &format!("grid of albedo 1, index {ior}"));
    }
}

#[test]
fn media_of_every_phase_function_are_invisible() {
    let double = PhaseDescription::DoubleHenyeyGreenstein { g1: 0.8, g2: -0.4, weight: 0.3 };
    // Where no surface bends it, the sky is asked for its light at every vertex: that is noisier.
    for (function, ior, count) in [
        (PhaseDescription::Rayleigh, 1.0, 450_000),
        (PhaseDescription::Rayleigh, 1.333, 100_000),
        (double, 1.333, 100_000),
    ] {
        let mut kit = SceneKit::new();
        volume(&mut kit, "milk", ior, LOSSLESS, COLORED, 0.0);
        kit.description.media.last_mut().unwrap().scattering.as_mut().unwrap().phase = function;
        kit.solid("ball", sphere(DVec3::ZERO, 0.9), "milk");
        assert_invisible(&mut kit, 1.0, count, &format!("{function:?}, index {ior}"));
    }
}

#[test]
fn all_light_of_a_lamp_in_a_scattering_ball_gets_out() {
    // A white lamp of radius a and radiance L at the center swallows nothing: its power, 4 π² a² L, leaves a ball of radius R
    // alike to all sides, so that the mean radiance over the ball's disc is L a² / R².
    let (lamp, radius, ball) = (5.0_f32, 0.1, 0.8);
    let expected = f64::from(lamp) * (radius / ball) * (radius / ball);
    for ior in [1.0, 1.333] {
        let mut kit = SceneKit::new();
        volume(&mut kit, "wax", ior, LOSSLESS, [2.5, 3.0, 3.6], 0.3);
        kit.solid("ball", sphere(DVec3::ZERO, ball), "wax");
        kit.matte("white", 1.0).lamp("lamp", sphere(DVec3::ZERO, radius), lamp);
        kit.description.objects.last_mut().unwrap().material = "white".into();
        kit.camera(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO);
        let world = kit.world();
        let mut random = Random::from_seed(3);
        let mut ray = || {
            let (r, phi) = (random.uniform_f32().sqrt() * ball as f32, random.uniform_f32() * TAU as f32);
            let (sin, cos) = hyaline_math::float::sin_cos(phi);
            Ray::new(Vec3::new(r * cos, r * sin, 4.0), -Vec3::Z)
        };
        let moments = channels(&world, std::iter::repeat_with(&mut ray).take(400_000));
        for (channel, moments) in moments.iter().enumerate() {
            let what = format!("lamp in wax of index {ior}, channel {channel}");
            let error = moments.variance_of_mean().sqrt() / expected;
            assert!(error < 0.01, "{what}: too noisy to tell, {error}");
            assert_mean(moments, expected, &what);
        }
    }
}
