//! Photons as they leave the lights: the flux that lands on a specular ball is the same with every projection map, and
//! what closed forms say; only the number of photons that miss differs.

mod scene_kit;

use hyaline_math::{DVec3, Transform, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scene::*;
use hyaline_testkit::{Moments, chi_square_square, integrate_rectangle, sidak, welch_t, z_test};
use hyaline_transport::photon::emission::start_numbers;
use hyaline_transport::photon::{PhotonEmitter, PhotonStart};
use hyaline_world::World;
use scene_kit::{SceneKit, ball_mesh, floor, rectangle, sphere};
use std::f64::consts::PI;
use std::sync::Arc;

const RADIUS: f64 = 0.5;
const CELLS: u32 = 24;
const ALL_MAPS: [ProjectionMaps; 3] = [ProjectionMaps::None, ProjectionMaps::Cells, ProjectionMaps::Objects];

/// A matte floor and, at the origin, a ball of glass.
fn stage() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.camera(DVec3::new(0.0, 1.0, 5.0), DVec3::ZERO);
    kit.matte("gray", 0.5).surface("floor", floor(-1.0, 3.0), "gray");
    kit.medium("glass", 1.5).solid("ball", sphere(DVec3::ZERO, RADIUS), "glass");
    kit
}

fn start(emitter: &PhotonEmitter, number: u32) -> Option<PhotonStart> {
    emitter.emit_from(start_numbers(&mut Sampler::new(SamplerKind::Independent, 7, (number, 1), 0)))
}

fn hits_ball(photon: &PhotonStart, center: DVec3, radius: f64) -> bool {
    let to_center = center - photon.ray.origin.as_dvec3();
    let along = to_center.dot(photon.ray.direction.as_dvec3());
    let miss2 = to_center.length_squared() - along * along;
    miss2 < radius * radius && (along > 0.0 || to_center.length() < radius)
}

/// Flux that lands on a ball, over `count` photons.
fn landing_on(world: &World, maps: ProjectionMaps, count: u32, center: DVec3, radius: f64) -> Moments {
    let emitter = PhotonEmitter::new(world, maps, CELLS);
    let flux = |number| match start(&emitter, number) {
        Some(photon) if hits_ball(&photon, center, radius) => f64::from(photon.flux.mean(world.lanes)),
        _ => 0.0,
    };
    (0..count).map(flux).collect()
}

fn landing(world: &World, maps: ProjectionMaps, count: u32) -> Moments {
    landing_on(world, maps, count, DVec3::ZERO, RADIUS)
}

fn assert_value(moments: &Moments, expected: f64, what: &str) {
    let (difference, error) = (moments.mean() - expected, moments.variance_of_mean().sqrt());
    let agrees = difference.abs() < 1e-4 * expected || z_test(difference, error) > 1e-3;
    assert!(agrees, "{what}: {} ± {error}, expected {expected}", moments.mean());
}

fn point(position: DVec3) -> LightKind {
    LightKind::Point { position, intensity: [2.0; 3] }
}

fn spot(falloff: SpotFalloff, outer_angle: f64, inner_angle: f64) -> LightKind {
    let position = DVec3::new(0.4, 2.0, 0.3);
    let direction = DVec3::new(-0.3, -2.0, -0.1);
    LightKind::Spot { position, direction, intensity: [2.0; 3], outer_angle, inner_angle, falloff }
}

fn sun() -> LightKind {
    LightKind::Directional { direction: DVec3::new(0.3, -1.0, 0.2), irradiance: [1.5; 3] }
}

fn with_light(kind: LightKind) -> SceneKit {
    let mut kit = stage();
    kit.light(kind);
    kit
}

fn image_sky() -> SceneKit {
    let mut kit = stage();
    let pixels = (0..40 * 20).map(|i| {
        let (x, y) = (i % 40, i / 40);
        let base = ((x * 7 + y * 3) % 5) as f32 * 0.2;
        [if (x, y) == (31, 4) { 50.0 } else { base }; 3]
    });
    let image = ImageData { width: 40, height: 20, pixels: pixels.collect() };
    let texture = TextureDescription::new("sky", TextureKind::Image(Arc::new(image)));
    kit.description.textures.push(texture.into());
    kit.light(LightKind::Environment {
        radiance: [1.0; 3],
        image: Some("sky".into()),
        placement: Transform::rotate(DVec3::new(1.0, 2.0, -0.5), 0.8).unwrap(),
        visible_to_camera: true,
    });
    kit
}

