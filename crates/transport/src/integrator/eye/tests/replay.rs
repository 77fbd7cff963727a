//! Paths of the renderer's own photons, and the same paths made again from the eye, to see what each way counts.

use super::by_hand::Finish;
use super::flight::{Arrival, Flight, Place, fly};
use super::scenes::{SIZE, Stage};
use super::ways::{Chain, Shares};
use crate::RenderSettings;
use crate::integrator::View;
use crate::integrator::eye::along::Along;
use crate::integrator::eye::asking;
use crate::integrator::eye::radius::GatherRadius;
use crate::integrator::eye::{Eye, Path};
use crate::integrator::merging::{Beam, Light as Photons, Passing, Photons as Merged, Senders};
use crate::photon::radius::Shrink;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex, VolumeVertex};
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec2, Vec3};
use hyaline_scattering::volume::BeamWeight;
use hyaline_scattering::{BsdfSample, Transport};
use hyaline_scene::PixelFilter as FilterDescription;
use hyaline_spectrum::Spectrum;
use hyaline_testkit::Random;
use hyaline_world::camera::PixelFilter;
use hyaline_world::light::{DirectSample, Light, LightChoice, LightPoint};
use hyaline_world::mask;

/// A pass so late that no way makes all paths alone.
const PASS: u32 = 4_000_000;

/// What the paths of the first photons count, by the renderer and by hand, with the photon's number.
pub(super) fn compare_all(
    stage: &Stage,
    photons: u32,
    paths: usize,
    mut each: impl FnMut(u32, &Chain, &Shares, &Shares),
) -> usize {
    let (world, settings) = (&stage.world, RenderSettings::default());
    let view =
        View { camera: 0, width: SIZE.0, height: SIZE.1, filter: PixelFilter::new(&FilterDescription::Box) };
    let senders = Senders::new(world, &view, settings.techniques);
    let radius = GatherRadius::new(&world.cameras[0], Shrink::of_pass(PASS));
    let sent = Photons { world, senders: &senders, settings: &settings, radius };
    let landed = sent.trace(PASS, &mut Stats::default());
    let merged = Merged { senders: &senders, landed: &landed, radius };
    let eye = Eye { world, settings: &settings, aim: None, photons: Some(merged) };
    let found = (0..photons).filter_map(|index| {
        let flight = fly(stage, &sent, index % 2 == 0, index)?;
        let mut random = Random::from_seed(u64::from(index));
        let (chain, found) =
            Replay { stage, eye: &eye, merged: &merged, flight: &flight }.run(&mut random)?;
        let known = chain.shares();
        // A path whose neighbors meet other surfaces has no derivative to compare with.
        let is_smooth = chain.is_steady() && known.all().all(f64::is_finite);
        is_smooth.then_some((index, chain, found, known))
    });
    found.take(paths).inspect(|(index, chain, found, known)| each(*index, chain, found, known)).count()
}

/// A photon's path, to be made again from the eye.
struct Replay<'a> {
    stage: &'a Stage,
    eye: &'a Eye<'a>,
    merged: &'a Merged<'a>,
    flight: &'a Flight<'a>,
}

