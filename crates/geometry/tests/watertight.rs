//! No ray passes through a closed mesh, however exactly it is aimed at a vertex or an edge, at any scale.

use hyaline_geometry::bvh::{MeshBvh, SimdLevel};
use hyaline_geometry::mesh::{Mesh, MeshData, generate};
use hyaline_geometry::{Aggregate, Item, ItemGeometry};
use hyaline_math::{DVec3, Ray, Transform, Vec3};
use hyaline_testkit::Random;
use std::sync::Arc;

/// A closed mesh in a scene, with a point that is inside it.
struct Closed {
    scene: Aggregate,
    mesh: Arc<MeshBvh>,
    transform: Option<Transform>,
    inside: Vec3,
    size: f32,
}

impl Closed {
    fn new(data: MeshData, inside: Vec3, size: f32, transform: Option<Transform>) -> Self {
        let mesh = Arc::new(MeshBvh::new(Mesh::new(data).unwrap()));
        assert!(mesh.mesh().topology().is_closed());
        let item = Item { geometry: ItemGeometry::Mesh { mesh: mesh.clone(), transform }, mask: 1 };
        let inside = transform.map_or(inside, |t| t.point(inside.as_dvec3()).as_vec3());
        Self { scene: Aggregate::build(vec![item]), mesh, transform, inside, size }
    }

    /// A vertex or the middle of an edge of some face.
    fn target(&self, random: &mut Random) -> Vec3 {
        let corners = self.mesh.mesh().corners((random.bits() % self.mesh.mesh().face_count() as u64) as u32);
        let [a, b] = [corners[random.bits() as usize % 3], corners[random.bits() as usize % 3]];
        let p = if a == b { a } else { 0.5 * (a + b) };
        self.transform.map_or(p, |t| t.point(p.as_dvec3()).as_vec3())
    }

    fn crossings(&self, ray: &Ray) -> usize {
        let mut count = 0;
        self.scene.crossings(ray, 1, &mut |_| count += 1);
        count
    }
}

fn meshes(scale: f32) -> Vec<Closed> {
    let center = Vec3::new(0.37, -1.2, 0.55) * scale;
    let knot_core = center + Vec3::X * (0.75 * scale);
    let uneven = Transform::rotate(DVec3::new(1.0, -1.0, 0.4), 1.1)
        .unwrap()
        .after(&Transform::scale(DVec3::new(0.4, 2.0, -0.9)).unwrap());
    vec![
        Closed::new(generate::uv_sphere(center, scale, 600), center, scale, None),
        Closed::new(generate::icosphere(center, scale, 5000), center, scale, None),
        Closed::new(generate::displaced_sphere(center, scale, 20_000, 0.1), center, scale, None),
        Closed::new(generate::torus_knot(center, scale, 20_000, 0.2), knot_core, scale, None),
        Closed::new(generate::icosphere(center, scale, 500), center, scale, Some(uneven)),
    ]
}

#[test]
fn rays_at_vertices_and_edges_never_pass_from_inside() {
    let mut random = Random::from_seed(31);
    let mut leaks = 0;
    let mut rays = 0;
    for scale in [1e-3, 0.1, 1.0, 10.0, 1e4] {
        for closed in meshes(scale) {
            for _ in 0..24_000 {
                let jitter = Vec3::from_array(random.direction().map(|x| x as f32)) * (0.01 * closed.size);
                let origin = closed.inside + jitter * random.uniform_f32();
                let direction = (closed.target(&mut random) - origin).normalize();
                let ray = Ray::new(origin, direction);
                rays += 1;
                leaks += usize::from(closed.scene.closest(&ray, 1).is_none());
                leaks += usize::from(!closed.scene.occluded(&ray, 1));
                leaks += usize::from(closed.crossings(&ray) % 2 == 0);
            }
        }
    }
    assert_eq!(leaks, 0, "of {rays} rays");
    assert!(rays >= 600_000);
}

#[test]
fn rays_at_vertices_and_edges_enter_as_often_as_they_leave_from_outside() {
    let mut random = Random::from_seed(32);
    let mut leaks = 0;
    let mut rays = 0;
    for scale in [1e-3, 0.1, 1.0, 10.0, 1e4] {
        for closed in meshes(scale) {
            let radius = 3.0 * closed.scene.bounds().radius();
            let center = closed.scene.bounds().center();
            for _ in 0..24_000 {
                let origin = center + Vec3::from_array(random.direction().map(|x| x as f32)) * radius;
                let direction = (closed.target(&mut random) - origin).normalize();
                rays += 1;
                leaks += closed.crossings(&Ray::new(origin, direction)) % 2;
            }
        }
    }
    assert_eq!(leaks, 0, "of {rays} rays");
    assert!(rays >= 600_000);
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
