//! The same bits for any number of threads, and an end where one is asked for.

mod fog_kit;
mod pictures;
mod scene_kit;

use hyaline_film::{PixelSample, Rect};
use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_transport::integrator::by_name;
use hyaline_transport::photon::maps::PhotonMaps;
use hyaline_transport::{RenderSettings, Stats, View};
use hyaline_world::World;
use pictures::Shot;
use scene_kit::*;
use std::sync::atomic::AtomicBool;

fn world() -> World {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.7).surface("wall", sphere(DVec3::ZERO, 2.0), "matte");
    kit.medium("glass", 1.5).solid("lens", sphere(DVec3::new(0.5, -0.5, -0.8), 0.6), "glass");
    kit.lamp("lamp", sphere(DVec3::new(-0.6, 0.9, 0.3), 0.3), 4.0);
    kit.camera(DVec3::new(0.0, 0.1, 1.2), DVec3::new(0.1, -0.2, -1.0));
    kit.world()
}

fn asked() -> RenderSettings {
    let photon_map = PhotonMapSettings {
        caustic_photons: 30_000,
        global_photons: 30_000,
        volume_photons: 20_000,
        ..PhotonMapSettings::default()
    };
    RenderSettings { photon_map, ..RenderSettings::default() }
}

/// The same, full of fog.
fn foggy_world() -> World {
    let mut kit = hollow(lamp_ball);
    fog_kit::volume(&mut kit, "fog", 1.0, [0.02, 0.05, 0.1], [0.2, 0.3, 0.5], 0.4);
    kit.description.surrounding = Some("fog".into());
    kit.world()
}

#[test]
fn a_picture_is_the_same_for_any_number_of_threads() {
    assert_same_for_any_number_of_threads(&world(), 60_000);
    assert_same_for_any_number_of_threads(&foggy_world(), 80_000);
}

fn assert_same_for_any_number_of_threads(world: &World, photons: u64) {
    let shot = Shot { world, integrator: "photon-map", settings: asked(), size: (24, 24) };
    let pictures: Vec<(Vec<PixelSample>, Stats)> = [1, 2, 3]
        .into_iter()
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut pixels = Vec::new();
            let stats = pool.install(|| {
                shot.render(shot.full_frame(), 0..2, |_, samples| pixels.extend_from_slice(samples))
            });
            (pixels, stats)
        })
        .collect();
    for (threads, picture) in pictures.iter().enumerate().skip(1) {
        assert!(*picture == pictures[0], "with {} threads the picture is another", threads + 1);
    }
    assert_eq!(pictures[0].1.photons, photons);
}

#[test]
fn tracing_stops_where_it_is_canceled() {
    let mut stats = Stats::default();
    let maps = PhotonMaps::new(&world(), &asked(), &AtomicBool::new(true), &mut stats);
    assert_eq!((maps.caustic.len(), maps.global.len(), stats.photons), (0, 0, 0));
}

#[test]
fn a_render_tells_what_its_maps_hold() {
    let mut stats = Stats::default();
    let maps = PhotonMaps::new(&world(), &asked(), &AtomicBool::new(false), &mut stats);
    let told = maps.statistics;
    assert_eq!((told.caustic.emitted, told.global.emitted), (30_000, 30_000));
    assert_eq!(told.caustic.stored, maps.caustic.len() as u64);
    // A wall of 0.7 is met 3.3 times.
    assert!((90_000..110_000).contains(&told.global.stored), "{told:?}");
    assert!(told.caustic.bytes >= 20 * told.caustic.stored, "{told:?}");
    assert_eq!((told.volume.emitted, told.volume.stored), (0, 0));
}

#[test]
fn where_photons_scatter_often_one_in_so_many_is_kept() {
    let mut kit = hollow(lamp_ball);
    fog_kit::volume(&mut kit, "milk", 1.0, [0.0; 3], [20.0; 3], 0.0);
    kit.description.surrounding = Some("milk".into());
    let maps = PhotonMaps::new(&kit.world(), &asked(), &AtomicBool::new(false), &mut Stats::default());
    let told = maps.statistics.volume;
    assert_eq!(told.emitted, 20_000);
    assert!((76_000..84_000).contains(&told.stored), "{told:?}");
}

#[test]
fn look_ups_are_counted() {
    let world = foggy_world();
    let view = View {
        camera: 0,
        width: 8,
        height: 8,
        filter: hyaline_world::camera::PixelFilter::new(&PixelFilter::Box),
    };
    let mut stats = Stats::default();
    let integrator = by_name("photon-map").unwrap();
    let prepared = integrator.prepare(&world, &view, &asked(), &AtomicBool::new(false), &mut stats);
    let mut samples = vec![PixelSample::default(); 64];
    let tile = Rect { x0: 0, y0: 0, x1: 8, y1: 8 };
    prepared.begin_pass(0, &mut stats).render_tile(tile, &mut samples, &mut stats);
    let told = prepared.photon_statistics().unwrap();
    for map in [told.caustic, told.global, told.volume] {
        assert!(map.look_ups >= 10 && !map.looking_up.is_zero(), "{told:?}");
    }
}

#[test]
fn a_scene_without_anything_specular_emits_no_photons_for_caustics() {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.7).surface("wall", sphere(DVec3::ZERO, 2.0), "matte");
    kit.light(LightKind::Point { position: DVec3::ZERO, intensity: [1.0; 3] });
    let mut stats = Stats::default();
    let maps = PhotonMaps::new(&kit.world(), &asked(), &AtomicBool::new(false), &mut stats);
    assert_eq!((maps.statistics.caustic.emitted, stats.photons), (0, 30_000));
}
