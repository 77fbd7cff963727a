use super::node::{Block, Child, MAX_DEPTH, Node};
use super::ray::{BoxRay, FilterRay, SlabRay};
use super::simd::Stack;
use super::*;
use crate::mesh::triangle::LocalRay;
use crate::mesh::{Mesh, generate};
use hyaline_math::float::f64::powf;
use hyaline_math::{Bounds, Ray, Vec3};
use hyaline_testkit::Random;
use std::ops::ControlFlow;

fn vector(random: &mut Random, size: f64) -> Vec3 {
    Vec3::from_array(random.direction().map(|x| (x * size) as f32))
}

/// A direction, of which components are sometimes zero or tiny.
fn awkward_direction(random: &mut Random) -> Vec3 {
    let mut direction = vector(random, 1.0);
    for axis in 0..3 {
        match random.bits() % 8 {
            0 => direction[axis] = 0.0,
            1 => direction[axis] *= 1e-20,
            2 => direction[axis] *= 1e-7,
            _ => {}
        }
    }
    direction.normalize_or(Vec3::NEG_Y)
}

fn levels() -> impl Iterator<Item = SimdLevel> {
    SimdLevel::ALL.into_iter().filter(|level| level.is_supported())
}

/// The boxes of a node that a ray meets, and where they begin.
struct Boxes<'a>(&'a Node, &'a BoxRay, f32);

impl Query for Boxes<'_> {
    type Output = (u32, [f32; 8]);

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Output {
        let (nears, hits) = lanes.hit_boxes(&lanes.prepare_boxes(self.1), self.0, self.2);
        (hits, nears.0)
    }
}

/// The triangles of a block that pass the filter.
struct Filter<'a>(&'a Block, &'a FilterRay, f32);

impl Query for Filter<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u32 {
        lanes.filter(&lanes.prepare_triangles(self.1), self.0, self.2)
    }
}

/// Where a ray is inside a box, in `f64`.
fn slab(ray: &Ray, bounds: &Bounds) -> Option<(f64, f64)> {
    let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let (low, high) = (f64::from(bounds.min[axis]), f64::from(bounds.max[axis]));
        if d[axis] == 0.0 {
            if o[axis] < low || o[axis] > high {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - o[axis]) / d[axis], (high - o[axis]) / d[axis]);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    (near <= far).then_some((near, far))
}

#[test]
fn no_box_that_the_ray_meets_is_missed() {
    let mut random = Random::from_seed(1);
    let mut met = 0;
    for _ in 0..200_000 {
        let scale = powf(10.0, random.between(-4.0, 5.0));
        let offset = if random.bits() & 1 == 0 { Vec3::ZERO } else { vector(&mut random, 10.0 * scale) };
        let mut node = Node::empty();
        let mut all = Bounds::EMPTY;
        let boxes: Vec<Bounds> = (0..5)
            .map(|slot| {
                // Every other box is flat along some axis.
                let mut size = vector(&mut random, scale).abs();
                size[random.bits() as usize % 3] *= (random.bits() & 1) as f32;
                let corner = offset + vector(&mut random, scale);
                let bounds = Bounds { min: corner, max: corner + size };
                node.set(slot, &bounds, Child::leaf(slot));
                all = all.union(bounds);
                bounds
            })
            .collect();
        let tree = Tree { nodes: Vec::new(), root: None, bounds: all };
        let target = boxes[0].min.lerp(boxes[0].max, (random.bits() % 3) as f32 * 0.5);
        let direction = awkward_direction(&mut random);
        let ray = Ray::new(target - direction * (scale * random.between(0.0, 5.0)) as f32, direction);
        let box_ray = BoxRay::new(&SlabRay::new(&LocalRay::from_world(&ray)), &tree);
        for level in levels() {
            let (hits, nears) = VerifiedLevel::new(level).run(Boxes(&node, &box_ray, f32::INFINITY));
            assert_eq!(hits >> 5, 0, "absent boxes are never met");
            for (slot, bounds) in boxes.iter().enumerate() {
                if let Some((near, _)) = slab(&ray, bounds) {
                    met += 1;
                    assert!(hits >> slot & 1 == 1, "{level:?} {ray:?} {bounds:?}");
                    assert!(f64::from(nears[slot]) <= near.next_up(), "{level:?} {} {near}", nears[slot]);
                }
            }
        }
    }
    assert!(met > 300_000);
}

