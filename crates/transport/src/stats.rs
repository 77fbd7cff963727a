//! Counts of what a render did and what it ran into.

use hyaline_scattering::ObjectId;
use std::collections::BTreeMap;

/// Counts, added up over tiles and passes; sums only, so the order does not matter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Rays traced, shadow rays among them.
    pub rays: u64,
    /// Photons emitted.
    pub photons: u64,
    /// Photons that `merging` looked at.
    pub merges: u64,
    /// Branches that `whitted` cut because their weight or depth reached its limit.
    pub branches_cut: u64,
    /// Boundaries left that were never entered, by object index.
    pub never_entered: BTreeMap<u32, u64>,
}

impl Stats {
    /// Notes that a boundary of `object` was left which was never entered.
    pub fn count_never_entered(&mut self, object: ObjectId) {
        *self.never_entered.entry(object.0).or_default() += 1;
    }

    /// Adds the counts of `other`.
    pub fn add(&mut self, other: &Stats) {
        self.rays += other.rays;
        self.photons += other.photons;
        self.merges += other.merges;
        self.branches_cut += other.branches_cut;
        for (object, count) in &other.never_entered {
            *self.never_entered.entry(*object).or_default() += count;
        }
    }
}
