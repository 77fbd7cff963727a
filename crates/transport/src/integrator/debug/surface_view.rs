//! What one camera ray finds, without any light.

use super::{code_color, polished};
use crate::RenderSettings;
use crate::first_hit;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex};
use hyaline_film::PixelSample;
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_scene::DebugView;
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};

/// The value that [`RenderSettings::debug`] asks for, along one camera ray; black where the ray meets nothing.
///
/// The first surface is the first that does something: boundaries that are hidden, index matched or mere bounds are
/// crossed as they are in every integrator.
pub(super) fn value(
    world: &World,
    settings: &RenderSettings,
    ray: Ray,
    mut set: MediumSet,
    sampler: &mut Sampler,
    stats: &mut Stats,
    first: Option<&mut PixelSample>,
) -> Spectrum {
    if settings.debug == DebugView::Crossings {
        return Spectrum::splat(polished::look(world, ray, set, sampler, stats, first).surfaces as f32);
    }
    match walk::advance(world, &ray, mask::CAMERA, &mut set, stats) {
        Event::Sky { .. } if settings.debug == DebugView::Medium => code_color::of_medium(set.active().0),
        Event::Sky { .. } => Spectrum::ZERO,
        Event::Surface(vertex) => {
            if let Some(sample) = first {
                first_hit::record(sample, &vertex, &ray);
            }
            value_at(world, settings.debug, &vertex, &set)
        }
    }
}

/// The value at the first surface, which a path within `set` has come to.
fn value_at(world: &World, view: DebugView, vertex: &Vertex, set: &MediumSet) -> Spectrum {
    match view {
        DebugView::Normal => from_direction(vertex.hit.n),
        DebugView::GeometricNormal => from_direction(vertex.hit.ng),
        DebugView::Depth => Spectrum::splat(vertex.distance),
        DebugView::Uv => Spectrum::from_rgb([vertex.hit.uv.x, vertex.hit.uv.y, 0.0]),
        DebugView::Medium => code_color::of_medium(vertex.far_set(world, set).active().0),
        DebugView::Object => code_color::of_index(vertex.object.0),
        DebugView::Albedo => vertex.bsdf.albedo_estimate(),
        // Shown elsewhere: by `polished` and `photon_view`.
        DebugView::Crossings
        | DebugView::PhotonPower
        | DebugView::PhotonDepth
        | DebugView::PhotonMap
        | DebugView::Irradiance
        | DebugView::CausticIrradiance
        | DebugView::PhotonsFound
        | DebugView::PhotonRadius => Spectrum::ZERO,
    }
}

/// A unit vector as a color: -1…1 as 0…1.
fn from_direction(direction: Vec3) -> Spectrum {
    Spectrum::from_rgb((0.5 + 0.5 * direction).to_array())
}
