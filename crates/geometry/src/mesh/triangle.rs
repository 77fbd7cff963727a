//! Where a ray crosses a triangle, decided without any tolerance.
//!
//! 1. Vertices are moved into a frame whose origin is the ray's and whose z axis is the ray, by a shear that depends
//!    on the ray and on the vertex alone, so faces that share a vertex see the same point.
//! 2. The ray crosses where the origin lies on the same side of the three edges in the plane. The side is the sign of
//!    the difference of two products. Rounding is monotone, so it can hide the sign only by making the products
//!    equal; then the rounding errors, which are exact, decide.
//! 3. Where a ray meets an edge or vertex exactly, it is moved aside by an infinitesimal step, the same for all
//!    faces. So it crosses exactly one of the two faces of a closed mesh that meet there, or none or both where they
//!    form a silhouette: crossings of closed meshes always pair up.
//! 4. The distance is interpolated in `f64`, so a ray that starts on the far side of a face by half a unit in the last
//!    place of `f32` is known to be there.
//!
//! Source: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013, here in `f64`; the step aside:
//! Edelsbrunner and Mücke, Simulation of Simplicity, ACM TOG 9(1), 1990.

use hyaline_math::{DVec3, Ray, Transform, Vec2, Vec3A};

/// The axes in order, each of them last once.
const TURNS: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// A ray in the space of a mesh; distances along it are those of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalRay {
    /// Rounded.
    pub(crate) origin: Vec3A,
    /// Rounded; of any length: a mesh may be placed with a scale.
    pub(crate) direction: Vec3A,
    pub(crate) t_min: f32,
    pub(crate) t_max: f32,
    /// The axes, the one of the largest component of the direction last.
    pub(crate) axes: [usize; 3],
    /// The origin, its coordinates in the order of `axes`.
    pub(crate) turned_origin: [f64; 3],
    /// Direction along the first two axes for a unit step along the third.
    pub(crate) shear: [f64; 2],
    pub(crate) inverse_z: f64,
}

/// A crossing of a ray and a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TriangleHit {
    pub(crate) t: f32,
    /// Weights of the second and third vertex.
    pub(crate) barycentric: Vec2,
}

impl LocalRay {
    /// The ray itself, for meshes in world space.
    pub(crate) fn from_world(ray: &Ray) -> Self {
        Self::new(ray.origin.as_dvec3(), ray.direction.as_dvec3(), ray)
    }

    /// The ray as seen from a mesh that `transform` places in the world.
    pub(crate) fn from_placed(ray: &Ray, transform: &Transform) -> Self {
        let origin = transform.inverse_point(ray.origin.as_dvec3());
        Self::new(origin, transform.inverse_vector(ray.direction.as_dvec3()), ray)
    }

    #[inline(always)]
    fn new(origin: DVec3, direction: DVec3, ray: &Ray) -> Self {
        let size = direction.abs();
        // Without a branch: which axis it is can't be foreseen.
        let is_x = (size.x > size.y) & (size.x > size.z);
        let is_y = (size.y >= size.x) & (size.y > size.z);
        let axes = TURNS[2 - 2 * usize::from(is_x) - usize::from(is_y)];
        let turned = |v: DVec3| {
            let v = [v.x, v.y, v.z, 0.0];
            [v[axes[0] & 3], v[axes[1] & 3], v[axes[2] & 3]]
        };
        let [x, y, z] = turned(direction);
        Self {
            origin: origin.as_vec3a(),
            direction: direction.as_vec3a(),
            t_min: ray.t_min,
            t_max: ray.t_max,
            axes,
            turned_origin: turned(origin),
            shear: [x / z, y / z],
            inverse_z: 1.0 / z,
        }
    }

    /// A vertex in the frame of the ray; z is not yet scaled.
    #[inline(always)]
    fn place(&self, vertex: [f32; 3]) -> [f64; 3] {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|i| f64::from(vertex[i]) - self.turned_origin[i]);
        [x - self.shear[0] * z, y - self.shear[1] * z, z]
    }

    /// The crossing with a triangle, if it lies strictly between `t_min` and `t_max`.
    ///
    /// - `corners`: their coordinates in the order of `axes`.
    #[inline(always)]
    pub(crate) fn turned_triangle(&self, corners: [[f32; 3]; 3]) -> Option<TriangleHit> {
        let [a, b, c] = [self.place(corners[0]), self.place(corners[1]), self.place(corners[2])];
        let u = Edge::between(c, b);
        let v = Edge::between(a, c);
        let w = Edge::between(b, a);
        if u.side == 0 || u.side != v.side || v.side != w.side {
            return None;
        }
        let sum = u.value + v.value + w.value;
        // A projection so thin that all products round to equality: any point of it will do.
        let [u, v, w, sum] = if sum == 0.0 { [1.0, 1.0, 1.0, 3.0] } else { [u.value, v.value, w.value, sum] };
        let inverse_sum = 1.0 / sum;
        let t = (u * a[2] + v * b[2] + w * c[2]) * (inverse_sum * self.inverse_z);
        let within = t > f64::from(self.t_min) && t < f64::from(self.t_max);
        within.then(|| {
            let [v, w] = [v, w].map(|weight| (weight * inverse_sum) as f32);
            TriangleHit { t: self.round_inside(t), barycentric: Vec2::new(v, w) }
        })
    }

    /// The same for corners as they are.
    #[cfg(test)]
    pub(crate) fn triangle(&self, corners: [hyaline_math::Vec3; 3]) -> Option<TriangleHit> {
        self.turned_triangle(corners.map(|corner| self.axes.map(|axis| corner[axis])))
    }

    /// `t` rounded to `f32`, but not onto the ends of the interval.
    #[inline(always)]
    fn round_inside(&self, t: f64) -> f32 {
        let t = t as f32;
        if t <= self.t_min {
            self.t_min.next_up()
        } else if t >= self.t_max {
            self.t_max.next_down()
        } else {
            t
        }
    }
}

/// On which side of an edge the ray passes.
struct Edge {
    /// Twice the area spanned by the edge and the ray; its sign is right or it is 0.
    value: f64,
    /// Sign of the exact value, moved aside where it is 0; 0 only for an edge without extent.
    side: i8,
}

impl Edge {
    /// The edge from `p` to `q`: sign and size of `p.x q.y - p.y q.x`.
    #[inline(always)]
    fn between(p: [f64; 3], q: [f64; 3]) -> Self {
        let (left, right) = (p[0] * q[1], p[1] * q[0]);
        let value = left - right;
        let side = if left > right {
            1
        } else if left < right {
            -1
        } else {
            exact_side(p, q, left, right)
        };
        Self { value, side }
    }
}

/// The side where both products round to the same number.
#[cold]
fn exact_side(p: [f64; 3], q: [f64; 3], left: f64, right: f64) -> i8 {
    let left_error = p[0].mul_add(q[1], -left);
    let right_error = p[1].mul_add(q[0], -right);
    // A step of the origin by (e, e²) changes the value by e (p.y - q.y) + e² (q.x - p.x).
    compare(left_error, right_error).or(compare(p[1], q[1])).or(compare(q[0], p[0])).unwrap_or(0)
}

/// Sign of `a - b`, if they differ.
fn compare(a: f64, b: f64) -> Option<i8> {
    if a > b {
        Some(1)
    } else if a < b {
        Some(-1)
    } else {
        None
    }
}
