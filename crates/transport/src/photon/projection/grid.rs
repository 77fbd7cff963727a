//! A grid of yes and no over the unit square, and points drawn from its yes cells alone.

use super::ball::Ball;
use hyaline_math::float::ONE_MINUS_EPSILON;
use hyaline_math::{DVec2, Vec2};
use hyaline_world::light::UnitBox;

/// Which cells of the unit square are a yes: a bit each.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    size: u32,
    words_per_row: usize,
    words: Vec<u64>,
    /// Yes cells before each row, and all of them at the end.
    starts: Vec<u32>,
}

impl Grid {
    /// Asks of each of `size` × `size` cells whether any of the targets is in its way.
    ///
    /// - `reaches`: makes, for a box of the square, the test of a target; where it says no for a box it must hold for
    ///   all that lies in it.
    ///
    /// The square is halved again and again, and what a half does not reach its parts are not asked about.
    pub(super) fn new<F: Fn(&Ball) -> bool>(
        size: u32,
        targets: &[Ball],
        reaches: &impl Fn(&UnitBox) -> F,
    ) -> Self {
        let words_per_row = (size as usize).div_ceil(64);
        let words = vec![0; words_per_row * size as usize];
        let mut grid = Self { size, words_per_row, words, starts: Vec::new() };
        grid.fill([0, size], [0, size], &mut targets.to_vec(), reaches);
        grid.count();
        grid
    }

    /// - `targets`: those that may be in the way; their order is changed.
    fn fill<F: Fn(&Ball) -> bool>(
        &mut self,
        x: [u32; 2],
        y: [u32; 2],
        targets: &mut [Ball],
        reaches: &impl Fn(&UnitBox) -> F,
    ) {
        let test = reaches(&self.unit_box(x, y));
        let (width, height) = (x[1] - x[0], y[1] - y[0]);
        if width == 1 && height == 1 {
            if let Some(met) = targets.iter().position(test) {
                self.set(x[0], y[0]);
                // The neighbors are likely to meet it, too.
                targets.swap(0, met);
            }
            return;
        }
        let near = bring_forward(targets, test);
        if near.is_empty() {
            return;
        }
        if width >= height {
            let middle = halfway(x);
            self.fill([x[0], middle], y, near, reaches);
            self.fill([middle, x[1]], y, near, reaches);
        } else {
            let middle = halfway(y);
            self.fill(x, [y[0], middle], near, reaches);
            self.fill(x, [middle, y[1]], near, reaches);
        }
    }

    fn unit_box(&self, x: [u32; 2], y: [u32; 2]) -> UnitBox {
        let corner = |i: usize| DVec2::new(f64::from(x[i]), f64::from(y[i])) / f64::from(self.size);
        UnitBox { min: corner(0), max: corner(1) }
    }

    fn set(&mut self, x: u32, y: u32) {
        self.words[y as usize * self.words_per_row + x as usize / 64] |= 1 << (x % 64);
    }

    fn count(&mut self) {
        let mut sum = 0;
        self.starts.push(0);
        for row in self.words.chunks_exact(self.words_per_row) {
            sum += row.iter().map(|word| word.count_ones()).sum::<u32>();
            self.starts.push(sum);
        }
    }

    /// Share of the cells that are a yes.
    pub(super) fn fraction(&self) -> f64 {
        f64::from(self.yes_count()) / (f64::from(self.size) * f64::from(self.size))
    }

    fn yes_count(&self) -> u32 {
        self.starts[self.size as usize]
    }

    /// A uniform point of the yes cells; `None` where there is none.
    ///
    /// - `u`: two uniform random numbers in [0, 1); the second chooses the row.
    pub(super) fn sample(&self, u: Vec2) -> Option<Vec2> {
        let total = self.yes_count();
        if total == 0 {
            return None;
        }
        let position = f64::from(u.y) * f64::from(total);
        let row = self.starts.partition_point(|&start| f64::from(start) <= position) - 1;
        let row = row.min(self.size as usize - 1);
        let count = self.starts[row + 1] - self.starts[row];
        let along_row = (position - f64::from(self.starts[row])) / f64::from(count);
        let along = f64::from(u.x) * f64::from(count);
        let rank = (along as u32).min(count - 1);
        let column = self.column_of(row, rank);
        let cell = |index: f64, inside: f64| {
            (((index + inside) / f64::from(self.size)) as f32).min(ONE_MINUS_EPSILON)
        };
        Some(Vec2::new(cell(f64::from(column), along - f64::from(rank)), cell(row as f64, along_row)))
    }

    /// The column of the yes cell of this rank in a row.
    fn column_of(&self, row: usize, mut rank: u32) -> u32 {
        let words = &self.words[row * self.words_per_row..][..self.words_per_row];
        for (i, &word) in words.iter().enumerate() {
            let count = word.count_ones();
            if rank < count {
                let rest = (0..rank).fold(word, |rest, _| rest & (rest - 1));
                return i as u32 * 64 + rest.trailing_zeros();
            }
            rank -= count;
        }
        unreachable!("the row has more yes cells than the rank")
    }

    /// Memory, bytes.
    pub(super) fn memory(&self) -> usize {
        size_of_val(&self.words[..]) + size_of_val(&self.starts[..])
    }
}

/// Puts those that pass the test before the others, and returns them.
fn bring_forward<T>(things: &mut [T], test: impl Fn(&T) -> bool) -> &mut [T] {
    let mut count = 0;
    for i in 0..things.len() {
        if test(&things[i]) {
            things.swap(i, count);
            count += 1;
        }
    }
    &mut things[..count]
}

/// The middle of a range: at its finest power of two, so that halves of the square are asked about as such.
fn halfway([low, high]: [u32; 2]) -> u32 {
    low + (high - low) / 2
}
