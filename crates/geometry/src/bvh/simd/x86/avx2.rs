//! Eight numbers at a time, with fused steps. Loads are from references to arrays of the full width, so they are always
//! in bounds.

use super::{Boxes, ROW};
use crate::bvh::node::{Block, Node};
use crate::bvh::ray::{BoxRay, FilterRay};
use crate::bvh::simd::{Lanes, Nears, Query};
use std::arch::x86_64::*;

/// Proof that the processor has AVX2 and FMA.
#[derive(Clone, Copy)]
pub(in crate::bvh::simd) struct Avx2(());

/// Runs a query compiled for AVX2 and FMA.
#[target_feature(enable = "avx2,fma")]
pub(in crate::bvh::simd) fn run_avx2<Q: Query>(query: Q) -> Q::Output {
    query.run(Avx2(()))
}

impl Lanes for Avx2 {
    type Boxes = Boxes<__m256>;
    type Triangles = Triangles;

    #[inline(always)]
    fn prepare_boxes(self, ray: &BoxRay) -> Self::Boxes {
        // Written out, since a closure of vectors would not be inlined.
        // SAFETY: `self` proves that the processor has AVX2.
        unsafe {
            Boxes {
                inverse: [
                    _mm256_set1_ps(ray.inverse.x),
                    _mm256_set1_ps(ray.inverse.y),
                    _mm256_set1_ps(ray.inverse.z),
                ],
                near: [_mm256_set1_ps(ray.near.x), _mm256_set1_ps(ray.near.y), _mm256_set1_ps(ray.near.z)],
                far: [_mm256_set1_ps(ray.far.x), _mm256_set1_ps(ray.far.y), _mm256_set1_ps(ray.far.z)],
                t_min: _mm256_set1_ps(ray.t_min),
                starts: ray.near_rows.map(|row| row % 6 * ROW),
            }
        }
    }

    #[inline(always)]
    fn hit_boxes(self, ray: &Self::Boxes, node: &Node, limit: f32) -> (Nears, u32) {
        let planes = node.planes.as_ptr().cast::<f32>();
        // SAFETY: `self` proves that the processor has AVX2 and FMA; planes start at multiples of `ROW` below 6 `ROW`.
        unsafe {
            let plane = |start: usize| _mm256_load_ps(planes.add(start));
            let [x, y, z] = ray.starts;
            let near_x = _mm256_fmsub_ps(plane(x), ray.inverse[0], ray.near[0]);
            let near_y = _mm256_fmsub_ps(plane(y), ray.inverse[1], ray.near[1]);
            let near_z = _mm256_fmsub_ps(plane(z), ray.inverse[2], ray.near[2]);
            let far_x = _mm256_fmsub_ps(plane(x ^ ROW), ray.inverse[0], ray.far[0]);
            let far_y = _mm256_fmsub_ps(plane(y ^ ROW), ray.inverse[1], ray.far[1]);
            let far_z = _mm256_fmsub_ps(plane(z ^ ROW), ray.inverse[2], ray.far[2]);
            let begin = larger(larger(near_x, near_y), larger(near_z, ray.t_min));
            let end = smaller(smaller(far_x, far_y), smaller(far_z, _mm256_set1_ps(limit)));
            // Distances are padded by more than their rounding: no box that matters begins where it ends.
            let hits = _mm256_movemask_ps(is_greater(end, begin));
            let mut nears = Nears([0.0; 8]);
            _mm256_store_ps(nears.0.as_mut_ptr(), begin);
            (nears, hits as u32)
        }
    }

    #[inline(always)]
    fn prepare_triangles(self, ray: &FilterRay) -> Triangles {
        // SAFETY: `self` proves that the processor has AVX2 and FMA.
        unsafe { prepare(ray) }
    }

    #[inline(always)]
    fn filter(self, ray: &Triangles, block: &Block, limit: f32) -> u32 {
        // SAFETY: `self` proves that the processor has AVX2 and FMA.
        unsafe { filter(ray, block, limit) }
    }
}

/// The larger of two numbers by their bits as integers, which takes a cycle instead of four. Of two negative ones it is
/// the smaller; so one number of a chain must not be negative, or the result must be of no use where none is.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn larger(a: __m256, b: __m256) -> __m256 {
    _mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)))
}

/// The smaller of two numbers likewise; of two negative ones the larger, which is negative all the same.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn smaller(a: __m256, b: __m256) -> __m256 {
    _mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)))
}

/// Whether a number is greater than one that is not negative, likewise.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn is_greater(a: __m256, b: __m256) -> __m256 {
    _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)))
}

