//! Paths of the renderer's own photons, and the same paths made again from the eye, to see what each way counts.

use super::by_hand::{End, Ray as HandRay, Shape, Turn};
use super::scenes::Stage;
use super::ways::{Chain, Lamp, Receiver, Shares};
use crate::integrator::eye::{Eye, Path, weight};
use crate::integrator::merging::{Photon, Photons, start, trace};
use crate::photon::PhotonEmitter;
use crate::photon::radius::Shrink;
use crate::photon::specular::is_specular;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex, VolumeVertex};
use crate::{RenderSettings, Techniques};
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec2, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scattering::{BsdfSample, MediumSet, Transport};
use hyaline_scene::ProjectionMaps;
use hyaline_spectrum::Spectrum;
use hyaline_testkit::Random;
use hyaline_world::camera::PixelSpread;
use hyaline_world::light::{DirectSample, Light, LightChoice, LightPoint};
use hyaline_world::mask;
use std::f64::consts::PI;

/// Photons of a pass.
const SENT: u32 = 4096;
/// Most vertices of a chain: longer ones say nothing new.
const LONGEST: usize = 5;
/// Gather radius, scene units.
const RADIUS: f32 = 0.01;

/// Where a photon has landed.
enum Landing {
    Surface(Box<Vertex>),
    Volume(VolumeVertex),
}

/// A photon's way.
struct Flight<'w> {
    photon: Photon<'w>,
    turns: Vec<Turn>,
    landing: Landing,
    /// What it has come through last.
    set: MediumSet,
}

/// What one path counts by the renderer and by hand; `None` where this photon makes no path to test.
fn compare(
    stage: &Stage,
    eye: &Eye<'_>,
    emitter: &PhotonEmitter<'_>,
    index: u32,
) -> Option<(Shares, Shares)> {
    let flight = fly(stage, emitter, index)?;
    let mut random = Random::from_seed(u64::from(index));
    let (path, merge, receiver) = receive(stage, eye, &flight, &mut random)?;
    let (hit, sample) = go_to_light(eye, path, &flight)?;
    let lamp = lamp(stage, emitter, &flight);
    let chain = Chain { lamp, turns: flight.turns, receiver };
    Some((Shares { hit, sample, merge }, chain.shares()))
}

/// What the paths of the first photons count, by the renderer and by hand, with the photon's number.
pub(super) fn compare_all(
    stage: &Stage,
    photons: u32,
    paths: usize,
    mut each: impl FnMut(u32, Shares, Shares),
) -> usize {
    let emitter = PhotonEmitter::new(&stage.world, ProjectionMaps::Cells, 16);
    let settings = RenderSettings::default();
    let landed = trace(&stage.world, &emitter, &settings, 0, SENT, &mut Stats::default());
    let merged = Photons { emitter: &emitter, landed: &landed, shrink: Shrink::of_pass(0) };
    let spread = PixelSpread { width: 0.0, angle: 0.0 };
    let eye = Eye { world: &stage.world, settings: &settings, spread, photons: Some(merged) };
    let found = (0..photons).filter_map(|index| {
        let (found, known) = compare(stage, &eye, &emitter, index)?;
        // A path whose neighbors meet other surfaces has no derivative to compare with.
        known.merge.is_finite().then_some((index, found, known))
    });
    found.take(paths).inspect(|&(index, found, known)| each(index, found, known)).count()
}

/// Lets a photon fly to where it may be merged.
fn fly<'w>(stage: &'w Stage, emitter: &PhotonEmitter<'_>, index: u32) -> Option<Flight<'w>> {
    let world = &stage.world;
    let mut sampler = Sampler::new(SamplerKind::Independent, 1, (index, 0), 0);
    let (mut photon, mut set) = start(world, emitter, Techniques::default(), &mut sampler, 1.0)?;
    let mut turns: Vec<Turn> = Vec::new();
    while turns.len() <= LONGEST {
        let before = set.clone();
        let mut stats = Stats::default();
        let event = walk::advance(world, &photon.ray, mask::PATH, &mut set, &mut stats);
        let stays = sampler.next_1d() < 0.5;
        let distance = if let Event::Surface(vertex) = &event { vertex.distance } else { 1.0 };
        let medium = before.active();
        if !turns.is_empty() && stays && world.media[medium.index()].scatters() {
            let distance = 0.4 * distance;
            let p = photon.ray.at(distance);
            let place = VolumeVertex { p, medium, weight: Spectrum::ONE, distance };
            return Some(Flight { photon, turns, landing: Landing::Volume(place), set: before });
        }
        let Event::Surface(vertex) = event else { return None };
        let is_wide = !is_specular(&vertex.bsdf);
        if !turns.is_empty() && !vertex.bsdf.is_delta() && (is_wide || stays) {
            return Some(Flight { photon, turns, landing: Landing::Surface(vertex.into()), set });
        }
        let wo = -photon.ray.direction;
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let scattered = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance).filter(|_| !is_wide)?;
        let ior_before = f64::from(world.ior(set.active()));
        photon.turn(world, &vertex, &mut set, &scattered);
        let p = vertex.hit.p.as_dvec3();
        if stage.ior_at(p + wo.as_dvec3() * 1e-3) != ior_before {
            // It has come in where the plate is open, at its edge.
            return None;
        }
        turns.push(Turn {
            shape: stage.shape_at(p),
            p,
            to_light: wo.as_dvec3().normalize(),
            to_receiver: scattered.wi.as_dvec3().normalize(),
            ior: [ior_before, world.ior(set.active()).into()],
            transmits: scattered.transmits,
            alpha: (!scattered.is_delta).then_some(stage.alpha),
        });
    }
    None
}

