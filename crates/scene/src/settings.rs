//! How to render: everything of a scene that is not the scene.

use crate::Techniques;
use serde::Serialize;

/// Settings of the render; `None` leaves the choice to the renderer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Settings {
    /// Integrator by name.
    pub integrator: Option<String>,
    /// Number of passes where no limit is given on the command line.
    #[serde(skip)]
    pub passes: Option<u32>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Where sample points come from.
    pub sampler: SamplerKind,
    /// `whitted`: a branch ends when its weight falls below this; default 1/512.
    pub min_weight: Option<f32>,
    /// Most bounces of a path, singular crossings not counted in `path`; `whitted`: depth of the recursion, default 64.
    pub max_depth: Option<u32>,
    /// `whitted`: shadow rays per area light and hit; default 1, as passes add up.
    pub light_samples: Option<u32>,
    /// `whitted` and `photon-map`: how the eye marches through media that scatter.
    pub march: MarchStep,
    /// `photon-map`: what its stages do.
    pub photon_map: PhotonMapSettings,
    /// `path`, `merging`: what they do; less than all to see what each part is worth.
    pub techniques: Techniques,
    /// `debug`: what it shows.
    pub debug: DebugView,
    /// What the file asked for, which is reported and obeyed only on demand.
    #[serde(skip)]
    pub file_integrator: Option<FileIntegrator>,
}

/// The integrator and sample count that an imported file names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FileIntegrator {
    /// Name in the file's own words.
    pub name: String,
    /// Depth limit, where given.
    pub max_depth: Option<u32>,
    /// Samples per pixel, where given.
    pub spp: Option<u32>,
}

/// How far the places are apart where a ray that marches through a medium asks for light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum MarchStep {
    /// -ln ξ over the extinction coefficient: short where the medium is dense.
    Adaptive {
        /// Places on a mean free path, ≥ 1 on the mean.
        stations: f32,
    },
    /// The same everywhere.
    Fixed {
        /// Scene units, > 0.
        length: f64,
    },
}

impl Default for MarchStep {
    fn default() -> Self {
        Self::Adaptive { stations: 4.0 }
    }
}

/// Settings of `photon-map`, in the words of Jensen's *Realistic Image Synthesis Using Photon Mapping*.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PhotonMapSettings {
    /// Photons emitted for the caustic map: toward polished and glossy surfaces only, where `projection` says so.
    pub caustic_photons: u32,
    /// Photons emitted for the global map.
    pub global_photons: u32,
    /// Photons emitted for the volume map.
    pub volume_photons: u32,
    /// Photons nearest to a place that an estimate takes, ≥ 2, by map.
    pub nearest: NearestPhotons,
    /// Largest radius in which an estimate looks, scene units; `None` is found from the scene.
    pub max_radius: Option<f64>,
    /// Weight of a photon by its distance.
    pub kernel: PhotonKernel,
    /// Where an estimate collects.
    pub collection: Collection,
    /// Photons in a leaf of the kd-tree, ≥ 1; decides on speed alone.
    pub leaf_size: u32,
    /// Which directions lights emit photons in for the caustic map.
    pub projection: ProjectionMaps,
    /// Cells of a projection map along each of its axes, ≥ 1.
    pub projection_cells: u32,
    /// Whether indirect light comes from gather rays; if not, straight from the global map.
    pub final_gather: bool,
    /// Gather rays per camera path and pass, ≥ 1.
    pub gather_rays: u32,
    /// Whether the global map leaves direct light out and shadow rays add it wherever the map is looked up.
    pub exclude_direct: bool,
    /// Whether the volume map leaves out light that comes straight from the lights and shadow rays add it.
    pub exclude_single_scattering: bool,
    /// Bounces of a photon, at most, singular ones not counted.
    pub max_bounces: u32,
}

impl Default for PhotonMapSettings {
    fn default() -> Self {
        Self {
            caustic_photons: 1_000_000,
            global_photons: 500_000,
            volume_photons: 500_000,
            nearest: NearestPhotons::default(),
            max_radius: None,
            kernel: PhotonKernel::default(),
            collection: Collection::default(),
            leaf_size: 64,
            projection: ProjectionMaps::default(),
            projection_cells: 64,
            final_gather: true,
            gather_rays: 1,
            exclude_direct: false,
            exclude_single_scattering: true,
            max_bounces: 1000,
        }
    }
}

