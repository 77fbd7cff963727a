//! Projection maps: light that can't reach anything specular is not emitted.
//!
//! 1. `targets` finds what is specular and puts balls about its parts.
//! 2. For each light a map tells from which places in which directions a ball can be reached: cells that say yes or no
//!    (`point`, `lamp`, `distant`), or cones and discs about whole objects (`objects`). No cell says no unless none of
//!    its rays can reach a ball.
//! 3. Photons are drawn from what says yes, with the density of the light itself, and their flux is scaled by the
//!    share that this is of the whole.
//!
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, §5.3 (projection maps).

mod ball;
mod beam;
mod cluster;
mod distant;
mod grid;
mod lamp;
mod neighbors;
mod objects;
mod patch;
mod point;
mod targets;
#[cfg(test)]
mod tests;
mod turn;

use distant::{DiscCells, SkyCells};
use hyaline_geometry::ItemGeometry;
use hyaline_math::{Vec2, Vec3};
use hyaline_scene::ProjectionMaps;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use hyaline_world::light::{EmissionSample, Light};
use lamp::LampCells;
use objects::{Cones, Discs};
use point::PointCells;
use targets::Targets;

/// Cells along each axis, at most.
const MOST_CELLS: u32 = 1024;

/// The same for each of the many grids of a lamp or the surroundings.
const MOST_INNER_CELLS: u32 = 64;

/// Parts that all lamps together are cut into, about.
const LAMP_PARTS: u32 = 1024;

/// Parts that one lamp is cut into, at most.
const MOST_LAMP_PARTS: u32 = 256;

/// Cells of all lamps together, about.
const LAMP_CELLS: u32 = 1 << 22;

/// Light that leaves a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Departure {
    pub(super) origin: Vec3,
    /// Bound on the distance of `origin` from the light's true surface.
    pub(super) p_error: f32,
    /// Outward normal of the light's surface, if it has one.
    pub(super) n: Option<Vec3>,
    /// Unit.
    pub(super) direction: Vec3,
    /// W.
    pub(super) flux: Spectrum,
}

impl Departure {
    /// From a light without a surface.
    fn bare(origin: Vec3, direction: Vec3, flux: Spectrum) -> Self {
        Self { origin, p_error: 0.0, n: None, direction, flux }
    }

    fn scaled(self, factor: f64) -> Self {
        Self { flux: self.flux * factor as f32, ..self }
    }
}

impl From<EmissionSample> for Departure {
    fn from(sample: EmissionSample) -> Self {
        let EmissionSample { origin, p_error, n, direction, weight: flux, .. } = sample;
        Self { origin, p_error, n, direction, flux }
    }
}

/// What a light emits.
#[derive(Clone, Debug)]
pub(super) enum Projection {
    /// Nothing: nothing specular can be reached.
    Nothing,
    /// Everything.
    Whole,
    /// What meets the ball of an object, found by emitting everything.
    Aimed(Targets),
    /// From a point, by cells.
    Point(PointCells),
    /// From a surface, by cells.
    Lamp(LampCells),
    /// From one direction, by cells.
    Directional(DiscCells),
    /// From the surroundings, by cells.
    Sky(SkyCells),
    /// From a point, by objects.
    Cones(Cones),
    /// From infinity, by objects.
    Discs(Discs),
}

impl Projection {
    /// The projections of all lights, in their order.
    ///
    /// - `cells`: cells along each axis.
    pub(super) fn of_lights(world: &World, maps: ProjectionMaps, cells: u32) -> Vec<Self> {
        let lights = world.lights.lights();
        if maps == ProjectionMaps::None {
            return vec![Self::Whole; lights.len()];
        }
        let targets = Targets::new(world);
        if targets.parts.is_empty() {
            return vec![Self::Nothing; lights.len()];
        }
        let builder = Builder::new(world, targets, cells);
        let build = |(index, light): (usize, &Light)| match maps {
            ProjectionMaps::Objects => builder.by_objects(index, light),
            ProjectionMaps::Cells | ProjectionMaps::None => builder.by_cells(index, light),
        };
        lights.iter().enumerate().map(build).collect()
    }

    /// Share of the light's own random numbers that is emitted, 0…1.
    pub(super) fn kept(&self) -> f64 {
        match self {
            Self::Nothing => 0.0,
            Self::Whole | Self::Aimed(_) => 1.0,
            Self::Point(map) => map.kept(),
            Self::Lamp(map) => map.kept(),
            Self::Directional(map) => map.kept(),
            Self::Sky(map) => map.kept(),
            Self::Cones(map) => map.kept(),
            Self::Discs(map) => map.kept(),
        }
    }

