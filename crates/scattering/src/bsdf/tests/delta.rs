//! Polished finishes against closed forms.

use super::*;
use hyaline_optics::{fresnel_conductor, fresnel_dielectric};

fn glass(eta: f32) -> SurfaceBsdf {
    flat(Bsdf::dielectric(eta, WHITE, WHITE, 0.0))
}

#[test]
fn lossless_glass_gives_every_photon_back_undiminished() {
    let mut random = Random::from_seed(31);
    for eta in [1.5, 1.0 / 1.5, 1.333, 2.42, 1.0] {
        let surface = glass(eta);
        for _ in 0..20_000 {
            let wo = random_direction(&mut random);
            let sample =
                draw(&surface, wo, &mut random, Transport::Importance).expect("light goes somewhere");
            assert_close(sample.weight, WHITE, 0.0, "weight");
            assert_eq!(sample.eta_scale, 1.0);
            assert_eq!(sample.transmits, sample.wi.z * wo.z < 0.0);
        }
    }
}

#[test]
fn branches_are_chosen_in_the_proportion_of_fresnel() {
    let mut random = Random::from_seed(32);
    let wo = direction(1.2, 0.3);
    let draws = (0..100_000).filter_map(|_| draw(&glass(1.5), wo, &mut random, Transport::Radiance));
    let reflected = draws.filter(|sample| !sample.transmits).count() as f32 / 100_000.0;
    assert!((reflected - fresnel_dielectric(wo.z, 1.5)).abs() < 0.005);
}

#[test]
fn radiance_takes_the_square_of_the_index_into_glass_and_gives_it_back_beyond() {
    let mut random = Random::from_seed(33);
    let wo = direction(0.5, 1.0);
    let into = loop {
        let sample = draw(&glass(1.5), wo, &mut random, Transport::Radiance).unwrap();
        if sample.transmits {
            break sample;
        }
        assert_close(sample.weight, WHITE, 0.0, "reflection");
    };
    assert!((into.weight[0] - 1.0 / 2.25).abs() < 1e-6);
    assert_eq!(into.eta_scale, into.weight[0]);
    // Out of the glass again: from the far side of the same surface, and through one built for the inside.
    for surface in [glass(1.5), flat(Bsdf::dielectric(1.0 / 1.5, WHITE, WHITE, 0.0))] {
        let inside = if surface.bsdf.eta() > 1.0 { into.wi } else { -into.wi };
        let [_, out] = surface.branches(inside);
        let out = out.unwrap();
        let transmitted = 1.0 - fresnel_dielectric(wo.z, 1.5);
        assert!((out.weight[0] * into.weight[0] - transmitted).abs() < 1e-5);
        let back = if surface.bsdf.eta() > 1.0 { out.wi } else { -out.wi };
        assert!((back - wo).length() < 1e-5);
    }
}

#[test]
fn total_internal_reflection_leaves_one_branch() {
    let wo = direction(0.8, 1.0);
    for surface in [
        glass(1.0 / 1.5),
        flat(Bsdf::SimpleTransparent(SimpleTransparent { k_r: 0.1, k_t: 0.8, eta: 1.0 / 1.5 })),
    ] {
        let [reflection, refraction] = surface.branches(wo);
        let reflection = reflection.unwrap();
        assert_close(reflection.weight, WHITE, 0.0, "total reflection");
        assert!((reflection.wi - Vec3::new(-wo.x, -wo.y, wo.z)).length() < 1e-6);
        assert_eq!(refraction, None);
    }
}

#[test]
fn equal_indices_let_light_pass_straight_whatever_the_roughness() {
    let mut random = Random::from_seed(34);
    let surface = flat(Bsdf::dielectric(1.0, WHITE, WHITE, 0.7));
    for _ in 0..10_000 {
        let wo = random_direction(&mut random);
        let sample = draw(&surface, wo, &mut random, Transport::Radiance).unwrap();
        assert!(sample.transmits && (sample.wi + wo).length() < 1e-6);
        assert_close(sample.weight, WHITE, 0.0, "weight");
    }
}

#[test]
fn a_thin_pane_sums_the_reflections_between_its_faces() {
    let surface = flat(Bsdf::ThinDielectric(ThinDielectric { eta: 1.5, tint: WHITE }));
    for (wo, want) in [(Vec3::Z, 0.076_923_08), (-Vec3::Z, 0.076_923_08)] {
        let [reflection, transmission] = surface.branches(wo).map(Option::unwrap);
        assert!((reflection.weight[0] - want).abs() < 1e-6);
        assert!((transmission.weight[0] - 0.923_076_9).abs() < 1e-6);
        assert_eq!((reflection.wi, transmission.wi), (wo, -wo));
    }
    let wo = direction(1.2, 2.0);
    // The series written out: R, and T² R^(2n-1) for n = 1, 2, ...
    let r = f64::from(fresnel_dielectric(wo.z, 1.5));
    let series = (0..200).fold(r, |sum, n| sum + (1.0 - r).powi(2) * r.powi(2 * n + 1));
    assert!((f64::from(surface.branches(wo)[0].unwrap().weight[0]) - series).abs() < 1e-6);
}

