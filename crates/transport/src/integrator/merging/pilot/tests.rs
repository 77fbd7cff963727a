//! Photons find small things, and wherever they are sent the picture keeps its mean.

use super::super::scene_kit::{SceneKit, floor, rectangle, sphere, walls};
use super::*;
use crate::photon::PhotonEmitter;
use hyaline_math::DVec3;
use hyaline_scene::{PixelFilter as FilterDescription, ProjectionMaps, Techniques};
use hyaline_testkit::{Moments, Random, welch_t};
use hyaline_world::camera::PixelFilter;
use std::collections::HashSet;

const SIZE: u32 = 32;

fn view() -> View {
    View { camera: 0, width: SIZE, height: SIZE, filter: PixelFilter::new(&FilterDescription::Box) }
}

/// A small glass ball on a large floor under the sky; a thousandth of the area of all.
fn ball_under_the_sky() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.medium("glass", 1.5).matte("matte", 0.5).sky(1.0);
    kit.surface("floor", floor(0.0, 10.0), "matte");
    kit.solid("ball", sphere(DVec3::Y * 0.2, 0.178), "glass");
    kit.camera(DVec3::new(0.0, 1.2, 2.0), DVec3::ZERO);
    kit
}

/// A glass ball in a closed room with a hole in its ceiling, through which the sky looks in.
fn ball_in_a_room_with_a_hole() -> SceneKit {
    let mut kit = ball_under_the_sky();
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    for (name, center, half_u, half_v) in [
        ("left", -x, y, z),
        ("right", x, y, z),
        ("back", -z, x, y),
        ("front", z * 2.5, x, y),
        ("ceiling, left", y - x * 0.55, x * 0.45, z * 3.0),
        ("ceiling, right", y + x * 0.55, x * 0.45, z * 3.0),
        ("ceiling, front", y + z * 1.6, x, z * 1.5),
        ("ceiling, back", y - z * 1.6, x, z * 1.5),
    ] {
        kit.surface(name, rectangle(center, half_u, half_v), "matte");
    }
    kit.camera(DVec3::new(0.0, 0.6, 2.0), DVec3::Y * 0.2);
    kit
}

/// Distinct photons of the aimed sender that paths merge, over all that it sends; and the mean of each pass.
fn merged(world: &World, senders: &Senders<'_>, passes: u32) -> (f64, Moments) {
    merged_within(world, senders, passes, 1.0)
}

/// The same with a radius as of pixels so many times as wide.
fn merged_within(world: &World, senders: &Senders<'_>, passes: u32, scale: f32) -> (f64, Moments) {
    merged_by(Techniques::default(), world, senders, passes, scale)
}

/// The same with some techniques.
fn merged_by(
    techniques: Techniques,
    world: &World,
    senders: &Senders<'_>,
    passes: u32,
    scale: f32,
) -> (f64, Moments) {
    let (view, mut stats) = (view(), Stats::default());
    let settings = RenderSettings { seed: 11, techniques, ..RenderSettings::default() };
    let mut pilot =
        Pilot { world, view: &view, settings, size: [SIZE; 2], scale, light: None, stats: &mut stats };
    let (mut found, mut means) = (0, Moments::new());
    for pass in 0..passes {
        let picture = pilot.take(senders, pass);
        means.push(f64::from(mean(&picture.light)));
        let all = picture.found.iter().flatten().map(|merged| merged.photon);
        found += all.filter(|photon| photon.is_aimed()).map(PhotonId::number).collect::<HashSet<_>>().len();
    }
    (found as f64 / f64::from(passes * senders.aimed.count), means)
}

fn assert_same_mean(a: &Moments, b: &Moments, what: &str) {
    let p = welch_t(a.mean(), a.variance_of_mean(), a.count(), b.mean(), b.variance_of_mean(), b.count());
    assert!(p > 1e-3, "{what}: {} and {}, p = {p}", a.mean(), b.mean());
}

/// Senders as `teach` leaves them, broad ones included.
fn taught<'w>(world: &'w World, senders: Senders<'w>) -> Senders<'w> {
    let (mut senders, view) = (senders, view());
    let settings = RenderSettings { seed: 3, ..RenderSettings::default() };
    teach(world, &view, &settings, &mut senders, &mut Stats::default());
    senders.send(SIZE * SIZE, true);
    senders
}

#[test]
fn a_small_glass_ball_under_the_sky_is_found() {
    let world = ball_under_the_sky().world();
    let mut unguided = Senders::new(&world, &view(), Techniques::default());
    unguided.aimed.emitter = PhotonEmitter::new(&world, ProjectionMaps::None, 1);
    unguided.send(SIZE * SIZE, true);
    let guided = taught(&world, Senders::new(&world, &view(), Techniques::default()));
    let (rare, mean) = merged(&world, &unguided, 400);
    let (common, same_mean) = merged(&world, &guided, 100);
    assert!(rare > 0.0 && common > 50.0 * rare, "{rare} unguided, {common} guided");
    assert_same_mean(&mean, &same_mean, "ball under the sky");
}

