//! Beams: directions of light that change with the place, as photons show them.
//!
//! Light that a lens or a pane sends to a small patch comes, at each place of it, from one direction and a little about it, the
//! lamp's image; and that direction turns from place to place, for the image is near or far, or each way another. To first
//! order the turn is linear, and a least-squares fit finds it. What is left is how wide the image is.

use hyaline_math::{DMat3, DVec3, Mat3, Vec3};
use std::ops::Sub;

/// How much wider a beam is than its photons show, times their number: others will come from beyond them.
const SPREAD: f64 = 8.0;
/// Share of the photons that the core of a beam is about.
const CORE: f64 = 0.92;
/// Share of the mean square extent that is added to that along each axis: along the normal of a flat patch there is none.
const RIDGE: f64 = 0.01;
/// Added where rays start in one place; far below any scene's extents, and its cube is a normal number.
const NO_EXTENT: f64 = 1e-90;
/// Numbers that a fit has for each coordinate of the direction, on a surface.
const FITTED: f64 = 3.0;
/// What is left of the weight of a photon in a fit to the others, at least.
const LEAST_LEFT: f64 = 0.25;

/// A photon's place and the unit direction that it came from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incidence {
    pub(super) p: DVec3,
    pub(super) u: DVec3,
}

/// Sums over rays, about a base.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments {
    count: f64,
    p: DVec3,
    u: DVec3,
    /// Sums of products of coordinates of `p`.
    pp: DMat3,
    /// Its columns: sums of `u` times a coordinate of `p`.
    up: DMat3,
    uu: f64,
}

impl Moments {
    /// Of no rays.
    pub(super) const ZERO: Self =
        Self { count: 0.0, p: DVec3::ZERO, u: DVec3::ZERO, pp: DMat3::ZERO, up: DMat3::ZERO, uu: 0.0 };

    /// The sums over rays.
    pub(super) fn of(rays: impl IntoIterator<Item = Incidence>, base: &Incidence) -> Self {
        rays.into_iter().fold(Self::ZERO, |sum, ray| sum.including(&ray, base))
    }

    /// The sums with a further ray.
    pub(super) fn including(mut self, ray: &Incidence, base: &Incidence) -> Self {
        let (p, u) = (ray.p - base.p, ray.u - base.u);
        self.count += 1.0;
        self.p += p;
        self.u += u;
        self.pp += outer(p, p);
        self.up += outer(u, p);
        self.uu += u.length_squared();
        self
    }

    /// Rays times the solid angle of the beam through them, about.
    pub(super) fn cost(&self) -> f64 {
        let n = self.count;
        if n <= FITTED {
            return f64::INFINITY;
        }
        let (turn, cross) = (self.turn(), self.cross());
        let explained =
            turn.x_axis.dot(cross.x_axis) + turn.y_axis.dot(cross.y_axis) + turn.z_axis.dot(cross.z_axis);
        let left = (self.uu - self.u.length_squared() / n - explained).max(0.0);
        left * n / (n - FITTED)
    }

    /// Change of direction by place.
    fn turn(&self) -> DMat3 {
        self.cross() * self.inverse_spread()
    }

    /// Sums of products of directions and places, both about their means.
    fn cross(&self) -> DMat3 {
        self.up - outer(self.u, self.p) * (1.0 / self.count)
    }

    /// Inverse of the sums of squares of places about their mean, a little more in all directions.
    fn inverse_spread(&self) -> DMat3 {
        let spread = self.pp - outer(self.p, self.p) * (1.0 / self.count);
        let ridge = RIDGE * (spread.x_axis.x + spread.y_axis.y + spread.z_axis.z) + NO_EXTENT;
        (spread + DMat3::from_diagonal(DVec3::splat(ridge))).inverse()
    }
}

impl Sub for Moments {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            count: self.count - other.count,
            p: self.p - other.p,
            u: self.u - other.u,
            pp: self.pp - other.pp,
            up: self.up - other.up,
            uu: self.uu - other.uu,
        }
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Directions about an axis that turns from place to place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Beam {
    center: Vec3,
    /// At the center.
    axis: Vec3,
    /// Change of the axis by place.
    turn: Mat3,
    /// 1 - the cosine of the half-angle that most directions are within.
    pub(super) core: f32,
    /// The same for all, and somewhat more: nearly parallel to light of the image there is light that took other ways.
    pub(super) whole: f32,
}

