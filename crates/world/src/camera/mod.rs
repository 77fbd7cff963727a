//! Cameras: from a place on the film to a ray in the world.
//!
//! A film position is turned into pixels right and up of the film's center, the projection turns that into a ray in
//! camera space (looking along -z, y up, x to the right), and the placement takes it to the world; all in `f64`.

mod filter;
mod fisheye;
mod orthographic;
mod perspective;
mod spherical;
#[cfg(test)]
mod tests;

pub use filter::PixelFilter;

use fisheye::Fisheye;
use hyaline_math::{DVec2, DVec3, Ray, Transform, Vec2};
use hyaline_scene::{CameraDescription, Projection};
use orthographic::Orthographic;
use perspective::{Perspective, ThinLens};
use spherical::Spherical;

/// A camera with a film of a certain size.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    placement: Transform,
    projection: FilmProjection,
    /// Half the film, pixels.
    half_size: DVec2,
}

/// A projection that knows the size of the film.
#[derive(Clone, Debug, PartialEq)]
enum FilmProjection {
    Perspective(Perspective),
    ThinLens(ThinLens),
    Orthographic(Orthographic),
    Fisheye(Fisheye),
    Spherical(Spherical),
}

/// A ray in camera space; the direction may have any length but 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LocalRay {
    origin: DVec3,
    direction: DVec3,
}

/// How wide the part of the scene is that a pixel at the film's center looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSpread {
    /// Width at the camera, scene units; 0 but for parallel rays.
    pub width: f32,
    /// Growth of the width with distance: the pixel's angle, radians.
    pub angle: f32,
}

impl PixelSpread {
    /// Width at this distance from the camera, scene units.
    pub fn width_at(&self, distance: f32) -> f32 {
        self.width + self.angle * distance
    }
}

impl Camera {
    /// The camera of a description before a film of `width × height` pixels; an empty film counts as one pixel.
    pub fn new(description: &CameraDescription, width: u32, height: u32) -> Self {
        let size = DVec2::new(f64::from(width.max(1)), f64::from(height.max(1)));
        let projection = match description.projection {
            Projection::Perspective { fov, fov_axis } => {
                FilmProjection::Perspective(Perspective::new(fov, fov_axis, size))
            }
            Projection::ThinLens { fov, fov_axis, lens_radius, focus_distance } => {
                let pinhole = Perspective::new(fov, fov_axis, size);
                FilmProjection::ThinLens(ThinLens { pinhole, lens_radius, focus_distance })
            }
            Projection::Orthographic { height } => {
                FilmProjection::Orthographic(Orthographic::new(height, size))
            }
            Projection::Fisheye { fov } => FilmProjection::Fisheye(Fisheye::new(fov, size)),
            Projection::Spherical { longitude, latitude } => {
                FilmProjection::Spherical(Spherical::new(longitude, latitude, size))
            }
        };
        Self { placement: description.placement, projection, half_size: 0.5 * size }
    }

    /// The ray through a place on the film.
    ///
    /// - `film`: pixels, continuous; (0, 0) is the film's top left corner, the first pixel's center is (0.5, 0.5).
    /// - `u_lens`: chooses the point on the lens; only a thin lens looks at it.
    ///
    /// Returns `None` where the camera sees nothing: outside the circle of a fisheye.
    pub fn ray(&self, film: Vec2, u_lens: Vec2) -> Option<Ray> {
        let from_center = film.as_dvec2() - self.half_size;
        let local = self.projection.ray(DVec2::new(from_center.x, -from_center.y), u_lens)?;
        let direction = self.placement.vector(local.direction).try_normalize()?;
        Some(Ray::new(self.placement.point(local.origin).as_vec3(), direction.as_vec3().normalize()))
    }

    /// How wide a pixel at the film's center is in the scene, approximately: the larger of its two extents.
    pub fn spread(&self) -> PixelSpread {
        let (width, angle) = match &self.projection {
            FilmProjection::Perspective(p) => (0.0, p.pixel_angle()),
            FilmProjection::ThinLens(p) => (0.0, p.pinhole.pixel_angle()),
            FilmProjection::Orthographic(p) => (p.pixel_width(), 0.0),
            FilmProjection::Fisheye(p) => (0.0, p.pixel_angle()),
            FilmProjection::Spherical(p) => (0.0, p.pixel_angle()),
        };
        PixelSpread { width: width as f32, angle: angle as f32 }
    }

    /// Where the camera stands, world space: the lens's center, or the film's for parallel rays.
    pub fn position(&self) -> DVec3 {
        self.placement.translation()
    }
}

impl FilmProjection {
    /// - `q`: pixels right and up of the film's center.
    fn ray(&self, q: DVec2, u_lens: Vec2) -> Option<LocalRay> {
        match self {
            Self::Perspective(p) => Some(p.ray(q)),
            Self::ThinLens(p) => Some(p.ray(q, u_lens)),
            Self::Orthographic(p) => Some(p.ray(q)),
            Self::Fisheye(p) => p.ray(q),
            Self::Spherical(p) => Some(p.ray(q)),
        }
    }
}
