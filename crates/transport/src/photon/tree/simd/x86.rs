//! The x86-64 kinds. Loads are from references to arrays of the full width, so they are always in bounds.

use super::{Distances, Lanes, Number, Query};
use crate::photon::tree::layout::{FAN, Node, PACKET, Packet};
use crate::photon::tree::region::Probe;
use std::arch::x86_64::*;

/// Proof that the processor has AVX2, BMI and POPCNT.
#[derive(Clone, Copy)]
pub(super) struct Avx2(());

/// Runs a query compiled for AVX2 and the bit instructions that come with it.
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt")]
pub(super) fn run_avx2<Q: Query>(query: Q) -> Q::Output {
    query.run(Avx2(()))
}

impl Lanes for Avx2 {
    #[inline(always)]
    fn box_distances(self, probe: &Probe, node: &Node, limit: f32) -> ([f32; FAN], u32) {
        // SAFETY: `self` proves that the processor has AVX2; rows are 8 wide.
        unsafe {
            let mut sum = _mm256_setzero_ps();
            for axis in 0..3 {
                let center = _mm256_set1_ps(probe.center[axis]);
                let below = _mm256_sub_ps(_mm256_load_ps(node.min[axis].as_ptr()), center);
                let above = _mm256_sub_ps(center, _mm256_load_ps(node.max[axis].as_ptr()));
                let distance = _mm256_max_ps(_mm256_max_ps(below, above), _mm256_setzero_ps());
                sum = _mm256_add_ps(sum, _mm256_mul_ps(distance, distance));
            }
            let mut distances = [0.0; FAN];
            _mm256_storeu_ps(distances.as_mut_ptr(), sum);
            let is_below = _mm256_cmp_ps::<_CMP_LT_OQ>(sum, _mm256_set1_ps(limit));
            (distances, _mm256_movemask_ps(is_below) as u32)
        }
    }

    #[inline(always)]
    fn point_distances(self, probe: &Probe, packet: &Packet, limit: f32) -> (Distances, u32) {
        let mut distances = Distances([0.0; PACKET]);
        let mut mask = 0;
        for half in [0, 8] {
            // SAFETY: `self` proves that the processor has AVX2; rows are 16 wide.
            unsafe {
                let mut sum = _mm256_setzero_ps();
                let mut height = _mm256_setzero_ps();
                for axis in 0..3 {
                    let row = _mm256_load_ps(packet.0[axis].as_ptr().add(half));
                    let offset = _mm256_sub_ps(row, _mm256_set1_ps(probe.center[axis]));
                    sum = _mm256_add_ps(sum, _mm256_mul_ps(offset, offset));
                    if probe.is_disc {
                        let part = _mm256_mul_ps(offset, _mm256_set1_ps(probe.normal[axis]));
                        height = _mm256_add_ps(height, part);
                    }
                }
                if probe.is_disc {
                    sum = _mm256_max_ps(sum, _mm256_mul_ps(height, height));
                }
                _mm256_store_ps(distances.0.as_mut_ptr().add(half), sum);
                let is_below = _mm256_cmp_ps::<_CMP_LT_OQ>(sum, _mm256_set1_ps(limit));
                mask |= (_mm256_movemask_ps(is_below) as u32) << half;
            }
        }
        (distances, mask)
    }

    #[inline(always)]
    fn not_above(self, numbers: &[f32; PACKET], limit: f32) -> u32 {
        // SAFETY: `self` proves that the processor has AVX2; the array is 16 wide.
        unsafe {
            let limit = _mm256_set1_ps(limit);
            let low = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_loadu_ps(numbers.as_ptr()), limit);
            let high = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_loadu_ps(numbers.as_ptr().add(8)), limit);
            _mm256_movemask_ps(low) as u32 | (_mm256_movemask_ps(high) as u32) << 8
        }
    }

    #[inline(always)]
    fn compress<N: Number>(self, numbers: &[N; PACKET], mask: u32, result: &mut [N; PACKET]) {
        let (low_mask, high_mask) = (mask as usize & 255, mask as usize >> 8 & 255);
        let low_count = low_mask.count_ones() as usize;
        // SAFETY: `self` proves that the processor has AVX2; the arrays are 16 wide and the count is at most 8. The
        // second store covers what the first left without meaning.
        unsafe {
            let low = _mm256_loadu_si256(numbers.as_ptr().cast());
            let high = _mm256_loadu_si256(numbers.as_ptr().add(8).cast());
            let order = |mask: usize| _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(SET_LANES[mask] as i64));
            let low = _mm256_permutevar8x32_epi32(low, order(low_mask));
            let high = _mm256_permutevar8x32_epi32(high, order(high_mask));
            _mm256_storeu_si256(result.as_mut_ptr().cast(), low);
            _mm256_storeu_si256(result.as_mut_ptr().add(low_count).cast(), high);
        }
    }
}

/// For each mask of eight lanes the lanes that are set, in order, one in a byte from the lowest.
static SET_LANES: [u64; 256] = set_lanes();

const fn set_lanes() -> [u64; 256] {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut count) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask] |= (lane as u64) << (8 * count);
                count += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
}
