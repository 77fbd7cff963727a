//! `photon-map` in media: uniform fields, and `path` on the same scenes.

mod fog_kit;
mod photon_kit;
mod pictures;
mod scene_kit;

use fog_kit::*;
use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_transport::photon::trace::MapKind;
use hyaline_world::World;
use photon_kit::assert_close;
use pictures::{Shot, assert_same};
use scene_kit::*;

/// Mean of a picture over `passes` passes, for `seeds` seeds, each with maps of its own.
fn means(world: &World, integrator: &str, photon_map: PhotonMapSettings, seeds: u64, passes: u32) -> Moments {
    let mut moments = Moments::new();
    for seed in 0..seeds {
        let settings = RenderSettings { seed, photon_map, ..settings() };
        let shot = Shot { world, integrator, settings, size: (8, 8) };
        moments.push(shot.mean(0..passes));
    }
    moments
}

fn few_photons() -> PhotonMapSettings {
    PhotonMapSettings {
        caustic_photons: 15_000,
        global_photons: 15_000,
        volume_photons: 30_000,
        nearest: NearestPhotons { caustic: 20, global: 30, volume: 20 },
        ..PhotonMapSettings::default()
    }
}

/// Settings between which the light may not change.
fn ways() -> [(&'static str, PhotonMapSettings); 4] {
    let plain = few_photons();
    [
        ("as it is", plain),
        ("single scattering in the map", PhotonMapSettings { exclude_single_scattering: false, ..plain }),
        ("without direct light in the map", PhotonMapSettings { exclude_direct: true, ..plain }),
        // Looked up directly the global map is blurred over the edges of round things: less, the more photons it has.
        (
            "without final gathering",
            PhotonMapSettings { final_gather: false, global_photons: 400_000, ..plain },
        ),
    ]
}

/// Things that lose nothing about the origin, in a sky of radiance 1: whatever they are, 1 is seen.
fn uniform(fill: impl FnOnce(&mut SceneKit)) -> World {
    let mut kit = SceneKit::new();
    kit.sky(1.0).camera(DVec3::new(0.3, 0.2, 2.2), DVec3::ZERO);
    fill(&mut kit);
    kit.world()
}

fn assert_uniform(world: &World, photon_map: PhotonMapSettings, what: &str) {
    let mean = means(world, "photon-map", photon_map, 3, 30).mean();
    assert_close(mean, 1.0, 0.015, what);
}

#[test]
fn fog_that_loses_nothing_is_invisible_in_a_uniform_field() {
    for (sigma_s, g) in [([1.0; 3], 0.0), ([0.3, 1.0, 3.0], 0.6), ([6.0; 3], -0.3)] {
        let world = uniform(|kit| {
            volume(kit, "fog", 1.0, [0.0; 3], sigma_s, g);
            kit.solid("fog", sphere(DVec3::ZERO, 1.0), "fog");
            // In the fog and half-way out of it.
            kit.matte("white", 1.0).surface("ball", sphere(DVec3::new(0.2, 0.0, 0.3), 0.4), "white");
            kit.surface("other", sphere(DVec3::new(-0.9, 0.1, 0.0), 0.3), "white");
        });
        // Where colors differ much, few photons carry the light of one lane.
        let count = if g == 0.6 { 400_000 } else { 60_000 };
        for (what, photon_map) in ways().into_iter().take(if g == 0.0 { 4 } else { 1 }) {
            let photon_map = PhotonMapSettings { volume_photons: count, ..photon_map };
            assert_uniform(&world, photon_map, &format!("{what}, {sigma_s:?}"));
        }
    }
}

#[test]
fn a_ball_of_milk_that_loses_nothing_is_invisible_in_a_uniform_field() {
    for ior in [1.0, 1.333] {
        let world = uniform(|kit| {
            volume(kit, "milk", ior, [0.0; 3], [2.0; 3], 0.2);
            kit.solid("ball", sphere(DVec3::ZERO, 0.7), "milk");
        });
        for (what, photon_map) in ways() {
            let photon_map = PhotonMapSettings { volume_photons: 100_000, ..photon_map };
            assert_uniform(&world, photon_map, &format!("{what}, index {ior}"));
        }
    }
}

#[test]
fn smoke_in_a_grid_that_loses_nothing_is_invisible_in_a_uniform_field() {
    let world = uniform(|kit| {
        volume(kit, "smoke", 1.0, [0.0; 3], [2.0; 3], 0.3);
        let half = DVec3::splat(0.5);
        grid(kit, -half, half, |[x, y, z]| 0.2 + 0.15 * ((x * 7 + y * 3 + z) % 11) as f32);
        kit.solid("box", cuboid(-half, half), "smoke");
    });
    for (what, photon_map) in ways() {
        let photon_map = PhotonMapSettings { volume_photons: 100_000, ..photon_map };
        assert_uniform(&world, photon_map, what);
    }
}

/// A lens in a matte ball that is full of fog.
fn foggy(lamp: impl FnOnce(&mut SceneKit)) -> World {
    let mut kit = hollow(lamp);
    volume(&mut kit, "fog", 1.0, [0.02; 3], [0.25; 3], 0.4);
    kit.description.surrounding = Some("fog".into());
    kit.world()
}

#[test]
fn fog_with_a_lens_looks_as_path_shows_it() {
    let world = foggy(lamp_ball);
    let paths = means(&world, "path", few_photons(), 12, 160);
    for (what, photon_map) in ways() {
        let maps = means(&world, "photon-map", photon_map, 12, 12);
        assert_same(&maps, &paths, 0.018, what);
    }
}

#[test]
fn a_glass_of_juice_looks_as_path_shows_it() {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.6).surface("wall", sphere(DVec3::ZERO, 2.0), "matte");
    kit.medium("glass", 1.5);
    volume(&mut kit, "juice", 1.34, [0.5, 2.0, 6.0], [5.0, 5.0, 5.0], 0.5);
    kit.description.media.last_mut().unwrap().priority = -1;
    kit.solid("wall of glass", sphere(DVec3::new(0.0, -0.3, 0.0), 0.5), "glass");
    kit.description.media[0].priority = -2;
    kit.solid("liquid", sphere(DVec3::new(0.0, -0.3, 0.0), 0.45), "juice");
    kit.lamp("lamp", sphere(DVec3::new(-0.6, 1.1, 0.3), 0.4), 4.0);
    kit.camera(DVec3::new(0.0, 0.3, 1.6), DVec3::new(0.0, -0.3, 0.0));
    let world = kit.world();
    let paths = means(&world, "path", few_photons(), 12, 240);
    let photon_map = PhotonMapSettings { caustic_photons: 60_000, volume_photons: 200_000, ..few_photons() };
    let maps = means(&world, "photon-map", photon_map, 12, 16);
    assert_same(&maps, &paths, 0.018, "juice");
}

