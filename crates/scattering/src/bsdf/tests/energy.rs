//! Nothing gives more light than it gets.

use super::*;
use hyaline_testkit::integrate_sphere;

/// Fraction of a photon's power that leaves again, first lane.
fn albedo(bsdf: Bsdf, wo: Vec3) -> f64 {
    let surface = flat(bsdf);
    integrate_sphere(|d| f64::from(surface.eval(wo, vector(d), Transport::Importance)[0]), 160, 80)
}

#[test]
fn nothing_scatters_more_than_it_receives() {
    for (name, bsdf) in examples() {
        for wo in views(&bsdf) {
            let albedo = albedo(bsdf, wo);
            assert!((0.0..=1.005).contains(&albedo), "{name} from {wo}: {albedo}");
        }
    }
}

#[test]
fn sampled_power_is_the_integrated_one() {
    let mut random = Random::from_seed(21);
    // Light that crosses between almost equal indices ends at an edge too sharp for the quadrature.
    let is_smooth = |bsdf: &Bsdf| bsdf.is_opaque() || (bsdf.eta() - 1.0).abs() > 0.1;
    for (name, bsdf) in examples().into_iter().filter(|(_, bsdf)| is_smooth(bsdf)) {
        for wo in views(&bsdf) {
            let surface = flat(bsdf);
            let sum: f64 = (0..50_000)
                .filter_map(|_| draw(&surface, wo, &mut random, Transport::Importance))
                .map(|sample| f64::from(sample.weight[0]))
                .sum();
            let (sampled, integrated) = (sum / 50_000.0, albedo(bsdf, wo));
            assert!((sampled - integrated).abs() < 0.01, "{name} from {wo}: {sampled}, {integrated}");
        }
    }
}

#[test]
fn a_matte_surface_reflects_its_reflectance_and_a_lobe_seen_straight_on_too() {
    let matte = Bsdf::Matte(Matte { reflectance: spectrum(0.6, 0.0, 0.0) });
    assert!((albedo(matte, direction(1.2, 0.4)) - 0.6).abs() < 1e-4);
    for exponent in [0.0, 1.0, 30.0] {
        let glossy = Bsdf::GlossySpecular(GlossySpecular { reflectance: spectrum(0.6, 0.0, 0.0), exponent });
        assert!((albedo(glossy, Vec3::Z) - 0.6).abs() < 1e-3, "exponent {exponent}");
    }
}

/// A metal that reflects everything, so that what is missing is what single scattering loses.
fn white_metal(alpha: f32) -> Bsdf {
    Bsdf::conductor(WHITE, Spectrum::splat(1e4), WHITE, alpha)
}

#[test]
fn a_white_metal_in_a_furnace_loses_only_what_its_facets_shadow() {
    for wo in [direction(0.0, 0.0), direction(0.9, 2.0), direction(1.3, 1.0)] {
        let albedos = [0.1, 0.3, 0.6, 1.0].map(|alpha| albedo(white_metal(alpha), wo));
        assert!(albedos[0] > 0.92 && albedos[0] < 1.001, "{wo}: {albedos:?}");
        assert!(albedos.windows(2).all(|pair| pair[1] < pair[0]), "{wo}: {albedos:?}");
        assert!(albedos[3] > 0.3, "{wo}: {albedos:?}");
    }
}

#[test]
fn a_white_metal_of_width_one_seen_straight_on_reflects_1_minus_ln_2() {
    // D = 1 / π and G2 = G1(wi) = 2 cos / (1 + cos), so that the albedo is 2 ∫ (2c² - 1) / c dc over 1/√2…1.
    let albedo = albedo(white_metal(1.0), Vec3::Z);
    assert!((albedo - (1.0 - std::f64::consts::LN_2)).abs() < 1e-4, "{albedo}");
}

#[test]
fn rough_glass_of_vanishing_roughness_is_polished_glass() {
    let mut random = Random::from_seed(22);
    for eta in [1.5, 1.0 / 1.5] {
        let (rough, smooth) = (
            flat(Bsdf::dielectric(eta, WHITE, WHITE, MIN_ALPHA)),
            flat(Bsdf::dielectric(eta, WHITE, WHITE, 0.0)),
        );
        assert!(!rough.is_delta() && smooth.is_delta());
        for wo in [direction(0.3, 0.0), direction(0.6, 2.0), -direction(0.5, 4.0)] {
            let branches = smooth.branches(wo);
            let (mut count, mut reflected, mut far) = (0, 0, 0);
            for _ in 0..20_000 {
                let Some(sample) = draw(&rough, wo, &mut random, Transport::Importance) else { continue };
                count += 1;
                reflected += usize::from(!sample.transmits);
                let nearest = branches.iter().flatten().find(|b| b.transmits == sample.transmits).unwrap();
                far += usize::from((sample.wi - nearest.wi).length() > 0.05);
                assert_close(sample.weight, WHITE, 0.02, "weight");
            }
            // GGX has long tails: of its facets α² / tan² are tilted by more.
            assert!(far < 200, "{far} of {count} are far from the polished directions");
            let expected = branches[0].unwrap().weight[0];
            assert!(count > 19_900);
            let share = reflected as f32 / count as f32;
            assert!((share - expected).abs() < 0.01, "eta {eta}, {wo}: {share} not {expected}");
        }
    }
}