impl Beam {
    /// A beam that holds rays, and somewhat more.
    ///
    /// # Panics
    /// Where there is no ray.
    pub(super) fn through(rays: &[Incidence]) -> Self {
        let sums = Moments::of(rays.iter().copied(), &rays[0]);
        let n = sums.count;
        let (center, axis) = (rays[0].p + sums.p / n, rays[0].u + sums.u / n);
        let (turn, inverse) = (sums.turn(), sums.inverse_spread());
        // How far each would be from a fit to the others.
        let mut chords: Vec<f64> = rays
            .iter()
            .map(|ray| {
                let offset = ray.p - center;
                let fitted = (axis + turn * offset).normalize_or(ray.u);
                let leverage = 1.0 / n + offset.dot(inverse * offset);
                (ray.u - fitted).length() / (1.0 - leverage).max(LEAST_LEFT)
            })
            .collect();
        chords.sort_unstable_by(f64::total_cmp);
        let versine = |chord: f64| (0.5 * chord * chord).min(2.0) as f32;
        let last = chords.len() - 1;
        Self {
            center: center.as_vec3(),
            axis: axis.as_vec3(),
            turn: turn.as_mat3(),
            core: versine(chords[(last as f64 * CORE) as usize]),
            whole: versine(chords[last] * (1.0 + SPREAD / n)),
        }
    }

    /// The middle of the directions at a place, unit.
    pub(super) fn axis(&self, p: Vec3) -> Vec3 {
        (self.axis + self.turn * (p - self.center)).try_normalize().unwrap_or(Vec3::Z)
    }

    /// Whether any of its directions at a place rises over the surface of the normal `n`.
    ///
    /// - `axis`: the middle of them.
    pub(super) fn rises_over(&self, axis: Vec3, n: Vec3) -> bool {
        let cos = axis.dot(n);
        cos > 0.0 || self.whole >= 1.0 || cos * cos < self.whole * (2.0 - self.whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;

    /// Places on a square of a half unit, and for each the direction to a point that `from` makes of it.
    fn rays(count: usize, mut from: impl FnMut(&mut Random, DVec3) -> DVec3) -> Vec<Incidence> {
        let mut random = Random::from_seed(8);
        let ray = |_| {
            let p = DVec3::new(random.between(-0.25, 0.25), random.between(-0.25, 0.25), 0.0);
            Incidence { p, u: (from(&mut random, p) - p).normalize() }
        };
        (0..count).map(ray).collect()
    }

    /// Angle between the axis at a place and a direction, radians.
    fn off(beam: &Beam, ray: &Incidence) -> f64 {
        (beam.axis(ray.p.as_vec3()).as_dvec3() - ray.u).length()
    }

    fn angle(versine: f32) -> f64 {
        (2.0 * f64::from(versine)).sqrt()
    }

    #[test]
    fn a_beam_is_as_narrow_as_the_lamp_however_large_the_patch() {
        let lamp = |random: &mut Random, _: DVec3| {
            DVec3::new(0.3, 0.1, 2.0)
                + DVec3::new(random.between(-0.02, 0.02), random.between(-0.02, 0.02), 0.0)
        };
        let beam = Beam::through(&rays(128, lamp));
        // The patch is seen from the lamp within 0.18 rad; the lamp from the patch within 0.014.
        assert!(angle(beam.whole) < 0.02 && angle(beam.core) < angle(beam.whole), "{beam:?}");
        let others = rays(2000, lamp);
        let within = |versine| others.iter().filter(|ray| off(&beam, ray) < angle(versine)).count();
        assert!(within(beam.whole) > 1990 && within(beam.core) > 1700);
    }

    #[test]
    fn the_two_ways_across_may_turn_differently() {
        // A cylindrical lens: a line image at one distance, another across it farther on.
        let lens = |_: &mut Random, p: DVec3| DVec3::new(-0.5 * p.x, 0.3 * p.y, 1.0);
        let beam = Beam::through(&rays(64, lens));
        for ray in rays(500, lens) {
            assert!(off(&beam, &ray) < 0.02, "{ray:?}");
        }
    }

    #[test]
    fn to_fit_less_than_the_whole_costs_more() {
        let two = |random: &mut Random, _: DVec3| {
            DVec3::new(if random.uniform() < 0.5 { -1.0 } else { 1.0 }, 0.0, 1.0)
        };
        let all = rays(100, two);
        let (left, right): (Vec<Incidence>, Vec<Incidence>) = all.iter().partition(|ray| ray.u.x < 0.0);
        let sums = |rays: &[Incidence]| Moments::of(rays.iter().copied(), &all[0]);
        let whole = sums(&all);
        assert!(sums(&left).cost() + sums(&right).cost() < 0.01 * whole.cost());
        assert!((whole - sums(&left)).cost() < 0.01 * whole.cost());
    }

    #[test]
    fn few_rays_rays_in_line_and_equal_rays_make_a_beam() {
        let in_line: Vec<Incidence> =
            (0..9).map(|i| Incidence { p: DVec3::X * f64::from(i), u: DVec3::new(0.0, 0.6, 0.8) }).collect();
        for rays in [&in_line[..], &in_line[..1], &[in_line[3]; 7]] {
            let beam = Beam::through(rays);
            assert!(rays.iter().all(|ray| off(&beam, ray) < 1e-6), "{beam:?}");
            assert!(beam.whole < 1e-6 && Moments::of(rays.iter().copied(), &rays[0]).cost() >= 0.0);
        }
    }
}
