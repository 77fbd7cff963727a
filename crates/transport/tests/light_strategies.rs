//! Lights that are sampled and lights that are hit are the same lights: `path`, which does both under MIS, against
//! an estimate that does nothing but follow BSDF samples until they hit a light.

mod by_hand;
mod following;
mod scene_kit;

use following::ray;
use hyaline_math::{DVec3, Ray, Transform, Vec3, offset_origin};
use hyaline_sampling::Sampler;
use hyaline_scattering::Transport;
use hyaline_scene::*;
use hyaline_spectrum::Spectrum;
use hyaline_testkit::{Moments, welch_t};
use hyaline_transport::Stats;
use hyaline_transport::direct::sky_radiance;
use hyaline_transport::walk::{self, Event};
use hyaline_world::{World, mask};
use scene_kit::*;
use std::sync::Arc;

const SAMPLES: u32 = 80_000;

/// Bounces after which the brute estimate gives up: what is left is below anything the test can see.
const LONGEST: u32 = 64;

/// One estimate of the radiance along `ray` by BSDF sampling alone.
fn brute_sample(world: &World, mut ray: Ray, index: u32) -> f64 {
    let mut sampler =
        Sampler::new(hyaline_sampling::SamplerKind::Independent, 99, (index % 4096, index / 4096), 0);
    let (mut set, mut stats) = (world.camera_media[0].clone(), Stats::default());
    let (mut result, mut throughput) = (Spectrum::ZERO, Spectrum::ONE);
    for _ in 0..LONGEST {
        let vertex = match walk::advance(world, &ray, mask::PATH, &mut set, &mut stats) {
            Event::Sky { transmittance } => {
                result += throughput * transmittance * sky_radiance(world, &ray, None, mask::PATH);
                break;
            }
            Event::Surface(vertex) => vertex,
        };
        throughput *= vertex.transmittance;
        if let Some(light) = vertex.light {
            result +=
                throughput * world.lights.get(light as usize).radiance_from(&vertex.hit, -ray.direction);
        }
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(next) = vertex.bsdf.sample(-ray.direction, u_lobe, u, Transport::Radiance) else { break };
        throughput *= next.weight;
        if next.transmits {
            vertex.commit(world, &mut set);
        }
        let start: Vec3 = offset_origin(vertex.hit.p, vertex.hit.p_error, vertex.hit.ng, next.wi);
        ray = Ray::new(start, next.wi);
    }
    f64::from(result.mean(world.lanes))
}

/// A floor and a wall that light each other, half matte, half shiny; with a ball of glass for caustics.
fn corner() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.camera(DVec3::new(2.0, 1.5, 3.0), DVec3::ZERO);
    let color = |c: f32| ColorSource::Constant([c; 3]);
    let shiny = MaterialKind::Phong {
        diffuse: color(0.4),
        specular: color(0.4),
        exponent: ScalarSource::Constant(15.0),
    };
    kit.matte("matte", 0.6).material("shiny", shiny).medium("glass", 1.5);
    kit.surface("floor", floor(0.0, 2.0), "shiny");
    kit.surface("wall", rectangle(-DVec3::Z, DVec3::X * 2.0, DVec3::Y * 2.0), "matte");
    kit.solid("ball", sphere(DVec3::new(-0.5, 0.4, 0.2), 0.35), "glass");
    kit
}

/// Fails unless both estimates agree on the floor and on the wall.
fn assert_consistent(kit: &SceneKit, what: &str) {
    let world = kit.world();
    let from = DVec3::new(2.0, 1.5, 3.0);
    for target in [DVec3::new(0.2, 0.0, 0.3), DVec3::new(0.3, 0.6, -1.0), DVec3::new(-0.6, 0.0, 0.0)] {
        let view = ray(from, target - from);
        let both = estimate(&world, view, SAMPLES);
        let brute: Moments = (0..SAMPLES).map(|i| brute_sample(&world, view, i)).collect();
        assert!(both.mean() > 0.0, "{what}: no light");
        let p = welch_t(
            both.mean(),
            both.variance_of_mean(),
            both.count(),
            brute.mean(),
            brute.variance_of_mean(),
            brute.count(),
        );
        let error = (both.variance_of_mean() + brute.variance_of_mean()).sqrt() / brute.mean();
        assert!(error < 0.05, "{what} at {target}: an error of {error} shows nothing");
        assert!(
            p > 1e-3,
            "{what} at {target}: {} with light sampling, {} without (p = {p})",
            both.mean(),
            brute.mean()
        );
    }
}

