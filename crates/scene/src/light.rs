//! Lights without a shape; those with one are objects with an emission.

use crate::{Located, Rgb};
use hyaline_math::DVec3;
use serde::Serialize;

/// A light that no ray can hit, or that surrounds everything.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightDescription {
    /// Name, for messages.
    pub name: String,
    /// What it is.
    pub kind: LightKind,
    /// Medium the light declares to stand in; used where looking around does not tell.
    pub medium: Option<Located<String>>,
}

/// The kinds of lights without a shape.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum LightKind {
    /// Shines alike in all directions.
    Point {
        /// Place.
        position: DVec3,
        /// Radiant intensity, W/sr.
        intensity: Rgb,
    },
    /// A cone of light.
    Spot {
        /// Place.
        position: DVec3,
        /// Axis of the cone, any length.
        direction: DVec3,
        /// Radiant intensity on the axis, W/sr.
        intensity: Rgb,
        /// Half-angle where the light ends, radians.
        outer_angle: f64,
        /// Half-angle up to which it is at full intensity, radians.
        inner_angle: f64,
        /// How the intensity falls from `inner_angle` to `outer_angle`.
        falloff: SpotFalloff,
    },
    /// An image thrown from a point, as by a slide projector.
    Projector {
        /// Projector space to world: it looks along local -z, y is up, x to the right of the image. No scaling.
        placement: hyaline_math::Transform,
        /// Full angle across the image's width, radians, 0…π.
        fov: f64,
        /// The image, by texture name; `None` is white all over, square.
        image: Option<Located<String>>,
        /// Irradiance of a white pixel on a plane across the axis at distance 1, where the axis meets it, W/m².
        irradiance: Rgb,
    },
    /// Parallel light from infinitely far.
    Directional {
        /// Direction the light travels in, any length.
        direction: DVec3,
        /// Irradiance of a surface that faces it, W/m².
        irradiance: Rgb,
    },
    /// Light from every direction of the surroundings.
    Environment {
        /// Radiance, or the factor on the image.
        radiance: Rgb,
        /// Latitude-longitude image by texture name.
        image: Option<Located<String>>,
        /// World to image space: local y is up, local -z is the image's center, +x to its right.
        placement: hyaline_math::Transform,
        /// Whether camera rays see it.
        visible_to_camera: bool,
    },
    /// Suffern's constant ambient term: added by `whitted` to matte and Phong surfaces, ignored elsewhere.
    Ambient {
        /// Radiance.
        radiance: Rgb,
    },
}

/// How a spot's intensity falls off between its two angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum SpotFalloff {
    /// Smooth step in the cosine.
    #[default]
    Smooth,
    /// Linear in the angle, as Mitsuba has it.
    LinearInAngle,
}
