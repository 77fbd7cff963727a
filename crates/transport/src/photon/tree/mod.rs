//! A tree of points: exact answers to 'which are within this radius' and 'which k are nearest'.
//!
//! A kd-tree with buckets, laid out without pointers:
//!
//! 1. `build` splits the points at medians, each time along the longest edge of their box, until every leaf has
//!    `leaf_size` of them and only the last one fewer. Splits fall where a tree with eight children to a node, full but
//!    for its right edge, wants them.
//! 2. Coordinates of leaves are stored by axis in packets of 16; what belongs to the points lies in an array beside them,
//!    in the same order.
//! 3. A node holds the boxes of its eight children, tight about their points: photons lie on surfaces, so
//!    that most of the space of a kd-cell is empty. Node i has the children 8 i + 1 … 8 i + 8.
//! 4. Queries descend it with one distance test for eight boxes and one for 16 points. Both round in the same order,
//!    so that the distance of a box is never above that of a point in it, to the last bit: queries are exact.

mod build;
mod layout;
mod nearest;
mod query;
mod region;
mod simd;
#[cfg(test)]
mod tests;

pub use nearest::Nearest;
pub use query::{Accept, All};
pub use region::{Disc, Region};

use hyaline_geometry::bvh::SimdLevel;
use hyaline_math::{Bounds, Vec3};
use layout::{Node, PACKET, Packet};
use simd::VerifiedLevel;

/// Points with something of type `T` at each, in the order of the tree: what is near has indices that are near.
#[derive(Clone, Debug)]
pub struct PointTree<T> {
    packets: Vec<Packet>,
    payloads: Vec<T>,
    nodes: Vec<Node>,
    /// Index that the first leaf would have among the nodes.
    first_leaf: u32,
    /// Packets in a leaf.
    leaf_packets: u32,
    bounds: Bounds,
    level: VerifiedLevel,
}

impl<T: Copy + Send + Sync> PointTree<T> {
    /// Builds the tree, on all threads of the current pool; the tree is the same for any number of them.
    ///
    /// - `points`: those that are not finite are left out, as nothing is near them.
    /// - `leaf_size`: most points in a leaf, rounded up to a power of two from 16 to 1024; decides on speed alone.
    ///
    /// # Panics
    /// With more than 2³² - 1 points.
    pub fn build(points: Vec<(Vec3, T)>, leaf_size: u32) -> Self {
        build::build(points, leaf_size)
    }

    /// The same tree, queried with other instructions; a level that the processor lacks becomes the best one.
    pub fn with_simd_level(mut self, level: SimdLevel) -> Self {
        self.level = VerifiedLevel::new(level);
        self
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.payloads.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.payloads.is_empty()
    }

    /// Memory that the tree takes, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.packets) + size_of_val(&*self.payloads) + size_of_val(&*self.nodes)
    }

    /// The smallest box about all points.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Where point `i` is.
    ///
    /// # Panics
    /// Where there is none.
    #[inline]
    pub fn position(&self, i: u32) -> Vec3 {
        let i = i as usize;
        self.packets[i / PACKET].position(i % PACKET)
    }

    /// What is at point `i`.
    ///
    /// # Panics
    /// Where there is none.
    #[inline]
    pub fn payload(&self, i: u32) -> &T {
        &self.payloads[i as usize]
    }
}
