//! Finishes that are chosen ray by ray, and relief, as integrators see them.

mod following;
mod pictures;
mod scene_kit;

use following::{Way, follow, ray};
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::Stats;
use hyaline_transport::walk::{self, Event};
use hyaline_world::{World, mask};
use pictures::{Shot, assert_same_picture};
use scene_kit::*;
use std::f64::consts::PI;
use std::sync::Arc;

const WIDE: f64 = 50.0;

fn color(c: f32) -> ColorSource {
    ColorSource::Constant([c; 3])
}

fn number(x: f32) -> ScalarSource {
    ScalarSource::Constant(x)
}

fn blend(first: &str, second: &str, weight: f32) -> MaterialKind {
    MaterialKind::Blend { first: first.into(), second: second.into(), weight: number(weight) }
}

/// Adds a material that is `edit`ed after it is made.
fn edited(kit: &mut SceneKit, name: &str, kind: MaterialKind, edit: impl Fn(&mut MaterialDescription)) {
    let mut material = MaterialDescription::new(name, kind);
    edit(&mut material);
    kit.description.materials.push(material.into());
}

/// Samples along `count` rays from about `from` towards about `to`, no two alike: what is chosen ray by ray has its
/// mean only over many rays.
fn spread(world: &World, from: DVec3, to: DVec3, count: u32) -> Moments {
    let samples = (0..count).map(|i| {
        let aside = DVec3::new(float::cos(f64::from(i)), 0.3 * float::sin(f64::from(i)), 0.5) * 1e-3;
        let ray = ray(from + aside, to - from);
        f64::from(sample(world, ray, world.camera_media[0].clone(), i))
    });
    samples.collect()
}

/// What is seen of a floor at the origin from obliquely above, below `roof` at height 0.5.
fn floor_below(kit: &SceneKit, roof: Option<&str>, floor_finish: &str, count: u32) -> Moments {
    let mut kit = kit.clone();
    kit.surface("floor", floor(0.0, 2.0), floor_finish);
    if let Some(finish) = roof {
        kit.surface("roof", floor(0.5, WIDE), finish);
    }
    let from = DVec3::new(0.3, 0.3, 0.0);
    kit.camera(from, DVec3::ZERO);
    spread(&kit.world(), from, DVec3::ZERO, count)
}

#[test]
fn a_blend_has_the_mean_of_its_parts_however_it_is_nested() {
    let mut kit = SceneKit::new();
    kit.sky(1.0).matte("light", 0.8).matte("dim", 0.2).matte("middle", 0.5);
    kit.material("two", blend("light", "dim", 0.25)).material("three", blend("two", "middle", 0.4));
    for (finish, expected) in [("two", 0.65), ("three", 0.6 * 0.65 + 0.4 * 0.5)] {
        assert_mean(&floor_below(&kit, None, finish, 40_000), expected, finish);
    }
}

#[test]
fn a_veil_lets_its_share_of_light_through_for_shadow_rays_and_paths() {
    let bare = |kit: &SceneKit| floor_below(kit, None, "gray", 40_000);
    let mut veils = SceneKit::new();
    veils.matte("gray", 0.5).material("nothing", MaterialKind::PassThrough);
    veils.material("mixed", blend("black", "nothing", 0.7));
    edited(&mut veils, "holed", MaterialKind::Black, |m| m.opacity = number(0.3));
    // Half of it has holes of half its area, the other half is not there at all.
    edited(&mut veils, "half", MaterialKind::Black, |m| m.opacity = number(0.6));
    veils.material("both", blend("half", "nothing", 0.5));
    let mut lamp = veils.clone();
    lamp.lamp("lamp", rectangle(DVec3::Y, DVec3::X * 0.6, DVec3::Z * 0.6), 2.0);
    let mut point = veils.clone();
    point.light(LightKind::Point { position: DVec3::Y * 1.5, intensity: [2.0; 3] });
    let mut sky = veils.clone();
    sky.sky(1.0);
    for (kit, what) in [(&lamp, "lamp"), (&point, "point light"), (&sky, "sky")] {
        let open = bare(kit);
        for veil in ["mixed", "holed", "both"] {
            let veiled = floor_below(kit, Some(veil), "gray", 40_000);
            let error = (veiled.variance_of_mean() + 0.49 * open.variance_of_mean()).sqrt();
            let (got, want) = (veiled.mean(), 0.7 * open.mean());
            assert!(error < 0.02 * want, "{what}, {veil}: nothing to compare");
            assert!((got - want).abs() < 4.0 * error + 1e-5, "{what}, {veil}: {got} for {want}");
        }
    }
    // The mean over the holes is taken exactly by shadow rays.
    let veiled = floor_below(&point, Some("holed"), "gray", 100);
    assert!(veiled.variance() < 1e-6 * veiled.mean() * veiled.mean());
}

