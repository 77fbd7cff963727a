//! A shape placed in the world: rays in `f32` outside, `f64` inside.

use crate::edges;
use crate::shape::{Crossings, Shape};
use crate::{SurfaceHit, Tangents};
use hyaline_math::{Bounds, DVec2, DVec3, Ray, Transform, Vec2, Vec3};

/// Bound on the rounding errors of one pass through a shape's equations and a transform, in units of `f64::EPSILON`
/// times the lengths involved.
const ROUNDING: f64 = 8.0;

/// A shape and its place in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Primitive {
    /// The surface in object space.
    pub shape: Shape,
    /// Object space to world; any invertible affine map.
    pub transform: Transform,
    /// Whether outside is the side that the shape's own normal points away from.
    pub flipped: bool,
}

/// A point sampled on a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaSample {
    /// Point on the surface, world.
    pub p: Vec3,
    /// Bound on the distance of `p` from the true surface, scene units.
    pub p_error: f32,
    /// Unit outward normal, world.
    pub n: Vec3,
    /// Density of the point, per unit of world area.
    pub pdf_a: f32,
}

impl Primitive {
    /// A shape whose object space is the world.
    pub fn new(shape: Shape) -> Self {
        Self { shape, transform: Transform::IDENTITY, flipped: false }
    }

    /// This primitive moved by a further transform.
    pub fn placed(&self, transform: &Transform) -> Self {
        Self { transform: transform.after(&self.transform), ..*self }
    }

    /// Distance to the nearest crossing with `t_min < t < t_max`.
    pub fn closest(&self, ray: &Ray) -> Option<f32> {
        let found = self.solve(ray);
        let mut distances = found.as_slice().iter().map(|&t| t as f32);
        // Rounding may put a crossing onto the interval's end.
        distances.find(|&t| ray.t_min < t && t < ray.t_max)
    }

    /// Calls `found` with every crossing in `t_min < t < t_max`, ascending.
    pub fn crossings(&self, ray: &Ray, found: &mut impl FnMut(f32)) {
        for t in self.solve(ray).as_slice().iter().map(|&t| t as f32) {
            if ray.t_min < t && t < ray.t_max {
                found(t);
            }
        }
    }

    fn solve(&self, ray: &Ray) -> Crossings {
        let (origin, direction) = self.object_line(ray);
        let mut found = Crossings::new();
        self.shape.crossings(origin, direction, ray.t_min.into(), ray.t_max.into(), &mut found);
        found
    }

    /// Origin and direction in object space; the distance along the ray stays the world's.
    fn object_line(&self, ray: &Ray) -> (DVec3, DVec3) {
        (
            self.transform.inverse_point(ray.origin.as_dvec3()),
            self.transform.inverse_vector(ray.direction.as_dvec3()),
        )
    }

    /// A box that holds the primitive, and every hit on it, rounding included.
    pub fn bounds(&self) -> Bounds {
        let linear = self.transform.linear().transpose();
        let shift = self.transform.translation();
        let high = DVec3::AXES.map(|axis| self.shape.support(linear * axis));
        let low = DVec3::AXES.map(|axis| -self.shape.support(linear * -axis));
        let (low, high) = (DVec3::from(low) + shift, DVec3::from(high) + shift);
        // Two units in the last place of `f32`, and the margin about the ends of part shapes.
        let stretch = self.world_magnitude(DVec3::splat(self.shape.extent())).max_element();
        let margin = low.abs().max(high.abs()) * (2.0 * f64::from(f32::EPSILON)) + 1e-8 * stretch;
        Bounds { min: (low - margin).as_vec3(), max: (high + margin).as_vec3() }
    }

    /// The surface at a hit.
    ///
    /// - `t`: a distance that `closest` or `crossings` gave for this ray.
    ///
    /// `item` and `primitive` are left 0.
    pub fn surface_at(&self, ray: &Ray, t: f32) -> SurfaceHit {
        let (origin, direction) = self.object_line(ray);
        let exact_t = self.refine(origin, direction, t);
        let point = self.shape.surface_at(origin + direction * exact_t);
        let ng = self.world_normal(point.n);
        let (p, p_error) = self.world_point(point.p);
        SurfaceHit { t, p, p_error, ng, n: ng, uv: point.uv.as_vec2(), item: 0, primitive: 0 }
    }

    /// See [`crate::Aggregate::off_the_edges`]; curved shapes and discs leave the hit where it is.
    pub(crate) fn off_the_edges(&self, hit: SurfaceHit) -> SurfaceHit {
        match &self.shape {
            Shape::Rectangle(rectangle) => {
                let shrinking = self.transform.inverse_norm();
                let nearest = rectangle.distance_to_edge(hit.uv);
                if nearest > f64::from(edges::margin(&hit)) * shrinking {
                    return hit;
                }
                edges::off_the_edges(hit, rectangle.corners().map(|p| self.transform.point(p)))
            }
            Shape::Sphere(_) | Shape::Segment(_) | Shape::Arc(_) => hit,
        }
    }

