//! Evenness, independence and convergence of the samplers.

use super::*;
use hyaline_testkit::{Moments, chi_square, chi_square_square};

fn point(pixel: (u32, u32), pass: u32, dimension: u32) -> [f64; 2] {
    let mut sampler = Sampler::new(SamplerKind::Sobol, 17, pixel, pass);
    sampler.set_dimension(dimension);
    let p = sampler.next_2d();
    [f64::from(p.x), f64::from(p.y)]
}

/// Whether every elementary interval of area 1/len holds exactly one of the points.
fn is_net(points: &[[f64; 2]]) -> bool {
    let m = points.len().trailing_zeros();
    (0..=m).all(|split| {
        let (columns, rows) = (1_usize << split, 1_usize << (m - split));
        let mut seen = vec![false; points.len()];
        points.iter().all(|p| {
            let cell = (p[0] * columns as f64) as usize * rows + (p[1] * rows as f64) as usize;
            !std::mem::replace(&mut seen[cell], true)
        })
    })
}

#[test]
fn every_aligned_block_of_passes_is_a_net() {
    for dimension in 0..4 {
        for m in 0..=12 {
            for block in [0_u32, 1, 2, 5] {
                let first = block << m;
                let points: Vec<_> = (first..first + (1 << m)).map(|p| point((3, 9), p, dimension)).collect();
                assert!(is_net(&points), "dimension {dimension}, block {block} of 2^{m}");
            }
        }
    }
}

#[test]
fn the_last_passes_of_all_are_a_net_too() {
    let points: Vec<_> = (0..256).map(|p| point((0, 0), u32::MAX - p, 1)).collect();
    assert!(is_net(&points));
}

#[test]
fn single_numbers_are_stratified() {
    let mut seen = [false; 64];
    for pass in 0..64 {
        let mut sampler = Sampler::new(SamplerKind::Sobol, 1, (5, 5), pass);
        sampler.next_2d();
        let stratum = (sampler.next_1d() * 64.0) as usize;
        assert!(!std::mem::replace(&mut seen[stratum], true));
    }
}

#[test]
fn first_points_of_the_pixels_are_uniform() {
    for kind in [SamplerKind::Sobol, SamplerKind::Independent] {
        let mut pixel = 0;
        let sample = || {
            pixel += 1;
            let p = Sampler::new(kind, 2, (pixel % 500, pixel / 500), 0).next_2d();
            [f64::from(p.x), f64::from(p.y)]
        };
        assert!(chi_square_square(sample, |_| 1.0, 200_000, 32, 32).p_value > 0.001, "{kind:?}");
    }
}

#[test]
fn neighboring_pixels_seeds_and_passes_are_independent() {
    let x = |seed, pixel, pass| {
        let mut sampler = Sampler::new(SamplerKind::Sobol, seed, pixel, pass);
        f64::from(sampler.next_2d().x)
    };
    let columns = |i| [x(1, (i, 0), 3), x(1, (i + 1, 0), 3)];
    let rows = |i| [x(1, (7, i), 3), x(1, (7, i + 1), 3)];
    let seeds = |i: u32| [x(u64::from(i), (7, 7), 3), x(u64::from(i) + 1, (7, 7), 3)];
    let pairs: [&dyn Fn(u32) -> [f64; 2]; 3] = [&columns, &rows, &seeds];
    for (k, pair) in pairs.into_iter().enumerate() {
        let mut i = 0;
        let sample = || {
            i += 1;
            pair(i)
        };
        assert!(chi_square_square(sample, |_| 1.0, 100_000, 24, 24).p_value > 0.001, "pair {k}");
    }
}

#[test]
fn pairs_of_dimensions_are_uncorrelated_in_four_dimensions() {
    // 4⁴ cells and the 4096 passes of each of 64 pixels. Stratification only lowers the statistic, so the test is of
    // structure between the pairs: without the shuffle some cells stay empty and others fill up.
    for (a, b) in [(0, 1), (0, 2), (3, 17)] {
        let mut counts = vec![0.0; 256];
        for pixel in 0..64 {
            for pass in 0..4096 {
                let (p, q) = (point((pixel, 0), pass, a), point((pixel, 0), pass, b));
                let digits = [p[0], p[1], q[0], q[1]].map(|v| (v * 4.0) as usize);
                counts[digits.iter().fold(0, |cell, digit| cell * 4 + digit)] += 1.0;
            }
        }
        let expected = vec![64.0 * 4096.0 / 256.0; 256];
        let result = chi_square(&counts, &expected, 5.0);
        assert!(result.p_value > 0.001, "dimensions {a} and {b}: {result:?}");
    }
}

