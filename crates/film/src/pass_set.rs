//! Which passes a film holds.

use std::fmt;

/// A set of pass numbers, kept as sorted ranges that neither overlap nor touch: equal sets are equal values.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PassSet {
    /// First and last pass of every range, both included.
    ranges: Vec<(u32, u32)>,
}

impl PassSet {
    /// No passes.
    pub fn new() -> Self {
        Self::default()
    }

    /// The passes first, …, last of each pair; `None` unless sorted, apart and not touching.
    pub fn from_ranges(ranges: Vec<(u32, u32)>) -> Option<Self> {
        let forward = ranges.iter().all(|(first, last)| first <= last);
        let apart = ranges.windows(2).all(|pair| u64::from(pair[0].1) + 1 < u64::from(pair[1].0));
        (forward && apart).then_some(Self { ranges })
    }

    /// First and last pass, both included, of each run of consecutive passes, in order.
    pub fn ranges(&self) -> &[(u32, u32)] {
        &self.ranges
    }

    /// Every pass, in order.
    pub fn iter(&self) -> impl Iterator<Item = u32> {
        self.ranges.iter().flat_map(|&(first, last)| first..=last)
    }

    /// Number of passes.
    pub fn len(&self) -> u64 {
        self.ranges.iter().map(|&(first, last)| u64::from(last - first) + 1).sum()
    }

    /// Whether there is no pass.
    pub fn is_empty(&self) -> bool {
        self.ranges.is_empty()
    }

    /// Whether `pass` is in the set.
    pub fn contains(&self, pass: u32) -> bool {
        let next = self.ranges.partition_point(|&(_, last)| last < pass);
        self.ranges.get(next).is_some_and(|&(first, _)| first <= pass)
    }

    /// Adds `pass`; false where it was there already.
    pub fn insert(&mut self, pass: u32) -> bool {
        let is_new = !self.contains(pass);
        if is_new {
            *self = self.union(&Self { ranges: vec![(pass, pass)] });
        }
        is_new
    }

    /// Passes in either set.
    pub fn union(&self, other: &Self) -> Self {
        let mut all: Vec<(u32, u32)> = self.ranges.iter().chain(&other.ranges).copied().collect();
        all.sort_unstable();
        let mut ranges: Vec<(u32, u32)> = Vec::with_capacity(all.len());
        for (first, last) in all {
            match ranges.last_mut() {
                Some(open) if u64::from(first) <= u64::from(open.1) + 1 => open.1 = open.1.max(last),
                _ => ranges.push((first, last)),
            }
        }
        Self { ranges }
    }

    /// The lowest pass in both sets.
    pub fn overlap(&self, other: &Self) -> Option<u32> {
        let (mut a, mut b) = (self.ranges.iter().peekable(), other.ranges.iter().peekable());
        while let (Some(x), Some(y)) = (a.peek(), b.peek()) {
            if x.0.max(y.0) <= x.1.min(y.1) {
                return Some(x.0.max(y.0));
            }
            if x.1 < y.1 {
                a.next()
            } else {
                b.next()
            };
        }
        None
    }
}

impl fmt::Display for PassSet {
    /// As on the command line, the end excluded: `0..16, 20..24`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return write!(f, "none");
        }
        for (i, &(first, last)) in self.ranges.iter().enumerate() {
            let separator = if i > 0 { ", " } else { "" };
            write!(f, "{separator}{first}..{}", u64::from(last) + 1)?;
        }
        Ok(())
    }
}

impl FromIterator<u32> for PassSet {
    fn from_iter<I: IntoIterator<Item = u32>>(passes: I) -> Self {
        let mut set = Self::new();
        passes.into_iter().for_each(|pass| {
            set.insert(pass);
        });
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Small numbers that repeat, from a fixed linear congruence.
    fn numbers(seed: u32, count: usize) -> Vec<u32> {
        let step = |x: &u32| Some(x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        std::iter::successors(Some(seed), step).skip(1).take(count).map(|x| x >> 26).collect()
    }

    #[test]
    fn sets_of_passes_behave_as_sets_of_numbers() {
        for seed in 0..50 {
            let (a, b) = (numbers(seed, 20), numbers(seed + 1000, 9));
            let (set_a, set_b): (PassSet, PassSet) =
                (a.iter().copied().collect(), b.iter().copied().collect());
            let (tree_a, tree_b): (BTreeSet<u32>, BTreeSet<u32>) =
                (a.into_iter().collect(), b.into_iter().collect());
            assert!(set_a.iter().eq(tree_a.iter().copied()));
            assert_eq!(set_a.len(), tree_a.len() as u64);
            assert!((0..70).all(|pass| set_a.contains(pass) == tree_a.contains(&pass)));
            assert!(set_a.union(&set_b).iter().eq(tree_a.union(&tree_b).copied()));
            assert_eq!(set_a.overlap(&set_b), tree_a.intersection(&tree_b).next().copied());
            assert_eq!(PassSet::from_ranges(set_a.ranges().to_vec()), Some(set_a));
        }
    }

    #[test]
    fn consecutive_passes_are_one_range_whatever_their_order() {
        let set: PassSet = [3, 1, 0, 2, 7, u32::MAX, u32::MAX - 1].into_iter().collect();
        assert_eq!(set.ranges(), [(0, 3), (7, 7), (u32::MAX - 1, u32::MAX)]);
        assert_eq!(set.to_string(), "0..4, 7..8, 4294967294..4294967296");
        assert_eq!(PassSet::new().to_string(), "none");
    }

    #[test]
    fn a_pass_is_inserted_once() {
        let mut set = PassSet::new();
        assert!(set.insert(5));
        assert!(!set.insert(5));
    }

    #[test]
    fn untidy_ranges_are_refused() {
        for ranges in [vec![(3, 2)], vec![(0, 1), (2, 3)], vec![(0, 5), (4, 8)], vec![(5, 6), (0, 1)]] {
            assert_eq!(PassSet::from_ranges(ranges), None);
        }
    }
}