    /// Derivatives of the surface point `p` by its coordinates.
    pub fn tangents(&self, p: Vec3) -> Tangents {
        let point = self.shape.surface_at(self.transform.inverse_point(p.as_dvec3()));
        let [dpdu, dpdv] = [point.dpdu, point.dpdv].map(|v| self.transform.vector(v).as_vec3());
        Tangents::new(dpdu, dpdv, self.world_normal(point.n))
    }

    /// The crossing that was rounded to `t`, in full precision.
    fn refine(&self, origin: DVec3, direction: DVec3, t: f32) -> f64 {
        let t = f64::from(t);
        let window = t.abs() * (2.0 * f64::from(f32::EPSILON)) + f64::from(f32::MIN_POSITIVE);
        let mut found = Crossings::new();
        self.shape.crossings(origin, direction, t - window, t + window, &mut found);
        let nearer = |a: f64, b: f64| if (b - t).abs() < (a - t).abs() { b } else { a };
        found.as_slice().iter().copied().reduce(nearer).unwrap_or(t)
    }

    /// World area, square scene units; by quadrature to about 1e-6 where the map is not a similarity.
    pub fn area(&self) -> f64 {
        let linear = self.transform.linear();
        let gram = linear.transpose() * linear;
        let scale2 = gram.x_axis.x;
        let is_similarity = gram.abs_diff_eq(hyaline_math::DMat3::IDENTITY * scale2, 1e-12 * scale2);
        let mean_stretch = if is_similarity { scale2 } else { self.mean_stretch() };
        self.shape.area() * mean_stretch
    }

    /// World area per unit of object area where the object-space normal is `n`.
    fn stretch(&self, n: DVec3) -> f64 {
        self.transform.linear().determinant().abs() * self.transform.normal(n).length()
    }

    /// Mean of `stretch` over the object's surface.
    fn mean_stretch(&self) -> f64 {
        const PANELS: usize = 32;
        let nodes = gauss_nodes(PANELS);
        let column = |&(x, weight_x): &(f64, f64)| {
            let row = |&(y, weight_y): &(f64, f64)| {
                weight_y * self.stretch(self.shape.sample_area(DVec2::new(x, y)).1)
            };
            weight_x * nodes.iter().map(row).sum::<f64>()
        };
        nodes.iter().map(column).sum()
    }

    /// A point on the surface, uniform by object area.
    ///
    /// - `u`: uniform in [0, 1)².
    pub fn sample_area(&self, u: Vec2) -> AreaSample {
        let (p, n) = self.shape.sample_area(u.as_dvec2());
        let pdf_a = (1.0 / (self.shape.area() * self.stretch(n))) as f32;
        let n = self.world_normal(n);
        let (p, p_error) = self.world_point(p);
        AreaSample { p, p_error, n, pdf_a }
    }

    /// Unit outward normal of the world from that of the shape. A mirroring map needs no special care: the inverse
    /// transpose keeps a normal on its side.
    fn world_normal(&self, n: DVec3) -> Vec3 {
        let n = self.transform.normal(n).normalize();
        if self.flipped { -n.as_vec3() } else { n.as_vec3() }
    }

    /// A surface point in the world, rounded, and a bound on how far all rounding moved it off the surface.
    fn world_point(&self, p: DVec3) -> (Vec3, f32) {
        let rounded = self.transform.point(p).as_vec3();
        let magnitude = self.world_magnitude(p.abs() + self.shape.extent());
        let inner = (ROUNDING * f64::EPSILON * magnitude).length();
        let outer =
            0.5 * f64::from(f32::EPSILON) * rounded.as_dvec3().length() + f64::from(f32::MIN_POSITIVE);
        // The factor covers the rounding of the bound itself.
        (rounded, ((inner + outer) * 1.000_001) as f32)
    }

    /// How large the terms are that sum up to a world point whose object coordinates are at most `size`.
    fn world_magnitude(&self, size: DVec3) -> DVec3 {
        let linear = self.transform.linear();
        let turned =
            linear.x_axis.abs() * size.x + linear.y_axis.abs() * size.y + linear.z_axis.abs() * size.z;
        turned + self.transform.translation().abs()
    }
}

/// Nodes and weights of composite three-point Gauss quadrature over [0, 1], through the substitution s² (3 - 2 s)
/// that makes square roots at either end smooth.
fn gauss_nodes(panels: usize) -> Vec<(f64, f64)> {
    let offset = 0.5 * 0.6_f64.sqrt();
    let rule = [(0.5 - offset, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + offset, 5.0 / 18.0)];
    let width = 1.0 / panels as f64;
    let nodes =
        (0..panels).flat_map(|panel| rule.map(|(x, weight)| ((panel as f64 + x) * width, weight * width)));
    nodes.map(|(s, weight)| (s * s * (3.0 - 2.0 * s), weight * 6.0 * s * (1.0 - s))).collect()
}

#[cfg(test)]
mod tests;
