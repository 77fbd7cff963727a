//! Flights and transmittances against closed forms and quadrature.

use super::*;
use crate::{Medium, Phase};
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Transform, Vec2, Vec3};
use hyaline_sampling::Rng;
use hyaline_spectrum::Spectrum;
use hyaline_testkit::{Moments, Random, integrate};
use std::sync::Arc;

const COLORED: [f32; 4] = [0.4, 1.3, 3.0, 0.0];

fn medium() -> Medium {
    Medium {
        sigma_a: Spectrum::from_lanes([0.1, 0.5, 0.2, 0.0]),
        sigma_s: Spectrum::from_lanes([0.3, 0.8, 2.8, 0.0]),
        phase: Phase::Isotropic,
        ..Medium::VACUUM
    }
}

/// A lumpy grid in a box that is turned and stretched; some of its blocks are empty.
fn lumpy() -> Grid {
    let size = [20, 9, 17];
    let mut random = Random::from_seed(8);
    let density =
        (0..20 * 9 * 17).map(|i| if i % 20 < 8 { 0.0 } else { random.uniform_f32() * 6.0 }).collect();
    let turn = Transform::rotate(DVec3::new(0.3, 1.0, 0.2), 0.7).unwrap();
    let stretch = Transform::scale(DVec3::new(2.0, 1.0, 1.5)).unwrap();
    let placement = Transform::translate(DVec3::new(-0.8, -0.4, -0.6)).after(&turn).after(&stretch);
    Grid::new(size, density, None, &placement)
}

fn ray() -> Ray {
    Ray::new(Vec3::new(-2.0, 0.1, -0.3), Vec3::new(0.98, 0.02, 0.1).normalize())
}

fn flyers(random: &mut Random, throughput: Spectrum) -> Flyer {
    Flyer { throughput, lanes: 3, u: Vec2::new(random.uniform_f32(), random.uniform_f32()) }
}

fn assert_mean(moments: &Moments, expected: f64, what: &str) {
    let error = moments.variance_of_mean().sqrt().max(1e-6);
    assert!(
        (moments.mean() - expected).abs() < 4.0 * error,
        "{what}: {} is not {expected} ± {error}",
        moments.mean()
    );
}

#[test]
fn homogeneous_flights_arrive_as_often_as_the_law_says_in_every_lane() {
    let (medium, distance) = (medium(), 0.8);
    for throughput in [Spectrum::ONE, Spectrum::from_lanes([0.01, 1.0, 0.3, 0.0])] {
        let mut random = Random::from_seed(1);
        let mut arrived = [Moments::new(), Moments::new(), Moments::new()];
        let mut scattered = [Moments::new(), Moments::new(), Moments::new()];
        for _ in 0..60_000 {
            let flight = flyers(&mut random, throughput).fly(&medium, &ray(), distance);
            for lane in 0..3 {
                let weight = f64::from(flight.weight.to_lanes()[lane]);
                arrived[lane].push(if flight.scatters_at.is_none() { weight } else { 0.0 });
                // Each scattering counted with its distance tests where, not only how often.
                scattered[lane].push(flight.scatters_at.map_or(0.0, |t| weight * f64::from(t)));
            }
        }
        let (sigma_t, sigma_s) = (medium.sigma_t().to_lanes(), medium.sigma_s.to_lanes());
        for lane in 0..3 {
            let sigma = f64::from(sigma_t[lane]);
            assert_mean(&arrived[lane], float::exp(-sigma * 0.8), "arrivals");
            let expected =
                integrate(|t| f64::from(sigma_s[lane]) * float::exp(-sigma * t) * t, 0.0, 0.8, 200);
            assert_mean(&scattered[lane], expected, "scatterings");
        }
    }
}

