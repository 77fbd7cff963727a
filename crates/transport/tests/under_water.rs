//! Cameras and lights on both sides of a flat water surface, against radiances calculated by hand.
//!
//! The surface is y = 0, water below, air above. Light that crosses it keeps its power but for Fresnel's reflection, and
//! its radiance grows by n² on the way down, where it fills a narrower cone, and shrinks by n² on the way up.

mod by_hand;
mod following;
mod scene_kit;

use by_hand::{reflected, reflected_from_inside, reflected_from_outside, refracted_cosine};
use following::{Way, follow, ray};
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray};
use hyaline_scene::ShapeDescription;
use hyaline_testkit::integrate;
use scene_kit::*;
use std::f64::consts::PI;

const N: f64 = 1.333;

/// So wide that the edges send no light that counts.
const WIDE: f64 = 1e4;

const SAMPLES: u32 = 60_000;

/// Radius of the patches that are lit but light nothing in turn.
const PATCH: f64 = 0.004;

/// A water surface, clear or absorbing.
fn water(sigma: f32) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.absorbing_medium("water", N, [sigma; 3], 0);
    kit.interface("surface", floor(0.0, WIDE), None, Some("water"));
    kit
}

fn disc(y: f64, normal: DVec3, radius: f64) -> ShapeDescription {
    ShapeDescription::Disc { center: DVec3::Y * y, normal, radius, inner_radius: 0.0 }
}

/// A ray from `from`, at `angle` radians from the vertical, up or down.
fn slanted(from: DVec3, angle: f64, up: f64) -> Ray {
    let (sin, cos) = float::sin_cos(angle);
    ray(from, DVec3::new(sin, up * cos, 0.0))
}

#[test]
fn the_sky_is_seen_in_a_window_and_the_floor_around_it() {
    let (sky, bottom) = (1.5_f32, 0.25_f32);
    let from = DVec3::new(0.2, -1.0, 0.0);
    let mut kit = water(0.0);
    kit.lamp("bottom", floor(-2.0, WIDE), bottom).sky(sky).camera(from, from + DVec3::Y);
    let world = kit.world();
    let (sky, bottom) = (N * N * f64::from(sky), f64::from(bottom));
    for degrees in [0.0_f64, 20.0, 40.0, 48.0, 48.6] {
        let view = slanted(from, degrees.to_radians(), 1.0);
        let r = reflected(float::cos(degrees.to_radians()), 1.0 / N);
        let expected = (1.0 - r) * sky + r * bottom;
        assert_mean(&estimate(&world, view, SAMPLES), expected, &format!("window at {degrees}°"));
        for index in 0..100 {
            let set = &world.camera_media[0];
            let is_one_of_both =
                |value: f64| (value / sky - 1.0).abs() < 1e-5 || (value / bottom - 1.0).abs() < 1e-5;
            let one_way = f64::from(unsplit_sample(&world, view, set.clone(), index));
            assert!(is_one_of_both(one_way), "{degrees}°: {one_way} is neither sky nor floor");
            // A path is split, but where one of its parts would be faint. Near the critical angle shares are steep in f32.
            let value = f64::from(sample(&world, view, set.clone(), index));
            let is_right = if r.min(1.0 - r) > 0.02 {
                (value / expected - 1.0).abs() < 1e-4
            } else {
                is_one_of_both(value)
            };
            assert!(is_right, "{degrees}°: {value}, not {expected} of sky and floor");
        }
    }
    for degrees in [48.62_f64, 55.0, 75.0, 89.0] {
        let moments = estimate(&world, slanted(from, degrees.to_radians(), 1.0), 1000);
        assert!((moments.mean() / bottom - 1.0).abs() < 1e-6 && moments.variance() < 1e-12, "{degrees}°");
    }
    // Below its surface, the way down is unhindered.
    assert_mean(&estimate(&world, slanted(from, 0.3, -1.0), 4), bottom, "down");
}

#[test]
fn the_window_is_48_6_degrees_wide_to_each_side() {
    let from = DVec3::new(0.0, -1.0, 0.0);
    let mut kit = water(0.0);
    kit.camera(from, from + DVec3::Y).sky(1.0);
    let world = kit.world();
    let gets_out = |angle: f64| follow(&world, slanted(from, angle, 1.0), &[Way::Transmit]).is_some();
    let (mut inside, mut outside) = (0.5, 1.2);
    assert!(gets_out(inside) && !gets_out(outside));
    while outside - inside > 1e-7 {
        let middle = 0.5 * (inside + outside);
        if gets_out(middle) { inside = middle } else { outside = middle }
    }
    assert!((inside.to_degrees() - 48.607).abs() < 1e-3, "the window ends at {}°", inside.to_degrees());
}

