//! Lights with a surface: from which places of it to emit in which directions.
//!
//! 1. The surface is cut into parts; each has a ball about its points and a cone about its normals.
//! 2. For each part the square of random numbers that directions are drawn with is cut into equal cells, about the
//!    part's middle normal; at other places of the part the directions are turned along with the normal.
//! 3. A part is chosen by its flux times the share of its yes cells, then a place in it, then a yes cell.

use super::ball::Ball;
use super::beam::Beam;
use super::cluster::{self, Cluster, Piece};
use super::grid::Grid;
use super::patch::Patch;
use super::turn::turned_frame;
use super::{Departure, patch};
use hyaline_geometry::{AreaSample, ItemGeometry, Primitive};
use hyaline_math::{DVec2, Frame, Vec2};
use hyaline_sampling::Distribution1d;
use hyaline_world::light::{EmissionSample, Light, UnitBox};
use rayon::prelude::*;

/// Places and directions by yes and no.
#[derive(Clone, Debug)]
pub(in crate::photon) struct LampCells {
    parts: Vec<Part>,
    choice: Distribution1d,
    kept: f64,
}

/// A part of the surface.
#[derive(Clone, Debug)]
struct Part {
    place: Place,
    /// Of all random numbers that lead to places.
    share: f64,
    /// About the middle normal.
    frame: Frame,
    grid: Grid,
}

/// How places of a part are drawn.
#[derive(Clone, Debug)]
enum Place {
    Shape(Box<Primitive>, UnitBox),
    /// Pieces of faces by area.
    Mesh(Vec<Piece>, Distribution1d),
}

impl LampCells {
    /// - `geometry`: the light's surface.
    /// - `part_count`: about how many parts to cut it into.
    /// - `cells`: cells along each axis of the square of directions, a multiple of 4.
    ///
    /// `None` where nothing can be met.
    pub(super) fn new(
        light: &Light,
        geometry: &ItemGeometry,
        targets: &[Ball],
        part_count: u32,
        cells: u32,
    ) -> Option<Self> {
        let build = |(place, share, patch): (Place, f64, Patch)| {
            let frame = Frame::from_normal(patch.normals.axis.as_vec3());
            let grid = grid_of(light, &patch, &frame, targets, cells);
            Part { place, share, frame, grid }
        };
        let parts: Vec<Part> = places(geometry, part_count).into_par_iter().map(build).collect();
        let parts: Vec<Part> = parts.into_iter().filter(|part| part.kept() > 0.0).collect();
        let kept = parts.iter().map(Part::kept).sum();
        let choice = Distribution1d::from_f64(parts.iter().map(Part::kept)).ok()?;
        Some(Self { parts, choice, kept })
    }

    pub(super) fn kept(&self) -> f64 {
        self.kept
    }

    pub(super) fn emit(&self, light: &Light, u_position: Vec2, u_direction: Vec2) -> Option<Departure> {
        let pick = self.choice.sample(u_position.x);
        let part = &self.parts[pick.index];
        let sample = part.place.sample(light, Vec2::new(pick.u, u_position.y))?;
        let emission = part.emission(light, &sample, part.grid.sample(u_direction)?)?;
        Some(Departure::from(emission).scaled(part.kept() / f64::from(pick.probability)))
    }

    pub(super) fn memory(&self) -> usize {
        let of = |part: &Part| size_of::<Part>() + part.grid.memory() + part.place.memory();
        self.parts.iter().map(of).sum()
    }
}

impl Part {
    /// Share of the light's random numbers that this part keeps.
    fn kept(&self) -> f64 {
        self.share * self.grid.fraction()
    }

    /// Light from a place of this part.
    ///
    /// - `u`: the point of the square of directions.
    fn emission(&self, light: &Light, sample: &AreaSample, u: Vec2) -> Option<EmissionSample> {
        light.emission_at(sample, &turned_frame(&self.frame, sample.n), u)
    }
}

