//! Where light may come from over polished surfaces: directions in which a wide surface asks for it (`aimed`).
//!
//! A path finds the light of a caustic only if it leaves a wide surface just so that polished ones lead it to a lamp; drawn
//! from the finish, few directions do. So the surface asks in directions of its own, drawn from cones:
//!
//! - along the beams that photons have come in to just about here (`learned`, `beam`);
//! - where none have, and in media: about each polished object that looks small, and about each lamp that one may stand
//!   before; those are nested, for glass may bend the way a little or much.
//!
//! What is bright with caustics lights other surfaces in turn. It is mostly small, and rarely found by chance: where photons
//! have shown it, paths go there more often (`onward`).

mod ball;
mod beam;
mod cones;
mod learned;
mod lesson;

pub(super) use cones::Cones;

use crate::RenderSettings;
use crate::stats::Stats;
use crate::walk::Vertex;
use ball::{Ball, MOST_OBJECTS, View, ball_about, merged, versine_of};
use hyaline_math::Vec3;
use hyaline_world::World;
use learned::{Learned, Source};
use lesson::{Arrival, Arrivals, arrivals, irradiance_of_lamps};
use smallvec::SmallVec;
use std::sync::atomic::AtomicBool;

/// Sources of caustic light that are told apart at a place, at most.
const MOST_SOURCES: usize = 12;
/// Sources of light that caustics throw on a place, at most: these are seen by chance, too.
const MOST_THROWN: usize = 4;
/// Variance that such a source makes where chance finds it, over the square of the light of the place, at least.
const LEAST_NOISE: f32 = 0.02;
/// Share of the directions in which paths go on along such beams, where there are no others.
const ALONG: f32 = 0.2;
/// Chance of asking for caustic light over the part that it is of the light of the place.
const EAGERNESS: f32 = 12.0;
/// That chance at least, and where no photons are known to have landed.
const LEAST_CHANCE: f32 = 0.1;
/// Share of polished objects as a whole, over that of all beams that photons have shown.
const ANYWHERE: f32 = 0.05;
/// Share of the core of a beam.
const CORE: f32 = 0.6;
/// Lamps, at most: the strongest.
const MOST_LAMPS: usize = 4;
/// Versine of the widest cone about an object that is worth it: wider ones are no better than a matte finish.
const WIDEST: f32 = 0.25;
/// What glass may bend the way to a lamp by, radians.
const BENDS: [f32; 3] = [0.02, 0.12, 0.35];
/// A lamp that looks larger than this angle, radians, is found without aim.
const LARGE_LAMP: f32 = 0.5;

/// What a scene's wide surfaces aim at.
#[derive(Clone, Debug, Default)]
pub(in crate::integrator) struct Aim {
    objects: Vec<Ball>,
    /// Lamps and the chance of each.
    lamps: Vec<(Ball, f32)>,
    learned: Learned,
    /// Of the light that caustics throw on other surfaces.
    thrown: Learned,
}

impl Aim {
    /// What there is to aim at; nothing where nothing is polished.
    pub(in crate::integrator) fn new(world: &World) -> Self {
        let ball = |item: u32| ball_about(&world.geometry.items()[item as usize].geometry);
        let objects = merged(world.specular_items().into_iter().map(ball).collect());
        let emission = world.lights.emission();
        let mut lamps: Vec<(Ball, f32)> = (0..world.items.len())
            .filter_map(|item| {
                let chance = emission.probability(world.items[item].light? as usize);
                (chance > 0.0).then(|| (ball(item as u32), chance))
            })
            .collect();
        lamps.sort_by(|a, b| b.1.total_cmp(&a.1));
        lamps.truncate(MOST_LAMPS);
        Self { objects, lamps, learned: Learned::default(), thrown: Learned::default() }
    }

