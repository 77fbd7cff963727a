//! Estimates from photons: radiance and irradiance on surfaces, radiance scattered in media.
//!
//! With n nearest, the n-th photon fixes the radius and is not counted: given the radius, the n - 1 nearer ones lie
//! evenly in the disc, so their number over its area has the right mean, which n over it has not. Where fewer than n lie
//! within the largest radius, that is the radius, and all count.
//!
//! Photons that cannot contribute (wrong kind, wrong side of the surface) are left out before any is counted, or they
//! would shrink the radius: on both sides of a thin wall each side is estimated as if the other were not there.

use super::clip::Clip;
use super::kernel::Kernel;
use super::record::{PackedPhoton, Photon, PhotonKind};
use super::tree::{Disc, Nearest, PointTree, Region};
use hyaline_geometry::SurfaceHit;
use hyaline_math::Vec3;
use hyaline_scattering::bsdf::{SurfaceBsdf, Transport};
use hyaline_scene::Collection;
use hyaline_spectrum::Spectrum;

/// Photons, by place.
pub type PhotonMap = PointTree<PackedPhoton>;

impl PhotonMap {
    /// A map of photons; see [`PointTree::build`].
    pub fn from_photons(photons: &[Photon], leaf_size: u32) -> Self {
        Self::build(photons.iter().map(Photon::pack).collect(), leaf_size)
    }

    /// The photon of an index.
    ///
    /// # Panics
    /// Where there is none.
    pub fn photon(&self, i: u32) -> Photon {
        self.payload(i).unpack(self.position(i))
    }
}

/// How an estimate is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Weight by distance.
    pub kernel: Kernel,
    /// Photons to look for, ≥ 2; the last one fixes the radius.
    pub nearest: usize,
    /// Largest radius in which to look, scene units, > 0; may be infinite.
    pub max_radius: f32,
    /// Where photons are collected on a surface; in media it is always a ball.
    pub collection: Collection,
}

/// What an estimate found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered {
    /// The estimate; its unit depends on what was asked.
    pub value: Spectrum,
    /// Photons found, the one that fixed the radius included.
    pub found: u32,
    /// Radius that was used, scene units.
    pub radius: f32,
}

/// Cosines below this are taken for it: stored directions are no finer, and the quotient of two cosines about different
/// normals would have no bound.
const MIN_COS: f32 = 1e-3;

/// Scene units; the volume of a smaller ball is beyond `f32`. Only photons that coincide at the origin come to it.
const MIN_RADIUS: f32 = 1e-12;

impl Estimate {
    /// Radiance that leaves a surface toward `wo` by the light of the photons, W sr⁻¹ m⁻².
    ///
    /// Photons on the other side of the surface count only where the finish transmits.
    ///
    /// - `bsdf`: finish at `hit`; polished ones give 0.
    /// - `wo`: unit, away from the surface.
    /// - `accept`: which photons count.
    pub fn radiance(
        &self,
        map: &PhotonMap,
        hit: &SurfaceHit,
        bsdf: &SurfaceBsdf,
        wo: Vec3,
        accept: impl Fn(PhotonKind) -> bool,
        scratch: &mut Nearest,
    ) -> Gathered {
        let n = if wo.dot(hit.ng) < 0.0 { -hit.ng } else { hit.ng };
        let is_opaque = bsdf.is_opaque();
        let counts = |photon: PackedPhoton| accept(photon.kind()) && (!is_opaque || photon.arrives_from(n));
        let region = self.surface_region(hit.p, n);
        let disc = self.collect(map, &region, hit.p_error, counts, scratch);
        self.sum(map, scratch, disc, self.kernel.disc_norm(disc.radius2), |photon| {
            let wi = -photon.direction();
            // `eval` holds the cosine about the shading normal; the photon's flux that about the true one.
            bsdf.eval(wo, wi, Transport::Radiance) * (photon.flux() * (1.0 / wi.dot(n).abs().max(MIN_COS)))
        })
    }