fn lamp(shape: ShapeDescription, two_sided: bool, placement: Transform) -> SceneKit {
    let mut kit = stage();
    kit.lamp("lamp", shape, 3.0);
    let object = kit.description.objects.last_mut().unwrap();
    object.placement = Transform::translate(DVec3::new(0.7, 1.6, -0.4)).after(&placement);
    object.emission.as_mut().unwrap().two_sided = two_sided;
    kit
}

fn lamps() -> Vec<(&'static str, SceneKit)> {
    let turn = Transform::rotate(DVec3::new(1.0, 0.3, -0.6), 2.0).unwrap();
    let uneven = turn.after(&Transform::scale(DVec3::new(1.0, 0.5, 0.8)).unwrap());
    let square = || rectangle(DVec3::ZERO, DVec3::X * 0.6, DVec3::Z * 0.4);
    let disc =
        ShapeDescription::Disc { center: DVec3::ZERO, normal: -DVec3::Y, radius: 0.5, inner_radius: 0.1 };
    let tube = ShapeDescription::Cylinder { radius: 0.1, y: [-0.7, 0.7], phi: [0.4, 5.0], capped: false };
    let torus = ShapeDescription::Torus {
        major_radius: 0.5,
        minor_radius: 0.2,
        phi: [0.0, 2.0 * PI],
        theta: [0.0, 2.0 * PI],
    };
    let cone = ShapeDescription::Cone { radius: 0.3, height: 0.5, capped: true };
    let part =
        ShapeDescription::Sphere { center: DVec3::ZERO, radius: 0.4, phi: [1.0, 4.0], theta: [0.5, 2.5] };
    let one = Transform::IDENTITY;
    vec![
        ("rectangle", lamp(square(), false, one)),
        ("two-sided rectangle", lamp(square(), true, turn)),
        ("sphere", lamp(sphere(DVec3::ZERO, 0.3), false, turn)),
        ("two-sided sphere", lamp(sphere(DVec3::ZERO, 0.3), true, turn)),
        ("ellipsoid", lamp(sphere(DVec3::ZERO, 0.4), false, uneven)),
        ("disc", lamp(disc, false, one)),
        ("tube", lamp(tube, true, uneven)),
        ("cone", lamp(cone, false, turn)),
        ("torus", lamp(torus, false, turn)),
        ("part of a sphere", lamp(part, true, turn)),
        ("mesh", lamp(ball_mesh(Vec3::ZERO, 0.3, 8), false, uneven)),
    ]
}

fn bare_lights() -> Vec<(&'static str, SceneKit)> {
    use SpotFalloff::{LinearInAngle, Smooth};
    let mut sky = stage();
    sky.sky(0.7);
    let mut projector = stage();
    let pixels = (0..8 * 6).map(|i| [0.1 + (i % 5) as f32; 3]).collect();
    let image = ImageData { width: 8, height: 6, pixels };
    projector
        .description
        .textures
        .push(TextureDescription::new("s", TextureKind::Image(Arc::new(image))).into());
    projector.light(LightKind::Projector {
        placement: Transform::look_at(DVec3::new(0.4, 2.0, 0.3), DVec3::new(0.2, 0.0, 0.0), DVec3::Z)
            .unwrap(),
        fov: 1.2,
        image: Some("s".into()),
        irradiance: [2.0; 3],
    });
    vec![
        ("projector", projector),
        ("point", with_light(point(DVec3::new(0.4, 2.0, 0.3)))),
        ("wide spot", with_light(spot(Smooth, 1.2, 0.3))),
        ("narrow spot", with_light(spot(LinearInAngle, 0.2, 0.1))),
        ("directional", with_light(sun())),
        ("constant sky", sky),
        ("image sky", image_sky()),
    ]
}

