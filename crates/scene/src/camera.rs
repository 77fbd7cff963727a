//! Cameras.

use crate::Located;
use hyaline_math::Transform;
use serde::Serialize;

/// A camera: where it stands and how it maps directions to the film.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CameraDescription {
    /// Name for `--camera`.
    pub name: String,
    /// Camera space to world: the camera looks along local -z, y is up, x to the right. No scaling.
    pub placement: Transform,
    /// The map to the film.
    pub projection: Projection,
    /// Medium the camera declares to stand in; used where looking around does not tell.
    pub medium: Option<Located<String>>,
}

/// How directions become film positions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Projection {
    /// Pinhole.
    Perspective {
        /// Full angle of view, radians, 0…π.
        fov: f64,
        /// Which extent of the film `fov` spans.
        fov_axis: FovAxis,
    },
    /// Pinhole with an aperture.
    ThinLens {
        /// Full angle of view, radians, 0…π.
        fov: f64,
        /// Which extent of the film `fov` spans.
        fov_axis: FovAxis,
        /// Radius of the lens, scene units.
        lens_radius: f64,
        /// Distance of the plane in focus along the view axis, scene units.
        focus_distance: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// Height of what is seen, scene units.
        height: f64,
    },
    /// Angle from the axis proportional to the distance from the film's center (equidistant).
    Fisheye {
        /// Full angle across the inscribed circle, radians, 0…2π; black outside the circle.
        fov: f64,
    },
    /// All directions, longitude across and latitude down.
    Spherical {
        /// Range of longitude across the film, radians, up to 2π.
        longitude: f64,
        /// Range of latitude down the film, radians, up to π.
        latitude: f64,
    },
}

/// Which extent of the film a field of view spans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum FovAxis {
    /// Width.
    X,
    /// Height.
    #[default]
    Y,
    /// Diagonal.
    Diagonal,
    /// The shorter of width and height.
    Smaller,
    /// The longer of width and height.
    Larger,
}
