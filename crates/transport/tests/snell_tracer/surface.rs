//! Whole surfaces and where a line meets them, by the first formula that comes to mind or by brute force.

use super::Ray;
use hyaline_math::{DVec2, DVec3};

/// A surface without ends.
#[derive(Clone, Debug)]
pub enum Surface {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Plane {
        point: DVec3,
        normal: DVec3,
    },
    /// The points at a distance of |radius + slope y| from the y axis: a cone, or a cylinder.
    Cone {
        radius: f64,
        slope: f64,
    },
    /// The circle about (distance from the axis, height) = `center`, turned about y.
    Torus {
        center: DVec2,
        radius: f64,
    },
    /// The points at distance `radius` from the box `min`…`max`.
    AboutBox {
        min: DVec3,
        max: DVec3,
        radius: f64,
    },
    /// Triangles, each with the normals at its corners.
    Triangles(Vec<Triangle>),
}

/// A triangle and the normals at its corners.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub corners: [DVec3; 3],
    pub normals: [DVec3; 3],
}

/// A place where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub t: f64,
    /// The normal that light obeys, on either side.
    pub normal: DVec3,
    /// The true one; another only on meshes with smooth normals.
    pub true_normal: DVec3,
}

impl Hit {
    fn new(t: f64, normal: DVec3) -> Self {
        Self { t, normal, true_normal: normal }
    }
}

impl Surface {
    /// Adds every place where the ray meets the surface, from a little before its start up to `end`.
    pub fn crossings(&self, ray: &Ray, end: f64, hits: &mut Vec<Hit>) {
        let at = |t: f64| ray.origin + ray.direction * t;
        match self {
            Self::Sphere { center, radius } => {
                let offset = ray.origin - *center;
                let (b, c) = (offset.dot(ray.direction), offset.length_squared() - radius * radius);
                hits.extend(quadratic(1.0, b, c).map(|t| Hit::new(t, (at(t) - *center).normalize())));
            }
            Self::Plane { point, normal } => {
                let t = (*point - ray.origin).dot(*normal) / ray.direction.dot(*normal);
                hits.extend(t.is_finite().then_some(Hit::new(t, *normal)));
            }
            Self::Cone { radius, slope } => {
                // x² + z² = (radius + slope y)², without any care for the mirrored half: no medium changes there.
                let (o, d) = (ray.origin, ray.direction);
                let (r, dr) = (radius + slope * o.y, slope * d.y);
                let a = d.x * d.x + d.z * d.z - dr * dr;
                let b = o.x * d.x + o.z * d.z - r * dr;
                let c = o.x * o.x + o.z * o.z - r * r;
                hits.extend(quadratic(a, b, c).map(|t| {
                    let p = at(t);
                    Hit::new(t, DVec3::new(p.x, -slope * (radius + slope * p.y), p.z).normalize())
                }));
            }
            Self::Torus { center, radius } => {
                let f = |t: f64| {
                    let p = at(t);
                    let from_ring = DVec2::new(DVec2::new(p.x, p.z).length(), p.y) - *center;
                    from_ring.length_squared() - radius * radius
                };
                if let Some((low, high)) = within(ray, DVec3::Y * center.y, center.x + radius, *radius) {
                    hits.extend(roots(f, low.max(-0.1 * radius), high.min(end)).into_iter().map(|t| {
                        let p = at(t);
                        let axis_distance = DVec2::new(p.x, p.z).length();
                        let n = DVec2::new(axis_distance, p.y) - *center;
                        let n = DVec3::new(p.x / axis_distance * n.x, n.y, p.z / axis_distance * n.x);
                        Hit::new(t, n.normalize())
                    }));
                }
            }
            Self::AboutBox { min, max, radius } => {
                let from_box = |p: DVec3| p - p.clamp(*min, *max);
                let f = |t: f64| from_box(at(t)).length() - radius;
                let middle = 0.5 * (*min + *max);
                let reach = (*max - middle).length() + radius;
                if let Some((low, high)) = within(ray, middle, reach, reach) {
                    let found = roots(f, low.max(-0.1 * reach), high.min(end));
                    hits.extend(found.into_iter().map(|t| Hit::new(t, from_box(at(t)).normalize())));
                }
            }
            Self::Triangles(triangles) => hits.extend(triangles.iter().filter_map(|one| one.crossing(ray))),
        }
    }

