//! The architect's glass: shadow rays pass it straight, and what they bring is not brought again by paths.

mod by_hand;
mod pictures;
mod scene_kit;

use by_hand::reflected;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Vec3};
use hyaline_scene::*;
use hyaline_testkit::{Moments, integrate, welch_t};
use hyaline_world::{World, mask};
use pictures::Shot;
use scene_kit::*;
use std::f64::consts::PI;

/// Reflectance of the receivers: so dark that what they send back does not matter.
const DARK: f32 = 0.01;

/// Finishes of a scene, once with straight shadows and once without.
fn with_straight_shadows(kit: &SceneKit, on: bool) -> World {
    let mut kit = kit.clone();
    for material in &mut kit.description.materials {
        material.value.straight_shadows = on && material.name.starts_with("clear");
    }
    kit.world()
}

fn thin(tint: Rgb) -> MaterialKind {
    MaterialKind::ThinDielectric { ior: 1.5, tint: ColorSource::Constant(tint) }
}

/// A dark receiver about the origin, its normal up, that sees what is above it; looked at from close by.
fn receiver() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.matte("dark", DARK).material("clear", clear_dielectric()).material("clear pane", thin([1.0; 3]));
    kit.surface("receiver", floor(0.0, 0.05), "dark");
    kit.camera(DVec3::new(0.0, 0.1, 0.0), DVec3::ZERO);
    kit
}

/// Irradiance of the receiver.
fn irradiance(world: &World, count: u32) -> Moments {
    let ray = Ray::new(Vec3::new(0.0, 0.1, 0.0), -Vec3::Y);
    let scale = PI / f64::from(DARK);
    let set = &world.camera_media[0];
    (0..count).map(|i| f64::from(sample(world, ray, set.clone(), i)) * scale).collect()
}

fn facing_down(center: DVec3, half: f64) -> ShapeDescription {
    rectangle(center, DVec3::X * half, DVec3::Z * half)
}

fn slab(low: f64, high: f64) -> ShapeDescription {
    cuboid(DVec3::new(-50.0, low, -50.0), DVec3::new(50.0, high, 50.0))
}

fn assert_alike(a: &Moments, b: &Moments, bias: f64, what: &str) {
    let p = welch_t(a.mean(), a.variance_of_mean(), a.count(), b.mean(), b.variance_of_mean(), b.count());
    let error = (a.variance_of_mean() + b.variance_of_mean()).sqrt();
    assert!(
        b.mean() > 0.0 && error < 0.04 * b.mean(),
        "{what}: an error of {error} in {} shows nothing",
        b.mean()
    );
    let off = (a.mean() - b.mean()).abs() / b.mean();
    assert!(p > 1e-3 || off < bias, "{what}: {} and {} ± {error} (p = {p})", a.mean(), b.mean());
}

#[test]
fn a_small_lamp_shines_through_a_pane_by_fresnel_twice_and_its_medium() {
    let (n, sigma, thickness) = (1.5, 2.0, 0.2);
    for x in [0.0, 0.8, 3.0] {
        let mut kit = receiver();
        kit.absorbing_medium("glass", n, [sigma as f32; 3], 0);
        kit.object(
            "pane",
            slab(0.4, 0.4 + thickness),
            BoundaryDescription::Solid { medium: "glass".into() },
            "clear",
        );
        kit.light(LightKind::Point { position: DVec3::new(x, 1.5, 0.0), intensity: [3.0; 3] });
        let distance = (x * x + 1.5 * 1.5_f64).sqrt();
        let cos = 1.5 / distance;
        let bare = 3.0 * cos / (distance * distance);
        let passed = (1.0 - reflected(cos, n)).powi(2) * float::exp(-sigma * thickness / cos);
        assert_mean(&irradiance(&with_straight_shadows(&kit, true), 500), bare * passed, &format!("x = {x}"));
        assert_eq!(irradiance(&with_straight_shadows(&kit, false), 500).mean(), 0.0, "glass without them");
    }
}

