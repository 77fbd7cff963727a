//! Where a path scatters on its way through a medium, if it does before the way ends.
//!
//! Coefficients that differ by lane make a path worth more in one lane than in another. Distances are therefore drawn
//! as if by one lane, chosen in proportion to what the path still carries in each, and weighted by the density of all lanes
//! together (balance heuristic): what a path carries never grows beyond the sum over its lanes, so no color noise and
//! no spikes. In a grid, collisions are drawn against a bound that holds for all lanes, and what they are is chosen by
//! the same shares.

use super::grid::Grid;
use super::majorants::Stretch;
use super::tracking::next_step;
use crate::Medium;
use hyaline_math::{Ray, Vec2, float};
use hyaline_sampling::Rng;
use hyaline_spectrum::Spectrum;

/// What became of a path on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// Distance at which it scatters; `None` where it arrives.
    pub scatters_at: Option<f32>,
    /// Factor on the path's throughput.
    pub weight: Spectrum,
    /// Light of the medium itself that the path gathers, before `weight`, W sr⁻¹ m⁻².
    pub emitted: Spectrum,
}

/// Who flies.
#[derive(Clone, Copy, Debug)]
pub struct Flyer {
    /// What the path carries.
    pub throughput: Spectrum,
    /// Lanes that count.
    pub lanes: usize,
    /// Two uniform random numbers in [0, 1).
    pub u: Vec2,
}

impl Flyer {
    /// Follows a path through a medium.
    ///
    /// - `ray`: the way, from its origin.
    /// - `distance`: its length, scene units, > 0; may be infinite.
    pub fn fly(&self, medium: &Medium, ray: &Ray, distance: f32) -> Flight {
        match &medium.grid {
            None => self.fly_homogeneous(medium, distance),
            Some(grid) => self.fly_grid(medium, grid, ray, distance),
        }
    }

    fn shares(&self, weight: Spectrum) -> [f32; 4] {
        shares_of(self.throughput * weight, self.lanes)
    }

    fn fly_homogeneous(&self, medium: &Medium, distance: f32) -> Flight {
        let sigma_t = medium.sigma_t();
        let emitted = emission_along(medium, sigma_t, distance);
        if !medium.scatters() {
            return Flight { scatters_at: None, weight: medium.transmittance(distance), emitted };
        }
        let shares = self.shares(Spectrum::ONE);
        let t = next_distance(sigma_t.to_lanes()[pick(&shares, self.u.x)], self.u.y);
        let transmittance = medium.transmittance(t.min(distance));
        if t >= distance {
            let probability = weighted(&shares, transmittance);
            return Flight { scatters_at: None, weight: transmittance / probability, emitted };
        }
        let density = weighted(&shares, transmittance * sigma_t);
        Flight { scatters_at: Some(t), weight: transmittance * medium.sigma_s * (1.0 / density), emitted }
    }

    /// Source: Kutz, Habel, Li & Novák, Spectral and decomposition tracking for rendering heterogeneous volumes, ACM TOG
    /// 36(4), 2017, §5 (history-aware collision probabilities), absorption taken as a weight.
    fn fly_grid(&self, medium: &Medium, grid: &Grid, ray: &Ray, distance: f32) -> Flight {
        let mut flight = Flight { scatters_at: None, weight: Spectrum::ONE, emitted: Spectrum::ZERO };
        let Some(line) = grid.inside(ray.origin, ray.direction, distance) else { return flight };
        let mut rng = Rng::new(u64::from(self.u.x.to_bits()) << 32 | u64::from(self.u.y.to_bits()), 0);
        let strongest = collision_rate(medium, line.range[1] - line.range[0]);
        for Stretch { range, majorant } in grid.majorants().along(line) {
            let rate = majorant * strongest;
            let mut way = 0.0;
            loop {
                way += next_step(rate, &mut rng);
                if way >= range[1] - range[0] {
                    break;
                }
                let t = range[0] + way;
                let density = grid.density_in_cube(line.origin + line.direction * t);
                if density > 0.0 {
                    let scattering = medium.sigma_s_at(ray.at(t), density) * (1.0 / rate);
                    if self.collide(medium, density / rate, scattering, &mut flight, &mut rng) {
                        flight.scatters_at = Some(t);
                        return flight;
                    }
                    if flight.weight.is_zero() {
                        return flight;
                    }
                }
            }
        }
        flight
    }

