//! Who sends out photons, and how densely: two senders share the light between them.
//!
//! The *aimed* sender makes all paths whose vertex next to the light is polished or nearly so; projection maps tell it
//! where such are, and a photon of it that meets something else first is dropped. The *broad* sender makes all others,
//! from the whole of the light. So a path can come from one of them alone, and either knows its density without asking
//! which cell of a map a ray belongs to.

use crate::integrator::View;
use crate::integrator::eye::weight;
use crate::photon::PhotonEmitter;
use crate::photon::guide::Guide;
use hyaline_math::Vec3;
use hyaline_scattering::MediumSet;
use hyaline_scene::{ProjectionMaps, Techniques};
use hyaline_world::World;
use hyaline_world::light::DirectSample;

/// Cells of the projection maps along each axis, at least and at most.
const PROJECTION_CELLS: [u32; 2] = [16, 64];

/// One photon in so many leaves beams in homogeneous media; a beam is found by many more paths than a point.
const PHOTONS_PER_BEAM: u32 = 64;
/// Share of the photons that leave beams.
pub(in crate::integrator) const BEAM_SHARE: f32 = 1.0 / PHOTONS_PER_BEAM as f32;

/// One kind of photons.
pub(in crate::integrator) struct Sender<'w> {
    pub(in crate::integrator) emitter: PhotonEmitter<'w>,
    /// Photons that a pass sends out.
    pub(in crate::integrator) count: u32,
    /// Whether the first vertex of its photons passes them on as polished ones do.
    pub(in crate::integrator) is_aimed: bool,
    /// Where they are sent more densely, as their light has been found there.
    pub(in crate::integrator) guide: Guide,
}

/// Both kinds.
pub(in crate::integrator) struct Senders<'w> {
    pub(in crate::integrator) aimed: Sender<'w>,
    pub(in crate::integrator) broad: Sender<'w>,
}

/// Cells of the projection maps along each axis: small pictures send too few photons for fine maps to be worth their making.
pub(in crate::integrator) fn projection_cells(pixels: u32) -> u32 {
    pixels.isqrt().clamp(PROJECTION_CELLS[0], PROJECTION_CELLS[1])
}

impl<'w> Senders<'w> {
    /// None is sent where `merging` is off.
    pub(in crate::integrator) fn new(world: &'w World, view: &View, techniques: Techniques) -> Self {
        let pixels = view.width * view.height;
        let sender = |maps, is_aimed| {
            let emitter = PhotonEmitter::new(world, maps, projection_cells(pixels));
            Sender { emitter, count: 0, is_aimed, guide: Guide::default() }
        };
        let aimed_at = if techniques.projection { ProjectionMaps::Cells } else { ProjectionMaps::None };
        let (aimed, broad) = (sender(aimed_at, true), sender(ProjectionMaps::None, false));
        let mut senders = Self { aimed, broad };
        if techniques.merging {
            senders.send(pixels, techniques.broad);
        }
        senders
    }

    /// Sets how many photons passes send out.
    ///
    /// - `pixels`: of the picture; `broad`: whether broad ones are sent at all.
    pub(super) fn send(&mut self, pixels: u32, broad: bool) {
        for (sender, share) in [(&mut self.aimed, 2), (&mut self.broad, u32::from(broad))] {
            sender.count = if share > 0 && sender.emitter.fraction() > 0.0 {
                (share * pixels).clamp(1 << 12, 1 << 20).next_multiple_of(PHOTONS_PER_BEAM)
            } else {
                0
            };
        }
    }

    /// Who makes the paths whose vertex next to the light is polished or nearly so, or the others.
    pub(in crate::integrator) fn of(&self, is_specular: bool) -> &Sender<'w> {
        if is_specular { &self.aimed } else { &self.broad }
    }

    /// Whether there are photons at all.
    pub(super) fn any(&self) -> bool {
        self.aimed.count + self.broad.count > 0
    }
}

impl Sender<'_> {
    /// Photons of a pass that leave beams: the first ones, so that they are as even as all are.
    pub(super) fn beams(&self) -> u32 {
        self.count / PHOTONS_PER_BEAM
    }

    /// The factor of a light.
    ///
    /// - `n`: outward normal of the light at the place; `None` without a surface.
    /// - `direction`: the way the photon travels.
    /// - `set`: what the place is in.
    pub(in crate::integrator) fn density(
        &self,
        world: &World,
        light: usize,
        n: Option<Vec3>,
        direction: Vec3,
        set: &MediumSet,
    ) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        // The yes cells have the density of the light itself over the share of its light that they send out.
        let chance = world.lights.emission().probability(light) / self.emitter.fraction();
        let pdf = world.lights.get(light).pdf_emission(n.unwrap_or(Vec3::Y), direction);
        let cos = n.map_or(1.0, |n| n.dot(direction).abs());
        let ior = world.ior(set.active());
        // Without the guide: which numbers would start just this photon need not be known. Weights are right by being the
        // same on both sides; where the guide sends more photons, merging counts for a little less than it could.
        weight::at_light(self.count as f32, chance, pdf.position, pdf.direction, ior, cos)
    }

    /// The same toward a vertex that has sampled the light; for a point the square of the way stands for the cosine.
    pub(in crate::integrator) fn density_of_sample(
        &self,
        world: &World,
        light: usize,
        sample: &DirectSample,
        set: &MediumSet,
    ) -> f32 {
        let n = sample.target.map(|target| target.n);
        let light = self.density(world, light, n, -sample.wi, set);
        let is_point = sample.is_delta && sample.distance.is_finite();
        if is_point { light / (sample.distance * sample.distance) } else { light }
    }
}
