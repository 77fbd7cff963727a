//! One glass of water built as a vessel, of overlapping bodies and of interfaces is one glass of water: the same
//! boundaries along every ray, in both directions, and the same picture.

mod scene_kit;
mod snell_tracer;
mod three_glasses;

use hyaline_math::{DVec3, Ray, Vec2, offset_origin};
use hyaline_sampling::Sampler;
use hyaline_scattering::{Crossing, MediumSet};
use hyaline_scene::IndexDescription;
use hyaline_testkit::{Moments, Random, sidak, welch_t};
use hyaline_transport::integrator::radiance;
use hyaline_transport::{RenderSettings, Stats};
use hyaline_world::{World, mask};
use rayon::prelude::*;
use scene_kit::*;
use snell_tracer::{Medium, Scene};
use three_glasses::{HEIGHT, WATER, WAYS, Way, glass_of_water, traced_glass};

/// Rays that each glass is looked at along.
const RAYS: usize = 100_000;
/// Distance of the rays that tell whether a ray is too near to an edge for `f32`, relative to the glass.
const BESIDE: f64 = 1e-5;
/// Roundings of `f32` that each boundary may add to the place of the next.
const ROUNDINGS: f64 = 16.0;
/// Length of the rays.
const REACH: f64 = 6.0 * HEIGHT;

/// Boundaries along a ray: distance, and the media on the near and the far side.
type Boundaries = Vec<(f64, Medium, Medium)>;

#[test]
fn a_glass_built_in_any_way_has_the_same_boundaries_along_every_ray_in_both_directions() {
    let scene = traced_glass();
    let worlds = WAYS.map(|way| (way, seen_from_afar(way)));
    let mut random = Random::from_seed(3);
    let (mut compared, mut undecided, mut boundaries) = (0, 0, 0);
    while compared < RAYS {
        let ray = random_ray(&mut random);
        let back = Ray::new(ray.at(REACH as f32), -ray.direction);
        let (Some(forward), Some(backward)) = (expected(&scene, &ray), expected(&scene, &back)) else {
            undecided += 1;
            continue;
        };
        assert_eq!(media_of(&forward.0), turned(media_of(&backward.0)), "the tracer contradicts itself");
        for (way, world) in &worlds {
            assert_same(&walk_straight(world, &ray), &forward, &format!("{way:?}, {ray:?}"));
            assert_same(&walk_straight(world, &back), &backward, &format!("{way:?} backward, {ray:?}"));
        }
        compared += 1;
        boundaries += forward.0.len();
    }
    println!("{boundaries} boundaries, {undecided} rays undecided");
    assert!(boundaries > 3 * RAYS, "only {boundaries} boundaries were met");
    assert!(undecided < RAYS / 200, "{undecided} rays were undecided");
}

/// The glass alone, the camera outside of it.
fn seen_from_afar(way: Way) -> World {
    let mut kit = glass_of_water(way);
    kit.camera(DVec3::Z * REACH, DVec3::ZERO);
    kit.world()
}

fn media_of(list: &Boundaries) -> Vec<(Medium, Medium)> {
    list.iter().map(|&(_, from, to)| (from, to)).collect()
}

fn turned(mut media: Vec<(Medium, Medium)>) -> Vec<(Medium, Medium)> {
    media.reverse();
    media.into_iter().map(|(from, to)| (to, from)).collect()
}

fn assert_same(seen: &Boundaries, (expected, allowed): &(Boundaries, Vec<f64>), what: &str) {
    assert_eq!(media_of(seen), media_of(expected), "{what}: {seen:?} instead of {expected:?}");
    for ((seen, expected), allowed) in seen.iter().zip(expected).zip(allowed) {
        let error = (seen.0 - expected.0).abs();
        assert!(error <= *allowed, "{what}: {seen:?} is {error:e} off {expected:?}, {allowed:e} are allowed");
    }
}

/// A ray from a ball about the glass to a point in or near it.
fn random_ray(random: &mut Random) -> Ray {
    let center = DVec3::Y * (0.5 * HEIGHT);
    let direction = |random: &mut Random| DVec3::from_array(random.direction());
    let from = (center + direction(random) * (0.5 * REACH)).as_vec3();
    let to = (center + direction(random) * (0.6 * HEIGHT * random.uniform())).as_vec3();
    Ray::new(from, (to - from).normalize())
}

/// What the tracer finds along a ray and how far each place may be off; `None` where rays beside it find other media.
fn expected(scene: &Scene, ray: &Ray) -> Option<(Boundaries, Vec<f64>)> {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize());
    let list = scene.straight(&snell_tracer::Ray { origin, direction })?;
    let mut spread = vec![1.0; list.len()];
    let (s, t) = direction.any_orthonormal_pair();
    for side in [s, t, -s, -t] {
        let beside = snell_tracer::Ray { origin: origin + side * BESIDE * scene.size, direction };
        let other = scene.straight(&beside)?;
        if media_of(&other) != media_of(&list) {
            return None;
        }
        for (spread, (a, b)) in spread.iter_mut().zip(list.iter().zip(&other)) {
            *spread = f64::max(*spread, (a.0 - b.0).abs() / (BESIDE * scene.size));
        }
    }
    let roundings = ROUNDINGS * f64::from(f32::EPSILON) * REACH;
    let allowed = (1..).zip(&spread).map(|(count, spread)| f64::from(count) * roundings * spread).collect();
    Some((list, allowed))
}

