//! Which finish a ray finds at a surface: the side it comes from, whether it meets a hole, which part of a blend.
//!
//! Paths choose, by numbers that hang on the ray and the place alone: no random number of the sampler is spent on a
//! surface, and who asks twice gets the same answer. Shadow rays take the mean over all choices instead, which is
//! exact. Both are estimates of the same light.
//!
//! A hole is a surface that is not there, but for what it bounds: who passes through a hole in the surface of a body is
//! inside the body then, as if both media had the same index.

use crate::material::{Composition, Finish, Material};
use crate::meeting::Encounter;
use crate::relief::Relief;
use crate::{World, material::ScalarInput};
use hyaline_geometry::SurfaceHit;
use hyaline_math::Ray;
use hyaline_sampling::hash::{combine, unit_f32};
use hyaline_scattering::{Crossing, MediumId, Sides, SurfaceBsdf};
use hyaline_spectrum::Spectrum;

/// What a ray finds, all choices made.
#[derive(Clone, Copy, Debug)]
pub struct Face<'w> {
    /// The finish; `None` in a hole.
    finish: Option<&'w Finish>,
    /// What turns the shading normal.
    pub relief: Option<&'w Relief>,
    sides: Sides,
    /// Whether shadow rays pass straight through what paths are bent by.
    pub straight_shadows: bool,
}

/// What of its light a shadow ray takes along straight through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightWay {
    /// The part that paths find by going straight, too: light sampling shares it with them by MIS.
    pub shared: Spectrum,
    /// The part that is left to shadow rays alone, through finishes with straight shadows: it counts in full.
    pub alone: Spectrum,
}

impl StraightWay {
    /// Nothing gets through.
    pub const BLOCKED: Self = Self::shared(Spectrum::ZERO);
    /// Everything gets through, for all.
    pub const OPEN: Self = Self::shared(Spectrum::ONE);

    /// A fraction that paths find, too.
    pub const fn shared(transmittance: Spectrum) -> Self {
        Self { shared: transmittance, alone: Spectrum::ZERO }
    }

    /// All of it.
    pub fn transmittance(self) -> Spectrum {
        self.shared + self.alone
    }

    /// One way after the other.
    pub fn then(self, next: Self) -> Self {
        let alone = self.alone * next.transmittance() + self.shared * next.alone;
        Self { shared: self.shared * next.shared, alone }
    }

    /// The mean of two ways, of which the second has the share `t`, 0…1.
    pub fn lerp(self, second: Self, t: f32) -> Self {
        let mix = |a: Spectrum, b: Spectrum| a * (1.0 - t) + b * t;
        Self { shared: mix(self.shared, second.shared), alone: mix(self.alone, second.alone) }
    }
}

impl World {
    /// What `ray` finds at a hit.
    pub fn face(&self, ray: &Ray, hit: &SurfaceHit, encounter: &Encounter) -> Face<'_> {
        if encounter.is_wedged {
            let finish = Some(&Finish::Black);
            return Face { finish, relief: None, sides: Sides::Both, straight_shadows: false };
        }
        let material = &self.materials[self.material_of(hit, encounter) as usize];
        match material.only_finish() {
            Some(finish) => Face {
                finish: Some(finish),
                relief: material.relief.as_ref(),
                sides: material.sides(),
                straight_shadows: material.straight_shadows,
            },
            None => self.choose_face(ray, hit, material),
        }
    }

    fn choose_face<'w>(&'w self, ray: &Ray, hit: &SurfaceHit, mut material: &'w Material) -> Face<'w> {
        let mut choices = Choices::new(ray, hit);
        // What is named for the back works there, whatever it says of itself.
        let mut is_own_back = false;
        let mut face = Face { finish: None, relief: None, sides: Sides::Both, straight_shadows: false };
        loop {
            if choices.is_hole(self, material, hit) {
                return face;
            }
            if let Some(back) = self.back_of(ray, hit, material) {
                material = back;
                is_own_back = true;
            }
            if !(material.two_sided || is_own_back) {
                face.sides = Sides::Front;
            }
            face.relief = material.relief.as_ref().or(face.relief);
            face.straight_shadows = material.straight_shadows;
            match &material.composition {
                Composition::Single(finish) => return Face { finish: Some(finish), ..face },
                Composition::Blend(first, second, weight) => {
                    let chosen = if choices.next() < self.share(*weight, hit) { second } else { first };
                    material = &self.materials[*chosen as usize];
                }
            }
        }
    }

    /// Whether `ray` meets a hole at a surface that bounds no medium.
    pub(crate) fn is_hole(&self, ray: &Ray, hit: &SurfaceHit) -> bool {
        let material = self.default_material(hit);
        material.has_holes() && Choices::new(ray, hit).is_hole(self, material, hit)
    }

    /// Fraction of light that goes straight through, unbent and unreflected; `None` where the surface does more than
    /// that.
    pub fn straight_through(&self, face: &Face, hit: &SurfaceHit, encounter: &Encounter) -> Option<Spectrum> {
        if self.items[hit.item as usize].light.is_some() {
            return None;
        }
        if encounter.crossing == Some(Crossing::Hidden) {
            return Some(Spectrum::ONE);
        }
        let Some(finish) = face.finish else { return Some(Spectrum::ONE) };
        let is_matched = encounter.crossing.is_some_and(|crossing| crossing.is_index_matched(&self.media));
        finish.straight_through(&self.textures, hit.uv, is_matched)
    }

    /// How the surface scatters light that comes along `ray` through the medium `within`.
    pub fn surface_bsdf(
        &self,
        face: &Face,
        ray: &Ray,
        hit: &SurfaceHit,
        encounter: &Encounter,
        within: MediumId,
    ) -> SurfaceBsdf {
        let (ior, eta) = self.indices(encounter, within);
        let bsdf = face.finish.unwrap_or(&Finish::PassThrough).bsdf(&self.textures, hit.uv, ior, eta);
        SurfaceBsdf::new(bsdf, hit.n, hit.ng, -ray.direction, face.sides, self.lanes)
    }

    /// What of its light a shadow ray takes along straight through a surface: the mean over all that paths may find
    /// there.
    pub fn straight_way(
        &self,
        ray: &Ray,
        hit: &SurfaceHit,
        encounter: &Encounter,
        within: MediumId,
    ) -> StraightWay {
        if self.items[hit.item as usize].light.is_some() || encounter.is_wedged {
            return StraightWay::BLOCKED;
        }
        if encounter.crossing == Some(Crossing::Hidden) {
            return StraightWay::OPEN;
        }
        let material = &self.materials[self.material_of(hit, encounter) as usize];
        Straight { world: self, ray, hit, encounter, within }.mean(material, !encounter.is_solid_there)
    }

    /// Index on the side of a path within `within`, and that of the far side over it.
    fn indices(&self, encounter: &Encounter, within: MediumId) -> (f32, f32) {
        match encounter.crossing {
            Some(Crossing::Boundary { from, to, .. }) => (self.ior(from), self.ior(to) / self.ior(from)),
            Some(Crossing::Hidden) | None => (self.ior(within), 1.0),
        }
    }

    /// The material of the back, where there is one and `ray` comes from there.
    fn back_of(&self, ray: &Ray, hit: &SurfaceHit, material: &Material) -> Option<&Material> {
        let back = material.back.filter(|_| ray.direction.dot(hit.ng) > 0.0)?;
        Some(&self.materials[back as usize])
    }

    fn share(&self, input: ScalarInput, hit: &SurfaceHit) -> f32 {
        input.at(&self.textures, hit.uv).clamp(0.0, 1.0)
    }
}

