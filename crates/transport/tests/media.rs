//! Light in media: furnaces of albedo 1, single scattering against its integral, media that ought not to matter.

mod fog_kit;
mod scene_kit;

use fog_kit::*;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scene::*;
use hyaline_testkit::{Moments, Random, integrate, welch_t};
use hyaline_transport::integrator::radiance;
use hyaline_transport::{RenderSettings, Stats};
use hyaline_world::World;
use scene_kit::*;

/// Mean over rays from everywhere through the middle of things.
fn furnace(kit: &SceneKit, count: u32) -> Moments {
    let mut kit = kit.clone();
    kit.sky(1.0).camera(DVec3::new(0.0, 0.0, 40.0), DVec3::ZERO);
    let world = kit.world();
    let mut random = Random::from_seed(11);
    let direction = |random: &mut Random| Vec3::from_array(random.direction().map(|x| x as f32)).normalize();
    let mut moments = Moments::new();
    for index in 0..count {
        let (from, to) = (direction(&mut random) * 3.0, direction(&mut random) * random.uniform_f32());
        let ray = Ray::new(from, (to - from).normalize());
        moments.push(f64::from(sample(&world, ray, world.camera_media[0].clone(), index)));
    }
    moments
}

fn assert_one(moments: &Moments, what: &str) {
    let error = moments.variance_of_mean().sqrt();
    assert!((moments.mean() - 1.0).abs() < 4.0 * error + 2e-5, "{what}: {} ± {error}", moments.mean());
}

#[test]
fn bodies_of_albedo_one_are_invisible_in_a_uniform_environment() {
    let lossless = |kit: &mut SceneKit, ior: f64, sigma_s: Rgb, g: f32| {
        volume(kit, "milk", ior, [0.0; 3], sigma_s, g);
    };
    let mut all = Moments::new();
    for (ior, sigma_s, g, what) in [
        (1.0, [2.0; 3], 0.0, "fog"),
        (1.0, [0.3, 1.0, 6.0], 0.7, "colored fog"),
        (1.333, [2.0; 3], -0.3, "milk"),
        (1.333, [0.5, 1.0, 4.0], 0.5, "colored milk"),
    ] {
        let mut kit = SceneKit::new();
        lossless(&mut kit, ior, sigma_s, g);
        kit.solid("ball", sphere(DVec3::ZERO, 0.9), "milk");
        let plain = furnace(&kit, 60_000);
        assert_one(&plain, what);
        let mut kit = SceneKit::new();
        lossless(&mut kit, ior, sigma_s, g);
        let (min, max) = (DVec3::new(-0.6, -0.5, -0.4), DVec3::new(0.6, 0.5, 0.4));
        grid(
            &mut kit,
            min,
            max,
            |[x, y, z]| if x < 4 { 0.0 } else { 0.2 + 0.1 * ((x * 7 + y * 3 + z) % 11) as f32 },
        );
        kit.solid("box", cuboid(min, max), "milk");
        let gridded = furnace(&kit, 60_000);
        assert_one(&gridded, &format!("{what} in a grid"));
        all.merge(&plain);
        all.merge(&gridded);
    }
    assert!((all.mean() - 1.0).abs() < 2e-3, "all together: {}", all.mean());
}

#[test]
fn paths_that_find_out_of_dense_milk_late_are_no_specks() {
    // Light scatters a hundred times on the mean, and thousands now and then; all that loses nothing brings back 1.
    let mut kit = SceneKit::new();
    volume(&mut kit, "milk", 1.333, [0.0; 3], [80.0; 3], 0.0);
    kit.solid("ball", sphere(DVec3::ZERO, 0.9), "milk");
    let moments = furnace(&kit, 20_000);
    let variance = moments.variance_of_mean() * f64::from(20_000);
    assert_one(&moments, "dense milk");
    assert!(variance < 0.5 && (moments.mean() - 1.0).abs() < 0.02, "{} ± √{variance}", moments.mean());
}