/// What the renderer finds along a ray that nothing bends.
fn walk_straight(world: &World, ray: &Ray) -> Boundaries {
    let mut set: MediumSet = world.camera_media[0].clone();
    let mut list = Vec::new();
    let mut rest = *ray;
    while let Some(candidate) = world.geometry.closest(&rest, mask::PATH) {
        let mut refuse = |object| panic!("{ray:?} leaves {object:?} and never entered it");
        let (hit, encounter) = world.meet(&rest, &candidate, &mut set, mask::PATH, &mut refuse);
        // Walls that separate a medium from itself are no boundaries.
        if let Some(Crossing::Boundary { from, to, .. }) = encounter.crossing
            && from != to
        {
            let t = (hit.p - ray.origin).as_dvec3().dot(ray.direction.as_dvec3());
            list.push((t, from.index(), to.index()));
        }
        encounter.commit(world, &mut set);
        rest.origin = offset_origin(hit.p, hit.p_error, hit.ng, rest.direction);
    }
    list
}

/// Pixels along each edge of the pictures.
const SIZE: u32 = 12;
/// Samples per pixel.
const SAMPLES: u32 = 1500;
/// Probability that the comparison of all pictures rejects pictures that are equal.
const LEVEL: f64 = 0.01;

#[test]
fn a_glass_built_in_any_way_gives_the_same_picture() {
    let pictures = WAYS.map(|way| (way, render(glass_of_water(way), way as u64 + 1)));
    let [(_, first), others @ ..] = &pictures;
    let relative: f64 =
        first.iter().map(|m| m.variance_of_mean().sqrt() / m.mean()).sum::<f64>() / first.len() as f64;
    assert!(relative < 0.05, "pixels are uncertain by {relative}: too much to tell anything");
    let level = sidak(LEVEL, first.len() * others.len());
    for (way, picture) in others {
        let (worst, p) = least_likely(first, picture);
        assert!(
            p > level,
            "{way:?}: value {worst} differs from the vessel's with p = {p:e}: {} and {}",
            picture[worst].mean(),
            first[worst].mean()
        );
    }
}

#[test]
fn water_of_an_index_five_percent_higher_is_noticed() {
    let mut wrong = glass_of_water(Way::Interfaces);
    wrong.description.media[WATER - 1].index = IndexDescription::Constant(1.4);
    let right = render(glass_of_water(Way::Interfaces), 1);
    let (_, p) = least_likely(&right, &render(wrong, 2));
    assert!(p < sidak(LEVEL, 3 * right.len()), "p = {p}");
}

/// The pair that differs most for what chance allows, and the chance.
fn least_likely(a: &[Moments], b: &[Moments]) -> (usize, f64) {
    let chance = |(a, b): (&Moments, &Moments)| {
        let (n, m) = (a.count(), b.count());
        welch_t(a.mean(), a.variance_of_mean(), n, b.mean(), b.variance_of_mean(), m)
    };
    a.iter().zip(b).map(chance).enumerate().min_by(|x, y| x.1.total_cmp(&y.1)).unwrap()
}

/// A picture of the glass on a table under a lamp and a dim sky: red, green and blue of each pixel.
fn render(mut kit: SceneKit, seed: u64) -> Vec<Moments> {
    kit.description.film.width = SIZE;
    kit.description.film.height = SIZE;
    kit.camera(DVec3::new(0.0, 0.16, 0.34), DVec3::new(0.0, 0.045, 0.0)).matte("table", 0.6);
    let half = DVec3::new(0.25, 0.0, 0.25);
    // Its normal is down.
    let lamp = rectangle(DVec3::new(0.1, 0.5, 0.1), DVec3::X * half.x, DVec3::Z * half.z);
    kit.surface("table", floor(0.0, 2.0), "table").lamp("lamp", lamp, 4.0).sky(0.5);
    let world = kit.world();
    let settings = RenderSettings { seed, ..settings() };
    let pixels: Vec<(u32, u32)> = (0..SIZE * SIZE).map(|i| (i % SIZE, i / SIZE)).collect();
    let values: Vec<[Moments; 3]> =
        pixels.par_iter().map(|&pixel| render_pixel(&world, &settings, pixel)).collect();
    values.into_iter().flatten().collect()
}

fn render_pixel(world: &World, settings: &RenderSettings, pixel: (u32, u32)) -> [Moments; 3] {
    let mut moments = [Moments::new(); 3];
    for pass in 0..SAMPLES {
        let mut sampler = Sampler::new(settings.sampler, settings.seed, pixel, pass);
        let film = Vec2::new(pixel.0 as f32, pixel.1 as f32) + sampler.next_2d();
        let ray = world.cameras[0].ray(film, sampler.next_2d()).unwrap();
        let (set, mut stats) = (world.camera_media[0].clone(), Stats::default());
        let value = radiance(world, settings, ray, set, &mut sampler, &mut stats, None);
        assert!(stats.never_entered.is_empty(), "left what was never entered: {:?}", stats.never_entered);
        moments.iter_mut().zip(value.to_rgb()).for_each(|(moments, x)| moments.push(f64::from(x)));
    }
    moments
}
