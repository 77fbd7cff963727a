//! From one place to the next surface that does something: camera paths, photons and mirror rays all walk here.
//!
//! Boundaries that are hidden, index matched or mere bounds are crossed on the way; the medium in force between two
//! crossings filters the light, and may scatter the path or add light of its own.

use crate::stats::Stats;
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec3, offset_origin};
use hyaline_sampling::Sampler;
use hyaline_scattering::volume::{self, Flyer};
use hyaline_scattering::{Medium, MediumId, MediumSet, ObjectId, SurfaceBsdf};
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
    /// Whether shadow rays pass it straight, though paths are bent by it.
    straight_shadows: bool,
}

impl Vertex {
    /// Takes the path across the surface: `set` becomes what holds on the other side.
    pub fn commit(&self, world: &World, set: &mut MediumSet) {
        self.encounter.commit(world, set);
    }

    /// Whether media meet here; an opaque surface or a sheet bounds none.
    pub(crate) fn is_boundary(&self) -> bool {
        self.encounter.crossing.is_some()
    }

    /// Whether shadow rays have already brought what comes to a receiver this way: the surface has straight shadows,
    /// and the path crosses it.
    ///
    /// This is the rule of straight shadows, for paths and photons alike. Light that comes to a receiver through
    /// nothing but such crossings, and what light passes straight anyway, is left to the receiver's shadow rays: a
    /// path from the receiver adds nothing for it, and a photon that takes this way from its light is not kept there.
    /// Light that is reflected on the way, or bent by a surface without straight shadows, counts as always.
    ///
    /// - `transmits`: whether the path crosses the surface.
    pub fn passes_straight(&self, transmits: bool) -> bool {
        // A lamp stops shadow rays, whatever its finish.
        self.straight_shadows && transmits && self.light.is_none()
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

/// What a walk that may scatter ends at.
#[expect(clippy::large_enum_variant, reason = "a box would be an allocation for every ray")]
pub enum Flown {
    /// What a straight walk ends at.
    Arrived(Event),
    /// A particle of a medium on the way.
    Scattered(VolumeVertex),
}

/// A place within a medium where a path scatters.
#[derive(Clone, Copy, Debug)]
pub struct VolumeVertex {
    /// Where.
    pub p: Vec3,
    /// The medium.
    pub medium: MediumId,
    /// Factor on the path's throughput: what is left of it on the way here, and what scatters.
    pub weight: Spectrum,
    /// Length of the way here, scene units.
    pub distance: f32,
}

/// Walks along `ray` to the next surface that does something; `set` is kept true on the way. Media dim the light;
/// what they scatter is lost.
///
/// - `visible`: mask of the items that the ray sees.
pub fn advance(world: &World, ray: &Ray, visible: u8, set: &mut MediumSet, stats: &mut Stats) -> Event {
    match walk(world, ray, visible, set, &mut Dimmed, stats) {
        Flown::Arrived(event) => event,
        Flown::Scattered(_) => unreachable!("media that only dim do not scatter"),
    }
}

/// `advance`, for callers that fly elsewhere: the answer stays in its place, as vertices are large.
pub(crate) fn advance_flown(
    world: &World,
    ray: &Ray,
    visible: u8,
    set: &mut MediumSet,
    stats: &mut Stats,
) -> Flown {
    walk(world, ray, visible, set, &mut Dimmed, stats)
}

/// Walks along `ray` to the next surface that does something or to the next place where a medium scatters the path.
///
/// - `throughput`: what the path carries; lanes that carry much decide where it scatters.
///
/// Returns where it ends, and the light that media on the way send out, as it arrives at the ray's origin.
pub fn fly(
    world: &World,
    ray: &Ray,
    visible: u8,
    set: &mut MediumSet,
    throughput: Spectrum,
    sampler: &mut Sampler,
    stats: &mut Stats,
) -> (Flown, Spectrum) {
    fly_watched(world, ray, visible, set, throughput, sampler, stats, |_| ())
}

/// The same, and `watch` is shown every stretch of the way that lies in a medium that scatters everywhere alike.
pub fn fly_watched(
    world: &World,
    ray: &Ray,
    visible: u8,
    set: &mut MediumSet,
    throughput: Spectrum,
    sampler: &mut Sampler,
    stats: &mut Stats,
    watch: impl FnMut(&Stretch<'_>),
) -> (Flown, Spectrum) {
    let mut flights = Flights { sampler, throughput, lanes: world.lanes, emitted: Spectrum::ZERO, watch };
    let flown = walk(world, ray, visible, set, &mut flights, stats);
    (flown, flights.emitted)
}

/// A straight part of a way, in one homogeneous medium that scatters.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<'a> {
    /// The medium.
    pub medium: &'a Medium,
    /// Its index.
    pub id: MediumId,
    /// All that the way is in.
    pub set: &'a MediumSet,
    /// From where, in which direction.
    pub ray: Ray,
    /// Length to the next crossing, scene units; may be infinite.
    pub way: f32,
    /// Length flown, scene units: to the next crossing, or to where the path scatters before it.
    pub flown: f32,
    /// Fraction of light left on the way to here.
    pub left: Spectrum,
}

/// What media do to a path between two crossings.
pub(crate) trait Between {
    /// Follows the path over `distance` along `ray`; `left` is what of its light has come that far, and is updated.
    ///
    /// Returns the distance at which it scatters; `None` where it arrives.
    ///
    /// - `set`: what the path is in, `medium` in force.
    fn pass(
        &mut self,
        set: &MediumSet,
        medium: &Medium,
        ray: &Ray,
        distance: f32,
        left: &mut Spectrum,
    ) -> Option<f32>;
}

/// Media dim the light and do nothing else.
struct Dimmed;

impl Between for Dimmed {
    fn pass(
        &mut self,
        _set: &MediumSet,
        medium: &Medium,
        ray: &Ray,
        distance: f32,
        left: &mut Spectrum,
    ) -> Option<f32> {
        *left *= volume::transmittance(medium, ray, distance);
        None
    }
}

/// Media scatter and shine.
struct Flights<'a, Watch> {
    sampler: &'a mut Sampler,
    throughput: Spectrum,
    lanes: usize,
    emitted: Spectrum,
    watch: Watch,
}

impl<Watch: FnMut(&Stretch<'_>)> Between for Flights<'_, Watch> {
    fn pass(
        &mut self,
        set: &MediumSet,
        medium: &Medium,
        ray: &Ray,
        distance: f32,
        left: &mut Spectrum,
    ) -> Option<f32> {
        if !medium.scatters() && !medium.shines() && medium.grid.is_none() {
            return Dimmed.pass(set, medium, ray, distance, left);
        }
        let flyer =
            Flyer { throughput: self.throughput * *left, lanes: self.lanes, u: self.sampler.next_2d() };
        let flight = flyer.fly(medium, ray, distance);
        if medium.grid.is_none() && medium.scatters() {
            let flown = flight.scatters_at.unwrap_or(distance);
            let id = set.active();
            (self.watch)(&Stretch { medium, id, set, ray: *ray, way: distance, flown, left: *left });
        }
        self.emitted += *left * flight.emitted;
        *left *= flight.weight;
        flight.scatters_at
    }
}

/// The walk that all others are.
pub(crate) fn walk(
    world: &World,
    ray: &Ray,
    visible: u8,
    set: &mut MediumSet,
    between: &mut impl Between,
    stats: &mut Stats,
) -> Flown {
    let mut ray = *ray;
    let mut transmittance = Spectrum::ONE;
    let mut distance = 0.0;
    for _ in 0..LONGEST_WALK {
        stats.rays += 1;
        let within = set.active();
        let medium = &world.media[within.index()];
        let candidate = world.geometry.closest(&ray, visible);
        let way = candidate.as_ref().map_or(f32::INFINITY, |candidate| candidate.t);
        if let Some(t) = between.pass(set, medium, &ray, way, &mut transmittance) {
            let distance = distance + t;
            return Flown::Scattered(VolumeVertex {
                p: ray.at(t),
                medium: within,
                weight: transmittance,
                distance,
            });
        }
        let Some(candidate) = candidate else {
            return Flown::Arrived(Event::Sky { transmittance });
        };
        let (mut hit, encounter) =
            world.meet(&ray, &candidate, set, visible, &mut |object| stats.count_never_entered(object));
        distance += hit.t;
        let face = world.face(&ray, &hit, &encounter);
        let Some(straight) = world.straight_through(&face, &hit, &encounter) else {
            if let Some(relief) = face.relief {
                hit.n = relief.normal(&world.textures, &hit, &world.geometry.tangents(&hit));
            }
            let item = &world.items[hit.item as usize];
            return Flown::Arrived(Event::Surface(Vertex {
                bsdf: world.surface_bsdf(&face, &ray, &hit, &encounter, within),
                object: item.object,
                light: item.light,
                straight_shadows: face.straight_shadows,
                hit,
                transmittance,
                distance,
                encounter,
            }));
        };
        transmittance *= straight;
        encounter.commit(world, set);
        ray.origin = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        ray.t_max -= hit.t;
    }
    Flown::Arrived(Event::Sky { transmittance: Spectrum::ZERO })
}
