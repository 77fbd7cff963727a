//! A matte plane under each kind of light, as the camera sees it, against closed forms of irradiance.

mod by_hand;
mod following;
mod scene_kit;

use by_hand::below_corner;
use following::ray;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::*;
use hyaline_testkit::integrate;
use scene_kit::*;
use std::f64::consts::PI;
use std::sync::Arc;

const ALBEDO: f32 = 0.7;
const SAMPLES: u32 = 40_000;

/// A matte square of the plane y = 0, 20 wide.
fn plane() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.matte("matte", ALBEDO).surface("plane", floor(0.0, 10.0), "matte");
    kit
}

/// Fails unless the plane at `p` is lit with `irradiance`; its radiance is albedo × irradiance / π.
fn assert_lit(kit: &SceneKit, p: DVec3, irradiance: f64, what: &str) {
    let mut kit = kit.clone();
    // Slanted, so that no lamp above is in the way.
    let from = p + DVec3::new(6.0, 1.0, 0.0);
    kit.camera(from, p);
    let moments = estimate(&kit.world(), ray(from, p - from), SAMPLES);
    assert_mean(&moments, f64::from(ALBEDO) * irradiance / PI, &format!("{what} at {p}"));
}

fn disc(center: DVec3, normal: DVec3, radius: f64) -> ShapeDescription {
    ShapeDescription::Disc { center, normal, radius, inner_radius: 0.0 }
}

/// The square of `rectangle` as two triangles.
fn square_mesh(center: DVec3, half_u: DVec3, half_v: DVec3) -> ShapeDescription {
    let corner = |a: f64, b: f64| (center + half_u * a + half_v * b).as_vec3().to_array();
    let positions = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mesh = MeshData { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..MeshData::default() };
    ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: false }
}

#[test]
fn a_point_light_lights_by_the_cube_of_the_cosine() {
    let (flux, h) = (30.0, 1.5);
    let mut kit = plane();
    let intensity = [(flux / (4.0 * PI)) as f32; 3];
    kit.light(LightKind::Point { position: DVec3::Y * h, intensity });
    for x in [0.0, 0.3, 1.0, 4.0] {
        let cos = h / (h * h + x * x).sqrt();
        assert_lit(&kit, DVec3::X * x, flux * cos.powi(3) / (4.0 * PI * h * h), "point");
    }
}

#[test]
fn lights_add_up() {
    let mut kit = plane();
    for (x, intensity) in [(-1.0, 1.0), (0.5, 10.0), (2.0, 0.1)] {
        kit.light(LightKind::Point { position: DVec3::new(x, 1.0, 0.0), intensity: [intensity; 3] });
    }
    kit.lamp("lamp", disc(DVec3::Y * 2.0, -DVec3::Y, 0.5), 3.0);
    let points = [(-1.0_f64, 1.0), (0.5, 10.0), (2.0, 0.1)].map(|(x, i)| i / (1.0 + x * x).sqrt().powi(3));
    let lamp = PI * 3.0 * 0.25 / (0.25 + 4.0);
    assert_lit(&kit, DVec3::ZERO, points.iter().sum::<f64>() + lamp, "three points and a disc");
}

#[test]
fn a_disc_lights_a_point_on_its_axis() {
    let (radiance, radius) = (5.0, 0.7);
    for h in [0.15, 0.3, 1.0, 8.0] {
        let mut kit = plane();
        kit.lamp("lamp", disc(DVec3::Y * h, -DVec3::Y, radius), radiance as f32);
        assert_lit(&kit, DVec3::ZERO, PI * radiance * radius * radius / (radius * radius + h * h), "disc");
        let ring = ShapeDescription::Disc {
            center: DVec3::Y * h,
            normal: -DVec3::Y,
            radius,
            inner_radius: 0.5 * radius,
        };
        let mut kit = plane();
        kit.lamp("ring", ring, radiance as f32);
        let covered = |a: f64| a * a / (a * a + h * h);
        assert_lit(&kit, DVec3::ZERO, PI * radiance * (covered(radius) - covered(0.5 * radius)), "annulus");
    }
}

