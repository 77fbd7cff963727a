//! Queries against brute force, on every kind of set and with every kind of instruction.

use super::*;
use hyaline_math::float;
use hyaline_testkit::Random;
use rayon::ThreadPoolBuilder;

fn unit_point(random: &mut Random) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| random.uniform_f32()))
}

/// Sets that are hard in different ways, by name.
fn sets(count: usize, random: &mut Random) -> Vec<(&'static str, Vec<Vec3>)> {
    let mut set = |place: &dyn Fn(Vec3) -> Vec3| -> Vec<Vec3> {
        (0..count).map(|_| place(unit_point(random))).collect()
    };
    vec![
        ("random", set(&|u| u)),
        ("clustered", set(&|u| Vec3::new((4.0 * u.x).floor() / 4.0, 0.5, 0.5) + 0.01 * u * u.z * u.z)),
        ("coplanar", set(&|u| Vec3::new(u.x, 0.25, u.z))),
        ("collinear", set(&|u| Vec3::splat(u.x))),
        ("duplicated", set(&|u| (5.0 * u).floor() / 5.0)),
        ("all the same", set(&|_| Vec3::splat(0.5))),
        ("of all sizes", set(&|u| Vec3::new(0.5, 0.5, float::powf(2.0, -80.0 * u.x)))),
        ("far away", set(&|u| 0.01 * u + Vec3::new(-4000.0, 0.5, 10.0))),
    ]
}

/// Squared distance of a point, infinite outside of the region.
fn distance_in(region: &Region, p: Vec3) -> f32 {
    let offset = p - region.center;
    let height = region.disc.map_or(0.0, |disc| offset.dot(disc.normal / disc.thickness.clamp(0.001, 1.0)));
    let distance2 = offset.length_squared().max(height * height);
    if distance2 <= region.radius * region.radius { distance2 } else { f32::INFINITY }
}

/// Regions of all kinds about a place.
fn regions(center: Vec3, random: &mut Random) -> Vec<Region> {
    let normal = Vec3::from_array(random.direction().map(|x| x as f32));
    let radii = [0.0, 1e-3, 0.05, 0.3, f32::INFINITY];
    let discs = [
        None,
        Some(Disc { normal, thickness: 0.3 }),
        Some(Disc { normal: Vec3::Y, thickness: 0.0 }),
        Some(Disc { normal, thickness: 1.0 }),
    ];
    radii.iter().flat_map(|&radius| discs.map(|disc| Region { center, radius, disc })).collect()
}

/// Calls `check` with every set, a tree of it for every level, and regions about points of it and beside it.
fn for_all(check: impl Fn(&str, &[Vec3], &PointTree<u32>, &Region)) {
    let mut random = Random::from_seed(1);
    for (round, count) in [0, 1, 2, 15, 16, 17, 33, 100, 700, 3000].into_iter().enumerate() {
        for (name, points) in sets(count, &mut random) {
            let level = SimdLevel::ALL[round % SimdLevel::ALL.len()];
            let leaf_size = [1, 32, 100][round % 3];
            let tree = PointTree::build(points.iter().copied().zip(0..).collect(), leaf_size);
            let tree = tree.with_simd_level(level);
            let beside = unit_point(&mut random);
            let at = points.first().copied().unwrap_or(beside);
            for center in [beside, at, at + 0.01 * beside] {
                for region in regions(center, &mut random) {
                    check(name, &points, &tree, &region);
                }
            }
        }
    }
}

/// The answer's squared distances, sorted, after checking that each point is there once and as far as is said.
fn checked(points: &[Vec3], region: &Region, tree: &PointTree<u32>, found: &[(f32, u32)]) -> Vec<f32> {
    let mut items: Vec<u32> = found.iter().map(|&(_, i)| *tree.payload(i)).collect();
    for (&(distance2, i), &item) in found.iter().zip(&items) {
        assert_eq!(tree.position(i), points[item as usize]);
        assert_eq!(distance2, distance_in(region, points[item as usize]));
    }
    items.sort_unstable();
    items.dedup();
    assert_eq!(items.len(), found.len(), "a point was found twice");
    sorted(found.iter().map(|&(distance2, _)| distance2))
}

fn sorted(distances: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut list: Vec<f32> = distances.filter(|distance2| *distance2 < f32::INFINITY).collect();
    list.sort_by(f32::total_cmp);
    list
}

#[test]
fn points_within_a_region_are_those_of_brute_force() {
    for_all(|name, points, tree, region| {
        let mut found = Vec::new();
        tree.within(region, &mut |i, distance2| found.push((distance2, i)));
        let expected = sorted(points.iter().map(|&p| distance_in(region, p)));
        assert_eq!(checked(points, region, tree, &found), expected, "{name} {} {region:?}", points.len());
    });
}

