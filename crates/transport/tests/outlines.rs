//! Rays that graze the outline of a body, where it is thinner than any error bound.

mod following;
mod scene_kit;

use following::ray;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scattering::{MediumSet, Transport};
use hyaline_scene::{MeshData, ShapeDescription};
use hyaline_testkit::Random;
use hyaline_transport::Stats;
use hyaline_transport::walk::{self, Event};
use hyaline_world::{World, mask};
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

/// Follows a chain of refractions and reflections until it gets away; returns what it is in then, and the vertices met.
fn get_away(world: &World, ray: Ray, index: u32) -> Option<(MediumSet, u32)> {
    let mut sampler = Sampler::new(SamplerKind::Independent, 5, (index, 0), 0);
    let (mut ray, mut set) = (ray, world.camera_media[0].clone());
    for met in 0..256 {
        let event = walk::advance(world, &ray, mask::PATH, &mut set, &mut Stats::default());
        let Event::Surface(vertex) = event else { return Some((set, met)) };
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let scattered = vertex.bsdf.sample(-ray.direction, u_lobe, u, Transport::Radiance)?;
        if scattered.transmits {
            vertex.commit(world, &mut set);
        }
        ray = vertex.leave(scattered.wi, 0.0);
    }
    None
}

#[test]
fn chains_aimed_at_vertices_and_edges_leave_all_that_they_enter() {
    for scale in [1e-3_f64, 1.0, 1e4] {
        let center = DVec3::new(0.37, -1.2, 0.55) * scale;
        let ball = ball_mesh(center.as_vec3(), scale as f32, 16);
        let ShapeDescription::Mesh { mesh, .. } = &ball else { unreachable!() };
        let edges = edges(mesh);
        let mut kit = SceneKit::new();
        kit.medium("glass", 1.5).camera(center + DVec3::Z * (9.0 * scale), center);
        // Shading normals are not reversible and may trap light for good: that is another matter.
        kit.solid("ball", ShapeDescription::Mesh { mesh: mesh.clone(), flat: true }, "glass");
        let world = kit.world();
        let mut random = Random::from_seed(6);
        let (mut entered, mut trapped) = (0, 0);
        for index in 0..100_000 {
            let ([a, b], _) = edges[random.bits() as usize % edges.len()];
            let target = [a, 0.5 * (a + b), a.lerp(b, random.uniform())][random.bits() as usize % 3];
            let origin = center + DVec3::from_array(random.direction()) * (3.0 * scale);
            let Some((set, met)) = get_away(&world, ray(origin, target - origin), index) else {
                trapped += 1;
                continue;
            };
            entered += u32::from(met > 1);
            assert_eq!(set, world.camera_media[0], "scale {scale}, chain {index}, after {met} vertices");
        }
        assert!(
            entered > 50_000 && trapped < 100,
            "scale {scale}: {entered} entered, {trapped} did not get away"
        );
    }
}

/// A point of the line where a mesh is cut by the plane of one `x`.
fn cut(mesh: &MeshData, x: f64, random: &mut Random) -> DVec3 {
    let position = |i: u32| DVec3::from_array(mesh.positions[i as usize].map(f64::from));
    loop {
        let face = mesh.triangles[random.bits() as usize % mesh.triangles.len()].map(position);
        let crossings: Vec<DVec3> = (0..3)
            .map(|i| (face[i], face[(i + 1) % 3]))
            .filter(|(a, b)| (a.x - x) * (b.x - x) < 0.0)
            .map(|(a, b)| a.lerp(b, (x - a.x) / (b.x - a.x)))
            .collect();
        if let [a, b] = crossings[..] {
            return a.lerp(b, random.uniform());
        }
    }
}

/// How many of `count` paths from about the camera, at `start`, to places that `target` makes see any light.
fn leaks(kit: &SceneKit, start: DVec3, count: u32, mut target: impl FnMut(&mut Random) -> DVec3) -> u32 {
    let world = kit.world();
    let mut random = Random::from_seed(9);
    let mut leaks = 0;
    for index in 0..count {
        let target = target(&mut random);
        let origin = start + DVec3::from_array(random.direction()) * 0.2;
        let value = sample(&world, ray(origin, target - origin), world.camera_media[0].clone(), index);
        leaks += u32::from(value > 0.0);
    }
    leaks
}

#[test]
fn no_light_comes_in_where_glass_pokes_through_a_wall() {
    let (center, radius) = (DVec3::new(-1.6, 1.0, -0.3), 0.7);
    let ball = ball_mesh(center.as_vec3(), radius as f32, 8);
    let ShapeDescription::Mesh { mesh, .. } = &ball else { unreachable!() };
    for (start, what) in [(center, "from the glass"), (DVec3::new(0.5, 1.5, 0.8), "from the room")] {
        let mut kit = SceneKit::new();
        kit.medium("glass", 1.5).sky(1.0).matte("wall", 0.5).camera(start, center + DVec3::Y * 0.1);
        kit.surface("room", cuboid(DVec3::new(-2.0, 0.0, -2.0), DVec3::new(2.0, 3.0, 2.0)), "wall");
        kit.solid("ball", ball.clone(), "glass");
        let leaks = leaks(&kit, start, 400_000, |random| {
            // From a tenth of what the coordinates are rounded by to a hundred times it.
            let depth = float::exp(random.between(-17.0, -10.0));
            cut(mesh, -2.0, random) + DVec3::X * depth
        });
        assert_eq!(leaks, 0, "{what}");
    }
}

#[test]
fn no_light_comes_in_at_the_edges_of_a_room() {
    for (from, to) in [
        (DVec3::new(-2.0, 0.0, -2.0), DVec3::new(2.0, 3.0, 2.0)),
        (DVec3::new(-2.7, 0.3, 7.0), DVec3::new(-1.1, 3.7, 9.3)),
    ] {
        let center = 0.5 * (from + to);
        let mut kit = SceneKit::new();
        kit.sky(1.0).matte("wall", 0.5).camera(center, from);
        kit.surface("room", cuboid(from, to), "wall");
        let leaks = leaks(&kit, center, 200_000, |random| {
            let mut at = DVec3::from_array([(); 3].map(|()| f64::from(random.bits() as u32 & 1)));
            at[random.bits() as usize % 3] = random.uniform();
            from + (to - from) * at
        });
        assert_eq!(leaks, 0);
    }
}
