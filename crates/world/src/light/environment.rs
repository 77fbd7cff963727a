//! Light from every direction of the surroundings: a constant or an image.
//!
//! Directions into an image are drawn cell by cell in proportion to the cells' light, uniformly within a cell, so the
//! density per solid angle is constant in a cell and positive wherever the interpolated image is. Light that enters
//! the scene from such a direction starts on a disc that covers the scene's bounding sphere.

mod restricted;

pub use restricted::{RestrictedSky, SkyDirection};

use super::{DirectSample, EmissionPdf, EmissionSample, SceneSphere, SkyImage};
use hyaline_math::{Mat3, Transform, Vec2, Vec3};
use hyaline_sampling::{Distribution2d, Pick2d, warp};
use hyaline_spectrum::Spectrum;
use std::f64::consts::PI;

/// The surroundings as a light.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentLight {
    sky: Sky,
    scene: SceneSphere,
    /// Radiance integrated over all directions, W m⁻².
    total: Spectrum,
}

#[derive(Clone, Debug, PartialEq)]
enum Sky {
    Constant(Spectrum),
    Image(Box<ImageSky>),
}

/// An image that is turned and can be sampled.
#[derive(Clone, Debug, PartialEq)]
struct ImageSky {
    image: SkyImage,
    /// World to image space, a rotation or reflection.
    to_image: Mat3,
    /// `None` for a black image.
    cells: Option<Distribution2d>,
    /// How many lanes count when directions are chosen.
    lanes: usize,
}

impl EnvironmentLight {
    /// The same radiance from everywhere, W sr⁻¹ m⁻².
    pub fn from_constant(radiance: Spectrum, scene: SceneSphere) -> Self {
        Self { sky: Sky::Constant(radiance), scene, total: radiance * (4.0 * PI) as f32 }
    }

    /// The radiance of an image, W sr⁻¹ m⁻².
    ///
    /// - `placement`: world to image space; only the directions of its axes count, not their lengths.
    /// - `lanes`: how many lanes of the image carry light and count when directions are chosen.
    pub fn from_image(image: SkyImage, placement: &Transform, lanes: usize, scene: SceneSphere) -> Self {
        let mut weights = Vec::with_capacity(image.width() as usize * image.height() as usize);
        let mut total = [0.0; 4];
        image.for_each_cell(|light| {
            weights.push(mean(light, lanes));
            total = std::array::from_fn(|lane| total[lane] + light[lane]);
        });
        let cells = Distribution2d::new(image.width() as usize, &weights).ok();
        let sky = ImageSky { image, to_image: rotation_of(placement), cells, lanes };
        let total = Spectrum::from_lanes(total.map(|x| x as f32));
        Self { sky: Sky::Image(Box::new(sky)), scene, total }
    }

    /// Radiance seen in a direction, unit.
    pub(super) fn radiance(&self, direction: Vec3) -> Spectrum {
        match &self.sky {
            Sky::Constant(radiance) => *radiance,
            Sky::Image(sky) => sky.image.radiance(sky.to_image * direction),
        }
    }

    pub(super) fn sample_direct(&self, u: Vec2) -> Option<DirectSample> {
        let (wi, pdf_w) = self.sample_direction(u)?;
        let (distance, radiance) = (f32::INFINITY, self.radiance(wi));
        Some(DirectSample { wi, distance, target: None, radiance, pdf_w, is_delta: false })
    }

    /// Density of `sample_direct`, sr⁻¹.
    pub(super) fn pdf_direct(&self, wi: Vec3) -> f32 {
        match &self.sky {
            Sky::Constant(_) => warp::pdf_sphere(),
            Sky::Image(sky) => sky.pdf(wi),
        }
    }

    pub(super) fn sample_emission(&self, u_position: Vec2, u_direction: Vec2) -> Option<EmissionSample> {
        let (from, pdf_direction) = self.sample_direction(u_direction)?;
        let radiance = self.radiance(from);
        let pdf_position = self.scene.disc_pdf();
        let direction = -from;
        (pdf_position > 0.0).then(|| EmissionSample {
            origin: self.scene.sample_disc(direction, u_position),
            p_error: 0.0,
            n: None,
            direction,
            weight: radiance * (self.scene.disc_area() / pdf_direction),
            pdf_position,
            pdf_direction,
            is_delta_position: false,
            is_delta_direction: false,
        })
    }

    /// - `direction`: in which the light travels.
    pub(super) fn pdf_emission(&self, direction: Vec3) -> EmissionPdf {
        EmissionPdf { position: self.scene.disc_pdf(), direction: self.pdf_direct(-direction) }
    }

    pub(super) fn power(&self) -> Spectrum {
        self.total * self.scene.disc_area()
    }

    /// What it shines on.
    pub fn scene(&self) -> &SceneSphere {
        &self.scene
    }

    /// A direction to the sky and its density, sr⁻¹.
    fn sample_direction(&self, u: Vec2) -> Option<(Vec3, f32)> {
        match &self.sky {
            Sky::Constant(_) => Some((warp::sample_sphere(u), warp::pdf_sphere())),
            Sky::Image(sky) => sky.sample(u),
        }
    }
}

impl ImageSky {
    fn sample(&self, u: Vec2) -> Option<(Vec3, f32)> {
        Some(self.direction_of(&self.cells.as_ref()?.sample(u)))
    }

    /// The direction at a chosen place of the image, and its density, sr⁻¹.
    fn direction_of(&self, pick: &Pick2d) -> (Vec3, f32) {
        let cell = [pick.x as u32, pick.y as u32];
        let inside = pick.uv * self.size() - Vec2::new(pick.x as f32, pick.y as f32);
        let local = self.image.direction_in_cell(cell, inside.clamp(Vec2::ZERO, Vec2::ONE));
        (self.to_image.transpose() * local, pick.pdf * self.per_solid_angle(cell[1]))
    }

    fn pdf(&self, direction: Vec3) -> f32 {
        let Some(cells) = &self.cells else { return 0.0 };
        let position = self.image.position_of(self.to_image * direction);
        let row = (position.y.max(0.0) as u32).min(self.image.height() - 1);
        cells.pdf(position / self.size()) * self.per_solid_angle(row)
    }

    /// Turns a density per area of the unit square into one per solid angle, in a row.
    fn per_solid_angle(&self, row: u32) -> f32 {
        let cell_count = f64::from(self.image.width()) * f64::from(self.image.height());
        (1.0 / (cell_count * self.image.solid_angle_of_cell(row))) as f32
    }

    fn size(&self) -> Vec2 {
        Vec2::new(self.image.width() as f32, self.image.height() as f32)
    }
}

/// Mean of the lanes that count.
fn mean(light: [f64; 4], lanes: usize) -> f32 {
    (light[..lanes].iter().sum::<f64>() / lanes as f64) as f32
}

/// The rotation or reflection nearest to a placement that keeps the direction of its y axis.
fn rotation_of(placement: &Transform) -> Mat3 {
    // Rows of the linear part are the axes of image space in the world.
    let axes = placement.linear().transpose();
    let up = axes.y_axis.normalize();
    let side = axes.x_axis - up * up.dot(axes.x_axis);
    let side = side.try_normalize().unwrap_or_else(|| up.any_orthonormal_vector());
    let back = side.cross(up) * if placement.is_mirroring() { -1.0 } else { 1.0 };
    Mat3::from_cols(side.as_vec3(), up.as_vec3(), back.as_vec3()).transpose()
}