#[test]
fn the_same_flux_lands_on_a_ball_with_every_projection() {
    let kinds: Vec<(&str, SceneKit)> = bare_lights().into_iter().chain(lamps()).collect();
    let level = sidak(1e-3, 2 * kinds.len());
    for (name, kit) in kinds {
        let world = kit.world();
        let [all, cells, objects] = ALL_MAPS.map(|maps| landing(&world, maps, 60_000));
        for (maps, aimed) in [("cells", cells), ("objects", objects)] {
            assert!(aimed.variance() < 1.05 * all.variance(), "{name} {maps}: more noise than without");
            let n = all.count();
            let p_value =
                welch_t(all.mean(), all.variance_of_mean(), n, aimed.mean(), aimed.variance_of_mean(), n);
            assert!(p_value > level, "{name} {maps}: {} for {}, p {p_value}", aimed.mean(), all.mean());
        }
    }
}

#[test]
fn the_flux_on_the_ball_is_that_of_the_closed_forms() {
    let place = DVec3::new(0.4, 2.0, 0.3);
    let sine2 = RADIUS * RADIUS / place.length_squared();
    let from_point = 4.0 * PI * 2.0 * 0.5 * (1.0 - (1.0 - sine2).sqrt());
    let from_sun = 1.5 * PI * RADIUS * RADIUS;
    let from_sky = 4.0 * PI * RADIUS * RADIUS * PI * 0.7;
    // Of a small piece of the lamp the ball takes (R/d)² cos θ of the flux.
    let per_area = |x: f64, z: f64| {
        let p = DVec3::new(x, 1.6, z);
        PI * 3.0 * RADIUS * RADIUS * p.y / p.length().powi(3)
    };
    let from_lamp = integrate_rectangle(per_area, [0.1, 1.3], [-0.8, 0.0], 8, 8);
    let mut sky = stage();
    sky.sky(0.7);
    let down = rectangle(DVec3::ZERO, DVec3::X * 0.6, DVec3::Z * 0.4);
    let cases = [
        ("point", with_light(point(place)), from_point),
        ("directional", with_light(sun()), from_sun),
        ("constant sky", sky, from_sky),
        ("rectangle", lamp(down, false, Transform::IDENTITY), from_lamp),
    ];
    for (name, kit, expected) in cases {
        for maps in ALL_MAPS {
            assert_value(&landing(&kit.world(), maps, 100_000), expected, &format!("{name} {maps:?}"));
        }
    }
}

#[test]
fn a_small_ball_at_the_edge_of_the_scene_gets_its_light_from_the_sky_and_the_sun() {
    let (center, radius) = (DVec3::new(2.6, 0.4, -2.4), 0.15);
    let mut kit = SceneKit::new();
    kit.matte("gray", 0.5).surface("floor", floor(-1.0, 3.0), "gray");
    kit.medium("glass", 1.5).solid("ball", sphere(center, radius), "glass");
    let (mut sky, mut lit) = (kit.clone(), kit);
    sky.sky(0.7);
    lit.light(sun());
    for maps in [ProjectionMaps::Cells, ProjectionMaps::Objects] {
        let from_sky = landing_on(&sky.world(), maps, 100_000, center, radius);
        assert_value(&from_sky, 4.0 * PI * radius * radius * PI * 0.7, "sky");
        let from_sun = landing_on(&lit.world(), maps, 100_000, center, radius);
        assert_value(&from_sun, 1.5 * PI * radius * radius, "sun");
    }
}

#[test]
fn a_small_ball_right_under_a_large_lamp_gets_all_of_its_light() {
    let (center, radius) = (DVec3::new(0.3, -0.08, 0.2), 0.03);
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).solid("ball", sphere(center, radius), "glass");
    kit.lamp("lamp", rectangle(DVec3::ZERO, DVec3::X * 3.0, DVec3::Z * 3.0), 2.0);
    let per_area = |x: f64, z: f64| {
        let to_ball = center - DVec3::new(x, 0.0, z);
        PI * 2.0 * radius * radius * -to_ball.y / to_ball.length().powi(3)
    };
    let expected = integrate_rectangle(per_area, [-3.0, 3.0], [-3.0, 3.0], 400, 400);
    let moments = landing_on(&kit.world(), ProjectionMaps::Cells, 100_000, center, radius);
    assert_value(&moments, expected, "lamp");
}

