//! Irradiance from `sample_direct` against closed forms.

use super::*;
use hyaline_testkit::{Moments, integrate_sphere, z_test};

/// Irradiance at `p` on a surface with normal `n`, estimated.
fn irradiance(light: &Light, p: Vec3, n: Vec3, sample_count: usize) -> Moments {
    let mut random = Random::from_seed(11);
    let contribution = |sample: DirectSample| {
        f64::from(sample.radiance[0]) * f64::from(sample.wi.dot(n).max(0.0)) / f64::from(sample.pdf_w)
    };
    (0..sample_count)
        .map(|_| light.sample_direct(p, random_pair(&mut random)).map_or(0.0, contribution))
        .collect()
}

fn assert_equal(what: &str, estimate: &Moments, expected: f64) {
    let p_value = z_test(estimate.mean() - expected, estimate.variance_of_mean().sqrt());
    let is_equal = (estimate.mean() - expected).abs() < 2e-5 * expected;
    assert!(is_equal || p_value > 1e-3, "{what}: {} for {expected}", estimate.mean());
}

#[test]
fn a_disc_lights_a_point_on_its_axis() {
    let a = 0.7;
    let lamp = Lamp::of_shape("disc", disc(a), Transform::IDENTITY, ShiningSides::Outer);
    for h in [0.05, 0.3, 1.0, 20.0, 1e4] {
        let got = irradiance(&lamp.light, Vec3::Y * h as f32, -Vec3::Y, 200_000);
        let h = f64::from(h as f32);
        assert_equal(&format!("disc at {h}"), &got, PI * f64::from(L) * a * a / (a * a + h * h));
    }
}

/// Irradiance at height h below the corner of an a × b rectangle. Source: Siegel & Howell, Thermal Radiation Heat
/// Transfer, 4th ed., configuration factor from a plane element to a parallel rectangle.
fn below_corner(a: f64, b: f64, h: f64) -> f64 {
    let (x, y) = (a / h, b / h);
    let (rx, ry) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    let sum = x / rx * float::atan2(y, rx) + y / ry * float::atan2(x, ry);
    0.5 * f64::from(L) * sum
}

#[test]
fn a_rectangle_lights_points_below_it() {
    let shape = Lamp::of_shape("square", square(0.5), Transform::IDENTITY, ShiningSides::Outer);
    let mesh = Lamp::of_mesh("square mesh", square_mesh(0.5), None, ShiningSides::Outer);
    for h in [1e-4_f32, 0.01, 0.3, 1.0, 20.0, 2000.0] {
        let below = f64::from(h);
        let (center, corner) = (4.0 * below_corner(0.5, 0.5, below), below_corner(1.0, 1.0, below));
        for (lamp, nearest) in [(&shape, 0.0), (&mesh, 0.1)] {
            if h > nearest {
                let got = irradiance(&lamp.light, Vec3::Y * h, -Vec3::Y, 100_000);
                assert_equal(&format!("{} center at {h}", lamp.name), &got, center);
                let got = irradiance(&lamp.light, Vec3::new(0.5, h, 0.5), -Vec3::Y, 100_000);
                assert_equal(&format!("{} corner at {h}", lamp.name), &got, corner);
            }
        }
    }
}

#[test]
fn a_sphere_lights_as_its_projection_does() {
    let r = 0.5;
    let lamp = Lamp::of_shape("sphere", sphere(r), Transform::IDENTITY, ShiningSides::Outer);
    for d in [0.500_001_f32, 0.51, 1.0, 30.0, 1e5] {
        let p = Vec3::new(0.0, 0.6, 0.8) * d;
        let got = irradiance(&lamp.light, p, -p.normalize(), 100_000);
        // As the point is rounded, so is its distance.
        let distance = p.as_dvec3().length();
        let expected = PI * f64::from(L) * (r / distance).powi(2).min(1.0);
        assert_equal(&format!("sphere at {d}"), &got, expected);
    }
    // Tilted, but with all of the sphere above the horizon.
    let p = Vec3::Y * 2.0;
    let n = Vec3::new(0.6, -0.8, 0.0);
    let got = irradiance(&lamp.light, p, n, 100_000);
    assert_equal("tilted", &got, PI * f64::from(L) * 0.8 * (r / 2.0).powi(2));
}

