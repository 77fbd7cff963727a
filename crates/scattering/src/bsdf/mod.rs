//! A finish at a point of a surface: what it does with light, in world space.
//!
//! The structs of this folder know a local frame and nothing else. What concerns all of them is done once, here:
//!
//! - the n² factor: radiance walked from the eye is multiplied by 1 / eta² where it crosses, a photon's flux by 1;
//! - the correction that shading normals ask of importance;
//! - light stays on its side of the true surface: what the shading normal would leak is refused, or, at polished
//!   finishes, scattered about the geometric normal instead, so that no light is lost there.

mod black;
pub mod coat;
mod conductor;
mod dielectric;
mod glossy;
mod local;
mod matte;
mod mirror;
mod pass_through;
mod phong;
mod plastic;
mod rough_conductor;
mod rough_dielectric;
mod rough_plastic;
mod simple_transparent;
#[cfg(test)]
mod tests;
mod thin_dielectric;

pub use black::Black;
pub use coat::CoatTable;
pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use glossy::GlossySpecular;
pub use local::{Bsdf, MIN_ALPHA};
pub use matte::Matte;
pub use mirror::Mirror;
pub use pass_through::PassThrough;
pub use phong::Phong;
pub use plastic::Plastic;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;
pub use rough_plastic::RoughPlastic;
pub use simple_transparent::SimpleTransparent;
pub use thin_dielectric::ThinDielectric;

use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_spectrum::Spectrum;
use local::{LocalBranch, LocalSample};

/// What a path carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transport {
    /// Radiance: the path was started at the eye, and light flows against it.
    Radiance,
    /// Importance: the path was started at a light, as a photon's.
    Importance,
}

/// From where an opaque finish works. Finishes that transmit work from both sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// From the side of the geometric normal; the back is black.
    Front,
    /// From both.
    Both,
}

/// A direction drawn from a BSDF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Where the path goes on: unit, away from the surface.
    pub wi: Vec3,
    /// Factor on the path's throughput: f |cos| / pdf with every correction.
    pub weight: Spectrum,
    /// Density per solid angle, or the probability of the branch where `is_delta`; free of the n² factor.
    pub pdf: f32,
    /// Whether `wi` was the only direction of its branch.
    pub is_delta: bool,
    /// Whether the path crosses the surface.
    pub transmits: bool,
    /// The n² factor that `weight` contains, 1 / eta² or 1; roulette divides it out.
    pub eta_scale: f32,
}

/// One of the directions in which a polished finish sends a ray on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Unit, away from the surface.
    pub wi: Vec3,
    /// Factor on the radiance that comes from there, the n² factor included.
    pub weight: Spectrum,
    /// Whether the ray crosses the surface.
    pub transmits: bool,
    /// The n² factor that `weight` contains, 1 / eta² or 1.
    pub eta_scale: f32,
}

/// A finish at a point, as seen by a path that arrives there.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceBsdf {
    bsdf: Bsdf,
    /// About the shading normal, on the side the path arrived from.
    frame: Frame,
    /// Geometric normal, on the side the path arrived from.
    ng: Vec3,
    lanes: usize,
}

impl SurfaceBsdf {
    /// Places a finish.
    ///
    /// - `bsdf`: indices in it are relative to the side of `wo`.
    /// - `n`, `ng`: shading and geometric normal, unit; `ng` points to the outside.
    /// - `wo`: where the path came from, unit, away from the surface.
    /// - `lanes`: lanes over which choices take means.
    ///
    /// Where `wo` is behind the shading normal, the geometric one takes its place.
    pub fn new(bsdf: Bsdf, n: Vec3, ng: Vec3, wo: Vec3, sides: Sides, lanes: usize) -> Self {
        let is_back = wo.dot(ng) < 0.0;
        let bsdf = match sides {
            Sides::Front if is_back && bsdf.is_opaque() => Bsdf::Black(Black),
            Sides::Front | Sides::Both => bsdf,
        };
        let ng = if is_back { -ng } else { ng };
        let n = if n.dot(ng) < 0.0 { -n } else { n };
        let n = if wo.dot(n) > 0.0 { n } else { ng };
        Self { bsdf, frame: Frame::from_normal(n), ng, lanes }
    }

