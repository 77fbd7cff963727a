//! Samples depend on seed, pixel and pass alone, and their means converge as statistics demand.

mod pictures;
mod scene_kit;

use hyaline_film::{PixelSample, Rect};
use hyaline_math::DVec3;
use hyaline_sampling::SamplerKind;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_world::World;
use pictures::{Shot, assert_same_picture};
use scene_kit::*;

const SIZE: (u32, u32) = (24, 16);

/// A ball of glass and a shiny one on a floor, between a lamp and a sky.
fn scene() -> World {
    let mut kit = SceneKit::new();
    let color = |c: f32| ColorSource::Constant([c; 3]);
    let shiny = MaterialKind::Phong {
        diffuse: color(0.3),
        specular: color(0.5),
        exponent: ScalarSource::Constant(30.0),
    };
    kit.absorbing_medium("glass", 1.5, [0.1, 0.3, 0.6], 0).matte("matte", 0.6).material("shiny", shiny);
    kit.surface("floor", floor(0.0, 5.0), "matte");
    kit.solid("glass", sphere(DVec3::new(-0.6, 0.5, 0.0), 0.5), "glass");
    kit.surface("ball", sphere(DVec3::new(0.6, 0.5, 0.0), 0.5), "shiny");
    kit.lamp("lamp", rectangle(DVec3::Y * 3.0, DVec3::X * 1.5, DVec3::Z * 1.5), 4.0).sky(0.2);
    kit.camera(DVec3::new(0.0, 1.5, 4.0), DVec3::new(0.0, 0.4, 0.0));
    (kit.description.film.width, kit.description.film.height) = SIZE;
    kit.world()
}

fn shot<'a>(world: &'a World, integrator: &'a str, sampler: SamplerKind, seed: u64) -> Shot<'a> {
    let settings = RenderSettings { sampler, seed, ..RenderSettings::default() };
    Shot { world, integrator, settings, size: SIZE }
}

#[test]
fn tiles_of_any_size_give_the_pixels_of_the_full_frame_bit_for_bit() {
    let world = scene();
    for integrator in ["path", "whitted"] {
        for sampler in [SamplerKind::Sobol, SamplerKind::Independent] {
            let shot = shot(&world, integrator, sampler, 3);
            let mut frames: Vec<Vec<PixelSample>> = Vec::new();
            shot.render(shot.full_frame(), 0..4, |_, samples| frames.push(samples.to_vec()));
            let (w, h) = SIZE;
            for tile in [
                Rect { x0: 0, y0: 0, x1: 1, y1: 1 },
                Rect { x0: 5, y0: 3, x1: 12, y1: 4 },
                Rect { x0: 7, y0: 0, x1: 24, y1: 16 },
                Rect { x0: w - 1, y0: h - 1, x1: w, y1: h },
            ] {
                // Later passes alone, too.
                shot.render(tile, 2..4, |pass, samples| {
                    for ((x, y), sample) in tile.pixels().zip(samples) {
                        let whole = &frames[pass as usize][(y * w + x) as usize];
                        let bits = |s: &PixelSample| {
                            (
                                s.beauty.map(f32::to_bits),
                                s.normal.map(f32::to_bits),
                                s.depth.map(f32::to_bits),
                                s.object,
                            )
                        };
                        assert_eq!(bits(sample), bits(whole), "{integrator}, ({x}, {y}), pass {pass}");
                    }
                });
            }
            assert_ne!(frames[0], frames[1], "{integrator}: two passes are the same");
        }
    }
}

/// Sum over tiles of the variance of the mean of `passes` passes, from `seeds` renders of their own.
fn variance_between_seeds(world: &World, sampler: SamplerKind, passes: u32, seeds: u64) -> f64 {
    let means = |seed: u64| -> Vec<f64> {
        shot(world, "path", sampler, 1000 + seed).tiles(4, 0..passes).iter().map(Moments::mean).collect()
    };
    let renders: Vec<Vec<f64>> = (0..seeds).map(means).collect();
    (0..renders[0].len()).map(|tile| renders.iter().map(|r| r[tile]).collect::<Moments>().variance()).sum()
}

#[test]
fn the_variance_of_the_mean_falls_as_one_over_the_number_of_passes() {
    let world = scene();
    let counts = [4_u32, 16, 64];
    let variances = counts.map(|passes| variance_between_seeds(&world, SamplerKind::Independent, passes, 40));
    // Least squares in the logarithms; three equidistant points need only the outer ones.
    let ln = |x: f64| hyaline_math::float::f64::ln(x);
    let slope = ln(variances[2] / variances[0]) / ln(f64::from(counts[2]) / f64::from(counts[0]));
    assert!((slope + 1.0).abs() < 0.1, "the slope is {slope}: {variances:?}");
    // What one render says of its own error is what the renders say of each other.
    let own: f64 = shot(&world, "path", SamplerKind::Independent, 1)
        .tiles(4, 0..64)
        .iter()
        .map(Moments::variance_of_mean)
        .sum();
    assert!((own / variances[2] - 1.0).abs() < 0.35, "{own} claimed, {} found", variances[2]);
}

#[test]
fn sobol_points_give_the_same_picture_with_less_variance() {
    let world = scene();
    let independent = shot(&world, "path", SamplerKind::Independent, 1).tiles(4, 0..512);
    // Passes of one Sobol render depend on each other; renders of different seeds do not.
    let mut sobol = vec![Moments::new(); independent.len()];
    for seed in 0..32 {
        let tiles = shot(&world, "path", SamplerKind::Sobol, 50 + seed).tiles(4, 0..16);
        sobol.iter_mut().zip(tiles).for_each(|(sum, tile)| sum.push(tile.mean()));
    }
    assert_same_picture(&sobol, &independent, 0.01, "Sobol and independent points");
    let of_sobol = variance_between_seeds(&world, SamplerKind::Sobol, 16, 24);
    let of_independent = variance_between_seeds(&world, SamplerKind::Independent, 16, 24);
    assert!(of_sobol < 0.8 * of_independent, "variances {of_sobol} and {of_independent}");
}