#[test]
fn a_sphere_that_shines_inward_lights_all_points_inside_alike() {
    let lamp = Lamp::of_shape("sphere", sphere(0.5), Transform::IDENTITY, ShiningSides::Both);
    for p in [Vec3::ZERO, Vec3::new(0.1, 0.2, -0.3), Vec3::new(0.499_999, 0.0, 0.0)] {
        let got = irradiance(&lamp.light, p, Vec3::new(0.36, -0.48, 0.8), 100_000);
        assert_equal(&format!("inside at {p}"), &got, PI * f64::from(L));
    }
}

#[test]
fn a_sphere_turned_inside_out_shines_inward_only() {
    let primitive = Primitive { flipped: true, ..Primitive::new(sphere(0.5)) };
    let light = Light::Shape(ShapeLight::new(primitive, Spectrum::splat(L), ShiningSides::Outer));
    let got = irradiance(&light, Vec3::new(0.1, 0.2, -0.3), Vec3::new(0.36, -0.48, 0.8), 100_000);
    assert_equal("inside out", &got, PI * f64::from(L));
    assert!(light.sample_direct(Vec3::ONE, Vec2::splat(0.4)).is_none());
    let start = light.sample_emission(Vec2::splat(0.3), Vec2::splat(0.6)).unwrap();
    assert!(start.direction.dot(start.origin) < 0.0);
}

#[test]
fn lamps_of_any_shape_light_a_ball_that_encloses_them_with_their_power() {
    // The irradiance on the ball's inside, integrated over it, is what the lamp sends out.
    for lamp in &lamps() {
        let radius = 4.0 * lamp.radius;
        let mut random = Random::from_seed(21);
        let m: Moments = (0..100_000)
            .map(|_| {
                let outward = to_vector(random.direction());
                let p = lamp.center + outward * radius;
                lamp.light.sample_direct(p, random_pair(&mut random)).map_or(0.0, |sample| {
                    // Both sides of some lamps face p; the far one is hidden.
                    let far = 1e-3 * sample.distance;
                    let is_hidden = lamp.hits(p, sample.wi).iter().any(|hit| hit.t < sample.distance - far);
                    let lit = if is_hidden { 0.0 } else { f64::from(sample.radiance[0]) };
                    lit * f64::from(-sample.wi.dot(outward)) / f64::from(sample.pdf_w)
                })
            })
            .collect();
        let got = m.mean() * 4.0 * PI * f64::from(radius).powi(2);
        let error = m.variance_of_mean().sqrt() * 4.0 * PI * f64::from(radius).powi(2);
        let power = f64::from(lamp.light.power()[0]);
        // Concave lamps, and those whose inner side shines into themselves, keep a part.
        let keeps = matches!(
            lamp.name,
            "two-sided sphere" | "half sphere" | "torus" | "part cylinder" | "tetrahedron"
        );
        if keeps {
            assert!(got < power + 4.0 * error && got > 0.3 * power, "{}: {got} of {power}", lamp.name);
        } else {
            assert!(z_test(got - power, error) > 1e-3, "{}: {got} of {power}", lamp.name);
        }
    }
}

#[test]
fn a_point_lights_a_plane_below_it() {
    let (flux, h) = (20.0, 1.5);
    let intensity = Spectrum::splat((flux / (4.0 * PI)) as f32);
    let light = Light::Point(PointLight { position: Vec3::Y * h, intensity });
    for x in [0.0, 0.7, 5.0] {
        let got = irradiance(&light, Vec3::X * x, Vec3::Y, 2);
        let cosine = f64::from(h) / f64::from(h).hypot(f64::from(x));
        let expected = flux * cosine.powi(3) / (4.0 * PI * f64::from(h).powi(2));
        assert_equal(&format!("point at {x}"), &got, expected);
    }
}