    /// Draws a direction in which the path goes on; `None` where it ends.
    ///
    /// - `wo`: unit, away from the surface.
    /// - `u_lobe`, `u2`: uniform in [0, 1).
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u2: Vec2, transport: Transport) -> Option<BsdfSample> {
        let (n, sample) = if self.bsdf.is_delta() {
            let (frame, branches) = self.delta_branches(wo)?;
            (frame.n, local::choose(branches, u_lobe, self.lanes)?)
        } else {
            self.sample_lobes(wo, u_lobe, u2)?
        };
        let LocalSample { wi, weight, pdf, is_delta, transmits } = sample;
        let eta_scale = self.eta_scale(wo, transmits, transport);
        let weight = weight * (eta_scale * self.shading_correction(wo, wi, n, transport));
        let is_usable = weight.is_finite() && !weight.is_zero();
        is_usable.then_some(BsdfSample { wi, weight, pdf, is_delta, transmits, eta_scale })
    }

    /// A direction of a finish with lobes, and the normal that it lies about. It may be the mirror direction of a
    /// polished coat.
    fn sample_lobes(&self, wo: Vec3, u_lobe: f32, u2: Vec2) -> Option<(Vec3, LocalSample)> {
        let local = self.bsdf.sample(self.frame.to_local(wo), u_lobe, u2, self.lanes)?;
        let sample = LocalSample { wi: self.frame.to_world(local.wi), ..local };
        if self.keeps_sides(wo, sample.wi, sample.transmits) {
            return Some((self.frame.n, sample));
        }
        // As polished finishes do, a polished coat falls back on the true surface rather than lose light.
        sample
            .is_delta
            .then(|| (self.ng, LocalSample { wi: self.ng * (2.0 * wo.dot(self.ng)) - wo, ..sample }))
    }

    /// f |cos|, sr⁻¹, per lane, with every correction; 0 for polished finishes and without the mirror direction of a
    /// polished coat.
    ///
    /// - `wo`, `wi`: unit, away from the surface; light flows from `wi` to `wo` for radiance, the other way for
    ///   importance.
    pub fn eval(&self, wo: Vec3, wi: Vec3, transport: Transport) -> Spectrum {
        let (local_wo, local_wi) = (self.frame.to_local(wo), self.frame.to_local(wi));
        let transmits = local_wo.z * local_wi.z < 0.0;
        if !self.keeps_sides(wo, wi, transmits) {
            return Spectrum::ZERO;
        }
        let factor = self.eta_scale(wo, transmits, transport)
            * self.shading_correction(wo, wi, self.frame.n, transport);
        self.bsdf.eval(local_wo, local_wi) * factor
    }

    /// Density, sr⁻¹, with which `sample` draws `wi`; 0 for polished finishes. Free of the n² factor.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let (local_wo, local_wi) = (self.frame.to_local(wo), self.frame.to_local(wi));
        if !self.keeps_sides(wo, wi, local_wo.z * local_wi.z < 0.0) {
            return 0.0;
        }
        self.bsdf.pdf(local_wo, local_wi, self.lanes)
    }

    /// `eval` and `pdf` in one, for less than both.
    pub fn eval_with_pdf(&self, wo: Vec3, wi: Vec3, transport: Transport) -> (Spectrum, f32) {
        let (local_wo, local_wi) = (self.frame.to_local(wo), self.frame.to_local(wi));
        let transmits = local_wo.z * local_wi.z < 0.0;
        if !self.keeps_sides(wo, wi, transmits) {
            return (Spectrum::ZERO, 0.0);
        }
        let factor = self.eta_scale(wo, transmits, transport)
            * self.shading_correction(wo, wi, self.frame.n, transport);
        (self.bsdf.eval(local_wo, local_wi) * factor, self.bsdf.pdf(local_wo, local_wi, self.lanes))
    }

    /// Both directions in which a polished finish sends the radiance's ray on; the mirror direction of a polished coat;
    /// neither for other finishes.
    pub fn branches(&self, wo: Vec3) -> [Option<Branch>; 2] {
        let Some((_, branches)) = self.delta_branches(wo) else {
            return [None, None];
        };
        branches.map(|branch| {
            let branch = branch?;
            let LocalBranch { wi, transmits, .. } = branch;
            let eta_scale = self.eta_scale(wo, transmits, Transport::Radiance);
            let weight = branch.weight() * eta_scale;
            (!weight.is_zero()).then_some(Branch { wi, weight, transmits, eta_scale })
        })
    }

    /// The same finish about the geometric normal.
    pub fn without_shading_normal(self) -> Self {
        Self { frame: Frame::from_normal(self.ng), ..self }
    }

    /// Whether the finish is polished: it knows single directions only, and no light can be sampled towards it. A
    /// polished coat over a matte base is not, though `sample` may return its mirror direction, which `is_delta`.
    pub fn is_delta(&self) -> bool {
        self.bsdf.is_delta()
    }

    /// Whether no light crosses the surface here.
    pub fn is_opaque(&self) -> bool {
        self.bsdf.is_opaque()
    }

    /// Whether part of the light is scattered evenly, as by Lambert's law.
    pub fn has_diffuse_part(&self) -> bool {
        matches!(self.bsdf, Bsdf::Matte(_) | Bsdf::Phong(_) | Bsdf::Plastic(_) | Bsdf::RoughPlastic(_))
    }

    /// Roughly the fraction of light that leaves the surface, 0…1 per lane: for the albedo layer.
    pub fn albedo_estimate(&self) -> Spectrum {
        self.bsdf.albedo_estimate()
    }

    /// Width of the widest lobe on the scale of GGX, 0 (polished) … 1 (matte): whether light arriving from elsewhere
    /// is worth gathering here.
    pub fn lobe_width(&self) -> f32 {
        self.bsdf.lobe_width()
    }

    /// Fraction of light that a straight shadow ray of direction `w` takes along through the surface, 0…1 per lane, no
    /// n² factor in it: over a closed body it cancels, and where the light ends inside one, what it gathers by being
    /// bent together makes up for it.
    pub fn straight_transmittance(&self, w: Vec3) -> Spectrum {
        self.bsdf.straight_transmittance(w.dot(self.frame.n).abs().min(1.0))
    }

    /// Branches of a finish that has some with world directions, and the frame they lie in.
    fn delta_branches(&self, wo: Vec3) -> Option<(Frame, [Option<LocalBranch>; 2])> {
        let about = |frame: Frame| {
            let branches = self.bsdf.branches(frame.to_local(wo))?;
            Some(branches.map(|b| b.map(|b| LocalBranch { wi: frame.to_world(b.wi), ..b })))
        };
        let branches = about(self.frame)?;
        let leaks = |b: &LocalBranch| !self.keeps_sides(wo, b.wi, b.transmits);
        if self.frame.n != self.ng && branches.iter().flatten().any(leaks) {
            // A refused branch would lose its share of the light: black rims on meshes of glass.
            let frame = Frame::from_normal(self.ng);
            return about(frame).map(|branches| (frame, branches));
        }
        Some((self.frame, branches))
    }

    /// Whether reflection stays on the side of the true surface, and transmission crosses it.
    fn keeps_sides(&self, wo: Vec3, wi: Vec3, transmits: bool) -> bool {
        let product = wo.dot(self.ng) * wi.dot(self.ng);
        if transmits { product < 0.0 } else { product > 0.0 }
    }

    /// The n² factor: radiance over n² is what stays the same along a ray.
    ///
    /// Source: Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, §5.2.
    fn eta_scale(&self, wo: Vec3, transmits: bool, transport: Transport) -> f32 {
        match transport {
            Transport::Radiance if transmits => {
                let eta = self.bsdf.eta();
                if wo.dot(self.ng) >= 0.0 { 1.0 / (eta * eta) } else { eta * eta }
            }
            Transport::Radiance | Transport::Importance => 1.0,
        }
    }

    /// What importance takes when the shading normal is not the geometric one.
    ///
    /// Source: Veach 1997, §5.3.2, eq. 5.19.
    fn shading_correction(&self, wo: Vec3, wi: Vec3, n: Vec3, transport: Transport) -> f32 {
        match transport {
            Transport::Radiance => 1.0,
            Transport::Importance if n == self.ng => 1.0,
            Transport::Importance => {
                let above = wo.dot(n) * wi.dot(self.ng);
                let below = wo.dot(self.ng) * wi.dot(n);
                if below == 0.0 { 0.0 } else { (above / below).abs() }
            }
        }
    }
}
