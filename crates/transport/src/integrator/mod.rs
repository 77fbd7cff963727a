//! What an integrator is: something that prepares, and then renders numbered passes that know nothing of each other.

pub mod debug;
mod eye;
mod merging;
mod path;
mod per_pixel;
mod photon_map;
mod whitted;

pub use debug::DebugIntegrator;
pub use merging::MergingIntegrator;
pub use path::{PathIntegrator, radiance};
pub use photon_map::PhotonMapIntegrator;
pub use whitted::WhittedIntegrator;

use crate::photon::maps::PhotonStatistics;
use crate::stats::Stats;
use hyaline_film::{PixelSample, Rect};
use hyaline_world::World;
use std::sync::atomic::AtomicBool;

/// Which picture of the world is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Index of the camera in the world.
    pub camera: usize,
    /// Width of the full frame, pixels.
    pub width: u32,
    /// Height of the full frame, pixels.
    pub height: u32,
    /// How samples spread about a pixel's center.
    pub filter: hyaline_world::camera::PixelFilter,
}

/// What all integrators can be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Where sample points come from.
    pub sampler: hyaline_sampling::SamplerKind,
    /// Most bounces of a path that are not singular crossings (`whitted`: depth of the recursion).
    pub max_depth: Option<u32>,
    /// `whitted`: a branch ends when its weight falls below this, 0…1.
    pub min_weight: f32,
    /// `whitted`: shadow rays per area light and hit, ≥ 1.
    pub light_samples: u32,
    /// `whitted`, `photon-map`: how the eye marches through media that scatter.
    pub march: hyaline_scene::MarchStep,
    /// `photon-map`: what its stages do.
    pub photon_map: hyaline_scene::PhotonMapSettings,
    /// `debug`: what it shows.
    pub debug: hyaline_scene::DebugView,
    /// `path`, `merging`: what they do; less than all for tests and ablations.
    pub techniques: hyaline_scene::Techniques,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            seed: 0,
            sampler: hyaline_sampling::SamplerKind::Sobol,
            max_depth: None,
            min_weight: 1.0 / 512.0,
            light_samples: 1,
            march: hyaline_scene::MarchStep::default(),
            photon_map: hyaline_scene::PhotonMapSettings::default(),
            debug: hyaline_scene::DebugView::default(),
            techniques: hyaline_scene::Techniques::default(),
        }
    }
}

/// A way to carry light. Called once a render.
pub trait Integrator: Send + Sync {
    /// Name on the command line.
    fn name(&self) -> &'static str;

    /// Learns what all passes share, from a fixed number of rays over the full frame: the same for every crop,
    /// length and split of the render. Stops early, with a useless result, when `cancel` is set.
    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w>;
}

/// An integrator that has learned what it needs.
pub trait Prepared: Send + Sync {
    /// Does the work that all pixels of pass number `pass` share.
    fn begin_pass<'a>(&'a self, pass: u32, stats: &mut Stats) -> Box<dyn Pass + 'a>;

    /// What the photon stage did; `None` for integrators without one.
    fn photon_statistics(&self) -> Option<PhotonStatistics> {
        None
    }
}

/// One pass: one sample per pixel.
pub trait Pass: Send + Sync {
    /// Renders the pixels of `tile`, row by row, into `samples`, which holds `tile.area()` of them.
    ///
    /// A sample depends on (seed, pixel, pass) alone.
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats);
}

/// Names of the integrators there are, the default first.
pub const NAMES: [&str; 5] = ["merging", "path", "photon-map", "whitted", "debug"];

/// The integrator of that name.
pub fn by_name(name: &str) -> Option<Box<dyn Integrator>> {
    match name {
        "path" => Some(Box::new(PathIntegrator)),
        "photon-map" => Some(Box::new(PhotonMapIntegrator)),
        "merging" => Some(Box::new(MergingIntegrator)),
        "whitted" => Some(Box::new(WhittedIntegrator)),
        "debug" => Some(Box::new(DebugIntegrator)),
        _ => None,
    }
}