impl Replay<'_> {
    /// What the ways of the path count by the renderer, and what is known of it; `None` where it makes no path to test.
    fn run(&self, random: &mut Random) -> Option<(Chain, Shares)> {
        let Self { stage, eye, flight, .. } = *self;
        let to_eye = Vec3::from_array([0; 3].map(|_| random.between(-1.0, 1.0) as f32)).try_normalize()?;
        let (mut path, transmits) = self.start(to_eye);
        let ior_of_eye = eye.world.ior(path.set.active());
        let mut shares = Shares { hit: 0.0, sample: 0.0, merges: vec![0.0; flight.arrivals.len()] };
        let ior_of_light = eye.world.ior(flight.set().active());
        let mut turns = flight.turns.clone();
        turns.push(flight.seen(stage, to_eye, [ior_of_light, ior_of_eye].map(f64::from), transmits));
        for (i, arrival) in flight.arrivals.iter().enumerate().rev() {
            let wi = turns[i].to_light.as_vec3();
            match &arrival.place {
                Place::Volume(place) => {
                    let wo = -path.ray.direction;
                    shares.merges[i] = self.merge_in_medium(&path, arrival, place).into();
                    if i == 0 {
                        shares.sample = self.sample_in_fog(&path, place, wo)?.into();
                    }
                    let phase = eye.world.media[place.medium.index()].phase.value(wo, wi);
                    eye.turn_at_place(&mut path, place, wi, phase);
                }
                Place::Surface(_) => {
                    let vertex = self.arrive(&mut path, arrival.place.p())?;
                    if vertex.bsdf.is_delta() {
                        self.turn_polished(&mut path, &vertex, turns[i].transmits)?;
                        continue;
                    }
                    let wo = -path.ray.direction;
                    let pdf = vertex.bsdf.pdf(wo, wi);
                    if pdf == 0.0 {
                        return None;
                    }
                    if arrival.photon.lands() {
                        let gather = self.eye.gathers(&path, &vertex, wo, self.merged);
                        let gather = gather[usize::from(arrival.photon.is_indirect)];
                        shares.merges[i] = gather.weight_of(wi, pdf, arrival.photon.others).into();
                    }
                    if i == 0 {
                        shares.sample = self.sample(&path, &vertex, wo)?.into();
                    }
                    let (weight, transmits) = (Spectrum::ONE, turns[i].transmits);
                    let known = BsdfSample { wi, weight, pdf, is_delta: false, transmits, eta_scale: 1.0 };
                    eye.turn(&mut path, &vertex, &known);
                }
            }
        }
        shares.hit = self.hit(&mut path)?.into();
        let radii = self.radii(&turns.iter().map(|turn| turn.finish).collect::<Vec<_>>());
        let chain = Chain { lamp: flight.lamp(stage), turns, radii, sigma: stage.sigma_t };
        Some((chain, shares))
    }

    /// A path on its way to where the photon stays, and whether light crosses a surface there to come to it.
    fn start(&self, to_eye: Vec3) -> (Path, bool) {
        let Self { eye, flight, .. } = *self;
        let (last, set) = (flight.last(), flight.set().clone());
        match &last.place {
            Place::Volume(place) => (eye.start(Ray::new(place.p + to_eye, -to_eye), set), false),
            Place::Surface(landed) => {
                let mut path = eye.start(Ray::new(landed.hit.p + to_eye * 0.05, -to_eye), set);
                let transmits = crosses(landed.hit.ng, to_eye, -last.photon.ray.direction);
                if transmits {
                    path.set = landed.far_set(eye.world, &path.set);
                }
                (path, transmits)
            }
        }
    }

    /// Walks on to the place where the photon was.
    fn arrive(&self, path: &mut Path, p: Vec3) -> Option<Vertex> {
        match self.advance(path) {
            Event::Surface(vertex) => (vertex.hit.p.distance(p) < 1e-4).then_some(vertex),
            Event::Sky { .. } => None,
        }
    }

    fn advance(&self, path: &mut Path) -> Event {
        walk::advance(self.eye.world, &path.ray, mask::PATH, &mut path.set, &mut Stats::default())
    }

    fn turn_polished(&self, path: &mut Path, vertex: &Vertex, transmits: bool) -> Option<()> {
        let wo = -path.ray.direction;
        let choose = |u_lobe| vertex.bsdf.sample(wo, u_lobe, Vec2::splat(0.5), Transport::Radiance);
        let mut branches = [choose(0.0), choose(0.999_999_9)].into_iter().flatten();
        let scattered = branches.find(|branch| branch.transmits == transmits)?;
        self.eye.turn(path, vertex, &scattered);
        Some(())
    }

    /// What merging counts at a particle.
    fn merge_in_medium(&self, path: &Path, arrival: &Arrival<'_>, place: &VolumeVertex) -> f32 {
        let (photon, medium) = (&arrival.photon, &self.eye.world.media[place.medium.index()]);
        if medium.grid.is_none() {
            return self.merge_beam(path, arrival, place);
        }
        if !photon.lands() {
            return 0.0;
        }
        let phase = medium.phase.value(-path.ray.direction, -photon.ray.direction);
        self.eye.points_about(path, place, self.merged).weight_of(phase, photon.others)
    }

    /// What merging the photon's beam counts where it passes the path.
    fn merge_beam(&self, path: &Path, arrival: &Arrival<'_>, place: &VolumeVertex) -> f32 {
        let (photon, world) = (&arrival.photon, self.eye.world);
        if !photon.beams_count() {
            return 0.0;
        }
        let medium = &world.media[place.medium.index()];
        let beam = Beam {
            origin: photon.ray.origin,
            direction: photon.ray.direction,
            length: f32::INFINITY,
            medium: place.medium,
            flux: Spectrum::ONE,
            weight: BeamWeight::new(medium, Spectrum::ONE, world.lanes),
            straight_from: photon.straight_from(),
            others: photon.others,
            bounces: photon.bounces,
            id: photon.id,
        };
        let sin = path.ray.direction.cross(beam.direction).length();
        let on_ray = path.ray.origin.distance(place.p);
        let radius = self.merged.radius.of_beams(place.p);
        let passing = Passing { on_ray, on_beam: beam.origin.distance(place.p), sin, radius };
        let along = Along {
            photons: self.merged,
            world,
            throughput: Spectrum::ONE,
            merges: path.merges,
            bounces: path.bounces,
            bounces_left: u32::MAX,
        };
        let phase = medium.phase.value(-path.ray.direction, -beam.direction);
        along.weight_of(&beam, &passing, &path.ray, medium, phase)
    }

    /// Gather radii at the vertices.
    fn radii(&self, finishes: &[Finish]) -> Vec<f64> {
        let radius = &self.merged.radius;
        let of = |(arrival, finish): (&Arrival<'_>, &Finish)| match finish {
            Finish::Fog(_) => radius.of_beams(arrival.place.p()),
            Finish::Smoke(_) => radius.in_volume(arrival.place.p()),
            _ => radius.on_surface(arrival.place.p()),
        };
        self.flight.arrivals.iter().zip(finishes).map(of).map(f64::from).collect()
    }

    /// What hitting the light counts.
    fn hit(&self, path: &mut Path) -> Option<f32> {
        let index = self.flight.last().photon.origin.light as usize;
        match (self.advance(path), self.eye.world.lights.get(index)) {
            (Event::Surface(vertex), Light::Shape(_)) => {
                Some(self.eye.hit_weight(path, vertex.light? as usize, Some(&vertex.hit)))
            }
            (Event::Sky { .. }, Light::Environment(_)) => Some(self.eye.hit_weight(path, index, None)),
            (_, light) if !light.can_be_met() => Some(0.0),
            _ => None,
        }
    }

    /// What sampling the photon's place on its light counts.
    fn sample(&self, path: &Path, vertex: &Vertex, wo: Vec3) -> Option<f32> {
        let (choice, sample) = self.light_sample(vertex.hit.p, path.bounces)?;
        let set = match crosses(vertex.hit.ng, wo, sample.wi) {
            true => vertex.far_set(self.eye.world, &path.set),
            false => path.set.clone(),
        };
        Some(self.eye.sample_weight(path, vertex, wo, vertex.bsdf.pdf(wo, sample.wi), &choice, &sample, &set))
    }

    fn sample_in_fog(&self, path: &Path, place: &VolumeVertex, wo: Vec3) -> Option<f32> {
        let (choice, sample) = self.light_sample(place.p, path.bounces)?;
        let phase = self.eye.world.media[place.medium.index()].phase.value(wo, sample.wi);
        Some(self.eye.sample_weight_in_volume(path, place, wo, &choice, &sample, phase))
    }

    /// The sample that light sampling would have made of the photon's start.
    ///
    /// - `bounces`: of the path before `p`.
    fn light_sample(&self, p: Vec3, bounces: u32) -> Option<(LightChoice, DirectSample)> {
        let start = &self.flight.last().photon.origin;
        let lights = &self.eye.world.lights;
        let index = start.light as usize;
        let light = lights.get(index);
        let (radiance, is_delta) = (Spectrum::ONE, false);
        let sample = match (light, start.n) {
            (Light::Shape(_), Some(n)) => {
                let (wi, distance) = ((start.p - p).normalize(), start.p.distance(p));
                let at = SurfaceHit {
                    t: 0.0,
                    p: start.p,
                    p_error: 0.0,
                    ng: n,
                    n,
                    uv: Vec2::ZERO,
                    item: 0,
                    primitive: 0,
                };
                let target = Some(LightPoint { p: start.p, p_error: 0.0, n });
                let pdf_w = light.pdf_direct(p, wi, Some(&at));
                DirectSample { wi, distance, target, radiance, pdf_w, is_delta }
            }
            (Light::Environment(_), _) => {
                let wi = -self.flight.start.direction;
                let (distance, pdf_w) = (f32::INFINITY, light.pdf_direct(p, wi, None));
                DirectSample { wi, distance, target: None, radiance, pdf_w, is_delta }
            }
            _ => light.sample_direct(p, Vec2::splat(0.5))?,
        };
        let choice =
            LightChoice { index, probability: asking::expected(self.eye.world, index, bounces), u: 0.5 };
        Some((choice, sample))
    }
}

fn crosses(n: Vec3, a: Vec3, b: Vec3) -> bool {
    (n.dot(a) > 0.0) != (n.dot(b) > 0.0)
}
