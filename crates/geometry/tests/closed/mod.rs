//! Closed meshes, and rays aimed where meshes leak: exactly at vertices and at points of edges.

use hyaline_geometry::bvh::MeshBvh;
use hyaline_geometry::mesh::{Mesh, MeshData, generate};
use hyaline_geometry::{Aggregate, Item, ItemGeometry};
use hyaline_math::{DVec3, Ray, Transform, Vec3, offset_origin};
use hyaline_testkit::Random;
use std::sync::Arc;

/// Sizes of the meshes, scene units.
pub(crate) const SCALES: [f32; 6] = [1e-3, 0.1, 1.0, 10.0, 1e3, 1e4];

/// A closed mesh in a scene, with a point that is inside it.
pub(crate) struct Closed {
    /// The scene, which holds nothing else.
    pub(crate) scene: Aggregate,
    /// The mesh.
    pub(crate) mesh: Arc<MeshBvh>,
    transform: Option<Transform>,
    inside: Vec3,
    size: f32,
}

impl Closed {
    /// - `size`: about the radius of the mesh.
    pub(crate) fn new(data: MeshData, inside: Vec3, size: f32, transform: Option<Transform>) -> Self {
        let mesh = Arc::new(MeshBvh::new(Mesh::new(data).unwrap()));
        assert!(mesh.mesh().topology().is_closed());
        let item = Item { geometry: ItemGeometry::Mesh { mesh: mesh.clone(), transform }, mask: 1 };
        let inside = transform.map_or(inside, |t| t.point(inside.as_dvec3()).as_vec3());
        Self { scene: Aggregate::build(vec![item]), mesh, transform, inside, size }
    }

    /// Meshes of all kinds: with a fan of slivers at the poles, even, rippled, winding, and placed by a map that
    /// scales unevenly and mirrors.
    pub(crate) fn all(scale: f32) -> Vec<Self> {
        let center = Vec3::new(0.37, -1.2, 0.55) * scale;
        let knot_core = center + Vec3::X * (0.75 * scale);
        let uneven = Transform::rotate(DVec3::new(1.0, -1.0, 0.4), 1.1)
            .unwrap()
            .after(&Transform::scale(DVec3::new(0.4, 2.0, -0.9)).unwrap());
        vec![
            Self::new(generate::uv_sphere(center, scale, 600), center, scale, None),
            Self::new(generate::icosphere(center, scale, 5000), center, scale, None),
            Self::new(generate::displaced_sphere(center, scale, 20_000, 0.1), center, scale, None),
            Self::new(generate::torus_knot(center, scale, 20_000, 0.2), knot_core, scale, None),
            Self::new(generate::icosphere(center, scale, 500), center, scale, Some(uneven)),
        ]
    }

