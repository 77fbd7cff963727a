use super::*;
use crate::mesh::{Mesh, MeshData, generate};
use crate::shape::{Rectangle, Shape, Sphere};
use hyaline_math::float::powf;
use hyaline_math::{DVec3, offset_origin};
use hyaline_testkit::Random;

fn vector(random: &mut Random, size: f32) -> Vec3 {
    Vec3::from_array(random.direction().map(|x| x as f32)) * size
}

fn levels() -> impl Iterator<Item = SimdLevel> {
    SimdLevel::ALL.into_iter().filter(|level| level.is_supported())
}

fn bvh(data: MeshData) -> Arc<MeshBvh> {
    Arc::new(MeshBvh::new(Mesh::new(data).unwrap()))
}

fn mesh(mesh: &Arc<MeshBvh>, transform: Option<Transform>) -> Item {
    Item { geometry: ItemGeometry::Mesh { mesh: mesh.clone(), transform }, mask: 0xff }
}

fn sphere(center: DVec3, radius: f64) -> Item {
    let shape = Primitive::new(Shape::Sphere(Sphere::new(radius).unwrap()));
    Item { geometry: ItemGeometry::Shape(shape.placed(&Transform::translate(center))), mask: 0xff }
}

/// Uneven scaling, a mirror, and a turn.
fn uneven(center: DVec3, factors: DVec3) -> Transform {
    let turn = Transform::rotate(DVec3::new(1.0, 2.0, -0.5), 0.8).unwrap();
    Transform::translate(center).after(&turn).after(&Transform::scale(factors).unwrap())
}

/// Meshes, instances and shapes that overlap, at some scale.
fn mixed_items(scale: f64) -> Vec<Item> {
    let s = scale as f32;
    let knot = bvh(generate::torus_knot(Vec3::ZERO, 1.5 * s, 2000, 0.2));
    let ball = bvh(generate::hollow_ball(Vec3::splat(0.2 * s), 0.5 * s, 0.1, 800));
    let wall =
        Rectangle::new(DVec3::Z * 2.0 * scale, DVec3::X * 3.0 * scale, DVec3::Y * 3.0 * scale).unwrap();
    let mut items = vec![
        mesh(&knot, None),
        mesh(&knot, Some(uneven(DVec3::X * scale, DVec3::new(0.5, 1.2, -0.3)))),
        sphere(DVec3::splat(0.3 * scale), 0.4 * scale),
        mesh(&ball, None),
        mesh(&ball, Some(uneven(-DVec3::Y * scale, DVec3::new(20.0, 0.01, 1.0)))),
        Item { geometry: ItemGeometry::Shape(Primitive::new(Shape::Rectangle(wall))), mask: 0xff },
    ];
    for i in 0..12 {
        let center = DVec3::new(f64::from(i % 4), f64::from(i / 4), -1.0) * 0.5 * scale;
        items.push(if i % 2 == 0 {
            sphere(center, 0.2 * scale)
        } else {
            mesh(&ball, Some(Transform::translate(center)))
        });
    }
    for (i, item) in items.iter_mut().enumerate() {
        item.mask = 1 << (i % 3);
    }
    items
}

/// All crossings, without a tree.
fn brute_force(items: &[Item], ray: &Ray, mask: u8) -> Vec<Candidate> {
    let mut found = Vec::new();
    for (item, object) in items.iter().enumerate().filter(|(_, object)| object.mask & mask != 0) {
        match &object.geometry {
            ItemGeometry::Shape(shape) => shape.crossings(ray, &mut |t| {
                found.push(Candidate { t, item: item as u32, primitive: 0, barycentric: Vec2::ZERO });
            }),
            ItemGeometry::Mesh { mesh, transform } => {
                let local = match transform {
                    Some(transform) => LocalRay::from_placed(ray, transform),
                    None => LocalRay::from_world(ray),
                };
                for primitive in 0..mesh.mesh().face_count() as u32 {
                    if let Some(hit) = local.triangle(mesh.mesh().corners(primitive)) {
                        let barycentric = hit.barycentric;
                        found.push(Candidate { t: hit.t, item: item as u32, primitive, barycentric });
                    }
                }
            }
        }
    }
    found.sort_by(|a, b| a.t.total_cmp(&b.t).then((a.item, a.primitive).cmp(&(b.item, b.primitive))));
    found
}

