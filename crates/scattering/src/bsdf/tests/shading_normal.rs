//! Normals that are not those of the true surface: no leaks, no black rims, and photons that agree with the eye.

use super::*;

/// A shading and a geometric normal less than a right angle apart, and a direction on either side.
fn random_geometry(random: &mut Random) -> (Vec3, Vec3, Vec3) {
    let (n, ng, wo) = (random_direction(random), random_direction(random), random_direction(random));
    (if n.dot(ng) < 0.0 { -n } else { n }, ng, wo)
}

fn all_finishes() -> Vec<(&'static str, Bsdf)> {
    let simple = SimpleTransparent { k_r: 0.2, k_t: 0.7, eta: 1.4 };
    let mut finishes = examples();
    finishes.extend([
        ("mirror", Bsdf::Mirror(Mirror { reflectance: WHITE })),
        ("metal", Bsdf::conductor(WHITE, Spectrum::splat(3.0), WHITE, 0.0)),
        ("glass", Bsdf::dielectric(1.5, WHITE, WHITE, 0.0)),
        ("glass from within", Bsdf::dielectric(1.0 / 1.5, WHITE, WHITE, 0.0)),
        ("pane", Bsdf::ThinDielectric(ThinDielectric { eta: 1.5, tint: WHITE })),
        ("simple transparent", Bsdf::SimpleTransparent(simple)),
        ("lacquer", plastic(1.5, spectrum(0.6, 0.3, 0.2), WHITE, 0.0)),
        ("nothing", Bsdf::PassThrough(PassThrough)),
    ]);
    finishes
}

#[test]
fn light_never_leaks_through_the_true_surface() {
    let mut random = Random::from_seed(41);
    for (name, bsdf) in all_finishes() {
        for _ in 0..20_000 {
            let (n, ng, wo) = random_geometry(&mut random);
            let surface = SurfaceBsdf::new(bsdf, n, ng, wo, Sides::Both, LANES);
            for transport in [Transport::Radiance, Transport::Importance] {
                let Some(sample) = draw(&surface, wo, &mut random, transport) else { continue };
                let crosses = wo.dot(ng) * sample.wi.dot(ng) < 0.0;
                assert_eq!(crosses, sample.transmits, "{name}: n {n}, ng {ng}, wo {wo}, {sample:?}");
                assert!((sample.wi.length() - 1.0).abs() < 1e-5 && sample.weight.is_finite());
                assert!(sample.pdf > 0.0, "{name}");
            }
            let wi = random_direction(&mut random);
            if bsdf.is_opaque() && wo.dot(ng) * wi.dot(ng) < 0.0 {
                assert!(surface.eval(wo, wi, Transport::Radiance).is_zero() && surface.pdf(wo, wi) == 0.0);
            }
        }
    }
}

#[test]
fn polished_glass_loses_no_light_to_interpolated_normals() {
    let mut random = Random::from_seed(42);
    for eta in [1.5, 1.0 / 1.5, 2.42, 1.0] {
        let bsdf = Bsdf::dielectric(eta, WHITE, WHITE, 0.0);
        for _ in 0..50_000 {
            let (n, ng, wo) = random_geometry(&mut random);
            let surface = SurfaceBsdf::new(bsdf, n, ng, wo, Sides::Both, LANES);
            let sample = draw(&surface, wo, &mut random, Transport::Radiance).expect("a direction");
            assert_close(sample.weight, Spectrum::splat(sample.eta_scale), 0.0, "weight");
            let power: f32 = surface
                .branches(wo)
                .iter()
                .flatten()
                .map(|b| b.weight[0] * if b.transmits { eta * eta } else { 1.0 })
                .sum();
            assert!((power - 1.0).abs() < 1e-6, "{power}");
        }
    }
}

#[test]
fn a_shading_normal_that_faces_away_gives_way_to_the_true_one() {
    let ng = Vec3::Z;
    let n = direction(1.2, 0.0);
    let wo = direction(1.2, std::f32::consts::PI);
    let matte = Bsdf::Matte(Matte { reflectance: WHITE });
    let tilted = SurfaceBsdf::new(matte, n, ng, wo, Sides::Both, LANES);
    let wi = direction(0.3, 1.0);
    assert_eq!(tilted.eval(wo, wi, Transport::Radiance), flat(matte).eval(wo, wi, Transport::Radiance));
}

#[test]
fn photons_on_tilted_shading_normals_carry_what_the_eye_sees() {
    // [Veach 1997, eq. 5.19]: with the cosines of the true surface, scattering is the same both ways.
    let mut random = Random::from_seed(43);
    for (name, bsdf) in examples().into_iter().filter(|(_, bsdf)| bsdf.is_opaque()) {
        let mut compared = 0;
        for _ in 0..20_000 {
            let (n, ng, wo) = random_geometry(&mut random);
            let wi = random_direction(&mut random);
            if wo.dot(n).min(wi.dot(n)).min(wo.dot(ng)).min(wi.dot(ng)) < 0.1 {
                continue;
            }
            compared += 1;
            let surface = SurfaceBsdf::new(bsdf, n, ng, wo, Sides::Both, LANES);
            let photon = surface.eval(wo, wi, Transport::Importance) * wo.dot(ng);
            let eye = surface.eval(wi, wo, Transport::Radiance) * wi.dot(ng);
            assert_close(photon, eye, 1e-3, name);
        }
        assert!(compared > 300, "{name}: {compared}");
    }
}

#[test]
fn one_sided_finishes_are_black_behind_and_two_sided_ones_are_not() {
    let matte = Bsdf::Matte(Matte { reflectance: WHITE });
    let glass = Bsdf::dielectric(1.5, WHITE, WHITE, 0.0);
    let behind = -direction(0.5, 0.0);
    let sample = |bsdf, sides| {
        let surface = SurfaceBsdf::new(bsdf, Vec3::Z, Vec3::Z, behind, sides, LANES);
        surface.sample(behind, 0.9, Vec2::splat(0.3), Transport::Radiance)
    };
    assert_eq!(sample(matte, Sides::Front), None);
    assert!(sample(matte, Sides::Both).unwrap().wi.z < 0.0);
    assert!(sample(glass, Sides::Front).unwrap().transmits);
}