#[test]
fn few_passes_of_one_pixel_do_not_line_up_between_dimensions() {
    // The same cells, 16 passes of each of many pixels.
    let mut counts = vec![0.0; 256];
    for pixel in 0..20_000 {
        for pass in 0..16 {
            let (p, q) = (point((pixel, 3), pass, 0), point((pixel, 3), pass, 1));
            let digits = [p[0], p[1], q[0], q[1]].map(|v| (v * 4.0) as usize);
            counts[digits.iter().fold(0, |cell, digit| cell * 4 + digit)] += 1.0;
        }
    }
    let result = chi_square(&counts, &[1250.0; 256], 5.0);
    assert!(result.p_value > 0.001, "{result:?}");
}

#[test]
fn sobol_points_converge_faster_than_independent_ones() {
    let variance = |kind, passes: u32| {
        let estimates: Moments = (0..400)
            .map(|pixel| {
                let sum: f64 = (0..passes)
                    .map(|pass| {
                        let p = Sampler::new(kind, 4, (pixel, 1), pass).next_2d();
                        f64::from(p.x) * f64::from(p.y) + f64::from(p.x * p.x)
                    })
                    .sum();
                sum / f64::from(passes)
            })
            .collect();
        // The integral is 1/4 + 1/3.
        assert!((estimates.mean() - 7.0 / 12.0).abs() < 5.0 * estimates.variance_of_mean().sqrt() + 1e-6);
        estimates.variance()
    };
    let independent = variance(SamplerKind::Independent, 16) / variance(SamplerKind::Independent, 1024);
    assert!((40.0..100.0).contains(&independent), "independent variance falls by {independent}, not 64");
    // A smooth integrand: variance falls as N⁻³ up to logarithms, 64³ = 262 144.
    let sobol = variance(SamplerKind::Sobol, 16) / variance(SamplerKind::Sobol, 1024);
    assert!(sobol > 20_000.0, "sobol variance falls by {sobol} only");
}

#[test]
fn forks_are_independent_of_their_origin_and_of_each_other() {
    let pixels = |pixel: u32| {
        let mut sampler = Sampler::new(SamplerKind::Sobol, 9, (pixel, pixel), 0);
        sampler.next_1d();
        sampler
    };
    let draws: [fn(&Sampler) -> f32; 4] = [
        |s| s.clone().next_1d(),
        |s| s.fork(0).next_1d(),
        |s| s.fork(1).next_1d(),
        |s| s.fork(0).fork(1).next_1d(),
    ];
    for i in 0..4 {
        for j in 0..i {
            let mut pixel = 0;
            let sample = || {
                pixel += 1;
                let sampler = pixels(pixel);
                [f64::from(draws[i](&sampler)), f64::from(draws[j](&sampler))]
            };
            assert!(chi_square_square(sample, |_| 1.0, 50_000, 16, 16).p_value > 0.001, "draws {i} and {j}");
        }
    }
}

#[test]
fn forks_stay_stratified_over_the_passes() {
    let points: Vec<_> = (0..256)
        .map(|pass| {
            let p = Sampler::new(SamplerKind::Sobol, 1, (2, 3), pass).fork(5).next_2d();
            [f64::from(p.x), f64::from(p.y)]
        })
        .collect();
    assert!(is_net(&points));
}

#[test]
fn setting_the_dimension_repeats_its_numbers() {
    let mut sampler = Sampler::new(SamplerKind::Sobol, 1, (2, 3), 4);
    let draws: Vec<Vec2> = (0..8).map(|_| sampler.next_2d()).collect();
    assert_eq!(sampler.dimension(), 8);
    sampler.set_dimension(5);
    assert_eq!(sampler.next_2d(), draws[5]);
}