#[test]
fn photons_that_are_aimed_are_fewer_by_the_fraction_and_all_alike() {
    let mut sky = stage();
    sky.sky(0.7);
    let mut three = with_light(sun());
    three.light(point(DVec3::new(0.4, 2.0, 0.3))).light(point(DVec3::new(-3.0, 0.2, 0.3)));
    for (kit, most) in [(sky, 0.06), (three, 0.04), (lamps().swap_remove(0).1, 0.2)] {
        let world = kit.world();
        let emitter = PhotonEmitter::new(&world, ProjectionMaps::Cells, 64);
        let powers = world.lights.lights().iter().map(|light| f64::from(light.power().mean(world.lanes)));
        let emitted = powers.sum::<f64>() * f64::from(emitter.fraction());
        assert!(emitter.fraction() > 0.0 && emitter.fraction() < most, "{}", emitter.fraction());
        let mut hits = 0;
        for number in 0..4000 {
            let photon = start(&emitter, number).unwrap();
            assert!((f64::from(photon.flux.mean(world.lanes)) / emitted - 1.0).abs() < 1e-3);
            hits += u32::from(hits_ball(&photon, DVec3::ZERO, RADIUS));
        }
        // Cells at the ball's outline are a yes as a whole.
        assert!(hits > 1200, "{hits} of 4000 photons hit what they are aimed at");
    }
}

#[test]
fn with_nothing_specular_nothing_is_emitted() {
    let mut kit = SceneKit::new();
    kit.matte("gray", 0.5).surface("floor", floor(-1.0, 3.0), "gray").sky(1.0).light(sun());
    kit.lamp("lamp", sphere(DVec3::Y, 0.2), 2.0);
    let world = kit.world();
    for maps in [ProjectionMaps::Cells, ProjectionMaps::Objects] {
        let emitter = PhotonEmitter::new(&world, maps, CELLS);
        assert_eq!(emitter.fraction(), 0.0);
        assert!((0..100).all(|number| start(&emitter, number).is_none()));
    }
    assert_eq!(PhotonEmitter::new(&world, ProjectionMaps::None, CELLS).fraction(), 1.0);
}

#[test]
fn a_light_within_a_specular_object_sends_out_everything() {
    for light in [point(DVec3::new(0.1, 0.0, 0.1)), point(DVec3::ZERO)] {
        let world = with_light(light).world();
        for maps in ALL_MAPS {
            assert_eq!(PhotonEmitter::new(&world, maps, CELLS).fraction(), 1.0, "{maps:?}");
            assert_value(&landing(&world, maps, 2000), 8.0 * PI, "within");
        }
    }
}

#[test]
fn a_lamp_sends_nothing_to_what_lies_behind_it_unless_both_its_sides_shine() {
    // Its normal points up and the ball is below.
    let up = || rectangle(DVec3::ZERO, DVec3::Z * 0.4, DVec3::X * 0.6);
    let level = Transform::IDENTITY;
    for maps in [ProjectionMaps::Cells, ProjectionMaps::Objects] {
        let one_sided = lamp(up(), false, level).world();
        let emitter = PhotonEmitter::new(&one_sided, maps, 64);
        assert_eq!(emitter.fraction(), 0.0);
        assert!(start(&emitter, 0).is_none());
        let two_sided = lamp(up(), true, level).world();
        let fraction = f64::from(PhotonEmitter::new(&two_sided, maps, 64).fraction());
        let down = lamp(rectangle(DVec3::ZERO, DVec3::X * 0.6, DVec3::Z * 0.4), false, level).world();
        let one_side = f64::from(PhotonEmitter::new(&down, maps, 32).fraction());
        assert!((fraction / one_side - 0.5).abs() < 0.1, "{fraction} of both sides, {one_side} of one");
    }
}