/// Radiance that a matte bottom sends up within clear water under a uniform sky of radiance 1.
///
/// Through each square meter of the surface come π (1 - F_out) W down, whatever their angles; the bottom returns a part
/// `albedo` as Lambertian light, of which the surface throws F_in back, and so on: a geometric series.
fn bottom_radiance(albedo: f64) -> f64 {
    albedo * (1.0 - reflected_from_outside(N)) / (1.0 - albedo * reflected_from_inside(N))
}

/// Water a meter deep over a matte bottom, under a sky of radiance 1.
fn pool(albedo: f32, sigma: f32, camera: DVec3) -> SceneKit {
    let mut kit = water(sigma);
    kit.matte("matte", albedo).surface("bottom", floor(-1.0, WIDE), "matte");
    kit.sky(1.0).camera(camera, camera + DVec3::Y);
    kit
}

#[test]
fn a_white_bottom_would_shine_as_the_furnace_does() {
    assert!((bottom_radiance(1.0) - N * N).abs() < 1e-9);
}

#[test]
fn a_camera_in_water_sees_the_bottom_the_sky_and_the_bottoms_reflection() {
    let from = DVec3::new(0.0, -0.5, 0.0);
    for albedo in [0.2_f32, 0.75] {
        let world = pool(albedo, 0.0, from).world();
        let bottom = bottom_radiance(f64::from(albedo));
        for angle in [0.0, 1.0] {
            let moments = estimate(&world, slanted(from, angle, -1.0), SAMPLES);
            assert_mean(&moments, bottom, &format!("albedo {albedo}, down at {angle}"));
        }
        for angle in [0.0, 0.5, 0.8] {
            let r = reflected(float::cos(angle), 1.0 / N);
            let expected = N * N * (1.0 - r) + r * bottom;
            let moments = estimate(&world, slanted(from, angle, 1.0), SAMPLES);
            assert_mean(&moments, expected, &format!("albedo {albedo}, up at {angle}"));
        }
        // Beyond the window there is nothing but the bottom, mirrored.
        assert_mean(&estimate(&world, slanted(from, 1.2, 1.0), SAMPLES), bottom, "total reflection");
    }
}

#[test]
fn a_camera_in_air_sees_the_bottom_dimmed_by_n_squared() {
    let from = DVec3::new(0.0, 0.7, 0.0);
    let albedo = 0.6;
    let world = pool(albedo, 0.0, from).world();
    for angle in [0.0, 0.6, 1.2] {
        let r = reflected(float::cos(angle), N);
        let expected = r + (1.0 - r) / (N * N) * bottom_radiance(f64::from(albedo));
        assert_mean(&estimate(&world, slanted(from, angle, -1.0), SAMPLES), expected, &format!("at {angle}"));
    }
}

#[test]
fn absorbing_water_dims_every_passage() {
    let (albedo, sigma, depth) = (0.8_f32, 0.5_f32, 1.0);
    let (rho, s) = (f64::from(albedo), f64::from(sigma));
    // Integrals over the cosine in air: at both ends of the same ray the surface reflects alike, and cos_w dcos_w =
    // cos_a dcos_a / n². Filtered is one way down, or both ways of a round trip; beyond the window the reflection is
    // total.
    let slope = |c: f64| depth / refracted_cosine(c, N);
    let down = |c: f64| (1.0 - reflected(c, N)) * float::exp(-s * slope(c)) * c;
    let to_and_fro = |c: f64| reflected(c, N) * float::exp(-2.0 * s * slope(c)) * c;
    let first = 2.0 * integrate(down, 0.0, 1.0, 64);
    let critical = (1.0 - 1.0 / (N * N)).sqrt();
    let total = 2.0 * integrate(|c| float::exp(-2.0 * s * depth / c) * c, 0.0, critical, 64);
    let round_trip = total + 2.0 * integrate(to_and_fro, 0.0, 1.0, 64) / (N * N);
    let bottom = rho * first / (1.0 - rho * round_trip);

    let from = DVec3::new(0.0, -0.4, 0.0);
    let world = pool(albedo, sigma, from).world();
    let expected = bottom * float::exp(-s * 0.6);
    assert_mean(&estimate(&world, slanted(from, 0.0, -1.0), 2 * SAMPLES), expected, "from within");

    let above = DVec3::new(0.0, 0.3, 0.0);
    let world = pool(albedo, sigma, above).world();
    let angle = 0.7;
    let r = reflected(float::cos(angle), N);
    let slant = depth / refracted_cosine(float::cos(angle), N);
    let expected = r + (1.0 - r) / (N * N) * bottom * float::exp(-s * slant);
    assert_mean(&estimate(&world, slanted(above, angle, -1.0), 2 * SAMPLES), expected, "from above");
}

