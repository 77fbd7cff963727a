//! Where light may come from over polished surfaces: directions that a wide surface tries beside those of its finish.
//!
//! A path finds the light of a caustic only if it leaves a wide surface just so that polished ones lead it to a lamp; drawn
//! from the finish, few directions do. So some are drawn from cones instead:
//!
//! - about each polished object that looks small;
//! - about each lamp that a polished object may stand before: nested cones, for glass may bend the way a little or much.
//!
//! Both ways share their directions by MIS: one of the two is chosen at random, and its direction counts by the density of
//! the mixture. Source: Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, §9.2.4 (one-sample
//! model, balance heuristic).

mod ball;
mod cones;

pub(super) use cones::{Choice, Cones};

use crate::walk::Vertex;
use ball::{Ball, MOST_OBJECTS, View, ball_about, merged, versine_of};
use hyaline_math::Vec3;
use hyaline_world::World;
use smallvec::SmallVec;

/// Share of the directions that are aimed, where there is something to aim at.
const AIMED: f32 = 0.5;
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
        Self { objects, lamps }
    }

    /// The cones that a surface tries; `None` where aim would not help.
    ///
    /// - `wo`: where the path came from, unit.
    pub(super) fn at_surface(&self, vertex: &Vertex, wo: Vec3) -> Option<Cones> {
        if !vertex.bsdf.is_opaque() {
            return None;
        }
        let n = if wo.dot(vertex.hit.ng) < 0.0 { -vertex.hit.ng } else { vertex.hit.ng };
        self.cones(vertex.hit.p, |view| view.rises_over(n))
    }

    /// The cones that a particle of a medium tries.
    pub(super) fn at_place(&self, p: Vec3) -> Option<Cones> {
        self.cones(p, |_| true)
    }

    /// - `faces`: what can be reached.
    fn cones(&self, p: Vec3, faces: impl Fn(&View) -> bool) -> Option<Cones> {
        let mut cones = Cones::default();
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