#[test]
fn the_eye_sees_through_holes_in_proportion() {
    let mut kit = SceneKit::new();
    edited(&mut kit, "holed", MaterialKind::Black, |m| m.opacity = number(0.3));
    kit.surface("veil", rectangle(-DVec3::Z, DVec3::X, DVec3::Y), "holed").sky(1.0);
    let world = kit.world();
    assert_mean(&spread(&world, DVec3::ZERO, -DVec3::Z, 20_000), 0.7, "veil before the sky");
    // Whoever asks again gets the same answer.
    let view = ray(DVec3::ZERO, -DVec3::Z);
    let first = sample(&world, view, world.camera_media[0].clone(), 0);
    assert!((1..100).all(|i| sample(&world, view, world.camera_media[0].clone(), i) == first));
}

#[test]
fn who_enters_a_body_through_a_hole_is_inside_it() {
    let sigma = 1.5;
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", 1.5, [sigma as f32; 3], 0).sky(1.0);
    edited(&mut kit, "holed", clear_dielectric(), |m| m.opacity = number(0.0));
    let ball = sphere(-DVec3::Z * 2.0, 0.6);
    kit.object("ball", ball, BoundaryDescription::Solid { medium: "glass".into() }, "holed");
    let seen = spread(&kit.world(), DVec3::ZERO, -DVec3::Z, 200);
    let expected = float::exp(-sigma * 1.2);
    assert!((seen.mean() - expected).abs() < 1e-4, "{} for {expected}", seen.mean());
}

/// A slab of glass whose front bears a label; of the two surfaces the one made first is met first.
fn labelled(ior: f64, sigma: f32, opacity: f32, label_first: bool) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", ior, [sigma; 3], 0);
    edited(&mut kit, "paper", MaterialKind::Black, |m| m.opacity = number(opacity));
    let (min, max) = (DVec3::new(-WIDE, -WIDE, -1.25), DVec3::new(WIDE, WIDE, -1.0));
    kit.solid("slab", cuboid(min, max), "glass");
    kit.surface("label", rectangle(-DVec3::Z, DVec3::X, DVec3::Y), "paper");
    if label_first {
        kit.description.objects.reverse();
    }
    kit
}

#[test]
fn a_label_with_holes_leaves_the_glass_behind_them_as_it_is() {
    for (opacity, label_first) in [0.0, 0.4, 1.0].into_iter().flat_map(|o| [(o, false), (o, true)]) {
        let mut kit = labelled(1.5, 1.0, opacity, label_first);
        kit.lamp("lamp", rectangle(-DVec3::Z * 20.0, DVec3::X * WIDE, DVec3::Y * WIDE), 1.0);
        let a = float::exp(-0.25);
        let passed = 0.96 * 0.96 * a / (1.0 - 0.0016 * a * a);
        let seen = spread(&kit.world(), DVec3::ZERO, -DVec3::Z, 40_000);
        // Behind the holes light may be thrown back to the label from within, too, and is lost there in part.
        let lost = 0.04 * 0.04 * a * a * f64::from(opacity);
        let expected = passed * f64::from(1.0 - opacity) * (1.0 - lost);
        assert_mean(&seen, expected, &format!("opacity {opacity}, {label_first}"));
    }
}

#[test]
fn shadow_rays_pass_the_holes_of_a_label_on_matched_glass() {
    let view = |opacity: f32, label_first: bool| {
        let mut kit = labelled(1.0, 1.0, opacity, label_first);
        kit.matte("gray", 0.5);
        kit.surface("wall", rectangle(-DVec3::Z * 2.0, DVec3::X * 0.1, DVec3::Y * 0.1), "gray");
        kit.light(LightKind::Point { position: DVec3::ZERO, intensity: [1.0; 3] });
        let from = DVec3::new(0.3, 0.0, -1.7);
        kit.camera(from, -DVec3::Z * 2.0);
        spread(&kit.world(), from, -DVec3::Z * 2.0, 4000)
    };
    for label_first in [false, true] {
        let open = view(0.0, label_first);
        // Roughly: the spread of rays sees the wall from a little aside.
        let expected = 0.5 / PI / 4.0 * float::exp(-0.25);
        assert!((open.mean() / expected - 1.0).abs() < 0.01, "{} for {expected}", open.mean());
        assert_mean(&view(0.4, label_first), 0.6 * open.mean(), "label with holes");
        assert_eq!(view(1.0, label_first).mean(), 0.0);
    }
}

