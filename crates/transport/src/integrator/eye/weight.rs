//! What a path counts for that can be made in several ways.
//!
//! Take a path whose wide vertex x nearest to the light is joined with it by a chain of polished or nearly polished ones.
//! It is made by
//!
//! - hitting the light: directions drawn at x and at each vertex of the chain;
//! - sampling the light at the last vertex of the chain, where that is rough;
//! - merging: a photon that lands within the gather radius of x.
//!
//! Densities compare in étendue, n² cos θ dA dω, which is the same on both ends of a free way and of a polished
//! crossing. So the ratio of merging to hitting is a product of three kinds of factor:
//!
//! | place | factor |
//! |---|---|
//! | x, [`at_receiver`] | N π r² n² cos θ / p(x → chain); in a volume N 4/3 π r³ n² σ / p |
//! | rough vertex of the chain, [`across`] | p(toward x) n² cos θ on the light's side / (p(toward light) n² cos θ on x's side) |
//! | light, [`at_light`] | p_light p_position p_direction / (n² cos θ) |
//!
//! Merging and hitting know all factors of their side, and so agree. Weights are those of the power heuristic; any other
//! function of the path would do as well, as long as all ways use the same one.

use std::f32::consts::PI;

/// The factor of the vertex that photons are merged at, on a surface.
///
/// - `photons`: photons of a pass; `radius`: gather radius.
/// - `ior`, `cos`: index and cosine (with the geometric normal) on the side of the chain.
/// - `pdf`: density of the path's direction toward the chain, sr⁻¹.
pub(in crate::integrator) fn at_receiver(photons: f32, radius: f32, ior: f32, cos: f32, pdf: f32) -> f32 {
    photons * PI * radius * radius * ior * ior * cos / pdf
}

/// The factor of the place in a medium that photons are merged at.
///
/// - `sigma`: mean extinction coefficient, 1 / scene unit: photons per length of their way that stop there.
pub(in crate::integrator) fn in_volume(photons: f32, radius: f32, ior: f32, sigma: f32, pdf: f32) -> f32 {
    photons * (4.0 / 3.0) * PI * radius * radius * radius * ior * ior * sigma / pdf
}

/// One side of a rough vertex of the chain.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct SideOfChain {
    /// Density of the direction on this side, drawn from the other, sr⁻¹.
    pub(in crate::integrator) pdf: f32,
    /// Index of refraction.
    pub(in crate::integrator) ior: f32,
    /// Cosine with the geometric normal, 0…1.
    pub(in crate::integrator) cos: f32,
}

/// The factor of a rough vertex of the chain.
pub(in crate::integrator) fn across(toward_receiver: SideOfChain, toward_light: SideOfChain) -> f32 {
    let etendue = |side: SideOfChain| side.ior * side.ior * side.cos;
    toward_receiver.pdf * etendue(toward_light) / (toward_light.pdf * etendue(toward_receiver))
}

/// The factor of the light.
///
/// - `chance`: of the light among all, for emission; `position`, `direction`: densities of the emitted ray.
/// - `ior`, `cos`: index and cosine at the light; 1 for the cosine at lights without a surface.
pub(in crate::integrator) fn at_light(chance: f32, position: f32, direction: f32, ior: f32, cos: f32) -> f32 {
    chance * position * direction / (ior * ior * cos)
}

/// The power heuristic among one way and others.
///
/// - `squares`: sum of the squares of the others' densities over that of this one; may be infinite.
pub(in crate::integrator) fn power(squares: f32) -> f32 {
    if squares.is_nan() { 0.0 } else { 1.0 / (1.0 + squares) }
}

/// What one way counts among those that are on.
///
/// - `is_on`: whether it is; where it is not, it counts only where no other can make the path.
/// - `squares`: as for [`power`].
pub(in crate::integrator) fn share(is_on: bool, squares: f32) -> f32 {
    match is_on {
        true => power(squares),
        false => f32::from(u8::from(squares == 0.0)),
    }
}
