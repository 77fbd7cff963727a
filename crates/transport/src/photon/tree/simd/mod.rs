//! The wide steps of queries for each kind of processor: all `unsafe` of this crate.
//!
//! The kind is chosen once for a query, around the whole descent; everything below is inlined into it. All kinds
//! multiply and add in the same order and never fuse, so that they give the same bits.

#![allow(unsafe_code, reason = "vector instructions")]

#[cfg(test)]
mod tests;
#[cfg(target_arch = "x86_64")]
mod x86;

use super::layout::{FAN, Node, PACKET, Packet};
use super::region::Probe;
use hyaline_geometry::bvh::SimdLevel;

/// Squared distances of the points of a packet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Distances(pub(super) [f32; PACKET]);

/// A level that this processor has; the field is private so that nothing else can be one.
#[derive(Clone, Copy, Debug)]
pub(super) struct VerifiedLevel(SimdLevel);

impl VerifiedLevel {
    /// The level, or the best one where the processor lacks it.
    pub(super) fn new(level: SimdLevel) -> Self {
        let level = if level.is_supported() { level } else { SimdLevel::detect() };
        // All processors with AVX2 have the instructions for bits, but nothing says so.
        Self(if level == SimdLevel::Avx2 && !has_bit_instructions() { SimdLevel::Scalar } else { level })
    }

    /// Runs a query with the instructions of this level.
    #[inline(always)]
    pub(super) fn run<Q: Query>(self, query: Q) -> Q::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: a verified level is one the processor has.
            SimdLevel::Avx2 => unsafe { x86::run_avx2(query) },
            // What the compiler makes of the plain steps is SSE2 already on any x86-64.
            _ => query.run(Plain),
        }
    }
}

/// Whether the processor searches and counts bits by instructions of their own.
fn has_bit_instructions() -> bool {
    #[cfg(target_arch = "x86_64")]
    return is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("bmi2")
        && is_x86_feature_detected!("popcnt");
    #[cfg(not(target_arch = "x86_64"))]
    return false;
}

/// Work to be done with some kind of lanes. `run` must be inlined, so that it is compiled for the level.
pub(super) trait Query {
    type Output;
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// The wide operations.
pub(super) trait Lanes: Copy {
    /// Squared distances of the boxes of a node, and which are below `limit`, as bits.
    fn box_distances(self, probe: &Probe, node: &Node, limit: f32) -> ([f32; FAN], u32);

    /// Squared distances of the points of a packet, and which are below `limit`, as bits.
    fn point_distances(self, probe: &Probe, packet: &Packet, limit: f32) -> (Distances, u32);

    /// Which numbers are at most `limit`, as bits.
    fn not_above(self, numbers: &[f32; PACKET], limit: f32) -> u32;

    /// Moves the numbers of the lanes in `mask` to the front of the result; what follows them there is of no meaning.
    fn compress<N: Number>(self, numbers: &[N; PACKET], mask: u32, result: &mut [N; PACKET]);
}

/// A plain number of 32 bits.
pub(super) trait Number: bytemuck::Pod {}
impl Number for f32 {}
impl Number for u32 {}

/// One number at a time, for the compiler to make the best of.
#[derive(Clone, Copy)]
pub(super) struct Plain;

impl Lanes for Plain {
    #[inline(always)]
    fn box_distances(self, probe: &Probe, node: &Node, limit: f32) -> ([f32; FAN], u32) {
        let mut sums = [0.0; FAN];
        for axis in 0..3 {
            for (slot, sum) in sums.iter_mut().enumerate() {
                let below = node.min[axis][slot] - probe.center[axis];
                let above = probe.center[axis] - node.max[axis][slot];
                let distance = below.max(above).max(0.0);
                *sum += distance * distance;
            }
        }
        (sums, bits(&sums, |distance| distance < limit))
    }

    #[inline(always)]
    fn point_distances(self, probe: &Probe, packet: &Packet, limit: f32) -> (Distances, u32) {
        let mut sums = [0.0; PACKET];
        let mut heights = [0.0; PACKET];
        for axis in 0..3 {
            for lane in 0..PACKET {
                let offset = packet.0[axis][lane] - probe.center[axis];
                sums[lane] += offset * offset;
                heights[lane] += offset * probe.normal[axis];
            }
        }
        if probe.is_disc {
            for lane in 0..PACKET {
                sums[lane] = sums[lane].max(heights[lane] * heights[lane]);
            }
        }
        (Distances(sums), bits(&sums, |distance| distance < limit))
    }

    #[inline(always)]
    fn not_above(self, numbers: &[f32; PACKET], limit: f32) -> u32 {
        bits(numbers, |number| number <= limit)
    }

    #[inline(always)]
    fn compress<N: Number>(self, numbers: &[N; PACKET], mask: u32, result: &mut [N; PACKET]) {
        let mut end = 0;
        for (lane, &number) in numbers.iter().enumerate() {
            // `end` never exceeds the lane; the minimum tells the compiler so.
            result[end.min(PACKET - 1)] = number;
            end += (mask >> lane & 1) as usize;
        }
    }
}

/// Begins to load values into the cache.
#[inline(always)]
pub(super) fn prefetch<T>(values: &[T]) {
    #[cfg(target_arch = "x86_64")]
    for line in 0..size_of_val(values).div_ceil(64) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch changes nothing but the cache, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(values.as_ptr().cast::<i8>().wrapping_add(64 * line)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = values;
}

#[inline(always)]
fn bits<const N: usize>(numbers: &[f32; N], test: impl Fn(f32) -> bool) -> u32 {
    (0..N).fold(0, |bits, lane| bits | u32::from(test(numbers[lane])) << lane)
}