#[test]
fn no_triangle_that_is_hit_is_filtered_out() {
    let mut random = Random::from_seed(2);
    let mut hits = 0;
    for _ in 0..200_000 {
        let scale = powf(10.0, random.between(-4.0, 5.0));
        let center = vector(&mut random, scale);
        let size = scale * powf(10.0, random.between(-6.0, 0.5));
        let corners = [0; 3].map(|_| center + vector(&mut random, size));
        // At the inside, an edge or a vertex.
        let weights = [random.uniform_f32(), random.uniform_f32() * (random.bits() & 1) as f32, 1.0];
        let target =
            (corners[0] * weights[0] + corners[1] * weights[1]) / (weights[0] + weights[1]).max(1e-9);
        let origin = vector(&mut random, scale * 3.0);
        let ray = LocalRay::from_world(&Ray::new(origin, (target - origin).normalize_or(Vec3::X)));
        let mut block = Block::empty();
        block.set(2, 7, corners);
        let tree = Tree { nodes: Vec::new(), root: None, bounds: Bounds::from_points(corners) };
        let Some(hit) = ray.triangle(corners) else { continue };
        hits += 1;
        let filter_ray = FilterRay::new(&ray, &SlabRay::new(&ray), &tree);
        for level in levels() {
            let passed = VerifiedLevel::new(level).run(Filter(&block, &filter_ray, hit.t));
            assert_eq!(passed, 0b100, "{level:?} {corners:?} {ray:?}");
        }
    }
    assert!(hits > 40_000, "{hits}");
}

#[test]
fn the_tree_is_the_same_for_any_number_of_threads() {
    // So many triangles that every parallel part of the builder runs, and symmetric, so that many boxes tie.
    let mesh = Mesh::new(generate::uv_sphere(Vec3::ZERO, 1.0, 520_000)).unwrap();
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| MeshBvh::new(mesh.clone()))
    };
    let one = build(1);
    assert!(one == build(2));
    assert!(one == build(7));
}

/// Counts the leaves it is shown, and checks the order of the near ones.
struct Count {
    leaves: Vec<usize>,
}

impl Visitor for Count {
    const IS_ORDERED: bool = true;

    fn limit(&self) -> f32 {
        f32::INFINITY
    }

    fn prefetch(&self, _: usize) {}

    fn leaf(&mut self, index: usize) -> ControlFlow<()> {
        self.leaves.push(index);
        ControlFlow::Continue(())
    }
}

struct Descend<'a>(&'a Tree, &'a SlabRay, &'a mut Count);

impl Query for Descend<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let _ = traverse(lanes, self.0, self.1, self.2);
    }
}

fn depth(tree: &Tree, child: Child) -> usize {
    if child.is_leaf() {
        return 0;
    }
    let node = &tree.nodes[child.index()];
    let slots = (0..8).filter(|&slot| node.planes[0][slot] <= node.planes[1][slot]);
    1 + slots.map(|slot| depth(tree, node.children[slot])).max().unwrap_or(0)
}

#[test]
fn boxes_that_shrink_geometrically_do_not_overflow_the_stack() {
    // Each box a fraction of the last, the most lopsided tree there is.
    for ratio in [0.99_f32, 0.9, 0.7, 0.5, 0.1] {
        let count =
            2000.min((-80.0 / f64::from(hyaline_math::float::ln(ratio)) / std::f64::consts::LN_2) as usize);
        let boxes: Vec<Bounds> = (0..count)
            .map(|i| Bounds { min: Vec3::ZERO, max: Vec3::splat(1e10 * ratio.powi(i as i32)) })
            .collect();
        let (tree, leaves) = build(&boxes, 1);
        assert_eq!(leaves.len(), count);
        assert!(depth(&tree, tree.root.unwrap()) <= MAX_DEPTH);
        let ray = LocalRay::from_world(&Ray::new(Vec3::splat(-1.0), Vec3::ONE.normalize()));
        for level in levels() {
            let mut visitor = Count { leaves: Vec::new() };
            VerifiedLevel::new(level).run(Descend(&tree, &SlabRay::new(&ray), &mut visitor));
            visitor.leaves.sort_unstable();
            assert!(visitor.leaves.iter().copied().eq(0..count), "{level:?}");
        }
    }
}

