//! The torus against its quartic, thin rims, far origins and touching rays.

use super::*;
use crate::shape::{Shape, WHOLE_TURN};
use hyaline_math::polynomial::quartic_roots;
use hyaline_testkit::Random;
use std::f64::consts::PI;

fn crossings(arc: RevolvedArc, o: DVec3, d: DVec3) -> Vec<f64> {
    let mut out = Crossings::new();
    Shape::Arc(arc).crossings(o, d, f64::NEG_INFINITY, f64::INFINITY, &mut out);
    out.as_slice().to_vec()
}

/// Distances by the squared equation, for a unit direction.
fn by_quartic(major: f64, minor: f64, o: DVec3, d: DVec3) -> Vec<f64> {
    let shift = -o.dot(d);
    let p = o + d * shift;
    // (τ² + m)² = 4 R² ((1 - e_y²) τ² - 2 p_y e_y τ + |p|² - p_y²), since p is perpendicular to e.
    let m = p.length_squared() + major * major - minor * minor;
    let four = 4.0 * major * major;
    let c = [
        m * m - four * (p.length_squared() - p.y * p.y),
        four * 2.0 * p.y * d.y,
        2.0 * m - four * (1.0 - d.y * d.y),
        0.0,
        1.0,
    ];
    quartic_roots(c, f64::NEG_INFINITY, f64::INFINITY).iter().map(|tau| tau + shift).collect()
}

#[test]
fn tori_agree_with_their_quartic() {
    let mut random = Random::from_seed(1);
    let mut by_count = [0; 5];
    for _ in 0..50_000 {
        let minor = random.between(0.05, 0.9);
        let arc = RevolvedArc::torus(1.0, minor, WHOLE_TURN, WHOLE_TURN).unwrap();
        let toward = DVec3::from_array(std::array::from_fn(|_| random.between(-1.5, 1.5)));
        let o = DVec3::from(random.direction()) * 4.0;
        let d = (toward - o).normalize();
        let (found, expected) = (crossings(arc, o, d), by_quartic(1.0, minor, o, d));
        by_count[found.len()] += 1;
        let is_touching = |t: &[f64]| t.windows(2).any(|pair| pair[1] - pair[0] < 1e-5);
        assert_eq!(found.len() % 2, 0);
        if !is_touching(&found) && !is_touching(&expected) {
            assert_eq!(found.len(), expected.len(), "{minor} {o} {d}");
            for (t, x) in found.iter().zip(&expected) {
                assert!((t - x).abs() < 1e-8, "{t} {x}");
            }
        }
    }
    assert!(by_count[2] > 1000 && by_count[4] > 1000 && by_count[0] > 1000, "{by_count:?}");
}

#[test]
fn spindles_and_lemons_have_only_the_turned_part() {
    // The center beyond the axis: a lemon, which a line meets at most twice.
    let lemon = RevolvedArc::new([-0.5, 0.0], 1.0, [-1.0, 1.0], WHOLE_TURN).unwrap();
    assert_eq!(crossings(lemon, DVec3::new(-3.0, 0.0, 0.0), DVec3::X), [2.5, 3.5]);
    // The center nearer than the radius: an apple without its core.
    let widest = hyaline_math::float::f64::acos(-0.5);
    let apple = RevolvedArc::new([0.5, 0.0], 1.0, [-widest, widest], WHOLE_TURN).unwrap();
    let t = crossings(apple, DVec3::new(-3.0, 0.0, 0.0), DVec3::X);
    assert!(t.len() == 2 && (t[0] - 1.5).abs() < 1e-15 && (t[1] - 4.5).abs() < 1e-15, "{t:?}");
    // Along the axis into the dimple.
    let t = crossings(apple, DVec3::new(1e-3, 5.0, 0.0), -DVec3::Y);
    assert_eq!(t.len(), 2);
    // An arc whose center is all but on the axis is all but a sphere.
    let nearly = RevolvedArc::new([1e-13, 0.0], 1.0, [-1.5, 1.5], WHOLE_TURN).unwrap();
    let t = crossings(nearly, DVec3::new(-3.0, 0.3, 0.1), DVec3::X);
    assert!(t.len() == 2 && (t[1] - t[0] - 2.0 * 0.9_f64.sqrt()).abs() < 1e-12, "{t:?}");
}

