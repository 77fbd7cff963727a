//! Every warp against its density, by chi-square.

use super::*;
use crate::Rng;
use hyaline_testkit::{chi_square_sphere, chi_square_square};

fn assert_directions(seed: u64, sample: impl Fn(Vec2) -> Vec3, pdf: impl Fn(f32) -> f32) {
    let mut rng = Rng::new(seed, 0);
    let draw = || {
        let d = sample(rng.uniform_2d());
        assert!((d.length() - 1.0).abs() < 1e-6);
        Some(d.to_array().map(f64::from))
    };
    let result = chi_square_sphere(draw, |d| f64::from(pdf(d[2] as f32)), 200_000, 40, 20);
    assert!(result.p_value > 0.001, "{result:?}");
}

#[test]
fn directions_follow_their_densities() {
    assert_directions(1, sample_cosine_hemisphere, pdf_cosine_hemisphere);
    assert_directions(2, sample_sphere, |_| pdf_sphere());
    assert_directions(3, sample_hemisphere, pdf_hemisphere);
}

#[test]
fn phong_lobes_follow_their_density() {
    for exponent in [0.0, 1.0, 5.0, 30.0] {
        assert_directions(4, |u| sample_phong(u, exponent), |cos| pdf_phong(cos, exponent));
    }
}

#[test]
fn cones_follow_their_density() {
    for degrees in [30.0_f32, 90.0, 140.0] {
        let versine = 1.0 - hyaline_math::float::cos(degrees.to_radians());
        let pdf = |cos: f32| if 1.0 - cos <= versine { pdf_cone(versine) } else { 0.0 };
        assert_directions(5, |u| sample_cone(u, versine), pdf);
    }
}

#[test]
fn narrow_cones_keep_their_width() {
    // A lamp of 1 m seen from 100 km: the cosine rounds to 1, the sine must not round to 0.
    let sin = 1e-5_f32;
    let versine = one_minus_cos(sin * sin);
    let edge = sample_cone(Vec2::new(hyaline_math::float::ONE_MINUS_EPSILON, 0.25), versine);
    assert!((edge.truncate().length() / sin - 1.0).abs() < 1e-5);
    assert!((pdf_cone(versine) * std::f32::consts::PI * sin * sin - 1.0).abs() < 1e-5);
}

#[test]
fn disc_points_are_uniform() {
    let mut rng = Rng::new(6, 0);
    let draw = || {
        let p = sample_disc(rng.uniform_2d());
        assert!(p.length() <= 1.000_001);
        [0.5 + 0.499_999 * f64::from(p.x), 0.5 + 0.499_999 * f64::from(p.y)]
    };
    // The disc in the unit square: the area shrinks by four.
    let pdf = |p: [f64; 2]| {
        4.0 * f64::from(pdf_disc(Vec2::new((2.0 * p[0] - 1.0) as f32, (2.0 * p[1] - 1.0) as f32)))
    };
    let result = chi_square_square(draw, pdf, 200_000, 24, 24);
    assert!(result.p_value > 0.001, "{result:?}");
    assert_eq!(sample_disc(Vec2::splat(0.5)), Vec2::ZERO);
}

#[test]
fn ball_points_are_uniform() {
    let mut rng = Rng::new(8, 0);
    let draw = || {
        let p = sample_ball(rng.uniform_2d(), rng.uniform_2d().extend(rng.uniform()));
        // By volume within its distance, and by the height that a sphere's area is uniform in.
        let r = f64::from(p.length());
        [(r * r * r).min(1.0 - 1e-9), (0.5 + 0.5 * f64::from(p.z) / r).clamp(0.0, 1.0 - 1e-9)]
    };
    let result = chi_square_square(draw, |_| 1.0, 200_000, 24, 24);
    assert!(result.p_value > 0.001, "{result:?}");
}

#[test]
fn triangle_points_are_uniform() {
    let mut rng = Rng::new(7, 0);
    let draw = || {
        let b = sample_triangle(rng.uniform_2d());
        assert!(b.min_element() >= 0.0 && (b.x + b.y + b.z - 1.0).abs() < 1e-6);
        [f64::from(b.x), f64::from(b.y)]
    };
    let pdf = |p: [f64; 2]| if p[0] + p[1] <= 1.0 { f64::from(pdf_triangle(0.5)) } else { 0.0 };
    let result = chi_square_square(draw, pdf, 200_000, 20, 20);
    assert!(result.p_value > 0.001, "{result:?}");
}

#[test]
fn corners_of_the_square_give_finite_directions() {
    let end = hyaline_math::float::ONE_MINUS_EPSILON;
    for u in [Vec2::ZERO, Vec2::new(end, 0.0), Vec2::new(0.0, end), Vec2::splat(end)] {
        for d in [sample_cosine_hemisphere(u), sample_sphere(u), sample_hemisphere(u), sample_phong(u, 1e6)] {
            assert!(d.is_finite() && (d.length() - 1.0).abs() < 1e-5, "{u} gives {d}");
        }
    }
}
