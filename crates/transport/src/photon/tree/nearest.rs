//! The nearest points found so far: candidates are collected, and thinned out when there are too many.
//!
//! No heap: candidates are appended, up to half as many again as are wanted. Then a distance is sought that about k of
//! them do not exceed, by counting how many lie within a guess and moving the guess (distances of photons on a surface,
//! squared, are spread evenly, so that few guesses are needed); the others are dropped, and it is the new limit. Only the
//! last thinning must be exact.

use super::layout::PACKET;
use super::simd::{Distances, Lanes};

/// Memory for a query of nearest points, and its answer; use it again and again, as it grows only once.
#[derive(Clone, Debug, Default)]
pub struct Nearest {
    /// Squared distances; whole packets, of which only the first `len` numbers mean something.
    distances: Vec<f32>,
    /// Indices, likewise.
    indices: Vec<u32>,
    len: usize,
    k: usize,
    /// Whether there was a first k.
    is_limited: bool,
}

impl Nearest {
    /// Empty.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of points found.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether none was found.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Squared distances of the points found; the order is that of the tree, not of distance.
    pub fn distances(&self) -> &[f32] {
        &self.distances[..self.len]
    }

    /// Indices of the points found, in the order of `distances`.
    pub fn indices(&self) -> &[u32] {
        &self.indices[..self.len]
    }

