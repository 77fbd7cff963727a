//! Four numbers at a time. Loads are from references to arrays of the full width, so they are always in bounds.

use super::{Boxes, ROW};
use crate::bvh::node::{Block, Node};
use crate::bvh::ray::{BoxRay, FilterRay};
use crate::bvh::simd::{Lanes, Nears};
use std::arch::x86_64::*;

/// SSE2 is part of x86-64.
#[derive(Clone, Copy)]
pub(in crate::bvh::simd) struct Sse2;

/// A ray for triangles: one register for each number.
pub(in crate::bvh::simd) struct Triangles {
    axes: [usize; 3],
    origin: [__m128; 3],
    shear: [__m128; 2],
    inverse_z: __m128,
    vertex_error: __m128,
    edge_factor: __m128,
    t_error: f32,
    t_min: __m128,
}

impl Lanes for Sse2 {
    type Boxes = Boxes<__m128>;
    type Triangles = Triangles;

    #[inline(always)]
    fn prepare_boxes(self, ray: &BoxRay) -> Self::Boxes {
        Boxes {
            inverse: splat3(ray.inverse.to_array()),
            near: splat3(ray.near.to_array()),
            far: splat3(ray.far.to_array()),
            t_min: splat(ray.t_min),
            starts: ray.near_rows.map(|row| row % 6 * ROW),
        }
    }

    #[inline(always)]
    fn hit_boxes(self, ray: &Self::Boxes, node: &Node, limit: f32) -> (Nears, u32) {
        let mut nears = Nears([0.0; 8]);
        let mut hits = 0;
        let planes = node.planes.as_ptr().cast::<f32>();
        for half in [0, 4] {
            // SAFETY: SSE2 is part of x86-64; planes start at multiples of `ROW` below 6 `ROW`.
            unsafe {
                let mut begin = ray.t_min;
                let mut end = splat(limit);
                for axis in 0..3 {
                    let near = _mm_load_ps(planes.add(ray.starts[axis] + half));
                    let far = _mm_load_ps(planes.add((ray.starts[axis] ^ ROW) + half));
                    let (near, far) =
                        (_mm_mul_ps(near, ray.inverse[axis]), _mm_mul_ps(far, ray.inverse[axis]));
                    begin = _mm_max_ps(_mm_sub_ps(near, ray.near[axis]), begin);
                    end = _mm_min_ps(_mm_sub_ps(far, ray.far[axis]), end);
                }
                hits |= (_mm_movemask_ps(_mm_cmple_ps(begin, end)) as u32) << half;
                _mm_store_ps(nears.0.as_mut_ptr().add(half), begin);
            }
        }
        (nears, hits)
    }

    #[inline(always)]
    fn prepare_triangles(self, ray: &FilterRay) -> Triangles {
        Triangles {
            axes: ray.axes,
            origin: splat3(ray.origin),
            shear: [splat(ray.shear[0]), splat(ray.shear[1])],
            inverse_z: splat(ray.inverse_z),
            vertex_error: splat(ray.vertex_error),
            edge_factor: splat(6.0 * ray.vertex_error),
            t_error: ray.t_error,
            t_min: splat(ray.t_min),
        }
    }

    #[inline(always)]
    fn filter(self, ray: &Triangles, block: &Block, limit: f32) -> u32 {
        filter_half(ray, block, limit, 0) | filter_half(ray, block, limit, 4) << 4
    }
}

/// The filter for four triangles from `first` on.
#[inline(always)]
fn filter_half(ray: &Triangles, block: &Block, limit: f32, first: usize) -> u32 {
    // SAFETY: SSE2 is part of x86-64; the arrays are 8 wide, and `first` is 0 or 4.
    unsafe {
        let [va, vb, vc] = &block.vertices;
        let (a, b, c) = (place(ray, va, first), place(ray, vb, first), place(ray, vc, first));
        let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
        let size = _mm_max_ps(_mm_max_ps(extent(a), extent(b)), extent(c));
        let error = _mm_mul_ps(ray.edge_factor, _mm_add_ps(size, ray.vertex_error));
        let least = _mm_min_ps(_mm_min_ps(u, v), w);
        let most = _mm_max_ps(_mm_max_ps(u, v), w);
        // Beside the triangle where one edge value is surely negative and another surely positive.
        let is_negative = _mm_cmplt_ps(_mm_add_ps(least, error), _mm_setzero_ps());
        let is_beside = _mm_and_ps(is_negative, _mm_cmpgt_ps(most, error));
        let ta = _mm_mul_ps(a[2], ray.inverse_z);
        let tb = _mm_mul_ps(b[2], ray.inverse_z);
        let tc = _mm_mul_ps(c[2], ray.inverse_z);
        let near = _mm_min_ps(_mm_min_ps(ta, tb), tc);
        let far = _mm_max_ps(_mm_max_ps(ta, tb), tc);
        let is_beyond = _mm_cmpgt_ps(near, splat(limit + ray.t_error));
        let is_before = _mm_cmplt_ps(far, ray.t_min);
        let is_absent = _mm_castsi128_ps(_mm_load_si128(block.faces.as_ptr().add(first).cast()));
        let out = _mm_or_ps(_mm_or_ps(is_beside, is_beyond), _mm_or_ps(is_before, is_absent));
        !(_mm_movemask_ps(out) as u32) & 0b1111
    }
}

#[inline(always)]
fn splat(x: f32) -> __m128 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_set1_ps(x) }
}

#[inline(always)]
fn splat3(x: [f32; 3]) -> [__m128; 3] {
    [splat(x[0]), splat(x[1]), splat(x[2])]
}

#[inline(always)]
fn abs(x: __m128) -> __m128 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_andnot_ps(_mm_set1_ps(-0.0), x) }
}

/// Twice the area between the ray and the edge from `p` to `q` of each triangle.
#[inline(always)]
fn edge(p: [__m128; 3], q: [__m128; 3]) -> __m128 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_sub_ps(_mm_mul_ps(p[0], q[1]), _mm_mul_ps(p[1], q[0])) }
}

/// The larger coordinate across the ray.
#[inline(always)]
fn extent(p: [__m128; 3]) -> __m128 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_max_ps(abs(p[0]), abs(p[1])) }
}

/// A vertex of each triangle in the frame of the ray.
#[inline(always)]
fn place(ray: &Triangles, vertex: &[[f32; 8]; 3], first: usize) -> [__m128; 3] {
    // SAFETY: SSE2 is part of x86-64; the arrays are 8 wide and aligned with their block, and `first` is 0 or 4.
    unsafe {
        let x = _mm_sub_ps(_mm_load_ps(vertex[ray.axes[0]].as_ptr().add(first)), ray.origin[0]);
        let y = _mm_sub_ps(_mm_load_ps(vertex[ray.axes[1]].as_ptr().add(first)), ray.origin[1]);
        let z = _mm_sub_ps(_mm_load_ps(vertex[ray.axes[2]].as_ptr().add(first)), ray.origin[2]);
        [_mm_sub_ps(x, _mm_mul_ps(ray.shear[0], z)), _mm_sub_ps(y, _mm_mul_ps(ray.shear[1], z)), z]
    }
}
