//! The views of `debug` show what closed forms say of simple scenes.

mod scene_kit;

use hyaline_film::{PixelSample, Rect};
use hyaline_math::DVec3;
use hyaline_scene::DebugView;
use hyaline_transport::{RenderSettings, Stats, View, integrator};
use hyaline_world::World;
use hyaline_world::camera::PixelFilter;
use scene_kit::{SceneKit, ball_mesh, floor, rectangle, sphere};
use std::sync::atomic::AtomicBool;

/// Side of the pictures; odd, so that the central pixel looks along the view.
const SIDE: u32 = 65;

/// An empty scene before a film of this size.
fn empty() -> SceneKit {
    let mut kit = SceneKit::new();
    (kit.description.film.width, kit.description.film.height) = (SIDE, SIDE);
    kit
}

/// A picture of one pass, one sample a pixel.
fn picture(world: &World, debug: DebugView) -> Vec<PixelSample> {
    let filter = PixelFilter::new(&hyaline_scene::PixelFilter::Box);
    let view = View { camera: 0, width: SIDE, height: SIDE, filter };
    let settings = RenderSettings { debug, ..RenderSettings::default() };
    let mut stats = Stats::default();
    let integrator = integrator::by_name("debug").expect("there is one");
    let prepared = integrator.prepare(world, &view, &settings, &AtomicBool::new(false), &mut stats);
    let mut samples = vec![PixelSample::default(); (SIDE * SIDE) as usize];
    let tile = Rect { x0: 0, y0: 0, x1: SIDE, y1: SIDE };
    prepared.begin_pass(0, &mut stats).render_tile(tile, &mut samples, &mut stats);
    assert!(stats.never_entered.is_empty(), "{:?}", stats.never_entered);
    samples
}

fn at(picture: &[PixelSample], x: u32, y: u32) -> [f32; 3] {
    picture[(y * SIDE + x) as usize].beauty
}

/// The value at the center.
fn center(world: &World, view: DebugView) -> [f32; 3] {
    at(&picture(world, view), SIDE / 2, SIDE / 2)
}

fn assert_close(value: [f32; 3], expected: [f32; 3], tolerance: f32) {
    let is_close = value.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
    assert!(is_close, "{value:?} is not {expected:?} within {tolerance}");
}

/// A matte ball of radius 1 five units before the camera, nothing else.
fn ball() -> World {
    let mut kit = empty();
    kit.matte("gray", 0.3).surface("ball", sphere(DVec3::new(0.0, 0.0, -5.0), 1.0), "gray").sky(1.0);
    kit.world()
}

#[test]
fn a_ball_shows_its_normal_its_distance_and_its_albedo() {
    let world = ball();
    assert_close(center(&world, DebugView::Normal), [0.5, 0.5, 1.0], 0.05);
    assert_close(center(&world, DebugView::GeometricNormal), [0.5, 0.5, 1.0], 0.05);
    assert_close(center(&world, DebugView::Depth), [4.0; 3], 0.01);
    assert_close(center(&world, DebugView::Albedo), [0.3; 3], 1e-6);
    for view in [DebugView::Normal, DebugView::Depth, DebugView::Object, DebugView::Crossings] {
        assert_eq!(at(&picture(&world, view), 0, 0), [0.0; 3], "{view:?} of the sky");
    }
}

#[test]
fn the_right_half_of_a_ball_looks_right_and_the_upper_half_up() {
    let normals = picture(&ball(), DebugView::Normal);
    let (middle, step) = (SIDE / 2, SIDE / 8);
    assert!(at(&normals, middle + step, middle)[0] > 0.6);
    assert!(at(&normals, middle - step, middle)[0] < 0.4);
    assert!(at(&normals, middle, middle - step)[1] > 0.6);
    assert!(at(&normals, middle, middle + step)[1] < 0.4);
}

#[test]
fn shading_normals_are_smooth_where_geometric_ones_are_flat() {
    let mut kit = empty();
    kit.matte("gray", 0.3).surface(
        "ball",
        ball_mesh(hyaline_math::Vec3::new(0.0, 0.0, -5.0), 1.0, 6),
        "gray",
    );
    let world = kit.world();
    let distinct = |view| {
        let mut values: Vec<[u32; 3]> =
            picture(&world, view).iter().map(|sample| sample.beauty.map(f32::to_bits)).collect();
        values.sort_unstable();
        values.dedup();
        values.len()
    };
    // The near half of 6 rings of 12 quads shows at most 2 * 6 * 12 / 2 triangles, and the sky.
    assert!(distinct(DebugView::GeometricNormal) <= 73);
    assert!(distinct(DebugView::Normal) > 500);
}