    /// Starts light; its mean flux, `None` counted as 0, is the power that is emitted.
    ///
    /// - `u_object`: uniform in [0, 1), like the pairs.
    pub(super) fn emit(
        &self,
        light: &Light,
        u_object: f32,
        u_position: Vec2,
        u_direction: Vec2,
    ) -> Option<Departure> {
        match (self, light) {
            (Self::Nothing, _) => None,
            (Self::Point(map), _) => map.emit(light, u_position, u_direction),
            (Self::Lamp(map), _) => map.emit(light, u_position, u_direction),
            (Self::Cones(map), _) => map.emit(light, u_object, u_direction),
            (Self::Directional(map), Light::Directional(sun)) => map.emit(sun, u_position),
            (Self::Sky(map), Light::Environment(sky)) => map.emit(sky, u_position, u_direction),
            (Self::Discs(map), Light::Directional(sun)) => {
                let (origin, share) = map.sample(&sun.scene, sun.direction, u_object, u_position)?;
                let flux = sun.irradiance * sun.scene.disc_area();
                Some(Departure::bare(origin, sun.direction, flux).scaled(share))
            }
            (Self::Discs(map), Light::Environment(sky)) => {
                let direction = sky.sample_unrestricted(u_direction)?;
                let (origin, share) = map.sample(sky.scene(), -direction.from, u_object, u_position)?;
                let flux = sky.irradiance_of(&direction) * sky.scene().disc_area();
                Some(Departure::bare(origin, -direction.from, flux).scaled(share))
            }
            (Self::Aimed(targets), _) => {
                let departure: Departure = light.sample_emission(u_position, u_direction)?.into();
                objects::any_ahead(&targets.objects, departure.origin, departure.direction)
                    .then_some(departure)
            }
            (Self::Whole | Self::Directional(_) | Self::Sky(_) | Self::Discs(_), _) => {
                light.sample_emission(u_position, u_direction).map(Departure::from)
            }
        }
    }

    /// Memory of its cells, bytes.
    pub(super) fn memory(&self) -> usize {
        match self {
            Self::Point(map) => map.memory(),
            Self::Lamp(map) => map.memory(),
            Self::Directional(map) => map.memory(),
            Self::Sky(map) => map.memory(),
            Self::Nothing | Self::Whole | Self::Aimed(_) | Self::Cones(_) | Self::Discs(_) => 0,
        }
    }
}

/// What it takes to make the maps of all lights.
struct Builder<'w> {
    world: &'w World,
    targets: Targets,
    cells: u32,
    /// Item of each lamp.
    items: Vec<Option<u32>>,
    lamp_parts: u32,
    lamp_cells: u32,
}

impl<'w> Builder<'w> {
    fn new(world: &'w World, targets: Targets, cells: u32) -> Self {
        let mut items = vec![None; world.lights.lights().len()];
        for (index, item) in world.items.iter().enumerate() {
            if let Some(light) = item.light {
                items[light as usize] = Some(index as u32);
            }
        }
        let lamps = items.iter().flatten().count().max(1) as u32;
        let lamp_parts = (LAMP_PARTS / lamps).clamp(1, MOST_LAMP_PARTS);
        // As fine as the budget allows where there are many lamps.
        let affordable = (LAMP_CELLS / (lamps * lamp_parts)).isqrt();
        let cells = cells.clamp(1, MOST_CELLS);
        let lamp_cells = cells.min(MOST_INNER_CELLS).min(affordable).next_multiple_of(4);
        Self { world, targets, cells, items, lamp_parts, lamp_cells }
    }

    fn by_cells(&self, index: usize, light: &Light) -> Projection {
        let parts = &self.targets.parts;
        let even = self.cells.next_multiple_of(2);
        match light {
            Light::Directional(sun) => Projection::Directional(DiscCells::new(sun, parts, even)),
            Light::Environment(sky) => {
                let [blocks, cells] = [MOST_INNER_CELLS, MOST_INNER_CELLS / 2].map(|most| even.min(most));
                SkyCells::new(sky, parts, blocks, cells).map_or(Projection::Nothing, Projection::Sky)
            }
            Light::Shape(_) | Light::Mesh(_) => self.lamp(index, light, parts),
            Light::Point(_) | Light::Spot(_) | Light::Projector(_) => {
                PointCells::new(light, parts, self.cells).map_or(Projection::Whole, Projection::Point)
            }
        }
    }

    /// A lamp has no one point that cones could start from: it takes cells for the objects' balls.
    fn by_objects(&self, index: usize, light: &Light) -> Projection {
        let objects = &self.targets.objects;
        let whole = || Projection::Aimed(self.targets.clone());
        match light {
            Light::Directional(sun) => Discs::new(&sun.scene, objects).map_or_else(whole, Projection::Discs),
            Light::Environment(sky) => Discs::new(sky.scene(), objects).map_or_else(whole, Projection::Discs),
            Light::Shape(_) | Light::Mesh(_) => self.lamp(index, light, &self.targets.merged_objects),
            Light::Point(_) | Light::Spot(_) | Light::Projector(_) => {
                Cones::new(light, objects).map_or_else(whole, Projection::Cones)
            }
        }
    }

    fn lamp(&self, index: usize, light: &Light, targets: &[ball::Ball]) -> Projection {
        let Some(item) = self.items[index] else { return Projection::Whole };
        let geometry: &ItemGeometry = &self.world.geometry.items()[item as usize].geometry;
        LampCells::new(light, geometry, targets, self.lamp_parts, self.lamp_cells)
            .map_or(Projection::Nothing, Projection::Lamp)
    }
}
