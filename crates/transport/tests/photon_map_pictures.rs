//! `photon-map` against `path`, and against itself with other settings: no light is lost, none is counted twice.

mod photon_kit;
mod pictures;
mod scene_kit;

use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_world::World;
use pictures::{Shot, assert_same, known_to};
use scene_kit::*;

/// Relative error of a difference above which nothing would be shown.
const POWER: f64 = 0.012;

/// Mean of a picture over `passes` passes, for as many seeds as that takes, each with maps of its own.
fn means(world: &World, integrator: &str, photon_map: PhotonMapSettings, passes: u32) -> Moments {
    means_to_depth(world, integrator, photon_map, passes, None)
}

fn means_to_depth(
    world: &World,
    integrator: &str,
    photon_map: PhotonMapSettings,
    passes: u32,
    max_depth: Option<u32>,
) -> Moments {
    known_to(0.7 * POWER, 0, |seed| {
        let settings = RenderSettings { seed, photon_map, max_depth, ..settings() };
        Shot { world, integrator, settings, size: (8, 8) }.mean(0..passes)
    })
}

fn few_photons() -> PhotonMapSettings {
    let nearest = NearestPhotons { caustic: 20, global: 30, volume: 20 };
    PhotonMapSettings {
        caustic_photons: 15_000,
        global_photons: 15_000,
        nearest,
        ..PhotonMapSettings::default()
    }
}

fn square_lamp(center: DVec3, half: f64) -> ShapeDescription {
    // Its normal is down.
    rectangle(center, DVec3::X * half, DVec3::Z * half)
}

/// A matte plane and a camera that looks at it, a lamp on the other side of a water surface or on the same.
fn pool(camera_height: f64, floor_height: f64, lamp_height: f64) -> World {
    let mut kit = SceneKit::new();
    kit.medium("water", 1.333).matte("matte", 0.6);
    kit.interface("surface", floor(0.0, 1.5), None, Some("water"));
    let up = if floor_height < lamp_height { 1.0 } else { -1.0 };
    let plane = rectangle(DVec3::Y * floor_height, DVec3::Z * 1.5, DVec3::X * (1.5 * up));
    kit.surface("plane", plane, "matte");
    let lamp = rectangle(DVec3::Y * lamp_height, DVec3::X, DVec3::Z * up);
    kit.lamp("lamp", lamp, 5.0);
    kit.camera(DVec3::new(0.0, camera_height, 1.5), DVec3::Y * floor_height);
    kit.world()
}

#[test]
fn light_through_a_water_surface_is_that_of_path_tracing() {
    let cases = [
        ("camera and plane under water, lamp in air", pool(-0.2, -1.0, 0.8)),
        ("camera and plane in air, lamp under water", pool(0.2, 1.0, -0.8)),
        ("camera in air, plane under water, lamp in air", pool(0.4, -0.6, 0.9)),
    ];
    for (what, world) in cases {
        let photon_map = PhotonMapSettings { caustic_photons: 60_000, ..few_photons() };
        let maps = means(&world, "photon-map", photon_map, 24);
        let paths = means(&world, "path", photon_map, 64);
        assert_same(&maps, &paths, POWER, what);
    }
}

fn point_light(kit: &mut SceneKit) {
    kit.light(LightKind::Point { position: DVec3::new(-0.6, 0.9, 0.3), intensity: [2.0; 3] });
}

#[test]
fn every_way_to_look_light_up_gives_the_picture_of_path_tracing() {
    let world = hollow(lamp_ball).world();
    let paths = means(&world, "path", few_photons(), 24);
    for (what, photon_map) in ways() {
        assert_same(&means(&world, "photon-map", photon_map, 2), &paths, POWER, what);
    }
}

#[test]
fn light_of_a_point_through_glass_comes_from_the_caustic_map_in_every_way() {
    let world = hollow(point_light).world();
    let [(_, plain), others @ ..] = ways();
    let first = means(&world, "photon-map", plain, 3);
    for (what, photon_map) in others {
        assert_same(&means(&world, "photon-map", photon_map, 3), &first, POWER, what);
    }
}

