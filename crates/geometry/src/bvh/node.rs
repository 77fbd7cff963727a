//! The memory layout of trees: nodes of eight boxes, blocks of eight triangles.

use hyaline_math::{Bounds, Vec3, Vec3A};

/// Children of a node.
pub(crate) const WIDTH: usize = 8;

/// Triangles of a block.
pub(crate) const BLOCK: usize = 8;

/// Most entries the stack of a traversal can hold.
pub(crate) const STACK_SIZE: usize = 256;

/// Most levels of nodes: each leaves at most seven children on the stack while the eighth is visited.
pub(crate) const MAX_DEPTH: usize = STACK_SIZE / (WIDTH - 1);

/// What a child of a node is: a node, or a leaf (a block of triangles, an item).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

impl Child {
    const LEAF: u32 = 1 << 31;

    pub(crate) fn node(index: usize) -> Self {
        debug_assert!(index < Self::LEAF as usize);
        Self(index as u32)
    }

    pub(crate) fn leaf(index: usize) -> Self {
        debug_assert!(index < Self::LEAF as usize);
        Self(index as u32 | Self::LEAF)
    }

    pub(crate) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    pub(crate) fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    pub(crate) fn index(self) -> usize {
        (self.0 & !Self::LEAF) as usize
    }
}

/// Eight boxes, plane by plane, and what they hold.
///
/// Children that are absent have a box that no finite ray meets; they refer to a leaf, so that even a ray that is NaN
/// comes to an end.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Lower x, upper x, lower y, upper y, lower z, upper z.
    pub(crate) planes: [[f32; WIDTH]; 6],
    pub(crate) children: [Child; WIDTH],
}

impl Node {
    /// A node without children.
    pub(crate) fn empty() -> Self {
        let (low, high) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
        Self { planes: [low, high, low, high, low, high], children: [Child::leaf(0); WIDTH] }
    }

    pub(crate) fn set(&mut self, slot: usize, bounds: &Bounds, child: Child) {
        for axis in 0..3 {
            self.planes[2 * axis][slot] = bounds.min[axis];
            self.planes[2 * axis + 1][slot] = bounds.max[axis];
        }
        self.children[slot] = child;
    }
}

/// Up to eight triangles, coordinate by coordinate.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Block {
    /// By vertex, then by axis.
    pub(crate) vertices: [[[f32; BLOCK]; 3]; 3],
    /// The faces; the highest bit is set where there is none.
    pub(crate) faces: [u32; BLOCK],
}

impl Block {
    const NO_FACE: u32 = u32::MAX;

    /// A block without triangles.
    pub(crate) fn empty() -> Self {
        Self { vertices: [[[0.0; BLOCK]; 3]; 3], faces: [Self::NO_FACE; BLOCK] }
    }

    pub(crate) fn set(&mut self, lane: usize, face: u32, corners: [Vec3; 3]) {
        for (vertex, corner) in corners.iter().enumerate() {
            for axis in 0..3 {
                self.vertices[vertex][axis][lane] = corner[axis];
            }
        }
        self.faces[lane] = face;
    }

    /// The corners of a triangle, their coordinates in the order of `axes`.
    #[inline(always)]
    pub(crate) fn corners(&self, lane: usize, axes: [usize; 3]) -> [[f32; 3]; 3] {
        let corner = |v: &[[f32; BLOCK]; 3]| axes.map(|axis| v[axis][lane]);
        [corner(&self.vertices[0]), corner(&self.vertices[1]), corner(&self.vertices[2])]
    }
}

/// A tree of boxes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    /// Where to start; `None` in an empty tree.
    pub(crate) root: Option<Child>,
    pub(crate) bounds: Bounds,
}

impl Tree {
    /// Gives the leaves other indices.
    pub(crate) fn relabel(&mut self, label: impl Fn(usize) -> usize) {
        let children = self.nodes.iter_mut().flat_map(|node| &mut node.children);
        for child in children.chain(&mut self.root).filter(|child| child.is_leaf()) {
            *child = Child::leaf(label(child.index()));
        }
    }

    /// Largest absolute coordinate along each axis.
    #[inline(always)]
    pub(crate) fn reach(&self) -> Vec3A {
        self.bounds.min.to_vec3a().abs().max(self.bounds.max.to_vec3a().abs())
    }
}