#[test]
fn a_rectangle_lights_by_its_form_factor_as_shape_and_as_mesh() {
    let (half_x, half_z, radiance) = (0.8, 0.5, 4.0);
    for h in [0.2, 0.6, 3.0] {
        // X × Z points down.
        let (center, u, v) = (DVec3::Y * h, DVec3::X * half_x, DVec3::Z * half_z);
        for (shape, what) in [(rectangle(center, u, v), "rectangle"), (square_mesh(center, u, v), "mesh")] {
            let mut kit = plane();
            kit.lamp("lamp", shape, radiance as f32);
            let at_center = 4.0 * below_corner(half_x, half_z, h);
            let at_corner = below_corner(2.0 * half_x, 2.0 * half_z, h);
            assert_lit(&kit, DVec3::ZERO, radiance * at_center, what);
            assert_lit(&kit, DVec3::new(half_x, 0.0, half_z), radiance * at_corner, what);
            // Beside it, the difference of two rectangles with their corner at the point, twice.
            let beside = 2.0 * (below_corner(3.0 * half_x, half_z, h) - below_corner(half_x, half_z, h));
            assert_lit(&kit, DVec3::X * (2.0 * half_x), radiance * beside, what);
        }
    }
}

#[test]
fn a_sphere_lights_as_a_disc_that_hides_it() {
    let (radius, radiance) = (0.4, 6.0);
    let center = DVec3::Y * 0.9;
    let mut solid = plane();
    solid.lamp("lamp", sphere(center, radius), radiance as f32);
    for x in [0.0, 0.5, 2.0] {
        let p = DVec3::X * x;
        let d = (center - p).length();
        let cos = center.y / d;
        // The whole sphere is above the horizon of the plane.
        assert_lit(&solid, p, PI * radiance * (radius / d).powi(2) * cos, "sphere");
    }
}

#[test]
fn a_ball_of_triangles_lights_nearly_as_a_sphere() {
    let (radius, radiance, h) = (0.4, 6.0, 0.9);
    let mut kit = plane();
    kit.lamp("lamp", ball_mesh((DVec3::Y * h).as_vec3(), radius as f32, 160), radiance as f32);
    let from = DVec3::new(6.0, 1.0, 0.0);
    kit.camera(from, DVec3::ZERO);
    let moments = estimate(&kit.world(), ray(from, -from), SAMPLES);
    let expected = f64::from(ALBEDO) * radiance * (radius / h).powi(2);
    // The inscribed faces hide π² / 6 / 160² of the disc at most twice over.
    let allowed = 4.0 * moments.variance_of_mean().sqrt() + 2e-4 * expected;
    assert!((moments.mean() - expected).abs() < allowed, "{} for {expected}", moments.mean());
}

#[test]
fn a_spot_lights_fully_inside_partly_between_and_not_at_all_outside_its_angles() {
    let (h, inner, outer) = (2.0, 0.3, 0.6);
    let light = |falloff| LightKind::Spot {
        position: DVec3::Y * h,
        direction: -DVec3::Y * 3.0,
        intensity: [12.0; 3],
        outer_angle: outer,
        inner_angle: inner,
        falloff,
    };
    for (falloff, what) in [(SpotFalloff::Smooth, "smooth spot"), (SpotFalloff::LinearInAngle, "linear spot")]
    {
        let mut kit = plane();
        kit.light(light(falloff));
        for angle in [0.0, 0.2, 0.29, 0.4, 0.5, 0.59, 0.61, 1.2] {
            let cos = float::cos(angle);
            let in_cosine = (cos - float::cos(outer)) / (float::cos(inner) - float::cos(outer));
            let factor: f64 = match falloff {
                SpotFalloff::Smooth => {
                    let t = in_cosine.clamp(0.0, 1.0);
                    t * t * (3.0 - 2.0 * t)
                }
                SpotFalloff::LinearInAngle => ((outer - angle) / (outer - inner)).clamp(0.0, 1.0),
            };
            let p = DVec3::X * h * float::tan(angle);
            assert_lit(&kit, p, 12.0 * factor * cos.powi(3) / (h * h), what);
        }
    }
}

