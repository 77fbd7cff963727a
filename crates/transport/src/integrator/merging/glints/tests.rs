//! More looks keep the mean, make speckles fainter, and are left away where they bring nothing.

use super::super::scene_kit::{SceneKit, sphere, walls};
use super::*;
use hyaline_math::DVec3;
use hyaline_scene::{PixelFilter as FilterDescription, Techniques};
use hyaline_testkit::{Moments, welch_t};
use hyaline_world::World;
use hyaline_world::camera::PixelFilter;

const SIZE: u32 = 24;
/// Mean light of the room with a lamp, roughly.
const LIGHT: f32 = 0.1;

fn view() -> View {
    View { camera: 0, width: SIZE, height: SIZE, filter: PixelFilter::new(&FilterDescription::Box) }
}

/// A small lamp in a room, and glass balls before it.
fn glittering(balls: &[(DVec3, f64)]) -> World {
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).matte("matte", 0.5);
    walls(&mut kit);
    kit.lamp("lamp", sphere(DVec3::new(0.05, 0.03, -0.8), 0.06), 100.0);
    for (i, &(center, radius)) in balls.iter().enumerate() {
        kit.solid(&format!("ball {i}"), sphere(center, radius), "glass");
    }
    kit.camera(DVec3::new(0.0, 0.0, 0.9), DVec3::ZERO);
    kit.world()
}

fn small_balls() -> World {
    let at = |i: u32| DVec3::new(-0.1 + 0.1 * f64::from(i % 3), -0.1 + 0.1 * f64::from(i / 3), 0.0);
    glittering(&(0..9).map(|i| (at(i), 0.049)).collect::<Vec<_>>())
}

/// Glints by paths alone and with more looks: means of pictures, a pass each, and what a pixel varies by, on the mean.
fn with_and_without(world: &World, passes: u32) -> ([Moments; 2], [f64; 2]) {
    let settings = RenderSettings { seed: 5, ..RenderSettings::default() };
    let eye = Eye { world, settings: &settings, aim: None, photons: None };
    let (view, mut stats) = (view(), Stats::default());
    let glints = Glints::find(&eye, &view, LIGHT, &mut stats).expect("glints in glass");
    let mut pictures = [(); 2].map(|()| vec![Moments::new(); passes as usize]);
    let mut varies = [0.0; 2];
    for y in 0..SIZE {
        for x in 0..SIZE {
            let mut pixel = [Moments::new(), Moments::new()];
            for pass in 0..passes {
                let mut sampler = Sampler::new(settings.sampler, settings.seed, (x, y), pass);
                let (ray, set) = ray_through(world, &view, (x, y), &mut sampler).expect("a ray");
                let mut draws = Draws { sampler: &mut sampler, stats: &mut stats, tally: Tally::default() };
                let seen = eye.radiance(ray, set, &mut draws, None);
                let looked = glints.look_again(seen, &eye, (&view, (x, y), pass), &mut stats);
                for (i, light) in [seen.glints, looked - seen.light].into_iter().enumerate() {
                    let light = f64::from(light.mean(world.lanes));
                    pixel[i].push(light);
                    pictures[i][pass as usize].push(light);
                }
            }
            for (varies, pixel) in varies.iter_mut().zip(&pixel) {
                *varies += pixel.variance() / f64::from(SIZE * SIZE);
            }
        }
    }
    let means = pictures.map(|passes| {
        let mut means = Moments::new();
        passes.iter().for_each(|pass| means.push(pass.mean()));
        means
    });
    (means, varies)
}

#[test]
fn more_looks_keep_the_mean_and_vary_less() {
    let ([paths, looks], [of_paths, of_looks]) = with_and_without(&small_balls(), 1000);
    let p = welch_t(
        paths.mean(),
        paths.variance_of_mean(),
        paths.count(),
        looks.mean(),
        looks.variance_of_mean(),
        looks.count(),
    );
    assert!(p > 1e-3, "{} and {}, p = {p}", paths.mean(), looks.mean());
    let known = looks.variance_of_mean().sqrt() / looks.mean();
    assert!(known < 0.02, "known to {known} only");
    assert!(of_looks < 0.3 * of_paths, "{of_paths}, with more looks {of_looks}");
}

/// Whether more looks are taken at all, and the share of the picture that they are taken at.
fn looked_at(world: &World, techniques: Techniques, light: f32) -> Option<f64> {
    let settings = RenderSettings { seed: 5, techniques, ..RenderSettings::default() };
    let eye = Eye { world, settings: &settings, aim: None, photons: None };
    let glints = Glints::find(&eye, &view(), light, &mut Stats::default())?;
    let polished = glints.polished.iter().filter(|polished| **polished).count();
    Some(polished as f64 / glints.polished.len() as f64)
}

#[test]
fn more_looks_are_taken_only_at_glass_with_glints() {
    let all = Techniques::default();
    let share = looked_at(&small_balls(), all, LIGHT).expect("glints in glass");
    assert!(0.1 < share && share < 0.7, "{share} of the picture");
    assert_eq!(looked_at(&small_balls(), Techniques { glints: false, ..all }, LIGHT), None, "switched off");
    assert_eq!(looked_at(&glittering(&[]), all, LIGHT), None, "a lamp that is seen directly");
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).sky(1.0);
    kit.solid("ball", sphere(DVec3::Y * 0.3, 0.3), "glass");
    kit.camera(DVec3::new(0.0, 0.6, 1.5), DVec3::Y * 0.2);
    assert_eq!(looked_at(&kit.world(), all, 1.0), None, "an even sky");
}