    /// Meshes whose faces meet at acute angles, of 70, 53 and 28 degrees at the base, plain and placed by a map.
    pub(crate) fn acute(scale: f32) -> Vec<Self> {
        let center = Vec3::new(0.37, -1.2, 0.55) * scale;
        let turned = Transform::rotate(DVec3::new(1.0, -1.0, 0.4), 1.1).unwrap();
        let pyramid = |height: f32, transform| {
            let corner = |x, y, z| center + Vec3::new(x, y, z) * scale;
            let ring = [corner(1., 0., 1.), corner(1., 0., -1.), corner(-1., 0., -1.), corner(-1., 0., 1.)];
            let positions = ring.into_iter().chain([corner(0.0, height, 0.0)]).collect();
            let triangles = vec![[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
            let data = MeshData { positions, triangles, ..MeshData::default() };
            Self::new(data, corner(0.0, 0.25 * height, 0.0), 0.2 * height * scale, transform)
        };
        vec![pyramid(2.75, None), pyramid(1.33, Some(turned)), pyramid(0.53, None)]
    }

    /// Follows a chain of diffuse reflections inside, the first of them at an edge; returns the rays traced, and whether
    /// all of them met a face from inside.
    pub(crate) fn bounce(&self, random: &mut Random, limit: usize) -> (usize, bool) {
        let mut ray = self.ray_from_inside(random);
        for count in 1..=limit {
            let Some(candidate) = self.scene.closest(&ray, 1) else { return (count, false) };
            let hit = self.scene.off_the_edges(self.scene.surface(&ray, &candidate), &candidate);
            if ray.direction.dot(hit.ng) < 0.0 {
                return (count, false);
            }
            let around = Vec3::from_array(random.direction().map(|x| x as f32));
            let direction = (around * 0.999 - hit.ng).normalize();
            ray = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
        }
        (limit, true)
    }

    /// A vertex, the middle of an edge, or any point of an edge, in `f64`.
    fn target(&self, random: &mut Random) -> DVec3 {
        let mesh = self.mesh.mesh();
        let corners = mesh.corners((random.bits() % mesh.face_count() as u64) as u32).map(|p| p.as_dvec3());
        let first = random.bits() as usize % 3;
        let (a, b) = (corners[first], corners[(first + 1) % 3]);
        let p = match random.bits() % 4 {
            0 => a,
            1 => 0.5 * (a + b),
            _ => a.lerp(b, random.between(0.0, 1.0)),
        };
        self.transform.map_or(p, |t| t.point(p))
    }

    fn aimed(&self, origin: Vec3, random: &mut Random) -> Ray {
        Ray::new(origin, (self.target(random) - origin.as_dvec3()).normalize().as_vec3())
    }

    /// A ray from the inside.
    pub(crate) fn ray_from_inside(&self, random: &mut Random) -> Ray {
        let jitter = Vec3::from_array(random.direction().map(|x| x as f32)) * (0.01 * self.size);
        self.aimed(self.inside + jitter * random.uniform_f32(), random)
    }

    /// A ray from well outside.
    pub(crate) fn ray_from_outside(&self, random: &mut Random) -> Ray {
        let bounds = self.scene.bounds();
        let around = Vec3::from_array(random.direction().map(|x| x as f32));
        self.aimed(bounds.center() + around * (3.0 * bounds.radius()), random)
    }

    /// How often the ray crosses the mesh.
    pub(crate) fn crossings(&self, ray: &Ray) -> usize {
        let mut count = 0;
        self.scene.crossings(ray, 1, &mut |_| count += 1);
        count
    }

    /// Whether a ray from inside gets out without a crossing, by any of the three queries.
    pub(crate) fn leaks_from_inside(&self, ray: &Ray) -> bool {
        self.scene.closest(ray, 1).is_none()
            || !self.scene.occluded(ray, 1)
            || self.crossings(ray).is_multiple_of(2)
    }

    /// Follows a chain of refractions and reflections from outside, at an index of 1.5, with up to `limit` rays;
    /// returns the rays traced, and whether each crossing fits the side that the path was on.
    #[allow(
        dead_code,
        reason = "the example's alone: where light ends up is a matter of medium sets, not of meshes"
    )]
    pub(crate) fn follow(&self, random: &mut Random, limit: usize) -> (usize, bool) {
        let mut ray = self.ray_from_outside(random);
        let mut is_inside = false;
        for count in 1..=limit {
            let Some(candidate) = self.scene.closest(&ray, 1) else { return (count, !is_inside) };
            let hit = self.scene.surface(&ray, &candidate);
            if (ray.direction.dot(hit.ng) > 0.0) != is_inside {
                return (count, false);
            }
            let (direction, crosses) = bend(ray.direction, hit.ng, random.uniform_f32() < 0.1);
            is_inside ^= crosses;
            ray = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
        }
        (limit, true)
    }
}

/// The refracted direction, or the reflected one where it is asked for or light is reflected totally; and whether it
/// crosses the surface.
fn bend(direction: Vec3, ng: Vec3, reflects: bool) -> (Vec3, bool) {
    let (n, eta) = if direction.dot(ng) < 0.0 { (ng, 1.5) } else { (-ng, 1.0 / 1.5) };
    let cos_i = -direction.dot(n);
    let cos_t2 = 1.0 - (1.0 - cos_i * cos_i) / (eta * eta);
    if reflects || cos_t2 <= 0.0 {
        return ((direction + 2.0 * cos_i * n).normalize(), false);
    }
    ((direction / eta + (cos_i / eta - cos_t2.sqrt()) * n).normalize(), true)
}
