//! All finishes as one closed type, in the local frame: unit directions away from the surface, z along the normal.
//!
//! Values are free of the n² factor, as photons see them.

use super::*;
use hyaline_optics::fresnel_dielectric;

/// Smaller GGX widths are taken for polished: their peaks are beyond `f32`, and nobody sees the difference.
pub const MIN_ALPHA: f32 = 1e-3;

/// With indices closer than this a rough boundary is taken for polished: it bends by less than a milliradian, which
/// a half vector in `f32` does not resolve.
const MIN_INDEX_STEP: f32 = 1e-3;

/// A finish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bsdf {
    /// See [`Black`].
    Black(Black),
    /// See [`Matte`].
    Matte(Matte),
    /// See [`Phong`].
    Phong(Phong),
    /// See [`GlossySpecular`].
    GlossySpecular(GlossySpecular),
    /// See [`Mirror`].
    Mirror(Mirror),
    /// See [`Conductor`].
    Conductor(Conductor),
    /// See [`RoughConductor`].
    RoughConductor(RoughConductor),
    /// See [`Dielectric`].
    Dielectric(Dielectric),
    /// See [`RoughDielectric`].
    RoughDielectric(RoughDielectric),
    /// See [`ThinDielectric`].
    ThinDielectric(ThinDielectric),
    /// See [`Plastic`].
    Plastic(Plastic),
    /// See [`RoughPlastic`].
    RoughPlastic(RoughPlastic),
    /// See [`SimpleTransparent`].
    SimpleTransparent(SimpleTransparent),
    /// See [`PassThrough`].
    PassThrough(PassThrough),
}

/// A direction drawn in the local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LocalSample {
    pub(super) wi: Vec3,
    /// f |cos| / pdf, 1.
    pub(super) weight: Spectrum,
    /// Per solid angle, or the probability of the branch.
    pub(super) pdf: f32,
    pub(super) is_delta: bool,
    pub(super) transmits: bool,
}

/// A single direction in which a polished finish sends part of the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LocalBranch {
    pub(super) wi: Vec3,
    /// Fraction of the power that goes there, 0…1.
    pub(super) fraction: f32,
    /// Factor on it, 0…1.
    pub(super) tint: Spectrum,
    pub(super) transmits: bool,
}

impl LocalBranch {
    /// Fraction of the power that goes on, 0…1 per lane.
    pub(super) fn weight(&self) -> Spectrum {
        self.tint * self.fraction
    }
}

/// One of the branches, with a probability in proportion to the mean of its weight.
pub(super) fn choose(branches: [Option<LocalBranch>; 2], u_lobe: f32, lanes: usize) -> Option<LocalSample> {
    let means = branches.map(|branch| branch.map_or(0.0, |b| b.fraction * b.tint.mean(lanes)));
    let total = means[0] + means[1];
    let i = usize::from(means[1] > 0.0 && u_lobe * total >= means[0]);
    let LocalBranch { wi, tint, transmits, .. } = branches[i].filter(|_| means[i] > 0.0)?;
    // The fraction cancels before it can round: a lossless bounce of white light has a weight of exactly 1.
    let weight = tint / tint.mean(lanes) * total;
    Some(LocalSample { wi, weight, pdf: means[i] / total, is_delta: true, transmits })
}

/// The relative index that light sees from `wo`, for an `eta` given from +z.
pub(super) fn eta_seen_from(wo: Vec3, eta: f32) -> f32 {
    if wo.z >= 0.0 { eta } else { 1.0 / eta }
}

/// The normal on the side of `wo`.
pub(super) fn normal_towards(wo: Vec3) -> Vec3 {
    if wo.z >= 0.0 { Vec3::Z } else { -Vec3::Z }
}

