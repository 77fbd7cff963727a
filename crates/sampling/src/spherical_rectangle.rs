//! Uniform directions towards a rectangle, as seen from a point.

use hyaline_math::float::ONE_MINUS_EPSILON;
use hyaline_math::float::f64::{acos, cos, sin};
use hyaline_math::{DVec3, Vec2, Vec3};
use std::f64::consts::TAU;

/// A rectangle projected onto the unit sphere about a point.
///
/// Source: Ureña, Fajardo & King, An area-preserving parametrization for spherical rectangles, EGSR 2013.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalRectangle {
    origin: DVec3,
    /// Axes of the local frame: along both edges, and away from the rectangle.
    axes: [DVec3; 3],
    /// Corners of the rectangle in the frame, both at depth `z0` < 0.
    x: [f64; 2],
    y: [f64; 2],
    z0: f64,
    /// z components of the normals of the planes through the origin and the edges at y0 and y1.
    b0: f64,
    b1: f64,
    /// 2π less the angles at the two corners at y1.
    k: f64,
    solid_angle: f64,
}

impl SphericalRectangle {
    /// The rectangle from `corner` along the perpendicular edges `edge_x` and `edge_y`, seen from `origin`.
    ///
    /// `None` where it is degenerate or so small or edge-on that its solid angle, below 1e-6 sr, is not worth the
    /// trouble: sample its area then.
    pub fn new(origin: Vec3, corner: Vec3, edge_x: Vec3, edge_y: Vec3) -> Option<Self> {
        let (edge_x, edge_y) = (edge_x.as_dvec3(), edge_y.as_dvec3());
        let (width, height) = (edge_x.length(), edge_y.length());
        let (ax, ay) = (edge_x / width, edge_y / height);
        let to_corner = corner.as_dvec3() - origin.as_dvec3();
        let plane = ax.cross(ay);
        let az = if to_corner.dot(plane) > 0.0 { -plane } else { plane };
        let (x0, y0, z0) = (to_corner.dot(ax), to_corner.dot(ay), to_corner.dot(az));
        let (x, y) = ([x0, x0 + width], [y0, y0 + height]);
        let origin = origin.as_dvec3();
        let mut this =
            Self { origin, axes: [ax, ay, az], x, y, z0, b0: 0.0, b1: 0.0, k: 0.0, solid_angle: 0.0 };
        this.measure();
        (this.solid_angle > 1e-6 && this.solid_angle.is_finite()).then_some(this)
    }

