//! From one place to the next surface that does something: camera paths, photons and mirror rays all walk here.
//!
//! Boundaries that are hidden, index matched or mere bounds are crossed on the way; the medium in force between two
//! crossings filters the light.

use crate::stats::Stats;
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec3, offset_origin};
use hyaline_scattering::{MediumSet, ObjectId, SurfaceBsdf};
use hyaline_spectrum::Spectrum;
use hyaline_world::{Encounter, World};

/// Straight crossings in a row, at most: far more than any scene has, and an end where rounding traps a ray.
pub(crate) const LONGEST_WALK: u32 = 1 << 16;

/// What a walk ends at.
#[expect(clippy::large_enum_variant, reason = "a box would be an allocation for every ray")]
pub enum Event {
    /// Nothing more: the surroundings.
    Sky {
        /// Fraction of light left on the way.
        transmittance: Spectrum,
    },
    /// A surface that scatters, swallows or shines.
    Surface(Vertex),
}

/// A surface at the end of a walk.
#[derive(Clone)]
pub struct Vertex {
    /// The surface.
    pub hit: SurfaceHit,
    /// How it scatters.
    pub bsdf: SurfaceBsdf,
    /// Whose surface it is.
    pub object: ObjectId,
    /// Index of the light that it is, if it shines.
    pub light: Option<u32>,
    /// Fraction of light left on the way here.
    pub transmittance: Spectrum,
    /// Length of the way here, scene units.
    pub distance: f32,
    /// What crossing it changes.
    encounter: Encounter,
}

impl Vertex {
    /// Takes the path across the surface: `set` becomes what holds on the other side.
    pub fn commit(&self, world: &World, set: &mut MediumSet) {
        self.encounter.commit(world, set);
    }

    /// The ray that leaves in direction `wi`, unit.
    pub fn leave(&self, wi: Vec3, time: f32) -> Ray {
        let origin = offset_origin(self.hit.p, self.hit.p_error, self.hit.ng, wi);
        Ray { time, ..Ray::new(origin, wi) }
    }

    /// The same place with another finish.
    pub fn with_bsdf(&self, bsdf: SurfaceBsdf) -> Vertex {
        Vertex { bsdf, ..self.clone() }
    }

    /// The set on the other side, for light that comes through.
    pub fn far_set(&self, world: &World, set: &MediumSet) -> MediumSet {
        let mut far = set.clone();
        self.encounter.commit(world, &mut far);
        far
    }
}

/// Walks along `ray` to the next surface that does something; `set` is kept true on the way.
///
/// - `visible`: mask of the items that the ray sees.
pub fn advance(world: &World, ray: &Ray, visible: u8, set: &mut MediumSet, stats: &mut Stats) -> Event {
    let mut ray = *ray;
    let mut transmittance = Spectrum::ONE;
    let mut distance = 0.0;
    for _ in 0..LONGEST_WALK {
        stats.rays += 1;
        let within = set.active();
        let medium = &world.media[within.index()];
        let Some(candidate) = world.geometry.closest(&ray, visible) else {
            transmittance *= medium.transmittance(f32::INFINITY);
            return Event::Sky { transmittance };
        };
        let (hit, encounter) =
            world.meet(&ray, &candidate, set, visible, &mut |object| stats.count_never_entered(object));
        transmittance *= medium.transmittance(hit.t);
        distance += hit.t;
        let Some(straight) = world.straight_through(&hit, &encounter) else {
            let item = &world.items[hit.item as usize];
            let bsdf = world.surface_bsdf(&ray, &hit, &encounter, within);
            let (object, light) = (item.object, item.light);
            return Event::Surface(Vertex { hit, bsdf, object, light, transmittance, distance, encounter });
        };
        transmittance *= straight;
        encounter.commit(world, set);
        ray.origin = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        ray.t_max -= hit.t;
    }
    Event::Sky { transmittance: Spectrum::ZERO }
}
