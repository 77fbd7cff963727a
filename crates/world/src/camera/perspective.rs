//! The pinhole, and the thin lens that blurs what is out of focus.

use super::LocalRay;
use hyaline_math::{DVec2, DVec3, Vec2, float};
use hyaline_sampling::warp;
use hyaline_scene::FovAxis;

/// All rays start at the camera's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Perspective {
    /// Width of a pixel on the plane at distance 1.
    pixel: f64,
}

impl Perspective {
    /// - `fov`: full angle, radians, that the extent of the film along `fov_axis` spans.
    /// - `size`: film, pixels.
    pub(super) fn new(fov: f64, fov_axis: FovAxis, size: DVec2) -> Self {
        let extent = match fov_axis {
            FovAxis::X => size.x,
            FovAxis::Y => size.y,
            FovAxis::Diagonal => size.length(),
            FovAxis::Smaller => size.min_element(),
            FovAxis::Larger => size.max_element(),
        };
        Self { pixel: 2.0 * float::f64::tan(0.5 * fov) / extent }
    }

    /// - `q`: pixels right and up of the film's center.
    pub(super) fn ray(&self, q: DVec2) -> LocalRay {
        LocalRay { origin: DVec3::ZERO, direction: (q * self.pixel).extend(-1.0) }
    }

    /// Angle of the pixel at the film's center, radians.
    pub(super) fn pixel_angle(&self) -> f64 {
        self.pixel
    }
}

/// Rays start on a disc and meet again where the pinhole's ray crosses the plane in focus.
///
/// Source: Cook, Porter, Carpenter, Distributed Ray Tracing, SIGGRAPH 1984.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ThinLens {
    /// The camera with a lens of radius 0.
    pub(super) pinhole: Perspective,
    /// Radius of the lens, scene units.
    pub(super) lens_radius: f64,
    /// Distance of the plane in focus along the view axis, scene units.
    pub(super) focus_distance: f64,
}

impl ThinLens {
    /// - `q`: pixels right and up of the film's center.
    /// - `u_lens`: chooses the point of the lens, uniformly by area.
    pub(super) fn ray(&self, q: DVec2, u_lens: Vec2) -> LocalRay {
        let lens = warp::sample_disc(u_lens).as_dvec2() * self.lens_radius;
        let origin = lens.extend(0.0);
        let focus = self.pinhole.ray(q).direction * self.focus_distance;
        LocalRay { origin, direction: focus - origin }
    }
}
