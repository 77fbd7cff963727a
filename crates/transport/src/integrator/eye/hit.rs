//! Lights that a path comes to by itself.

use super::{Eye, Path, asking, weight};
use crate::walk::Vertex;
use hyaline_geometry::SurfaceHit;
use hyaline_math::Vec3;
use hyaline_spectrum::Spectrum;
use hyaline_world::mask;

impl Eye<'_> {
    /// Light of the surface that the path hits.
    pub(super) fn emitted(&self, path: &Path, vertex: &Vertex) -> Spectrum {
        let Some(index) = vertex.light.filter(|_| !path.last.is_covered) else { return Spectrum::ZERO };
        let light = self.world.lights.get(index as usize);
        let (hit, direction) = (&vertex.hit, path.ray.direction);
        let radiance = light.radiance_from(hit, -direction);
        if radiance.is_zero() {
            return radiance;
        }
        radiance * self.hit_weight(path, index as usize, Some(hit))
    }

    /// Light of the surroundings.
    pub(super) fn sky(&self, path: &Path) -> Spectrum {
        let mut result = Spectrum::ZERO;
        if path.last.is_covered {
            return result;
        }
        let lights = &self.world.lights;
        let seen = if path.visible == mask::CAMERA { &self.world.camera_sky } else { lights.environments() };
        for &index in seen {
            let light = lights.get(index as usize);
            result += light.radiance_of_sky(path.ray.direction) * self.hit_weight(path, index as usize, None);
        }
        result
    }

    /// What hitting a light counts beside sampling it and merging.
    ///
    /// - `hit`: the place on the light; `None` for the surroundings.
    pub(super) fn hit_weight(&self, path: &Path, index: usize, hit: Option<&SurfaceHit>) -> f32 {
        let techniques = self.settings.techniques;
        let sampled = path.last.sampled.filter(|_| techniques.sampling);
        let sampling = sampled.map_or(0.0, |(p, pdf)| {
            let light = self.world.lights.get(index);
            let chance = asking::expected(self.world, index, path.bounces - 1);
            chance * light.pdf_direct(p, path.ray.direction, hit) / pdf
        });
        let aimed = if path.crossings > 0 { path.rival } else { 0.0 };
        let merging = self.merging(path, index, hit.map(|hit| hit.ng));
        weight::share(techniques.hits, sampling * sampling + aimed * aimed + merging)
    }

    /// Squared densities of all ways to merge over that of hitting the light that the path has come to.
    ///
    /// - `n`: outward normal of the light at the place; `None` for the surroundings.
    fn merging(&self, path: &Path, index: usize, n: Option<Vec3>) -> f32 {
        let squares = path.merges.at_light();
        let Some(photons) = self.photons.as_ref().filter(|_| squares > 0.0) else { return 0.0 };
        let sender = photons.senders.of(path.merges.is_specular());
        let light = sender.density(self.world, index, n, -path.ray.direction, &path.set);
        squares * light * light
    }
}
