//! `sample_emission` against `pdf_emission` and `power`.

use super::*;
use hyaline_math::Frame;
use hyaline_testkit::{Moments, chi_square, chi_square_sphere, chi_square_square, integrate_sphere, z_test};

fn emit(light: &Light, random: &mut Random) -> Option<EmissionSample> {
    let (u_position, u_direction) = (random_pair(random), random_pair(random));
    light.sample_emission(u_position, u_direction)
}

fn all_lights() -> Vec<Light> {
    let mut lights = bare_lights();
    lights.extend(lamps().into_iter().map(|lamp| lamp.light));
    lights
}

#[test]
fn weights_average_to_the_power() {
    for (seed, light) in all_lights().iter().enumerate() {
        let mut random = Random::from_seed(100 + seed as u64);
        let mut lanes = [Moments::new(); LANES];
        for _ in 0..100_000 {
            let weight = emit(light, &mut random).map_or(Spectrum::ZERO, |sample| sample.weight);
            lanes.iter_mut().enumerate().for_each(|(lane, m)| m.push(f64::from(weight[lane])));
        }
        for (lane, m) in lanes.iter().enumerate() {
            let power = f64::from(light.power()[lane]);
            let p_value = z_test(m.mean() - power, m.variance_of_mean().sqrt());
            let is_equal = (m.mean() / power - 1.0).abs() < 2e-5;
            assert!(is_equal || p_value > 1e-3, "{light:?}: {} for {power}", m.mean());
        }
    }
}

#[test]
fn samples_carry_their_own_densities() {
    let mut random = Random::from_seed(1);
    for light in all_lights() {
        let (mut agreeing, mut count) = (0, 0);
        for _ in 0..2000 {
            let Some(sample) = emit(&light, &mut random) else { continue };
            let pdf = light.pdf_emission(sample.n.unwrap_or(Vec3::Y), sample.direction);
            assert!((sample.direction.length() - 1.0).abs() < 1e-5, "{light:?}");
            assert!((pdf.position / sample.pdf_position - 1.0).abs() < 1e-5, "{light:?}");
            count += 1;
            agreeing += usize::from((pdf.direction / sample.pdf_direction - 1.0).abs() < 5e-3);
        }
        assert!(count > 500 && agreeing * 100 > count * 98, "{light:?}: {agreeing} of {count}");
    }
}

#[test]
fn weights_of_lamps_are_radiance_and_cosine_over_the_densities() {
    let mut random = Random::from_seed(2);
    for lamp in &lamps() {
        for _ in 0..1000 {
            let Some(sample) = emit(&lamp.light, &mut random) else { continue };
            let cosine = sample.n.unwrap().dot(sample.direction).abs();
            let weight = L * cosine / (sample.pdf_position * sample.pdf_direction);
            assert!((sample.weight[0] / weight - 1.0).abs() < 1e-4, "{}", lamp.name);
            assert!(!sample.is_delta_position && !sample.is_delta_direction);
        }
    }
}

#[test]
fn directions_from_lamps_follow_the_density_about_the_normal() {
    for (seed, lamp) in lamps().iter().enumerate() {
        let mut random = Random::from_seed(200 + seed as u64);
        let sample = || {
            let sample = emit(&lamp.light, &mut random)?;
            Some(to_array(Frame::from_normal(sample.n.unwrap()).to_local(sample.direction)))
        };
        let pdf = |w| f64::from(lamp.light.pdf_emission(Vec3::Z, to_vector(w)).direction);
        let result = chi_square_sphere(sample, pdf, 60_000, 16, 24);
        assert!(result.p_value > 1e-4, "{}: {result:?}", lamp.name);
    }
}

#[test]
fn directions_of_wide_bare_lights_follow_the_density() {
    use SpotFalloff::{LinearInAngle, Smooth};
    let point = PointLight { position: Vec3::ONE, intensity: Spectrum::ONE };
    let lights = [
        Light::Point(point),
        spot(0.6, 0.3, Smooth),
        spot(2.5, 0.0, LinearInAngle),
        spot(1.2, 1.2, Smooth),
        constant_sky(),
        image_sky(),
    ];
    for (seed, light) in lights.iter().enumerate() {
        let mut random = Random::from_seed(300 + seed as u64);
        let sample = || Some(to_array(emit(light, &mut random)?.direction));
        let pdf = |w| f64::from(light.pdf_emission(Vec3::Y, to_vector(w)).direction);
        let result = chi_square_sphere(sample, pdf, 100_000, 32, 48);
        assert!(result.p_value > 1e-4, "{light:?}: {result:?}");
    }
}

#[test]
fn directions_of_projectors_follow_the_density() {
    for (seed, light) in projectors().iter().enumerate() {
        let mut random = Random::from_seed(370 + seed as u64);
        let sample = || Some(to_array(emit(light, &mut random)?.direction));
        let pdf = |w| f64::from(light.pdf_emission(Vec3::Y, to_vector(w)).direction);
        let result = chi_square_sphere(sample, pdf, 60_000, 48, 64);
        assert!(result.p_value > 1e-4, "{light:?}: {result:?}");
    }
}

