//! An analytic shape that shines.
//!
//! Whole spheres and rectangles are sampled uniformly in the solid angle they are seen in; all other shapes by area,
//! and so are rectangles that are too small in the view for the other method.

use super::sphere::SphereDirections;
use super::surface::{ShiningSides, SurfaceEmission};
use super::{Cone, DirectSample, EmissionPdf, EmissionSample, LightPoint, UnitBox};
use hyaline_geometry::{AreaSample, Primitive, Shape, SurfaceHit};
use hyaline_math::{DMat3, DVec2, DVec3, Frame, Mat3, Transform, Vec2, Vec3, float::gamma};
use hyaline_sampling::{RectangleFrame, SphericalRectangle};
use hyaline_spectrum::Spectrum;

/// Diffuse light from a shape.
#[derive(Clone, Debug)]
pub struct ShapeLight {
    primitive: Primitive,
    emission: SurfaceEmission,
    /// World area, m².
    area: f32,
    /// The length of this times the normal is the density by area at a place, m⁻²: a placement that is not a
    /// similarity stretches some places more than others.
    density: Mat3,
    method: Method,
    /// Largest coordinate of any of its points: what the rounding of its description goes by.
    reach: f32,
}

/// How directions to the light are chosen.
#[derive(Clone, Debug, PartialEq)]
enum Method {
    Area,
    Sphere(SphereDirections),
    Rectangle { frame: RectangleFrame, n: Vec3 },
}

impl ShapeLight {
    /// A placed shape of the given radiance, W sr⁻¹ m⁻².
    pub fn new(primitive: Primitive, radiance: Spectrum, sides: ShiningSides) -> Self {
        let area = primitive.area() as f32;
        let (density, method) = (density_of(&primitive), method_for(&primitive));
        let bounds = primitive.bounds();
        let reach = bounds.min.abs().max(bounds.max.abs()).max_element();
        Self { primitive, emission: SurfaceEmission { radiance, sides }, area, density, method, reach }
    }

    pub(super) fn sample_direct(&self, p: Vec3, u: Vec2) -> Option<DirectSample> {
        match &self.method {
            Method::Area => self.sample_by_area(p, u),
            Method::Sphere(sphere) => self.sample_sphere(sphere, p, u),
            Method::Rectangle { frame, n } => match frame.seen_from(p) {
                Some(view) => self.sample_rectangle(&view, *n, p, u),
                None => self.sample_by_area(p, u),
            },
        }
    }

    /// Density of `sample_direct`, sr⁻¹.
    pub(super) fn pdf_direct(&self, p: Vec3, wi: Vec3, hit: &SurfaceHit) -> f32 {
        if !self.emission.shines_toward(hit.ng, -wi) {
            return 0.0;
        }
        let by_area = || self.emission.pdf_by_area(p, wi, (hit.p, hit.ng), self.pdf_a(hit.ng));
        match &self.method {
            Method::Area => by_area(),
            Method::Sphere(sphere) => sphere.pdf(p.as_dvec3(), wi.as_dvec3(), hit.p.as_dvec3()) as f32,
            Method::Rectangle { frame, .. } => {
                frame.seen_from(p).map_or_else(by_area, |view| 1.0 / view.solid_angle())
            }
        }
    }

    pub(super) fn radiance_from(&self, hit: &SurfaceHit, w: Vec3) -> Spectrum {
        self.emission.radiance_toward(hit.ng, w)
    }

    pub(super) fn sample_emission(&self, u_position: Vec2, u_direction: Vec2) -> Option<EmissionSample> {
        let sample = self.primitive.sample_area(u_position);
        self.emission.emission(&sample, &Frame::from_normal(sample.n), u_direction)
    }

    pub(super) fn emission_at(&self, sample: &AreaSample, frame: &Frame, u: Vec2) -> Option<EmissionSample> {
        self.emission.emission(sample, frame, u)
    }

    pub(super) fn cone_at(&self, frame: &Frame, unit_box: &UnitBox) -> Cone {
        self.emission.cone(frame, unit_box)
    }

    pub(super) fn pdf_emission(&self, n: Vec3, direction: Vec3) -> EmissionPdf {
        EmissionPdf { position: self.pdf_a(n), direction: self.emission.pdf_of_direction(n, direction) }
    }

    pub(super) fn is_two_sided(&self) -> bool {
        self.emission.sides == ShiningSides::Both
    }

