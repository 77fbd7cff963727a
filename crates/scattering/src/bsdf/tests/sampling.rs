//! Samples, densities and values agree, and light is the same both ways.

use super::*;
use hyaline_testkit::{chi_square_sphere, sidak};

#[test]
fn samples_follow_their_density() {
    let mut random = Random::from_seed(11);
    let level = sidak(0.01, examples().iter().map(|(_, bsdf)| views(bsdf).len()).sum());
    for (name, bsdf) in examples() {
        let surface = flat(bsdf);
        for wo in views(&bsdf) {
            let sample = || {
                let sample = draw(&surface, wo, &mut random, Transport::Radiance)?;
                Some(sample.wi.to_array().map(f64::from))
            };
            let pdf = |d: [f64; 3]| f64::from(surface.pdf(wo, vector(d)));
            let result = chi_square_sphere(sample, pdf, 40_000, 30, 24);
            assert!(result.p_value > level, "{name} from {wo}: {result:?}");
        }
    }
}

#[test]
fn weights_are_values_over_densities() {
    let mut random = Random::from_seed(12);
    for (name, bsdf) in examples() {
        let surface = flat(bsdf);
        for wo in views(&bsdf) {
            for transport in [Transport::Radiance, Transport::Importance] {
                let mut drawn = 0;
                for _ in 0..2000 {
                    let Some(sample) = draw(&surface, wo, &mut random, transport) else { continue };
                    drawn += 1;
                    let pdf = surface.pdf(wo, sample.wi);
                    assert!((pdf - sample.pdf).abs() < 5e-3 * pdf, "{name}, {wo}: {pdf}, {sample:?}");
                    let weight = surface.eval(wo, sample.wi, transport) / pdf;
                    assert_close(sample.weight, weight, 5e-3, name);
                    assert_eq!(sample.transmits, sample.wi.z * wo.z < 0.0);
                    assert!(!sample.is_delta);
                }
                assert!(drawn > 500, "{name} from {wo}: only {drawn}");
            }
        }
    }
}

#[test]
fn light_and_its_reverse_are_scattered_alike_up_to_the_square_of_the_index() {
    let mut random = Random::from_seed(13);
    for (name, bsdf) in examples() {
        let surface = flat(bsdf);
        let index = |w: Vec3| if w.z > 0.0 { 1.0 } else { bsdf.eta() };
        let mut compared = 0;
        for _ in 0..20_000 {
            let (wo, wi) = (random_direction(&mut random), random_direction(&mut random));
            if wo.z.abs().min(wi.z.abs()) < 0.05 {
                continue;
            }
            let f = |a: Vec3, b: Vec3, transport| surface.eval(a, b, transport) / b.z.abs();
            let there = f(wo, wi, Transport::Radiance) / (index(wo) * index(wo));
            let back = f(wi, wo, Transport::Radiance) / (index(wi) * index(wi));
            assert_close(there, back, 2e-3, name);
            // A photon is scattered as the radiance that comes the other way.
            assert_close(f(wo, wi, Transport::Importance), f(wi, wo, Transport::Radiance), 2e-3, name);
            compared += usize::from(!there.is_zero());
        }
        assert!(compared > 1000, "{name}: only {compared} pairs scatter");
    }
}

#[test]
fn permuted_lanes_come_out_permuted() {
    let turned = |s: Spectrum| spectrum(s[2], s[0], s[1]);
    let turn = |bsdf: Bsdf| match bsdf {
        Bsdf::Matte(b) => Bsdf::Matte(Matte { reflectance: turned(b.reflectance) }),
        Bsdf::Phong(b) => {
            Bsdf::Phong(Phong { diffuse: turned(b.diffuse), specular: turned(b.specular), ..b })
        }
        Bsdf::GlossySpecular(b) => {
            Bsdf::GlossySpecular(GlossySpecular { reflectance: turned(b.reflectance), ..b })
        }
        Bsdf::RoughConductor(b) => {
            let Conductor { eta, k, tint } = b.smooth;
            Bsdf::conductor(turned(eta), turned(k), turned(tint), b.alpha)
        }
        Bsdf::RoughDielectric(b) => {
            let Dielectric { eta, tint_r, tint_t } = b.smooth;
            Bsdf::dielectric(eta, turned(tint_r), turned(tint_t), b.alpha)
        }
        Bsdf::RoughPlastic(mut b) => {
            (b.specular, b.base) = (turned(b.specular), turned(b.base));
            Bsdf::RoughPlastic(b)
        }
        other => panic!("no example is {other:?}"),
    };
    let mut random = Random::from_seed(14);
    for (name, bsdf) in examples() {
        for wo in views(&bsdf) {
            for _ in 0..200 {
                let (u_lobe, u2) = (random.uniform_f32(), random_pair(&mut random));
                let sample = |bsdf| flat(bsdf).sample(wo, u_lobe, u2, Transport::Radiance);
                match (sample(bsdf), sample(turn(bsdf))) {
                    (None, None) => {}
                    (Some(a), Some(b)) => {
                        assert_eq!(a.wi, b.wi, "{name}");
                        assert_close(
                            turned(a.weight),
                            spectrum(b.weight[0], b.weight[1], b.weight[2]),
                            1e-5,
                            name,
                        );
                    }
                    (a, b) => panic!("{name}: {a:?} against {b:?}"),
                }
            }
        }
    }
}

#[test]
fn lanes_beyond_the_count_decide_nothing() {
    let spoiled = |s: Spectrum, extra| Spectrum::from_lanes([s[0], s[1], s[2], extra]);
    let (diffuse, specular) = (spectrum(0.3, 0.2, 0.1), spectrum(0.1, 0.5, 0.4));
    let phong = |extra| {
        Bsdf::Phong(Phong {
            diffuse: spoiled(diffuse, extra),
            specular: spoiled(specular, 0.0),
            exponent: 9.0,
        })
    };
    let glass = |extra| Bsdf::dielectric(1.5, spoiled(WHITE, extra), spoiled(WHITE, 0.5), 0.0);
    let mut random = Random::from_seed(15);
    for _ in 0..1000 {
        let (u_lobe, u2) = (random.uniform_f32(), random_pair(&mut random));
        for pair in [[phong(0.0), phong(100.0)], [glass(0.0), glass(100.0)]] {
            let [a, b] = pair.map(|bsdf| {
                let sample = flat(bsdf).sample(direction(0.7, 0.2), u_lobe, u2, Transport::Radiance);
                sample.map(|s| (s.wi, s.weight[0], s.pdf))
            });
            assert_eq!(a, b);
        }
    }
}
