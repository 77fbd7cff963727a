//! Densities of the ways to make a given path, from first principles in f64: own rays, own lobes, derivatives by
//! differences. Nothing of étendue is used here; that it is conserved is what the comparison shows.

use hyaline_math::DVec3;
use std::f64::consts::PI;

/// Step of the differences, radians or scene units.
const STEP: f64 = 1e-5;

/// A surface that light meets.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Plane { p: DVec3, n: DVec3 },
    Sphere { center: DVec3, radius: f64 },
}

impl Shape {
    /// Distance of a point from the surface.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        match *self {
            Self::Plane { p, n } => (point - p).dot(n).abs(),
            Self::Sphere { center, radius } => (point.distance(center) - radius).abs(),
        }
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        match *self {
            Self::Plane { n, .. } => n,
            Self::Sphere { center, .. } => (point - center).normalize(),
        }
    }

    /// The first place on the ray that is not its start.
    fn meet(&self, ray: Ray) -> Option<DVec3> {
        let Ray { origin, direction } = ray;
        let t = match *self {
            Self::Plane { p, n } => (p - origin).dot(n) / direction.dot(n),
            Self::Sphere { center, radius } => {
                let to_center = center - origin;
                let middle = to_center.dot(direction);
                let half = (radius * radius - (to_center.length_squared() - middle * middle)).sqrt();
                if middle - half > 1e-4 { middle - half } else { middle + half }
            }
        };
        (t.is_finite() && t > 1e-6).then(|| origin + direction * t)
    }
}

/// A ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub(super) origin: DVec3,
    /// Unit.
    pub(super) direction: DVec3,
}

/// What a place does to light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Finish {
    Polished,
    /// Ground glass of this GGX width.
    Ground(f64),
    Matte,
    /// A particle of a homogeneous medium; the mean cosine.
    Fog(f64),
    /// The same of one with a grid.
    Smoke(f64),
}

/// What a path does at a surface or in the fog, in the order of a photon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// In the fog of no meaning.
    pub(super) shape: Shape,
    pub(super) p: DVec3,
    /// Unit, back to where the photon came from, and where it goes on.
    pub(super) to_light: DVec3,
    pub(super) to_receiver: DVec3,
    /// Indices on those sides.
    pub(super) ior: [f64; 2],
    pub(super) transmits: bool,
    pub(super) finish: Finish,
}

impl Turn {
    /// The same, seen from the eye.
    pub(super) fn reversed(self) -> Self {
        let [a, b] = self.ior;
        Self { to_light: self.to_receiver, to_receiver: self.to_light, ior: [b, a], ..self }
    }

    /// Density of the direction in which a photon goes on; at polished surfaces the chance of its branch.
    pub(super) fn pdf(&self) -> f64 {
        let n = self.shape.normal(self.p);
        let n = if n.dot(self.to_light) < 0.0 { -n } else { n };
        let eta = if self.transmits { self.ior[1] / self.ior[0] } else { self.eta_beyond() };
        match self.finish {
            Finish::Polished => branch(self.to_light.dot(n), eta, self.transmits),
            Finish::Ground(alpha) => {
                ground_glass(n, self.to_light, self.to_receiver, eta, self.transmits, alpha)
            }
            Finish::Matte => self.to_receiver.dot(n).max(0.0) / PI,
            Finish::Fog(g) | Finish::Smoke(g) => henyey_greenstein(g, -self.to_light.dot(self.to_receiver)),
        }
    }

    /// The smaller cosine of its two ways with the surface; 1 in media.
    pub(super) fn cos(&self) -> f64 {
        if matches!(self.finish, Finish::Fog(_) | Finish::Smoke(_)) {
            return 1.0;
        }
        let n = self.shape.normal(self.p);
        n.dot(self.to_light).abs().min(n.dot(self.to_receiver).abs())
    }

    /// Whether it is a place that paths make, not one that they are led over.
    pub(super) fn is_drawn(&self) -> bool {
        self.finish != Finish::Polished
    }

    /// Whether photons scatter widely there.
    pub(super) fn is_wide(&self) -> bool {
        match self.finish {
            Finish::Polished => false,
            Finish::Ground(alpha) => alpha > 0.25,
            Finish::Matte | Finish::Fog(_) | Finish::Smoke(_) => true,
        }
    }

    /// What light ends at that comes here from the light's or from the eye's side: in the fog the plane across its way.
    pub(super) fn end(&self, from: DVec3) -> End {
        End::Surface(match self.finish {
            Finish::Fog(_) | Finish::Smoke(_) => Shape::Plane { p: self.p, n: from },
            _ => self.shape,
        })
    }

