//! `merging` against `path`: where the radius is small the two are one, whatever the light has gone through.

mod fog_kit;
mod pictures;
mod scene_kit;

use fog_kit::{grid, uneven, volume};
use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_world::World;
use pictures::{Shot, assert_same, known_to, luminance};
use scene_kit::*;
use std::ops::Range;
use std::sync::Arc;

/// Relative error of the difference above which nothing would be shown.
const POWER: f64 = 0.006;
/// The same where few photons and few paths carry much of the light.
const POWER_UNDER_WATER: f64 = 0.009;
/// Passes so late that their radius is a fortieth of the first one's: with pixels as large as these, blur would carry
/// light across edges, out of the glass that it is in.
const LATE: Range<u32> = 4_000_000..4_000_024;

/// Mean of a picture over some passes, for as many seeds as it takes to know a difference of two to `power`.
fn means(world: &World, integrator: &str, passes: Range<u32>, power: f64) -> Moments {
    known_to(0.7 * power, 0, |seed| {
        let settings = RenderSettings { seed, ..settings() };
        Shot { world, integrator, settings, size: (8, 8) }.mean(passes.clone())
    })
}

fn assert_as_path(world: &World, power: f64, what: &str) {
    let (photons, paths) = (means(world, "merging", LATE, power), means(world, "path", 0..64, power));
    assert_same(&photons, &paths, power, what);
}

#[test]
fn a_lamp_seen_through_glass_counts_once() {
    assert_as_path(&hollow(lamp_ball).world(), POWER, "glass ball");
}

/// Adds finishes from polished to half matte: chains of them end at the wall or at each other.
fn add_rough(kit: &mut SceneKit, roughness: f32) {
    let white = || ColorSource::Constant([1.0; 3]);
    let roughness = ScalarSource::Constant(roughness);
    let glass = MaterialKind::Dielectric { roughness: roughness.clone(), tint: (white(), white()) };
    let metal = MaterialKind::Conductor { metal: Metal::Named("silver".into()), roughness, tint: white() };
    kit.material("rough", glass).material("metal", metal);
    let boundary = BoundaryDescription::Solid { medium: "glass".into() };
    kit.object("frosted", sphere(DVec3::new(-0.6, -0.5, -0.9), 0.5), boundary, "rough");
    kit.surface("ball", sphere(DVec3::new(0.2, 0.5, -1.0), 0.3), "metal");
}

#[test]
fn chains_of_rough_glass_and_metal_lose_and_double_no_light() {
    for roughness in [0.25, 0.45, 0.7] {
        let mut kit = hollow(lamp_ball);
        add_rough(&mut kit, roughness);
        assert_as_path(&kit.world(), POWER, &format!("roughness {roughness}"));
    }
}

#[test]
fn mirrors_throw_light_on_walls_and_through_glass() {
    let mut kit = hollow(lamp_ball);
    let white = || ColorSource::Constant([0.9; 3]);
    let polished = ScalarSource::Constant(0.0);
    let mirror =
        MaterialKind::Conductor { metal: Metal::Named("silver".into()), roughness: polished, tint: white() };
    kit.material("mirror", mirror);
    kit.surface("mirror ball", sphere(DVec3::new(-0.6, -0.5, -0.9), 0.5), "mirror");
    kit.surface(
        "mirror plate",
        rectangle(DVec3::new(0.2, -1.2, 0.0), DVec3::Z * 0.4, DVec3::X * 0.4),
        "mirror",
    );
    assert_as_path(&kit.world(), POWER, "mirrors");
}

#[test]
fn light_through_a_glass_of_water_counts_once() {
    // Walls, base, rim and water: bodies within bodies, of which each crossing knows what meets there.
    let mut kit = hollow(lamp_ball);
    kit.medium("water", 1.333);
    let glass = tumbler(RimKind::Round, &[("water", 0.75, 0.001)], 9.0);
    kit.object("tumbler", glass, BoundaryDescription::None, "dielectric");
    assert_as_path(&kit.world(), POWER, "glass of water");
}