#[test]
fn paths_are_as_long_as_is_asked_for() {
    let world = hollow(lamp_ball).world();
    let [plain, _, straight, ..] = ways().map(|(_, photon_map)| photon_map);
    for (depth, photon_map) in [(1, plain), (2, plain), (3, plain), (2, straight)] {
        let maps = means_to_depth(&world, "photon-map", photon_map, 2, Some(depth));
        let paths = means_to_depth(&world, "path", photon_map, 20, Some(depth));
        assert_same(&maps, &paths, POWER, &format!("{depth} bounces"));
    }
}

fn ways() -> [(&'static str, PhotonMapSettings); 5] {
    let plain = few_photons();
    [
        ("as it is", plain),
        ("without direct light in the map", PhotonMapSettings { exclude_direct: true, ..plain }),
        ("without final gathering", PhotonMapSettings { final_gather: false, ..plain }),
        ("with three gather rays", PhotonMapSettings { gather_rays: 3, ..plain }),
        ("without projection maps", PhotonMapSettings { projection: ProjectionMaps::None, ..plain }),
    ]
}

#[test]
fn finishes_between_polished_and_matte_lose_no_light() {
    for roughness in [0.3, 0.6] {
        let mut kit = hollow(lamp_ball);
        let white = || ColorSource::Constant([1.0; 3]);
        let rough = MaterialKind::Dielectric {
            roughness: ScalarSource::Constant(roughness),
            tint: (white(), white()),
        };
        kit.material("rough", rough);
        kit.object(
            "frosted",
            sphere(DVec3::new(-0.6, -0.5, -0.9), 0.5),
            BoundaryDescription::Solid { medium: "glass".into() },
            "rough",
        );
        let phong = MaterialKind::GlossySpecular {
            reflectance: ColorSource::Constant([0.8; 3]),
            exponent: ScalarSource::Constant(2.0 / (roughness * roughness)),
        };
        kit.material("glossy", phong).surface("ball", sphere(DVec3::new(0.2, 0.5, -1.0), 0.3), "glossy");
        let world = kit.world();
        let paths = means(&world, "path", few_photons(), 24);
        let maps = means(&world, "photon-map", few_photons(), 3);
        assert_same(&maps, &paths, POWER, &format!("roughness {roughness}"));
    }
}

#[test]
fn a_sky_and_lamps_that_shine_through_each_other_are_counted_once() {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.6).surface("floor", floor(-0.7, 3.0), "matte").sky(0.7);
    kit.medium("glass", 1.5).solid("lens", sphere(DVec3::new(0.1, 0.0, 0.0), 0.6), "glass");
    kit.lamp("lamp", square_lamp(DVec3::new(0.4, 1.6, -0.3), 0.3), 6.0);
    kit.camera(DVec3::new(0.0, 1.0, 2.6), DVec3::new(0.0, -0.4, 0.0));
    let world = kit.world();
    let photon_map = PhotonMapSettings { caustic_photons: 20_000, global_photons: 40_000, ..few_photons() };
    let paths = means(&world, "path", few_photons(), 24);
    assert_same(&means(&world, "photon-map", photon_map, 2), &paths, POWER, "lens under a sky");
}

#[test]
fn light_of_a_wall_that_shines_and_scatters_is_a_geometric_series() {
    let (albedo, radiance) = (0.6_f32, 2.0);
    let mut kit = SceneKit::new();
    kit.matte("matte", albedo).surface("wall", sphere(DVec3::ZERO, 1.0), "matte");
    kit.description.objects[0].emission = Some(Emission {
        color: [radiance; 3],
        quantity: EmissionQuantity::Radiance,
        two_sided: true,
        visible_to_camera: true,
        texture: None,
        medium: None,
    });
    let expected = f64::from(radiance) / (1.0 - f64::from(albedo));
    for (what, photon_map) in ways() {
        let mean = means(&kit.world(), "photon-map", photon_map, 2).mean();
        photon_kit::assert_close(mean, expected, 0.01, what);
    }
}
