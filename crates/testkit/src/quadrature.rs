//! Numerical integration over intervals, rectangles and the sphere, by Gauss-Legendre panels.

use std::f64::consts::{PI, TAU};

/// Positive nodes and their weights of the five-point rule on -1…1; the first node, 0, counts once.
///
/// Source: Abramowitz & Stegun, Handbook of Mathematical Functions, table 25.4.
const NODES: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Integral of `f` from `a` to `b`, over `panels` equal panels; exact for polynomials up to degree 9.
pub fn integrate(f: impl Fn(f64) -> f64, a: f64, b: f64, panels: usize) -> f64 {
    let width = (b - a) / panels as f64;
    (0..panels).map(|i| panel(&f, a + i as f64 * width, a + (i + 1) as f64 * width)).sum()
}

/// Integral of `f(x, y)` over the rectangle `x[0]…x[1]` by `y[0]…y[1]`, over `nx × ny` equal panels.
pub fn integrate_rectangle(
    f: impl Fn(f64, f64) -> f64,
    x: [f64; 2],
    y: [f64; 2],
    nx: usize,
    ny: usize,
) -> f64 {
    integrate(|x| integrate(|y| f(x, y), y[0], y[1], ny), x[0], x[1], nx)
}

/// Integral over the unit sphere of `f(direction)`, over panels in the polar angle (from +z) and the azimuth.
///
/// Functions that jump at the equator integrate well for an even `theta_panels`.
pub fn integrate_sphere(f: impl Fn([f64; 3]) -> f64, theta_panels: usize, phi_panels: usize) -> f64 {
    integrate_rectangle(spherical(f), [0.0, PI], [0.0, TAU], theta_panels, phi_panels)
}

/// `f(direction) sin(theta)` as a function of the polar angle and the azimuth.
#[allow(
    clippy::disallowed_methods,
    reason = "statistics never reach a picture, and this crate has no dependency"
)]
pub(crate) fn spherical(f: impl Fn([f64; 3]) -> f64) -> impl Fn(f64, f64) -> f64 {
    move |theta, phi| {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_phi, cos_phi) = phi.sin_cos();
        f([sin_theta * cos_phi, sin_theta * sin_phi, cos_theta]) * sin_theta
    }
}

/// Integral over a rectangle, refined where the function is not smooth until the error is about `tolerance`.
///
/// At least 4 × 4 panels are looked at; a peak narrower than one of them may be missed.
pub(crate) fn integrate_adaptive(
    f: &impl Fn(f64, f64) -> f64,
    x: [f64; 2],
    y: [f64; 2],
    tolerance: f64,
) -> f64 {
    refine(f, x, y, integrate_rectangle(f, x, y, 1, 1), tolerance, 0)
}

fn refine(
    f: &impl Fn(f64, f64) -> f64,
    x: [f64; 2],
    y: [f64; 2],
    coarse: f64,
    tolerance: f64,
    depth: u32,
) -> f64 {
    const MIN_DEPTH: u32 = 2;
    const MAX_DEPTH: u32 = 9;
    let (mx, my) = (0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1]));
    let quarters = [
        ([x[0], mx], [y[0], my]),
        ([mx, x[1]], [y[0], my]),
        ([x[0], mx], [my, y[1]]),
        ([mx, x[1]], [my, y[1]]),
    ];
    let parts = quarters.map(|(x, y)| integrate_rectangle(f, x, y, 1, 1));
    let fine: f64 = parts.iter().sum();
    if depth >= MAX_DEPTH || (depth >= MIN_DEPTH && (fine - coarse).abs() <= tolerance) {
        return fine;
    }
    // Errors of the quarters add up like independent ones along an edge, so each may have half.
    quarters.iter().zip(parts).map(|((x, y), part)| refine(f, *x, *y, part, 0.5 * tolerance, depth + 1)).sum()
}

fn panel(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let pair = |(node, weight): (f64, f64)| weight * (f(middle - half * node) + f(middle + half * node));
    half * (NODES[0].1 * f(middle) + pair(NODES[1]) + pair(NODES[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_nine_are_exact() {
        let got = integrate(|x| 10.0 * x.powi(9) - 3.0 * x * x + 1.0, -1.0, 2.0, 1);
        assert!((got - (1023.0 - 9.0 + 3.0)).abs() < 1e-10);
    }

    #[test]
    fn an_arc_of_the_circle_has_its_area() {
        assert!((integrate(|x| 1.0 / (1.0 + x * x), 0.0, 1.0, 8) - PI / 4.0).abs() < 1e-13);
    }

    #[test]
    fn rectangles_integrate_in_the_order_of_their_axes() {
        let got = integrate_rectangle(|x, y| x * x * y, [0.0, 3.0], [1.0, 2.0], 2, 1);
        assert!((got - 9.0 * 1.5).abs() < 1e-12);
    }

    #[test]
    fn the_sphere_has_its_area_and_its_second_moments() {
        assert!((integrate_sphere(|_| 1.0, 4, 2) - 4.0 * PI).abs() < 1e-9);
        assert!((integrate_sphere(|d| d[0] * d[0], 8, 8) - 4.0 * PI / 3.0).abs() < 1e-9);
        assert!((integrate_sphere(|d| d[2].max(0.0), 8, 2) - PI).abs() < 1e-9);
    }

    #[test]
    fn refinement_finds_an_edge_that_cuts_a_cell() {
        let f = |x: f64, y: f64| if x + y < 0.7 { 1.0 } else { 0.0 };
        let got = integrate_adaptive(&f, [0.0, 1.0], [0.0, 1.0], 1e-6);
        assert!((got - 0.245).abs() < 1e-4, "{got}");
    }
}
