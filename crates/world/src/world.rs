//! The world that rays travel in.

use crate::camera::Camera;
use crate::light::{LightMedia, LightSet};
use crate::material::Material;
use crate::texture::Texture;
use hyaline_geometry::Aggregate;
use hyaline_scattering::{Boundaries, Medium, MediumSet, ObjectId};
use hyaline_spectrum::Spectrum;

/// Which rays see an item.
pub mod mask {
    /// Rays that leave the camera.
    pub const CAMERA: u8 = 1;
    /// All other rays.
    pub const PATH: u8 = 2;
    /// Shadow rays that ask only whether something is in the way: items that let nothing through straight.
    pub const BLOCKS: u8 = 4;
}

/// A compiled scene: immutable, indexed, shared by all threads.
#[derive(Debug)]
pub struct World {
    /// Everything that rays can hit.
    pub geometry: Aggregate,
    /// What each item of the geometry is.
    pub items: Vec<ItemInfo>,
    /// Names of the objects; an object id is an index here.
    pub object_names: Vec<String>,
    /// Finish of each object, where faces don't say otherwise.
    pub object_materials: Vec<u32>,
    /// Which media meet at each object.
    pub boundaries: Boundaries,
    /// The media; the first is the world's.
    pub media: Vec<Medium>,
    /// The finishes.
    pub materials: Vec<Material>,
    /// The textures.
    pub textures: Vec<Texture>,
    /// The lights, and how they are chosen.
    pub lights: LightSet,
    /// What the light of each light starts in.
    pub light_media: Vec<LightMedia>,
    /// Indices of the surroundings that camera rays see.
    pub camera_sky: Vec<u32>,
    /// Suffern's ambient radiance, for `whitted`.
    pub ambient: Spectrum,
    /// The cameras, in the order of the description.
    pub cameras: Vec<Camera>,
    /// Names of the cameras.
    pub camera_names: Vec<String>,
    /// What each camera is in.
    pub camera_media: Vec<MediumSet>,
    /// Whether shadow rays can pass any boundary straight.
    pub has_permeable: bool,
    /// Whether any medium scatters, shines or varies in space: then paths are to fly, not only to advance.
    pub has_volumes: bool,
    /// Lanes of a spectrum that carry something.
    pub lanes: usize,
}

/// What an item of the geometry is.
#[derive(Clone, Debug)]
pub struct ItemInfo {
    /// Whose surface it is.
    pub object: ObjectId,
    /// Its finish, where faces don't say otherwise.
    pub material: u32,
    /// Finish by face slot, for meshes with several; else empty.
    pub slot_materials: Vec<u32>,
    /// Index of the light that it is, if it shines.
    pub light: Option<u32>,
    /// Whether surfaces of other objects may coincide with it.
    pub may_coincide: bool,
}
