//! A picture has the same bits whichever instructions the processor has.

mod scene_kit;

use hyaline_film::{PixelSample, Rect};
use hyaline_geometry::bvh::SimdLevel;
use hyaline_math::{DVec3, Vec3};
use hyaline_scene::{BoundaryDescription, RimKind};
use hyaline_transport::{Stats, View, integrator};
use hyaline_world::World;
use hyaline_world::camera::PixelFilter;
use scene_kit::*;
use std::sync::atomic::AtomicBool;

const SIZE: u32 = 24;

fn picture(world: &World, name: &str) -> Vec<PixelSample> {
    let view = View {
        camera: 0,
        width: SIZE,
        height: SIZE,
        filter: PixelFilter::new(&hyaline_scene::PixelFilter::Box),
    };
    let integrator = integrator::by_name(name).unwrap();
    let (cancel, mut stats) = (AtomicBool::new(false), Stats::default());
    let prepared = integrator.prepare(world, &view, &settings(), &cancel, &mut stats);
    let mut samples = vec![PixelSample::default(); (SIZE * SIZE) as usize];
    let whole = Rect { x0: 0, y0: 0, x1: SIZE, y1: SIZE };
    prepared.begin_pass(3, &mut stats).render_tile(whole, &mut samples, &mut stats);
    samples
}

#[test]
fn every_simd_level_gives_the_same_picture() {
    let mut kit = SceneKit::new();
    kit.description.film.width = SIZE;
    kit.description.film.height = SIZE;
    kit.absorbing_medium("glass", 1.5, [2.0, 0.5, 1.0], 1).medium("water", 1.333).matte("matte", 0.6);
    let tumbler = tumbler(RimKind::Round, &[("water", 0.7, 0.001)], 10.0);
    kit.object("tumbler", tumbler, BoundaryDescription::None, "dielectric");
    kit.solid("ball", ball_mesh(Vec3::new(0.7, 0.3, 0.0), 0.3, 16), "glass");
    kit.surface("table", floor(0.0, 4.0), "matte").sky(1.0);
    kit.lamp("lamp", rectangle(DVec3::new(0.0, 3.0, 0.0), DVec3::X * 0.5, DVec3::Z * 0.5), 5.0);
    kit.camera(DVec3::new(0.3, 1.6, 3.5), DVec3::new(0.3, 0.4, 0.0));
    for name in integrator::NAMES {
        let expected = picture(&kit.world(), name);
        for level in SimdLevel::ALL.into_iter().filter(|level| level.is_supported()) {
            let mut world = kit.world();
            world.geometry = world.geometry.with_simd_level(level);
            assert_eq!(picture(&world, name), expected, "{name} at {level:?}");
        }
    }
}