#[test]
fn a_back_has_a_material_of_its_own() {
    let mut kit = SceneKit::new();
    kit.sky(1.0).matte("light", 0.8);
    edited(&mut kit, "front", MaterialKind::Matte { reflectance: color(0.2) }, |m| {
        m.back = Some("light".into())
    });
    kit.surface("sheet", floor(0.0, 1.0), "front");
    let world = kit.world();
    assert_mean(&spread(&world, DVec3::Y, DVec3::ZERO, 2000), 0.2, "front");
    assert_mean(&spread(&world, -DVec3::Y, DVec3::ZERO, 2000), 0.8, "back");
    // A part of a blend that works from one side does so in the blend, and a blend that does speaks for its parts.
    edited(&mut kit, "one-sided", MaterialKind::Matte { reflectance: color(0.6) }, |m| m.two_sided = false);
    kit.material("half", blend("light", "one-sided", 0.5));
    edited(&mut kit, "none", blend("light", "light", 0.5), |m| m.two_sided = false);
    for (finish, front, back) in [("half", 0.7, 0.4), ("none", 0.8, 0.0)] {
        kit.description.objects[0].value.material = finish.into();
        let world = kit.world();
        assert_mean(&spread(&world, DVec3::Y, DVec3::ZERO, 20_000), front, finish);
        assert_mean(&spread(&world, -DVec3::Y, DVec3::ZERO, 20_000), back, finish);
    }
}

#[test]
fn materials_that_are_made_of_themselves_are_refused() {
    let refused = |edit: fn(&mut SceneKit)| {
        let mut kit = SceneKit::new();
        kit.matte("plain", 0.5).sky(1.0);
        edit(&mut kit);
        World::compile(&kit.description).expect_err("refused").to_string()
    };
    let ring = refused(|kit| {
        kit.material("a", blend("plain", "b", 0.5)).material("b", blend("a", "plain", 0.5));
    });
    assert!(ring.contains("'a' is made of itself"), "{ring}");
    let own_back = refused(|kit| {
        edited(kit, "a", MaterialKind::Black, |m| m.back = Some("a".into()));
    });
    assert!(own_back.contains("made of itself"), "{own_back}");
    let missing = refused(|kit| {
        kit.material("a", blend("plain", "plane", 0.5));
    });
    assert!(missing.contains("did you mean 'plain'"), "{missing}");
    let deep = refused(|kit| {
        kit.material("m0", blend("plain", "plain", 0.5));
        for i in 1..20 {
            kit.material(&format!("m{i}"), blend(&format!("m{}", i - 1), "plain", 0.5));
        }
    });
    assert!(deep.contains("materials deep"), "{deep}");
    let glass_back = refused(|kit| {
        edited(kit, "a", MaterialKind::Black, |m| m.back = Some("dielectric".into()));
    });
    assert!(glass_back.contains("light passes"), "{glass_back}");
    let opacity = refused(|kit| edited(kit, "a", MaterialKind::Black, |m| m.opacity = number(1.5)));
    assert!(opacity.contains("opacity = 1.5"), "{opacity}");
}

/// A texture of one value everywhere.
fn plain_texture(kit: &mut SceneKit, name: &str, value: Rgb) {
    let image = ImageData { width: 1, height: 1, pixels: vec![value] };
    kit.description.textures.push(TextureDescription::new(name, TextureKind::Image(Arc::new(image))).into());
}

/// Fresnel's law for light that comes from the air.
fn mirrored_by_water(cos: f64) -> f64 {
    let bent = (1.0 - (1.0 - cos * cos) / (1.333 * 1.333)).sqrt();
    let across = (cos - 1.333 * bent) / (cos + 1.333 * bent);
    let along = (1.333 * cos - bent) / (1.333 * cos + bent);
    0.5 * (across * across + along * along)
}

#[test]
fn a_wavy_surface_of_water_refracts_about_its_waves() {
    let mut kit = SceneKit::new();
    kit.medium("water", 1.333).sky(1.0);
    // Along u, which is +z on this floor, the surface falls by half of 0.4; along v, +x, it rises by half of 0.6.
    plain_texture(&mut kit, "waves", [-0.4, 0.6, 0.0]);
    edited(&mut kit, "wavy", clear_dielectric(), |m| {
        m.relief = Some(Relief::Slopes { texture: "waves".into(), scale: 0.5 });
    });
    let boundary = BoundaryDescription::Interface { outside: None, inside: Some("water".into()) };
    kit.object("surface", floor(0.0, 10.0), boundary, "wavy").camera(DVec3::Y, DVec3::ZERO);
    let world = kit.world();
    let n = DVec3::new(-0.3, 1.0, 0.2).normalize();
    for aside in [DVec3::ZERO, DVec3::new(0.4, 0.0, -0.3), DVec3::new(-1.0, 0.0, 0.5)] {
        let (from, wo) = (DVec3::Y + aside, (DVec3::Y + aside).normalize());
        let view = ray(from, -wo);
        let bent = follow(&world, view, &[Way::Transmit]).expect("transmission").direction;
        // Snell's law: the tangential part shrinks by the index, and stays in the plane of incidence.
        let (along, bent_along) = (wo - n * n.dot(wo), bent - n * n.dot(bent));
        assert!((bent_along + along / 1.333).length() < 1e-5, "{aside}: {bent}");
        assert!(bent.dot(n) < 0.0);
        let mirrored = follow(&world, view, &[Way::Reflect]).expect("reflection").direction;
        assert!((mirrored - (2.0 * n.dot(wo) * n - wo)).length() < 1e-5);
        // The sky is 1 all around, within the water as well, where it should have been n².
        let share = mirrored_by_water(n.dot(wo));
        let want = share + (1.0 - share) / (1.333 * 1.333);
        for i in 0..20 {
            let seen = f64::from(sample(&world, view, world.camera_media[0].clone(), i));
            assert!((seen - want).abs() < 1e-4, "no light is lost: {seen}, not {want}");
        }
    }
}

