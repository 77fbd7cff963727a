//! `sample_direct` against `pdf_direct` and `radiance_from`.

use super::*;
use hyaline_math::Frame;
use hyaline_testkit::{ChiSquare, chi_square_sphere};

const SAMPLE_COUNT: usize = 30_000;

/// A map of directions about an axis that blows a narrow cone up to a hemisphere, so that lights far away fill more
/// than one cell of the test.
struct Lens {
    frame: Frame,
    /// Tangent of the half-angle of the cone.
    tangent: f64,
}

impl Lens {
    fn toward(lamp: &Lamp, p: Vec3) -> Self {
        let to_center = lamp.center - p;
        let sine = f64::from(lamp.radius) / f64::from(to_center.length());
        let tangent = 1.02 * sine / (1.0 - sine * sine).sqrt();
        Self { frame: Frame::from_normal(to_center.normalize()), tangent }
    }

    /// Stereographic image of the plane that the cone cuts out a disc of.
    fn magnify(&self, wi: Vec3) -> [f64; 3] {
        let local = self.frame.to_local(wi).as_dvec3();
        let q = local.truncate() / (local.z * self.tangent);
        let s = q.length_squared();
        [2.0 * q.x / (1.0 + s), 2.0 * q.y / (1.0 + s), (1.0 - s) / (1.0 + s)]
    }

    /// The direction of an image, and how many times larger a solid angle is in the image.
    fn shrink(&self, image: [f64; 3]) -> Option<(Vec3, f64)> {
        let q = DVec3::from_array(image).truncate() / (1.0 + image[2]);
        let s = q.length_squared();
        let local = (q * self.tangent).extend(1.0).normalize();
        let factor = 4.0 / (1.0 + s).powi(2) / (self.tangent.powi(2) * local.z.powi(3));
        (s < 4.0).then(|| (self.frame.to_world(local.as_vec3()), factor))
    }
}

/// Whether light reaches a point: the density of nothing cannot be tested.
fn is_lit(lamp: &Lamp, p: Vec3) -> bool {
    let mut random = Random::from_seed(77);
    (0..1000).any(|_| lamp.sample_clearly(p, random_pair(&mut random)).is_some())
}

/// The test through a lens, for points outside the ball about a lamp.
fn magnified_test(lamp: &Lamp, p: Vec3, seed: u64) -> ChiSquare {
    let lens = Lens::toward(lamp, p);
    let mut random = Random::from_seed(seed);
    let sample = || {
        let wi = lamp.sample_clearly(p, random_pair(&mut random))?;
        Some(lens.magnify(wi))
    };
    let pdf = |image| {
        let Some((wi, factor)) = lens.shrink(image) else { return 0.0 };
        lamp.pdf_clearly(p, wi) / factor
    };
    direction_test(sample, pdf, SAMPLE_COUNT)
}

/// The test on all directions.
fn plain_test(lamp: &Lamp, p: Vec3, seed: u64) -> ChiSquare {
    let mut random = Random::from_seed(seed);
    let sample = || Some(to_array(lamp.sample_clearly(p, random_pair(&mut random))?));
    let pdf = |wi| lamp.pdf_clearly(p, to_vector(wi));
    direction_test(sample, pdf, SAMPLE_COUNT)
}

#[test]
fn directions_to_lamps_outside_follow_the_density() {
    let offsets = [Vec3::new(0.9, 1.3, 0.4), Vec3::new(-0.3, -1.2, -1.1), Vec3::new(60.0, -90.0, 20.0)];
    let mut tested = 0;
    for (i, lamp) in lamps().iter().enumerate() {
        for (j, offset) in offsets.into_iter().enumerate() {
            if is_lit(lamp, lamp.center + offset) {
                let result = magnified_test(lamp, lamp.center + offset, (10 * i + j) as u64);
                assert!(result.p_value > 1e-4, "{} from {offset}: {result:?}", lamp.name);
                tested += 1;
            }
        }
    }
    assert!(tested >= 30, "{tested}");
}

