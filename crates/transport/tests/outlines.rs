//! Rays that graze the outline of a body, where it is thinner than any error bound.

mod following;
mod scene_kit;

use following::ray;
use hyaline_math::DVec3;
use hyaline_math::float::f64 as float;
use hyaline_scene::{MeshData, ShapeDescription};
use hyaline_testkit::Random;
use scene_kit::*;
use std::collections::BTreeMap;

/// Edges as pairs of ends with the normals of the two faces that share them.
fn edges(mesh: &MeshData) -> Vec<([DVec3; 2], [DVec3; 2])> {
    let position = |i: u32| DVec3::from_array(mesh.positions[i as usize].map(f64::from));
    let mut normals: BTreeMap<(u32, u32), Vec<DVec3>> = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        let normal = (position(b) - position(a)).cross(position(c) - position(a));
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if normal.length() > 1e-9 {
                normals.entry((from.min(to), from.max(to))).or_default().push(normal.normalize());
            }
        }
    }
    let shared = normals.into_iter().filter(|(_, faces)| faces.len() == 2);
    shared.map(|((a, b), faces)| ([position(a), position(b)], [faces[0], faces[1]])).collect()
}

/// Shoots rays through a ball of triangles, just inside of edges of its outline; all must see the sky's radiance of 1.
fn assert_invisible(kit: &SceneKit, mesh: &MeshData, what: &str) {
    let world = kit.world();
    let edges = edges(mesh);
    let mut random = Random::from_seed(3);
    let mut grazing = 0;
    for index in 0..400_000 {
        let ([a, b], faces) = edges[random.bits() as usize % edges.len()];
        let direction = DVec3::from_array(random.direction());
        if faces[0].dot(direction) * faces[1].dot(direction) >= 0.0 {
            continue;
        }
        grazing += 1;
        // From some roundings of the coordinates up.
        let inward = -(faces[0] + faces[1]).normalize();
        let depth = float::exp(random.between(-14.0, -5.0));
        let p = a + (b - a) * random.uniform() + inward * depth;
        // Fails, too, where something is left that was not entered.
        let value = sample(&world, ray(p - direction * 4.0, direction), world.camera_media[0].clone(), index);
        assert!((value - 1.0).abs() < 1e-4, "{what}: {value} at depth {depth}");
    }
    assert!(grazing > 10_000, "only {grazing} rays graze the outline");
}

#[test]
fn what_is_entered_at_an_outline_is_left_there() {
    let ball = ball_mesh(DVec3::new(-1.2, 0.6, 0.5).as_vec3(), 0.5, 12);
    let ShapeDescription::Mesh { mesh, .. } = &ball else { unreachable!() };
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).medium("water", 1.333).sky(1.0).camera(DVec3::Z * 9.0, DVec3::ZERO);
    kit.solid("mesh", ball.clone(), "glass");
    assert_invisible(&kit, mesh, "alone");
    // Another body reaches into the box about the mesh, so that surfaces are looked at for coincidence: at grazing
    // incidence the far face of an outline is within the error of the near one, measured along the ray.
    kit.solid("other", cuboid(DVec3::new(-0.8, 0.9, 0.8), DVec3::splat(2.0)), "water");
    assert_invisible(&kit, mesh, "beside another body");
}