#[test]
fn weights_of_projectors_are_their_intensity_over_the_density() {
    let mut random = Random::from_seed(380);
    for light in projectors() {
        let position = light.position().unwrap();
        for _ in 0..2000 {
            let sample = emit(&light, &mut random).unwrap();
            let lit = light.sample_direct(position + sample.direction * 2.0, Vec2::ZERO);
            let intensity = lit.map_or(0.0, |lit| lit.radiance[0] * 4.0);
            let expected = intensity / sample.pdf_direction;
            assert!((sample.weight[0] - expected).abs() < 2e-3 * (1.0 + expected), "{light:?} {sample:?}");
            assert!((light.intensity(sample.direction)[0] - intensity).abs() < 1e-3 * (1.0 + intensity));
        }
    }
}

#[test]
fn a_narrow_spot_follows_the_density_in_its_cone() {
    let axis = Vec3::new(0.48, -0.6, 0.64).as_dvec3();
    let frame = Frame::from_normal(axis.as_vec3());
    for (seed, light) in
        [spot(0.01, 0.004, SpotFalloff::Smooth), spot(0.01, 0.01, SpotFalloff::Smooth)].iter().enumerate()
    {
        let mut random = Random::from_seed(350 + seed as u64);
        let outer = 1.0 - f64::from(0.01_f32).powi(2) / 2.0 * (1.0 - 1e-4 / 12.0);
        let sample = || {
            let local = frame.to_local(emit(light, &mut random).unwrap().direction).as_dvec3();
            let h = 0.5 * (local - DVec3::Z).length_squared() / (1.0 - outer);
            let azimuth = float::atan2(local.y, local.x) / TAU + 0.5;
            [h.min(1.0), azimuth.clamp(0.0, 1.0)]
        };
        let pdf = |q: [f64; 2]| {
            let h = q[0] * (1.0 - outer);
            let w = Vec3::new((h * (2.0 - h)).sqrt() as f32, 0.0, (1.0 - h) as f32);
            let density = light.pdf_emission(Vec3::Y, frame.to_world(w)).direction;
            f64::from(density) * TAU * (1.0 - outer)
        };
        let result = chi_square_square(sample, pdf, 50_000, 20, 12);
        assert!(result.p_value > 1e-4, "{light:?}: {result:?}");
    }
}

#[test]
fn lamps_emit_uniformly_from_their_surface() {
    let ball = Lamp::of_shape("sphere", sphere(0.7), Transform::IDENTITY, ShiningSides::Outer);
    let mut random = Random::from_seed(7);
    let sample = || Some(to_array(emit(&ball.light, &mut random)?.origin));
    let result = chi_square_sphere(sample, |_| 0.25 / PI, 60_000, 16, 24);
    assert!(result.p_value > 1e-4, "sphere: {result:?}");
    let flat = Lamp::of_shape("square", square(0.5), Transform::IDENTITY, ShiningSides::Both);
    let sample = || {
        let p = emit(&flat.light, &mut random).unwrap().origin.as_dvec3();
        [p.x + 0.5, p.z + 0.5]
    };
    let result = chi_square_square(sample, |_| 1.0, 60_000, 20, 20);
    assert!(result.p_value > 1e-4, "square: {result:?}");
}

#[test]
fn faces_of_a_mesh_emit_in_proportion_to_their_area() {
    let data = MeshData {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.0, 0.0, 3.0)],
        triangles: vec![[0, 2, 1], [0, 1, 3]],
        ..MeshData::default()
    };
    let lamp = Lamp::of_mesh("two faces", data, None, ShiningSides::Outer);
    let mut random = Random::from_seed(3);
    let mut counts = [0.0; 2];
    for _ in 0..40_000 {
        let origin = emit(&lamp.light, &mut random).unwrap().origin;
        counts[usize::from(origin.z > 0.0)] += 1.0;
    }
    assert!(chi_square(&counts, &[10_000.0, 30_000.0], 5.0).p_value > 1e-3, "{counts:?}");
}

#[test]
fn light_from_infinity_starts_uniformly_on_a_disc_that_faces_and_covers_the_scene() {
    for (seed, light) in [directional(), constant_sky(), image_sky()].iter().enumerate() {
        let mut random = Random::from_seed(400 + seed as u64);
        let sample = || loop {
            let Some(sample) = emit(light, &mut random) else { continue };
            let local =
                Frame::from_normal(sample.direction).to_local(sample.origin - SCENE.center).as_dvec3();
            assert!((local.z / f64::from(SCENE.radius) + 1.0).abs() < 1e-5);
            let q = local.truncate() / f64::from(SCENE.radius);
            let azimuth = float::atan2(q.y, q.x) / TAU + 0.5;
            return [q.length_squared().min(1.0), azimuth.clamp(0.0, 1.0)];
        };
        let result = chi_square_square(sample, |_| 1.0, 60_000, 20, 24);
        assert!(result.p_value > 1e-4, "{light:?}: {result:?}");
    }
}