    /// Squared distance and index of the points found.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (f32, u32)> {
        self.distances().iter().copied().zip(self.indices().iter().copied())
    }

    /// If `k` points were found, takes the farthest away and returns its squared distance.
    pub fn take_farthest(&mut self, k: usize) -> Option<f32> {
        if self.len < k {
            return None;
        }
        let farthest = self.distances().iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let place = self.distances().iter().position(|&distance| distance == farthest)?;
        self.distances.copy_within(place + 1..self.len, place);
        self.indices.copy_within(place + 1..self.len, place);
        self.len -= 1;
        Some(farthest)
    }

    /// Begins a query.
    pub(super) fn begin(&mut self, k: usize) {
        self.len = 0;
        self.k = k;
        self.is_limited = false;
    }

    /// Adds the points of a packet that are in `mask`; `first` is the index of its first point.
    #[inline(always)]
    pub(super) fn push<L: Lanes>(&mut self, lanes: L, distances: &Distances, mask: u32, first: u32) {
        if mask == 0 {
            return;
        }
        if self.len + PACKET > self.distances.len() {
            self.grow();
        }
        let indices: [u32; PACKET] = std::array::from_fn(|lane| first + lane as u32);
        lanes.compress(&distances.0, mask, packet_mut(&mut self.distances, self.len));
        lanes.compress(&indices, mask, packet_mut(&mut self.indices, self.len));
        self.len += mask.count_ones() as usize;
    }

    #[cold]
    fn grow(&mut self) {
        // Whole packets, so that the last one can be read as such.
        let size = (2 * (self.len + PACKET)).next_multiple_of(PACKET);
        self.distances.resize(size, 0.0);
        self.indices.resize(size, 0);
    }

    /// The distance, squared, below which points still matter, at most `limit`. Thins the candidates out where there are
    /// many.
    #[inline(always)]
    pub(super) fn tighten<L: Lanes>(&mut self, lanes: L, limit: f32) -> f32 {
        // The first limit is worth having at once; later ones once there is much to drop.
        let most = if self.is_limited { self.k + self.k / 2 + PACKET } else { self.k };
        if self.len < most {
            return limit;
        }
        self.is_limited = true;
        self.thin_out(lanes, self.k / 8)
    }

    /// Ends a query: leaves the k nearest.
    #[inline(always)]
    pub(super) fn finish<L: Lanes>(&mut self, lanes: L) {
        if self.len > self.k {
            self.thin_out(lanes, 0);
        }
    }

    /// Drops all but the k nearest candidates and at most `excess` more; returns a bound on the distances left.
    #[inline(always)]
    fn thin_out<L: Lanes>(&mut self, lanes: L, excess: usize) -> f32 {
        let cut = self.find_cut(excess);
        match cut.ties {
            0 => self.keep_up_to(lanes, cut.distance),
            ties => self.keep_below(cut.distance, ties),
        }
        cut.distance
    }

    /// A distance that k to k + `excess` candidates do not exceed.
    #[inline(always)]
    fn find_cut(&self, excess: usize) -> Cut {
        let distances = self.distances();
        let farthest = distances.iter().fold(0.0, |a: f32, &b| if a > b { a } else { b });
        let mut low = End { bits: -1, count: 0 };
        let mut high = End { bits: farthest.to_bits() as i32, count: self.len };
        let wanted = self.k as f32 + 0.5 * excess.max(1) as f32;
        let mut guess_count = 0;
        loop {
            if (self.k..=self.k + excess).contains(&high.count) {
                return Cut { distance: high.distance(), ties: 0 };
            }
            if high.bits - low.bits == 1 {
                // More candidates than are wanted lie at one and the same distance.
                return Cut { distance: high.distance(), ties: self.k - low.count };
            }
            guess_count += 1;
            // Halving in between keeps the number of guesses small whatever the distances are.
            let bits = if guess_count % 4 == 0 { i32::MIN } else { End::between(low, high, wanted) };
            let bits = if bits > low.bits && bits < high.bits {
                bits
            } else {
                low.bits + (high.bits - low.bits) / 2
            };
            let distance = f32::from_bits(bits as u32);
            let count = distances.iter().map(|&d| u32::from(d <= distance)).sum::<u32>() as usize;
            let end = if count < self.k { &mut low } else { &mut high };
            *end = End { bits, count };
        }
    }

    /// Drops the candidates beyond a distance.
    #[inline(always)]
    fn keep_up_to<L: Lanes>(&mut self, lanes: L, distance: f32) {
        let mut kept = 0;
        for start in (0..self.len).step_by(PACKET) {
            let distances = *packet_mut(&mut self.distances, start);
            let indices = *packet_mut(&mut self.indices, start);
            let is_candidate = u32::MAX >> (32 - (self.len - start).min(PACKET));
            let mask = lanes.not_above(&distances, distance) & is_candidate;
            // What is written beyond the kept ones was read before.
            lanes.compress(&distances, mask, packet_mut(&mut self.distances, kept));
            lanes.compress(&indices, mask, packet_mut(&mut self.indices, kept));
            kept += mask.count_ones() as usize;
        }
        self.len = kept;
    }

    /// Drops the candidates at a distance or beyond, but for the first `ties` of those right at it.
    #[cold]
    fn keep_below(&mut self, distance: f32, mut ties: usize) {
        let mut kept = 0;
        for i in 0..self.len {
            let candidate = self.distances[i];
            let is_tie = candidate == distance && ties > 0;
            if candidate < distance || is_tie {
                ties -= usize::from(is_tie);
                self.distances[kept] = candidate;
                self.indices[kept] = self.indices[i];
                kept += 1;
            }
        }
        self.len = kept;
    }
}

/// Where candidates are cut off.
struct Cut {
    /// Squared distance of the farthest that stay, or a bit more.
    distance: f32,
    /// How many of those right at `distance` stay; 0 for all.
    ties: usize,
}

/// An end of the range in which the cut lies.
#[derive(Clone, Copy)]
struct End {
    /// A squared distance as the bits of an `f32`, which are in the order of the numbers; -1 is below all of them.
    bits: i32,
    /// Candidates up to there.
    count: usize,
}

impl End {
    fn distance(self) -> f32 {
        f32::from_bits(self.bits.max(0) as u32)
    }

    /// Where `wanted` candidates would be if they were spread evenly, as bits.
    fn between(low: Self, high: Self, wanted: f32) -> i32 {
        let fraction = (wanted - low.count as f32) / (high.count - low.count) as f32;
        (low.distance() + fraction * (high.distance() - low.distance())).to_bits() as i32
    }
}

/// A packet's worth of a list.
#[inline(always)]
pub(super) fn packet_mut<N>(list: &mut [N], start: usize) -> &mut [N; PACKET] {
    (&mut list[start..start + PACKET]).try_into().expect("the range is of this length")
}