#[test]
fn a_lamp_in_air_lights_a_patch_under_water() {
    let (h, depth, radius, radiance, albedo) = (0.8, 1.0, 1.5, 4.0, 0.5_f32);
    let from = DVec3::new(0.4, -0.3, 0.1);
    let mut kit = water(0.0);
    kit.matte("matte", albedo).surface("patch", disc(-depth, DVec3::Y, PATCH), "matte");
    kit.lamp("lamp", disc(h, -DVec3::Y, radius), radiance as f32).camera(from, from + DVec3::X);
    // The farthest ray: the lamp's edge is at depth × tan in water + h × tan in air.
    let reach = |cos_w: f64| {
        let tan = |cos: f64| (1.0 - cos * cos).sqrt() / cos;
        depth * tan(cos_w) + h * tan(refracted_cosine(cos_w, 1.0 / N))
    };
    let (mut out, mut within) = ((1.0 - 1.0 / (N * N)).sqrt() + 1e-12, 1.0);
    while within - out > 1e-14 {
        let middle = 0.5 * (out + within);
        if reach(middle) < radius { within = middle } else { out = middle }
    }
    let light = |c: f64| N * N * radiance * (1.0 - reflected(c, 1.0 / N)) * c;
    let irradiance = 2.0 * PI * integrate(light, within, 1.0, 64);
    let expected = f64::from(albedo) * irradiance / PI;
    let view = ray(from, DVec3::Y * -depth - from);
    assert_mean(&estimate(&kit.world(), view, 2 * SAMPLES), expected, "lamp in air, camera in water");

    // The same patch from the air, past the lamp: Snell's law backwards from the patch.
    let sin_w = float::sin(0.7);
    let cos_a = refracted_cosine((1.0 - sin_w * sin_w).sqrt(), 1.0 / N);
    let sin_a = N * sin_w;
    let at_surface = DVec3::X * (depth * sin_w / (1.0 - sin_w * sin_w).sqrt());
    let from = at_surface + DVec3::new(sin_a, cos_a, 0.0) * 0.5;
    kit.camera(from, from + DVec3::X);
    // The lamp is mirrored in the surface, too.
    assert!((at_surface.x - sin_a / cos_a * h).abs() < radius);
    let r = reflected(cos_a, N);
    let expected = r * radiance + expected * (1.0 - r) / (N * N);
    let view = ray(from, at_surface - from);
    assert_mean(&estimate(&kit.world(), view, 2 * SAMPLES), expected, "lamp in air, camera in air");
}

#[test]
fn a_lamp_under_water_lights_a_patch_seen_from_the_air() {
    let (h, radius, radiance, albedo, sigma) = (0.5, 0.3, 7.0, 0.9_f32, 0.4_f32);
    let mut kit = water(sigma);
    kit.matte("matte", albedo).surface("patch", disc(-1.0, DVec3::Y, PATCH), "matte");
    kit.lamp("lamp", disc(-1.0 + h, -DVec3::Y, radius), radiance as f32);
    // Straight through the water, each ray filtered on its own length.
    let nearest = h / (h * h + radius * radius).sqrt();
    let light = |c: f64| radiance * float::exp(-f64::from(sigma) * h / c) * c;
    let irradiance = 2.0 * PI * integrate(light, nearest, 1.0, 32);
    // From the air past the lamp: 45° in water, 70.5° in air.
    let sin_w = 0.5_f64.sqrt();
    let (sin_a, cos_a) = (N * sin_w, refracted_cosine(sin_w, 1.0 / N));
    let from = DVec3::X + DVec3::new(sin_a, cos_a, 0.0) * 0.8;
    kit.camera(from, from + DVec3::X);
    let leaving = f64::from(albedo) * irradiance / PI;
    let passage = float::exp(-f64::from(sigma) * 2.0_f64.sqrt()) * (1.0 - reflected(cos_a, N)) / (N * N);
    let view = ray(from, DVec3::X - from);
    assert_mean(&estimate(&kit.world(), view, SAMPLES), leaving * passage, "lamp in water, camera in air");
}

#[test]
fn a_shining_bottom_lights_a_patch_in_the_air() {
    let (radiance, albedo) = (3.0, 0.8_f32);
    let mut kit = water(0.0);
    kit.lamp("bottom", floor(-1.0, WIDE), radiance as f32);
    kit.matte("matte", albedo).surface("patch", disc(0.6, -DVec3::Y, PATCH), "matte");
    // What leaves the water upwards: π L / n² less the reflections, which are those of the same rays from outside.
    let irradiance = PI * radiance / (N * N) * (1.0 - reflected_from_outside(N));
    let leaving = f64::from(albedo) * irradiance / PI;

    let in_air = DVec3::new(0.3, 0.2, 0.0);
    kit.camera(in_air, in_air + DVec3::X);
    let view = ray(in_air, DVec3::Y * 0.6 - in_air);
    assert_mean(&estimate(&kit.world(), view, SAMPLES), leaving, "camera in air");

    let in_water = DVec3::new(0.0, -0.5, 0.0);
    kit.camera(in_water, in_water + DVec3::X);
    let r = reflected(1.0, N);
    let expected = (1.0 - r) * N * N * leaving + r * radiance;
    assert_mean(&estimate(&kit.world(), slanted(in_water, 0.0, 1.0), SAMPLES), expected, "camera in water");
}
