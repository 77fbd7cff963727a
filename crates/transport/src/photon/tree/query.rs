//! Queries: where they look, and how they descend.

use super::PointTree;
use super::layout::{FAN, Node, PACKET, Packet};
use super::nearest::Nearest;
use hyaline_math::Vec3;

/// Where a query looks: a ball, or a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Center.
    pub center: Vec3,
    /// Radius, scene units, ≥ 0; may be infinite. What lies on the edge is inside.
    pub radius: f32,
    /// What makes a disc of the ball.
    pub disc: Option<Disc>,
}

/// A disc: the part of a ball close to a plane through its center.
///
/// Its proportions are fixed, and what is nearest is found by growing it: the distance of a point is the radius of the
/// smallest disc that holds it, the larger of its distance from the center and of that from the plane over `thickness`.
/// So the disc through the k-th photon rejects, by its own size, what a disc of the largest radius would let in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Normal of the plane, unit.
    pub normal: Vec3,
    /// Half its thickness as a fraction of its radius, 0…1; less than 1/1000 is taken for that, as surfaces are not
    /// known better.
    pub thickness: f32,
}

/// Least thickness of a disc.
const MIN_THICKNESS: f32 = 1e-3;

/// What distances are measured from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe {
    pub(super) center: [f32; 3],
    /// Normal of the disc over its thickness.
    pub(super) normal: [f32; 3],
    pub(super) is_disc: bool,
    /// Squared distances below this are inside.
    pub(super) limit: f32,
}

impl Probe {
    /// `None` where nothing can be inside.
    fn new(region: &Region) -> Option<Self> {
        if !(region.center.is_finite() && region.radius >= 0.0) {
            return None;
        }
        let normal =
            region.disc.map_or(Vec3::ZERO, |disc| disc.normal / disc.thickness.clamp(MIN_THICKNESS, 1.0));
        let limit = (region.radius * region.radius).next_up();
        let is_disc = region.disc.is_some();
        Some(Self { center: region.center.to_array(), normal: normal.to_array(), is_disc, limit })
    }

    /// Squared distances of the boxes of a node.
    #[inline(always)]
    fn box_distances(&self, node: &Node) -> [f32; FAN] {
        let mut sums = [0.0; FAN];
        for axis in 0..3 {
            for slot in 0..FAN {
                let below = node.min[axis][slot] - self.center[axis];
                let above = self.center[axis] - node.max[axis][slot];
                let distance = below.max(above).max(0.0);
                sums[slot] += distance * distance;
            }
        }
        sums
    }

    /// Squared distances of the points of a packet.
    #[inline(always)]
    fn point_distances(&self, packet: &Packet) -> [f32; PACKET] {
        let mut sums = [0.0; PACKET];
        let mut heights = [0.0; PACKET];
        for axis in 0..3 {
            for lane in 0..PACKET {
                let offset = packet.0[axis][lane] - self.center[axis];
                sums[lane] += offset * offset;
                heights[lane] += offset * self.normal[axis];
            }
        }
        if self.is_disc {
            for lane in 0..PACKET {
                sums[lane] = sums[lane].max(heights[lane] * heights[lane]);
            }
        }
        sums
    }
}

impl<T: Copy + Send + Sync> PointTree<T> {
    /// Visits all points of a region, with their squared distances.
    pub fn within(&self, region: &Region, visit: &mut impl FnMut(u32, f32)) {
        let Some(probe) = Probe::new(region) else { return };
        let mut stack = vec![0_u32; usize::from(!self.nodes.is_empty())];
        while let Some(id) = stack.pop() {
            if id < self.first_leaf {
                let distances = probe.box_distances(&self.nodes[id as usize]);
                for slot in (0..FAN).filter(|&slot| distances[slot] < probe.limit) {
                    stack.push(id * FAN as u32 + 1 + slot as u32);
                }
                continue;
            }
            for (packet, first) in self.leaf(id) {
                let distances = probe.point_distances(packet);
                for lane in (0..PACKET).filter(|&lane| distances[lane] < probe.limit) {
                    visit(first + lane as u32, distances[lane]);
                }
            }
        }
    }

    /// Finds the `k` nearest points of a region among those that `accept` takes; fewer where there are not as many.
    ///
    /// Of points at one and the same distance it is open which are taken; it depends on the tree and the region alone.
    ///
    /// - `found`: memory for the answer, which replaces what was in it.
    pub fn nearest(&self, region: &Region, k: usize, accept: impl Fn(u32) -> bool, found: &mut Nearest) {
        found.begin(k);
        let Some(mut probe) = Probe::new(region).filter(|_| k > 0 && !self.is_empty()) else { return };
        let mut stack = vec![(0.0, 0_u32)];
        while let Some((distance, id)) = stack.pop() {
            if distance >= probe.limit {
                continue;
            }
            if id < self.first_leaf {
                let distances = probe.box_distances(&self.nodes[id as usize]);
                let start = stack.len();
                for slot in (0..FAN).filter(|&slot| distances[slot] < probe.limit) {
                    stack.push((distances[slot], id * FAN as u32 + 1 + slot as u32));
                }
                stack[start..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
                continue;
            }
            for (packet, first) in self.leaf(id) {
                let distances = probe.point_distances(packet);
                for lane in (0..PACKET).filter(|&lane| distances[lane] < probe.limit) {
                    if accept(first + lane as u32) {
                        found.push(distances[lane], first + lane as u32);
                    }
                }
            }
            found.tighten(&mut probe.limit);
        }
        found.finish();
    }

    /// Packets of a leaf, and the index of the first point in each.
    fn leaf(&self, id: u32) -> impl Iterator<Item = (&Packet, u32)> {
        let first = ((id - self.first_leaf) * self.leaf_packets) as usize;
        let end = (first + self.leaf_packets as usize).min(self.packets.len());
        self.packets[first..end].iter().zip((first * PACKET..).step_by(PACKET).map(|i| i as u32))
    }
}