    pub(super) fn power(&self) -> Spectrum {
        self.emission.power(self.area)
    }

    /// Density of a place with the normal `n` when it is chosen by area, m⁻².
    fn pdf_a(&self, n: Vec3) -> f32 {
        (self.density * n).length()
    }

    fn sample_by_area(&self, p: Vec3, u: Vec2) -> Option<DirectSample> {
        self.emission.direct_by_area(p, &self.primitive.sample_area(u))
    }

    fn sample_sphere(&self, sphere: &SphereDirections, p: Vec3, u: Vec2) -> Option<DirectSample> {
        let sample = sphere.sample(p.as_dvec3(), u.as_dvec2());
        let distance = sample.q.distance(p.as_dvec3()) as f32;
        let n = if self.primitive.flipped { -sample.n } else { sample.n };
        let target = rounded_point(sample.q, n.as_vec3(), self.reach);
        self.emission.direct(sample.wi.as_vec3(), distance, target, sample.pdf_w as f32)
    }

    fn sample_rectangle(&self, view: &SphericalRectangle, n: Vec3, p: Vec3, u: Vec2) -> Option<DirectSample> {
        let q = view.sample(u);
        let to_light = q - p;
        let wi = to_light.try_normalize()?;
        let target = rounded_point(q.as_dvec3(), n, self.reach);
        self.emission.direct(wi, to_light.length(), target, 1.0 / view.solid_angle())
    }
}

/// A point of the surface, known in `f64`, and the error of its `f32` image: its own rounding and that of the surface's
/// description.
fn rounded_point(q: DVec3, n: Vec3, reach: f32) -> LightPoint {
    LightPoint { p: q.as_vec3(), p_error: gamma(8) * reach, n }
}

/// The map from a world normal to its object normal, scaled so that its length is the density by world area of a
/// point that is uniform by object area.
fn density_of(primitive: &Primitive) -> Mat3 {
    let linear = primitive.transform.linear();
    (linear.transpose() * (1.0 / (linear.determinant().abs() * primitive.shape.area()))).as_mat3()
}

/// The best method for a shape.
fn method_for(primitive: &Primitive) -> Method {
    let placement = &primitive.transform;
    match &primitive.shape {
        Shape::Sphere(sphere) => {
            let whole_area = 4.0 * std::f64::consts::PI * sphere.radius() * sphere.radius();
            let is_whole = primitive.shape.area() > whole_area * (1.0 - 1e-9);
            match scale_of(placement) {
                Some(scale) if is_whole => {
                    let center = placement.translation();
                    Method::Sphere(SphereDirections { center, radius: sphere.radius() * scale })
                }
                Some(_) | None => Method::Area,
            }
        }
        Shape::Rectangle(_) => rectangle_method(primitive),
        Shape::Segment(_) | Shape::Arc(_) => Method::Area,
    }
}

/// The corner and edges of a parallelogram, if they are perpendicular in the world.
fn rectangle_method(primitive: &Primitive) -> Method {
    let point = |u: f64, v: f64| {
        let (p, _) = primitive.shape.sample_area(DVec2::new(u, v));
        primitive.transform.point(p)
    };
    let corner = point(0.0, 0.0);
    let edges = [point(1.0, 0.0) - corner, point(0.0, 1.0) - corner];
    let is_rectangular = edges[0].dot(edges[1]).abs() < 1e-6 * edges[0].length() * edges[1].length();
    if !is_rectangular {
        return Method::Area;
    }
    let n = primitive.sample_area(Vec2::splat(0.5)).n;
    let [edge_x, edge_y] = edges.map(|edge| edge.as_vec3());
    Method::Rectangle { frame: RectangleFrame::new(corner.as_vec3(), edge_x, edge_y), n }
}

/// The factor by which a placement scales, if it scales alike in all directions.
fn scale_of(placement: &Transform) -> Option<f64> {
    let m = placement.linear();
    let square = m.transpose() * m;
    let scale_squared = (square.x_axis.x + square.y_axis.y + square.z_axis.z) / 3.0;
    let rest = square - DMat3::IDENTITY * scale_squared;
    let deviation = rest.to_cols_array().into_iter().fold(0.0, |worst: f64, x| worst.max(x.abs()));
    (deviation < 1e-9 * scale_squared).then(|| scale_squared.sqrt())
}
