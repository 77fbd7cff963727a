//! An image thrown from a point.
//!
//! A plane across the axis at distance z sees the image, evenly lit, 1 / z² as bright as at distance 1. Toward a
//! direction at the angle θ from the axis that is the intensity E / cos³ θ, where E is the irradiance of the plane at
//! distance 1. Emission draws a place of that plane: a pixel by its light, then uniformly within the pixel.

use super::point::from_point;
use super::{Cone, DirectSample, EmissionPdf, EmissionSample, UnitBox};
use hyaline_math::{DVec2, DVec3, Mat3, Transform, Vec2, Vec3, float};
use hyaline_sampling::Distribution1d;
use hyaline_spectrum::Spectrum;
use std::f32::consts::{FRAC_PI_2, PI};

/// Widest half-angle, just short of a quarter turn, radians.
const WIDEST: f32 = FRAC_PI_2 - 1e-3;

/// A slide projector.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectorLight {
    position: Vec3,
    /// Its right, its up and its back in the world.
    axes: Mat3,
    /// Half the width and height of the image at distance 1.
    half_size: Vec2,
    /// Of a white pixel on the plane at distance 1, W m⁻².
    irradiance: Spectrum,
    /// `None` is white all over.
    slide: Option<Slide>,
}

/// An image whose pixels are chosen by their light.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide {
    width: usize,
    height: usize,
    pixels: Vec<Spectrum>,
    mean: Spectrum,
    /// `None` for a black image.
    rows: Option<Distribution1d>,
    /// By row; `None` for a black one.
    columns: Vec<Option<Distribution1d>>,
}

impl Slide {
    /// An image of `width × height` colors, rows from the top.
    ///
    /// Lanes that are negative or not finite are taken as 0. `lanes` is how many of them count in the choice of
    /// pixels. Returns `None` where the image is empty or the number of pixels is not its size.
    pub fn new(width: u32, height: u32, pixels: Vec<Spectrum>, lanes: usize) -> Option<Self> {
        let (width, height) = (width as usize, height as usize);
        if width * height == 0 || pixels.len() != width * height {
            return None;
        }
        let valid = |pixel: Spectrum| pixel.map(|x| if x > 0.0 && x.is_finite() { x } else { 0.0 });
        let pixels = pixels.into_iter().map(valid).collect();
        let mut slide = Self { width, height, pixels, mean: Spectrum::ZERO, rows: None, columns: Vec::new() };
        let means: Vec<Spectrum> = (0..width * height).map(|i| slide.mean_of(i % width, i / width)).collect();
        let weights: Vec<f32> = means.iter().map(|mean| mean.mean(lanes)).collect();
        slide.mean = mean(&means);
        slide.columns = weights.chunks_exact(width).map(|row| Distribution1d::new(row).ok()).collect();
        let sums = weights.chunks_exact(width).map(|row| row.iter().map(|&w| f64::from(w)).sum::<f64>());
        slide.rows = Distribution1d::from_f64(sums).ok();
        Some(slide)
    }

    /// Width over height.
    fn aspect(&self) -> f32 {
        self.width as f32 / self.height as f32
    }

    /// The color at a place, 0…1 from the left and from the top: interpolated between the centers of the pixels.
    fn color(&self, place: Vec2) -> Spectrum {
        let q = place * Vec2::new(self.width as f32, self.height as f32) - 0.5;
        let (base, f) = (q.floor(), q - q.floor());
        let (x, y) = (base.x as i64, base.y as i64);
        let row = |y: i64| self.pixel(x, y) * (1.0 - f.x) + self.pixel(x + 1, y) * f.x;
        row(y) * (1.0 - f.y) + row(y + 1) * f.y
    }

