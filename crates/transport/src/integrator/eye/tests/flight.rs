//! The renderer's own photons on their way through a stage, vertex by vertex.

use super::by_hand::{End, Finish, Ray as HandRay, Shape, Turn};
use super::scenes::{LAMP_RADIUS, Stage};
use super::ways::Lamp;
use crate::integrator::merging::{Light as Photons, Photon};
use crate::photon::specular::is_specular_event;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex, VolumeVertex};
use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::Light;
use hyaline_world::mask;
use std::f64::consts::PI;

/// Shortest way between vertices, scene units: over shorter ones f32 can't make a path again.
const SHORTEST: f32 = 0.1;
/// Most vertices of a way: longer ones say nothing new.
const LONGEST: usize = 6;

/// Where a photon has come to.
#[derive(Clone)]
pub(super) enum Place {
    Surface(Box<Vertex>),
    Volume(VolumeVertex),
}

impl Place {
    pub(super) fn p(&self) -> Vec3 {
        match self {
            Self::Surface(vertex) => vertex.hit.p,
            Self::Volume(place) => place.p,
        }
    }

    /// What paths and photons can do there, by hand, but for the directions.
    fn known(&self, stage: &Stage) -> (Shape, Finish) {
        match self {
            Self::Surface(vertex) => stage.shape_at(vertex.hit.p.as_dvec3()),
            Self::Volume(place) => (Shape::Plane { p: place.p.as_dvec3(), n: DVec3::Y }, stage.particle),
        }
    }
}

/// A photon as it arrives at a vertex.
pub(super) struct Arrival<'w> {
    pub(super) photon: Photon<'w>,
    pub(super) place: Place,
}

/// A photon's way.
pub(super) struct Flight<'w> {
    /// The way of the photon as it leaves its light.
    pub(super) start: Ray,
    /// At every vertex, singular ones too; it stays at the last one.
    pub(super) arrivals: Vec<Arrival<'w>>,
    /// What it does at all but the last one.
    pub(super) turns: Vec<Turn>,
}

/// Lets a photon fly to where it stays, which is not singular; `None` where it comes to no such place.
///
/// - `is_aimed`: which sender sends it.
pub(super) fn fly<'w>(
    stage: &Stage,
    photons: &'w Photons<'w>,
    is_aimed: bool,
    index: u32,
) -> Option<Flight<'w>> {
    let mut sampler = Sampler::new(SamplerKind::Independent, 1, (index, 0), 0);
    let mut photon = photons.start(photons.senders.of(is_aimed), 0, &mut sampler)?;
    let mut flight = Flight { start: photon.ray, arrivals: Vec::new(), turns: Vec::new() };
    while flight.turns.len() <= LONGEST {
        let from = photon.ray.origin;
        let place = next_place(photons, &mut photon, &mut sampler)?;
        // Where the plate is open, at its edge, light comes in unseen.
        let before = (place.p() - photon.ray.direction * 1e-3).as_dvec3();
        let is_sound = stage.ior_at(before) == f64::from(photons.world.ior(photon.set.active()));
        if !is_sound || place.p().distance(from) < SHORTEST {
            return None;
        }
        let is_drawn = match &place {
            Place::Surface(vertex) => !vertex.bsdf.is_delta(),
            Place::Volume(_) => true,
        };
        flight.arrivals.push(Arrival { photon: photon.clone(), place: place.clone() });
        if is_drawn && sampler.next_1d() < 0.35 {
            let is_specular =
                matches!(&place, Place::Surface(vertex) if is_specular_event(&vertex.bsdf, false));
            return (!flight.turns.is_empty() || is_specular == is_aimed).then_some(flight);
        }
        let turn = turn(stage, photons, &mut photon, &place, &mut sampler)?;
        flight.turns.push(turn);
    }
    None
}

/// To the next surface, or to a place on the way there.
fn next_place(photons: &Photons<'_>, photon: &mut Photon<'_>, sampler: &mut Sampler) -> Option<Place> {
    let (world, before) = (photons.world, photon.set.clone());
    let event = walk::advance(world, &photon.ray, mask::PATH, &mut photon.set, &mut Stats::default());
    let stops = sampler.next_1d() < 0.5;
    let medium = before.active();
    if stops && world.media[medium.index()].scatters() {
        let way = if let Event::Surface(vertex) = &event { vertex.distance } else { 1.0 };
        // From afar it is in the midst of things only at the end of its way.
        let distance = if way > 10.0 { way - 0.3 } else { 0.4 * way };
        photon.set = before;
        let p = photon.ray.at(distance);
        if world.media[medium.index()].density(p) == 0.0 {
            return None;
        }
        return Some(Place::Volume(VolumeVertex { p, medium, weight: Spectrum::ONE, distance }));
    }
    match event {
        Event::Surface(vertex) => Some(Place::Surface(vertex.into())),
        Event::Sky { .. } => None,
    }
}