#[test]
fn objects_that_overlap_are_counted_once() {
    // The second ball hides a half of the first, the third is the first again.
    let extra = DVec3::new(0.4, 0.0, 0.0);
    let add = |kit: &mut SceneKit| {
        kit.solid("second", sphere(extra, RADIUS), "glass").solid(
            "third",
            sphere(DVec3::ZERO, RADIUS),
            "glass",
        );
    };
    for (light, name) in [(point(DVec3::new(0.1, 2.0, 0.3)), "point"), (sun(), "sun")] {
        let alone = with_light(light.clone()).world();
        let mut kit = with_light(light);
        add(&mut kit);
        let world = kit.world();
        let expected = landing(&alone, ProjectionMaps::Objects, 40_000).mean();
        let first = landing(&world, ProjectionMaps::Objects, 150_000);
        assert!((first.mean() / expected - 1.0).abs() < 0.02, "{name}: {} for {expected}", first.mean());
        let second = landing_on(&world, ProjectionMaps::Objects, 150_000, extra, RADIUS);
        let all = landing_on(&world, ProjectionMaps::None, 400_000, extra, RADIUS);
        let error = (all.variance_of_mean() + second.variance_of_mean()).sqrt();
        assert!(z_test(all.mean() - second.mean(), error) > 1e-3, "{name}: {}", second.mean());
    }
}

#[test]
fn a_mirror_plate_is_aimed_at_but_for_its_matte_faces() {
    // Half of the plate is specular; the light is high above it, so that half the plate's solid angle is kept.
    let mut kit = SceneKit::new();
    let white = ColorSource::Constant([0.9; 3]);
    kit.material("mirror", MaterialKind::PerfectSpecular { reflectance: white }).matte("gray", 0.5);
    let corner = |x: f32, z: f32| [x, 0.0, z];
    let mesh = MeshData {
        positions: vec![
            corner(-1.0, -1.0),
            corner(-1.0, 1.0),
            corner(0.0, 1.0),
            corner(0.0, -1.0),
            corner(1.0, 1.0),
            corner(1.0, -1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3], [3, 2, 4], [3, 4, 5]],
        face_slots: vec![0, 0, 1, 1],
        slots: vec!["shiny".into(), "dull".into()],
        ..MeshData::default()
    };
    kit.surface("plate", ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: true }, "gray");
    kit.description.objects[0].slot_materials = vec![("shiny".into(), "mirror".into())];
    kit.light(LightKind::Directional { direction: -DVec3::Y, irradiance: [1.0; 3] });
    let world = kit.world();
    let emitter = PhotonEmitter::new(&world, ProjectionMaps::Cells, 128);
    let share = f64::from(emitter.fraction());
    let scene = PI * 2.0; // A disc about the plate's corners.
    assert!(share > 2.0 / scene && share < 3.6 / scene, "{share}");
}

#[test]
fn directions_of_yes_cells_are_uniform_within_them() {
    let world = with_light(point(DVec3::new(0.0, 2.0, 0.0))).world();
    let emitter = PhotonEmitter::new(&world, ProjectionMaps::Cells, CELLS);
    let sine2 = RADIUS * RADIUS / 4.0;
    let versine = 1.0 - (1.0 - sine2).sqrt();
    let mut number = 0;
    // All directions to the ball are in yes cells, so within its cone they are uniform.
    let sample = || loop {
        number += 1;
        let direction = start(&emitter, number).unwrap().ray.direction.as_dvec3();
        let u = (1.0 + direction.y) / versine;
        if u < 1.0 {
            let azimuth = hyaline_math::float::f64::atan2(direction.z, direction.x) / (2.0 * PI) + 0.5;
            return [u.max(0.0), azimuth.clamp(0.0, 1.0)];
        }
    };
    let result = chi_square_square(sample, |_| 1.0, 60_000, 12, 24);
    assert!(result.p_value > 1e-3, "{result:?}");
}

#[test]
fn a_lamp_of_many_faces_and_a_sky_keep_their_maps_small() {
    let mut kit = stage();
    kit.sky(1.0);
    kit.lamp("lamp", ball_mesh(Vec3::new(0.0, 3.0, 0.0), 0.3, 40), 3.0);
    let emitter_memory = PhotonEmitter::new(&kit.world(), ProjectionMaps::Cells, 64).memory();
    assert!(emitter_memory < 4 << 20, "{emitter_memory} bytes");
}
