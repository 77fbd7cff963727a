//! Paths that ask for light where photons have come from show the right picture, with less noise than others.

mod pictures;
mod scene_kit;

use hyaline_math::DVec3;
use hyaline_scene::{ColorSource, MaterialKind, Techniques};
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_world::World;
use pictures::{Shot, assert_same_picture};
use scene_kit::*;

/// A small lamp over a floor, and before a mirror: that, or a second lamp in its place.
fn lamp_over_a_floor(has_mirror: bool) -> World {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.6);
    kit.surface("floor", floor(0.0, 3.0), "matte");
    let mut lamp = |name: &str, z: f64| {
        let shape = rectangle(DVec3::new(2.0, 2.0, z), DVec3::X * 0.03, DVec3::Z * 0.03);
        kit.lamp(name, shape, 900.0);
    };
    lamp("lamp", 0.5);
    if has_mirror {
        let reflectance = ColorSource::Constant([1.0; 3]);
        kit.material("mirror", MaterialKind::PerfectSpecular { reflectance });
        kit.surface("mirror", rectangle(DVec3::Z * -1.0, DVec3::X * 9.0, DVec3::Y * 9.0), "mirror");
    } else {
        lamp("image", -2.5);
    }
    kit.camera(DVec3::new(0.0, 4.0, 0.8), DVec3::Z * 0.8);
    kit.world()
}

fn tiles(world: &World, guiding: bool, passes: u32) -> Vec<Moments> {
    let techniques = Techniques { guiding, ..Techniques::default() };
    let settings = RenderSettings { techniques, seed: u64::from(guiding), ..RenderSettings::default() };
    Shot { world, integrator: "path", settings, size: (32, 32) }.tiles(4, 0..passes)
}

#[test]
fn light_from_a_mirror_is_found_where_photons_came_from() {
    let (with_mirror, with_image) = (lamp_over_a_floor(true), lamp_over_a_floor(false));
    let [taught, others] = [true, false].map(|guiding| tiles(&with_mirror, guiding, 1200));
    let right = tiles(&with_image, true, 1200);
    assert_same_picture(&taught, &right, 1e-2, "a lamp and its image");
    let error =
        |tiles: &[Moments]| tiles.iter().zip(&right).map(|(a, b)| (a.mean() - b.mean()).powi(2)).sum::<f64>();
    let gain = error(&others) / error(&taught);
    println!("{gain} times less error");
    assert!(gain > 30.0, "only {gain} times less error");
}

/// A room in the dark but for a spot on its floor, which a lamp far off makes over a mirror in the wall, or its image through
/// a hole there. The camera sees another wall, which the spot lights.
fn spot_on_a_floor(has_mirror: bool) -> World {
    let mut kit = SceneKit::new();
    kit.matte("black", 0.0);
    kit.matte("matte", 0.6);
    let mut plate = |name: &str, center: DVec3, half_u: DVec3, half_v: DVec3, material: &str| {
        kit.surface(name, rectangle(center, half_u, half_v), material);
    };
    plate("floor", DVec3::Z * 1.5, DVec3::Z * 1.5, DVec3::X * 3.0, "matte");
    plate("wall", DVec3::new(0.0, 1.0, 3.0), DVec3::X * 3.0, DVec3::Y, "matte");
    // What the lamp's side of the world is cut off by, and that of its image; each with a hole on the way of the light.
    let mut screen = |name: &str, hole: DVec3, u: DVec3, v: DVec3, [half, low, high]: [f64; 3]| {
        let middle = |a: f64, b: f64| 0.5 * (a + b);
        let across = u * middle(half, 15.0);
        plate(&format!("{name}, left"), hole - across, u * middle(15.0, -half), v * 15.0, "black");
        plate(&format!("{name}, right"), hole + across, u * middle(15.0, -half), v * 15.0, "black");
        plate(
            &format!("{name}, below"),
            hole - v * middle(half, low),
            u * half,
            v * middle(low, -half),
            "black",
        );
        plate(
            &format!("{name}, above"),
            hole + v * middle(half, high),
            u * half,
            v * middle(high, -half),
            "black",
        );
    };
    screen("screen", DVec3::Y, DVec3::X, DVec3::Y, [0.3, 1.0, 5.0]);
    screen("lid", DVec3::new(0.0, 6.0, 7.5), DVec3::X, DVec3::Z, [0.4, 7.5, 15.0]);
    // It shines toward the wall with the hole.
    let toward = if has_mirror { -1.0 } else { 1.0 };
    let lamp = rectangle(DVec3::new(0.0, 9.0, -12.0 * toward), DVec3::X * 0.1, DVec3::Y * (0.1 * toward));
    kit.lamp("lamp", lamp, 1e5);
    if has_mirror {
        let reflectance = ColorSource::Constant([1.0; 3]);
        kit.material("mirror", MaterialKind::PerfectSpecular { reflectance });
        kit.surface("mirror", rectangle(DVec3::Y, DVec3::X * 0.3, DVec3::Y * 0.3), "mirror");
    }
    kit.camera(DVec3::new(1.0, 2.0, 0.5), DVec3::new(-0.5, 1.0, 3.0));
    kit.world()
}

#[test]
fn what_a_caustic_lights_is_found_by_going_there_more_often() {
    let (with_mirror, with_hole) = (spot_on_a_floor(true), spot_on_a_floor(false));
    let [taught, others] = [true, false].map(|guiding| tiles(&with_mirror, guiding, 1200));
    let right = tiles(&with_hole, true, 4800);
    let mean = |tiles: &[Moments]| tiles.iter().map(Moments::mean).sum::<f64>();
    println!("{} {} {}", mean(&taught), mean(&others), mean(&right));
    assert_same_picture(&taught, &right, 1e-2, "a spot over a mirror and through a hole");
    let error = |tiles: &[Moments]| tiles.iter().map(|a| a.variance_of_mean()).sum::<f64>();
    let gain = error(&others) / error(&taught);
    println!("{gain} times less variance");
    assert!(gain > 100.0, "only {gain} times less variance");
}