/// Photons that an estimate takes, by map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct NearestPhotons {
    /// Of the caustic map.
    pub caustic: u32,
    /// Of the global map.
    pub global: u32,
    /// Of the volume map.
    pub volume: u32,
}

impl Default for NearestPhotons {
    fn default() -> Self {
        Self { caustic: 60, global: 100, volume: 60 }
    }
}

/// Weight of a photon by its distance from the place of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum PhotonKernel {
    /// The same for all.
    Constant,
    /// Jensen's cone filter.
    Cone {
        /// Slope, ≥ 1: 1 - d / (k r).
        k: f32,
    },
    /// Jensen's Gaussian filter.
    Gaussian,
    /// 1 - d² / r².
    Epanechnikov,
}

impl Default for PhotonKernel {
    fn default() -> Self {
        Self::Cone { k: 1.1 }
    }
}

/// Where an estimate on a surface collects photons.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Collection {
    /// In a ball.
    Sphere,
    /// In a disc about the normal: photons farther off its plane are left out. With n nearest it is the smallest disc of
    /// these proportions that holds n.
    Disc {
        /// Half the disc's thickness as a fraction of its radius (the one found, not the largest), 0…1.
        thickness: f32,
    },
}

impl Default for Collection {
    fn default() -> Self {
        Self::Disc { thickness: 0.25 }
    }
}

/// Toward what lights emit photons for the caustic map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum ProjectionMaps {
    /// Everything.
    None,
    /// The cells, of directions and of places on the light, from which specular objects can be reached.
    #[default]
    Cells,
    /// Cones and discs about the bounds of each specular object.
    Objects,
}

/// What the `debug` integrator shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum DebugView {
    /// Shading normals, -1…1 as 0…1.
    #[default]
    Normal,
    /// Geometric normals, likewise.
    GeometricNormal,
    /// Distance to the first surface, scene units.
    Depth,
    /// Texture coordinates.
    Uv,
    /// A color for each medium: that behind the first surface where it is a boundary, else that before it.
    Medium,
    /// A color for each object.
    Object,
    /// Albedo of the first surface.
    Albedo,
    /// Number of surfaces that a ray through all polished surfaces meets.
    Crossings,
    /// The photons as points, in the color of their power.
    PhotonPower,
    /// The photons as points, in a color for the length of their path.
    PhotonDepth,
    /// The photons as points: those of the global map red, of the caustic map green, of the volume map blue.
    PhotonMap,
    /// Irradiance from the global map at the first surface that is not polished.
    Irradiance,
    /// Irradiance from the caustic map there.
    CausticIrradiance,
    /// Number of photons that an estimate found there: global, caustic, volume as red, green, blue.
    PhotonsFound,
    /// Radius that it used: likewise, scene units.
    PhotonRadius,
}

/// Where sample points come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum SamplerKind {
    /// Owen-scrambled Sobol points: even coverage.
    #[default]
    Sobol,
    /// Independent random numbers: for statistics.
    Independent,
}

/// The picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FilmDescription {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Part to render, [x0, y0, x1, y1] from the top left, ends exclusive.
    pub crop: Option<[u32; 4]>,
    /// How samples spread about a pixel's center.
    pub filter: PixelFilter,
    /// Factor on radiance when developing to 8 bits.
    #[serde(skip)]
    pub exposure: f32,
}

impl Default for FilmDescription {
    fn default() -> Self {
        Self { width: 640, height: 480, crop: None, filter: PixelFilter::default(), exposure: 1.0 }
    }
}

/// Pixel filters that can be importance sampled: non-negative ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub enum PixelFilter {
    /// The pixel's square.
    #[default]
    Box,
    /// A pyramid of this radius, pixels.
    Tent(f32),
    /// A bell, cut off at `radius`.
    Gaussian {
        /// Standard deviation, pixels.
        sigma: f32,
        /// Cut-off, pixels.
        radius: f32,
    },
}
