//! What a path counts for that can be made in several ways.
//!
//! A path from the eye to a light is made by
//!
//! - hitting the light: all directions are drawn from the eye's side;
//! - sampling the light at the last vertex, where that is not singular;
//! - asking for it over polished surfaces at the last vertex before them, where no photons are about (`aimed`);
//! - merging at any vertex that is not singular and not the last one: a photon, which has drawn all directions from the
//!   light's side, lands within the gather radius of it.
//!
//! Densities compare in étendue, n² cos θ dA dω, which is the same on both ends of a free way and of a polished
//! crossing. So the ratio of merging at x to hitting is a product of three kinds of factor:
//!
//! | place | factor |
//! |---|---|
//! | x, [`at_receiver`] | π r² n² cos θ / p(x → light); in a volume 4/3 π r³ n² σ / p; for beams 2 r sin θ n² / (σ p), θ between the two ways |
//! | each vertex between x and the light, [`across`] | p(toward x) n² cos θ on the light's side / (p(toward light) n² cos θ on x's side); 1 where it is singular or in a volume |
//! | light, [`at_light`] | N p_light p_position p_direction / (n² cos θ) |
//!
//! Each way knows the factors of its own side, and so all agree. Weights are those of the power heuristic; any other
//! function of the path would do as well, as long as all ways use the same one: the radius is that of the place, however
//! it was reached, and roulette is left out.
//!
//! Source: Georgiev, Křivánek, Davidovič & Slusallek, Light transport simulation with vertex connection and merging, ACM TOG
//! 31(6), 2012, in other words: their recursive quantities are the sums of squares here.

use std::f32::consts::PI;

/// The factor of a vertex on a surface that photons are merged at.
///
/// - `radius`: gather radius.
/// - `ior`, `cos`: index and cosine (with the geometric normal) on the side of the light.
/// - `pdf`: density of the path's direction toward the light, sr⁻¹.
pub(in crate::integrator) fn at_receiver(radius: f32, ior: f32, cos: f32, pdf: f32) -> f32 {
    PI * radius * radius * ior * ior * cos / pdf
}

/// The factor of the place in a medium that photons are merged at.
///
/// - `sigma`: mean extinction coefficient, 1 / scene unit: photons per length of their way that stop there.
pub(in crate::integrator) fn in_volume(radius: f32, ior: f32, sigma: f32, pdf: f32) -> f32 {
    (4.0 / 3.0) * PI * radius * radius * radius * ior * ior * sigma / pdf
}

/// The factor of a place in a homogeneous medium that beams are merged at, but for the density of the direction.
///
/// - `share`: of the photons that leave beams.
/// - `sin`: sine of the angle between the path and the beam.
/// - `sigma`: mean extinction coefficient, 1 / scene unit: what the path's density along its way is about.
pub(in crate::integrator) fn of_beam(share: f32, radius: f32, sin: f32, ior: f32, sigma: f32) -> f32 {
    share * 2.0 * radius * sin * ior * ior / sigma
}

/// One side of a vertex that photons may pass.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Side {
    /// Density of the direction on this side, drawn from the other, sr⁻¹.
    pub(in crate::integrator) pdf: f32,
    /// Index of refraction.
    pub(in crate::integrator) ior: f32,
    /// Cosine with the geometric normal, 0…1.
    pub(in crate::integrator) cos: f32,
}

impl Side {
    /// Étendue of a unit of area and solid angle.
    fn etendue(&self) -> f32 {
        self.ior * self.ior * self.cos
    }
}

/// The factor of a vertex between the receiver and the light.
pub(in crate::integrator) fn across(toward_receiver: Side, toward_light: Side) -> f32 {
    toward_receiver.pdf * toward_light.etendue() / (toward_light.pdf * toward_receiver.etendue())
}

/// The factor of the light.
///
/// - `photons`: photons sent out in a pass that come this way.
/// - `chance`: of the light among all, for emission; `position`, `direction`: densities of the emitted ray.
/// - `ior`, `cos`: index and cosine at the light; 1 for the cosine at lights without a surface.
pub(in crate::integrator) fn at_light(
    photons: f32,
    chance: f32,
    position: f32,
    direction: f32,
    ior: f32,
    cos: f32,
) -> f32 {
    photons * chance * position * direction / (ior * ior * cos)
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
