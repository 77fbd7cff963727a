//! Large sets of boxes in parts, each of which becomes a tree of its own.
//!
//! What building a tree needs beside the tree grows with the part, not with the mesh, and a part is worked on in the
//! caches of one core. The parts depend on the boxes alone, not on the number of threads.
//!
//! Source: Wald, On Fast Construction of SAH-Based Bounding Volume Hierarchies, RT 2007: bins of centers.

use hyaline_math::{Bounds, Vec3};
use rayon::prelude::*;

/// Bins along each axis.
const BINS: usize = 32;

/// Neither side of a cut gets less than this share, so that there are few parts, all of them large.
const LEAST_SHARE: f32 = 0.1;

/// Boxes that one task puts into bins.
const TASK: usize = 1 << 16;

/// Cuts the boxes into parts of at most `limit`: their indices, ascending in each part.
pub(super) fn parts(boxes: &[Bounds], limit: usize) -> Vec<Vec<u32>> {
    split(boxes, (0..boxes.len() as u32).collect(), limit)
}

fn split(boxes: &[Bounds], part: Vec<u32>, limit: usize) -> Vec<Vec<u32>> {
    if part.len() <= limit {
        return vec![part];
    }
    let (left, right) = match best_cut(boxes, &part) {
        Some(cut) => part.into_par_iter().partition(|&i| cut.is_left(&boxes[i as usize])),
        // Centers too close together to tell apart.
        None => {
            let (left, right) = part.split_at(part.len() / 2);
            (left.to_vec(), right.to_vec())
        }
    };
    let (mut parts, rest) = rayon::join(|| split(boxes, left, limit), || split(boxes, right, limit));
    parts.extend(rest);
    parts
}

/// Where a part is cut: beyond the first few bins along an axis.
struct Cut {
    grid: Grid,
    axis: usize,
    left_bins: usize,
}

impl Cut {
    fn is_left(&self, bounds: &Bounds) -> bool {
        self.grid.bins(bounds)[self.axis] < self.left_bins
    }
}

/// Bins over the box of all centers.
#[derive(Clone, Copy)]
struct Grid {
    low: Vec3,
    bins_per_unit: Vec3,
}

impl Grid {
    fn over(centers: Bounds) -> Self {
        let size = centers.size();
        let per_unit = |x: f32| if x > 0.0 { BINS as f32 / x } else { 0.0 };
        Self {
            low: centers.min,
            bins_per_unit: Vec3::new(per_unit(size.x), per_unit(size.y), per_unit(size.z)),
        }
    }

    fn bins(&self, bounds: &Bounds) -> [usize; 3] {
        let place = (bounds.center() - self.low) * self.bins_per_unit;
        // A place that is not a number becomes 0.
        place.to_array().map(|x| (x as usize).min(BINS - 1))
    }
}

/// Boxes of a bin: how many, and the box about them.
#[derive(Clone, Copy)]
struct Bin {
    count: usize,
    bounds: Bounds,
}

impl Bin {
    const EMPTY: Self = Self { count: 0, bounds: Bounds::EMPTY };

    fn join(self, other: Self) -> Self {
        Self { count: self.count + other.count, bounds: self.bounds.union(other.bounds) }
    }

    /// Expected work: share of the rays that meet it, times what it holds.
    fn cost(&self) -> f64 {
        let size = self.bounds.size().as_dvec3();
        (size.x * size.y + size.y * size.z + size.z * size.x) * self.count as f64
    }
}

type Bins = [[Bin; BINS]; 3];

/// The cheapest cut that gives neither side too little.
fn best_cut(boxes: &[Bounds], part: &[u32]) -> Option<Cut> {
    let centers = part
        .par_chunks(TASK)
        .map(|task| Bounds::from_points(task.iter().map(|&i| boxes[i as usize].center())))
        .reduce(|| Bounds::EMPTY, Bounds::union);
    let grid = Grid::over(centers);
    let bins = part
        .par_chunks(TASK)
        .map(|task| filled(boxes, task, &grid))
        .reduce(|| [[Bin::EMPTY; BINS]; 3], joined);
    let least = (LEAST_SHARE * part.len() as f32) as usize;
    let mut best: Option<(f64, Cut)> = None;
    for (axis, row) in bins.iter().enumerate() {
        for left_bins in 1..BINS {
            let sum = |bins: &[Bin]| bins.iter().fold(Bin::EMPTY, |sum, &bin| sum.join(bin));
            let (left, right) = (sum(&row[..left_bins]), sum(&row[left_bins..]));
            let cost = left.cost() + right.cost();
            if left.count.min(right.count) > least && best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, Cut { grid, axis, left_bins }));
            }
        }
    }
    best.map(|(_, cut)| cut)
}

fn filled(boxes: &[Bounds], task: &[u32], grid: &Grid) -> Bins {
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for &i in task {
        let bounds = boxes[i as usize];
        for (row, bin) in bins.iter_mut().zip(grid.bins(&bounds)) {
            row[bin] = row[bin].join(Bin { count: 1, bounds });
        }
    }
    bins
}

fn joined(mut a: Bins, b: Bins) -> Bins {
    for (bin, other) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *bin = bin.join(*other);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(count: u32, place: impl Fn(u32) -> Vec3) -> Vec<Bounds> {
        (0..count).map(|i| Bounds { min: place(i), max: place(i) + Vec3::ONE }).collect()
    }

    #[test]
    fn parts_hold_each_box_once_in_order_and_none_holds_too_many() {
        let spread = boxes(5000, |i| Vec3::new((i * 7 % 101) as f32, (i * 31 % 499) as f32, (i % 13) as f32));
        let coincident = boxes(1000, |_| Vec3::X);
        let clustered = boxes(1000, |i| if i == 0 { Vec3::splat(1e6) } else { Vec3::X * (i % 3) as f32 });
        for boxes in [spread, coincident, clustered] {
            let parts = parts(&boxes, 300);
            assert!(parts.iter().all(|part| part.len() <= 300 && part.is_sorted()));
            let mut all = parts.concat();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..boxes.len() as u32));
        }
    }

    #[test]
    fn a_gap_is_cut_along() {
        let two = boxes(1000, |i| Vec3::new((i % 10) as f32, 100.0 * (i % 2) as f32, (i % 7) as f32));
        let parts = parts(&two, 500);
        assert_eq!(parts.len(), 2);
        assert!(parts.iter().all(|part| part.iter().all(|i| i % 2 == part[0] % 2)));
    }
}