#[test]
fn what_a_path_carries_stays_below_the_sum_of_its_lanes() {
    let medium =
        Medium { sigma_a: Spectrum::ZERO, sigma_s: Spectrum::from_lanes([0.01, 50.0, 1.0, 0.0]), ..medium() };
    let mut random = Random::from_seed(2);
    let throughput = Spectrum::from_lanes([1.0, 0.2, 0.5, 0.0]);
    for _ in 0..20_000 {
        let flight = flyers(&mut random, throughput).fly(&medium, &ray(), 3.0);
        let carried = (throughput * flight.weight).max_lane(3);
        assert!(carried <= 1.7 * 1.001, "{carried}");
    }
}

#[test]
fn ratio_tracking_agrees_with_quadrature() {
    let grid = lumpy();
    let ray = ray();
    let depth = integrate(|t| f64::from(grid.density(ray.at(t as f32))), 0.0, 5.0, 40_000);
    assert!(depth > 0.5, "{depth}: the ray should meet the grid");
    let medium = Medium {
        grid: Some(Arc::new(grid)),
        sigma_s: Spectrum::ZERO,
        sigma_a: Spectrum::from_lanes(COLORED),
        ..medium()
    };
    let mut moments = [Moments::new(), Moments::new(), Moments::new()];
    let mut random = Random::from_seed(3);
    for _ in 0..20_000 {
        // The estimate is keyed by the ray: along the same line other origins draw other numbers.
        let back = random.uniform_f32();
        let start = Ray { origin: ray.at(-back), ..ray };
        let left = transmittance(&medium, &start, 5.0 + back).to_lanes();
        for lane in 0..3 {
            moments[lane].push(f64::from(left[lane]));
        }
    }
    for lane in 0..3 {
        assert_mean(&moments[lane], float::exp(-f64::from(COLORED[lane]) * depth), "transmittance");
    }
    assert_eq!(transmittance(&medium, &Ray::new(Vec3::splat(9.0), Vec3::X), f32::INFINITY), Spectrum::ONE);
}

/// What scatters, each time counted with its distance, what is emitted and what is left on the way along `ray`.
fn by_quadrature(medium: &Medium) -> [[f64; 3]; 3] {
    let (grid, ray) = (medium.grid.as_ref().unwrap(), ray());
    let steps = 4000;
    let dt = 5.0 / f64::from(steps);
    let (sigma_t, sigma_s) = (medium.sigma_t().to_lanes(), medium.sigma_s.to_lanes());
    let mut expected = [[0.0_f64; 3]; 3];
    for lane in 0..3 {
        let mut depth = 0.0;
        for i in 0..steps {
            let t = (f64::from(i) + 0.5) * dt;
            let density = f64::from(grid.density(ray.at(t as f32)));
            let left = float::exp(-f64::from(sigma_t[lane]) * (depth + 0.5 * density * dt));
            expected[lane][0] += left * f64::from(sigma_s[lane]) * density * dt * t;
            expected[lane][1] += left * f64::from(medium.emission.to_lanes()[lane]) * density * dt;
            depth += density * dt;
        }
        expected[lane][2] = float::exp(-f64::from(sigma_t[lane]) * depth);
    }
    expected
}

#[test]
fn flights_through_a_grid_scatter_where_quadrature_says() {
    let grid = lumpy();
    let ray = ray();
    let medium = Medium {
        grid: Some(Arc::new(grid)),
        emission: Spectrum::from_lanes([0.7, 0.2, 0.0, 0.0]),
        ..medium()
    };
    let expected = by_quadrature(&medium);
    let mut random = Random::from_seed(4);
    let mut moments: [[Moments; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| Moments::new()));
    for _ in 0..60_000 {
        let flight = flyers(&mut random, Spectrum::from_lanes([1.0, 0.5, 0.8, 0.0])).fly(&medium, &ray, 5.0);
        for (lane, moments) in moments.iter_mut().enumerate() {
            let weight = f64::from(flight.weight.to_lanes()[lane]);
            moments[0].push(flight.scatters_at.map_or(0.0, |t| weight * f64::from(t)));
            moments[1].push(f64::from(flight.emitted.to_lanes()[lane]));
            moments[2].push(if flight.scatters_at.is_none() { weight } else { 0.0 });
        }
    }
    for lane in 0..3 {
        for (kind, what) in ["scattered", "emitted", "arrived"].into_iter().enumerate() {
            let (got, error) = (moments[lane][kind].mean(), moments[lane][kind].variance_of_mean().sqrt());
            let expected = expected[lane][kind];
            // Half a per mille for the quadrature.
            assert!(
                (got - expected).abs() < 4.0 * error + 5e-4,
                "{what} in lane {lane}: {got} is not {expected}"
            );
        }
    }
}

