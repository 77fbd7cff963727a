//! The rays that are timed.

use hyaline_geometry::{Aggregate, SurfaceHit};
use hyaline_math::{Frame, Ray, Vec3, offset_origin};
use hyaline_testkit::Random;

/// Rays of each kind.
const RAY_COUNT: usize = 200_000;

/// Rays of each kind.
#[derive(Default)]
pub(crate) struct Rays {
    primary: Vec<Ray>,
    diffuse: Vec<Ray>,
    refracted: Vec<Ray>,
    shadow: Vec<Ray>,
}

impl Rays {
    /// Follows paths from a camera in a corner of the room.
    pub(crate) fn trace(scene: &Aggregate) -> Self {
        let mut random = Random::from_seed(7);
        let mut rays = Self::default();
        let eye = Vec3::new(1.1, 0.9, 1.5);
        let frame = Frame::from_normal(-eye.normalize());
        let side = (RAY_COUNT as f64).sqrt() as usize;
        for pixel in 0..side * side {
            let x = (pixel % side) as f32 / side as f32 - 0.5;
            let y = (pixel / side) as f32 / side as f32 - 0.5;
            let ray = Ray::new(eye, frame.to_world(Vec3::new(x, y, 0.8)).normalize());
            rays.primary.push(ray);
            rays.scatter(scene, ray, &mut random);
            rays.refract(scene, ray, &mut random);
        }
        rays
    }

    pub(crate) fn kinds(&self) -> [(&'static str, &[Ray]); 4] {
        [
            ("primary", &self.primary),
            ("diffuse", &self.diffuse),
            ("refracted", &self.refracted),
            ("shadow", &self.shadow),
        ]
    }

    /// Two diffuse bounces; the last ray is kept, and a shadow ray from the first hit.
    fn scatter(&mut self, scene: &Aggregate, mut ray: Ray, random: &mut Random) {
        for bounce in 0..2 {
            let Some(hit) = surface(scene, &ray) else { return };
            let n = if hit.ng.dot(ray.direction) > 0.0 { -hit.ng } else { hit.ng };
            if bounce == 0 {
                let to_light = Vec3::new(-0.5, 1.9, 0.3) - hit.p;
                let direction = to_light.normalize();
                let origin = offset_origin(hit.p, hit.p_error, hit.ng, direction);
                self.shadow.push(Ray { t_max: 0.999 * to_light.length(), ..Ray::new(origin, direction) });
            }
            let lobe = Vec3::from_array(random.direction().map(|x| x as f32));
            let direction = (n + 0.999 * lobe).normalize();
            ray = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
        }
        self.diffuse.push(ray);
    }

    /// A chain of Fresnel choices through the object, until it meets the room.
    fn refract(&mut self, scene: &Aggregate, mut ray: Ray, random: &mut Random) {
        for _ in 0..24 {
            let Some(hit) = surface(scene, &ray) else { return };
            if hit.p.abs().max_element() > 1.99 || self.refracted.len() >= RAY_COUNT {
                return;
            }
            let direction = fresnel_choice(ray.direction, hit.ng, random.uniform_f32());
            ray = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
            self.refracted.push(ray);
        }
    }
}

fn surface(scene: &Aggregate, ray: &Ray) -> Option<SurfaceHit> {
    Some(scene.surface(ray, &scene.closest(ray, 0xff)?))
}

/// The reflected direction with the probability of Fresnel's equations, else the refracted one.
fn fresnel_choice(direction: Vec3, ng: Vec3, u: f32) -> Vec3 {
    let (n, eta) = if direction.dot(ng) < 0.0 { (ng, 1.5) } else { (-ng, 1.0 / 1.5) };
    let cos_i = -direction.dot(n);
    let cos_t2 = 1.0 - (1.0 - cos_i * cos_i) / (eta * eta);
    let reflected = direction + 2.0 * cos_i * n;
    if cos_t2 <= 0.0 {
        return reflected.normalize();
    }
    let cos_t = cos_t2.sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    if u < 0.5 * (parallel * parallel + perpendicular * perpendicular) {
        return reflected.normalize();
    }
    (direction / eta + (cos_i / eta - cos_t) * n).normalize()
}