/// Mirror direction about the normal.
pub(super) fn mirrored(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

impl Bsdf {
    /// A metal, polished or rough by `alpha`.
    ///
    /// - `eta`, `k`: index and extinction index over the index on the side of the path.
    /// - `tint`: factor on the reflected light, 0…1.
    /// - `alpha`: GGX width, 0…1.
    pub fn conductor(eta: Spectrum, k: Spectrum, tint: Spectrum, alpha: f32) -> Self {
        let smooth = Conductor { eta, k, tint };
        if alpha < MIN_ALPHA {
            Self::Conductor(smooth)
        } else {
            Self::RoughConductor(RoughConductor { smooth, alpha })
        }
    }

    /// A boundary of two media, polished or rough by `alpha`; polished where the indices agree.
    ///
    /// - `eta`: index beyond over index on the side of the path, > 0.
    /// - `tint_r`, `tint_t`: factors on the reflected and the transmitted light, 0…1.
    /// - `alpha`: GGX width, 0…1.
    pub fn dielectric(eta: f32, tint_r: Spectrum, tint_t: Spectrum, alpha: f32) -> Self {
        let smooth = Dielectric { eta, tint_r, tint_t };
        if alpha < MIN_ALPHA || (eta - 1.0).abs() < MIN_INDEX_STEP {
            Self::Dielectric(smooth)
        } else {
            Self::RoughDielectric(RoughDielectric { smooth, alpha })
        }
    }

    /// A matte base under a clear coat, polished or rough by `alpha`; matte alone where the coat has the index of its
    /// surroundings.
    ///
    /// - `eta`: index of the coat over that of its surroundings, > 0; `coats`: for this `eta`.
    /// - `diffuse`: reflectance of the base, 0…1; `specular`: factor on what the coat reflects, 0…1.
    /// - `nonlinear`: whether light between base and coat takes the color of the base each time.
    /// - `alpha`: GGX width, 0…1.
    pub fn plastic(
        eta: f32,
        coats: &CoatTable,
        diffuse: Spectrum,
        specular: Spectrum,
        nonlinear: bool,
        alpha: f32,
    ) -> Self {
        if eta == 1.0 {
            Self::Matte(Matte { reflectance: diffuse })
        } else if alpha < MIN_ALPHA {
            Self::Plastic(Plastic::new(eta, diffuse, specular, nonlinear))
        } else {
            let coat = coats.at(alpha);
            Self::RoughPlastic(RoughPlastic::new(eta, alpha, coat, diffuse, specular, nonlinear))
        }
    }

    /// Whether the finish knows single directions only.
    pub fn is_delta(&self) -> bool {
        match self {
            Self::Mirror(_)
            | Self::Conductor(_)
            | Self::Dielectric(_)
            | Self::ThinDielectric(_)
            | Self::SimpleTransparent(_)
            | Self::PassThrough(_) => true,
            Self::Black(_)
            | Self::Matte(_)
            | Self::Phong(_)
            | Self::GlossySpecular(_)
            | Self::RoughConductor(_)
            | Self::RoughDielectric(_)
            | Self::Plastic(_)
            | Self::RoughPlastic(_) => false,
        }
    }

    /// Whether no light crosses.
    pub fn is_opaque(&self) -> bool {
        match self {
            Self::Black(_)
            | Self::Matte(_)
            | Self::Phong(_)
            | Self::GlossySpecular(_)
            | Self::Mirror(_)
            | Self::Conductor(_)
            | Self::RoughConductor(_)
            | Self::Plastic(_)
            | Self::RoughPlastic(_) => true,
            Self::Dielectric(_)
            | Self::RoughDielectric(_)
            | Self::ThinDielectric(_)
            | Self::SimpleTransparent(_)
            | Self::PassThrough(_) => false,
        }
    }

    /// Index at -z over the index at +z by which crossing light is bent; 1 where it goes straight.
    pub(super) fn eta(&self) -> f32 {
        match self {
            Self::Dielectric(b) => b.eta,
            Self::RoughDielectric(b) => b.smooth.eta,
            Self::SimpleTransparent(b) => b.eta,
            Self::Black(_)
            | Self::Matte(_)
            | Self::Phong(_)
            | Self::GlossySpecular(_)
            | Self::Mirror(_)
            | Self::Conductor(_)
            | Self::RoughConductor(_)
            | Self::ThinDielectric(_)
            | Self::Plastic(_)
            | Self::RoughPlastic(_)
            | Self::PassThrough(_) => 1.0,
        }
    }

    /// The single directions of a finish, all of a polished one and the coat of a coated one; `None` for others.
    pub(super) fn branches(&self, wo: Vec3) -> Option<[Option<LocalBranch>; 2]> {
        match self {
            Self::Mirror(b) => Some(b.branches(wo)),
            Self::Conductor(b) => Some(b.branches(wo)),
            Self::Dielectric(b) => Some(b.branches(wo)),
            Self::ThinDielectric(b) => Some(b.branches(wo)),
            Self::SimpleTransparent(b) => Some(b.branches(wo)),
            Self::PassThrough(b) => Some(b.branches(wo)),
            Self::Plastic(b) => Some(b.branches(wo)),
            Self::Black(_)
            | Self::Matte(_)
            | Self::Phong(_)
            | Self::GlossySpecular(_)
            | Self::RoughConductor(_)
            | Self::RoughDielectric(_)
            | Self::RoughPlastic(_) => None,
        }
    }

    /// Draws a direction.
    pub(super) fn sample(&self, wo: Vec3, u_lobe: f32, u2: Vec2, lanes: usize) -> Option<LocalSample> {
        match self {
            Self::Matte(b) => b.sample(wo, u2),
            Self::Phong(b) => b.sample(wo, u_lobe, u2, lanes),
            Self::GlossySpecular(b) => b.sample(wo, u2),
            Self::RoughConductor(b) => b.sample(wo, u2),
            Self::RoughDielectric(b) => b.sample(wo, u_lobe, u2, lanes),
            Self::Plastic(b) => b.sample(wo, u_lobe, u2, lanes),
            Self::RoughPlastic(b) => b.sample(wo, u_lobe, u2, lanes),
            Self::Black(_) => None,
            Self::Mirror(_)
            | Self::Conductor(_)
            | Self::Dielectric(_)
            | Self::ThinDielectric(_)
            | Self::SimpleTransparent(_)
            | Self::PassThrough(_) => choose(self.branches(wo)?, u_lobe, lanes),
        }
    }

    /// f |cos(wi)|, sr⁻¹.
    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        match self {
            Self::Matte(b) => b.eval(wo, wi),
            Self::Phong(b) => b.eval(wo, wi),
            Self::GlossySpecular(b) => b.eval(wo, wi),
            Self::RoughConductor(b) => b.eval(wo, wi),
            Self::RoughDielectric(b) => b.eval(wo, wi),
            Self::Plastic(b) => b.eval(wo, wi),
            Self::RoughPlastic(b) => b.eval(wo, wi),
            Self::Black(_)
            | Self::Mirror(_)
            | Self::Conductor(_)
            | Self::Dielectric(_)
            | Self::ThinDielectric(_)
            | Self::SimpleTransparent(_)
            | Self::PassThrough(_) => Spectrum::ZERO,
        }
    }

    /// Density of `sample`, sr⁻¹.
    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3, lanes: usize) -> f32 {
        match self {
            Self::Matte(b) => b.pdf(wo, wi),
            Self::Phong(b) => b.pdf(wo, wi, lanes),
            Self::GlossySpecular(b) => b.pdf(wo, wi),
            Self::RoughConductor(b) => b.pdf(wo, wi),
            Self::RoughDielectric(b) => b.pdf(wo, wi, lanes),
            Self::Plastic(b) => b.pdf(wo, wi, lanes),
            Self::RoughPlastic(b) => b.pdf(wo, wi, lanes),
            Self::Black(_)
            | Self::Mirror(_)
            | Self::Conductor(_)
            | Self::Dielectric(_)
            | Self::ThinDielectric(_)
            | Self::SimpleTransparent(_)
            | Self::PassThrough(_) => 0.0,
        }
    }

    /// Fraction of light that a straight shadow ray takes along through the surface: what Fresnel's equations let
    /// through, as if the way were not bent.
    ///
    /// - `cos`: cosine of the way to the normal, 0…1, taken for the one on the side of the lower index: so that both
    ///   faces of a pane weigh alike, and neither reflects totally.
    pub(super) fn straight_transmittance(&self, cos: f32) -> Spectrum {
        let polished = |b: &Dielectric| {
            let eta = if b.eta >= 1.0 { b.eta } else { 1.0 / b.eta };
            b.tint_t * (1.0 - fresnel_dielectric(cos, eta))
        };
        match self {
            Self::Dielectric(b) => polished(b),
            Self::RoughDielectric(b) => polished(&b.smooth),
            Self::ThinDielectric(b) => b.transmittance(cos),
            Self::SimpleTransparent(b) => Spectrum::splat(b.k_t),
            Self::PassThrough(_) => Spectrum::ONE,
            Self::Black(_)
            | Self::Matte(_)
            | Self::Phong(_)
            | Self::GlossySpecular(_)
            | Self::Mirror(_)
            | Self::Conductor(_)
            | Self::RoughConductor(_)
            | Self::Plastic(_)
            | Self::RoughPlastic(_) => Spectrum::ZERO,
        }
    }

    pub(super) fn albedo_estimate(&self) -> Spectrum {
        match self {
            Self::Black(_) => Spectrum::ZERO,
            Self::Matte(b) => b.reflectance,
            Self::Phong(b) => b.diffuse + b.specular,
            Self::GlossySpecular(b) => b.reflectance,
            Self::Mirror(b) => b.reflectance,
            Self::Conductor(b) => b.reflectance(1.0),
            Self::RoughConductor(b) => b.smooth.reflectance(1.0),
            Self::Dielectric(b) => b.tint_t,
            Self::RoughDielectric(b) => b.smooth.tint_t,
            Self::ThinDielectric(b) => b.tint,
            Self::SimpleTransparent(b) => Spectrum::splat((b.k_r + b.k_t).min(1.0)),
            Self::Plastic(b) => b.albedo_estimate(),
            Self::RoughPlastic(b) => b.albedo_estimate(),
            Self::PassThrough(_) => Spectrum::ONE,
        }
    }

    pub(super) fn lobe_width(&self) -> f32 {
        match self {
            Self::Black(_)
            | Self::Mirror(_)
            | Self::Conductor(_)
            | Self::Dielectric(_)
            | Self::ThinDielectric(_)
            | Self::SimpleTransparent(_)
            | Self::PassThrough(_) => 0.0,
            Self::Matte(_) => 1.0,
            Self::Phong(b) if !b.diffuse.is_zero() => 1.0,
            Self::Phong(b) => phong::width(b.exponent),
            Self::GlossySpecular(b) => phong::width(b.exponent),
            Self::RoughConductor(b) => b.alpha,
            Self::RoughDielectric(b) => b.alpha,
            Self::Plastic(_) => 1.0,
            Self::RoughPlastic(b) if b.has_base() => 1.0,
            Self::RoughPlastic(b) => b.alpha(),
        }
    }
}