#[test]
fn light_that_comes_through_a_hole_is_learned() {
    let world = ball_in_a_room_with_a_hole().world();
    let aimed = Senders::new(&world, &view(), Techniques::default());
    let guided = taught(&world, Senders::new(&world, &view(), Techniques::default()));
    let (rare, mean) = merged(&world, &aimed, 200);
    let (common, same_mean) = merged(&world, &guided, 200);
    assert!(common > 3.0 * rare, "{rare} aimed, {common} guided");
    assert_same_mean(&mean, &same_mean, "ball in a room");
}

#[test]
fn a_senseless_guide_keeps_the_mean() {
    let world = ball_in_a_room_with_a_hole().world();
    let senseless = |seed| {
        let mut random = Random::from_seed(seed);
        let mut found = || Found {
            numbers: std::array::from_fn(|_| random.uniform_f32().powi(3)),
            worth: random.uniform_f32().powi(4),
        };
        Guide::learn(&(0..5000).map(|_| found()).collect::<Vec<_>>(), LEAST_GAIN)
    };
    let aimed = Senders::new(&world, &view(), Techniques::default());
    let mut misled = Senders::new(&world, &view(), Techniques::default());
    (misled.aimed.guide, misled.broad.guide) = (senseless(1), senseless(2));
    assert_ne!(misled.aimed.guide, Guide::default());
    let (_, mean) = merged(&world, &aimed, 300);
    let (_, same_mean) = merged(&world, &misled, 300);
    assert_same_mean(&mean, &same_mean, "senseless guide");
}

#[test]
fn broad_photons_are_left_away_where_they_bring_nothing() {
    let broad = |kit: &SceneKit| {
        let world = kit.world();
        let (mut senders, view) = (Senders::new(&world, &view(), Techniques::default()), view());
        teach(&world, &view, &RenderSettings::default(), &mut senders, &mut Stats::default());
        senders.broad.count
    };
    let mut plain = SceneKit::new();
    plain.matte("matte", 0.5).sky(1.0).surface("floor", floor(0.0, 2.0), "matte");
    plain.surface("ball", sphere(DVec3::Y * 0.4, 0.4), "matte");
    plain.camera(DVec3::new(0.0, 1.2, 3.0), DVec3::ZERO);
    assert_eq!(broad(&plain), 0);
    // A lamp that shines at a wall nearby: most light comes from a small bright spot.
    let mut spot = SceneKit::new();
    spot.matte("matte", 0.8);
    walls(&mut spot);
    spot.lamp("lamp", rectangle(DVec3::new(0.0, 0.95, 0.0), DVec3::X * 0.03, -DVec3::Z * 0.03), 100.0);
    spot.camera(DVec3::new(0.0, 0.0, 0.9), DVec3::ZERO);
    assert!(broad(&spot) > 0);
}

#[test]
fn corners_are_not_dark() {
    // The foot of a wall, which the bright floor lights: the disc that photons are gathered from is wider than what is seen.
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.5);
    walls(&mut kit);
    kit.lamp("lamp", rectangle(DVec3::Y * -0.5, DVec3::X * 0.3, DVec3::Z * 0.3), 10.0);
    kit.camera(DVec3::new(0.0, -0.935, -0.8), DVec3::new(0.0, -0.935, -1.0));
    let world = kit.world();
    let senders = Senders::new(&world, &view(), Techniques::default());
    let (_, wide) = merged_within(&world, &senders, 40, 8.0);
    let (_, narrow) = merged_within(&world, &senders, 100, 0.1);
    // The disc's blur up the wall stays; the floor's photons on the wall would take away a ninth.
    assert!((wide.mean() / narrow.mean() - 1.0).abs() < 0.04, "{} and {}", wide.mean(), narrow.mean());
}

#[test]
fn open_edges_are_not_dark() {
    // A plate in a ball of thin glass under an even sky, seen along its edge: nothing lies beyond that could tell that the
    // disc reaches over. Photons alone bring the light, and it is even.
    let (ior, albedo) = (1.05, 0.5);
    let mut kit = SceneKit::new();
    kit.medium("thin glass", ior).matte("matte", albedo).sky(1.0);
    kit.solid("ball", sphere(DVec3::ZERO, 0.5), "thin glass");
    kit.surface("plate", rectangle(DVec3::ZERO, DVec3::X * 0.2, DVec3::Z * 0.2), "matte");
    kit.camera(DVec3::new(0.165, -0.1, 0.0), DVec3::X * 0.165);
    let world = kit.world();
    let techniques = Techniques { hits: false, ..Techniques::default() };
    let senders = Senders::new(&world, &view(), techniques);
    let (_, wide) = merged_by(techniques, &world, &senders, 400, 16.0);
    let expected = f64::from(albedo) * ior * ior;
    assert!((wide.mean() / expected - 1.0).abs() < 0.02, "{} is not {expected}", wide.mean());
}
