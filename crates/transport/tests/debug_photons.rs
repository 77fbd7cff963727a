//! The views of photons that `debug` has show what photons must do in simple scenes.

mod scene_kit;

use hyaline_film::{PixelSample, Rect};
use hyaline_math::DVec3;
use hyaline_scene::{DebugView, LightKind, MaterialKind, PhotonMapSettings};
use hyaline_transport::{RenderSettings, Stats, View, integrator};
use hyaline_world::World;
use hyaline_world::camera::PixelFilter;
use scene_kit::{SceneKit, floor, sphere};
use std::sync::atomic::AtomicBool;

/// Side of the pictures.
const SIDE: u32 = 33;
/// Height of the lamp over the floor.
const HEIGHT: f64 = 2.0;
/// W/sr of the lamp.
const INTENSITY: f32 = 5.0;

/// A point lamp over a wide floor, seen from straight above.
fn lamp_and_floor() -> SceneKit {
    let mut kit = SceneKit::new();
    (kit.description.film.width, kit.description.film.height) = (SIDE, SIDE);
    kit.matte("gray", 0.5).surface("floor", floor(0.0, 20.0), "gray");
    kit.camera(DVec3::new(0.0, 4.0, 0.0), DVec3::ZERO);
    kit.light(LightKind::Point { position: DVec3::new(0.0, HEIGHT, 0.0), intensity: [INTENSITY; 3] });
    kit
}

fn picture(world: &World, debug: DebugView, photon_map: PhotonMapSettings, passes: u32) -> Vec<[f32; 3]> {
    let filter = PixelFilter::new(&hyaline_scene::PixelFilter::Box);
    let view = View { camera: 0, width: SIDE, height: SIDE, filter };
    let settings = RenderSettings { debug, photon_map, ..RenderSettings::default() };
    let mut stats = Stats::default();
    let integrator = integrator::by_name("debug").expect("there is one");
    let prepared = integrator.prepare(world, &view, &settings, &AtomicBool::new(false), &mut stats);
    assert!(prepared.photon_statistics().is_some_and(|photons| photons.global.emitted > 0));
    let tile = Rect { x0: 0, y0: 0, x1: SIDE, y1: SIDE };
    let mut sums = vec![[0.0; 3]; tile.area()];
    for pass in 0..passes {
        let mut samples = vec![PixelSample::default(); tile.area()];
        prepared.begin_pass(pass, &mut stats).render_tile(tile, &mut samples, &mut stats);
        for (sum, sample) in sums.iter_mut().zip(&samples) {
            (0..3).for_each(|lane| sum[lane] += sample.beauty[lane] / passes as f32);
        }
    }
    sums
}

fn center(picture: &[[f32; 3]]) -> [f32; 3] {
    picture[(SIDE / 2 * SIDE + SIDE / 2) as usize]
}

fn photons(caustic: u32, global: u32) -> PhotonMapSettings {
    PhotonMapSettings { caustic_photons: caustic, global_photons: global, ..PhotonMapSettings::default() }
}

#[test]
fn irradiance_under_a_point_lamp_falls_with_the_square_of_the_height() {
    let world = lamp_and_floor().world();
    let settings = PhotonMapSettings { max_radius: Some(0.3), ..photons(1000, 200_000) };
    let [e, ..] = center(&picture(&world, DebugView::Irradiance, settings, 4));
    let expected = INTENSITY / (HEIGHT * HEIGHT) as f32;
    assert!((e / expected - 1.0).abs() < 0.15, "irradiance is {e}, expected {expected}");
    let caustics = picture(&world, DebugView::CausticIrradiance, settings, 1);
    assert!(caustics.iter().all(|value| *value == [0.0; 3]), "nothing throws a caustic");
}

#[test]
fn a_glass_ball_gathers_the_caustic_under_it() {
    let mut kit = lamp_and_floor();
    kit.medium("glass", 1.5).solid("ball", sphere(DVec3::new(0.0, 0.45, 0.0), 0.3), "glass");
    // From aside, past the ball, onto the floor under it.
    kit.camera(DVec3::new(3.0, 0.6, 0.0), DVec3::new(0.0, 0.0, 0.0));
    let world = kit.world();
    let [e, ..] = center(&picture(&world, DebugView::CausticIrradiance, photons(30_000, 1000), 2));
    let direct = INTENSITY / (HEIGHT * HEIGHT) as f32;
    assert!(e > 3.0 * direct, "the caustic is {e}, direct light alone would be {direct}");
}

#[test]
fn estimates_tell_how_many_photons_they_took_and_from_how_far() {
    let world = lamp_and_floor().world();
    let settings = PhotonMapSettings { max_radius: Some(0.7), ..photons(1000, 300) };
    let radii = picture(&world, DebugView::PhotonRadius, settings, 1);
    let found = picture(&world, DebugView::PhotonsFound, settings, 1);
    let [found_global, found_caustic, found_volume] = center(&found);
    assert!((2.0..=100.0).contains(&found_global), "{found_global}");
    assert_eq!((found_caustic, found_volume), (0.0, 0.0));
    assert!((center(&radii)[0] - 0.7).abs() < 1e-6, "too few photons for 100: the largest radius is used");
}

#[test]
fn points_are_few_where_photons_are_few_and_everywhere_where_they_are_many() {
    let world = lamp_and_floor().world();
    let share = |global| {
        let points = picture(&world, DebugView::PhotonMap, photons(1000, global), 1);
        points.iter().filter(|value| value[0] == 1.0).count() as f32 / points.len() as f32
    };
    let (few, many) = (share(1000), share(400_000));
    assert!(few < 0.2 && many > 0.9, "{few} and {many}");
}

#[test]
fn points_behind_an_object_are_hidden_and_direct_photons_are_white() {
    let mut kit = lamp_and_floor();
    kit.material("mirror", MaterialKind::PerfectSpecular { reflectance: scene_color(1.0) });
    kit.surface("plate", floor(3.0, 0.05), "mirror");
    let world = kit.world();
    let depths = picture(&world, DebugView::PhotonDepth, photons(1000, 400_000), 1);
    let on_plate = center(&depths);
    assert!(on_plate.iter().all(|&lane| lane < 0.1), "photons beneath the plate show: {on_plate:?}");
    let corner = depths[(SIDE / 2 * SIDE + 2) as usize];
    assert_eq!(corner, [1.0; 3], "straight from the lamp");
}

fn scene_color(value: f32) -> hyaline_scene::ColorSource {
    hyaline_scene::ColorSource::Constant([value; 3])
}