#[test]
fn whitted_lets_the_same_light_through() {
    let mut kit = receiver();
    kit.medium("glass", 1.5);
    kit.object("pane", slab(0.4, 0.6), BoundaryDescription::Solid { medium: "glass".into() }, "clear");
    kit.light(LightKind::Point { position: DVec3::new(0.0, 1.5, 0.0), intensity: [3.0; 3] });
    kit.description.cameras[0].projection = Projection::Orthographic { height: 1e-3 };
    (kit.description.film.width, kit.description.film.height) = (1, 1);
    let world = with_straight_shadows(&kit, true);
    let shot = Shot { world: &world, integrator: "whitted", settings: settings(), size: (1, 1) };
    let (seen, _) = shot.pixel(50);
    let expected = 3.0 / 2.25 * 0.96 * 0.96 * f64::from(DARK) / PI;
    assert!((seen.mean() / expected - 1.0).abs() < 1e-3, "{} for {expected}", seen.mean());
}

#[test]
fn a_receiver_inside_the_glass_gets_what_a_calm_surface_lets_in() {
    // Parallel light at 45 degrees on water: of E cos(45°) per area of the surface T gets in, and lands below.
    let mut kit = receiver();
    kit.medium("water", 1.333);
    kit.object("water", slab(-1.0, 0.5), BoundaryDescription::Solid { medium: "water".into() }, "clear");
    kit.light(LightKind::Directional { direction: DVec3::new(1.0, -1.0, 0.0), irradiance: [2.0; 3] });
    let cos = 0.5_f64.sqrt();
    let expected = 2.0 * cos * (1.0 - reflected(cos, 1.333));
    assert_mean(&irradiance(&with_straight_shadows(&kit, true), 200), expected, "below water");
}

#[test]
fn light_behind_a_pane_lights_the_room_with_and_without_straight_shadows() {
    // A disc of radius 0.8 at height 1, its light thinned by a thin pane at every angle.
    let mut kit = receiver();
    kit.surface("pane", slab_sheet(0.5), "clear pane");
    let disc = ShapeDescription::Disc { center: DVec3::Y, normal: -DVec3::Y, radius: 0.8, inner_radius: 0.0 };
    kit.lamp("lamp", disc, 2.0);
    let edge = 1.0 / (1.0 + 0.8 * 0.8_f64).sqrt();
    let passed = |c: f64| {
        let r = reflected(c, 1.5);
        c * (1.0 - r) / (1.0 + r)
    };
    let expected = 2.0 * 2.0 * PI * integrate(passed, edge, 1.0, 16);
    let [off, on] = [false, true].map(|on| irradiance(&with_straight_shadows(&kit, on), 40_000));
    assert_mean(&off, expected, "by hits");
    assert_mean(&on, expected, "by shadow rays");
    assert!(on.variance() < 0.1 * off.variance(), "they are there to calm the picture");
}

fn slab_sheet(height: f64) -> ShapeDescription {
    rectangle(DVec3::Y * height, DVec3::Z * 50.0, DVec3::X * 50.0)
}

#[test]
fn a_thick_pane_shifts_light_a_little_and_counts_none_of_it_twice() {
    let mut kit = receiver();
    kit.medium("glass", 1.5);
    kit.object("pane", slab(0.4, 0.42), BoundaryDescription::Solid { medium: "glass".into() }, "clear");
    kit.lamp("lamp", facing_down(DVec3::Y * 1.5, 0.7), 2.0);
    let [off, on] = [false, true].map(|on| irradiance(&with_straight_shadows(&kit, on), 60_000));
    assert_alike(&on, &off, 0.01, "thick pane");
}

/// A corner of thin panes, some full of holes, and lamps before, behind and beside them: light comes straight through
/// one pane and through two, is reflected by them, and does one after the other.
fn panes() -> SceneKit {
    let mut kit = receiver();
    let mut holed = MaterialDescription::new("clear holed", thin([0.9, 0.8, 0.7]));
    holed.opacity = ScalarSource::Constant(0.6);
    kit.description.materials.push(holed.into());
    kit.material("other glass", thin([1.0; 3])).matte("wall", 0.3);
    let upright = |x: f64| rectangle(DVec3::new(x, 1.0, 0.0), DVec3::Y * 0.95, DVec3::Z * 2.0);
    kit.surface("beside", upright(0.5), "clear pane");
    kit.surface("beyond", upright(-0.6), "clear holed");
    kit.surface("other", upright(-0.9), "other glass");
    kit.surface("above", facing_down(DVec3::Y * 0.6, 0.45), "clear pane");
    kit.surface("wall", rectangle(DVec3::new(2.5, 1.0, 0.0), -DVec3::Z * 2.0, DVec3::Y), "wall");
    kit.lamp("up", facing_down(DVec3::Y * 1.2, 0.4), 2.0);
    kit.lamp("right", rectangle(DVec3::new(1.2, 0.8, 0.0), DVec3::Y * 0.5, DVec3::Z * 0.5), 3.0);
    kit.lamp("left", rectangle(DVec3::new(-1.5, 0.6, 0.0), DVec3::Z * 0.6, DVec3::Y * 0.6), 4.0);
    // A lamp that is itself such a pane stops shadow rays, but no paths.
    kit.lamp("shining pane", upright(0.8), 0.2);
    kit.description.objects.last_mut().unwrap().material = "clear pane".into();
    kit
}

