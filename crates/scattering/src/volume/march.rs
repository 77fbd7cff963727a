//! Marching: the light that a medium scatters toward the eye, gathered at stations along a ray.
//!
//! L = ∫ T j dt is the sum of T j Δ over stations, T what is left on the way back to the eye and j what the medium scatters
//! toward it there. The stations are
//!
//! - at equal steps: one in each, at a random place, Δ its length;
//! - or a random step Δ = -ln ξ / λ apart. Then each stands for 1 / λ: their sum has the right mean for any rate λ that
//!   says nothing of what lies ahead. It is the extinction of what is still alive of the light, times the number of
//!   stations wanted on a mean free path; lanes share their stations, and as T and j are taken lane by lane no color is
//!   favored. In a grid stations follow the local upper bounds of the density, and T is that of ratio tracking over the
//!   same stations.
//!
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, §10.4.

use super::flight::{collision_rate, emission_along};
use super::grid::{Grid, Inside};
use super::majorants::Stretch;
use super::tracking::{FAINT, next_step};
use crate::Medium;
use hyaline_math::{Ray, float};
use hyaline_sampling::Rng;
use hyaline_spectrum::Spectrum;

/// Most equal steps on one way: shorter steps are lengthened.
const MOST_STEPS: f32 = 4096.0;

/// Optical depth at which equal steps on an endless way end.
const DEEPEST: f32 = 16.0;

/// How far the stations of a march are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Always the same.
    Fixed {
        /// Scene units, > 0.
        length: f32,
    },
    /// -ln ξ / λ: short where the medium is dense.
    Adaptive {
        /// Stations on a mean free path, ≥ 1 on the mean.
        stations: f32,
    },
}

/// A place where a march asks for light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Distance along the ray, scene units.
    pub t: f32,
    /// Factor on the light that is scattered toward the eye on a unit of path: T Δ, scene units.
    pub weight: Spectrum,
    /// Scattering coefficient there, 1 / scene unit.
    pub sigma_s: Spectrum,
}

/// What a march found besides its stations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marched {
    /// Fraction of light left on the whole way.
    pub transmittance: Spectrum,
    /// Light of the medium itself, as it arrives at the ray's origin, W sr⁻¹ m⁻².
    pub emitted: Spectrum,
}

/// Who marches.
#[derive(Clone, Copy, Debug)]
pub struct Marcher {
    /// How long the steps are.
    pub step: Step,
    /// What the path carries: lanes that carry much decide where the stations are.
    pub throughput: Spectrum,
    /// Lanes that count.
    pub lanes: usize,
}

impl Marcher {
    /// Marches through a medium.
    ///
    /// - `ray`: the way, from its origin.
    /// - `distance`: its length, scene units, > 0; may be infinite.
    /// - `visit`: told every station.
    pub fn march(
        &self,
        medium: &Medium,
        ray: &Ray,
        distance: f32,
        rng: &mut Rng,
        visit: &mut impl FnMut(Station),
    ) -> Marched {
        let Some(grid) = &medium.grid else {
            if medium.scatters() {
                match self.step {
                    Step::Fixed { length } => self.equal_steps(medium, length, distance, rng, visit),
                    Step::Adaptive { stations } => self.free_steps(medium, stations, distance, rng, visit),
                }
            }
            let transmittance = medium.transmittance(distance);
            return Marched { transmittance, emitted: emission_along(medium, medium.sigma_t(), distance) };
        };
        let mut gridded =
            Gridded { medium, grid, ray, lanes: self.lanes, left: Spectrum::ONE, emitted: Spectrum::ZERO };
        if let Some(line) = grid.inside(ray.origin, ray.direction, distance) {
            match self.step {
                Step::Fixed { length } => gridded.equal_steps(line, length, rng, visit),
                Step::Adaptive { stations } => gridded.free_steps(line, stations, rng, visit),
            }
        }
        Marched { transmittance: gridded.left, emitted: gridded.emitted }
    }

    /// Random steps through a homogeneous medium.
    fn free_steps(
        &self,
        medium: &Medium,
        stations: f32,
        distance: f32,
        rng: &mut Rng,
        visit: &mut impl FnMut(Station),
    ) {
        let (sigma_t, mut t) = (medium.sigma_t(), 0.0);
        let mut patience = Patience::new(self, medium);
        while let Some(alive) = patience.go_on(medium.transmittance(t), rng) {
            // Lanes count by what they still carry: as the dense ones die out, steps grow.
            let (alive_sigma, alive) = (sum(alive * sigma_t, self.lanes), sum(alive, self.lanes));
            let rate = stations * alive_sigma / alive;
            t += next_step(rate, rng);
            if t >= distance {
                return;
            }
            let weight = medium.transmittance(t) * (patience.worth / rate);
            visit(Station { t, weight, sigma_s: medium.sigma_s });
        }
    }

    /// Equal steps through a homogeneous medium.
    fn equal_steps(
        &self,
        medium: &Medium,
        length: f32,
        distance: f32,
        rng: &mut Rng,
        visit: &mut impl FnMut(Station),
    ) {
        let mut patience = Patience::new(self, medium);
        let (count, step) = steps(distance.min(depth_end(medium, self.lanes)), length);
        for i in 0..count {
            let t = (i as f32 + rng.uniform()) * step;
            let transmittance = medium.transmittance(t);
            if patience.go_on(transmittance, rng).is_none() {
                return;
            }
            let weight = transmittance * (patience.worth * step);
            visit(Station { t, weight, sigma_s: medium.sigma_s });
        }
    }
}