#[test]
fn without_merging_samples_are_those_of_path() {
    let world = hollow(lamp_ball).world();
    let samples = |integrator, guiding| {
        let techniques = Techniques { merging: false, guiding, ..Techniques::default() };
        let settings = RenderSettings { techniques, ..settings() };
        let shot = Shot { world: &world, integrator, settings, size: (8, 8) };
        let mut all = Vec::new();
        let stats = shot.render(shot.full_frame(), 0..8, |_, samples| all.extend_from_slice(samples));
        (all, stats.photons)
    };
    for guiding in [true, false] {
        let (path, photons) = samples("path", guiding);
        assert!(path.iter().any(|sample| luminance(sample) > 0.0));
        // Photons teach where to aim; without that none are sent at all.
        assert_eq!(photons > 0, guiding);
        assert_eq!(samples("merging", guiding), (path, photons));
    }
}

#[test]
fn a_varnished_wall_reflects_caustics_and_receives_them() {
    let mut kit = hollow(lamp_ball);
    let plastic = MaterialKind::Plastic {
        diffuse: ColorSource::Constant([0.5; 3]),
        specular: ColorSource::Constant([1.0; 3]),
        ior: 1.5,
        roughness: ScalarSource::Constant(0.0),
        nonlinear: false,
    };
    kit.material("varnish", plastic);
    kit.surface("board", rectangle(DVec3::new(0.0, -1.2, -0.6), DVec3::Z, DVec3::X), "varnish");
    assert_as_path(&kit.world(), POWER, "varnish");
}

#[test]
fn under_water_radiance_and_photons_agree() {
    // Camera and matte plane on one side of the surface, the lamp on the other; and the reverse.
    for (camera, plane, lamp) in [(-0.2, -1.0, 0.8), (0.2, 1.0, -0.8), (0.4, -0.6, 0.9)] {
        let mut kit = SceneKit::new();
        kit.medium("water", 1.333).matte("matte", 0.6);
        kit.interface("surface", floor(0.0, 20.0), None, Some("water"));
        let up = if plane < lamp { 1.0 } else { -1.0 };
        let ground = rectangle(DVec3::Y * plane, DVec3::Z * 20.0, DVec3::X * (20.0 * up));
        kit.surface("plane", ground, "matte");
        let square = rectangle(DVec3::Y * lamp, DVec3::X * 1.5, DVec3::Z * (1.5 * up));
        kit.lamp("lamp", square, 5.0).camera(DVec3::new(0.0, camera, 1.5), DVec3::Y * plane);
        assert_as_path(
            &kit.world(),
            POWER_UNDER_WATER,
            &format!("camera {camera}, plane {plane}, lamp {lamp}"),
        );
    }
}

#[test]
fn the_sky_through_glass_counts_once() {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.6).surface("floor", floor(-0.6, 3.0), "matte");
    kit.medium("glass", 1.5).solid("ball", sphere(DVec3::new(0.0, 0.0, -0.4), 0.5), "glass");
    add_rough(&mut kit, 0.3);
    kit.sky(1.0).camera(DVec3::new(0.0, 0.8, 2.0), DVec3::new(0.0, -0.4, -0.3));
    assert_as_path(&kit.world(), POWER, "sky");
}

fn fog(kit: &mut SceneKit) {
    let scattering = Scattering { sigma_s: [0.2, 0.4, 0.5], phase: PhaseDescription::from_mean_cosine(0.4) };
    let medium = MediumDescription {
        absorption: Absorption::SigmaA([0.1, 0.02, 0.05]),
        scattering: Some(scattering),
        ..MediumDescription::clear("fog", IndexDescription::Constant(1.0))
    };
    kit.description.media.push(medium.into());
    kit.description.surrounding = Some("fog".into());
}

#[test]
fn in_fog_photons_and_paths_agree() {
    let mut kit = hollow(lamp_ball);
    fog(&mut kit);
    assert_as_path(&kit.world(), POWER, "fog");
}

#[test]
fn media_are_as_bright_at_their_skin_as_within() {
    // The first passes, whose kernels are a quarter of the ball: what lies beyond its skin must not count as dark.
    for is_grid in [false, true] {
        let mut kit = SceneKit::new();
        volume(&mut kit, "milk", 1.333, [0.0; 3], [3.0; 3], 0.0);
        if is_grid {
            grid(&mut kit, DVec3::splat(-1.0), DVec3::ONE, |_| 1.0);
        }
        assert_shines_like_the_sky(kit, 0..24, &format!("grid {is_grid}"));
    }
}