/// Brings a path of the eye to where the photon has landed; returns it on its way to the chain, and what merging counts.
fn receive(
    stage: &Stage,
    eye: &Eye<'_>,
    flight: &Flight<'_>,
    random: &mut Random,
) -> Option<(Path, f64, Receiver)> {
    let wi = -flight.photon.ray.direction;
    let others = flight.photon.others;
    let from = Vec3::from_array([0; 3].map(|_| random.between(-1.0, 1.0) as f32)).try_normalize()?;
    let (sent, area) = (SENT as f32, f64::from(SENT) * PI * f64::from(RADIUS).powi(2));
    match &flight.landing {
        Landing::Volume(place) => {
            let mut path = eye.start(Ray::new(place.p + from, -from), flight.set.clone());
            let phase = eye.world.media[place.medium.index()].phase.value(from, wi);
            let own = eye.volume_ratio(place, RADIUS, sent);
            let merge = weight::power(others / (own / phase).powi(2));
            eye.turn_at_place(&mut path, place, wi, phase, RADIUS);
            let (p, to_light) = (place.p.as_dvec3(), wi.as_dvec3().normalize());
            let cos = -from.as_dvec3().dot(to_light);
            let pdf = stage.henyey_greenstein(cos);
            let gathered = area * 4.0 / 3.0 * f64::from(RADIUS) * stage.sigma_t;
            let shape = Shape::Plane { p, n: to_light };
            Some((path, merge.into(), Receiver { p, shape, to_light, pdf, gathered }))
        }
        Landing::Surface(landed) => {
            // A path that ends where the photon did, from the photon's side or through the surface.
            let mut path = eye.start(Ray::new(landed.hit.p + from * 0.05, -from), flight.set.clone());
            if crosses(landed.hit.ng, from, wi) {
                path.set = landed.far_set(eye.world, &path.set);
            }
            let Event::Surface(vertex) = advance(eye, &mut path) else { return None };
            if vertex.hit.p.distance(landed.hit.p) > 1e-4 {
                return None;
            }
            let transmits = crosses(vertex.hit.ng, from, wi);
            let ior = eye.world.ior(path.set.active());
            let pdf = vertex.bsdf.pdf(from, wi);
            if pdf == 0.0 {
                return None;
            }
            let own = weight::at_receiver(sent, RADIUS, 1.0, 1.0, 1.0);
            let ratio = eye.photon_ratio(&path, &vertex, from, wi, own, ior);
            let merge = weight::power(others / (ratio * ratio));
            let is_wide = !is_specular(&vertex.bsdf);
            turn(eye, &mut path, &vertex, wi, pdf, transmits, is_wide);
            let (p, to_light) = (landed.hit.p.as_dvec3(), wi.as_dvec3().normalize());
            let shape = stage.shape_at(p);
            let ior = [f64::from(ior), eye.world.ior(path.set.active()).into()];
            let at = Turn {
                shape,
                p,
                to_light: from.as_dvec3().normalize(),
                to_receiver: to_light,
                ior,
                transmits,
                alpha: Some(stage.alpha),
            };
            let pdf = if is_wide { to_light.dot(landed.hit.ng.as_dvec3()).abs() / PI } else { at.pdf() };
            Some((path, merge.into(), Receiver { p, shape, to_light, pdf, gathered: area }))
        }
    }
}

/// Takes the path along the photon's way back to the light; returns what hitting it and sampling it count.
fn go_to_light(eye: &Eye<'_>, mut path: Path, flight: &Flight<'_>) -> Option<(f64, f64)> {
    let mut sample = 0.0;
    for (i, known) in flight.turns.iter().enumerate().rev() {
        let Event::Surface(vertex) = advance(eye, &mut path) else { return None };
        if vertex.hit.p.as_dvec3().distance(known.p) > 1e-4 {
            return None;
        }
        let wo = -path.ray.direction;
        if known.alpha.is_none() {
            let choose = |u_lobe| vertex.bsdf.sample(wo, u_lobe, Vec2::splat(0.5), Transport::Radiance);
            let mut branches = [choose(0.0), choose(0.999_999_9)].into_iter().flatten();
            let scattered = branches.find(|branch| branch.transmits == known.transmits)?;
            eye.turn(&mut path, &vertex, &scattered, false, RADIUS);
            continue;
        }
        let wi = known.to_light.as_vec3();
        if i == 0 {
            sample = sampled(eye, &path, &vertex, wo, flight)?;
        }
        let pdf = vertex.bsdf.pdf(wo, wi);
        turn(eye, &mut path, &vertex, wi, pdf, known.transmits, false);
    }
    let hit = match (advance(eye, &mut path), flight.photon.light) {
        (Event::Surface(vertex), Light::Shape(_)) => {
            eye.hit_weight(&path, vertex.light? as usize, Some(&vertex.hit))
        }
        (Event::Sky { .. }, Light::Environment(_)) => eye.hit_weight(&path, flight.photon.index, None),
        (_, light) if crate::direct::is_delta(light) => 0.0,
        _ => return None,
    };
    Some((hit.into(), sample))
}