#[test]
fn arcs_that_cross_the_axis_are_refused() {
    assert!(RevolvedArc::torus(0.5, 1.0, WHOLE_TURN, WHOLE_TURN).is_err());
    assert!(RevolvedArc::new([-0.5, 0.0], 1.0, [-1.2, 1.2], WHOLE_TURN).is_err());
    assert!(RevolvedArc::torus(1.0, 0.0, WHOLE_TURN, WHOLE_TURN).is_err());
}

#[test]
fn thin_rims_are_met_precisely_from_near_and_far() {
    let mut random = Random::from_seed(2);
    for (major, minor) in [(0.04, 1e-3), (0.04, 1e-6), (3.0, 1e-4)] {
        let arc = RevolvedArc::torus(major, minor, WHOLE_TURN, WHOLE_TURN).unwrap();
        for distance in [0.1, 10.0, 1e4] {
            for _ in 0..2_000 {
                let target = Shape::Arc(arc).sample_area(DVec2::new(random.uniform(), random.uniform())).0;
                let d = DVec3::from(random.direction());
                let o = target - d * distance;
                let t = crossings(arc, o, d);
                assert_eq!(t.len() % 2, 0);
                // The line's own rounding moves it off the target by about this much.
                let blur = 1e-15 * (distance + major);
                let n = Shape::Arc(arc).surface_at(target).n.dot(d).abs();
                if n > 0.2 && n * minor > 100.0 * blur {
                    let error = t.iter().map(|t| (o + d * *t).distance(target)).fold(f64::MAX, f64::min);
                    assert!(error < 20.0 * blur, "{error:e} at {distance}");
                }
                for t in t {
                    let p = o + d * t;
                    let off = (axis_distance(p) - major).hypot(p.y) - minor;
                    assert!(off.abs() < 8.0 * blur, "{off:e}");
                }
            }
        }
    }
}

#[test]
fn a_level_ray_over_the_top_touches_twice_or_never() {
    let arc = RevolvedArc::torus(1.0, 0.25, WHOLE_TURN, WHOLE_TURN).unwrap();
    for i in -20..=20 {
        let y = 0.25 + f64::from(i) * f64::EPSILON;
        for x in [0.0, 0.5, 0.99, 1.0] {
            let t = crossings(arc, DVec3::new(x, y, -3.0), DVec3::Z);
            assert!(t.is_empty() || t.len() == 2 || t.len() == 4, "{t:?}");
        }
    }
}

#[test]
fn rays_through_the_axis_meet_both_sides() {
    let arc = RevolvedArc::torus(1.0, 0.25, WHOLE_TURN, WHOLE_TURN).unwrap();
    let mut random = Random::from_seed(3);
    for i in 0..4_000 {
        // Past the axis at distances from nothing through the smallest float to the ordinary.
        let miss = if i % 4 == 0 { 0.0 } else { hyaline_math::float::f64::exp(random.between(-400.0, -5.0)) };
        let (y, slope) = (random.between(-0.2, 0.2), random.between(-0.04, 0.04));
        let d = DVec3::new(0.0, slope, 1.0).normalize() * random.between(0.1, 9.0);
        let o = DVec3::new(miss, y, 0.0) - d * random.between(1.0, 2.0);
        let t = crossings(arc, o, d);
        assert_eq!(t.len(), 4, "{miss:e} {o} {d}");
    }
}

#[test]
fn half_rims_are_met_on_their_half_only() {
    let rim = RevolvedArc::torus(1.0, 0.1, [0.0, PI], WHOLE_TURN).unwrap();
    assert_eq!(crossings(rim, DVec3::new(1.0, 3.0, 0.0), -DVec3::Y).len(), 1);
    assert_eq!(crossings(rim, DVec3::new(-3.0, 0.05, 0.0), DVec3::X).len(), 4);
    assert!(crossings(rim, DVec3::new(-3.0, -0.05, 0.0), DVec3::X).is_empty());
}