    /// Irradiance of the side of a surface that `n` points to, W m⁻².
    ///
    /// - `n`: geometric normal, unit.
    /// - `accept`: which photons count.
    pub fn irradiance(
        &self,
        map: &PhotonMap,
        p: Vec3,
        n: Vec3,
        accept: impl Fn(PhotonKind) -> bool,
        scratch: &mut Nearest,
    ) -> Gathered {
        let counts = |photon: PackedPhoton| accept(photon.kind()) && photon.arrives_from(n);
        let disc = self.collect(map, &self.surface_region(p, n), 0.0, counts, scratch);
        self.sum(map, scratch, disc, self.kernel.disc_norm(disc.radius2), |photon| photon.flux())
    }

    /// Radiance that a medium scatters toward the eye on a unit of path, W sr⁻¹ m⁻³: σ_s ∫ p L dω.
    ///
    /// Photons in media hold what leaves the collision ([`Photon::flux`]), so no coefficient of the medium is needed.
    ///
    /// - `phase`: phase function toward the eye, sr⁻¹, by the direction in which a photon traveled.
    /// - `clip`: what of a ball of that radius about `p` counts.
    pub fn volume(
        &self,
        map: &PhotonMap,
        p: Vec3,
        phase: impl Fn(Vec3) -> f32,
        clip: impl FnOnce(f32) -> Clip,
        scratch: &mut Nearest,
    ) -> Gathered {
        let region = Region { center: p, radius: self.max_radius, disc: None };
        let Collected { radius2, found } = self.collect(map, &region, 0.0, |_| true, scratch);
        let radius = radius2.sqrt();
        if scratch.is_empty() {
            return Gathered { value: Spectrum::ZERO, found, radius };
        }
        let clip = clip(radius);
        let mut value = Spectrum::ZERO;
        for (distance2, i) in scratch.iter() {
            if clip.holds(map.position(i)) {
                let photon = map.payload(i);
                let weight = phase(photon.direction()) * self.kernel.weight(distance2, radius2);
                value += photon.flux() * weight;
            }
        }
        Gathered { value: value * (self.kernel.ball_norm(radius2) / clip.share), found, radius }
    }

    fn surface_region(&self, p: Vec3, normal: Vec3) -> Region {
        let disc = match self.collection {
            Collection::Sphere => None,
            Collection::Disc { thickness } => Some(Disc { normal, thickness }),
        };
        Region { center: p, radius: self.max_radius, disc }
    }

    /// Leaves the photons that count in `scratch`, and finds the radius.
    fn collect(
        &self,
        map: &PhotonMap,
        region: &Region,
        p_error: f32,
        counts: impl Fn(PackedPhoton) -> bool,
        scratch: &mut Nearest,
    ) -> Collected {
        let nearest = self.nearest.max(2);
        map.nearest(region, nearest, |i: u32| counts(*map.payload(i)), scratch);
        let found = scratch.len() as u32;
        let radius = match scratch.take_farthest(nearest) {
            Some(distance2) => distance2.sqrt(),
            None => self.max_radius,
        };
        // Photons that coincide say no more than that they are as close as positions can tell.
        let rounding = region.center.abs().max_element() * f32::EPSILON;
        Collected { radius2: radius.max(p_error).max(rounding).max(MIN_RADIUS).powi(2), found }
    }

    /// Sum of what the photons contribute, weighted.
    fn sum(
        &self,
        map: &PhotonMap,
        nearest: &Nearest,
        Collected { radius2, found }: Collected,
        norm: f32,
        contribution: impl Fn(PackedPhoton) -> Spectrum,
    ) -> Gathered {
        let mut value = Spectrum::ZERO;
        for (distance2, i) in nearest.iter() {
            value += contribution(*map.payload(i)) * self.kernel.weight(distance2, radius2);
        }
        Gathered { value: value * norm, found, radius: radius2.sqrt() }
    }
}

/// Where photons were collected.
#[derive(Clone, Copy)]
struct Collected {
    /// Radius squared, > 0.
    radius2: f32,
    /// Photons within it.
    found: u32,
}

#[cfg(test)]
mod tests;