#[test]
fn every_query_agrees_with_brute_force_bit_for_bit_at_each_level() {
    let mut random = Random::from_seed(21);
    let mut crossing_count = 0;
    for scale in [1e-3, 1.0, 1e4] {
        let aggregate = Aggregate::build(mixed_items(scale));
        let scenes: Vec<Aggregate> = levels().map(|level| aggregate.clone().with_simd_level(level)).collect();
        for i in 0..2000 {
            let s = scale as f32;
            let reach = 3.0 * s * random.uniform_f32();
            let origin = vector(&mut random, reach);
            let mut direction = (vector(&mut random, s) - origin).normalize();
            if i % 10 == 0 {
                // Along an axis, where slabs degenerate.
                direction = Vec3::AXES[i / 10 % 3];
            }
            let mut ray = Ray::new(origin, direction);
            if i % 3 == 0 {
                ray.t_min = random.uniform_f32() * s;
                ray.t_max = ray.t_min + 2.0 * random.uniform_f32() * s;
            }
            let mask = if i % 4 == 0 { random.bits() as u8 & 7 } else { 7 };
            let expected = brute_force(aggregate.items(), &ray, mask);
            crossing_count += expected.len();
            for scene in &scenes {
                assert_eq!(scene.closest(&ray, mask), expected.first().copied(), "{:?}", scene.simd_level());
                assert_eq!(scene.occluded(&ray, mask), !expected.is_empty());
                let mut found = Vec::new();
                scene.crossings(&ray, mask, &mut |hit| found.push(hit));
                found.sort_by(|a, b| {
                    a.t.total_cmp(&b.t).then((a.item, a.primitive).cmp(&(b.item, b.primitive)))
                });
                assert_eq!(found, expected);
            }
        }
    }
    assert!(crossing_count > 10_000);
}

#[test]
fn an_instance_is_the_transformed_mesh() {
    let mut random = Random::from_seed(22);
    for scale in [1e-3, 1.0, 1e4] {
        let transform = uneven(DVec3::new(0.3, -0.1, 0.2) * scale, DVec3::new(2.0, 0.3, -0.7) * scale);
        let data = generate::displaced_sphere(Vec3::ZERO, 1.0, 5000, 0.1);
        let mut baked = data.clone();
        baked.positions.iter_mut().for_each(|p| *p = transform.point(p.as_dvec3()).as_vec3());
        baked.triangles.iter_mut().for_each(|face| face.swap(0, 1));
        baked.normals = None;
        let instance = Aggregate::build(vec![mesh(&bvh(data), Some(transform))]);
        let baked = Aggregate::build(vec![mesh(&bvh(baked), None)]);
        let mut hits = 0;
        for _ in 0..5000 {
            let origin = vector(&mut random, 4.0 * scale as f32);
            let target = vector(&mut random, 0.3 * scale as f32);
            let ray = Ray::new(origin, (target - origin).normalize());
            let (Some(a), Some(b)) = (instance.closest(&ray, 1), baked.closest(&ray, 1)) else { continue };
            hits += 1;
            let (a, b) = (instance.surface(&ray, &a), baked.surface(&ray, &b));
            assert!((a.t - b.t).abs() < 1e-4 * a.t, "{} {}", a.t, b.t);
            assert!((a.p - b.p).length() < 1e-4 * scale as f32);
            assert!(a.primitive != b.primitive || a.ng.dot(b.ng) > 0.999);
            assert!(a.n.dot(a.ng) > 0.0);
        }
        assert!(hits > 4000);
    }
}

/// Number of crossings ahead.
fn crossings_ahead(scene: &Aggregate, origin: Vec3, direction: Vec3) -> usize {
    let mut count = 0;
    scene.crossings(&Ray::new(origin, direction), 0xff, &mut |_| count += 1);
    count
}

#[test]
fn a_ray_that_leaves_a_surface_starts_on_the_side_it_goes_to() {
    let mut random = Random::from_seed(23);
    let mut hits = 0;
    for scale in [1e-3, 0.1, 1.0, 30.0, 1e4] {
        let s = scale as f32;
        let shell = generate::hollow_ball(Vec3::new(0.1, 0.7, -0.4) * s, s, 0.05, 3000);
        let stretched = uneven(DVec3::new(3.0, -1.0, 2.0) * scale, DVec3::new(0.2, 3.0, -1.0));
        for transform in [None, Some(stretched)] {
            let scene = Aggregate::build(vec![mesh(&bvh(shell.clone()), transform)]);
            let center = scene.bounds().center();
            for _ in 0..10_000 {
                let origin = center + vector(&mut random, scene.bounds().radius());
                let reach = 0.8 * s * random.uniform_f32();
                let target = center + vector(&mut random, reach);
                let ray = Ray::new(origin, (target - origin).normalize());
                let Some(hit) = scene.closest(&ray, 0xff) else { continue };
                let surface = scene.surface(&ray, &hit);
                hits += 1;
                // From nearly along the surface to straight off it, on either side.
                let grazing = powf(10.0, -5.0 * random.uniform_f32());
                let tangent = surface.ng.cross(vector(&mut random, 1.0)).normalize();
                for side in [1.0, -1.0] {
                    let direction = (tangent + grazing * side * surface.ng).normalize();
                    let start = offset_origin(surface.p, surface.p_error, surface.ng, direction);
                    let next = scene.closest(&Ray::new(start, direction), 0xff);
                    assert!(next.is_none_or(|next| next.primitive != hit.primitive), "{scale} {transform:?}");
                    let is_inside = crossings_ahead(&scene, start, direction) % 2 == 1;
                    assert_eq!(is_inside, side < 0.0, "{scale} {transform:?} {surface:?} {direction}");
                }
            }
        }
    }
    assert!(hits > 80_000, "{hits}");
}

