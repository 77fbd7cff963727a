//! Uniform directions towards a rectangle, as seen from a point.

use hyaline_math::float::ONE_MINUS_EPSILON;
use hyaline_math::float::f64::{atan2, sin_cos};
use hyaline_math::{DVec3, Vec2, Vec3};
use std::f64::consts::TAU;

/// Below this solid angle, sr, a rectangle is not worth the trouble.
const MIN_SOLID_ANGLE: f64 = 1e-6;

/// A rectangle and the frame along its edges; directions are drawn towards it from many points.
#[derive(Clone, Debug, PartialEq)]
pub struct RectangleFrame {
    corner: DVec3,
    /// Unit vectors along both edges, and across.
    axes: [DVec3; 3],
    /// Lengths of the edges.
    size: [f64; 2],
}

impl RectangleFrame {
    /// The rectangle from `corner` along two perpendicular edges.
    pub fn new(corner: Vec3, edge_x: Vec3, edge_y: Vec3) -> Self {
        let (edge_x, edge_y) = (edge_x.as_dvec3(), edge_y.as_dvec3());
        let size = [edge_x.length(), edge_y.length()];
        let (ax, ay) = (edge_x / size[0], edge_y / size[1]);
        Self { corner: corner.as_dvec3(), axes: [ax, ay, ax.cross(ay)], size }
    }

    /// The rectangle as seen from `origin`.
    ///
    /// `None` where it is degenerate or so small or edge-on that its solid angle, below 1e-6 sr, is not worth the
    /// trouble: sample its area then.
    pub fn seen_from(&self, origin: Vec3) -> Option<SphericalRectangle<'_>> {
        let to_corner = self.corner - origin.as_dvec3();
        let [x0, y0, z] = self.axes.map(|axis| to_corner.dot(axis));
        let (x, y) = ([x0, x0 + self.size[0]], [y0, y0 + self.size[1]]);
        let far_corners = corner(x[0], y[1], z.abs()).times(corner(-x[0], y[0], z.abs()));
        let near_corners = corner(x[1], y[0], z.abs()).times(corner(-x[1], y[1], z.abs()));
        let all = near_corners.times(far_corners);
        // The angles add up to Ω + 2π. Where a view is nothing, rounding may bring them to a little less.
        let angle = atan2(all.im, all.re);
        let solid_angle = if angle < -1e-9 { angle + TAU } else { angle };
        let is_worth_it = solid_angle > MIN_SOLID_ANGLE && solid_angle.is_finite();
        is_worth_it.then_some(SphericalRectangle { rectangle: self, x, y, z, far_corners, solid_angle })
    }
}

/// A complex number; only its argument matters here, an angle that takes no arc cosine to know.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Angle {
    re: f64,
    im: f64,
}

impl Angle {
    /// The sum of both angles.
    fn times(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

/// The angle of the spherical quadrilateral at the corner (x, y) at depth `h`, where the rectangle lies toward -x and +y;
/// at the others in turn with the signs of x changed: `acos(x y / (√(h² + x²) √(h² + y²)))`.
fn corner(x: f64, y: f64, h: f64) -> Angle {
    Angle { re: x * y, im: h * (x * x + y * y + h * h).sqrt() }
}

/// A rectangle projected onto the unit sphere about a point.
///
/// Source: Ureña, Fajardo & King, An area-preserving parametrization for spherical rectangles, EGSR 2013. Its angles are
/// carried as complex numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalRectangle<'a> {
    rectangle: &'a RectangleFrame,
    /// Edges in the frame of the rectangle about the point.
    x: [f64; 2],
    y: [f64; 2],
    /// Height of the rectangle over the point.
    z: f64,
    /// Sum of the angles at both corners at x0.
    far_corners: Angle,
    solid_angle: f64,
}

impl SphericalRectangle<'_> {
    /// Solid angle, sr; the density of `sample` is 1 over it.
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle as f32
    }

    /// The point of the rectangle that lies in a direction drawn uniformly from its solid angle.
    ///
    /// - `u`: [0, 1)².
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let RectangleFrame { corner, axes, .. } = self.rectangle;
        let x = self.column(f64::from(u.x));
        let y = self.row(x, f64::from(u.y));
        (*corner + axes[0] * (x - self.x[0]) + axes[1] * (y - self.y[0])).as_vec3()
    }

    /// The x that has the fraction `u` of the solid angle below it.
    fn column(&self, u: f64) -> f64 {
        let [x0, x1] = self.x;
        let h2 = self.z * self.z;
        let below2 = h2 + self.y[0] * self.y[0];
        let b0 = -self.y[0] / below2.sqrt();
        let b1 = self.y[1] / (h2 + self.y[1] * self.y[1]).sqrt();
        // [Ureña 2013, fig. 5], there with φ = u Ω - γ2 - γ3, f = (cos φ b0 - b1) / sin φ, the cosine that places the
        // column c = ±1 / √(f² + b0²), and x = c h / √(1 - c²); here with both terms of f times a length.
        let corners = self.far_corners;
        let length = (corners.re * corners.re + corners.im * corners.im).sqrt();
        let (im, re) = sin_cos(u * self.solid_angle);
        let phi = Angle { re, im }.times(Angle { im: -corners.im, ..corners });
        let f = phi.re * b0 - b1 * length;
        let rest = f * f - h2 / below2 * phi.im * phi.im;
        let x = 1.0_f64.copysign(f) * phi.im * self.z.abs() / rest.max(f64::MIN_POSITIVE).sqrt();
        x.clamp(x0, x1)
    }

    /// The y that has the fraction `v` of the height of the spherical column at `x` below it.
    fn row(&self, x: f64, v: f64) -> f64 {
        let [y0, y1] = self.y;
        let d2 = x * x + self.z * self.z;
        let (h0, h1) = (y0 / (d2 + y0 * y0).sqrt(), y1 / (d2 + y1 * y1).sqrt());
        let h = h0 + v.min(f64::from(ONE_MINUS_EPSILON)) * (h1 - h0);
        let h2 = h * h;
        let y = if h2 < 1.0 - 1e-12 { h * (d2 / (1.0 - h2)).sqrt() } else { y1 };
        y.clamp(y0, y1)
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
            let frame = RectangleFrame::new(corner, Vec3::X * width, Vec3::Y * height);
            let expected = integrate_rectangle(
                |x, y| angle_per_area(corner, x, y),
                [0.0, f64::from(width)],
                [0.0, f64::from(height)],
                400,
                400,
            );
            let got = f64::from(frame.seen_from(Vec3::ZERO).expect("large enough").solid_angle());
            assert!((got / expected - 1.0).abs() < 1e-5, "{got}, not {expected}");
        }
    }

    #[test]
    fn points_are_uniform_in_solid_angle() {
        for (corner, width, height) in cases() {
            let frame = RectangleFrame::new(corner, Vec3::X * width, Vec3::Y * height);
            let rectangle = frame.seen_from(Vec3::ZERO).expect("large enough");
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
        let square = RectangleFrame::new(Vec3::ZERO, Vec3::X, Vec3::Y);
        let seen = |origin| square.seen_from(origin);
        assert!(seen(Vec3::new(5.0, 5.0, 0.0)).is_none());
        assert!(seen(Vec3::new(0.0, 0.0, 1e5)).is_none());
        assert!(seen(Vec3::new(0.5, 0.5, 0.0)).is_none());
        assert!(RectangleFrame::new(Vec3::ZERO, Vec3::ZERO, Vec3::Y).seen_from(Vec3::ONE).is_none());
        assert!(seen(Vec3::new(0.5, 0.5, 1.0)).is_some());
    }
}