    /// Relative index of the far side where the light is reflected: all glass here has 1.5, in air.
    fn eta_beyond(&self) -> f64 {
        if self.ior[0] > 1.0 { 1.0 / self.ior[0] } else { GLASS }
    }
}

/// Index of all bodies in the tests.
pub(super) const GLASS: f64 = 1.5;

/// Unpolarized Fresnel reflectance. [Born & Wolf, §1.5.2]
fn fresnel(cos: f64, eta: f64) -> f64 {
    let sin2 = (1.0 - cos * cos) / (eta * eta);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2).sqrt();
    let (s, p) = ((cos - eta * cos_t) / (cos + eta * cos_t), (eta * cos - cos_t) / (eta * cos + cos_t));
    0.5 * (s * s + p * p)
}

fn branch(cos: f64, eta: f64, transmits: bool) -> f64 {
    let reflected = fresnel(cos.abs(), eta);
    if transmits { 1.0 - reflected } else { reflected }
}

/// Density of a direction drawn at ground glass by visible normals. [Walter 2007, eq. 13-17, 33, 34; Heitz 2018]
fn ground_glass(n: DVec3, wo: DVec3, wi: DVec3, eta: f64, transmits: bool, alpha: f64) -> f64 {
    let h = if transmits { wo + wi * eta } else { wo + wi }.normalize();
    let h = if h.dot(n) < 0.0 { -h } else { h };
    let (cos_o, cos_i) = (wo.dot(h), wi.dot(h));
    let a2 = alpha * alpha;
    let d = a2 / (PI * ((a2 - 1.0) * n.dot(h).powi(2) + 1.0).powi(2));
    let cos = wo.dot(n);
    let g1 = 2.0 / (1.0 + (1.0 + a2 * (1.0 - cos * cos) / (cos * cos)).sqrt());
    let visible = g1 * d * cos_o.max(0.0) / cos;
    let stretch = match transmits {
        true => eta * eta * cos_i.abs() / (cos_o + eta * cos_i).powi(2),
        false => 0.25 / cos_o,
    };
    branch(cos_o, eta, transmits) * visible * stretch
}

/// Phase function by the cosine of the angle of deflection, sr⁻¹. [Henyey & Greenstein 1941]
fn henyey_greenstein(g: f64, cos: f64) -> f64 {
    let square = 1.0 + g * g - 2.0 * g * cos;
    (1.0 - g * g) / (4.0 * PI * square * square.sqrt())
}

/// Where a bundle of rays ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    Surface(Shape),
    Infinity,
}

/// Follows a ray through polished surfaces to its end: a place, or a direction at infinity.
pub(super) fn follow(mut ray: Ray, polished: &[Turn], end: End) -> Option<DVec3> {
    for turn in polished {
        let p = turn.shape.meet(ray)?;
        let n = turn.shape.normal(p);
        let n = if n.dot(ray.direction) > 0.0 { -n } else { n };
        let cos = -n.dot(ray.direction);
        let direction = if turn.transmits {
            // Snell's law for vectors.
            let ratio = turn.ior[0] / turn.ior[1];
            let cos_t = (1.0 - ratio * ratio * (1.0 - cos * cos)).sqrt();
            ray.direction * ratio + n * (ratio * cos - cos_t)
        } else {
            ray.direction + n * (2.0 * cos)
        };
        ray = Ray { origin: p, direction: direction.normalize() };
    }
    match end {
        End::Surface(shape) => shape.meet(ray),
        End::Infinity => Some(ray.direction),
    }
}

/// What a bundle of rays covers at its end, per solid angle at its start (or per area across it, where the rays are
/// parallel): m² or sr per sr or m². Not a number where the bundle is torn.
pub(super) fn spread(ray: Ray, is_parallel: bool, polished: &[Turn], end: End) -> f64 {
    let u = ray.direction.any_orthonormal_vector();
    let v = ray.direction.cross(u);
    let along = |axis: DVec3| {
        let moved = |step: f64| match is_parallel {
            true => Ray { origin: ray.origin + axis * step, ..ray },
            false => Ray { direction: (ray.direction + axis * step).normalize(), ..ray },
        };
        let place = |step: f64| follow(moved(step), polished, end).unwrap_or(DVec3::NAN);
        (place(STEP) - place(-STEP)) / (2.0 * STEP)
    };
    along(u).cross(along(v)).length()
}