#[test]
fn light_of_a_homogeneous_medium_is_that_of_the_closed_form() {
    let shining = |sigma: f32| Medium {
        sigma_a: Spectrum::splat(sigma),
        emission: Spectrum::splat(2.0),
        ..Medium::VACUUM
    };
    for (sigma, distance, expected) in
        [(0.0, 3.0, 6.0), (1e-5, 3.0, 6.0), (1.0, 3.0, 1.900_426), (0.5, f32::INFINITY, 4.0)]
    {
        let flyer = Flyer { throughput: Spectrum::ONE, lanes: 3, u: Vec2::splat(0.5) };
        let got = flyer.fly(&shining(sigma), &ray(), distance).emitted.to_lanes()[0];
        assert!((got / expected - 1.0).abs() < 1e-4, "{sigma}: {got} is not {expected}");
    }
}

#[test]
fn densities_are_those_of_the_cells_at_their_centers_and_none_outside() {
    let placement = Transform::scale(DVec3::splat(2.0)).unwrap();
    let grid = Grid::new([2, 2, 1], vec![1.0, 2.0, 3.0, 4.0], None, &placement);
    for (p, expected) in [
        ([0.5, 0.5, 1.0], 1.0),
        ([1.5, 0.5, 1.0], 2.0),
        ([0.5, 1.5, 0.1], 3.0),
        ([1.0, 1.0, 1.9], 2.5),
        ([1.99, 1.99, 1.0], 4.0),
        ([-0.01, 1.0, 1.0], 0.0),
        ([1.0, 1.0, 2.01], 0.0),
    ] {
        let got = grid.density(Vec3::from_array(p));
        assert!((got - expected).abs() < 1e-5, "{p:?}: {got} is not {expected}");
    }
}

/// Means of the sum over stations of weight × σ_s × t, of what is emitted and of what is left, lane by lane.
fn marches(medium: &Medium, distance: f32, step: Step, throughput: Spectrum) -> [[Moments; 3]; 3] {
    let mut moments: [[Moments; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| Moments::new()));
    let mut rng = Rng::new(7, 0);
    let marcher = Marcher { step, throughput, lanes: 3 };
    for _ in 0..30_000 {
        let mut sum = Spectrum::ZERO;
        let marched = marcher.march(medium, &ray(), distance, &mut rng, &mut |station| {
            sum += station.weight * station.sigma_s * station.t;
        });
        for (lane, moments) in moments.iter_mut().enumerate() {
            for (moments, value) in moments.iter_mut().zip([sum, marched.emitted, marched.transmittance]) {
                moments.push(f64::from(value.to_lanes()[lane]));
            }
        }
    }
    moments
}

const STEPS: [Step; 4] = [
    Step::Adaptive { stations: 1.0 },
    Step::Adaptive { stations: 5.0 },
    Step::Fixed { length: 0.05 },
    Step::Fixed { length: 0.3 },
];

