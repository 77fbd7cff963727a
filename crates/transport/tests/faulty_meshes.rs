//! Glass meshes with small faults still look like glass: in a uniform environment nearly every sample is 1, and
//! none is black.

mod scene_kit;

use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scene::{MeshData, ShapeDescription};
use hyaline_testkit::Random;
use hyaline_transport::Stats;
use hyaline_transport::integrator::radiance;
use scene_kit::*;
use std::sync::Arc;

const SAMPLES: u32 = 20_000;

/// What samples of a furnace are like.
#[derive(Debug)]
struct Furnace {
    /// How many samples are 1.
    right: u32,
    mean: f64,
    least: f32,
    most: f32,
}

/// Shoots rays at a ball of one medium in a sky of 1; every sample should be 1 where the medium is clear.
fn furnace(mesh: MeshData, sigma_a: f32) -> Furnace {
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", 1.5, [sigma_a; 3], 0);
    kit.solid("ball", ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: false }, "glass");
    kit.sky(1.0).camera(DVec3::new(0.0, 0.0, 40.0), DVec3::ZERO);
    let world = kit.world();
    let mut random = Random::from_seed(3);
    let direction = |random: &mut Random| Vec3::from_array(random.direction().map(|x| x as f32)).normalize();
    let mut result = Furnace { right: 0, mean: 0.0, least: f32::INFINITY, most: 0.0 };
    for index in 0..SAMPLES {
        let from = direction(&mut random) * 3.0;
        let to = direction(&mut random) * (random.uniform_f32() * 0.9);
        let ray = Ray::new(from, (to - from).normalize());
        let settings = settings();
        let mut sampler = Sampler::new(settings.sampler, settings.seed, (index % 4096, index / 4096), 0);
        let set = world.camera_media[0].clone();
        let value = radiance(&world, &settings, ray, set, &mut sampler, &mut Stats::default(), None);
        let value = value.mean(world.lanes);
        result.right += u32::from((value - 1.0).abs() < 1e-4);
        result.mean += f64::from(value) / f64::from(SAMPLES);
        (result.least, result.most) = (result.least.min(value), result.most.max(value));
    }
    result
}

fn ball() -> MeshData {
    let ShapeDescription::Mesh { mesh, .. } = ball_mesh(Vec3::ZERO, 0.9, 16) else { unreachable!() };
    Arc::unwrap_or_clone(mesh)
}

/// Removes some faces, spread over the ball.
fn with_holes(count: usize) -> MeshData {
    let mut mesh = ball();
    for hole in (0..count).rev() {
        mesh.triangles.remove(hole * mesh.triangles.len() / count + 40);
    }
    mesh
}

fn assert_sensible(furnace: &Furnace, least_right: f64, what: &str) {
    eprintln!("{what}: {furnace:?}");
    assert!(f64::from(furnace.right) >= least_right * f64::from(SAMPLES), "{what}: {furnace:?}");
    assert!((furnace.mean - 1.0).abs() < 0.02, "{what}: {furnace:?}");
    assert!(furnace.least > 0.1 && furnace.most < 6.0, "{what}: {furnace:?}");
}

#[test]
fn a_ball_with_a_few_holes_is_nearly_invisible() {
    assert_sensible(&furnace(with_holes(4), 0.0), 0.97, "four of a thousand faces are gone");
}

#[test]
fn a_ball_with_a_flipped_face_is_nearly_invisible() {
    let mut mesh = ball();
    mesh.triangles[500].swap(0, 1);
    assert_sensible(&furnace(mesh, 0.0), 0.98, "a face looks inward");
}

#[test]
fn split_vertices_and_repeated_faces_change_nothing() {
    let smooth = ball();
    let mut mesh = MeshData::default();
    for face in &smooth.triangles {
        for &vertex in face {
            mesh.positions.push(smooth.positions[vertex as usize]);
            mesh.normals.push(smooth.normals[vertex as usize]);
        }
        let last = mesh.positions.len() as u32;
        mesh.triangles.push([last - 3, last - 2, last - 1]);
    }
    mesh.triangles.push(mesh.triangles[300]);
    assert_sensible(&furnace(mesh, 0.0), 1.0, "split vertices, a face twice");
}

#[test]
fn a_ball_that_is_inside_out_is_as_invisible_as_any() {
    let mut mesh = ball();
    mesh.triangles.iter_mut().for_each(|face| face.swap(1, 2));
    assert_sensible(&furnace(mesh, 0.0), 1.0, "inside out");
}

#[test]
fn colored_glass_with_a_few_holes_keeps_its_color() {
    let (whole, holed) = (furnace(ball(), 0.5), furnace(with_holes(4), 0.5));
    assert!((holed.mean / whole.mean - 1.0).abs() < 0.02, "{holed:?} against {whole:?}");
}
