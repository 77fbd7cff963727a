//! An f64 ray tracer that knows Snell's law, Fresnel's equations and where things are, and nothing of the renderer.
//!
//! Its world is two lists that need not agree in detail: whole surfaces, never trimmed (a cone without ends, a full
//! torus), and a function that tells the medium at any point. A surface bounds something where the media on its two
//! sides differ; everywhere else a ray passes it unnoticed.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part of the tracer")]

pub mod body;
pub mod surface;
pub mod vessel;

pub use surface::Surface;

use hyaline_math::DVec3;
use surface::Hit;

/// Number of a medium; 0 fills the world.
pub type Medium = usize;

/// The world as the tracer sees it.
pub struct Scene {
    pub surfaces: Vec<Surface>,
    /// The medium at a point that lies on no surface.
    pub medium_at: Box<dyn Fn(DVec3) -> Medium>,
    /// Index of refraction of each medium.
    pub ior: Vec<f64>,
    /// About how large the things are; gaps below 1e-11 of it are none.
    pub size: f64,
    /// Half the edge of the cubic room about the origin whose walls end every path.
    pub room: f64,
}

/// A ray: `direction` is unit.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
}

/// One boundary on a path.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub p: DVec3,
    /// True normal of the surface, on either side.
    pub n: DVec3,
    /// Direction in which the path goes on.
    pub next: DVec3,
    pub from: Medium,
    pub to: Medium,
    pub transmits: bool,
}

/// A path from its start to the wall of the room.
#[derive(Clone, Debug)]
pub struct Path {
    pub steps: Vec<Step>,
    /// Where it meets the wall, or the last boundary of a path that is too long.
    pub end: DVec3,
    /// Its direction there.
    pub direction: DVec3,
    /// Radiance that arrives for a radiance of 1 at the end.
    pub weight: f64,
    /// Whether it met the wall.
    pub got_out: bool,
}

/// What a ray does at the boundaries it meets.
#[derive(Clone, Copy, Debug)]
pub struct Choices {
    /// The number of a boundary at which the path is reflected; elsewhere it is where reflection is total.
    pub reflect_at: Option<usize>,
    /// Boundaries after which a path is given up.
    pub longest: usize,
}

impl Scene {
    /// Follows a ray to the wall. `None` where the path is undecided: it passes where surfaces meet, or a smooth normal
    /// would send light to the wrong side of a triangle.
    pub fn follow(&self, ray: Ray, choices: Choices) -> Option<Path> {
        let medium = (self.medium_at)(ray.origin);
        self.follow_from(ray, medium, 0, choices)
    }

    /// The rest of a path that is in `medium` after `count` boundaries.
    pub fn follow_from(
        &self,
        mut ray: Ray,
        mut medium: Medium,
        count: usize,
        choices: Choices,
    ) -> Option<Path> {
        let mut steps: Vec<Step> = Vec::new();
        let mut weight = 1.0;
        while count + steps.len() < choices.longest {
            let Some((hit, to)) = self.next_boundary(&ray, medium)? else {
                let end = ray.origin + ray.direction * self.distance_to_wall(&ray);
                return Some(Path { steps, end, direction: ray.direction, weight, got_out: true });
            };
            let (n_i, n_t) = (self.ior[medium], self.ior[to]);
            let reflectance = fresnel(&ray, hit.normal, n_i, n_t);
            let reflected = ray.direction - 2.0 * ray.direction.dot(hit.normal) * hit.normal;
            let refracted = refract(ray.direction, hit.normal, n_i, n_t);
            let crosses = |way: DVec3| way.dot(hit.true_normal) * ray.direction.dot(hit.true_normal) > 0.0;
            if crosses(reflected) || refracted.is_some_and(|way| !crosses(way)) {
                return None;
            }
            let may_cross = choices.reflect_at != Some(count + steps.len());
            let transmitted = refracted.filter(|_| may_cross);
            let (next, transmits) = (transmitted.unwrap_or(reflected), transmitted.is_some());
            weight *= if transmits { (1.0 - reflectance) * (n_i / n_t) * (n_i / n_t) } else { reflectance };
            ray = Ray { origin: ray.origin + ray.direction * hit.t, direction: next.normalize() };
            steps.push(Step {
                p: ray.origin,
                n: hit.true_normal,
                next: ray.direction,
                from: medium,
                to,
                transmits,
            });
            medium = if transmits { to } else { medium };
        }
        Some(Path { end: ray.origin, direction: ray.direction, weight, got_out: false, steps })
    }

