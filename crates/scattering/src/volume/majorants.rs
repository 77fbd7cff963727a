//! Upper bounds of a grid's density, block by block, and the walk along a line from block to block.
//!
//! Where a block is empty, paths cross it in one step; where it is thin, possible collisions are few.

use super::grid::Inside;
use hyaline_math::Vec3;

/// Cells of the grid along each side of a block.
const BLOCK: u32 = 8;

/// Upper bounds of a grid's density.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Majorants {
    /// Blocks along x, y and z.
    blocks: [u32; 3],
    /// Sides of a block in the unit cube.
    extent: Vec3,
    values: Vec<f32>,
}

/// A stretch of a line within one block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub(super) range: [f32; 2],
    /// Upper bound of the density on it.
    pub(super) majorant: f32,
}

impl Majorants {
    pub(super) fn new(size: [u32; 3], density: &[f32]) -> Self {
        let blocks = size.map(|n| n.div_ceil(BLOCK));
        let extent = Vec3::from_array(std::array::from_fn(|axis| BLOCK as f32 / size[axis] as f32));
        let mut values = Vec::with_capacity(blocks.iter().map(|&n| n as usize).product());
        for z in 0..blocks[2] {
            for y in 0..blocks[1] {
                for x in 0..blocks[0] {
                    values.push(block_maximum(size, density, [x, y, z]));
                }
            }
        }
        Self { blocks, extent, values }
    }

    /// The stretches of a line, in order.
    pub(super) fn along(&self, line: Inside) -> Walk<'_> {
        let start = line.origin + line.direction * line.range[0];
        let cell = std::array::from_fn(|axis| {
            let index = (start[axis] / self.extent[axis]).floor().max(0.0) as u32;
            index.min(self.blocks[axis] - 1)
        });
        Walk { majorants: self, line, cell, t: line.range[0] }
    }
}

/// Largest density in a block and in the cells next to it, between which values are interpolated.
fn block_maximum(size: [u32; 3], density: &[f32], block: [u32; 3]) -> f32 {
    let range = |axis: usize| {
        let first = (block[axis] * BLOCK).saturating_sub(1);
        first..((block[axis] + 1) * BLOCK + 1).min(size[axis])
    };
    let mut maximum = 0.0_f32;
    for z in range(2) {
        for y in range(1) {
            let row = (z as usize * size[1] as usize + y as usize) * size[0] as usize;
            let cells = row + range(0).start as usize..row + range(0).end as usize;
            maximum = density[cells].iter().fold(maximum, |a, &b| a.max(b));
        }
    }
    maximum
}

/// The walk of a line from block to block.
#[derive(Clone, Debug)]
pub(super) struct Walk<'a> {
    majorants: &'a Majorants,
    line: Inside,
    cell: [u32; 3],
    t: f32,
}

impl Iterator for Walk<'_> {
    type Item = Stretch;

    fn next(&mut self) -> Option<Stretch> {
        let Majorants { blocks, extent, values } = self.majorants;
        if self.t >= self.line.range[1] {
            return None;
        }
        let [x, y, z] = self.cell;
        let majorant = values[((z * blocks[1] + y) * blocks[0] + x) as usize];
        // The next plane that the line crosses.
        let (mut nearest, mut nearest_axis) = (self.line.range[1], 3);
        for axis in 0..3 {
            let d = self.line.direction[axis];
            if d != 0.0 {
                let side = self.cell[axis] + u32::from(d > 0.0);
                let t = (side as f32 * extent[axis] - self.line.origin[axis]) / d;
                if t < nearest {
                    (nearest, nearest_axis) = (t, axis);
                }
            }
        }
        let range = [self.t, nearest.max(self.t)];
        self.t = range[1];
        if nearest_axis < 3 {
            let axis = nearest_axis;
            let is_last = if self.line.direction[axis] > 0.0 {
                self.cell[axis] + 1 >= blocks[axis]
            } else {
                self.cell[axis] == 0
            };
            if is_last {
                self.t = f32::INFINITY;
            } else if self.line.direction[axis] > 0.0 {
                self.cell[axis] += 1;
            } else {
                self.cell[axis] -= 1;
            }
        }
        Some(Stretch { range, majorant })
    }
}
