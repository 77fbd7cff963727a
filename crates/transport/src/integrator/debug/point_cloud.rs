//! Photons as points: each lights the pixels that look at the surface where it lies.
//!
//! 1. Follow the camera ray to the first surface, polished ones included: what is behind it stays hidden.
//! 2. Ask the maps for the photons within half a pixel's footprint of it.
//! 3. Show the mean of their colors; where there are none, the surface in a dim gray by its slope, to show where the
//!    points are.

use super::code_color;
use crate::first_hit;
use crate::photon::maps::PhotonMaps;
use crate::photon::tree::Region;
use crate::photon::{PackedPhoton, PhotonKind, PhotonMap};
use crate::stats::Stats;
use crate::walk::{self, Event};
use hyaline_film::PixelSample;
use hyaline_math::Ray;
use hyaline_scattering::MediumSet;
use hyaline_scene::DebugView;
use hyaline_spectrum::Spectrum;
use hyaline_world::camera::PixelSpread;
use hyaline_world::{World, mask};

/// Gray of a surface that is seen head on.
const BACKDROP: f32 = 0.03;

/// What points are drawn from.
pub(super) struct PointCloud<'a> {
    pub(super) world: &'a World,
    pub(super) maps: &'a PhotonMaps,
    pub(super) spread: PixelSpread,
    pub(super) show: DebugView,
}

/// Colors added up.
#[derive(Default)]
struct Sum {
    color: Spectrum,
    count: u32,
}

impl PointCloud<'_> {
    /// Whether the view shows points.
    pub(super) fn is_wanted(&self) -> bool {
        matches!(self.show, DebugView::PhotonPower | DebugView::PhotonDepth | DebugView::PhotonMap)
    }

    /// The points along a camera ray, which starts inside `set`.
    pub(super) fn color(
        &self,
        ray: &Ray,
        mut set: MediumSet,
        stats: &mut Stats,
        first: &mut PixelSample,
    ) -> Spectrum {
        let Event::Surface(vertex) = walk::advance(self.world, ray, mask::CAMERA, &mut set, stats) else {
            return Spectrum::ZERO;
        };
        first_hit::record(first, &vertex, ray);
        let radius = 0.5 * self.spread.width_at(vertex.distance);
        let region = Region { center: vertex.hit.p, radius, disc: None };
        let mut sum = Sum::default();
        for (map, color) in [(&self.maps.global, RED), (&self.maps.caustic, GREEN)] {
            map.within(&region, &mut |i, _| self.add(&mut sum, map, *map.payload(i), color));
        }
        match sum.count {
            0 => Spectrum::splat(BACKDROP * vertex.hit.n.dot(ray.direction).abs()),
            _ if self.show == DebugView::PhotonMap => sum.color.map(|lane| lane.min(1.0)),
            count => sum.color / count as f32,
        }
    }

    /// Adds a photon of a map whose color is `map_color`.
    fn add(&self, sum: &mut Sum, map: &PhotonMap, photon: PackedPhoton, map_color: Spectrum) {
        let is_of_caustic_map = std::ptr::eq(map, &self.maps.caustic);
        if self.show == DebugView::PhotonMap {
            sum.color += map_color;
        } else if !is_of_caustic_map && photon.kind() == PhotonKind::Caustic {
            // The caustic map has more and finer ones of the same light.
            return;
        } else if self.show == DebugView::PhotonDepth {
            sum.color += code_color::of_bounces(photon.bounces());
        } else {
            let flux = photon.flux();
            sum.color += flux / flux.max_lane(self.world.lanes).max(f32::MIN_POSITIVE);
        }
        sum.count += 1;
    }
}

/// The global map.
const RED: Spectrum = Spectrum::from_rgb([1.0, 0.0, 0.0]);
/// The caustic map.
const GREEN: Spectrum = Spectrum::from_rgb([0.0, 1.0, 0.0]);
