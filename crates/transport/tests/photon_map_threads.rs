//! The same bits for any number of threads, and an end where one is asked for.

mod pictures;
mod scene_kit;

use hyaline_film::PixelSample;
use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_transport::photon::maps::PhotonMaps;
use hyaline_transport::{RenderSettings, Stats};
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
    let photon_map =
        PhotonMapSettings { caustic_photons: 30_000, global_photons: 30_000, ..PhotonMapSettings::default() };
    RenderSettings { photon_map, ..RenderSettings::default() }
}

#[test]
fn a_picture_is_the_same_for_any_number_of_threads() {
    let world = world();
    let shot = Shot { world: &world, integrator: "photon-map", settings: asked(), size: (24, 24) };
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
    assert_eq!(pictures[0].1.photons, 60_000);
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