#[test]
fn bumps_are_lit_as_the_slopes_they_are() {
    let ramp = |along_u: f32| {
        let pixels = (0..32).map(|i| [along_u * (i as f32 + 0.5) / 32.0; 3]).collect();
        TextureDescription::new(
            "ramp",
            TextureKind::Image(Arc::new(ImageData { width: 32, height: 1, pixels })),
        )
    };
    let mut kit = SceneKit::new();
    kit.description.textures.push(ramp(0.5).into());
    // The floor is 4 long along u, +z: heights that grow by 0.5 × 2 over it are a slope of 0.25.
    edited(&mut kit, "rough", MaterialKind::Matte { reflectance: color(0.6) }, |m| {
        m.relief = Some(Relief::Bump { height: "ramp".into(), scale: 2.0 });
    });
    kit.surface("floor", floor(0.0, 2.0), "rough").camera(DVec3::Y, DVec3::ZERO);
    let toward_light = DVec3::new(0.2, 1.0, 0.5).normalize();
    kit.light(LightKind::Directional { direction: -toward_light, irradiance: [3.0; 3] });
    let n = DVec3::new(0.0, 1.0, -0.25).normalize();
    let world = kit.world();
    let seen = estimate(&world, Ray::new(Vec3::Y, -Vec3::Y), 100);
    assert_mean(&seen, 0.6 / PI * 3.0 * n.dot(toward_light), "slope");
    // The layer of normals shows relief.
    let mut set = world.camera_media[0].clone();
    let view = Ray::new(Vec3::Y, -Vec3::Y);
    match walk::advance(&world, &view, mask::CAMERA, &mut set, &mut Stats::default()) {
        Event::Surface(vertex) => assert!((vertex.hit.n.as_dvec3() - n).length() < 1e-4),
        Event::Sky { .. } => panic!("the floor is there"),
    }
}

fn plastic(diffuse: f32, roughness: f32) -> MaterialKind {
    MaterialKind::Plastic {
        diffuse: color(diffuse),
        specular: color(1.0),
        ior: 1.5,
        roughness: number(roughness),
        nonlinear: true,
    }
}

#[test]
fn white_plastic_vanishes_in_a_white_sky() {
    let mut kit = SceneKit::new();
    kit.sky(1.0).material("plastic", plastic(1.0, 0.0));
    kit.surface("ball", sphere(-DVec3::Z * 2.0, 0.7), "plastic");
    let world = kit.world();
    for x in [0.0, 0.15, 0.3] {
        let seen = spread(&world, DVec3::ZERO, DVec3::new(x, 0.0, -1.0), 20_000);
        assert_mean(&seen, 1.0, &format!("x = {x}"));
    }
}

#[test]
fn whitted_and_path_see_the_same_plastic() {
    let mut kit = SceneKit::new();
    kit.material("plastic", plastic(0.5, 0.0));
    // Of a floor and lamps alone, so that there is no light that whitted leaves out.
    kit.surface("floor", floor(0.0, 3.0), "plastic");
    kit.lamp("lamp", rectangle(DVec3::new(0.0, 1.0, -1.5), DVec3::X * 0.7, DVec3::new(0.0, 0.3, 0.3)), 2.0);
    kit.light(LightKind::Point { position: DVec3::new(1.0, 2.0, 0.0), intensity: [2.0; 3] });
    kit.camera(DVec3::new(0.0, 1.0, 2.5), DVec3::new(0.0, 0.2, 0.0));
    let world = kit.world();
    let shot = |integrator| Shot { world: &world, integrator, settings: settings(), size: (16, 16) };
    let [path, whitted] = ["path", "whitted"].map(|name| shot(name).tiles(4, 0..150));
    assert_same_picture(&path, &whitted, 0.01, "plastic");
}