/// Sends a photon on; returns what it has done, by hand.
fn turn(
    stage: &Stage,
    photons: &Photons<'_>,
    photon: &mut Photon<'_>,
    place: &Place,
    sampler: &mut Sampler,
) -> Option<Turn> {
    let world = photons.world;
    let wo = -photon.ray.direction;
    let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
    let ior_before = f64::from(world.ior(photon.set.active()));
    let p = place.p().as_dvec3();
    let transmits = match place {
        Place::Surface(vertex) => {
            let scattered = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance)?;
            let is_specular = is_specular_event(&vertex.bsdf, scattered.is_delta);
            if photon.vertices == 0 && is_specular != photon.sender.is_aimed {
                return None;
            }
            photons.turn(photon, vertex, &scattered);
            scattered.transmits
        }
        Place::Volume(place) => {
            if photon.vertices == 0 && photon.sender.is_aimed {
                return None;
            }
            let phase = &world.media[place.medium.index()].phase;
            let wi = phase.sample(wo, u);
            photons.turn_at_place(photon, place, wi, phase.value(wo, wi));
            false
        }
    };
    let (shape, finish) = place.known(stage);
    Some(Turn {
        shape,
        p,
        to_light: wo.as_dvec3().normalize(),
        to_receiver: photon.ray.direction.as_dvec3().normalize(),
        ior: [ior_before, world.ior(photon.set.active()).into()],
        transmits,
        finish,
    })
}

impl Flight<'_> {
    /// The last vertex, seen by the eye.
    ///
    /// - `to_eye`: unit; `ior`: on the side of the light and of the eye.
    pub(super) fn seen(&self, stage: &Stage, to_eye: Vec3, ior: [f64; 2], transmits: bool) -> Turn {
        let last = self.last();
        let (shape, finish) = last.place.known(stage);
        Turn {
            shape,
            p: last.place.p().as_dvec3(),
            to_light: -last.photon.ray.direction.as_dvec3().normalize(),
            to_receiver: to_eye.as_dvec3().normalize(),
            ior,
            transmits,
            finish,
        }
    }

    pub(super) fn last(&self) -> &Arrival<'_> {
        self.arrivals.last().expect("a photon arrives somewhere")
    }

    /// Set of the photon that arrives last.
    pub(super) fn set(&self) -> &MediumSet {
        &self.last().photon.set
    }

    /// The photon's light, by hand as far as its shape is simple.
    pub(super) fn lamp(&self, stage: &Stage) -> Lamp {
        let Photon { origin: start, sender, .. } = &self.last().photon;
        let (lights, index) = (&stage.world.lights, start.light as usize);
        let light = lights.get(index);
        let origin = start.p.as_dvec3();
        let direction = self.start.direction.as_dvec3().normalize();
        let chance = lights.emission().probability(index) / sender.emitter.fraction();
        let own = light.pdf_emission(start.n.unwrap_or(Vec3::Y), self.start.direction);
        let area = PI * LAMP_RADIUS.powi(2);
        let down = End::Surface(Shape::Plane { p: origin, n: DVec3::NEG_Y });
        let (end, emission, direct) = match (light, start.n.map(|n| n.as_dvec3())) {
            (Light::Shape(_), Some(n)) => {
                let end = End::Surface(Shape::Plane { p: origin, n });
                (end, [1.0 / area, n.dot(direction) / PI], 1.0 / area)
            }
            (Light::Point(_), _) => (down, [1.0, 0.25 / PI], 1.0),
            (Light::Environment(_), _) => (End::Infinity, [own.position.into(), 0.25 / PI], 0.25 / PI),
            (Light::Directional(_), _) => (End::Infinity, [own.position.into(), 1.0], 1.0),
            _ => (down, [1.0, own.direction.into()], 1.0),
        };
        Lamp {
            start: HandRay { origin, direction },
            end,
            is_delta: !light.can_be_met(),
            photons: sender.count.into(),
            lamps: lights.lights().len(),
            chances: [chance, lights.direct().probability(index)].map(f64::from),
            emission,
            direct,
        }
    }
}
