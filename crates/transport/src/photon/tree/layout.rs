//! How points and boxes lie in memory: by axis, so that one instruction serves many.

use hyaline_math::{Bounds, Vec3};

/// Points of a packet.
pub(super) const PACKET: usize = 16;

/// Children of a node.
pub(super) const FAN: usize = 8;

/// Coordinates of 16 points by axis. Places without a point hold NaN, which is near nothing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Packet(pub(super) [[f32; PACKET]; 3]);

impl Packet {
    /// A packet of at most 16 points.
    pub(super) fn new(points: impl Iterator<Item = Vec3>) -> Self {
        let mut packet = Self([[f32::NAN; PACKET]; 3]);
        for (lane, p) in points.take(PACKET).enumerate() {
            for axis in 0..3 {
                packet.0[axis][lane] = p[axis];
            }
        }
        packet
    }

    #[inline]
    pub(super) fn position(&self, lane: usize) -> Vec3 {
        Vec3::new(self.0[0][lane], self.0[1][lane], self.0[2][lane])
    }

    /// The smallest box about the points.
    pub(super) fn bounds(&self) -> Bounds {
        // Minima and maxima ignore the NaN of places without a point.
        let fold = |f: fn(f32, f32) -> f32, start: f32| {
            Vec3::from_array(self.0.map(|row| row.into_iter().fold(start, f)))
        };
        Bounds { min: fold(f32::min, f32::INFINITY), max: fold(f32::max, f32::NEG_INFINITY) }
    }
}

/// Boxes of eight children by axis. Absent children have the empty box, which is near nothing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    pub(super) min: [[f32; FAN]; 3],
    pub(super) max: [[f32; FAN]; 3],
}

impl Node {
    pub(super) const EMPTY: Self =
        Self { min: [[f32::INFINITY; FAN]; 3], max: [[f32::NEG_INFINITY; FAN]; 3] };

    /// A node of at most eight children.
    pub(super) fn new(children: impl Iterator<Item = Bounds>) -> Self {
        let mut node = Self::EMPTY;
        for (slot, bounds) in children.take(FAN).enumerate() {
            for axis in 0..3 {
                node.min[axis][slot] = bounds.min[axis];
                node.max[axis][slot] = bounds.max[axis];
            }
        }
        node
    }

    /// The smallest box about all children.
    pub(super) fn bounds(&self) -> Bounds {
        Bounds {
            min: Vec3::from_array(self.min.map(|row| row.into_iter().fold(f32::INFINITY, f32::min))),
            max: Vec3::from_array(self.max.map(|row| row.into_iter().fold(f32::NEG_INFINITY, f32::max))),
        }
    }
}
