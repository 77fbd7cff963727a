//! Queries against brute force.

use super::*;
use hyaline_testkit::Random;

fn points(count: usize, random: &mut Random) -> Vec<(Vec3, u32)> {
    (0..count).map(|i| (Vec3::from_array([(); 3].map(|()| random.uniform_f32())), i as u32)).collect()
}

#[test]
fn nearest_points_are_those_of_brute_force() {
    let mut random = Random::from_seed(1);
    let mut found = Nearest::new();
    for count in [0, 1, 15, 16, 17, 100, 1000, 5000] {
        let list = points(count, &mut random);
        let tree = PointTree::build(list.clone(), 32);
        assert_eq!(tree.len(), count);
        for k in [1, 10, 50] {
            let center = Vec3::from_array([(); 3].map(|()| random.uniform_f32()));
            let region = Region { center, radius: 0.5, disc: None };
            tree.nearest(&region, k, All, &mut found);
            let mut expected: Vec<f32> =
                list.iter().map(|(p, _)| p.distance_squared(center)).filter(|d| *d <= 0.25).collect();
            expected.sort_by(f32::total_cmp);
            expected.truncate(k);
            let mut distances: Vec<f32> = found.iter().map(|(d, _)| d).collect();
            distances.sort_by(f32::total_cmp);
            assert_eq!(distances, expected);
        }
    }
}