#[test]
fn marches_through_homogeneous_media_add_up_to_the_integral_in_every_lane() {
    let medium = medium();
    let (sigma_t, sigma_s) = (medium.sigma_t().to_lanes(), medium.sigma_s.to_lanes());
    for distance in [0.8, f32::INFINITY] {
        for throughput in [Spectrum::ONE, Spectrum::from_lanes([0.01, 1.0, 0.3, 0.0])] {
            for step in STEPS {
                let moments = marches(&medium, distance, step, throughput);
                for lane in 0..3 {
                    let (sigma, end) = (f64::from(sigma_t[lane]), f64::from(distance.min(60.0)));
                    let expected =
                        integrate(|t| f64::from(sigma_s[lane]) * float::exp(-sigma * t) * t, 0.0, end, 4000);
                    // Equal steps of an endless way end at a depth of 16.
                    let error = moments[lane][0].variance_of_mean().sqrt();
                    let got = moments[lane][0].mean();
                    assert!(
                        (got - expected).abs() < 4.0 * error + 1e-4 * expected,
                        "{step:?} {distance} lane {lane}: {got} is not {expected} ± {error}"
                    );
                    let left = moments[lane][2].mean();
                    assert!((left - float::exp(-sigma * f64::from(distance))).abs() < 1e-6);
                }
            }
        }
    }
}

#[test]
fn marches_through_a_grid_add_up_to_the_integral() {
    let medium = Medium {
        grid: Some(Arc::new(lumpy())),
        emission: Spectrum::from_lanes([0.7, 0.2, 0.0, 0.0]),
        ..medium()
    };
    let expected = by_quadrature(&medium);
    // Equal steps take the density of one place for that of a step, whose depth is up to 0.9 and 0.2 here.
    let steps = [
        (Step::Adaptive { stations: 1.0 }, 0.0),
        (Step::Adaptive { stations: 5.0 }, 0.0),
        (Step::Fixed { length: 0.05 }, 0.015),
        (Step::Fixed { length: 0.0125 }, 0.005),
    ];
    for (step, bias) in steps {
        let moments = marches(&medium, 5.0, step, Spectrum::from_lanes([1.0, 0.5, 0.8, 0.0]));
        for lane in 0..3 {
            for (kind, what) in ["scattered", "emitted", "arrived"].into_iter().enumerate() {
                let (got, error) =
                    (moments[lane][kind].mean(), moments[lane][kind].variance_of_mean().sqrt());
                let expected = expected[lane][kind];
                assert!(
                    (got - expected).abs() < 4.0 * error + 5e-4 + bias * expected,
                    "{what} in lane {lane}, {step:?}: {got} is not {expected}"
                );
            }
        }
    }
}

#[test]
fn marches_end_where_a_lane_is_clear_and_the_way_endless() {
    let sigma_s = Spectrum::from_lanes([1.0, 0.0, 1e-6, 0.0]);
    let medium = Medium { sigma_a: Spectrum::ZERO, sigma_s, ..medium() };
    for step in STEPS {
        let mut stations = 0;
        let marcher = Marcher { step, throughput: Spectrum::ONE, lanes: 3 };
        let marched = marcher.march(&medium, &ray(), f32::INFINITY, &mut Rng::new(1, 2), &mut |station| {
            assert!(station.weight.is_finite() && station.t.is_finite());
            stations += 1;
        });
        assert!(stations < 5000, "{stations}");
        assert_eq!(marched.transmittance.to_lanes()[..3], [0.0, 1.0, 0.0]);
    }
}

#[test]
fn steps_that_are_small_beside_the_way_to_a_grid_come_to_an_end() {
    // A million possible collisions, each of a 64th of what separates two distances from a thousand on.
    let grid = Grid::new([2, 1, 1], vec![1e-9, 1e6], None, &Transform::IDENTITY);
    let medium = Medium { sigma_s: Spectrum::ONE, grid: Some(Arc::new(grid)), ..Medium::VACUUM };
    let from_afar = Ray::new(Vec3::new(0.1, -1000.0, 0.5), Vec3::Y);
    assert_eq!(transmittance(&medium, &from_afar, 2000.0).to_lanes()[0], 1.0);
    let flight = flyers(&mut Random::from_seed(5), Spectrum::ONE).fly(&medium, &from_afar, 2000.0);
    assert_eq!(flight.scatters_at, None);
}
