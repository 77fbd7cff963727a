//! Lights with a surface: from which places of it to emit in which directions.
//!
//! 1. The surface is cut into parts; each has a ball about its points and a cone about its normals.
//! 2. For each part the square of random numbers that directions are drawn with is cut into equal cells, about the
//!    part's middle normal; at other places of the part the directions are turned along with the normal.
//! 3. A part is chosen by its flux times the share of its yes cells, then a place in it, then a yes cell.

use super::ball::Ball;
use super::beam::Beam;
use super::grid::Grid;
use super::patch::Patch;
use super::turn::turned_frame;
use super::{Departure, cluster, patch};
use hyaline_geometry::{AreaSample, ItemGeometry, Primitive};
use hyaline_math::{DVec2, Frame, Vec2};
use hyaline_sampling::Distribution1d;
use hyaline_world::light::{Light, UnitBox};
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
    /// Faces by area.
    Faces(Vec<u32>, Distribution1d),
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
        let frame = turned_frame(&part.frame, sample.n);
        let emission = light.emission_at(&sample, &frame, part.grid.sample(u_direction)?)?;
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
}

impl Place {
    /// - `u`: two uniform random numbers in [0, 1).
    fn sample(&self, light: &Light, u: Vec2) -> Option<AreaSample> {
        match self {
            Self::Shape(primitive, unit_box) => {
                Some(primitive.sample_area(unit_box.at(u.as_dvec2()).as_vec2()))
            }
            Self::Faces(faces, by_area) => {
                let Light::Mesh(mesh) = light else { return None };
                let pick = by_area.sample(u.x);
                Some(mesh.sample_face(faces[pick.index], Vec2::new(pick.u, u.y)))
            }
        }
    }

    fn memory(&self) -> usize {
        match self {
            Self::Shape(..) => size_of::<Primitive>(),
            Self::Faces(faces, _) => 2 * size_of_val(&faces[..]),
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
            let (mesh, transform) = (mesh.mesh(), transform.as_ref());
            let area = |face: u32| cluster::area(mesh, transform, face);
            let faces: Vec<u32> = (0..mesh.face_count() as u32).collect();
            let total: f64 = faces.iter().map(|&face| area(face)).sum();
            let clusters = cluster::cut(mesh, transform, faces, count);
            let place = |cluster: cluster::Cluster| {
                let areas: Vec<f64> = cluster.faces.iter().map(|&face| area(face)).collect();
                let share = areas.iter().sum::<f64>() / total;
                let by_area = Distribution1d::from_f64(areas.into_iter()).ok()?;
                Some((Place::Faces(cluster.faces, by_area), share, cluster.patch))
            };
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
