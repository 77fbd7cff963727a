//! Each way to find light, alone: what the others are weighed against it for, it does by itself where it can.

mod pictures;
mod scene_kit;

use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::{RenderSettings, Stats};
use hyaline_world::World;
use pictures::{Shot, assert_same, known_to};
use scene_kit::*;
use std::cell::RefCell;
use std::ops::Range;

/// Passes so late that blur is small.
const LATE: Range<u32> = 62_500..62_508;
/// Relative error of a difference above which nothing would be shown.
const POWER: f64 = 0.008;

/// Mean of a picture by some of the ways, for as many seeds as that takes; different ways draw different numbers.
fn means(world: &World, techniques: Techniques, first_seed: u64) -> Moments {
    means_of("merging", world, techniques, first_seed)
}

fn means_of(integrator: &str, world: &World, techniques: Techniques, first_seed: u64) -> Moments {
    known_to(0.7 * POWER, first_seed, |seed| {
        let settings = RenderSettings { seed, techniques, ..settings() };
        Shot { world, integrator, settings, size: (16, 16) }.mean(LATE)
    })
}

/// Fails unless the picture is the same in the mean without each of these ways.
fn assert_same_without(world: &World, ways: &[(&str, Techniques)], what: &str) {
    let whole = means(world, Techniques::default(), 0);
    for (index, (name, techniques)) in ways.iter().enumerate() {
        let part = means(world, *techniques, 1000 * (index as u64 + 1));
        assert_same(&whole, &part, POWER, &format!("{what}, without {name}"));
    }
}

/// A lamp that paths hit often, so that each way alone is good enough to be tested.
fn large_lamp(kit: &mut SceneKit) {
    kit.lamp("lamp", sphere(DVec3::new(-0.6, 0.9, 0.3), 0.6), 1.0);
}

/// A ball of ground glass and one of polished, so that all three ways meet: at the ground one lamps are sampled, hit and
/// merged.
fn ground_and_polished(lamp: impl FnOnce(&mut SceneKit)) -> SceneKit {
    let mut kit = hollow(lamp);
    let white = || ColorSource::Constant([1.0; 3]);
    let ground =
        MaterialKind::Dielectric { roughness: ScalarSource::Constant(0.4), tint: (white(), white()) };
    kit.material("ground", ground);
    let boundary = BoundaryDescription::Solid { medium: "glass".into() };
    kit.object("frosted", sphere(DVec3::new(-0.6, -0.5, -0.9), 0.5), boundary, "ground");
    kit
}

#[test]
fn lamps_are_found_as_well_without_hits_samples_or_photons() {
    let world = ground_and_polished(large_lamp).world();
    let ways = [
        ("hits", Techniques { hits: false, ..Techniques::default() }),
        ("samples", Techniques { sampling: false, ..Techniques::default() }),
        ("photons", Techniques { merging: false, ..Techniques::default() }),
        ("hits and photons", Techniques { hits: false, merging: false, ..Techniques::default() }),
    ];
    assert_same_without(&world, &ways, "lamp");
}

#[test]
fn of_faint_reflections_one_stands_for_all() {
    // A glass of water close by, in a room that the lamps in it light: `path` draws one of the ways on which they are seen.
    let mut kit = hollow(|kit| {
        for x in [-0.7, 0.0, 0.7] {
            kit.lamp(&format!("lamp {x}"), sphere(DVec3::new(x, 0.9, 0.9), 0.25), 4.0);
        }
    });
    kit.medium("water", 1.333);
    let glass = tumbler(RimKind::Round, &[("water", 0.75, 0.001)], 8.0);
    kit.object("tumbler", glass, BoundaryDescription::None, "dielectric");
    kit.camera(DVec3::new(0.0, 0.5, 1.4), DVec3::new(0.0, 0.35, 0.0));
    let world = kit.world();
    let counted = RefCell::new(Stats::default());
    let means = |techniques, first_seed| {
        known_to(0.7 * POWER, first_seed, |seed| {
            let settings = RenderSettings { seed, techniques, ..settings() };
            let shot = Shot { world: &world, integrator: "path", settings, size: (16, 16) };
            shot.mean_counted(LATE, &mut counted.borrow_mut())
        })
    };
    let whole = means(Techniques::default(), 0);
    let unsplit = means(Techniques { splitting: false, ..Techniques::default() }, 1000);
    assert_same(&whole, &unsplit, POWER, "faint reflections");
    // In the cusp where the water climbs the glass a ray may start beyond the next surface: hardly ever.
    let Stats { rays, never_entered, .. } = counted.into_inner();
    let astray: u64 = never_entered.values().sum();
    println!("{astray} of {rays} rays started beyond the next surface");
    assert!(astray * 1_000_000 <= rays, "{astray} of {rays} rays started beyond the next surface");
    // In an even field nothing is left to chance but what each way carries.
    let mut furnace = SceneKit::new();
    furnace.medium("glass", 1.5).solid("ball", sphere(DVec3::ZERO, 1.0), "glass");
    furnace.medium("water", 1.333).solid("drop", sphere(DVec3::ZERO, 0.7), "water");
    furnace.sky(1.0).camera(DVec3::Z * 3.0, DVec3::ZERO);
    let mean = means_of("path", &furnace.world(), Techniques::default(), 0);
    let error = mean.variance_of_mean().sqrt();
    println!("{} ± {error}", mean.mean());
    assert!((mean.mean() - 1.0).abs() < 3.0 * error + 1e-4, "{} ± {error}", mean.mean());
}

#[test]
fn the_sky_is_found_as_well_without_hits_samples_or_photons() {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.6).surface("floor", floor(-0.6, 3.0), "matte");
    kit.medium("glass", 1.5).solid("ball", sphere(DVec3::new(0.0, 0.0, -0.4), 0.5), "glass");
    kit.sky(1.0).camera(DVec3::new(0.0, 0.8, 2.0), DVec3::new(0.0, -0.4, -0.3));
    let ways = [
        ("hits", Techniques { hits: false, ..Techniques::default() }),
        ("samples", Techniques { sampling: false, ..Techniques::default() }),
        ("photons", Techniques { merging: false, ..Techniques::default() }),
    ];
    assert_same_without(&kit.world(), &ways, "sky");
}

#[test]
fn points_are_found_by_photons_alone_behind_ground_glass() {
    let kit = ground_and_polished(|kit| {
        kit.light(LightKind::Point { position: DVec3::new(-0.6, 0.9, 0.3), intensity: [2.0; 3] });
    });
    let ways = [("samples", Techniques { sampling: false, ..Techniques::default() })];
    assert_same_without(&kit.world(), &ways, "point");
}

#[test]
fn in_fog_each_way_finds_the_lamp() {
    let mut kit = hollow(large_lamp);
    let scattering = Scattering { sigma_s: [0.3; 3], phase: PhaseDescription::from_mean_cosine(0.4) };
    let fog = MediumDescription {
        absorption: Absorption::SigmaA([0.05; 3]),
        scattering: Some(scattering),
        ..MediumDescription::clear("fog", IndexDescription::Constant(1.0))
    };
    kit.description.media.push(fog.into());
    kit.description.surrounding = Some("fog".into());
    let ways = [
        ("hits", Techniques { hits: false, ..Techniques::default() }),
        ("samples", Techniques { sampling: false, ..Techniques::default() }),
        ("photons", Techniques { merging: false, ..Techniques::default() }),
    ];
    assert_same_without(&kit.world(), &ways, "fog");
}