#[inline]
#[target_feature(enable = "avx2,fma")]
fn negated(a: __m256) -> __m256 {
    _mm256_xor_ps(a, _mm256_set1_ps(-0.0))
}

/// A ray for eight triangles at a time.
pub(in crate::bvh::simd) struct Triangles {
    axes: [usize; 3],
    origin: [__m256; 3],
    shear: [__m256; 2],
    inverse_z: __m256,
    vertex_error: __m256,
    edge_factor: __m256,
    t_error: f32,
    t_min: __m256,
}

#[inline]
#[target_feature(enable = "avx2,fma")]
fn prepare(ray: &FilterRay) -> Triangles {
    Triangles {
        axes: ray.axes,
        origin: [_mm256_set1_ps(ray.origin[0]), _mm256_set1_ps(ray.origin[1]), _mm256_set1_ps(ray.origin[2])],
        shear: [_mm256_set1_ps(ray.shear[0]), _mm256_set1_ps(ray.shear[1])],
        inverse_z: _mm256_set1_ps(ray.inverse_z),
        vertex_error: _mm256_set1_ps(ray.vertex_error),
        edge_factor: _mm256_set1_ps(6.0 * ray.vertex_error),
        t_error: ray.t_error,
        t_min: _mm256_set1_ps(ray.t_min),
    }
}

#[inline]
#[target_feature(enable = "avx2,fma")]
fn filter(ray: &Triangles, block: &Block, limit: f32) -> u32 {
    let [va, vb, vc] = &block.vertices;
    let (a, b, c) = (place(ray, va), place(ray, vb), place(ray, vc));
    let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
    let size = larger(larger(extent(a), extent(b)), extent(c));
    let error = _mm256_mul_ps(ray.edge_factor, _mm256_add_ps(size, ray.vertex_error));
    // Beside the triangle where one edge value is surely negative and another surely positive.
    let is_positive =
        _mm256_or_ps(_mm256_or_ps(is_greater(u, error), is_greater(v, error)), is_greater(w, error));
    let is_negative = _mm256_or_ps(
        _mm256_or_ps(is_greater(negated(u), error), is_greater(negated(v), error)),
        is_greater(negated(w), error),
    );
    let is_beside = _mm256_and_ps(is_negative, is_positive);
    let near = _mm256_mul_ps(ray.inverse_z, a[2]);
    let (tb, tc) = (_mm256_mul_ps(ray.inverse_z, b[2]), _mm256_mul_ps(ray.inverse_z, c[2]));
    let far = _mm256_max_ps(_mm256_max_ps(near, tb), tc);
    let near = _mm256_min_ps(_mm256_min_ps(near, tb), tc);
    let is_beyond = _mm256_cmp_ps::<_CMP_GT_OQ>(near, _mm256_set1_ps(limit + ray.t_error));
    let is_before = _mm256_cmp_ps::<_CMP_LT_OQ>(far, ray.t_min);
    // SAFETY: faces are 8 wide and follow aligned arrays.
    let is_absent = unsafe { _mm256_castsi256_ps(_mm256_load_si256(block.faces.as_ptr().cast())) };
    let out = _mm256_or_ps(_mm256_or_ps(is_beside, is_beyond), _mm256_or_ps(is_before, is_absent));
    !(_mm256_movemask_ps(out) as u32) & 0xff
}

/// A vertex of each triangle in the frame of the ray.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn place(ray: &Triangles, vertex: &[[f32; 8]; 3]) -> [__m256; 3] {
    // SAFETY: the arrays are 8 wide and aligned with their block.
    unsafe {
        let x = _mm256_sub_ps(_mm256_load_ps(vertex[ray.axes[0]].as_ptr()), ray.origin[0]);
        let y = _mm256_sub_ps(_mm256_load_ps(vertex[ray.axes[1]].as_ptr()), ray.origin[1]);
        let z = _mm256_sub_ps(_mm256_load_ps(vertex[ray.axes[2]].as_ptr()), ray.origin[2]);
        [_mm256_fnmadd_ps(ray.shear[0], z, x), _mm256_fnmadd_ps(ray.shear[1], z, y), z]
    }
}

/// Twice the area between the ray and the edge from `p` to `q` of each triangle.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn edge(p: [__m256; 3], q: [__m256; 3]) -> __m256 {
    _mm256_fmsub_ps(p[0], q[1], _mm256_mul_ps(p[1], q[0]))
}

/// The larger coordinate across the ray.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn extent(p: [__m256; 3]) -> __m256 {
    let sign = _mm256_set1_ps(-0.0);
    larger(_mm256_andnot_ps(sign, p[0]), _mm256_andnot_ps(sign, p[1]))
}