    /// The same with what photons show, which are traced for it, unless the settings say not to.
    ///
    /// - `pixels`: of the picture.
    pub(in crate::integrator) fn taught(
        world: &World,
        pixels: u32,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Self {
        let aim = Self::new(world);
        if !settings.techniques.guiding {
            return aim;
        }
        let Arrivals { caustic, thrown } = arrivals(world, pixels, settings, cancel, stats);
        let lamps = |arrival: &Arrival, number| irradiance_of_lamps(world, arrival, number);
        let learned = Learned::new(caustic, MOST_SOURCES, lamps);
        let direct = |arrival: &Arrival, number| {
            let caustic = learned.at(arrival.landed).map_or(0.0, |cell| cell.irradiance);
            caustic + lamps(arrival, number)
        };
        let thrown = Learned::new(thrown, MOST_THROWN, direct).noisy(LEAST_NOISE);
        Self { learned, thrown, ..aim }
    }

    /// The cones that a surface tries; `None` where aim would not help.
    ///
    /// - `wo`: where the path came from, unit.
    pub(super) fn at_surface(&self, vertex: &Vertex, wo: Vec3) -> Option<Cones> {
        let (p, n) = opaque_side(vertex, wo)?;
        // Where photons are known to have landed elsewhere alone, there is little to ask for.
        let chance = if self.learned.is_empty() { 1.0 } else { LEAST_CHANCE };
        self.learned_cones(p, n).or_else(|| self.cones(p, chance, |view| view.rises_over(n)))
    }

    /// Toward where photons have come from, and now and then anywhere on polished objects: few photons don't show
    /// all ways.
    fn learned_cones(&self, p: Vec3, n: Vec3) -> Option<Cones> {
        let cell = self.learned.at(p)?;
        let mut cones = Cones::new((EAGERNESS * cell.part).clamp(LEAST_CHANCE, 1.0));
        cones.push_beams(&cell.sources, p, n);
        if cones.total == 0.0 {
            return None;
        }
        let views = self.objects.iter().map(|ball| View::new(ball, p)).filter(|view| view.rises_over(n));
        for view in views {
            cones.push(view.axis, view.versine(), ANYWHERE / self.objects.len() as f32);
        }
        Some(cones)
    }

    /// The cones along which a path goes on now and then, toward what is bright with caustics; their chance says how often.
    ///
    /// - `wo`: where the path came from, unit.
    pub(super) fn onward(&self, vertex: &Vertex, wo: Vec3) -> Option<Cones> {
        let (p, n) = opaque_side(vertex, wo)?;
        let mut cones = Cones::new(1.0);
        cones.push_beams(&self.thrown.at(p)?.sources, p, n);
        // What is left of the light comes from anywhere.
        let chance = ALONG * cones.total;
        (chance > 0.0).then(|| cones.with_chance(chance))
    }

    /// The cones that a particle of a medium tries.
    pub(super) fn at_place(&self, p: Vec3) -> Option<Cones> {
        self.cones(p, 1.0, |_| true)
    }

    /// - `chance`: of asking; `faces`: what can be reached.
    fn cones(&self, p: Vec3, chance: f32, faces: impl Fn(&View) -> bool) -> Option<Cones> {
        let mut cones = Cones::new(chance);
        let views: SmallVec<[View; MOST_OBJECTS]> =
            self.objects.iter().map(|ball| View::new(ball, p)).filter(&faces).collect();
        if views.is_empty() {
            return None;
        }
        for view in views.iter().filter(|view| view.versine() < WIDEST) {
            cones.push(view.axis, view.versine(), 1.0);
        }
        for (ball, chance) in &self.lamps {
            let lamp = View::new(ball, p);
            let is_small = lamp.sin < LARGE_LAMP;
            if is_small && faces(&lamp) && views.iter().any(|view| view.may_hide(&lamp)) {
                for bend in BENDS {
                    cones.push(lamp.axis, versine_of(lamp.sin + bend), chance / BENDS.len() as f32);
                }
            }
        }
        (cones.total > 0.0).then_some(cones)
    }
}

/// Where an opaque surface is, and its unit normal on the side that the path came from.
fn opaque_side(vertex: &Vertex, wo: Vec3) -> Option<(Vec3, Vec3)> {
    let n = if wo.dot(vertex.hit.ng) < 0.0 { -vertex.hit.ng } else { vertex.hit.ng };
    vertex.bsdf.is_opaque().then_some((vertex.hit.p, n))
}

impl Cones {
    /// Adds the beams of sources that reach the surface of the normal `n` at `p`, each by its share.
    fn push_beams(&mut self, sources: &[Source], p: Vec3, n: Vec3) {
        for Source { beam, share } in sources {
            let axis = beam.axis(p);
            if beam.rises_over(axis, n) {
                self.push(axis, beam.core, share * CORE);
                self.push(axis, beam.whole, share * (1.0 - CORE));
            }
        }
    }
}