#[test]
fn a_spot_s_intensity_falls_between_its_angles() {
    use SpotFalloff::{LinearInAngle, Smooth};
    let angles = (0.8_f32, 0.4_f32);
    for falloff in [Smooth, LinearInAngle] {
        let light =
            Light::Spot(SpotLight::new(Vec3::ZERO, Vec3::Z, Spectrum::ONE, angles.0, angles.1, falloff));
        let intensity = |angle: f64| {
            let (sin, cos) = float::sin_cos(angle);
            let p = DVec3::new(2.0 * sin, 0.0, 2.0 * cos).as_vec3();
            light.sample_direct(p, Vec2::ZERO).map_or(0.0, |sample| 4.0 * f64::from(sample.radiance[0]))
        };
        assert!((intensity(0.0) - 1.0).abs() < 1e-5 && (intensity(0.399) - 1.0).abs() < 1e-5);
        assert_eq!(intensity(0.801), 0.0);
        assert_eq!(intensity(2.0), 0.0);
        let middle_cosine = 0.5 * (float::cos(0.4) + float::cos(0.8));
        let (smooth_middle, linear_middle) = (float::acos(middle_cosine), 0.6);
        let middle = if falloff == Smooth { smooth_middle } else { linear_middle };
        assert!((intensity(middle) - 0.5).abs() < 1e-4, "{falloff:?}: {}", intensity(middle));
        if falloff == LinearInAngle {
            assert!((intensity(0.7) - 0.25).abs() < 1e-4);
        }
    }
}

#[test]
fn parallel_light_lights_by_the_cosine() {
    let got = irradiance(&directional(), Vec3::ONE, Vec3::Y, 2);
    assert_equal("directional", &got, 0.6 * f64::from(L));
}

#[test]
fn the_sky_lights_a_plane_with_its_radiance_times_the_cosine() {
    let n = Vec3::new(0.6, 0.64, -0.48);
    assert_equal("constant", &irradiance(&constant_sky(), Vec3::ZERO, n, 200_000), PI * f64::from(L));
    let sky = image_sky();
    let cosine = |w: [f64; 3]| DVec3::from_array(w).dot(n.as_dvec3()).max(0.0);
    let integrand = |w: [f64; 3]| cosine(w) * f64::from(sky.radiance_of_sky(to_vector(w))[0]);
    let expected = integrate_sphere(integrand, 300, 300);
    let got = irradiance(&sky, Vec3::ZERO, n, 200_000);
    assert_equal("image", &got, expected);
    // A sampler that ignored the image would have several times its mean as standard deviation.
    let relative_deviation = got.variance().sqrt() / got.mean();
    assert!(relative_deviation < 1.5, "the image is sampled badly: {relative_deviation}");
}

#[test]
fn a_projector_lights_a_plane_across_its_axis_evenly_and_the_right_way_up() {
    // Red at the top left, green at the top right, blue in the lower row.
    let [red, green, blue] =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]].map(Spectrum::from_lanes);
    let slide = Slide::new(2, 2, vec![red, green, blue, blue], LANES);
    let (placement, fov) = (placed(1.0), 1.2);
    let projector = |slide: Option<Slide>| {
        Light::Projector(ProjectorLight::new(&placement, fov, Spectrum::splat(L), slide))
    };
    let (half_width, n) = (float::tan(0.6), placement.vector(DVec3::Z).as_vec3());
    for distance in [0.3, 1.0, 40.0] {
        // Places a quarter of the way from each corner of the image are at the centers of its pixels.
        let at = |x: f64, y: f64| {
            placement.point(DVec3::new(x * half_width, y * half_width, -1.0) * distance).as_vec3()
        };
        let expected = f64::from(L) / (distance * distance);
        for (x, y, lane) in [(-0.5, 0.5, 0), (0.5, 0.5, 1), (-0.5, -0.5, 2), (0.5, -0.5, 2)] {
            let white = irradiance(&projector(None), at(x, y), n, 1).mean();
            assert!((white / expected - 1.0).abs() < 1e-4, "{white} for {expected}");
            let sample = projector(slide.clone()).sample_direct(at(x, y), Vec2::ZERO).unwrap();
            let cosine = f64::from(sample.wi.dot(n));
            for other in 0..LANES {
                let got = f64::from(sample.radiance[other]) * cosine;
                let wanted = if other == lane { expected } else { 0.0 };
                assert!((got - wanted).abs() < 1e-3 * expected, "{x} {y}: {:?}", sample.radiance);
            }
        }
        for beside in [at(1.01, 0.0), at(0.0, -1.01), placement.point(DVec3::Z * distance).as_vec3()] {
            assert!(projector(None).sample_direct(beside, Vec2::ZERO).is_none());
        }
    }
}
