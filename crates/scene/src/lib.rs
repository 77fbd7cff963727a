//! The scene description: plain data with names and units as the files give them.
//!
//! Readers write it, `validate` finds what cannot be meant, and the world is compiled from it; after that nobody
//! reads it again. Lengths are in scene units (one is a metre unless a file says otherwise), angles in radians.

pub mod camera;
pub mod error;
pub mod light;
pub mod material;
pub mod measured;
pub mod medium;
pub mod mesh;
pub mod object;
pub mod settings;
mod techniques;
pub mod texture;

pub use camera::{CameraDescription, FovAxis, Projection};
pub use error::{Located, Note, SceneError, Severity, Source};
pub use light::{LightDescription, LightKind, SpotFalloff};
pub use material::{ColorSource, MaterialDescription, MaterialKind, Metal, Relief, ScalarSource};
pub use medium::{
    Absorption, DensityGrid, GridData, IndexDescription, MediumDescription, PhaseDescription, Scattering,
};
pub use mesh::MeshData;
pub use object::{
    BoundaryDescription, Emission, EmissionQuantity, FillLayer, GeneratedForm, ObjectDescription,
    ProfileCurve, RimKind, ShapeDescription, ShapePart, VesselDescription, VesselProfile,
};
pub use settings::{
    Collection, DebugView, FileIntegrator, FilmDescription, MarchStep, NearestPhotons, PhotonKernel,
    PhotonMapSettings, PixelFilter, ProjectionMaps, SamplerKind, Settings,
};
pub use techniques::Techniques;
pub use texture::{ImageData, TextureDescription, TextureFilter, TextureKind, Wrap};

use serde::Serialize;

/// A linear Rec. 709 color, unbounded.
pub type Rgb = [f32; 3];

/// A whole scene, as described.
#[derive(Clone, Debug, Default, Serialize)]
pub struct SceneDescription {
    /// How to render: integrator, passes, seed, limits.
    pub settings: Settings,
    /// Size and filter of the picture.
    pub film: FilmDescription,
    /// Cameras; the first is the default.
    pub cameras: Vec<Located<CameraDescription>>,
    /// Media by name.
    pub media: Vec<Located<MediumDescription>>,
    /// Materials by name.
    pub materials: Vec<Located<MaterialDescription>>,
    /// Textures by name.
    pub textures: Vec<Located<TextureDescription>>,
    /// Objects, lights with a shape among them.
    pub objects: Vec<Located<ObjectDescription>>,
    /// Lights without a shape.
    pub lights: Vec<Located<LightDescription>>,
    /// Name of the medium that fills the world; `None` is vacuum (index 1, clear).
    pub surrounding: Option<Located<String>>,
    /// What was skipped, doubted or unsupported while reading.
    #[serde(skip)]
    pub notes: Vec<Note>,
}
