//! How to render: everything of a scene that is not the scene.

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
