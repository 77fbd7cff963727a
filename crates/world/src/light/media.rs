//! What light starts in: a lamp under water shines into water.

use crate::World;
use hyaline_math::Vec3;
use hyaline_scattering::MediumSet;

/// The media about a light.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LightMedia {
    /// On the side that the normals of its surface point to; about a light without a surface.
    pub outer: MediumSet,
    /// On the other side of its surface.
    pub inner: MediumSet,
}

impl World {
    /// The set that a path starts with when it leaves a light.
    ///
    /// - `light`: index of the light.
    /// - `n`: outward normal of the light's surface where the path starts; `None` without a surface.
    /// - `direction`: in which the path leaves.
    ///
    /// # Panics
    /// Where there is no such light.
    pub fn emission_set(&self, light: u32, n: Option<Vec3>, direction: Vec3) -> &MediumSet {
        let media = &self.light_media[light as usize];
        let leaves_inside = n.is_some_and(|n| n.dot(direction) < 0.0);
        if leaves_inside { &media.inner } else { &media.outer }
    }
}