    /// One possible collision; returns whether the path scatters.
    ///
    /// - `density`: density over the rate of possible collisions.
    /// - `scattering`: scattering coefficient over it.
    fn collide(
        &self,
        medium: &Medium,
        density: f32,
        scattering: Spectrum,
        flight: &mut Flight,
        rng: &mut Rng,
    ) -> bool {
        flight.emitted += flight.weight * medium.emission * density;
        let extinction = medium.sigma_t() * density;
        let passing = (Spectrum::ONE + extinction * -1.0).map(|p| p.max(0.0));
        let shares = self.shares(flight.weight);
        let (scatter, pass) = (weighted(&shares, scattering), weighted(&shares, passing));
        if scatter + pass <= 0.0 {
            flight.weight = Spectrum::ZERO;
            return false;
        }
        let probability = scatter / (scatter + pass);
        if rng.uniform() < probability {
            flight.weight *= scattering * (1.0 / probability);
            return true;
        }
        flight.weight *= passing * (1.0 / (1.0 - probability));
        false
    }
}

/// Shares of the lanes in what a path carries; those beyond the lanes that count are 0.
pub(super) fn shares_of(carried: Spectrum, lanes: usize) -> [f32; 4] {
    let carried = carried.to_lanes();
    let mut shares: [f32; 4] = std::array::from_fn(|i| if i < lanes { carried[i].max(0.0) } else { 0.0 });
    let total: f32 = shares.iter().sum();
    if total > 0.0 && total.is_finite() {
        shares.iter_mut().for_each(|share| *share /= total);
    } else {
        shares = std::array::from_fn(|i| if i < lanes { 1.0 / lanes as f32 } else { 0.0 });
    }
    shares
}

/// Possible collisions per unit of length where the density is 1.
pub(super) fn collision_rate(medium: &Medium, length: f32) -> f32 {
    let strongest = medium.sigma_t().to_lanes().into_iter().fold(0.0, f32::max);
    // What only shines has no collisions of its own: a few places along the way estimate its light.
    if medium.shines() { strongest.max(4.0 / length) } else { strongest }
}

/// Light of a homogeneous medium along a way, as it arrives at its start.
pub(super) fn emission_along(medium: &Medium, sigma_t: Spectrum, distance: f32) -> Spectrum {
    if !medium.shines() {
        return Spectrum::ZERO;
    }
    let transmittance = medium.transmittance(distance);
    let (sigma_t, transmittance) = (sigma_t.to_lanes(), transmittance.to_lanes());
    let length = std::array::from_fn(|i| match sigma_t[i] * distance {
        // A thin medium: 1 - e^(-x) loses its digits.
        depth if depth < 1e-3 => distance * (1.0 - 0.5 * depth),
        _ if sigma_t[i] == 0.0 => 0.0,
        _ => (1.0 - transmittance[i]) / sigma_t[i],
    });
    medium.emission * Spectrum::from_lanes(length)
}

/// A distance with the density sigma e^(-sigma t).
fn next_distance(sigma: f32, u: f32) -> f32 {
    if sigma > 0.0 { -float::ln(1.0 - u) / sigma } else { f32::INFINITY }
}

/// A lane, chosen by its share.
fn pick(shares: &[f32; 4], u: f32) -> usize {
    let mut sum = 0.0;
    let mut last = 0;
    for (lane, &share) in shares.iter().enumerate() {
        if share > 0.0 {
            last = lane;
            sum += share;
            if u < sum {
                break;
            }
        }
    }
    last
}

/// Mean over lanes by their shares.
pub(super) fn weighted(shares: &[f32; 4], values: Spectrum) -> f32 {
    shares.iter().zip(values.to_lanes()).map(|(share, value)| share * value).sum()
}
