//! Where a photon comes from, as far as weights ask.

use crate::photon::PhotonStart;
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Vec2, Vec3};
use hyaline_scene::Techniques;
use hyaline_world::World;
use hyaline_world::light::Light;

/// The start of a photon.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Origin {
    pub(in crate::integrator) light: u32,
    pub(in crate::integrator) p: Vec3,
    p_error: f32,
    /// Outward normal of the light; `None` without a surface.
    pub(in crate::integrator) n: Option<Vec3>,
    /// The factor of the light, see `weight`.
    at_light: f32,
    /// Which ways other than merging count.
    techniques: Techniques,
    /// Whether no path hits the light: sampling it then stands where drawing a direction toward it would.
    pub(in crate::integrator) is_delta: bool,
}

impl Origin {
    pub(super) fn new(world: &World, start: &PhotonStart, at_light: f32, techniques: Techniques) -> Self {
        let PhotonStart { light, origin: p, p_error, n, .. } = *start;
        let is_delta = !world.lights.get(light as usize).can_be_met();
        Self { light, p, p_error, n, at_light, techniques, is_delta }
    }

    /// Square of the density of hitting the light over its factor.
    pub(super) fn hit(&self) -> f32 {
        if self.is_delta || !self.techniques.hits { 0.0 } else { (self.at_light * self.at_light).recip() }
    }

    /// Density of sampling the light from the first vertex over the light's factor, once it is asked.
    ///
    /// - `p`: the vertex; `toward`: unit, from there to the light.
    pub(in crate::integrator) fn sampled(&self, world: &World, p: Vec3, toward: Vec3) -> f32 {
        if !self.techniques.sampling {
            return 0.0;
        }
        let light = world.lights.get(self.light as usize);
        match light {
            Light::Directional(_) => self.at_light.recip(),
            // For a point the square of the way stands for the cosine.
            _ if self.is_delta => self.p.distance_squared(p) / self.at_light,
            _ => light.pdf_direct(p, toward, self.hit_by_path().as_ref()) / self.at_light,
        }
    }

    /// The place on the light as a path would hit it.
    fn hit_by_path(&self) -> Option<SurfaceHit> {
        let Self { p, p_error, n, .. } = *self;
        let n = n?;
        Some(SurfaceHit { t: 0.0, p, p_error, ng: n, n, uv: Vec2::ZERO, item: 0, primitive: 0 })
    }
}
