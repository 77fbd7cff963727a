//! Groups of neighbors: things are halved by their centers along the widest axis, again and again.
//!
//! Of each half it only counts what is in it, so halves are selected; the groups alone are sorted. The order is total, so
//! groups are the same on every machine and for any number of threads.

use hyaline_math::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;

/// Things that one task looks at.
const TASK: usize = 1 << 14;

/// A thing by its number, with its center.
#[derive(Clone, Copy, Debug)]
struct Place {
    center: DVec3,
    index: u32,
}

/// Splits things into at most `most` groups of neighbors; returns their numbers.
///
/// In a group things come in the order of their centers along the axis that was halved last, then along those before, then
/// of their numbers.
pub(super) fn groups(centers: impl IndexedParallelIterator<Item = DVec3>, most: usize) -> Vec<Vec<u32>> {
    let place = |(index, center): (usize, DVec3)| Place { center, index: index as u32 };
    let mut places: Vec<Place> = centers.enumerate().map(place).collect();
    if places.is_empty() { Vec::new() } else { halve(&mut places, most, &Order::default()) }
}

fn halve(places: &mut [Place], most: usize, order: &Order) -> Vec<Vec<u32>> {
    if most <= 1 || places.len() <= 1 {
        places.sort_unstable_by(|a, b| order.compare(a, b));
        return vec![places.iter().map(|place| place.index).collect()];
    }
    let order = order.by(widest_axis(places));
    let middle = places.len() / 2;
    places.select_nth_unstable_by(middle, |a, b| order.compare(a, b));
    let (lower, upper) = places.split_at_mut(middle);
    let (mut groups, rest) =
        rayon::join(|| halve(lower, most / 2, &order), || halve(upper, most - most / 2, &order));
    groups.extend(rest);
    groups
}

/// The axis along which the centers lie farthest apart, the first of several.
fn widest_axis(places: &[Place]) -> usize {
    let none = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = places
        .par_chunks(TASK)
        .map(|chunk| chunk.iter().fold(none(), |(low, high), p| (low.min(p.center), high.max(p.center))))
        .reduce(none, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let size = high - low;
    (0..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest })
}

/// By some axes, the first of them first, then by number.
#[derive(Clone, Debug, Default)]
struct Order {
    axes: Vec<usize>,
}

impl Order {
    /// By `axis` before the others.
    fn by(&self, axis: usize) -> Self {
        let others = self.axes.iter().copied().filter(|&other| other != axis);
        Self { axes: std::iter::once(axis).chain(others).collect() }
    }

    fn compare(&self, a: &Place, b: &Place) -> Ordering {
        let by_axis = |&axis: &usize| a.center[axis].total_cmp(&b.center[axis]);
        let unequal = self.axes.iter().map(by_axis).find(|ordering| ordering.is_ne());
        unequal.unwrap_or_else(|| a.index.cmp(&b.index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;

    /// The same by sorting everything at every step; the sort is stable.
    fn sorted(places: &mut [Place], most: usize) -> Vec<Vec<u32>> {
        if most <= 1 || places.len() <= 1 {
            return vec![places.iter().map(|place| place.index).collect()];
        }
        let axis = widest_axis(places);
        places.sort_by(|a, b| a.center[axis].total_cmp(&b.center[axis]));
        let (lower, upper) = places.split_at_mut(places.len() / 2);
        [sorted(lower, most / 2), sorted(upper, most - most / 2)].concat()
    }

    #[test]
    fn groups_are_those_of_sorting_ties_included_for_any_number_of_threads() {
        let mut random = Random::from_seed(1);
        for (count, most) in [(1, 4), (5, 8), (300, 7), (20_000, 64)] {
            // A few values for each coordinate, so that most of them tie.
            let centers: Vec<DVec3> = (0..count)
                .map(|_| DVec3::from([0; 3].map(|_| f64::from(random.bits() as u32 % 9))))
                .collect();
            let place = |(index, &center)| Place { center, index: index as u32 };
            let mut places: Vec<Place> = (0..).zip(&centers).map(place).collect();
            let expected = sorted(&mut places, most);
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let found = pool.install(|| groups(centers.par_iter().copied(), most));
                assert_eq!(found, expected, "{count} things, {most} groups");
            }
        }
        assert!(groups(Vec::new().into_par_iter(), 3).is_empty());
    }
}