#[test]
fn photons_in_media_hold_what_is_scattered_there() {
    // All light of a lamp in endless fog is scattered 1 / (1 - albedo) times, the first time straight from the lamp.
    let mut kit = SceneKit::new();
    kit.light(LightKind::Point { position: DVec3::ZERO, intensity: [3.0; 3] });
    volume(&mut kit, "fog", 1.0, [0.2; 3], [0.6; 3], 0.5);
    kit.description.surrounding = Some("fog".into());
    let world = kit.world();
    let lamp = 4.0 * std::f64::consts::PI * 3.0;
    for (with_direct, share, expected) in [(true, 1.0, 3.0), (false, 1.0, 2.25), (true, 0.3, 3.0)] {
        let map = MapKind::Volume { with_direct, share };
        let photons = photon_kit::trace(&world, map, 100_000);
        assert_close(photon_kit::power(&photons), expected * lamp, 0.01, &format!("{map:?}"));
    }
}

#[test]
fn a_ball_gathers_light_of_every_kind_of_lamp_in_the_fog_behind_it() {
    let position = DVec3::Y * 2.5;
    let spot = LightKind::Spot {
        position,
        direction: -DVec3::Y,
        intensity: [4.0; 3],
        outer_angle: 0.25,
        inner_angle: 0.24,
        falloff: SpotFalloff::Smooth,
    };
    let point = LightKind::Point { position, intensity: [4.0; 3] };
    // Few neighbors blur the tip of the cone less; what they leave of noise goes in the mean of many looks at a map.
    let photon_map = PhotonMapSettings {
        volume_photons: 400_000,
        nearest: NearestPhotons { volume: 4, ..few_photons().nearest },
        ..few_photons()
    };
    for (what, light) in [("point", Some(point)), ("spot", Some(spot)), ("area", None)] {
        let foggy = |with_ball: bool| {
            let mut kit = SceneKit::new();
            if with_ball {
                kit.medium("glass", 1.5).solid("ball", sphere(DVec3::ZERO, 0.5), "glass");
            }
            // A black plate keeps all other light out of the fog below. The ball stands in its hole.
            let plate = ShapeDescription::Disc {
                center: DVec3::ZERO,
                normal: DVec3::Y,
                radius: 50.0,
                inner_radius: 0.5,
            };
            kit.matte("black", 0.0).surface("plate", plate, "black");
            match &light {
                Some(light) => kit.light(light.clone()),
                None => kit.lamp("lamp", square_lamp(position, 0.1), 100.0),
            };
            volume(&mut kit, "fog", 1.0, [0.01; 3], [0.15; 3], 0.2);
            kit.solid("fog", cuboid(DVec3::new(-3.0, -4.0, -3.0), DVec3::new(3.0, -0.51, 3.0)), "fog");
            // Its picture is 0.6 wide about the focus.
            kit.camera(DVec3::new(0.0, -0.85, 2.0), DVec3::Y * -0.85);
            kit.description.cameras[0].projection =
                Projection::Perspective { fov: 0.3, fov_axis: FovAxis::Y };
            kit.world()
        };
        let world = foggy(true);
        let merging = means(&world, "merging", photon_map, 8, 60);
        let maps = means(&world, "photon-map", photon_map, 8, 100);
        let error = (merging.variance_of_mean() + maps.variance_of_mean()).sqrt();
        println!("{what}: {} and {} ± {error}", maps.mean(), merging.mean());
        assert!(error < 0.05 * maps.mean(), "{what}: an error of {error} in {} shows nothing", maps.mean());
        // Estimates blur the tip of the cone beyond the picture's edge.
        let off = (maps.mean() - merging.mean()).abs();
        assert!(off < 3.0 * error + 0.05 * merging.mean(), "{what}: off by {off}, ± {error}");
        // What is seen is the cone, not the fog.
        let plain = means(&foggy(false), "photon-map", photon_map, 4, 10);
        println!("{what}: {} without the ball", plain.mean());
        assert!(maps.mean() > 1.5 * plain.mean(), "{what}: {} without the ball", plain.mean());
    }
}

/// Its normal is down.
fn square_lamp(center: DVec3, half: f64) -> ShapeDescription {
    rectangle(center, DVec3::X * half, DVec3::Z * half)
}