    /// The six planes of a box.
    pub fn planes_of_box(min: DVec3, max: DVec3) -> Vec<Self> {
        DVec3::AXES
            .iter()
            .flat_map(|&normal| [Self::Plane { point: min, normal }, Self::Plane { point: max, normal }])
            .collect()
    }
}

impl Triangle {
    /// By Cramer's rule for origin + t direction = a + u (b - a) + v (c - a).
    fn crossing(&self, ray: &Ray) -> Option<Hit> {
        let [a, b, c] = self.corners;
        let (e, f, s) = (b - a, c - a, ray.origin - a);
        let determinant = |x: DVec3, y: DVec3, z: DVec3| x.dot(y.cross(z));
        let whole = determinant(-ray.direction, e, f);
        let t = determinant(s, e, f) / whole;
        let u = determinant(-ray.direction, s, f) / whole;
        let v = determinant(-ray.direction, e, s) / whole;
        let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        let [na, nb, nc] = self.normals;
        let normal = (na * (1.0 - u - v) + nb * u + nc * v).normalize();
        is_inside.then(|| Hit { t, normal, true_normal: e.cross(f).normalize() })
    }
}

/// Roots of a t² + 2 b t + c.
fn quadratic(a: f64, b: f64, c: f64) -> impl Iterator<Item = f64> {
    let root = (b * b - a * c).sqrt();
    let q = -b - root.copysign(b);
    [q / a, c / q].into_iter().filter(|t| t.is_finite())
}

/// The part of a ray within a ball of the given radius and within `half_height` of its equator.
fn within(ray: &Ray, center: DVec3, radius: f64, half_height: f64) -> Option<(f64, f64)> {
    let offset = ray.origin - center;
    let (b, c) = (offset.dot(ray.direction), offset.length_squared() - radius * radius);
    let root = (b * b - c).sqrt();
    let (low, high) = (-b - root, -b + root);
    let ends = [-half_height, half_height].map(|y| (y - offset.y) / ray.direction.y);
    let (enter, leave) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let (low, high) = (low.max(enter), high.min(leave));
    (low < high).then_some((low, high))
}

/// All roots of `f` between two places, found by looking at many places and halving where the sign changes; double
/// roots that lie between two looks are found where f comes near 0 in between.
fn roots(f: impl Fn(f64) -> f64, low: f64, high: f64) -> Vec<f64> {
    const LOOKS: usize = 96;
    if low >= high {
        return Vec::new();
    }
    // A little beyond both ends, where nothing is, so that a root at an end is between two looks.
    let margin = 1e-3 * (high - low);
    let place = |i: usize| low - margin + (high - low + 2.0 * margin) * i as f64 / LOOKS as f64;
    let seen: Vec<f64> = (0..=LOOKS).map(|i| f(place(i))).collect();
    let mut found = Vec::new();
    for i in 0..LOOKS {
        if (seen[i] < 0.0) != (seen[i + 1] < 0.0) {
            found.push(halve(&f, place(i), place(i + 1)));
        } else if i > 0 && turns_back(seen[i - 1], seen[i], seen[i + 1]) {
            let turn = extremum(&f, place(i - 1), place(i + 1), seen[i].signum());
            if (f(turn) < 0.0) != (seen[i] < 0.0) {
                let (before, after) = (place(i - 1), place(i + 1));
                found.extend([halve(&f, before, turn), halve(&f, turn, after)]);
            }
        }
    }
    found
}

/// Whether f comes nearest to 0 in the middle of three looks on one side of 0.
fn turns_back(before: f64, here: f64, after: f64) -> bool {
    let same_side = (before < 0.0) == (here < 0.0) && (here < 0.0) == (after < 0.0);
    same_side && here.abs() <= before.abs() && here.abs() <= after.abs()
}

fn halve(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let a_is_negative = f(a) < 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if (f(middle) < 0.0) == a_is_negative { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

/// Where `sign · f` is least, by golden section.
fn extremum(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64, sign: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    for _ in 0..50 {
        let (c, d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
        if sign * f(c) < sign * f(d) { b = d } else { a = c }
    }
    0.5 * (a + b)
}