#[test]
fn an_uneven_grid_is_as_bright_as_an_even_one() {
    // A photon is worth what the medium is where it landed, not where it is gathered; an albedo overrules the coefficients.
    // Kernels are as wide as a cell, and no wider: straight light and scattered light are blurred each by itself.
    let mut kit = SceneKit::new();
    volume(&mut kit, "milk", 1.333, [2.0; 3], [1.0; 3], 0.0);
    grid(&mut kit, DVec3::splat(-1.0), DVec3::ONE, uneven);
    let white = GridData { size: [1, 1, 1], channels: 3, values: vec![1.0; 3] };
    kit.description.media.last_mut().unwrap().density.as_mut().unwrap().albedo = Some(Arc::new(white));
    assert_shines_like_the_sky(kit, 1000..1024, "uneven grid");
}

/// Fails where a lossless ball of the last medium doesn't show the radiance of the sky about it.
fn assert_shines_like_the_sky(mut kit: SceneKit, passes: Range<u32>, what: &str) {
    kit.solid("ball", sphere(DVec3::ZERO, 0.9), "milk");
    kit.sky(1.0).camera(DVec3::Z * 4.0, DVec3::ZERO);
    kit.description.cameras[0].projection = Projection::Perspective { fov: 0.4, fov_axis: FovAxis::Y };
    let world = kit.world();
    let mean = known_to(POWER, 0, |seed| {
        let settings = RenderSettings { seed, ..settings() };
        Shot { world: &world, integrator: "merging", settings, size: (12, 12) }.mean(passes.clone())
    });
    let error = mean.variance_of_mean().sqrt();
    println!("{what}: {} ± {error}, {} pictures", mean.mean(), mean.count());
    assert!((mean.mean() - 1.0).abs() < 3.0 * error + 0.002, "{what}: {} ± {error}", mean.mean());
}

#[test]
fn a_point_is_a_very_small_lamp() {
    // Path tracing can't tell: no path hits a point. Merging of small lamps is tested above.
    let at = DVec3::new(-0.6, 0.9, 0.3);
    let (radius, intensity) = (0.02_f64, 2.0_f64);
    for roughness in [0.0, 0.3] {
        let mut point = hollow(|kit| {
            kit.light(LightKind::Point { position: at, intensity: [intensity as f32; 3] });
        });
        // A ball of this radiance has the same intensity from afar.
        let radiance = intensity / (std::f64::consts::PI * radius * radius);
        let mut ball = hollow(|kit| {
            kit.lamp("lamp", sphere(at, radius), radiance as f32);
        });
        if roughness > 0.0 {
            add_rough(&mut point, roughness);
            add_rough(&mut ball, roughness);
        }
        let (a, b) =
            (means(&point.world(), "merging", LATE, POWER), means(&ball.world(), "merging", LATE, POWER));
        assert_same(&a, &b, POWER, &format!("point, roughness {roughness}"));
    }
}

/// The first passes of a picture, by as many threads.
fn bits(world: &World, techniques: Techniques, threads: usize) -> Vec<[f32; 3]> {
    let settings = RenderSettings { techniques, ..settings() };
    let shot = Shot { world, integrator: "merging", settings, size: (24, 24) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let mut all = Vec::new();
    pool.install(|| {
        shot.render(shot.full_frame(), 0..2, |_, samples| all.extend(samples.iter().map(|s| s.beauty)))
    });
    all
}

#[test]
fn a_pass_has_the_same_bits_on_any_number_of_threads() {
    let mut foggy = hollow(lamp_ball);
    fog(&mut foggy);
    // Balls as small as these show the lamp as glints.
    let mut glittering = hollow(|kit| {
        kit.lamp("lamp", sphere(DVec3::new(-0.2, 0.3, -1.2), 0.05), 150.0);
    });
    for i in 0..9 {
        let at = DVec3::new(0.1 * f64::from(i % 3 - 1), 0.1 * f64::from(i / 3 - 1), 0.3);
        glittering.solid(&format!("ball {i}"), sphere(at, 0.049), "glass");
    }
    let [fog, glints] = [foggy, glittering].map(|kit| kit.world());
    let all = Techniques::default();
    for world in [&fog, &glints] {
        let one = bits(world, all, 1);
        assert!(one.iter().flatten().any(|&value| value > 0.0));
        assert_eq!(one, bits(world, all, 2));
        assert_eq!(one, bits(world, all, 3));
    }
    let without = Techniques { glints: false, ..all };
    assert!(bits(&glints, all, 1) != bits(&glints, without, 1), "there are glints to look for again");
}
