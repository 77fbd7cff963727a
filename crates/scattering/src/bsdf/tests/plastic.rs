//! A matte base under a clear coat, polished and rough.

use super::*;
use hyaline_optics::{diffuse_fresnel, fresnel_dielectric};
use hyaline_testkit::{chi_square_sphere, integrate_sphere};

const ETAS: [f32; 4] = [1.2, 1.5, 2.0, 1.0 / 1.3];

/// Fraction of the light that the even part sends out, first lane.
fn even_albedo(surface: &SurfaceBsdf, wo: Vec3) -> f64 {
    integrate_sphere(|d| f64::from(surface.eval(wo, vector(d), Transport::Radiance)[0]), 160, 8)
}

#[test]
fn a_white_base_below_a_polished_coat_gives_back_all_light() {
    for eta in ETAS {
        for nonlinear in [false, true] {
            let coats = CoatTable::uniform(eta, 0.0);
            let surface = flat(Bsdf::plastic(eta, &coats, WHITE, WHITE, nonlinear, 0.0));
            for wo in [direction(0.0, 0.0), direction(0.8, 1.0), direction(1.4, 2.0)] {
                let mirrored = f64::from(surface.branches(wo)[0].map_or(0.0, |b| b.weight[0]));
                let total = mirrored + even_albedo(&surface, wo);
                assert!((total - 1.0).abs() < 1e-3, "eta {eta}, {wo}: {total}");
            }
        }
    }
}

#[test]
fn the_even_part_has_the_sum_of_a_geometric_series() {
    let reflectance = 0.6;
    for eta in ETAS {
        let coats = CoatTable::uniform(eta, 0.0);
        let returned = diffuse_fresnel(1.0 / eta);
        let series = |nonlinear: bool| {
            let each = if nonlinear { reflectance * returned } else { returned };
            // Out at once, or after being sent back once, twice, ...
            (0..400).map(|n| reflectance * (1.0 - returned) * each.powi(n)).sum::<f32>()
        };
        for nonlinear in [false, true] {
            let bsdf = Bsdf::plastic(eta, &coats, Spectrum::splat(reflectance), WHITE, nonlinear, 0.0);
            for wo in [direction(0.2, 0.0), direction(1.2, 2.0)] {
                let want = f64::from((1.0 - fresnel_dielectric(wo.z, eta)) * series(nonlinear));
                let got = even_albedo(&flat(bsdf), wo);
                assert!((got - want).abs() < 1e-3, "eta {eta}, {nonlinear}: {got} not {want}");
            }
        }
    }
}

#[test]
fn a_polished_coat_is_drawn_as_often_as_it_says_and_the_rest_follows_its_density() {
    let mut random = Random::from_seed(51);
    let surface = flat(plastic(1.5, spectrum(0.5, 0.3, 0.1), WHITE, 0.0));
    for wo in [direction(0.3, 0.0), direction(1.3, 2.0)] {
        let (mut delta, mut mean, mut mirror) = (0, 0.0, None);
        for _ in 0..50_000 {
            let sample = draw(&surface, wo, &mut random, Transport::Radiance).unwrap();
            mean += f64::from(sample.weight[0]) / 50_000.0;
            if sample.is_delta {
                delta += 1;
                mirror = Some(sample);
            } else {
                let weight = surface.eval(wo, sample.wi, Transport::Radiance) / surface.pdf(wo, sample.wi);
                assert_close(sample.weight, weight, 1e-4, "even part");
            }
        }
        let mirror = mirror.expect("the coat reflects");
        assert!((mirror.wi - Vec3::new(-wo.x, -wo.y, wo.z)).length() < 1e-6 && !mirror.transmits);
        assert!((delta as f32 / 50_000.0 - mirror.pdf).abs() < 0.01, "{delta}, {}", mirror.pdf);
        let branch = surface.branches(wo)[0].unwrap();
        assert_close(mirror.weight * mirror.pdf, branch.weight, 1e-6, "coat");
        let total = f64::from(branch.weight[0]) + even_albedo(&surface, wo);
        assert!((mean - total).abs() < 0.01, "{mean} drawn of {total}");

        let sample = || {
            let sample = draw(&surface, wo, &mut random, Transport::Radiance)?;
            (!sample.is_delta).then(|| sample.wi.to_array().map(f64::from))
        };
        let pdf = |d: [f64; 3]| f64::from(surface.pdf(wo, vector(d)));
        let result = chi_square_sphere(sample, pdf, 40_000, 20, 16);
        assert!(result.p_value > 1e-3, "{wo}: {result:?}");
    }
    assert!(!surface.is_delta() && surface.has_diffuse_part() && surface.lobe_width() == 1.0);
}

#[test]
fn a_polished_coat_looks_the_same_both_ways() {
    let mut random = Random::from_seed(52);
    let surface = flat(plastic(1.7, spectrum(0.5, 0.3, 0.1), WHITE, 0.0));
    for _ in 0..2000 {
        let (wo, wi) = (random_direction(&mut random), random_direction(&mut random));
        let f = |a: Vec3, b: Vec3| surface.eval(a, b, Transport::Radiance) / b.z.abs();
        assert_close(f(wo, wi), f(wi, wo), 1e-5, "reciprocity");
    }
}

#[test]
fn a_rough_coat_of_vanishing_roughness_gives_the_light_of_a_polished_one() {
    let mut random = Random::from_seed(53);
    for wo in [direction(0.3, 0.0), direction(1.0, 2.0)] {
        let [rough, smooth] = [2e-3, 0.0].map(|alpha| {
            let surface = flat(plastic(1.5, spectrum(0.7, 0.3, 0.1), WHITE, alpha));
            let weights = (0..20_000).filter_map(|_| draw(&surface, wo, &mut random, Transport::Radiance));
            weights.map(|s| f64::from(s.weight[0])).sum::<f64>() / 20_000.0
        });
        assert!((rough - smooth).abs() < 0.01, "{rough} not {smooth}");
    }
}

#[test]
fn a_coat_of_the_index_around_it_is_not_there() {
    let matte = Bsdf::Matte(Matte { reflectance: spectrum(0.5, 0.4, 0.3) });
    assert_eq!(plastic(1.0, spectrum(0.5, 0.4, 0.3), WHITE, 0.3), matte);
}