#[test]
fn within_milk_radiance_is_the_square_of_the_index() {
    let mut kit = SceneKit::new();
    volume(&mut kit, "milk", 1.333, [0.0; 3], [1.5; 3], 0.2);
    kit.solid("ball", sphere(DVec3::ZERO, 1.0), "milk").sky(1.0).camera(DVec3::new(0.2, 0.1, 0.0), DVec3::Z);
    let world = kit.world();
    let mut moments = Moments::new();
    for index in 0..40_000 {
        let ray = Ray::new(Vec3::new(0.2, 0.1, 0.0), Vec3::new(0.3, -0.5, 0.8).normalize());
        moments.push(f64::from(sample(&world, ray, world.camera_media[0].clone(), index)));
    }
    let expected = 1.333_f64 * 1.333;
    assert_mean(&moments, expected, "radiance in milk");
    assert!((moments.mean() / expected - 1.0).abs() < 2e-3, "{}", moments.mean());
}

/// Estimate along a ray of paths that scatter once at most, in one lane.
fn single_scattering(world: &World, ray: Ray, lane: usize, count: u32) -> Moments {
    let settings = RenderSettings { max_depth: Some(1), ..settings() };
    let mut moments = Moments::new();
    for index in 0..count {
        let mut sampler = Sampler::new(settings.sampler, 5, (index % 4096, index / 4096), 0);
        let set = world.camera_media[0].clone();
        let value = radiance(world, &settings, ray, set, &mut sampler, &mut Stats::default(), None);
        moments.push(f64::from(value.to_lanes()[lane]));
    }
    moments
}

#[test]
fn single_scattering_of_a_point_light_is_its_integral() {
    let lamp = DVec3::new(0.3, 1.1, -2.0);
    let mut kit = SceneKit::new();
    kit.light(LightKind::Point { position: lamp, intensity: [3.0; 3] });
    let world = fog_world(&mut kit);
    let ray = Ray::new(Vec3::ZERO, Vec3::new(0.05, 0.1, -1.0).normalize());
    for lane in 0..3 {
        let expected = single_by_quadrature(&ray, lamp, lane, 60.0, |_| 3.0);
        assert_mean(&single_scattering(&world, ray, lane, 120_000), expected, "point light in fog");
    }
}

#[test]
fn a_narrow_beam_seen_from_the_side_is_its_integral() {
    let (lamp, half_angle) = (DVec3::new(-1.0, 0.0, -3.0), 0.05);
    let mut kit = SceneKit::new();
    kit.light(LightKind::Spot {
        position: lamp,
        direction: DVec3::X,
        intensity: [40.0; 3],
        outer_angle: half_angle,
        inner_angle: half_angle,
        falloff: SpotFalloff::Smooth,
    });
    let world = fog_world(&mut kit);
    let ray = Ray::new(Vec3::ZERO, Vec3::new(0.08, 0.01, -1.0).normalize());
    let inside = |w: DVec3| if w.dot(DVec3::X) > float::cos(half_angle) { 40.0 } else { 0.0 };
    for lane in 0..3 {
        let expected = single_by_quadrature(&ray, lamp, lane, 6.0, inside);
        assert!(expected > 0.0);
        assert_mean(&single_scattering(&world, ray, lane, 400_000), expected, "beam in fog");
    }
}

/// A matte floor under a small lamp, all in fog; `extra` adds what ought not to matter.
fn foggy_room(extra: impl Fn(&mut SceneKit)) -> Moments {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.5).surface("floor", floor(-1.0, 4.0), "matte");
    let lamp = rectangle(DVec3::new(0.0, 1.5, -2.0), DVec3::X * 0.4, DVec3::Z * 0.4);
    kit.lamp("lamp", lamp, 10.0);
    volume(&mut kit, "fog", 1.0, [0.05; 3], [0.4; 3], 0.3);
    kit.description.surrounding = Some("fog".into());
    extra(&mut kit);
    let world = kit.world();
    estimate(&world, Ray::new(Vec3::ZERO, Vec3::new(0.1, -0.35, -1.0).normalize()), 60_000)
}

