//! Points of flat faces, taken away from the edges.
//!
//! The start of a ray that leaves a face lies off it by what its point may be off. Where the next face meets this one at
//! an acute angle, a start right at the edge would lie behind that face, and light would get into a closed room.

use crate::SurfaceHit;
use hyaline_math::{DVec3, ray::offset_distance};

/// How far a point keeps from the edges, in units of what the start of a ray is moved by: two of those above its face,
/// which is as high as a start can be, it is still between faces that meet at 27 degrees or more.
const MARGIN: f32 = 4.0;

/// Rounds through the edges: at a corner, to get away from one edge is to near the other.
const ROUNDS: usize = 3;

/// What a point keeps from the edges of its face, scene units.
pub(crate) fn margin(hit: &SurfaceHit) -> f32 {
    MARGIN * offset_distance(hit.p, hit.p_error)
}

/// The hit, moved along its face where an edge is within the margin; in a face smaller than that, towards its middle.
///
/// - `corners`: of a convex flat face, in order, either way about.
#[cold]
pub(crate) fn off_the_edges<const N: usize>(hit: SurfaceHit, corners: [DVec3; N]) -> SurfaceHit {
    let mut p = hit.p.as_dvec3();
    let edges: [(DVec3, DVec3); N] = std::array::from_fn(|i| (corners[i], corners[(i + 1) % N] - corners[i]));
    let perimeter: f64 = edges.iter().map(|(_, edge)| edge.length()).sum();
    let doubled_area: DVec3 = edges.iter().map(|&(corner, edge)| (corner - corners[0]).cross(edge)).sum();
    // Half the radius of a triangle's incircle.
    let margin = f64::from(margin(&hit)).min(0.5 * doubled_area.length() / perimeter);
    for (corner, edge) in edges.iter().cycle().take(ROUNDS * N) {
        let inward = doubled_area.cross(*edge).normalize_or_zero();
        p += inward * (margin - inward.dot(p - *corner)).max(0.0);
    }
    // Rounded once more.
    SurfaceHit { p: p.as_vec3(), p_error: 2.0 * hit.p_error, ..hit }
}
