//! Rays that march: single scattering in `whitted` and `photon-map` against its integral, for every step.

mod fog_kit;
mod pictures;
mod scene_kit;

use fog_kit::*;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_world::World;
use pictures::Shot;
use scene_kit::*;

const STEPS: [MarchStep; 3] = [
    MarchStep::Adaptive { stations: 1.0 },
    MarchStep::Adaptive { stations: 6.0 },
    MarchStep::Fixed { length: 0.3 },
];

/// Looks along -z with hardly any angle.
fn narrow(kit: &mut SceneKit, toward: DVec3) -> Ray {
    kit.camera(DVec3::ZERO, toward);
    kit.description.cameras[0].projection = Projection::Perspective { fov: 1e-4, fov_axis: FovAxis::Y };
    Ray::new(Vec3::ZERO, toward.normalize().as_vec3())
}

/// Mean of each channel of a picture of one pixel.
fn channels(world: &World, integrator: &str, settings: RenderSettings, passes: u32) -> [Moments; 3] {
    let mut moments = [Moments::new(), Moments::new(), Moments::new()];
    let shot = Shot { world, integrator, settings, size: (1, 1) };
    shot.render(shot.full_frame(), 0..passes, |_, samples| {
        for (moments, value) in moments.iter_mut().zip(samples[0].beauty) {
            moments.push(f64::from(value));
        }
    });
    moments
}

/// Fails unless both integrators show these radiances, whatever the step.
fn assert_single_scattering(world: &World, passes: u32, expected: [f64; 3], what: &str) {
    for march in STEPS {
        let settings = RenderSettings { march, ..settings() };
        let once = RenderSettings { max_depth: Some(1), ..settings };
        for (integrator, settings) in [("whitted", settings), ("photon-map", once)] {
            let channels = channels(world, integrator, settings, passes);
            for (moments, expected) in channels.iter().zip(expected) {
                let error = moments.variance_of_mean().sqrt();
                assert!(error < 0.03 * expected, "{what}, {integrator}, {march:?}: {error} shows nothing");
                assert_mean(moments, expected, &format!("{what}, {integrator}, {march:?}"));
            }
        }
    }
}

#[test]
fn single_scattering_of_a_point_light_is_its_integral() {
    let lamp = DVec3::new(0.3, 1.1, -2.0);
    let mut kit = SceneKit::new();
    kit.light(LightKind::Point { position: lamp, intensity: [3.0; 3] });
    let ray = narrow(&mut kit, DVec3::new(0.05, 0.1, -1.0));
    let expected = [0, 1, 2].map(|lane| single_by_quadrature(&ray, lamp, lane, 60.0, |_| 3.0));
    assert_single_scattering(&fog_world(&mut kit), 30_000, expected, "point light");
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
    let ray = narrow(&mut kit, DVec3::new(0.08, 0.01, -1.0));
    let inside = |w: DVec3| if w.dot(DVec3::X) > float::cos(half_angle) { 40.0 } else { 0.0 };
    let expected = [0, 1, 2].map(|lane| single_by_quadrature(&ray, lamp, lane, 6.0, inside));
    assert_single_scattering(&fog_world(&mut kit), 150_000, expected, "beam");
}

#[test]
fn single_scattering_kept_in_the_map_is_the_same_light() {
    let lamp = DVec3::new(0.3, 1.1, -2.0);
    let mut kit = SceneKit::new();
    kit.light(LightKind::Point { position: lamp, intensity: [3.0; 3] });
    let ray = narrow(&mut kit, DVec3::new(0.05, 0.1, -1.0));
    let world = fog_world(&mut kit);
    let photon_map = PhotonMapSettings {
        volume_photons: 300_000,
        exclude_single_scattering: false,
        ..PhotonMapSettings::default()
    };
    let mut means = [Moments::new(), Moments::new(), Moments::new()];
    for seed in 0..12 {
        let settings = RenderSettings { seed, max_depth: Some(1), photon_map, ..settings() };
        for (means, moments) in means.iter_mut().zip(channels(&world, "photon-map", settings, 400)) {
            means.push(moments.mean());
        }
    }
    for (lane, means) in means.iter().enumerate() {
        let expected = single_by_quadrature(&ray, lamp, lane, 60.0, |_| 3.0);
        let (ratio, error) = (means.mean() / expected, means.variance_of_mean().sqrt() / expected);
        println!("lane {lane}: {ratio} ± {error} of what the integral says");
        assert!(error < 0.02 && (ratio - 1.0).abs() < 0.02 + 3.0 * error, "lane {lane}: {ratio} ± {error}");
    }
}

#[test]
fn a_glowing_ball_shines_by_its_depth_in_all_integrators() {
    for (gridded, tolerance) in [(false, 1e-4), (true, 0.02)] {
        let mut kit = SceneKit::new();
        volume(&mut kit, "plasma", 1.0, [0.8; 3], [0.0; 3], 0.0);
        kit.description.media.last_mut().unwrap().emission = [2.0; 3];
        if gridded {
            grid(&mut kit, DVec3::new(-2.0, -2.0, -5.0), DVec3::new(2.0, 2.0, -1.0), |_| 1.0);
        }
        kit.solid("ball", sphere(DVec3::new(0.0, 0.0, -3.0), 1.0), "plasma");
        narrow(&mut kit, -DVec3::Z);
        let world = kit.world();
        let expected = 2.0 / 0.8 * (1.0 - float::exp(-1.6));
        for integrator in ["whitted", "photon-map", "path"] {
            for march in STEPS {
                let settings = RenderSettings { march, ..settings() };
                let mean = channels(&world, integrator, settings, 20_000)[0].mean();
                let ratio = mean / expected;
                assert!((ratio - 1.0).abs() < tolerance, "{integrator}, {march:?}: {ratio}");
            }
        }
    }
}
