//! Light that is scattered again and again: integrating spheres and matte furnaces, against geometric series.

mod by_hand;
mod following;
mod scene_kit;

use following::ray;
use hyaline_math::{DVec3, Vec3};
use hyaline_scene::*;
use scene_kit::*;
use std::f64::consts::PI;

const SAMPLES: u32 = 40_000;

/// A closed matte ball about the origin, and the camera within.
fn hollow(albedo: f32, radius: f64, camera: DVec3) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.camera(camera, camera + DVec3::X).matte("matte", albedo).surface(
        "wall",
        sphere(DVec3::ZERO, radius),
        "matte",
    );
    kit
}

#[test]
fn indirect_light_in_an_integrating_sphere_is_uniform() {
    let (radius, flux) = (2.0, 40.0);
    // Off the center, so that direct light is not uniform.
    let lamp = DVec3::new(0.3, 1.1, -0.4);
    let camera = DVec3::new(-0.5, 0.2, 0.7);
    for albedo in [0.3_f32, 0.8] {
        let mut kit = hollow(albedo, radius, camera);
        kit.light(LightKind::Point { position: lamp, intensity: [(flux / (4.0 * PI)) as f32; 3] });
        let world = kit.world();
        let rho = f64::from(albedo);
        let mean_direct = flux / (4.0 * PI * radius * radius);
        let indirect = rho * mean_direct / (1.0 - rho);
        for target in
            [DVec3::X, DVec3::Y, -DVec3::Z, DVec3::new(-0.6, -0.8, 0.0), DVec3::new(0.48, 0.6, -0.64)]
        {
            let p = target * radius;
            let to_lamp = lamp - p;
            let cos = to_lamp.normalize().dot(-target);
            let direct = flux / (4.0 * PI) * cos / to_lamp.length_squared();
            let expected = rho / PI * (direct + indirect);
            assert_mean(
                &estimate(&world, ray(camera, p - camera), SAMPLES),
                expected,
                &format!("{albedo} at {target}"),
            );
        }
    }
}

#[test]
fn a_sphere_whose_wall_shines_and_scatters_sums_its_own_light() {
    let (albedo, radiance) = (0.6_f32, 2.0);
    let camera = DVec3::new(0.4, -0.3, 0.2);
    let mut kit = hollow(albedo, 1.0, camera);
    kit.description.objects[0].emission = Some(Emission {
        color: [radiance; 3],
        quantity: EmissionQuantity::Radiance,
        two_sided: true,
        visible_to_camera: true,
        texture: None,
        medium: None,
    });
    let world = kit.world();
    let expected = f64::from(radiance) / (1.0 - f64::from(albedo));
    for direction in [DVec3::X, DVec3::new(-0.3, 0.5, 0.9), -DVec3::Y] {
        assert_mean(&estimate(&world, ray(camera, direction), SAMPLES), expected, "shining wall");
    }
}

#[test]
fn white_matte_things_vanish_in_a_uniform_sky() {
    let color = || ColorSource::Constant([1.0; 3]);
    let open_box = |kit: &mut SceneKit| {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        kit.surface("bottom", rectangle(-y, x, z), "white");
        for (name, n, u) in [("left", -x, z), ("right", x, z), ("back", -z, x)] {
            kit.surface(name, rectangle(n, u, y), "white");
        }
    };
    type Build<'a> = &'a dyn Fn(&mut SceneKit);
    let scenes: [(&str, Build); 4] = [
        ("ball", &|kit| {
            kit.surface("ball", sphere(DVec3::ZERO, 0.8), "white");
        }),
        ("mesh", &|kit| {
            // Flat: no finish that obeys reciprocity keeps all light where normals are bent.
            let ShapeDescription::Mesh { mesh, .. } = ball_mesh(Vec3::ZERO, 0.8, 8) else { unreachable!() };
            kit.surface("mesh", ShapeDescription::Mesh { mesh, flat: true }, "white");
        }),
        ("open box", &open_box),
        ("ball in an open box", &|kit| {
            open_box(kit);
            kit.surface("ball", sphere(DVec3::new(0.1, -0.5, 0.0), 0.5), "white");
        }),
    ];
    for (what, build) in scenes {
        let mut kit = SceneKit::new();
        kit.sky(1.0).camera(DVec3::new(0.5, 1.0, 5.0), DVec3::ZERO);
        kit.material("white", MaterialKind::Matte { reflectance: color() });
        build(&mut kit);
        let world = kit.world();
        let from = DVec3::new(0.5, 1.0, 5.0);
        for target in [DVec3::ZERO, DVec3::new(0.3, -0.4, 0.0), DVec3::new(-0.5, -0.3, 0.2)] {
            assert_mean(&estimate(&world, ray(from, target - from), SAMPLES), 1.0, what);
        }
    }
}

#[test]
fn a_gray_surface_in_a_uniform_sky_shows_its_albedo() {
    for albedo in [0.0_f32, 0.25, 0.9] {
        let mut kit = SceneKit::new();
        kit.sky(1.0).camera(DVec3::Z * 4.0, DVec3::ZERO).matte("gray", albedo);
        kit.surface("ball", sphere(DVec3::ZERO, 1.0), "gray");
        let view = ray(DVec3::new(0.3, 0.4, 4.0), -DVec3::Z);
        assert_mean(&estimate(&kit.world(), view, SAMPLES), f64::from(albedo), "gray ball");
    }
}