/// Roulette that ends a march where hardly any light comes from.
struct Patience {
    /// What the path carries in lanes that scatter.
    carried: Spectrum,
    lanes: usize,
    /// What was carried at the start, largest lane.
    full: f32,
    /// How many marches like this one those count for that still go on.
    worth: f32,
}

impl Patience {
    fn new(marcher: &Marcher, medium: &Medium) -> Self {
        let scatters = medium.sigma_s.map(|sigma| if sigma > 0.0 { 1.0 } else { 0.0 });
        let mut carried = marcher.throughput * scatters;
        if carried.max_lane(marcher.lanes) <= 0.0 || !carried.is_finite() {
            carried = scatters;
        }
        let full = carried.max_lane(marcher.lanes);
        Self { carried, lanes: marcher.lanes, full, worth: 1.0 }
    }

    /// What is still carried; `None` where the march ends.
    fn go_on(&mut self, transmittance: Spectrum, rng: &mut Rng) -> Option<Spectrum> {
        let alive = self.carried * transmittance;
        let left = alive.max_lane(self.lanes) / self.full * self.worth;
        if left < FAINT {
            if rng.uniform() * FAINT >= left {
                return None;
            }
            self.worth *= FAINT / left;
        }
        Some(alive)
    }
}

/// A march through a grid.
struct Gridded<'a> {
    medium: &'a Medium,
    grid: &'a Grid,
    ray: &'a Ray,
    lanes: usize,
    left: Spectrum,
    emitted: Spectrum,
}

impl Gridded<'_> {
    fn free_steps(&mut self, line: Inside, stations: f32, rng: &mut Rng, visit: &mut impl FnMut(Station)) {
        let strongest = collision_rate(self.medium, line.range[1] - line.range[0]);
        for Stretch { range, majorant } in self.grid.majorants().along(line) {
            // Ratio tracking needs a station for every possible collision.
            let rate = stations.max(1.0) * majorant * strongest;
            let mut way = 0.0;
            loop {
                way += next_step(rate, rng);
                if way >= range[1] - range[0] {
                    break;
                }
                let t = range[0] + way;
                let density = self.grid.density_in_cube(line.origin + line.direction * t);
                self.stop_at(t, density, 1.0 / rate, visit);
                self.left *= Spectrum::ONE + self.medium.sigma_t() * (-density / rate);
                if !self.survives(rng) {
                    return;
                }
            }
        }
    }

    fn equal_steps(&mut self, line: Inside, length: f32, rng: &mut Rng, visit: &mut impl FnMut(Station)) {
        let (count, step) = steps(line.range[1] - line.range[0], length);
        for i in 0..count {
            let part = rng.uniform() * step;
            let t = line.range[0] + i as f32 * step + part;
            let density = self.grid.density_in_cube(line.origin + line.direction * t);
            let before = self.left;
            self.left = before * self.dimmed(density * part);
            self.stop_at(t, density, step, visit);
            self.left = before * self.dimmed(density * step);
            if !self.survives(rng) {
                return;
            }
        }
    }

    /// Fraction left after a way on which the density adds up to `amount`.
    fn dimmed(&self, amount: f32) -> Spectrum {
        self.medium.sigma_t().map(|sigma| float::exp(-sigma * amount))
    }

    /// A station that stands for `length`.
    fn stop_at(&mut self, t: f32, density: f32, length: f32, visit: &mut impl FnMut(Station)) {
        if density <= 0.0 {
            return;
        }
        let weight = self.left * length;
        self.emitted += weight * self.medium.emission * density;
        let sigma_s = self.medium.sigma_s_at(self.ray.at(t), density);
        if !sigma_s.is_zero() {
            visit(Station { t, weight, sigma_s });
        }
    }

    /// Roulette, where little is left.
    fn survives(&mut self, rng: &mut Rng) -> bool {
        let most = self.left.max_lane(self.lanes);
        if most < FAINT {
            if rng.uniform() * FAINT >= most {
                self.left = Spectrum::ZERO;
                return false;
            }
            self.left *= FAINT / most;
        }
        true
    }
}

/// Number and length of equal steps on a way.
fn steps(distance: f32, length: f32) -> (u32, f32) {
    let count = (distance / length).ceil().clamp(1.0, MOST_STEPS);
    (count as u32, distance / count)
}

/// Distance beyond which no lane that scatters sends light.
fn depth_end(medium: &Medium, lanes: usize) -> f32 {
    let (sigma_t, sigma_s) = (medium.sigma_t().to_lanes(), medium.sigma_s.to_lanes());
    let thinnest = (0..lanes)
        .filter(|&lane| sigma_s[lane] > 0.0)
        .map(|lane| sigma_t[lane])
        .fold(f32::INFINITY, f32::min);
    DEEPEST / thinnest
}

fn sum(value: Spectrum, lanes: usize) -> f32 {
    value.to_lanes()[..lanes].iter().sum()
}
