//! The same scene in millimeters and in kilometers: no offset, threshold or epsilon knows how large things are.
//!
//! Lengths are multiplied by a scale, coefficients divided by it, powers and intensities multiplied by its square; the
//! radiances stay.

mod pictures;
mod scene_kit;

use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use pictures::{Shot, assert_same_picture, luminance};
use scene_kit::*;

const SIZE: (u32, u32) = (32, 32);
const TILE: u32 = 4;
const SCALES: [f64; 3] = [1.0, 1e-3, 1e3];

/// Radiance of the lamp.
const LAMP: f64 = 6.0;

/// On a table: a tumbler of dyed water, a ball of glass that touches the table, a mesh of colored glass that hovers.
/// Above: a square lamp given by its power, a faint sky, and a point light.
fn still_life(scale: f64) -> SceneKit {
    let s = scale;
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z) * s;
    let per_length = |sigma: Rgb| sigma.map(|c| (f64::from(c) / s) as f32);
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", 1.5, [0.0; 3], 3)
        .absorbing_medium("tea", 1.333, per_length([0.4, 1.2, 3.0]), 1)
        .absorbing_medium("amber", 1.55, per_length([0.2, 0.9, 2.5]), 2)
        .matte("table", 0.6);
    kit.surface("table", floor(0.0, 30.0 * s), "table");
    kit.object(
        "tumbler",
        tumbler(RimKind::Round, &[("tea", 0.6, 0.001)], 20.0 * s),
        BoundaryDescription::None,
        "dielectric",
    );
    kit.solid("ball", sphere(at(1.3, 0.45, 0.2), 0.45 * s), "glass");
    kit.solid("mesh", ball_mesh(at(-1.2, 0.6, 0.5).as_vec3(), (0.5 * s) as f32, 12), "amber");
    kit.lamp("lamp", rectangle(at(-0.5, 4.0, 0.5), DVec3::X * 1.5 * s, DVec3::Z * 1.5 * s), 0.0);
    let emission = kit.description.objects.last_mut().unwrap().emission.as_mut().unwrap();
    emission.quantity = EmissionQuantity::Power;
    emission.color = [(LAMP * std::f64::consts::PI * 9.0 * s * s) as f32; 3];
    kit.sky(0.3);
    kit.light(LightKind::Point { position: at(2.0, 3.0, -1.0), intensity: [(2.0 * s * s) as f32; 3] });
    kit.camera(at(0.3, 2.2, 6.0), at(0.0, 0.8, 0.0));
    kit.description.cameras[0].projection = Projection::Perspective { fov: 0.7, fov_axis: FovAxis::Y };
    (kit.description.film.width, kit.description.film.height) = SIZE;
    kit
}

/// The picture at a scale, and its brightest sample.
fn picture(scale: f64, integrator: &str, seed: u64, passes: u32) -> (Vec<Moments>, f64) {
    let world = still_life(scale).world();
    let settings = RenderSettings { seed, ..settings() };
    let shot = Shot { world: &world, integrator, settings, size: SIZE };
    let mut tiles = vec![Moments::new(); (SIZE.0 * SIZE.1 / TILE / TILE) as usize];
    let mut brightest = 0.0_f64;
    shot.render(shot.full_frame(), 0..passes, |_, samples| {
        brightest = samples.iter().map(luminance).fold(brightest, f64::max);
        for (tile, value) in tiles.iter_mut().zip(shot.tile_means(samples, TILE)) {
            tile.push(value);
        }
    });
    (tiles, brightest)
}

#[test]
fn pictures_agree_from_millimeters_to_kilometers() {
    for (integrator, passes) in [("path", 160), ("whitted", 40)] {
        let pictures: Vec<_> =
            SCALES.iter().zip(1..).map(|(&scale, seed)| picture(scale, integrator, seed, passes)).collect();
        for ((tiles, _), scale) in pictures.iter().zip(SCALES).skip(1) {
            assert_same_picture(tiles, &pictures[0].0, 0.02, &format!("{integrator}, scale {scale}"));
        }
        for ((_, brightest), scale) in pictures.iter().zip(SCALES) {
            // A path meets the lamp at most once and each factor is at most 1 in the air, so no sample is brighter than
            // the lamp, plus what a few vertices collect directly.
            assert!(*brightest < 2.0 * LAMP, "{integrator}, scale {scale}: a speckle of {brightest}");
        }
    }
}

#[test]
fn the_same_random_numbers_give_nearly_the_same_samples_at_every_scale() {
    // A power of two changes no digit but the exponents: any difference is an absolute length in the code.
    let samples = |scale: f64| {
        let world = still_life(scale).world();
        let shot = Shot { world: &world, integrator: "path", settings: settings(), size: SIZE };
        let mut all = Vec::new();
        shot.render(shot.full_frame(), 0..4, |_, samples| all.extend(samples.iter().map(luminance)));
        all
    };
    let reference = samples(1.0);
    for scale in [2.0_f64.powi(-10), 2.0_f64.powi(10)] {
        let other = samples(scale);
        let different =
            reference.iter().zip(&other).filter(|(a, b)| (*a - *b).abs() > 1e-3 * (1.0 + *a)).count();
        assert!(
            different * 100 < reference.len(),
            "scale {scale}: {different} of {} differ",
            reference.len()
        );
    }
}

#[test]
fn a_closed_room_stays_dark_in_a_bright_world() {
    for scale in SCALES {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z) * scale;
        let mut kit = SceneKit::new();
        kit.absorbing_medium("glass", 1.5, [0.0; 3], 3).absorbing_medium("water", 1.333, [0.0; 3], 1);
        kit.matte("wall", 0.9).sky(1e6);
        kit.light(LightKind::Point {
            position: at(9.0, 9.0, 9.0),
            intensity: [(1e6 * scale * scale) as f32; 3],
        });
        kit.surface("room", cuboid(at(-2.0, 0.0, -2.0), at(2.0, 3.0, 2.0)), "wall");
        let vessel = tumbler(RimKind::Flat, &[("water", 0.7, 0.0)], 20.0 * scale);
        kit.object("tumbler", vessel, BoundaryDescription::None, "dielectric");
        // These touch the walls, or stand in them.
        kit.solid("block", cuboid(at(1.0, 0.0, 1.0), at(2.0, 1.0, 2.0)), "glass");
        kit.solid("mesh", ball_mesh(at(-1.6, 1.0, -1.6).as_vec3(), (0.7 * scale) as f32, 8), "glass");
        kit.camera(at(0.5, 1.5, 1.2), at(-0.3, 0.5, -1.0));
        kit.description.cameras[0].projection = Projection::Perspective { fov: 1.8, fov_axis: FovAxis::Y };
        (kit.description.film.width, kit.description.film.height) = SIZE;
        let world = kit.world();
        for integrator in ["path", "whitted"] {
            let shot = Shot { world: &world, integrator, settings: settings(), size: SIZE };
            shot.render(shot.full_frame(), 0..8, |pass, samples| {
                for ((x, y), sample) in shot.full_frame().pixels().zip(samples) {
                    let leak = luminance(sample);
                    assert!(
                        leak == 0.0,
                        "{integrator}, scale {scale}: {leak} leaks into ({x}, {y}) in pass {pass}"
                    );
                }
            });
        }
    }
}
