//! Light that crosses boundaries straight arrives as if they were not there, by sampling as by hits.

mod scene_kit;

use hyaline_math::{DVec3, Ray, Transform, Vec3};
use hyaline_scene::{BoundaryDescription, MaterialKind, ShapeDescription, ShapePart};
use hyaline_testkit::Moments;
use hyaline_world::World;
use scene_kit::*;

const SAMPLES: u32 = 4_000;

/// Radiance seen straight down from `from`.
fn below(world: &World, from: DVec3) -> Moments {
    estimate(world, Ray::new(from.as_vec3(), -Vec3::Y), SAMPLES)
}

fn assert_alike(a: &Moments, b: &Moments, what: &str) {
    let error = (a.variance_of_mean() + b.variance_of_mean()).sqrt();
    let difference = (a.mean() - b.mean()).abs();
    assert!(b.mean() > 0.0 && error < 0.05 * b.mean(), "{what}: nothing to compare");
    assert!(difference <= 4.0 * error + 1e-3 * b.mean(), "{what}: {} and {}", a.mean(), b.mean());
}

fn facing_down(center: DVec3, half: f64) -> ShapeDescription {
    rectangle(center, DVec3::X * half, DVec3::Z * half)
}

/// A matte floor under a lamp, at `x` from the origin, with `sheets` that do nothing between them.
fn under_sheets(x: f64, sheets: u32) -> Moments {
    let mut kit = SceneKit::new();
    let at = |y: f64| DVec3::new(x, y, 0.0);
    kit.matte("matte", 0.5).material("nothing", MaterialKind::PassThrough);
    kit.surface("floor", rectangle(at(0.0), DVec3::Z * 2.0, DVec3::X * 2.0), "matte");
    kit.lamp("lamp", facing_down(at(1.0), 0.5), 1.0);
    for index in 0..sheets {
        let y = 0.3 + 0.05 * f64::from(index);
        kit.surface(&format!("sheet {index}"), facing_down(at(y), 3.0), "nothing");
    }
    kit.camera(at(0.2), at(0.0));
    below(&kit.world(), at(0.2))
}

#[test]
fn sheets_that_do_nothing_take_no_light_wherever_they_are() {
    for x in [0.0, 10.0, 1000.0] {
        let bare = under_sheets(x, 0);
        for sheets in [1, 2, 8] {
            assert_alike(&under_sheets(x, sheets), &bare, &format!("{sheets} sheets at {x}"));
        }
    }
}

/// A floor and a lamp inside a body of water of the given shape.
fn in_water(shape: ShapeDescription) -> Moments {
    let mut kit = SceneKit::new();
    kit.medium("water", 1.333).matte("matte", 0.5).solid("water", shape, "water");
    kit.surface("floor", floor(0.1, 1.9), "matte");
    kit.lamp("lamp", facing_down(DVec3::new(1.0, 0.9, 0.0), 0.4), 1.0);
    let from = DVec3::new(-0.6, 0.5, 0.0);
    kit.camera(from, from - DVec3::Y);
    below(&kit.world(), from)
}

#[test]
fn overlapping_and_touching_parts_of_one_body_are_one_body() {
    let part = |from: f64, to: f64| {
        let shape = cuboid(DVec3::new(from, 0.0, -2.0), DVec3::new(to, 1.0, 2.0));
        ShapePart { shape, placement: Transform::IDENTITY }
    };
    let whole = in_water(cuboid(DVec3::new(-2.0, 0.0, -2.0), DVec3::new(2.0, 1.0, 2.0)));
    let overlapping = ShapeDescription::Compound { parts: vec![part(-2.0, 0.2), part(-0.2, 2.0)] };
    let touching = ShapeDescription::Compound { parts: vec![part(-2.0, 0.0), part(0.0, 2.0)] };
    assert_alike(&in_water(overlapping), &whole, "overlapping parts");
    assert_alike(&in_water(touching), &whole, "touching parts");
}

#[test]
fn a_body_of_water_under_a_sheet_of_water_casts_no_shadow() {
    let look = |with_body: bool| {
        let mut kit = SceneKit::new();
        kit.medium("water", 1.333).matte("matte", 0.5);
        kit.interface("surface", floor(20.0, 200.0), None, Some("water"));
        kit.surface("floor", floor(0.0, 2.0), "matte");
        kit.lamp("lamp", facing_down(DVec3::Y, 0.5), 1.0);
        if with_body {
            kit.solid("body", cuboid(DVec3::new(-1.0, 0.4, -1.0), DVec3::new(1.0, 0.6, 1.0)), "water");
        }
        let from = DVec3::new(0.0, 0.2, 0.0);
        kit.camera(from, DVec3::ZERO);
        below(&kit.world(), from)
    };
    assert_alike(&look(true), &look(false), "body of water in water");
}

#[test]
fn a_lamp_that_lets_light_through_shines_like_any_other() {
    let look = |finish: &str| {
        let mut kit = SceneKit::new();
        kit.matte("matte", 0.5).material("nothing", MaterialKind::PassThrough);
        kit.surface("floor", floor(0.0, 2.0), "matte");
        kit.lamp("lamp", facing_down(DVec3::Y, 0.5), 1.0);
        kit.description.objects.last_mut().unwrap().material = finish.into();
        let from = DVec3::new(0.0, 0.2, 0.0);
        kit.camera(from, DVec3::ZERO);
        below(&kit.world(), from)
    };
    assert_alike(&look("nothing"), &look("black"), "pass-through lamp");
}

#[test]
fn paths_end_in_a_closed_room_that_swallows_nothing() {
    let mut kit = SceneKit::new();
    kit.matte("white", 1.0);
    let room = cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    kit.object("room", room, BoundaryDescription::None, "white");
    kit.lamp("lamp", facing_down(DVec3::Y * 0.9, 0.1), 1.0);
    let world = kit.world();
    for index in 0..200 {
        let value = sample(&world, Ray::new(Vec3::ZERO, Vec3::X), world.camera_media[0].clone(), index);
        assert!(value.is_finite());
    }
}