fn assert_same(a: &Moments, b: &Moments, what: &str) {
    let side = |m: &Moments| (m.mean(), m.variance_of_mean(), m.count());
    let ((mean_a, var_a, n_a), (mean_b, var_b, n_b)) = (side(a), side(b));
    let p = welch_t(mean_a, var_a, n_a, mean_b, var_b, n_b);
    assert!(p > 1e-3, "{what}: {} and {}, p = {p}", a.mean(), b.mean());
    let error = (a.variance_of_mean() + b.variance_of_mean()).sqrt();
    assert!(error < 0.02 * a.mean(), "too noisy to tell: {error} of {}", a.mean());
}

#[test]
fn a_boundary_between_equal_fogs_changes_nothing() {
    let plain = foggy_room(|_| {});
    let bounded = foggy_room(|kit| {
        volume(kit, "same fog", 1.0, [0.05; 3], [0.4; 3], 0.3);
        kit.solid("ball", sphere(DVec3::new(0.1, -0.2, -1.5), 0.6), "same fog");
    });
    assert_same(&plain, &bounded, "equal fogs");
}

#[test]
fn an_even_grid_is_a_homogeneous_medium() {
    let plain = foggy_room(|_| {});
    let gridded = foggy_room(|kit| {
        // Twice the coefficients at half the density, in a box that holds all that counts.
        volume(kit, "grid fog", 1.0, [0.1; 3], [0.8; 3], 0.3);
        grid(kit, DVec3::splat(-30.0), DVec3::splat(30.0), |_| 0.5);
        kit.description.surrounding = Some("grid fog".into());
    });
    assert_same(&plain, &gridded, "an even grid");
}

#[test]
fn a_lamp_behind_smoke_is_dimmed_by_the_density_on_the_way() {
    let mut kit = SceneKit::new();
    kit.lamp("lamp", rectangle(DVec3::new(0.0, 0.0, -4.0), DVec3::X, DVec3::Y), 5.0);
    volume(&mut kit, "smoke", 1.0, [1.5, 0.7, 0.2], [0.0; 3], 0.0);
    let (min, max) = (DVec3::new(-0.5, -0.5, -2.5), DVec3::new(0.5, 0.5, -1.5));
    let cells = |[x, y, z]: [u32; 3]| ((x + 2 * y + 3 * z) % 5) as f32;
    grid(&mut kit, min, max, cells);
    kit.solid("smoke", cuboid(min, max), "smoke");
    let world = kit.world();
    let ray = Ray::new(Vec3::ZERO, Vec3::new(0.03, 0.05, -1.0).normalize());
    let medium = &world.media[1];
    let grid = medium.grid.as_ref().unwrap();
    let depth = integrate(|t| f64::from(grid.density(ray.at(t as f32))), 1.0, 3.0, 20_000);
    let settings = settings();
    let mut moments = [Moments::new(), Moments::new(), Moments::new()];
    let mut random = Random::from_seed(2);
    for index in 0..20_000 {
        let mut sampler = Sampler::new(settings.sampler, 1, (index, 0), 0);
        let ray = Ray { origin: ray.at(0.5 * random.uniform_f32()), ..ray };
        let set = world.camera_media[0].clone();
        let value = radiance(&world, &settings, ray, set, &mut sampler, &mut Stats::default(), None);
        for (lane, moments) in moments.iter_mut().enumerate() {
            moments.push(f64::from(value.to_lanes()[lane]));
        }
    }
    for (lane, sigma) in [1.5, 0.7, 0.2].into_iter().enumerate() {
        assert_mean(&moments[lane], 5.0 * float::exp(-sigma * depth), "dimmed lamp");
    }
}

#[test]
fn a_glowing_ball_shines_by_its_depth() {
    let mut kit = SceneKit::new();
    volume(&mut kit, "plasma", 1.0, [0.8; 3], [0.0; 3], 0.0);
    kit.description.media.last_mut().unwrap().emission = [2.0; 3];
    kit.solid("ball", sphere(DVec3::new(0.0, 0.0, -3.0), 1.0), "plasma");
    let world = kit.world();
    let value = f64::from(sample(&world, Ray::new(Vec3::ZERO, -Vec3::Z), world.camera_media[0].clone(), 0));
    let expected = 2.0 / 0.8 * (1.0 - float::exp(-1.6));
    assert!((value - expected).abs() < 1e-4, "{value} is not {expected}");
}