#[test]
fn a_ball_in_a_uniform_sky_is_crossed_by_the_flux_of_its_surface() {
    // Isotropic radiance brings 4 π r² · π L to a ball, wherever it lies in the scene.
    let sky = constant_sky();
    for (seed, offset) in [Vec3::ZERO, Vec3::new(1.0, -1.5, 0.7)].into_iter().enumerate() {
        let (center, r) = (SCENE.center + offset, 0.8_f32);
        let mut random = Random::from_seed(500 + seed as u64);
        let m: Moments = (0..200_000)
            .map(|_| {
                let sample = emit(&sky, &mut random).unwrap();
                let to_ball = center - sample.origin;
                let miss = to_ball - sample.direction * to_ball.dot(sample.direction);
                if miss.length() < r { f64::from(sample.weight[0]) } else { 0.0 }
            })
            .collect();
        let expected = 4.0 * PI * f64::from(r * r) * PI * f64::from(L);
        assert!(z_test(m.mean() - expected, m.variance_of_mean().sqrt()) > 1e-3, "{}", m.mean());
    }
}

#[test]
fn power_is_the_intensity_integrated_over_all_directions() {
    // The intensity, as a point at distance 1 sees it. The axis of the spot is turned to the pole of the quadrature.
    let frame = Frame::from_normal(Vec3::new(0.48, -0.6, 0.64));
    for (light, position) in spots().into_iter().map(|light| (light, Vec3::ONE)) {
        let intensity = |w: [f64; 3]| {
            let p = position + frame.to_world(to_vector(w));
            light.sample_direct(p, Vec2::ZERO).map_or(0.0, |sample| f64::from(sample.radiance[0]))
        };
        let power = f64::from(light.power()[0]);
        if power > 0.05 {
            let got = integrate_sphere(intensity, 4000, 1);
            assert!((got / power - 1.0).abs() < 2e-3, "{light:?}: {got} for {power}");
        }
    }
}

#[test]
fn the_sky_s_power_is_its_radiance_integrated_over_all_directions() {
    let sky = image_sky();
    let area = PI * f64::from(SCENE.radius).powi(2);
    for lane in 0..LANES {
        let got = area * integrate_sphere(|w| f64::from(sky.radiance_of_sky(to_vector(w))[lane]), 300, 300);
        let power = f64::from(sky.power()[lane]);
        assert!((got / power - 1.0).abs() < 1e-3, "{got} for {power}");
    }
}

#[test]
fn closed_forms_of_power() {
    let area = 2.0 * 2.0 * 0.5 * 0.5;
    let one = Lamp::of_shape("square", square(0.5), Transform::IDENTITY, ShiningSides::Outer);
    assert!((f64::from(one.light.power()[0]) - f64::from(L) * PI * area).abs() < 1e-5);
    let both = Lamp::of_shape("square", square(0.5), Transform::IDENTITY, ShiningSides::Both);
    assert_eq!(both.light.power(), one.light.power() * 2.0);
    let disc_area = PI * f64::from(SCENE.radius).powi(2);
    let sun = f64::from(directional().power()[0]);
    assert!((sun / (f64::from(L) * disc_area) - 1.0).abs() < 1e-6);
    let sky = f64::from(constant_sky().power()[0]);
    assert!((sky / (4.0 * PI * f64::from(L) * disc_area) - 1.0).abs() < 1e-6);
    // A sharp cone: 2 π (1 - cos) I.
    let cone = f64::from(spot(1.2, 1.2, SpotFalloff::Smooth).power()[0]);
    let expected = TAU * (1.0 - float::cos(f64::from(1.2_f32))) * f64::from(L);
    assert!((cone / expected - 1.0).abs() < 1e-5);
}

#[test]
fn lights_at_infinity_have_no_power_where_there_is_nothing_to_light() {
    let nothing = SceneSphere::from_bounds(&hyaline_math::Bounds::EMPTY);
    let sky = Light::Environment(EnvironmentLight::from_constant(Spectrum::ONE, nothing));
    assert!(sky.power().is_zero());
    assert!(sky.sample_emission(Vec2::splat(0.2), Vec2::splat(0.7)).is_none());
    assert_eq!(sky.radiance_of_sky(Vec3::X), Spectrum::ONE);
    let black = SkyImage::new(2, 1, vec![Spectrum::ZERO; 2]).unwrap();
    let night = Light::Environment(EnvironmentLight::from_image(black, &Transform::IDENTITY, LANES, SCENE));
    assert!(night.sample_direct(Vec3::ZERO, Vec2::splat(0.5)).is_none());
    assert_eq!(night.pdf_direct(Vec3::ZERO, Vec3::X, None), 0.0);
}