    /// Place and far medium of the next boundary, if there is one before the wall; the outer `None` means
    /// that the place cannot be told apart from another surface.
    fn next_boundary(&self, ray: &Ray, medium: Medium) -> Option<Option<(Hit, Medium)>> {
        let gap = 1e-11 * self.size;
        let wall = self.distance_to_wall(ray);
        let mut hits: Vec<Hit> = Vec::new();
        self.surfaces.iter().for_each(|surface| surface.crossings(ray, wall, &mut hits));
        // The surface just left is at 0, and a little off for rounding.
        hits.retain(|hit| hit.t > 1e3 * gap && hit.t < wall);
        hits.sort_by(|a, b| a.t.total_cmp(&b.t));
        let at = |t: f64| (self.medium_at)(ray.origin + ray.direction * t);
        let first = hits.first().map_or(wall, |hit| hit.t);
        if at(0.5 * first) != medium {
            return None;
        }
        for (i, hit) in hits.iter().enumerate() {
            let next = hits.get(i + 1).map_or(wall, |hit| hit.t);
            if next - hit.t < gap {
                continue;
            }
            let to = at(0.5 * (hit.t + next));
            if to != medium {
                return Some(Some((*hit, to)));
            }
        }
        Some(None)
    }

    fn distance_to_wall(&self, ray: &Ray) -> f64 {
        let away = |axis: usize| {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            if d == 0.0 { f64::INFINITY } else { (self.room * d.signum() - o) / d }
        };
        (0..3).map(away).fold(f64::INFINITY, f64::min)
    }

    /// All places where the medium changes along a straight line, with both media.
    pub fn straight(&self, ray: &Ray) -> Option<Vec<(f64, Medium, Medium)>> {
        let mut seen = Vec::new();
        let mut medium = (self.medium_at)(ray.origin);
        let (mut start, mut ray) = (0.0, *ray);
        while let Some((hit, to)) = self.next_boundary(&ray, medium)? {
            start += hit.t;
            seen.push((start, medium, to));
            ray.origin += ray.direction * hit.t;
            medium = to;
        }
        Some(seen)
    }
}

/// Snell's law: n_i sin i = n_t sin t in the plane of incidence. `None` where that asks for a sine above 1.
pub fn refract(direction: DVec3, normal: DVec3, n_i: f64, n_t: f64) -> Option<DVec3> {
    let normal = if direction.dot(normal) < 0.0 { normal } else { -normal };
    let along_surface = direction - normal * direction.dot(normal);
    let sine = along_surface * (n_i / n_t);
    let cos2 = 1.0 - sine.length_squared();
    (cos2 > 0.0).then(|| sine - normal * cos2.sqrt())
}

/// Fraction of unpolarised light that is reflected, by Fresnel's equations: sines and tangents of i - t and i + t.
fn fresnel(ray: &Ray, normal: DVec3, n_i: f64, n_t: f64) -> f64 {
    let Some(refracted) = refract(ray.direction, normal, n_i, n_t) else { return 1.0 };
    let (cos_i, cos_t) = (ray.direction.dot(normal).abs(), refracted.dot(normal).abs());
    let (sin_i, sin_t) = ((1.0 - cos_i * cos_i).max(0.0).sqrt(), (1.0 - cos_t * cos_t).max(0.0).sqrt());
    if sin_i < 1e-6 {
        let amplitude = (n_i - n_t) / (n_i + n_t);
        return amplitude * amplitude;
    }
    let (sin_minus, sin_plus) = (sin_i * cos_t - cos_i * sin_t, sin_i * cos_t + cos_i * sin_t);
    let (cos_minus, cos_plus) = (cos_i * cos_t + sin_i * sin_t, cos_i * cos_t - sin_i * sin_t);
    let perpendicular = sin_minus / sin_plus;
    let parallel = perpendicular * cos_plus / cos_minus;
    0.5 * (perpendicular * perpendicular + parallel * parallel)
}