#[test]
fn ties_go_to_the_lowest_item_and_face() {
    let face = |count| MeshData {
        positions: vec![Vec3::new(-1.0, -1.0, 2.0), Vec3::new(1.0, -1.0, 2.0), Vec3::new(0.0, 1.0, 2.0)],
        triangles: vec![[0, 1, 2]; count],
        ..MeshData::default()
    };
    let items = vec![sphere(DVec3::Z * 9.0, 1.0), mesh(&bvh(face(50)), None), mesh(&bvh(face(3)), None)];
    let scene = Aggregate::build(items);
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    for level in levels() {
        let scene = scene.clone().with_simd_level(level);
        let hit = scene.closest(&ray, 0xff).unwrap();
        assert_eq!((hit.t, hit.item, hit.primitive), (2.0, 1, 0));
        let mut count = 0;
        scene.crossings(&ray, 0xff, &mut |_| count += 1);
        assert_eq!(count, 55);
    }
}

#[test]
fn an_empty_scene_and_a_single_triangle_work() {
    let empty = Aggregate::build(Vec::new());
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    assert!(empty.bounds().is_empty());
    assert_eq!(empty.closest(&ray, 0xff), None);
    assert!(!empty.occluded(&ray, 0xff));
    let triangle = MeshData {
        positions: vec![Vec3::new(-1.0, -1.0, 2.0), Vec3::new(1.0, -1.0, 2.0), Vec3::new(0.0, 1.0, 2.0)],
        triangles: vec![[0, 1, 2]],
        ..MeshData::default()
    };
    let scene = Aggregate::build(vec![mesh(&bvh(triangle), None)]);
    assert_eq!(scene.closest(&ray, 0xff).map(|hit| hit.t), Some(2.0));
    assert_eq!(scene.closest(&ray, 0), None);
    assert_eq!(scene.closest(&Ray { t_min: 2.0, ..ray }, 0xff), None);
}

#[test]
fn slivers_and_triangles_of_all_sizes_are_found() {
    let mut random = Random::from_seed(24);
    let mut data = MeshData::default();
    for i in 0..3000_u32 {
        let size = powf(10.0, 12.0 * random.uniform_f32() - 8.0);
        let center = vector(&mut random, 10.0);
        let (long, short) = (vector(&mut random, size), vector(&mut random, size * 1e-6));
        data.positions.extend([
            center,
            center + long,
            center + if i % 2 == 0 { short } else { Vec3::new(long.z, long.x, long.y) },
        ]);
        data.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let items = vec![mesh(&bvh(data), None)];
    let scene = Aggregate::build(items);
    for level in levels() {
        let scene = scene.clone().with_simd_level(level);
        for _ in 0..300 {
            let origin = vector(&mut random, 12.0);
            let ray = Ray::new(origin, vector(&mut random, 1.0).normalize());
            assert_eq!(scene.closest(&ray, 0xff), brute_force(scene.items(), &ray, 0xff).first().copied());
        }
    }
}

#[test]
fn rays_that_are_not_finite_hit_nothing_and_end() {
    let scene = Aggregate::build(mixed_items(1.0));
    for bad in [Vec3::NAN, Vec3::INFINITY, Vec3::splat(f32::MAX)] {
        for level in levels() {
            let scene = scene.clone().with_simd_level(level);
            assert_eq!(scene.closest(&Ray::new(bad, Vec3::X), 0), None);
            let _ = scene.closest(&Ray::new(bad, Vec3::X), 7);
            let _ = scene.closest(&Ray::new(Vec3::ZERO, bad), 7);
        }
    }
    assert_eq!(scene.closest(&Ray::new(Vec3::ZERO, Vec3::NAN), 1), None);
}
