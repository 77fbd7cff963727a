//! Lights at infinity: from which places of the disc that covers the scene to emit in which directions.
//!
//! A directional light has one disc, and a grid of yes and no over it. The surroundings have a disc for each block of
//! directions, its frame turned along with the direction within the block: what a target's shadow on the disc moves
//! by, when the direction turns, is added to its radius. Blocks are chosen by their light times the share of their
//! yes cells.

use super::Departure;
use super::ball::Ball;
use super::grid::Grid;
use super::turn::turned_frame;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec2, Frame, Vec2};
use hyaline_world::light::{DirectionalLight, DiscPatch, EnvironmentLight, RestrictedSky, SceneSphere};
use rayon::prelude::*;

/// A directional light's disc by yes and no.
#[derive(Clone, Debug)]
pub(in crate::photon) struct DiscCells {
    frame: Frame,
    grid: Grid,
}

impl DiscCells {
    /// - `cells`: cells along each axis, even.
    pub(super) fn new(light: &DirectionalLight, targets: &[Ball], cells: u32) -> Self {
        let frame = Frame::from_normal(light.direction);
        Self { frame, grid: disc_grid(&light.scene, &frame, 0.0, targets, cells) }
    }

    pub(super) fn kept(&self) -> f64 {
        self.grid.fraction()
    }

    pub(super) fn emit(&self, light: &DirectionalLight, u_position: Vec2) -> Option<Departure> {
        let origin = light.scene.point_of_disc(&self.frame, self.grid.sample(u_position)?);
        let flux = light.irradiance * light.scene.disc_area();
        Some(Departure::bare(origin, light.direction, flux).scaled(self.kept()))
    }

    pub(super) fn memory(&self) -> usize {
        self.grid.memory()
    }
}

/// The surroundings by yes and no.
#[derive(Clone, Debug)]
pub(in crate::photon) struct SkyCells {
    sky: RestrictedSky,
    /// By block of directions, with the frame about the direction that light of its middle travels in.
    discs: Vec<(Frame, Grid)>,
}

impl SkyCells {
    /// - `blocks`: blocks of directions along each axis.
    /// - `cells`: cells of their discs along each axis, even.
    ///
    /// `None` where nothing can be met.
    pub(super) fn new(light: &EnvironmentLight, targets: &[Ball], blocks: u32, cells: u32) -> Option<Self> {
        let blocks = light.blocks(blocks);
        let disc = |index: u32| {
            let cone = light.cone_of_block(blocks, [index % blocks[0], index / blocks[0]]);
            let frame = Frame::from_normal(-cone.axis.as_vec3());
            let chord = 2.0 * float::sin(0.5 * cone.half_angle);
            (frame, disc_grid(light.scene(), &frame, chord, targets, cells))
        };
        let discs: Vec<(Frame, Grid)> = (0..blocks[0] * blocks[1]).into_par_iter().map(disc).collect();
        let factors: Vec<f32> = discs.iter().map(|(_, grid)| grid.fraction() as f32).collect();
        Some(Self { sky: light.restricted(blocks, &factors)?, discs })
    }

    pub(super) fn kept(&self) -> f64 {
        self.sky.kept
    }

    pub(super) fn emit(
        &self,
        light: &EnvironmentLight,
        u_position: Vec2,
        u_direction: Vec2,
    ) -> Option<Departure> {
        let direction = light.sample_restricted(&self.sky, u_direction);
        let (frame, grid) = &self.discs[direction.block];
        let frame = turned_frame(frame, -direction.from);
        let origin = light.scene().point_of_disc(&frame, grid.sample(u_position)?);
        let flux = light.irradiance_of(&direction) * light.scene().disc_area();
        Some(Departure::bare(origin, frame.n, flux).scaled(grid.fraction()))
    }

    pub(super) fn memory(&self) -> usize {
        self.discs.iter().map(|(_, grid)| size_of::<(Frame, Grid)>() + grid.memory()).sum::<usize>()
            + self.sky.memory()
    }
}

/// The grid of a disc that covers the scene.
///
/// - `frame`: about the direction that the light travels in.
/// - `chord`: distance between the frame's directions and the same ones turned, at most; 0…2.
fn disc_grid(scene: &SceneSphere, frame: &Frame, chord: f64, targets: &[Ball], cells: u32) -> Grid {
    let shadows: Vec<Ball> = targets.iter().map(|target| shadow(scene, frame, chord, target)).collect();
    Grid::new(cells, &shadows, &|unit_box| {
        let (center, radius) = DiscPatch::of_box(unit_box).disc();
        move |shadow: &Ball| center.distance(shadow.center.truncate()) <= radius + shadow.radius
    })
}

/// The shadow of a target on the disc, in units of the disc's radius; its height is 0.
fn shadow(scene: &SceneSphere, frame: &Frame, chord: f64, target: &Ball) -> Ball {
    let scale = 1.0 / f64::from(scene.radius).max(f64::MIN_POSITIVE);
    let offset = target.center - scene.center.as_dvec3();
    let center = DVec2::new(frame.s.as_dvec3().dot(offset), frame.t.as_dvec3().dot(offset));
    let rounding = 2e-6 * (offset.length() + f64::from(scene.center.abs().max_element()));
    let radius = (target.radius + offset.length() * chord + rounding) * scale;
    Ball { center: (center * scale).extend(0.0), radius }
}