#[test]
fn directions_to_lamps_around_follow_the_density() {
    let offsets = [Vec3::new(0.05, 0.1, -0.08), Vec3::new(-0.2, 0.3, 0.3)];
    for (i, lamp) in lamps().iter().enumerate() {
        for (j, offset) in offsets.into_iter().enumerate() {
            if is_lit(lamp, lamp.center + offset) {
                let result = plain_test(lamp, lamp.center + offset, (500 + 10 * i + j) as u64);
                assert!(result.p_value > 1e-4, "{} from {offset}: {result:?}", lamp.name);
            }
        }
    }
}

#[test]
fn directions_from_just_above_a_lamp_follow_the_density() {
    for height in [0.1, 1e-3] {
        let rectangle = Lamp::of_shape("rectangle", square(0.5), Transform::IDENTITY, ShiningSides::Outer);
        let p = Vec3::new(0.2, height, -0.1);
        let result = plain_test(&rectangle, p, 900);
        assert!(result.p_value > 1e-4, "rectangle at {height}: {result:?}");
        let ball = Lamp::of_shape("sphere", sphere(0.5), Transform::IDENTITY, ShiningSides::Outer);
        let p = Vec3::new(0.0, 0.3, 0.4) * (1.0 + 2.0 * height);
        let result = plain_test(&ball, p, 901);
        assert!(result.p_value > 1e-4, "sphere at {height}: {result:?}");
    }
}

#[test]
fn directions_to_the_sky_follow_the_density() {
    for (seed, sky) in [constant_sky(), image_sky()].iter().enumerate() {
        let mut random = Random::from_seed(seed as u64);
        let sample = || Some(to_array(sky.sample_direct(Vec3::ZERO, random_pair(&mut random))?.wi));
        let pdf = |wi| f64::from(sky.pdf_direct(Vec3::ZERO, to_vector(wi), None));
        let result = chi_square_sphere(sample, pdf, 200_000, 32, 48);
        assert!(result.p_value > 1e-4, "{result:?}");
    }
}

#[test]
fn a_ray_in_a_sampled_direction_meets_the_sampled_place_with_the_sampled_density() {
    let mut random = Random::from_seed(4);
    for lamp in &lamps() {
        let mut found = 0;
        for _ in 0..20_000 {
            let reach = if random.uniform() < 0.5 { 0.8 } else { 30.0 };
            let p = lamp.center + to_vector(random.direction()) * (reach * random.uniform_f32());
            let Some(sample) = lamp.light.sample_direct(p, random_pair(&mut random)) else { continue };
            let target = sample.target.expect("a lamp has a surface");
            // Grazing hits may be off by more than their density tells.
            if target.n.dot(sample.wi).abs() < 0.02 {
                continue;
            }
            let hits = lamp.hits(p, sample.wi);
            let is_there = |hit: &&SurfaceHit| {
                (hit.p - target.p).length() < 1e-4 * (1.0 + sample.distance) && hit.ng.dot(target.n) > 0.99
            };
            let Some(hit) = hits.iter().find(is_there) else { continue };
            found += 1;
            assert!((hit.t / sample.distance - 1.0).abs() < 1e-3 || sample.distance < 1e-2, "{}", lamp.name);
            let pdf = lamp.light.pdf_direct(p, sample.wi, Some(hit));
            let deviation = (pdf / sample.pdf_w - 1.0).abs();
            let is_touching = sample.distance < 0.05;
            assert!(deviation < 5e-3 || is_touching, "{} from {p}: {pdf} for {sample:?}", lamp.name);
            assert_eq!(lamp.light.radiance_from(hit, -sample.wi), sample.radiance, "{}", lamp.name);
        }
        assert!(found > 3000, "{}: only {found} samples could be compared", lamp.name);
    }
}