    /// Mean of the interpolated color over the square of a pixel.
    fn mean_of(&self, x: usize, y: usize) -> Spectrum {
        let shares = [(-1, 0.125), (0, 0.75), (1, 0.125)];
        let terms = shares.iter().flat_map(|&(dy, b)| shares.iter().map(move |&(dx, a)| (dx, dy, a * b)));
        terms.fold(Spectrum::ZERO, |sum, (dx, dy, share)| {
            sum + self.pixel(x as i64 + dx, y as i64 + dy) * share
        })
    }

    /// A pixel; beyond the edges the nearest one.
    fn pixel(&self, x: i64, y: i64) -> Spectrum {
        let column = x.clamp(0, self.width as i64 - 1) as usize;
        self.pixels[y.clamp(0, self.height as i64 - 1) as usize * self.width + column]
    }

    /// A place by the light of its pixel, and its density by area of the unit square.
    fn sample(&self, u: Vec2) -> Option<(Vec2, f32)> {
        let row = self.rows.as_ref()?.sample(u.y);
        let column = self.columns[row.index].as_ref()?.sample(u.x);
        let size = Vec2::new(self.width as f32, self.height as f32);
        let place = Vec2::new(column.index as f32 + column.u, row.index as f32 + row.u) / size;
        Some((place, row.probability * column.probability * size.x * size.y))
    }

    fn pdf(&self, place: Vec2) -> f32 {
        let along = |x: f32, count: usize| ((x * count as f32) as usize).min(count - 1);
        let (x, y) = (along(place.x, self.width), along(place.y, self.height));
        let (Some(rows), Some(columns)) = (&self.rows, &self.columns[y]) else { return 0.0 };
        rows.probability(y) * columns.probability(x) * self.width as f32 * self.height as f32
    }

    /// The smallest box about all places that `sample` gives a box of random numbers.
    fn places_of(&self, unit_box: &UnitBox) -> Option<UnitBox> {
        let (low, high) = (unit_box.min.as_vec2(), unit_box.max.as_vec2());
        let rows = self.rows.as_ref()?;
        let (top, bottom) = (rows.sample(low.y).index, rows.sample(high.y).index);
        let columns = self.columns[top..=bottom].iter().flatten();
        let ends = columns.map(|row| (row.sample(low.x).index, row.sample(high.x).index));
        let (left, right) = ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        let size = DVec2::new(self.width as f64, self.height as f64);
        Some(UnitBox {
            min: DVec2::new(left as f64, top as f64) / size,
            max: DVec2::new((right + 1) as f64, (bottom + 1) as f64) / size,
        })
    }
}