/// What sampling the photon's place on its light counts.
fn sampled(eye: &Eye<'_>, path: &Path, vertex: &Vertex, wo: Vec3, flight: &Flight<'_>) -> Option<f64> {
    let Photon { light, index, start, .. } = &flight.photon;
    let p = vertex.hit.p;
    let free = |wi: Vec3, distance, target, pdf_w| DirectSample {
        wi,
        distance,
        target,
        radiance: Spectrum::ONE,
        pdf_w,
        is_delta: false,
    };
    let sample = match (light, start.n) {
        (Light::Shape(_), Some(n)) => {
            let (wi, distance) = ((start.origin - p).normalize(), start.origin.distance(p));
            let hit = SurfaceHit {
                t: 0.0,
                p: start.origin,
                p_error: 0.0,
                ng: n,
                n,
                uv: Vec2::ZERO,
                item: 0,
                primitive: 0,
            };
            let target = LightPoint { p: start.origin, p_error: 0.0, n };
            free(wi, distance, Some(target), light.pdf_direct(p, wi, Some(&hit)))
        }
        (Light::Environment(_), _) => {
            let wi = -start.ray.direction;
            free(wi, f32::INFINITY, None, light.pdf_direct(p, wi, None))
        }
        _ => light.sample_direct(p, Vec2::splat(0.5))?,
    };
    let choice =
        LightChoice { index: *index, probability: eye.world.lights.direct().probability(*index), u: 0.5 };
    let set = match crosses(vertex.hit.ng, wo, sample.wi) {
        true => vertex.far_set(eye.world, &path.set),
        false => path.set.clone(),
    };
    Some(eye.sample_weight(path, vertex, wo, false, &choice, &sample, &set).into())
}

/// The photon's light, by hand as far as its shape is simple.
fn lamp(stage: &Stage, emitter: &PhotonEmitter<'_>, flight: &Flight<'_>) -> Lamp {
    let Photon { light, index, start, .. } = &flight.photon;
    let lights = &stage.world.lights;
    let origin = start.origin.as_dvec3();
    let direction = start.ray.direction.as_dvec3().normalize();
    let chances =
        [lights.emission().probability(*index) / emitter.fraction(), lights.direct().probability(*index)];
    let own = light.pdf_emission(start.n.unwrap_or(Vec3::Y), start.ray.direction);
    let area = PI * super::scenes::LAMP_RADIUS.powi(2);
    let (end, emission, direct) = match (light, start.n.map(|n| n.as_dvec3())) {
        (Light::Shape(_), Some(n)) => {
            (End::Surface(Shape::Plane { p: origin, n }), [1.0 / area, n.dot(direction) / PI], 1.0 / area)
        }
        (Light::Point(_), _) => (End::Surface(Shape::Plane { p: origin, n: DOWN }), [1.0, 0.25 / PI], 1.0),
        (Light::Environment(_), _) => (End::Infinity, [own.position.into(), 0.25 / PI], 0.25 / PI),
        (Light::Directional(_), _) => (End::Infinity, [own.position.into(), 1.0], 1.0),
        _ => (End::Surface(Shape::Plane { p: origin, n: DOWN }), [1.0, own.direction.into()], 1.0),
    };
    Lamp {
        start: HandRay { origin, direction },
        end,
        is_delta: crate::direct::is_delta(light),
        chances: chances.map(f64::from),
        emission,
        direct,
    }
}

const DOWN: hyaline_math::DVec3 = hyaline_math::DVec3::NEG_Y;

fn advance(eye: &Eye<'_>, path: &mut Path) -> Event {
    walk::advance(eye.world, &path.ray, mask::PATH, &mut path.set, &mut Stats::default())
}

/// Sends a path on in a direction that is not drawn but known.
fn turn(eye: &Eye<'_>, path: &mut Path, vertex: &Vertex, wi: Vec3, pdf: f32, transmits: bool, is_wide: bool) {
    let known = BsdfSample { wi, weight: Spectrum::ONE, pdf, is_delta: false, transmits, eta_scale: 1.0 };
    eye.turn(path, vertex, &known, is_wide, RADIUS);
}

fn crosses(n: Vec3, a: Vec3, b: Vec3) -> bool {
    (n.dot(a) > 0.0) != (n.dot(b) > 0.0)
}