#[test]
fn thin_panes_light_receivers_alike_with_and_without_straight_shadows() {
    let mut sky = panes();
    sky.sky(0.5);
    for (kit, what) in [(panes(), "panes"), (sky, "panes under a sky")] {
        let [off, on] = [false, true].map(|on| irradiance(&with_straight_shadows(&kit, on), 100_000));
        assert_alike(&on, &off, 0.0, what);
    }
}

#[test]
fn the_eye_sees_through_glass_with_straight_shadows_as_through_any() {
    let mut kit = receiver();
    kit.medium("glass", 1.5);
    let ball = sphere(DVec3::new(0.0, 0.0, -2.0), 0.5);
    kit.object("ball", ball, BoundaryDescription::Solid { medium: "glass".into() }, "clear");
    kit.sky(1.0).camera(DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 0.0, -2.0));
    let world = with_straight_shadows(&kit, true);
    for x in [-0.3, 0.0, 0.2] {
        let ray = Ray::new(Vec3::Y, (Vec3::new(x, 0.1, -2.0) - Vec3::Y).normalize());
        assert_mean(&estimate(&world, ray, 200), 1.0, "a lossless ball in a white sky");
    }
}

#[test]
fn photon_maps_leave_straight_light_to_shadow_rays() {
    let mut kit = receiver();
    kit.surface("pane", slab_sheet(0.5), "clear pane");
    kit.lamp("lamp", facing_down(DVec3::Y * 1.5, 0.7), 2.0);
    let [off, on] = [false, true].map(|on| {
        let world = with_straight_shadows(&kit, on);
        let photon_map = PhotonMapSettings { caustic_photons: 2_000_000, ..PhotonMapSettings::default() };
        let settings = hyaline_transport::RenderSettings { photon_map, ..settings() };
        Shot { world: &world, integrator: "photon-map", settings, size: (1, 1) }.pixel(3000).0.mean()
    });
    // Few of the photons meet so small a receiver; counted twice, the light would be double.
    assert!((on / off - 1.0).abs() < 0.15, "{on} with straight shadows, {off} without");
}

#[test]
fn what_is_opaque_behind_the_glass_still_throws_its_shadow() {
    let mut kit = receiver();
    kit.surface("pane", slab_sheet(0.5), "clear pane");
    kit.light(LightKind::Point { position: DVec3::Y * 1.5, intensity: [3.0; 3] });
    kit.surface("plate", facing_down(DVec3::Y * 0.8, 0.1), "dark");
    let world = with_straight_shadows(&kit, true);
    assert_eq!(irradiance(&world, 100).mean(), 0.0);
    let blocks: Vec<bool> = world.geometry.items().iter().map(|item| item.mask & mask::BLOCKS != 0).collect();
    assert_eq!(blocks, [true, false, true], "receiver, pane, plate");
    assert!(world.has_permeable && !with_straight_shadows(&kit, false).has_permeable);
}

#[test]
fn rough_glass_has_no_straight_way_and_a_note_says_so() {
    let mut kit = receiver();
    let rough = MaterialKind::Dielectric {
        roughness: ScalarSource::Constant(0.3),
        tint: (ColorSource::Constant([1.0; 3]), ColorSource::Constant([1.0; 3])),
    };
    kit.material("clear ground glass", rough);
    for material in &mut kit.description.materials {
        material.value.straight_shadows = true;
    }
    let (world, notes) = World::compile(&kit.description).unwrap();
    let straight: Vec<bool> = world.materials.iter().map(|m| m.straight_shadows).collect();
    assert_eq!(
        straight,
        [true, false, false, true, true, false],
        "dielectric, black, dark, clear, pane, ground"
    );
    let ignored = notes.iter().filter(|note| note.message.contains("straight_shadows")).count();
    assert_eq!(ignored, 3);
}
