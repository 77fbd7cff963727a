//! Cones of directions.

use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_sampling::warp;
use smallvec::SmallVec;

/// Versine of the narrowest cone: `f32` directions are no finer.
pub(super) const NARROWEST: f32 = 1e-5;

/// Directions about an axis.
#[derive(Clone, Copy, Debug)]
struct Cone {
    axis: Vec3,
    /// 1 - the cosine of the half-angle.
    versine: f32,
    share: f32,
    /// Density of its directions, sr⁻¹, times its share.
    density: f32,
}

/// Cones of directions, each with a share.
#[derive(Clone, Debug)]
pub(in super::super) struct Cones {
    cones: SmallVec<[Cone; 16]>,
    pub(super) total: f32,
    /// Of drawing a direction at all, 0…1.
    chance: f32,
}

impl Cones {
    /// None yet.
    ///
    /// - `chance`: of drawing a direction at all, 0…1.
    pub(super) fn new(chance: f32) -> Self {
        Self { cones: SmallVec::new(), total: 0.0, chance }
    }

    pub(super) fn push(&mut self, axis: Vec3, versine: f32, share: f32) {
        let versine = versine.max(NARROWEST);
        self.cones.push(Cone { axis, versine, share, density: share * warp::pdf_cone(versine) });
        self.total += share;
    }

    /// A direction; `None` as often as the chance says.
    ///
    /// - `u_choice`, `u`: uniform in [0, 1).
    pub(in super::super) fn sample(&self, u_choice: f32, u: Vec2) -> Option<Vec3> {
        if u_choice >= self.chance {
            return None;
        }
        let mut left = u_choice / self.chance * self.total;
        let is_chosen = |cone: &&Cone| {
            left -= cone.share;
            left < 0.0
        };
        // Rounding may leave a little beyond the last one.
        let Cone { axis, versine, .. } =
            self.cones.iter().find(is_chosen).unwrap_or(&self.cones[self.cones.len() - 1]);
        Some(Frame::from_normal(*axis).to_world(warp::sample_cone(u, *versine)).normalize())
    }

    /// The same cones, drawn from as often as the chance says, 0…1.
    pub(super) fn with_chance(self, chance: f32) -> Self {
        Self { chance, ..self }
    }

    /// Chance of drawing a direction at all, 0…1.
    pub(in super::super) fn chance(&self) -> f32 {
        self.chance
    }

    /// Density of a direction, sr⁻¹: its integral is the chance.
    pub(in super::super) fn pdf(&self, wi: Vec3) -> f32 {
        let within = |cone: &&Cone| 0.5 * (wi - cone.axis).length_squared() <= cone.versine;
        let density: f32 = self.cones.iter().filter(within).map(|cone| cone.density).sum();
        density * self.chance / self.total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;
    use std::f32::consts::TAU;

    fn overlapping() -> Cones {
        let mut cones = Cones::new(0.8);
        cones.push(Vec3::Z, 0.01, 1.0);
        cones.push(Vec3::new(0.1, 0.0, 1.0).normalize(), 0.03, 0.5);
        cones.push(Vec3::X, 0.2, 2.0);
        cones
    }

    #[test]
    fn directions_come_at_their_density() {
        let cones = overlapping();
        let mut random = Random::from_seed(3);
        let mut found = [0.0_f64; 3];
        let count = 200_000;
        for _ in 0..count {
            let u = Vec2::new(random.uniform_f32(), random.uniform_f32());
            let Some(wi) = cones.sample(random.uniform_f32(), u) else { continue };
            // A margin keeps the edges' rounding out of it.
            for (solid_angle, Cone { axis, versine, .. }) in found.iter_mut().zip(&cones.cones) {
                let is_in = 0.5 * (wi - *axis).length_squared() <= 0.99 * versine;
                *solid_angle += if is_in { 1.0 / f64::from(cones.pdf(wi)) } else { 0.0 };
            }
        }
        for (solid_angle, Cone { versine, .. }) in found.into_iter().zip(&cones.cones) {
            let expected = f64::from(TAU * 0.99 * versine);
            let mean = solid_angle / f64::from(count);
            assert!((mean / expected - 1.0).abs() < 0.02, "{mean}, not {expected}");
        }
    }
}
