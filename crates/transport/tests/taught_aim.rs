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