/// Numbers in [0, 1) for the choices of one ray at one place: functions of both and of nothing else.
struct Choices {
    key: u64,
}

impl Choices {
    fn new(ray: &Ray, hit: &SurfaceHit) -> Self {
        let pair = |a: u32, b: u32| u64::from(a) << 32 | u64::from(b);
        let [x, y, z] = ray.origin.to_array().map(f32::to_bits);
        let [u, v, w] = ray.direction.to_array().map(f32::to_bits);
        let words = [pair(x, y), pair(z, u), pair(v, w), pair(hit.item, hit.primitive)];
        Self { key: words.into_iter().fold(0, combine) }
    }

    fn next(&mut self) -> f32 {
        self.key = combine(self.key, 1);
        unit_f32((self.key >> 32) as u32)
    }

    fn is_hole(&mut self, world: &World, material: &Material, hit: &SurfaceHit) -> bool {
        material.has_holes() && self.next() >= world.share(material.opacity, hit)
    }
}

/// The mean over the choices at one place.
struct Straight<'a> {
    world: &'a World,
    ray: &'a Ray,
    hit: &'a SurfaceHit,
    encounter: &'a Encounter,
    within: MediumId,
}

impl Straight<'_> {
    /// - `may_be_hole`: whether the opacity of `material` is still to be asked.
    fn mean(&self, material: &Material, may_be_hole: bool) -> StraightWay {
        let there = self.through(self.world.back_of(self.ray, self.hit, material).unwrap_or(material));
        if !(may_be_hole && material.has_holes()) {
            return there;
        }
        StraightWay::OPEN.lerp(there, self.world.share(material.opacity, self.hit))
    }

    fn through(&self, material: &Material) -> StraightWay {
        match &material.composition {
            Composition::Single(finish) => self.through_finish(finish, material.straight_shadows),
            Composition::Blend(first, second, weight) => {
                let [first, second] =
                    [*first, *second].map(|i| self.mean(&self.world.materials[i as usize], true));
                first.lerp(second, self.world.share(*weight, self.hit))
            }
        }
    }

    fn through_finish(&self, finish: &Finish, straight_shadows: bool) -> StraightWay {
        let Self { world, ray, hit, encounter, within } = self;
        let is_matched = encounter.crossing.is_some_and(|crossing| crossing.is_index_matched(&world.media));
        if let Some(straight) = finish.straight_through(&world.textures, hit.uv, is_matched) {
            return StraightWay::shared(straight);
        }
        if !straight_shadows {
            return StraightWay::BLOCKED;
        }
        let (ior, eta) = world.indices(encounter, *within);
        let bsdf = finish.bsdf(&world.textures, hit.uv, ior, eta);
        let surface = SurfaceBsdf::new(bsdf, hit.n, hit.ng, -ray.direction, Sides::Both, world.lanes);
        StraightWay { shared: Spectrum::ZERO, alone: surface.straight_transmittance(ray.direction) }
    }
}
