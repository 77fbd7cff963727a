//! Times traversal against obvhs's own compressed 8-wide tree, on the same triangles and the same rays.
//!
//! `cargo bench -p hyaline-geometry` prints millions of rays a second on one thread, and the ratio. An argument sets
//! the number of triangles (default 1,000,000). Scenes: a rippled torus knot, a rippled sphere and 108 hollow balls,
//! each in a closed room. Rays: from a camera, after two diffuse bounces, along chains of refraction and reflection at
//! an index of 1.5, and towards a light.

use hyaline_geometry::bvh::{MeshBvh, SimdLevel};
use hyaline_geometry::mesh::{Mesh, MeshData, generate};
use hyaline_geometry::{Aggregate, Item, ItemGeometry, SurfaceHit};
use hyaline_math::{Frame, Ray, Vec3, offset_origin};
use hyaline_testkit::Random;
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::RayHit;
use obvhs::{BvhBuildParams, triangle::Triangle};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Rays of each kind.
const RAY_COUNT: usize = 200_000;

/// Repetitions, of which the fastest counts.
const ROUNDS: usize = 5;

fn main() {
    let triangle_count = std::env::args().find_map(|arg| arg.parse().ok()).unwrap_or(1_000_000);
    let scenes = [
        ("knot", generate::torus_knot(Vec3::ZERO, 0.9, triangle_count, 0.2)),
        ("sphere", generate::displaced_sphere(Vec3::ZERO, 0.8, triangle_count, 0.1)),
        ("shells", generate::hollow_balls(Vec3::ZERO, 1.8, 108, triangle_count)),
    ];
    for (name, object) in scenes {
        compare(name, object);
    }
}

/// Builds both trees and times all kinds of rays.
fn compare(name: &str, mut object: MeshData) {
    add_room(&mut object);
    let mesh = Mesh::new(object).expect("generated meshes are valid");
    let triangles = obvhs_triangles(&mesh);
    let (bvh, build_time) = timed(|| MeshBvh::new(mesh));
    let size = bvh.tree_size();
    let scene = Aggregate::build(vec![Item {
        geometry: ItemGeometry::Mesh { mesh: Arc::new(bvh), transform: None },
        mask: 0xff,
    }]);
    let (rival, rival_time) =
        timed(|| build_cwbvh_from_tris(&triangles, BvhBuildParams::slow_build(), &mut Duration::default()));
    let ordered: Vec<Triangle> = rival.primitive_indices.iter().map(|&i| triangles[i as usize]).collect();
    println!(
        "{name}: {} triangles, built in {build_time:.2} s ({} MiB); obvhs slow preset {rival_time:.2} s",
        triangles.len(),
        size >> 20
    );
    for (kind, rays) in Rays::trace(&scene).kinds() {
        let is_shadow = kind == "shadow";
        let levels = SimdLevel::ALL.into_iter().filter(|level| level.is_supported());
        let scenes: Vec<Aggregate> = levels.map(|level| scene.clone().with_simd_level(level)).collect();
        let differing = rays.iter().filter(|ray| differs(&rival, &ordered, &scene, ray, is_shadow)).count();
        assert!(differing * 10_000 <= rays.len(), "{differing} of {} {kind} rays end elsewhere", rays.len());
        // One round of each in turn, so that a busy machine slows all alike.
        let (mut theirs, mut ours) = (0.0_f64, vec![0.0_f64; scenes.len()]);
        for _ in 0..ROUNDS {
            theirs = theirs.max(rate(rays, |ray| rival_hit(&rival, &ordered, ray, is_shadow)));
            for (scene, best) in scenes.iter().zip(&mut ours) {
                *best = best.max(rate(rays, |ray| {
                    if is_shadow { scene.occluded(ray, 0xff) } else { scene.closest(ray, 0xff).is_some() }
                }));
            }
        }
        print!("  {kind:9} obvhs {theirs:5.2}");
        for (scene, ours) in scenes.iter().zip(ours) {
            print!("   {:?} {ours:5.2} ({:.2}x)", scene.simd_level(), ours / theirs);
        }
        println!("   Mray/s");
    }
}

/// Twelve triangles about the object.
fn add_room(mesh: &mut MeshData) {
    let first = mesh.positions.len() as u32;
    for i in 0..8 {
        mesh.positions.push(Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 4.0 - 2.0);
    }
    let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    for [a, b, c, d] in quads {
        mesh.triangles.extend([[a, b, c], [a, c, d]].map(|face| face.map(|i: u32| first + i)));
    }
    mesh.normals = None;
}

fn obvhs_triangles(mesh: &Mesh) -> Vec<Triangle> {
    (0..mesh.face_count() as u32)
        .map(|face| {
            let [v0, v1, v2] = mesh.corners(face).map(|p| p.to_vec3a());
            Triangle { v0, v1, v2 }
        })
        .collect()
}

fn rival_hit(bvh: &CwBvh, triangles: &[Triangle], ray: &Ray, is_shadow: bool) -> bool {
    let ray = obvhs::ray::Ray::new(ray.origin.to_vec3a(), ray.direction.to_vec3a(), ray.t_min, ray.t_max);
    if is_shadow {
        !bvh.ray_traverse_miss(ray, |ray, id| triangles[id].intersect(ray))
    } else {
        bvh.ray_traverse(ray, &mut RayHit::none(), |ray, id| triangles[id].intersect(ray))
    }
}

