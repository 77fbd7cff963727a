//! No ray passes through a closed mesh, however exactly it is aimed at a vertex or an edge, at any scale.

mod closed;

use closed::{Closed, SCALES};
use hyaline_geometry::bvh::SimdLevel;
use hyaline_geometry::mesh::MeshData;
use hyaline_math::{Ray, Vec3};
use hyaline_testkit::Random;

/// Rays for each mesh at each scale; `examples/watertight.rs` traces many more.
const RAYS: usize = 20_000;

#[test]
fn rays_at_vertices_and_edges_never_pass_from_inside() {
    let mut random = Random::from_seed(31);
    for closed in SCALES.into_iter().flat_map(Closed::all) {
        for _ in 0..RAYS {
            let ray = closed.ray_from_inside(&mut random);
            assert!(!closed.leaks_from_inside(&ray), "{ray:?}");
        }
    }
}

#[test]
fn rays_at_vertices_and_edges_enter_as_often_as_they_leave_from_outside() {
    let mut random = Random::from_seed(32);
    for closed in SCALES.into_iter().flat_map(Closed::all) {
        for _ in 0..RAYS {
            let ray = closed.ray_from_outside(&mut random);
            assert!(closed.crossings(&ray).is_multiple_of(2), "{ray:?}");
        }
    }
}

#[test]
fn what_is_reflected_near_an_edge_stays_inside() {
    let mut random = Random::from_seed(33);
    for closed in SCALES.into_iter().flat_map(Closed::acute) {
        for _ in 0..RAYS {
            assert!(closed.bounce(&mut random, 4).1, "{:?}", closed.scene.bounds());
        }
    }
}

#[test]
fn rays_in_the_planes_and_along_the_edges_of_a_box_see_it_closed() {
    // Everything is exact here, so each ray meets vertices, edges and diagonals exactly.
    let data = MeshData {
        positions: (0..8)
            .map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - 1.0)
            .collect(),
        triangles: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        ..MeshData::default()
    };
    let closed = Closed::new(data, Vec3::ZERO, 1.0, None);
    assert!(closed.mesh.mesh().signed_volume() > 7.9);
    for level in SimdLevel::ALL.into_iter().filter(|level| level.is_supported()) {
        let scene = closed.scene.clone().with_simd_level(level);
        for i in 0..5_i32.pow(3) {
            let origin = Vec3::new((i % 5 - 2) as f32, (i / 5 % 5 - 2) as f32, (i / 25 - 2) as f32) * 0.25;
            for j in (0..27).filter(|&j| j != 13) {
                let target = Vec3::new((j % 3 - 1) as f32, (j / 3 % 3 - 1) as f32, (j / 9 - 1) as f32);
                let ray = Ray::new(origin, (target - origin).normalize());
                let mut count = 0;
                scene.crossings(&ray, 1, &mut |_| count += 1);
                assert_eq!(count, 1, "{level:?} {ray:?}");
                let outside = Ray::new(origin - 3.0 * target, target.normalize());
                let mut count = 0;
                scene.crossings(&outside, 1, &mut |_| count += 1);
                assert!(count % 2 == 0, "{level:?} {outside:?}");
            }
        }
    }
}