#[test]
fn nearest_points_are_those_of_brute_force() {
    let found = std::cell::RefCell::new(Nearest::new());
    for_all(|name, points, tree, region| {
        for k in [0, 1, 5, 50, 200, 5000] {
            let mut found = found.borrow_mut();
            tree.nearest(region, k, All, &mut found);
            let mut expected = sorted(points.iter().map(|&p| distance_in(region, p)));
            expected.truncate(k);
            let list: Vec<_> = found.iter().collect();
            assert_eq!(
                checked(points, region, tree, &list),
                expected,
                "{k} of {name} {} {region:?}",
                points.len()
            );
        }
    });
}

#[test]
fn all_levels_find_the_same_points_in_the_same_order() {
    let mut random = Random::from_seed(6);
    let (_, points) = sets(5000, &mut random).swap_remove(1);
    let tree = PointTree::build(points.iter().copied().zip(0..).collect(), 32);
    for center in points.iter().step_by(50) {
        for region in regions(*center, &mut random) {
            let ask = |level| {
                let (tree, mut found) = (tree.clone().with_simd_level(level), Nearest::new());
                tree.nearest(&region, 40, All, &mut found);
                let push = |mut list: Vec<(f32, u32)>, i, distance2| {
                    list.push((distance2, i));
                    list
                };
                (found.iter().collect::<Vec<_>>(), tree.fold_within(&region, Vec::new(), push))
            };
            let expected = ask(SimdLevel::Scalar);
            assert!(SimdLevel::ALL.into_iter().all(|level| ask(level) == expected));
        }
    }
}

#[test]
fn points_that_do_not_count_make_room_for_others() {
    let found = std::cell::RefCell::new(Nearest::new());
    for_all(|name, points, tree, region| {
        let mut found = found.borrow_mut();
        tree.nearest(region, 20, |i: u32| tree.payload(i) % 3 == 1, &mut found);
        let mut expected = sorted(points.iter().skip(1).step_by(3).map(|&p| distance_in(region, p)));
        expected.truncate(20);
        let list: Vec<_> = found.iter().collect();
        assert!(list.iter().all(|&(_, i)| tree.payload(i) % 3 == 1));
        assert_eq!(checked(points, region, tree, &list), expected, "{name} {} {region:?}", points.len());
    });
}

#[test]
fn the_farthest_is_taken_only_where_all_were_found() {
    let points = (0..40).map(|i| (Vec3::splat(i as f32), i)).collect();
    let tree = PointTree::build(points, 16);
    let mut found = Nearest::new();
    let region = Region { center: Vec3::ZERO, radius: 10.0, disc: None };
    tree.nearest(&region, 4, All, &mut found);
    assert_eq!(found.take_farthest(4), Some(27.0));
    assert_eq!(sorted(found.iter().map(|(distance2, _)| distance2)), [0.0, 3.0, 12.0]);
    // Six points lie within 10.
    tree.nearest(&region, 7, All, &mut found);
    assert_eq!((found.take_farthest(7), found.len()), (None, 6));
}

#[test]
fn the_tree_is_the_same_for_any_number_of_threads() {
    let mut random = Random::from_seed(3);
    let (_, points) = sets(60_000, &mut random).swap_remove(1);
    let build = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
        let points: Vec<(Vec3, u32)> = points.iter().copied().zip(0..).collect();
        pool.install(|| PointTree::build(points, 32))
    };
    let (one, two) = (build(1), build(2));
    assert_eq!(one.payloads, two.payloads);
    let bits = |tree: &PointTree<u32>| -> Vec<u32> {
        let boxes = tree.nodes.iter().flat_map(|node| node.min.into_iter().chain(node.max)).flatten();
        boxes.chain(tree.packets.iter().flat_map(|packet| packet.0).flatten()).map(f32::to_bits).collect()
    };
    assert_eq!(bits(&one), bits(&two));
}

#[test]
fn points_that_are_nowhere_are_left_out() {
    let nowhere = [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NEG_INFINITY, 0.0)];
    let points = nowhere.into_iter().chain([Vec3::ONE]).zip(0..).collect();
    let tree = PointTree::build(points, 32);
    assert_eq!((tree.len(), tree.position(0), *tree.payload(0)), (1, Vec3::ONE, 3));
    assert_eq!(tree.bounds(), Bounds::from_points([Vec3::ONE]));
}

#[test]
fn a_region_that_is_nowhere_holds_nothing() {
    let tree = PointTree::build(vec![(Vec3::ONE, ())], 32);
    let mut found = Nearest::new();
    for (center, radius) in [(Vec3::NAN, 1.0), (Vec3::ONE, -1.0), (Vec3::ONE, f32::NAN)] {
        let region = Region { center, radius, disc: None };
        tree.nearest(&region, 1, All, &mut found);
        assert!(found.is_empty());
        tree.within(&region, &mut |_, _| panic!("nothing is there"));
    }
}

#[test]
fn photons_take_at_most_32_bytes_each() {
    let mut random = Random::from_seed(4);
    let points = (0..100_000).map(|_| (unit_point(&mut random), [0_u32; 2])).collect();
    let tree = PointTree::build(points, 32);
    assert!(tree.bytes() < 22 * tree.len(), "{} bytes", tree.bytes());
}