/// Whether the two trees disagree on a ray: on whether anything is hit, or on the distance of the nearest hit. The
/// rival has no rule for rays along edges and loses a few, so the two are not quite alike.
fn differs(rival: &CwBvh, triangles: &[Triangle], scene: &Aggregate, ray: &Ray, is_shadow: bool) -> bool {
    if is_shadow {
        return rival_hit(rival, triangles, ray, true) != scene.occluded(ray, 0xff);
    }
    let ours = scene.closest(ray, 0xff).map_or(f32::INFINITY, |hit| hit.t);
    let rival_ray =
        obvhs::ray::Ray::new(ray.origin.to_vec3a(), ray.direction.to_vec3a(), ray.t_min, ray.t_max);
    let mut hit = RayHit::none();
    rival.ray_traverse(rival_ray, &mut hit, |ray, id| triangles[id].intersect(ray));
    ours != hit.t && (ours - hit.t).abs() > 1e-4 * (1.0 + ours)
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

/// Millions of rays a second.
fn rate(rays: &[Ray], mut trace: impl FnMut(&Ray) -> bool) -> f64 {
    let (hits, time) = timed(|| rays.iter().filter(|ray| trace(ray)).count());
    std::hint::black_box(hits);
    rays.len() as f64 / time * 1e-6
}

/// Rays of each kind.
#[derive(Default)]
struct Rays {
    primary: Vec<Ray>,
    diffuse: Vec<Ray>,
    refracted: Vec<Ray>,
    shadow: Vec<Ray>,
}

impl Rays {
    /// Follows paths from a camera in a corner of the room.
    fn trace(scene: &Aggregate) -> Self {
        let mut random = Random::from_seed(7);
        let mut rays = Self::default();
        let eye = Vec3::new(1.1, 0.9, 1.5);
        let frame = Frame::from_normal(-eye.normalize());
        let side = (RAY_COUNT as f64).sqrt() as usize;
        for pixel in 0..side * side {
            let x = (pixel % side) as f32 / side as f32 - 0.5;
            let y = (pixel / side) as f32 / side as f32 - 0.5;
            let ray = Ray::new(eye, frame.to_world(Vec3::new(x, y, 0.8)).normalize());
            rays.primary.push(ray);
            rays.scatter(scene, ray, &mut random);
            rays.refract(scene, ray, &mut random);
        }
        rays
    }

    fn kinds(&self) -> [(&'static str, &[Ray]); 4] {
        [
            ("primary", &self.primary),
            ("diffuse", &self.diffuse),
            ("refracted", &self.refracted),
            ("shadow", &self.shadow),
        ]
    }

    /// Two diffuse bounces; the last ray is kept, and a shadow ray from the first hit.
    fn scatter(&mut self, scene: &Aggregate, mut ray: Ray, random: &mut Random) {
        for bounce in 0..2 {
            let Some(hit) = surface(scene, &ray) else { return };
            let n = if hit.ng.dot(ray.direction) > 0.0 { -hit.ng } else { hit.ng };
            if bounce == 0 {
                let to_light = Vec3::new(-0.5, 1.9, 0.3) - hit.p;
                let direction = to_light.normalize();
                let origin = offset_origin(hit.p, hit.p_error, hit.ng, direction);
                self.shadow.push(Ray { t_max: 0.999 * to_light.length(), ..Ray::new(origin, direction) });
            }
            let lobe = Vec3::from_array(random.direction().map(|x| x as f32));
            let direction = (n + 0.999 * lobe).normalize();
            ray = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
        }
        self.diffuse.push(ray);
    }

    /// A chain of Fresnel choices through the object, until it meets the room.
    fn refract(&mut self, scene: &Aggregate, mut ray: Ray, random: &mut Random) {
        for _ in 0..24 {
            let Some(hit) = surface(scene, &ray) else { return };
            if hit.p.abs().max_element() > 1.99 || self.refracted.len() >= RAY_COUNT {
                return;
            }
            let direction = fresnel_choice(ray.direction, hit.ng, random.uniform_f32());
            ray = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
            self.refracted.push(ray);
        }
    }
}

fn surface(scene: &Aggregate, ray: &Ray) -> Option<SurfaceHit> {
    Some(scene.surface(ray, &scene.closest(ray, 0xff)?))
}

/// The reflected direction with the probability of Fresnel's equations, else the refracted one.
fn fresnel_choice(direction: Vec3, ng: Vec3, u: f32) -> Vec3 {
    let (n, eta) = if direction.dot(ng) < 0.0 { (ng, 1.5) } else { (-ng, 1.0 / 1.5) };
    let cos_i = -direction.dot(n);
    let cos_t2 = 1.0 - (1.0 - cos_i * cos_i) / (eta * eta);
    let reflected = direction + 2.0 * cos_i * n;
    if cos_t2 <= 0.0 {
        return reflected.normalize();
    }
    let cos_t = cos_t2.sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    if u < 0.5 * (parallel * parallel + perpendicular * perpendicular) {
        return reflected.normalize();
    }
    (direction / eta + (cos_i / eta - cos_t) * n).normalize()
}
