//! The nearest points found so far: candidates are collected, and thinned out when there are too many.

/// Memory for a query of nearest points, and its answer; use it again and again, as it grows only once.
#[derive(Clone, Debug, Default)]
pub struct Nearest {
    entries: Vec<(f32, u32)>,
    k: usize,
}

impl Nearest {
    /// Empty.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of points found.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether none was found.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Squared distance and index of the points found; the order is that of the tree, not of distance.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (f32, u32)> {
        self.entries.iter().copied()
    }

    /// If `k` points were found, takes the farthest away and returns its squared distance.
    pub fn take_farthest(&mut self, k: usize) -> Option<f32> {
        if self.entries.len() < k {
            return None;
        }
        let farthest =
            (0..self.entries.len()).max_by(|&a, &b| self.entries[a].0.total_cmp(&self.entries[b].0))?;
        Some(self.entries.remove(farthest).0)
    }

    pub(super) fn begin(&mut self, k: usize) {
        self.entries.clear();
        self.k = k;
    }

    pub(super) fn push(&mut self, distance2: f32, i: u32) {
        self.entries.push((distance2, i));
    }

    /// Lowers the limit where more than enough candidates are known.
    pub(super) fn tighten(&mut self, limit: &mut f32) {
        if self.entries.len() >= self.k {
            self.finish();
            *limit = self.entries[self.k - 1].0;
        }
    }

    pub(super) fn finish(&mut self) {
        if self.entries.len() >= self.k {
            self.entries.select_nth_unstable_by(self.k - 1, |a, b| a.0.total_cmp(&b.0));
            self.entries.truncate(self.k);
        }
    }
}