#[test]
fn rectangles_are_hit_as_they_are_sampled() {
    let mut kit = corner();
    kit.lamp("lamp", rectangle(DVec3::new(0.3, 1.2, 0.0), DVec3::X * 0.6, DVec3::Z * 0.4), 3.0);
    assert_consistent(&kit, "rectangle");
}

#[test]
fn discs_are_hit_as_they_are_sampled() {
    let mut kit = corner();
    let disc = ShapeDescription::Disc {
        center: DVec3::new(0.3, 1.1, 0.0),
        normal: DVec3::new(-0.2, -1.0, -0.3),
        radius: 0.5,
        inner_radius: 0.15,
    };
    kit.lamp("lamp", disc, 3.0);
    assert_consistent(&kit, "disc");
}

#[test]
fn spheres_are_hit_as_they_are_sampled() {
    let mut kit = corner();
    kit.lamp("lamp", sphere(DVec3::new(0.5, 0.9, 0.1), 0.4), 3.0);
    assert_consistent(&kit, "sphere");
}

#[test]
fn meshes_are_hit_as_they_are_sampled() {
    let mut kit = corner();
    kit.lamp("lamp", ball_mesh(Vec3::new(0.5, 0.9, 0.1), 0.4, 5), 3.0);
    assert_consistent(&kit, "mesh");
}

#[test]
fn tubes_and_boxes_that_shine_are_hit_as_they_are_sampled() {
    let mut kit = corner();
    kit.lamp("box", cuboid(DVec3::new(0.8, 0.2, -0.2), DVec3::new(1.3, 0.8, 0.4)), 2.0);
    let tube = ShapeDescription::Cylinder {
        radius: 0.4,
        y: [1.0, 1.5],
        phi: [0.0, std::f64::consts::TAU],
        capped: false,
    };
    kit.lamp("tube", tube, 2.0);
    kit.description.objects.last_mut().unwrap().emission.as_mut().unwrap().two_sided = true;
    assert_consistent(&kit, "box and tube");
}

#[test]
fn an_image_of_the_sky_is_hit_as_it_is_sampled() {
    // Mostly dim, with one bright patch and a black row.
    let mut pixels: Vec<Rgb> = (0..16 * 8).map(|i| [0.1 + 0.01 * (i % 7) as f32; 3]).collect();
    pixels[2 * 16 + 5] = [12.0, 6.0, 3.0];
    pixels[4 * 16..5 * 16].fill([0.0; 3]);
    let image = ImageData { width: 16, height: 8, pixels };
    let mut kit = corner();
    let sky = TextureDescription::new("sky", TextureKind::Image(Arc::new(image)));
    kit.description.textures.push(sky.into());
    kit.light(LightKind::Environment {
        radiance: [2.0; 3],
        image: Some("sky".into()),
        placement: Transform::rotate(DVec3::new(0.2, 1.0, 0.1), 2.4).unwrap(),
        visible_to_camera: true,
    });
    assert_consistent(&kit, "image of the sky");
}

#[test]
fn several_lights_share_the_samples_as_they_should() {
    let mut kit = corner();
    kit.lamp("large", rectangle(DVec3::new(0.3, 1.6, 0.0), DVec3::X * 0.9, DVec3::Z * 0.9), 0.5);
    kit.lamp("small", sphere(DVec3::new(1.0, 0.5, 0.3), 0.3), 8.0);
    kit.sky(0.2);
    assert_consistent(&kit, "three lights");
}
