//! The surface of a mesh about a point of a face: position, normals, texture coordinates, tangents.

use super::{Mesh, Shading};
use crate::edges;
use crate::hit::{Candidate, SurfaceHit, Tangents};
use hyaline_math::{DVec3, Transform, Vec2, Vec3};

/// A point of a face and how far rounding may have moved it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshPoint {
    pub(crate) p: Vec3,
    /// Bound on the distance from the face's plane.
    pub(crate) p_error: f32,
    /// Unit normal of the face.
    pub(crate) ng: Vec3,
}

impl Mesh {
    /// The surface at a crossing; `transform` places the mesh in the world.
    ///
    /// # Panics
    /// Where the mesh has no such face.
    pub(crate) fn surface(&self, hit: &Candidate, transform: Option<&Transform>) -> SurfaceHit {
        let point = self.point(hit.primitive, hit.barycentric, transform);
        SurfaceHit {
            t: hit.t,
            p: point.p,
            p_error: point.p_error,
            ng: point.ng,
            n: self.shading_normal(hit.primitive, hit.barycentric, transform, point.ng),
            uv: self.coordinates(hit.primitive, hit.barycentric),
            item: hit.item,
            primitive: hit.primitive,
        }
    }

    /// The world point of a face at barycentric coordinates.
    ///
    /// It is interpolated in `f64` and rounded once, so the error is half a unit in the last place of each
    /// coordinate as seen along the normal, plus the little that `f64` loses on the way.
    pub(crate) fn point(&self, face: u32, barycentric: Vec2, transform: Option<&Transform>) -> MeshPoint {
        let [a, b, c] = self.corners(face).map(|p| p.as_dvec3());
        let (v, w) = (f64::from(barycentric.x), f64::from(barycentric.y));
        let local = a + (b - a) * v + (c - a) * w;
        let local_n = self.doubled_area(face);
        let reach = a.abs().max(b.abs()).max(c.abs()).max_element();
        let (p, n, slack) = match transform {
            None => (local, local_n, F64_SLACK * reach),
            Some(t) => (t.point(local), t.normal(local_n), transform_slack(t, local, reach)),
        };
        let n = n.normalize_or(DVec3::Y);
        let rounding = HALF_ULP * n.abs().dot(p.abs()) + slack;
        // Slightly up, so that the bound survives its own rounding; and never 0.
        let p_error = (rounding * 1.000_001) as f32 + f32::MIN_POSITIVE;
        MeshPoint { p: p.as_vec3(), p_error, ng: n.as_vec3().normalize_or(Vec3::Y) }
    }

    /// See [`crate::Aggregate::off_the_edges`].
    pub(crate) fn off_the_edges(
        &self,
        hit: SurfaceHit,
        barycentric: Vec2,
        transform: Option<&Transform>,
    ) -> SurfaceHit {
        let [a, b, c] = self.corners(hit.primitive);
        let place = |v: Vec3| transform.map_or(v, |t| t.vector(v.as_dvec3()).as_vec3());
        let (ab, ac) = (place(b - a), place(c - a));
        // No edge is nearer than by this share of the height over the longest.
        let share = barycentric.min_element().min(1.0 - barycentric.element_sum());
        let longest2 = ab.length_squared().max(ac.length_squared()).max((ac - ab).length_squared());
        if share * ab.cross(ac).length() > edges::margin(&hit) * longest2.sqrt() {
            return hit;
        }
        let place = |p: Vec3| transform.map_or(p.as_dvec3(), |t| t.point(p.as_dvec3()));
        edges::off_the_edges(hit, [a, b, c].map(place))
    }

    /// The normal to shade with: unit, on the side of `ng`.
    fn shading_normal(&self, face: u32, barycentric: Vec2, transform: Option<&Transform>, ng: Vec3) -> Vec3 {
        let Some(normals) = self.normals().filter(|_| self.shading() == Shading::Smooth) else {
            return ng;
        };
        let [a, b, c] = self.triangles()[face as usize].map(|i| normals[i as usize]);
        let local = a * (1.0 - barycentric.x - barycentric.y) + b * barycentric.x + c * barycentric.y;
        let world = transform.map_or(local, |t| t.normal(local.as_dvec3()).normalize_or_zero().as_vec3());
        match world.try_normalize() {
            Some(n) if n.dot(ng) > 0.0 => n,
            Some(n) if n.dot(ng) < 0.0 => -n,
            _ => ng,
        }
    }

    /// Texture coordinates; barycentric ones where the mesh has none.
    fn coordinates(&self, face: u32, barycentric: Vec2) -> Vec2 {
        let Some(uvs) = self.uvs() else {
            return barycentric;
        };
        let [a, b, c] = self.triangles()[face as usize].map(|i| uvs[i as usize]);
        a + (b - a) * barycentric.x + (c - a) * barycentric.y
    }

    /// Derivatives of the points of a face by their texture coordinates, the same all over it.
    ///
    /// # Panics
    /// Where the mesh has no such face.
    pub(crate) fn tangents(&self, face: u32, transform: Option<&Transform>) -> Tangents {
        let [a, b, c] = self.corners(face).map(|p| p.as_dvec3());
        let (mut dpdu, mut dpdv) = (b - a, c - a);
        if let Some(uvs) = self.uvs() {
            let [uv_a, uv_b, uv_c] = self.triangles()[face as usize].map(|i| uvs[i as usize]);
            let (d_b, d_c) = ((uv_b - uv_a).as_dvec2(), (uv_c - uv_a).as_dvec2());
            // [Pharr, Jakob, Humphreys 2023, eq. 6.7]: solve the two edges for dp/du and dp/dv.
            let determinant = d_b.perp_dot(d_c);
            (dpdu, dpdv) =
                ((dpdu * d_c.y - dpdv * d_b.y) / determinant, (dpdv * d_b.x - dpdu * d_c.x) / determinant);
        }
        let place = |v: DVec3| transform.map_or(v, |t| t.vector(v)).as_vec3();
        let n = self.doubled_area(face);
        let ng = transform.map_or(n, |t| t.normal(n)).normalize_or(DVec3::Y).as_vec3();
        Tangents::new(place(dpdu), place(dpdv), ng)
    }
}

/// Unit roundoff of `f32`: a coordinate rounded to `f32` is off by at most this, relatively.
const HALF_ULP: f64 = f32::EPSILON as f64 / 2.0;

/// Relative slack for the `f64` arithmetic of a triangle: a few dozen roundings of values up to its coordinates.
const F64_SLACK: f64 = 64.0 * f64::EPSILON;

/// Slack in the world for a point that goes through a transform and, with the next ray, back again: each way the
/// error of `f64` is stretched by no more than the condition of the map.
fn transform_slack(transform: &Transform, local: DVec3, reach: f64) -> f64 {
    let row_sum = |t: &Transform| {
        let m = t.linear();
        (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()).max_element()
    };
    let (norm, inverse_norm) = (row_sum(transform), row_sum(&transform.inverse()));
    let world_reach =
        norm * local.abs().max_element().max(reach) + transform.translation().abs().max_element();
    F64_SLACK * world_reach * (norm * inverse_norm).max(1.0)
}