    /// Solid angle, sr; the density of `sample` is 1 over it.
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle as f32
    }

    /// The point of the rectangle that lies in a direction drawn uniformly from its solid angle.
    ///
    /// - `u`: [0, 1)².
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let [x0, x1] = self.x;
        let area = f64::from(u.x) * self.solid_angle + self.k;
        // [Ureña 2013: cu is the cosine that places the column of the point]
        let fu = (cos(area) * self.b0 - self.b1) / sin(area);
        let cu = (1.0_f64.copysign(fu) / (fu * fu + self.b0 * self.b0).sqrt()).clamp(-1.0, 1.0);
        let xu = (-(cu * self.z0) / (1.0 - cu * cu).sqrt().max(1e-150)).clamp(x0, x1);
        let p = self.origin
            + self.axes[0] * xu
            + self.axes[1] * self.row(xu, f64::from(u.y))
            + self.axes[2] * self.z0;
        p.as_vec3()
    }

    /// The point at fraction `v` of the heights of the spherical column at `xu`.
    fn row(&self, xu: f64, v: f64) -> f64 {
        let [y0, y1] = self.y;
        let d2 = xu * xu + self.z0 * self.z0;
        let (h0, h1) = (y0 / (d2 + y0 * y0).sqrt(), y1 / (d2 + y1 * y1).sqrt());
        let h = h0 + v.min(f64::from(ONE_MINUS_EPSILON)) * (h1 - h0);
        let h2 = h * h;
        let y = if h2 < 1.0 - 1e-12 { h * d2.sqrt() / (1.0 - h2).sqrt() } else { y1 };
        y.clamp(y0, y1)
    }

    /// Solid angle: the sum of the corner angles of the spherical quadrilateral, less 2π.
    fn measure(&mut self) {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z0);
        // Normals of the planes through the origin and each edge; components along the edge are 0.
        let n0 = -y0 / (z * z + y0 * y0).sqrt();
        let n1 = x1 / (z * z + x1 * x1).sqrt();
        let n2 = y1 / (z * z + y1 * y1).sqrt();
        let n3 = -x0 / (z * z + x0 * x0).sqrt();
        let (g0, g1, g2, g3) = (acos(-n0 * n1), acos(-n1 * n2), acos(-n2 * n3), acos(-n3 * n0));
        (self.b0, self.b1) = (n0, n2);
        self.k = TAU - g2 - g3;
        self.solid_angle = g0 + g1 - self.k;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use hyaline_testkit::{chi_square_square, integrate_rectangle};

    fn cases() -> [(Vec3, f32, f32); 5] {
        [
            (Vec3::new(-0.5, -0.5, 0.3), 1.0, 1.0),
            (Vec3::new(0.2, 1.0, 0.1), 2.0, 0.5),
            (Vec3::new(-1.0, 0.4, -2.0), 0.3, 0.7),
            (Vec3::new(-30.0, -10.0, 1.0), 60.0, 20.0),
            (Vec3::new(3.0, -2.0, -0.01), 1.0, 4.0),
        ]
    }

    /// cos θ / r², the solid angle per area of a point of the rectangle seen from 0.
    fn angle_per_area(corner: Vec3, x: f64, y: f64) -> f64 {
        let p = DVec3::new(f64::from(corner.x) + x, f64::from(corner.y) + y, f64::from(corner.z));
        p.z.abs() / p.length().powi(3)
    }

    #[test]
    fn solid_angle_is_the_integral_over_the_area() {
        for (corner, width, height) in cases() {
            let rectangle = SphericalRectangle::new(Vec3::ZERO, corner, Vec3::X * width, Vec3::Y * height);
            let expected = integrate_rectangle(
                |x, y| angle_per_area(corner, x, y),
                [0.0, f64::from(width)],
                [0.0, f64::from(height)],
                400,
                400,
            );
            let got = f64::from(rectangle.expect("large enough").solid_angle());
            assert!((got / expected - 1.0).abs() < 1e-5, "{got}, not {expected}");
        }
    }

    #[test]
    fn points_are_uniform_in_solid_angle() {
        for (corner, width, height) in cases() {
            let rectangle = SphericalRectangle::new(Vec3::ZERO, corner, Vec3::X * width, Vec3::Y * height)
                .expect("large enough");
            let mut rng = Rng::new(8, 0);
            let sample = || {
                let p = rectangle.sample(rng.uniform_2d()) - corner;
                assert!(p.z.abs() < 1e-5);
                [f64::from(p.x / width), f64::from(p.y / height)].map(|v| v.clamp(0.0, 1.0))
            };
            let area = f64::from(width) * f64::from(height);
            let pdf = |p: [f64; 2]| {
                let density = angle_per_area(corner, p[0] * f64::from(width), p[1] * f64::from(height));
                density * area / rectangle.solid_angle
            };
            let result = chi_square_square(sample, pdf, 100_000, 20, 20);
            assert!(result.p_value > 0.001, "{corner}: {result:?}");
        }
    }

    #[test]
    fn rectangles_seen_edge_on_or_from_afar_are_left_to_area_sampling() {
        let seen = |origin| SphericalRectangle::new(origin, Vec3::ZERO, Vec3::X, Vec3::Y);
        assert!(seen(Vec3::new(5.0, 5.0, 0.0)).is_none());
        assert!(seen(Vec3::new(0.0, 0.0, 1e5)).is_none());
        assert!(SphericalRectangle::new(Vec3::ONE, Vec3::ZERO, Vec3::ZERO, Vec3::Y).is_none());
        assert!(seen(Vec3::new(0.5, 0.5, 1.0)).is_some());
    }
}
