//! Tests of the catalogue against published indices and Abbe numbers.

use super::*;
use hyaline_math::float::f64::{asin, cos, sin};
use hyaline_optics::dispersion::{LAMBDA_C, LAMBDA_D, LAMBDA_F};

fn index(name: &str, lambda: f64) -> f64 {
    index_by_name(name).unwrap_or_else(|| panic!("{name} is not in the catalogue")).index(lambda)
}

#[test]
fn substances_have_their_published_index_and_abbe_number() {
    // Name, n_d, V_d, tolerance of n_d, tolerance of V_d.
    let published = [
        ("BK7", 1.5168, 64.17, 1e-5, 0.01),
        ("F2", 1.620_04, 36.37, 1e-5, 0.01),
        ("SF10", 1.728_25, 28.41, 1e-5, 0.01),
        ("SF11", 1.784_72, 25.76, 1e-5, 0.01),
        ("fused silica", 1.458_46, 67.8, 1e-5, 0.1),
        ("fluorite", 1.433_85, 95.0, 2e-5, 0.3),
        ("sapphire", 1.7682, 72.2, 2e-4, 0.3),
        ("diamond", 2.4175, 55.3, 1e-3, 1.0),
        ("cubic zirconia", 2.158, 33.5, 2e-3, 1.5),
        ("water", 1.3334, 55.8, 2e-4, 0.5),
        ("ethanol", 1.3616, 60.0, 5e-4, 1.5),
    ];
    for (name, nd, abbe, nd_tolerance, abbe_tolerance) in published {
        let model = index_by_name(name).unwrap();
        let (got_nd, got_abbe) = (model.index(LAMBDA_D), model.abbe_number());
        assert!((got_nd - nd).abs() < nd_tolerance, "{name}: n_d = {got_nd}");
        assert!((got_abbe - abbe).abs() < abbe_tolerance, "{name}: V_d = {got_abbe}");
    }
}

#[test]
fn water_keeps_to_the_four_terms_of_its_source() {
    for step in 0..=47 {
        let lambda = 360.0 + 10.0 * f64::from(step);
        let squared = lambda * lambda * 1e-6;
        let term = |b: f64, c: f64| b * squared / (squared - c);
        let four = 1.0
            + term(0.568_402_756_5, 0.005_101_829_712)
            + term(0.172_617_739_1, 0.018_211_539_36)
            + term(0.020_861_895_78, 0.026_207_222_93)
            + term(0.113_074_868_8, 10.697_927_21);
        assert!((index("water", lambda) - four.sqrt()).abs() < 1e-7, "{lambda} nm");
    }
}

#[test]
fn ice_keeps_to_its_measured_table() {
    for (lambda, n) in [(450.0, 1.3157), (500.0, 1.3130), (550.0, 1.3110), (600.0, 1.3094), (650.0, 1.3080)] {
        assert!((index("ice", lambda) - n).abs() < 2e-4, "{lambda} nm: {}", index("ice", lambda));
    }
}

#[test]
fn window_glass_keeps_to_its_formula() {
    for lambda in [LAMBDA_C, LAMBDA_D, LAMBDA_F] {
        let squared = lambda * lambda * 1e-6;
        let rubin = 1.5130 - 0.003_169 * squared + 0.003_962 / squared;
        assert!((index("window glass", lambda) - rubin).abs() < 1.5e-4, "{lambda} nm");
    }
}

#[test]
fn every_entry_is_usable_and_bends_blue_at_least_as_much_as_red() {
    for (names, model) in TABLE {
        assert!(model.is_usable(), "{names:?}");
        assert!((1.0..3.0).contains(&model.index(LAMBDA_D)), "{names:?}");
        assert!(model.index(LAMBDA_F) >= model.index(LAMBDA_C), "{names:?}");
    }
}

#[test]
fn names_are_unique_and_each_spelling_finds_its_entry() {
    let all: Vec<&str> = TABLE.iter().flat_map(|(names, _)| names.iter().copied()).collect();
    for (i, a) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|b| !is_same_name(a, b)), "{a} is there twice");
    }
    for (names, model) in TABLE {
        assert!(names.iter().all(|name| index_by_name(&name.to_uppercase()) == Some(*model)));
    }
    assert_eq!(index_names().count(), TABLE.len());
    assert_eq!(index_by_name("unobtainium"), None);
}

/// Angle of the primary rainbow from the antisolar point, degrees.
///
/// Source: Humphreys, Physics of the Air, 3rd ed., 1940, part IV, chapter on the rainbow.
fn rainbow(n: f64) -> f64 {
    let sin_i = ((4.0 - n * n) / 3.0).sqrt();
    (4.0 * asin(sin_i / n) - 2.0 * asin(sin_i)).to_degrees()
}

#[test]
fn water_makes_a_rainbow_red_outside_and_17_tenths_of_a_degree_wide() {
    let (red, violet) = (rainbow(index("water", 680.0)), rainbow(index("water", 410.0)));
    assert!(red > violet);
    assert!((red - violet - 1.7).abs() < 0.1, "{red} {violet}");
    assert!((rainbow(1.333) - 42.08).abs() < 0.01);
}

#[test]
fn a_prism_of_dense_flint_spreads_colors_more_than_one_of_crown() {
    let spread = |name: &str| {
        let deviation = |lambda: f64| 2.0 * asin(index(name, lambda) * sin(0.4)) - 0.8;
        deviation(LAMBDA_F) - deviation(LAMBDA_C)
    };
    assert!(cos(spread("SF11")) < cos(spread("BK7")));
    assert!(spread("SF11") > 3.0 * spread("BK7"));
}
