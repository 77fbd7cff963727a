//! Lights that are a point: which directions to emit in.
//!
//! With cells, the square of random numbers that a direction is drawn with is cut into equal cells, and only those
//! whose directions may meet something specular are drawn from. As all cells of a light are equally likely, the flux
//! of each photon is what it was, times the share of the cells: for a point light that is the share of the solid
//! angle.

use super::Departure;
use super::ball::Ball;
use super::beam::Beam;
use super::grid::Grid;
use hyaline_math::Vec2;
use hyaline_world::light::Light;

/// Directions by yes and no.
#[derive(Clone, Debug)]
pub(in crate::photon) struct PointCells {
    grid: Grid,
}

impl PointCells {
    /// - `cells`: cells along each axis.
    pub(super) fn new(light: &Light, targets: &[Ball], cells: u32) -> Option<Self> {
        let origin = Ball { center: light.position()?.as_dvec3(), radius: 0.0 };
        let grid = Grid::new(cells, targets, &|unit_box| {
            let beam = Beam::new(origin, light.cone_of_emission(unit_box));
            move |target: &Ball| beam.may_meet(target)
        });
        Some(Self { grid })
    }

    pub(super) fn kept(&self) -> f64 {
        self.grid.fraction()
    }

    pub(super) fn emit(&self, light: &Light, u_position: Vec2, u_direction: Vec2) -> Option<Departure> {
        let sample = light.sample_emission(u_position, self.grid.sample(u_direction)?)?;
        Some(Departure::from(sample).scaled(self.kept()))
    }

    pub(super) fn memory(&self) -> usize {
        self.grid.memory()
    }
}