#[test]
fn parallel_light_lights_by_the_cosine() {
    for degrees in [0.0_f64, 30.0, 60.0, 85.0] {
        let (sin, cos) = float::sin_cos(degrees.to_radians());
        let mut kit = plane();
        let direction = DVec3::new(0.0, -cos, sin) * 7.0;
        kit.light(LightKind::Directional { direction, irradiance: [2.5; 3] });
        assert_lit(&kit, DVec3::new(1.0, 0.0, -2.0), 2.5 * cos, "directional");
    }
}

#[test]
fn a_constant_sky_lights_with_pi_times_its_radiance() {
    let mut kit = plane();
    kit.sky(1.7);
    assert_lit(&kit, DVec3::ZERO, PI * f64::from(1.7_f32), "sky");
}

#[test]
fn an_image_of_the_sky_lights_as_its_integral_does() {
    // Two rows: bright above, dark below; between their centers, 45° up and down, radiance goes linearly with the angle.
    let image = ImageData {
        width: 4,
        height: 2,
        pixels: [[3.0; 3], [1.0; 3]].into_iter().flat_map(|row| [row; 4]).collect(),
    };
    let mut kit = plane();
    let sky = TextureDescription::new("sky", TextureKind::Image(Arc::new(image)));
    kit.description.textures.push(sky.into());
    kit.light(LightKind::Environment {
        radiance: [2.0; 3],
        image: Some("sky".into()),
        placement: Transform::IDENTITY,
        visible_to_camera: true,
    });
    let radiance = |theta: f64| 2.0 * (3.0 - 2.0 * (theta / (0.5 * PI) - 0.5).clamp(0.0, 1.0));
    let lambert = |theta: f64| radiance(theta) * float::sin(theta) * float::cos(theta);
    let irradiance =
        2.0 * PI * (integrate(lambert, 0.0, 0.25 * PI, 8) + integrate(lambert, 0.25 * PI, 0.5 * PI, 8));
    assert_lit(&kit, DVec3::ZERO, irradiance, "image of the sky");
}

#[test]
fn a_lamp_of_a_given_power_has_that_power_over_pi_and_area_as_radiance() {
    let r = 0.3;
    let shapes = [
        (sphere(DVec3::ZERO, r), 4.0 * PI * r * r, "sphere"),
        (disc(DVec3::ZERO, DVec3::Z, r), PI * r * r, "disc"),
        (rectangle(DVec3::ZERO, DVec3::X * r, DVec3::Y * r), 4.0 * r * r, "rectangle"),
        (
            cuboid(DVec3::splat(-r), DVec3::new(r, 2.0 * r, r)),
            4.0 * 3.0 * 2.0 * r * r + 2.0 * 4.0 * r * r,
            "box",
        ),
        (square_mesh(DVec3::ZERO, DVec3::X * r, DVec3::Y * r), 4.0 * r * r, "mesh"),
    ];
    for (shape, area, what) in shapes {
        for two_sided in [false, true] {
            let mut kit = SceneKit::new();
            kit.lamp("lamp", shape.clone(), 0.0);
            let emission = kit.description.objects[0].emission.as_mut().unwrap();
            *emission = Emission {
                color: [8.0, 4.0, 2.0],
                quantity: EmissionQuantity::Power,
                two_sided,
                visible_to_camera: true,
                texture: None,
                medium: None,
            };
            kit.camera(DVec3::Z * 3.0, DVec3::ZERO);
            let moments = estimate(&kit.world(), ray(DVec3::new(0.05, 0.02, 3.0), -DVec3::Z), 2);
            let sides = if two_sided { 2.0 } else { 1.0 };
            assert_mean(&moments, 14.0 / 3.0 / (PI * area * sides), what);
        }
    }
}