impl Place {
    /// - `u`: two uniform random numbers in [0, 1).
    fn sample(&self, light: &Light, u: Vec2) -> Option<AreaSample> {
        match self {
            Self::Shape(primitive, unit_box) => {
                Some(primitive.sample_area(unit_box.at(u.as_dvec2()).as_vec2()))
            }
            Self::Mesh(pieces, by_area) => {
                let Light::Mesh(mesh) = light else { return None };
                let pick = by_area.sample(u.x);
                let piece = &pieces[pick.index];
                let inside = piece.unit_box().at(DVec2::new(f64::from(pick.u), f64::from(u.y)));
                Some(mesh.sample_face(piece.face, inside.as_vec2()))
            }
        }
    }

    fn memory(&self) -> usize {
        match self {
            Self::Shape(..) => size_of::<Primitive>(),
            // With a step count for each piece.
            Self::Mesh(pieces, _) => size_of_val(&pieces[..]) + pieces.len() * size_of::<u32>(),
        }
    }
}

/// The parts of a surface, and their shares.
fn places(geometry: &ItemGeometry, count: u32) -> Vec<(Place, f64, Patch)> {
    match geometry {
        ItemGeometry::Shape(primitive) => patch::cut(primitive, count)
            .into_iter()
            .map(|(unit_box, patch)| {
                let size: DVec2 = unit_box.max - unit_box.min;
                (Place::Shape(Box::new(*primitive), unit_box), size.x * size.y, patch)
            })
            .collect(),
        ItemGeometry::Mesh { mesh, transform } => {
            let faces: Vec<u32> = (0..mesh.mesh().face_count() as u32).collect();
            let place = |Cluster { pieces, patch }| {
                let shares = pieces.iter().map(|piece| f64::from(piece.share));
                let share = shares.clone().sum();
                let by_area = Distribution1d::from_f64(shares).ok()?;
                Some((Place::Mesh(pieces, by_area), share, patch))
            };
            let clusters = cluster::cut(mesh.mesh(), transform.as_ref(), &faces, count);
            clusters.into_iter().filter_map(place).collect()
        }
    }
}

fn grid_of(light: &Light, patch: &Patch, frame: &Frame, targets: &[Ball], cells: u32) -> Grid {
    Grid::new(cells, targets, &|unit_box| {
        let directions = light.cone_at(frame, unit_box).widened(patch.normals.half_angle);
        let beam = Beam::new(patch.ball, directions);
        move |target: &Ball| beam.may_meet(target)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_geometry::Shape;
    use hyaline_geometry::shape::Sphere;
    use hyaline_math::DVec3;
    use hyaline_spectrum::Spectrum;
    use hyaline_testkit::Random;
    use hyaline_world::light::{ShapeLight, ShiningSides};

    #[test]
    fn directions_from_all_places_of_a_part_lie_in_the_cone_that_its_cells_are_judged_by() {
        let ball = Primitive::new(Shape::Sphere(Sphere::new(1.0).unwrap()));
        let light = Light::Shape(ShapeLight::new(ball, Spectrum::ONE, ShiningSides::Both));
        let everything = [Ball { center: DVec3::ZERO, radius: 10.0 }];
        let map = LampCells::new(&light, &ItemGeometry::Shape(ball), &everything, 64, 8).unwrap();
        assert!((map.kept() - 1.0).abs() < 1e-6);
        let mut random = Random::from_seed(1);
        let mut pair = || Vec2::new(random.uniform_f32(), random.uniform_f32());
        for part in &map.parts {
            let Place::Shape(_, place_box) = &part.place else { panic!("a shape has boxes") };
            let spread = super::super::patch::cut(&ball, 64)
                .iter()
                .find(|(unit_box, _)| unit_box == place_box)
                .map(|(_, patch)| patch.normals.half_angle)
                .unwrap();
            for _ in 0..50 {
                let u = pair();
                let cell = (u * 8.0).floor().as_dvec2() / 8.0;
                let unit_box = UnitBox { min: cell, max: cell + 0.125 };
                let cone = light.cone_at(&part.frame, &unit_box).widened(spread);
                let sample = part.place.sample(&light, pair()).unwrap();
                let direction = part.emission(&light, &sample, u).unwrap().direction;
                let angle =
                    2.0 * hyaline_math::float::f64::asin(0.5 * direction.as_dvec3().distance(cone.axis));
                assert!(angle <= cone.half_angle, "{angle} {cone:?}");
            }
        }
    }
}