#[test]
fn a_tree_of_parts_has_each_box_once_where_a_ray_finds_it() {
    let mut random = Random::from_seed(5);
    let boxes: Vec<Bounds> = (0..5000)
        .map(|_| {
            let corner = vector(&mut random, 10.0);
            Bounds { min: corner, max: corner + vector(&mut random, 1.0).abs() }
        })
        .collect();
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| collapse::build_in_parts(&boxes, 4, 300))
    };
    let (tree, leaves) = build(1);
    assert!(tree == build(7).0);
    let mut all: Vec<u32> = (0..leaves.len()).flat_map(|leaf| leaves.get(leaf)).copied().collect();
    all.sort_unstable();
    assert!(all.into_iter().eq(0..5000));
    assert!((0..leaves.len()).all(|leaf| leaves.get(leaf).is_sorted() && leaves.get(leaf).len() <= 4));
    let mut met = 0;
    for _ in 0..200 {
        let origin = vector(&mut random, 20.0);
        let target = boxes[random.bits() as usize % boxes.len()].center();
        let ray = Ray::new(origin, (target - origin).normalize());
        let local = LocalRay::from_world(&ray);
        for level in levels() {
            let mut visitor = Count { leaves: Vec::new() };
            VerifiedLevel::new(level).run(Descend(&tree, &SlabRay::new(&local), &mut visitor));
            let shown: Vec<u32> = visitor.leaves.iter().flat_map(|&leaf| leaves.get(leaf)).copied().collect();
            for (i, bounds) in boxes.iter().enumerate() {
                if slab(&ray, bounds).is_some() {
                    met += 1;
                    assert_eq!(shown.iter().filter(|&&shown| shown == i as u32).count(), 1, "{level:?}");
                }
            }
        }
    }
    assert!(met >= 600, "{met}");
}

#[test]
fn boxes_of_any_size_can_be_built() {
    for size in [0.0, 1e-38, 1e-20, 1e15] {
        for count in [1, 2, 9, 100] {
            let boxes = vec![Bounds { min: Vec3::splat(-size), max: Vec3::splat(size) }; count];
            let (tree, leaves) = build(&boxes, 4);
            assert_eq!((0..leaves.len()).map(|leaf| leaves.get(leaf).len()).sum::<usize>(), count);
            assert!((0..leaves.len()).all(|leaf| leaves.get(leaf).len() <= 4));
            assert_eq!(tree.bounds, boxes[0]);
        }
    }
    let not_numbers = vec![Bounds { min: Vec3::NAN, max: Vec3::NAN }; 20];
    assert_eq!(build(&not_numbers, 1).1.len(), 20);
    assert_eq!(build(&[], 4).0.root, None);
}

#[test]
fn the_stack_gives_back_the_smallest_of_each_group_first() {
    let mut stack = Stack::new();
    for group in [[5, 3, 9], [2, 8, 1]] {
        let start = stack.len();
        for entry in group {
            stack.push(entry);
            stack.sink_last(start);
        }
    }
    let order: Vec<u64> = std::iter::from_fn(|| stack.pop()).collect();
    assert_eq!(order, [1, 2, 8, 3, 5, 9]);
}

#[test]
fn a_level_that_the_processor_lacks_is_replaced() {
    for level in SimdLevel::ALL {
        let verified = VerifiedLevel::new(level).level();
        assert!(verified.is_supported());
        assert!(verified == level || !level.is_supported());
    }
}