#[test]
fn nearly_every_sampled_place_is_met_by_a_ray() {
    let mut random = Random::from_seed(14);
    for lamp in &lamps() {
        let (mut sampled, mut met) = (0, 0);
        for _ in 0..5000 {
            let p = lamp.center + to_vector(random.direction()) * 4.0;
            let Some(sample) = lamp.light.sample_direct(p, random_pair(&mut random)) else { continue };
            sampled += 1;
            met += usize::from(!lamp.hits(p, sample.wi).is_empty());
        }
        assert!(sampled > 500 && met * 1000 >= sampled * 998, "{}: {met} of {sampled}", lamp.name);
    }
}

#[test]
fn the_sky_s_radiance_and_density_are_those_of_its_samples() {
    let sky = image_sky();
    let mut random = Random::from_seed(6);
    let mut agreeing = 0;
    for _ in 0..10_000 {
        let Some(sample) = sky.sample_direct(Vec3::ONE, random_pair(&mut random)) else { continue };
        assert_eq!(sky.radiance_of_sky(sample.wi), sample.radiance);
        let pdf = sky.pdf_direct(Vec3::ONE, sample.wi, None);
        agreeing += usize::from((pdf / sample.pdf_w - 1.0).abs() < 1e-4);
        assert!(sample.distance.is_infinite() && sample.target.is_none() && !sample.is_delta);
    }
    // A direction within rounding of a cell's edge may be looked up in the next cell.
    assert!(agreeing > 9_900, "{agreeing}");
}

#[test]
fn one_sided_lamps_are_dark_from_behind() {
    let mut random = Random::from_seed(8);
    let lamp = Lamp::of_shape("square", square(0.5), Transform::IDENTITY, ShiningSides::Outer);
    let (front, behind) = (Vec3::new(0.1, 1.0, 0.2), Vec3::new(0.1, -1.0, 0.2));
    for _ in 0..1000 {
        let u = random_pair(&mut random);
        assert!(lamp.light.sample_direct(front, u).is_some());
        assert!(lamp.light.sample_direct(behind, u).is_none());
    }
    let hit = lamp.hits(behind, Vec3::Y)[0];
    assert_eq!(lamp.light.pdf_direct(behind, Vec3::Y, Some(&hit)), 0.0);
    assert!(lamp.light.radiance_from(&hit, -Vec3::Y).is_zero());
    let ball = Lamp::of_shape("sphere", sphere(0.7), Transform::IDENTITY, ShiningSides::Outer);
    assert!(ball.light.sample_direct(Vec3::new(0.1, 0.2, 0.0), Vec2::splat(0.3)).is_none());
}

#[test]
fn delta_lights_are_never_met_by_chance() {
    for light in bare_lights() {
        if let Some(sample) = light.sample_direct(Vec3::new(1.1, 0.9, 1.2), Vec2::splat(0.5))
            && sample.is_delta
        {
            assert_eq!(sample.pdf_w, 1.0);
            assert_eq!(light.pdf_direct(Vec3::ZERO, sample.wi, None), 0.0);
            assert!(light.radiance_of_sky(sample.wi).is_zero());
        }
    }
}

#[test]
fn a_point_on_the_light_itself_gives_no_numbers_that_are_not_finite() {
    let mut random = Random::from_seed(12);
    let mut check = |light: &Light, p: Vec3| {
        for _ in 0..2000 {
            if let Some(sample) = light.sample_direct(p, random_pair(&mut random)) {
                assert!(sample.wi.is_finite() && sample.radiance.is_finite(), "{light:?}");
                assert!(sample.pdf_w > 0.0 && sample.pdf_w.is_finite(), "{light:?}");
            }
        }
    };
    for lamp in &lamps() {
        let start = lamp.light.sample_emission(Vec2::splat(0.4), Vec2::splat(0.3)).unwrap();
        check(&lamp.light, start.origin);
        check(&lamp.light, lamp.center);
    }
    for light in bare_lights() {
        check(&light, Vec3::ONE);
        check(&light, Vec3::new(0.5, 0.25, -1.0));
    }
}
