//! Where light may come from over polished surfaces: directions in which a wide surface asks for it (`aimed`).
//!
//! A path finds the light of a caustic only if it leaves a wide surface just so that polished ones lead it to a lamp; drawn
//! from the finish, few directions do. So the surface asks in directions of its own, drawn from cones:
//!
//! - along the beams that photons have come in to just about here (`learned`, `beam`);
//! - where none have, and in media: about each polished object that looks small, and about each lamp that one may stand
//!   before; those are nested, for glass may bend the way a little or much.

mod ball;
mod beam;
mod cones;
mod learned;

pub(super) use cones::Cones;

use crate::RenderSettings;
use crate::stats::Stats;
use crate::walk::Vertex;
use ball::{Ball, MOST_OBJECTS, View, ball_about, merged, versine_of};
use hyaline_math::Vec3;
use hyaline_world::World;
use learned::{LEAST_CHANCE, Learned};
use smallvec::SmallVec;
use std::sync::atomic::AtomicBool;

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
    /// Chance of asking where no photons are known to have landed.
    chance: f32,
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
        Self { objects, lamps, learned: Learned::default(), chance: 1.0 }
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
        let learned = Learned::new(world, pixels, settings, cancel, stats);
        Self { chance: if learned.is_empty() { 1.0 } else { LEAST_CHANCE }, learned, ..aim }
    }

    /// The cones that a surface tries; `None` where aim would not help.
    ///
    /// - `wo`: where the path came from, unit.
    pub(super) fn at_surface(&self, vertex: &Vertex, wo: Vec3) -> Option<Cones> {
        if !vertex.bsdf.is_opaque() {
            return None;
        }
        let n = if wo.dot(vertex.hit.ng) < 0.0 { -vertex.hit.ng } else { vertex.hit.ng };
        let p = vertex.hit.p;
        self.learned_cones(p, n).or_else(|| self.cones(p, self.chance, |view| view.rises_over(n)))
    }

    /// Toward where photons have come from, and now and then anywhere on polished objects: few photons don't show
    /// all ways.
    fn learned_cones(&self, p: Vec3, n: Vec3) -> Option<Cones> {
        let (sources, chance) = self.learned.at(p);
        let mut cones = Cones::new(chance);
        for source in sources {
            let axis = source.beam.axis(p);
            if source.beam.rises_over(axis, n) {
                cones.push(axis, source.beam.core, source.share * CORE);
                cones.push(axis, source.beam.whole, source.share * (1.0 - CORE));
            }
        }
        if cones.total == 0.0 {
            return None;
        }
        let views = self.objects.iter().map(|ball| View::new(ball, p)).filter(|view| view.rises_over(n));
        for view in views {
            cones.push(view.axis, view.versine(), ANYWHERE / self.objects.len() as f32);
        }
        Some(cones)
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
