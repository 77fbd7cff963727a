//! A chi-square test for densities of directions that have edges anywhere, as those of lamps do.

use hyaline_math::float::f64 as float;
use hyaline_testkit::{ChiSquare, Random, chi_square};
use std::f64::consts::{PI, TAU};

/// Cells of equal solid angle.
const HEIGHTS: usize = 20;
const AZIMUTHS: usize = 24;

/// Share of the samples that is taken uniformly from the sphere.
const UNIFORM_SHARE: f64 = 0.02;

/// Error of an expected count that the statistic does not notice.
const COUNT_TOLERANCE: f64 = 0.05;

/// Tests a sampler of directions against its density per solid angle.
///
/// Some samples are uniform, and the density is mixed to match, so that a cell of which the density fills but a sliver
/// cannot decide the test by itself.
pub(super) fn direction_test(
    mut sample: impl FnMut() -> Option<[f64; 3]>,
    pdf: impl Fn([f64; 3]) -> f64,
    sample_count: usize,
) -> ChiSquare {
    let mut random = Random::from_seed(1234);
    let mut observed = vec![0.0; HEIGHTS * AZIMUTHS + 1];
    for _ in 0..sample_count {
        let is_uniform = random.uniform() < UNIFORM_SHARE;
        let direction = if is_uniform { Some(random.direction()) } else { sample() };
        observed[direction.map_or(HEIGHTS * AZIMUTHS, cell_of)] += 1.0;
    }
    let scale = sample_count as f64 * 4.0 * PI;
    let density = |x: f64, y: f64| {
        let density = (1.0 - UNIFORM_SHARE) * pdf(direction_of(x, y)) + UNIFORM_SHARE / (4.0 * PI);
        scale * density
    };
    let mut expected: Vec<f64> = (0..HEIGHTS * AZIMUTHS).map(|cell| expected_count(&density, cell)).collect();
    let lost = sample_count as f64 - expected.iter().sum::<f64>();
    expected.push(lost.max(f64::MIN_POSITIVE));
    chi_square(&observed, &expected, 5.0)
}

/// The cell that holds a direction. Heights are along x: edges often are circles about z, and would run along the cells.
fn cell_of([z, x, y]: [f64; 3]) -> usize {
    let row = ((0.5 * z + 0.5) * HEIGHTS as f64) as usize;
    let column = ((float::atan2(y, x) / TAU + 0.5) * AZIMUTHS as f64) as usize;
    row.min(HEIGHTS - 1) * AZIMUTHS + column.min(AZIMUTHS - 1)
}

/// The direction of a point of the unit square; equal areas are equal solid angles.
fn direction_of(x: f64, y: f64) -> [f64; 3] {
    let z = 2.0 * x - 1.0;
    let (r, (sin, cos)) = ((1.0 - z * z).sqrt(), float::sin_cos((y - 0.5) * TAU));
    [z, r * cos, r * sin]
}

fn expected_count(density: &impl Fn(f64, f64) -> f64, cell: usize) -> f64 {
    let (width, height) = (1.0 / HEIGHTS as f64, 1.0 / AZIMUTHS as f64);
    let corner = [(cell / AZIMUTHS) as f64 * width, (cell % AZIMUTHS) as f64 * height];
    let coarse = four_points(density, corner, [width, height]);
    refined(density, corner, [width, height], coarse, COUNT_TOLERANCE, 0)
}

/// The integral over a rectangle, split where it is not smooth.
fn refined(
    f: &impl Fn(f64, f64) -> f64,
    corner: [f64; 2],
    size: [f64; 2],
    coarse: f64,
    tolerance: f64,
    depth: u32,
) -> f64 {
    let half = [0.5 * size[0], 0.5 * size[1]];
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
        .map(|[i, j]| [corner[0] + i * half[0], corner[1] + j * half[1]]);
    let parts = corners.map(|corner| four_points(f, corner, half));
    let fine: f64 = parts.iter().sum();
    if depth == 8 || (depth >= 2 && (fine - coarse).abs() <= tolerance) {
        return fine;
    }
    let part = |(corner, part)| refined(f, corner, half, part, 0.5 * tolerance, depth + 1);
    corners.into_iter().zip(parts).map(part).sum()
}

/// Two-point Gauss rule along both axes. Source: Abramowitz & Stegun, table 25.4.
fn four_points(f: &impl Fn(f64, f64) -> f64, corner: [f64; 2], size: [f64; 2]) -> f64 {
    const NODES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
    let at = |x: f64, y: f64| f(corner[0] + x * size[0], corner[1] + y * size[1]);
    let sum: f64 = NODES.iter().flat_map(|&x| NODES.map(|y| at(x, y))).sum();
    0.25 * size[0] * size[1] * sum
}

#[test]
fn the_test_accepts_a_right_density_and_refuses_a_wrong_one() {
    let mut random = Random::from_seed(1);
    let mut cap = || loop {
        let d = random.direction();
        if d[2] > 0.8 {
            return Some(d);
        }
    };
    let density = |z: f64, edge: f64| if z > edge { 1.0 / (TAU * (1.0 - edge)) } else { 0.0 };
    assert!(direction_test(&mut cap, |d| density(d[2], 0.8), 30_000).p_value > 1e-3);
    assert!(direction_test(&mut cap, |d| density(d[2], 0.79), 30_000).p_value < 1e-6);
    assert!(direction_test(&mut cap, |d| 0.97 * density(d[2], 0.8), 30_000).p_value < 1e-6);
}