#[test]
fn surface_coordinates_run_over_a_rectangle() {
    let mut kit = empty();
    let square = rectangle(DVec3::new(0.0, 0.0, -2.0), DVec3::X, DVec3::Y);
    kit.matte("gray", 0.3).surface("square", square, "gray");
    assert_close(center(&kit.world(), DebugView::Uv), [0.5, 0.5, 0.0], 0.02);
}

#[test]
fn objects_have_colors_of_their_own() {
    let mut kit = empty();
    kit.matte("gray", 0.3);
    kit.surface("left", sphere(DVec3::new(-0.7, 0.0, -5.0), 0.5), "gray");
    kit.surface("right", sphere(DVec3::new(0.7, 0.0, -5.0), 0.5), "gray");
    let objects = picture(&kit.world(), DebugView::Object);
    let (left, right) = (at(&objects, SIDE / 4, SIDE / 2), at(&objects, 3 * SIDE / 4, SIDE / 2));
    let distance = left.iter().zip(right).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(distance > 0.1 && left != [0.0; 3], "{left:?} and {right:?}");
}

#[test]
fn media_are_shown_behind_their_boundary_and_before_opaque_surfaces() {
    let mut kit = empty();
    kit.medium("glass", 1.5).medium("water", 1.33).matte("gray", 0.3);
    kit.solid("ball", sphere(DVec3::new(0.0, 0.0, -5.0), 0.5), "glass");
    kit.solid("drop", sphere(DVec3::new(1.1, 0.0, -5.0), 0.3), "water");
    let outside = picture(&kit.world(), DebugView::Medium);
    let colors = [0, SIDE / 2, SIDE / 2 + SIDE * 11 / 31].map(|x| at(&outside, x, SIDE / 2));
    assert!(colors[0] != colors[1] && colors[1] != colors[2] && colors[0] != colors[2], "{colors:?}");
    let mut kit = empty();
    kit.medium("glass", 1.5).medium("water", 1.33).matte("gray", 0.3);
    kit.solid("pool", sphere(DVec3::ZERO, 3.0), "water");
    kit.surface("stone", sphere(DVec3::new(0.0, 0.0, -2.0), 0.3), "gray");
    assert_eq!(center(&kit.world(), DebugView::Medium), colors[2], "the camera is in the water");
}

#[test]
fn crossings_count_every_surface_on_the_way() {
    let mut kit = empty();
    kit.medium("glass", 1.5).matte("gray", 0.3);
    kit.solid("first", sphere(DVec3::new(0.0, 0.0, -3.0), 0.5), "glass");
    kit.solid("second", sphere(DVec3::new(0.0, 0.0, -5.0), 0.5), "glass");
    let wall = rectangle(DVec3::new(0.0, 0.0, -8.0), 9.0 * DVec3::X, 9.0 * DVec3::Y);
    kit.surface("wall", wall, "gray");
    let crossings = picture(&kit.world(), DebugView::Crossings);
    assert_eq!(at(&crossings, SIDE / 2, SIDE / 2), [5.0; 3]);
    assert_eq!(at(&crossings, 0, 0), [1.0; 3]);
}

#[test]
fn a_lamp_that_the_camera_does_not_see_is_looked_through() {
    let mut kit = empty();
    kit.matte("gray", 0.3).surface("floor", floor(-1.0, 50.0), "gray");
    kit.camera(DVec3::new(0.0, 4.0, 0.0), DVec3::new(0.0, -1.0, 0.0));
    kit.lamp("lamp", rectangle(DVec3::new(0.0, 2.0, 0.0), DVec3::X, DVec3::Z), 1.0);
    assert_close(center(&kit.world(), DebugView::Depth), [2.0; 3], 0.01);
    kit.description.objects.last_mut().unwrap().emission.as_mut().unwrap().visible_to_camera = false;
    assert_close(center(&kit.world(), DebugView::Depth), [5.0; 3], 0.01);
}
