//! Times traversal against obvhs's own compressed 8-wide tree, on the same triangles and the same rays.
//!
//! `cargo bench -p hyaline-geometry --bench traversal` first prints a table of millions of rays a second on one thread,
//! and the ratios, measured in turns so that a busy machine slows all alike; then criterion's own times. After `--`, a
//! number sets how many triangles there are (default 1,000,000), and `--table` ends it after the table. Scenes: a rippled
//! torus knot, a rippled sphere and 108 hollow balls, each in a closed room. Rays: from a camera, after two diffuse
//! bounces, along chains of refraction and reflection at an index of 1.5, and towards a light.

mod rays;

use criterion::Criterion;
use hyaline_geometry::bvh::{MeshBvh, SimdLevel};
use hyaline_geometry::mesh::{Mesh, MeshData, generate};
use hyaline_geometry::{Aggregate, Item, ItemGeometry};
use hyaline_math::{Ray, Vec3};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::RayHit;
use obvhs::{BvhBuildParams, triangle::Triangle};
use rays::Rays;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Repetitions, of which the fastest counts.
const ROUNDS: usize = 5;

fn main() {
    let triangle_count = std::env::args().find_map(|arg| arg.parse().ok()).unwrap_or(1_000_000);
    let scenes = [
        ("knot", generate::torus_knot(Vec3::ZERO, 0.9, triangle_count, 0.2)),
        ("sphere", generate::displaced_sphere(Vec3::ZERO, 0.8, triangle_count, 0.1)),
        ("shells", generate::hollow_balls(Vec3::ZERO, 1.8, 108, triangle_count)),
    ];
    let is_table = std::env::args().any(|arg| arg == "--table");
    let mut criterion = Criterion::default().without_plots().sample_size(10);
    let is_filter = |arg: &String| !arg.starts_with('-') && arg.parse::<usize>().is_err();
    if let Some(filter) = std::env::args().skip(1).find(is_filter) {
        criterion = criterion.with_filter(filter);
    }
    for (name, object) in scenes {
        let rivals = Rivals::build(name, object);
        let rays = Rays::trace(&rivals.ours);
        for (kind, rays) in rays.kinds() {
            rivals.compare(kind, rays);
        }
        if !is_table {
            rivals.time(name, &rays, &mut criterion);
        }
    }
}

/// Both trees.
struct Rivals {
    ours: Aggregate,
    theirs: CwBvh,
    /// In the order of their tree.
    triangles: Vec<Triangle>,
}

impl Rivals {
    fn build(name: &str, mut object: MeshData) -> Self {
        add_room(&mut object);
        let mesh = Mesh::new(object).expect("generated meshes are valid");
        let unordered = obvhs_triangles(&mesh);
        let (bvh, build_time) = timed(|| MeshBvh::new(mesh));
        let size = bvh.tree_size();
        let geometry = ItemGeometry::Mesh { mesh: Arc::new(bvh), transform: None };
        let ours = Aggregate::build(vec![Item { geometry, mask: 0xff }]);
        let (theirs, their_time) = timed(|| {
            build_cwbvh_from_tris(&unordered, BvhBuildParams::slow_build(), &mut Duration::default())
        });
        println!(
            "{name}: {} triangles, built in {build_time:.2} s ({} MiB); obvhs slow preset {their_time:.2} s",
            unordered.len(),
            size >> 20
        );
        let triangles = theirs.primitive_indices.iter().map(|&i| unordered[i as usize]).collect();
        Self { ours, theirs, triangles }
    }

    /// Prints how many rays of a kind are traced a second.
    fn compare(&self, kind: &str, rays: &[Ray]) {
        let is_shadow = kind == "shadow";
        let levels = SimdLevel::ALL.into_iter().filter(|level| level.is_supported());
        let scenes: Vec<Aggregate> = levels.map(|level| self.ours.clone().with_simd_level(level)).collect();
        let differing = rays.iter().filter(|ray| self.differs(ray, is_shadow)).count();
        assert!(differing * 10_000 <= rays.len(), "{differing} of {} {kind} rays end elsewhere", rays.len());
        // One round of each in turn, so that a busy machine slows all alike.
        let (mut theirs, mut ours) = (0.0_f64, vec![0.0_f64; scenes.len()]);
        for _ in 0..ROUNDS {
            theirs = theirs.max(rate(rays, |ray| self.their_hit(ray, is_shadow)));
            for (scene, best) in scenes.iter().zip(&mut ours) {
                *best = best.max(rate(rays, |ray| our_hit(scene, ray, is_shadow)));
            }
        }
        print!("  {kind:9} obvhs {theirs:5.2}");
        for (scene, ours) in scenes.iter().zip(ours) {
            print!("   {:?} {ours:5.2} ({:.2}x)", scene.simd_level(), ours / theirs);
        }
        println!("   Mray/s");
    }

    /// Criterion's times of all rays of each kind.
    fn time(&self, name: &str, rays: &Rays, criterion: &mut Criterion) {
        let mut group = criterion.benchmark_group(name);
        for (kind, rays) in rays.kinds() {
            let is_shadow = kind == "shadow";
            group.throughput(criterion::Throughput::Elements(rays.len() as u64));
            group.bench_function(format!("hyaline/{kind}"), |b| {
                b.iter(|| rays.iter().filter(|ray| our_hit(&self.ours, ray, is_shadow)).count());
            });
            group.bench_function(format!("obvhs/{kind}"), |b| {
                b.iter(|| rays.iter().filter(|ray| self.their_hit(ray, is_shadow)).count());
            });
        }
        group.finish();
    }

    fn their_hit(&self, ray: &Ray, is_shadow: bool) -> bool {
        let ray = obvhs_ray(ray);
        if is_shadow {
            !self.theirs.ray_traverse_miss(ray, |ray, id| self.triangles[id].intersect(ray))
        } else {
            self.theirs.ray_traverse(ray, &mut RayHit::none(), |ray, id| self.triangles[id].intersect(ray))
        }
    }

    /// Whether the two trees disagree on a ray: on whether anything is hit, or on the distance of the nearest hit. The
    /// rival has no rule for rays along edges and loses a few, so the two are not quite alike.
    fn differs(&self, ray: &Ray, is_shadow: bool) -> bool {
        if is_shadow {
            return self.their_hit(ray, true) != our_hit(&self.ours, ray, true);
        }
        let ours = self.ours.closest(ray, 0xff).map_or(f32::INFINITY, |hit| hit.t);
        let mut hit = RayHit::none();
        self.theirs.ray_traverse(obvhs_ray(ray), &mut hit, |ray, id| self.triangles[id].intersect(ray));
        ours != hit.t && (ours - hit.t).abs() > 1e-4 * (1.0 + ours)
    }
}

fn our_hit(scene: &Aggregate, ray: &Ray, is_shadow: bool) -> bool {
    if is_shadow { scene.occluded(ray, 0xff) } else { scene.closest(ray, 0xff).is_some() }
}

fn obvhs_ray(ray: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.to_vec3a(), ray.direction.to_vec3a(), ray.t_min, ray.t_max)
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

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

/// Millions of rays a second.
fn rate(rays: &[Ray], mut trace: impl FnMut(&Ray) -> bool) -> f64 {
    let (hits, time) = timed(|| rays.iter().filter(|ray| trace(ray)).count());
    black_box(hits);
    rays.len() as f64 / time * 1e-6
}