#[test]
fn simple_transparency_takes_constant_fractions_and_the_square_of_the_index() {
    let simple = SimpleTransparent { k_r: 0.1, k_t: 0.9, eta: 1.5 };
    let surface = flat(Bsdf::SimpleTransparent(simple));
    for wo in [direction(0.2, 0.0), direction(1.3, 0.0)] {
        let [reflection, refraction] = surface.branches(wo).map(Option::unwrap);
        assert_close(reflection.weight, Spectrum::splat(0.1), 0.0, "reflection");
        assert_close(refraction.weight, Spectrum::splat(0.9 / 2.25), 1e-6, "refraction");
        assert!((refraction.wi.x + wo.x / 1.5).abs() < 1e-6);
    }
    let mut random = Random::from_seed(35);
    let sample = draw(&surface, Vec3::Z, &mut random, Transport::Importance).unwrap();
    assert_close(sample.weight, WHITE, 1e-6, "k_r + k_t");
}

#[test]
fn metals_and_mirrors_reflect_at_the_mirror_angle_only() {
    let (eta, k) = (spectrum(0.2, 0.4, 1.4), spectrum(3.9, 2.4, 1.6));
    let wo = direction(0.9, 0.3);
    let fresnel = |lane: usize| fresnel_conductor(wo.z, eta[lane], k[lane]);
    let gold = flat(Bsdf::conductor(eta, k, spectrum(1.0, 0.5, 1.0), 0.0));
    let mirror = flat(Bsdf::Mirror(Mirror { reflectance: spectrum(0.9, 0.8, 0.7) }));
    let wanted = [spectrum(fresnel(0), 0.5 * fresnel(1), fresnel(2)), spectrum(0.9, 0.8, 0.7)];
    let mut random = Random::from_seed(36);
    for (surface, want) in [gold, mirror].into_iter().zip(wanted) {
        let sample = draw(&surface, wo, &mut random, Transport::Radiance).unwrap();
        assert!((sample.wi - Vec3::new(-wo.x, -wo.y, wo.z)).length() < 1e-6);
        assert_close(sample.weight, want, 1e-6, "weight");
        assert!(sample.is_delta && !sample.transmits && sample.pdf == 1.0);
        assert!(surface.eval(wo, sample.wi, Transport::Radiance).is_zero());
        assert_eq!(surface.pdf(wo, sample.wi), 0.0);
        assert_eq!(surface.sample(-wo, 0.5, Vec2::splat(0.5), Transport::Radiance), None, "the back");
    }
}

#[test]
fn lanes_without_an_index_are_dark_and_spoil_nothing() {
    for alpha in [0.0, 0.3] {
        let metal = Bsdf::conductor(spectrum(0.2, 0.4, 1.4), spectrum(3.9, 2.4, 1.6), WHITE, alpha);
        let sample = flat(metal).sample(Vec3::Z, 0.5, Vec2::new(0.5, 0.0), Transport::Radiance).unwrap();
        assert!(sample.weight[0] > 0.8 && sample.weight[3] == 0.0, "{sample:?}");
    }
}

#[test]
fn passing_through_changes_nothing() {
    let surface = flat(Bsdf::PassThrough(PassThrough));
    let wo = direction(1.0, 1.0);
    let sample = surface.sample(wo, 0.99, Vec2::ZERO, Transport::Radiance).unwrap();
    assert_eq!((sample.wi, sample.weight, sample.pdf, sample.transmits), (-wo, WHITE, 1.0, true));
}

#[test]
fn what_has_lobes_has_no_branches_and_black_has_nothing() {
    for (name, bsdf) in examples() {
        assert_eq!(flat(bsdf).branches(direction(0.4, 0.0)), [None, None], "{name}");
    }
    let black = flat(Bsdf::Black(Black));
    assert_eq!(black.sample(Vec3::Z, 0.5, Vec2::splat(0.5), Transport::Radiance), None);
    assert!(black.eval(Vec3::Z, Vec3::Z, Transport::Radiance).is_zero() && !black.is_delta());
}

#[test]
fn widths_and_albedos_order_finishes_as_the_eye_does() {
    let widths = [
        Bsdf::dielectric(1.5, WHITE, WHITE, 0.0),
        Bsdf::GlossySpecular(GlossySpecular { reflectance: WHITE, exponent: 1000.0 }),
        Bsdf::conductor(WHITE, WHITE, WHITE, 0.2),
        Bsdf::Matte(Matte { reflectance: WHITE }),
    ]
    .map(|bsdf| flat(bsdf).lobe_width());
    assert!(widths[0] == 0.0 && widths.is_sorted_by(|a, b| a < b) && widths[3] == 1.0, "{widths:?}");
    let orange = spectrum(0.8, 0.4, 0.1);
    assert_eq!(flat(Bsdf::Matte(Matte { reflectance: orange })).albedo_estimate(), orange);
    assert!(flat(Bsdf::Black(Black)).albedo_estimate().is_zero());
}