impl ProjectorLight {
    /// A projector at the origin of `placement`, which looks along local -z, y up.
    ///
    /// - `fov`: full angle across the width of the image, radians, 0…π.
    /// - `irradiance`: of a white pixel on a plane across the axis at distance 1, W m⁻².
    /// - `slide`: the image; `None` is a white square.
    pub fn new(placement: &Transform, fov: f32, irradiance: Spectrum, slide: Option<Slide>) -> Self {
        let axis = |axis: DVec3| placement.vector(axis).normalize().as_vec3();
        let half_width = float::tan((0.5 * fov).clamp(0.0, WIDEST));
        let aspect = slide.as_ref().map_or(1.0, Slide::aspect);
        Self {
            position: placement.translation().as_vec3(),
            axes: Mat3::from_cols(axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z)),
            half_size: Vec2::new(half_width, half_width / aspect),
            irradiance,
            slide,
        }
    }

    pub(super) fn position(&self) -> Vec3 {
        self.position
    }

    pub(super) fn sample_direct(&self, p: Vec3) -> Option<DirectSample> {
        from_point(self.position, p, |direction| self.intensity_toward(direction))
    }

    /// Intensity in a direction, unit, W sr⁻¹.
    pub(super) fn intensity_toward(&self, direction: Vec3) -> Spectrum {
        match self.place_of(direction) {
            Some((place, cosine)) => self.irradiance_at(place) / cosine.powi(3),
            None => Spectrum::ZERO,
        }
    }

    pub(super) fn sample_emission(&self, u: Vec2) -> Option<EmissionSample> {
        let (place, pdf) = self.slide.as_ref().map_or(Some((u, 1.0)), |slide| slide.sample(u))?;
        let direction = self.direction_to(place);
        let cosine = -direction.dot(self.axes.z_axis);
        let area = self.area();
        (area > 0.0).then(|| EmissionSample {
            origin: self.position,
            p_error: 0.0,
            n: None,
            direction,
            weight: self.irradiance_at(place) * (area / pdf),
            pdf_position: 1.0,
            pdf_direction: pdf / (area * cosine.powi(3)),
            is_delta_position: true,
            is_delta_direction: false,
        })
    }

    pub(super) fn pdf_emission(&self, direction: Vec3) -> EmissionPdf {
        let density = |(place, cosine): (Vec2, f32)| {
            let pdf = self.slide.as_ref().map_or(1.0, |slide| slide.pdf(place));
            pdf / (self.area() * cosine.powi(3))
        };
        EmissionPdf { position: 1.0, direction: self.place_of(direction).map_or(0.0, density) }
    }

    pub(super) fn power(&self) -> Spectrum {
        let mean = self.slide.as_ref().map_or(Spectrum::ONE, |slide| slide.mean);
        self.irradiance * mean * self.area()
    }

    /// About the directions of `sample_emission`.
    pub(super) fn cone_of_emission(&self, unit_box: &UnitBox) -> Cone {
        let places = match &self.slide {
            None => *unit_box,
            Some(slide) => slide.places_of(unit_box).unwrap_or(UnitBox::WHOLE),
        };
        let axis = self.direction_to(places.center().as_vec2()).as_dvec3();
        // The directions to a rectangle lie within the widest angle to its corners.
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].map(|corner| places.at(corner));
        let angle = |place: DVec2| {
            let corner = self.direction_to(place.as_vec2()).as_dvec3();
            2.0 * float::f64::asin(0.5 * corner.distance(axis))
        };
        Cone { axis, half_angle: corners.map(angle).into_iter().fold(0.0, f64::max) }.widened(1e-5)
    }

    /// Of the image, sr.
    pub(super) fn solid_angle(&self) -> f32 {
        let Vec2 { x: a, y: b } = self.half_size;
        let sine = (a * a / (1.0 + a * a) * (b * b / (1.0 + b * b))).sqrt();
        4.0 * float::asin(sine).min(0.5 * PI)
    }

    /// Area of the image at distance 1, m².
    fn area(&self) -> f32 {
        4.0 * self.half_size.x * self.half_size.y
    }

    fn irradiance_at(&self, place: Vec2) -> Spectrum {
        self.irradiance * self.slide.as_ref().map_or(Spectrum::ONE, |slide| slide.color(place))
    }

    /// Unit direction to a place of the image, 0…1 from the left and from the top.
    fn direction_to(&self, place: Vec2) -> Vec3 {
        let q = self.half_size * Vec2::new(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y);
        (self.axes * Vec3::new(q.x, q.y, -1.0)).normalize()
    }

    /// The place of the image in a direction, and the cosine to the axis; `None` beside the image.
    fn place_of(&self, direction: Vec3) -> Option<(Vec2, f32)> {
        let local = self.axes.transpose() * direction;
        let cosine = -local.z;
        let q = local.truncate() / (cosine * self.half_size);
        let is_inside = cosine > 0.0 && q.abs().max_element() <= 1.0;
        is_inside.then(|| (0.5 * Vec2::new(1.0 + q.x, 1.0 - q.y), cosine))
    }
}

/// Mean of some colors, in `f64`.
fn mean(colors: &[Spectrum]) -> Spectrum {
    let mut sum = [0.0_f64; 4];
    for color in colors {
        let lanes = color.to_lanes();
        sum = std::array::from_fn(|lane| sum[lane] + f64::from(lanes[lane]));
    }
    Spectrum::from_lanes(sum.map(|x| (x / colors.len() as f64) as f32))
}
