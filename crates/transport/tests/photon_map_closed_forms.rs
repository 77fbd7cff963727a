//! Photons against closed forms: irradiance from simple lights, light that is scattered again and again, and where
//! mirrors and lenses bring it together.

mod photon_kit;
mod scene_kit;

use hyaline_math::{DVec3, float};
use hyaline_scene::*;
use hyaline_transport::photon::gather::PhotonMap;
use hyaline_transport::photon::record::{Photon, PhotonKind};
use hyaline_transport::photon::trace::MapKind;
use hyaline_world::World;
use photon_kit::*;
use scene_kit::*;
use std::f64::consts::PI;

const FLUX: f64 = 40.0;

fn point_light(position: DVec3) -> LightKind {
    LightKind::Point { position, intensity: [(FLUX / (4.0 * PI)) as f32; 3] }
}

fn map(photons: &[Photon]) -> PhotonMap {
    PhotonMap::from_photons(photons, 32)
}

fn of_kind(kind: PhotonKind, photons: Vec<Photon>) -> Vec<Photon> {
    photons.into_iter().filter(|photon| photon.kind == kind).collect()
}

fn caustics(world: &World, count: u32) -> Vec<Photon> {
    of_kind(PhotonKind::Caustic, trace(world, MapKind::Caustic, count))
}

#[test]
fn a_plane_under_a_point_light_has_the_irradiance_of_the_cosine_cubed() {
    let height = 1.5;
    for sigma in [0.0_f32, 0.4] {
        let mut kit = SceneKit::new();
        kit.matte("matte", 0.5).surface("floor", floor(0.0, 6.0), "matte");
        kit.absorbing_medium("water", 1.333, [sigma; 3], 0).solid("pool", sphere(DVec3::ZERO, 20.0), "water");
        kit.light(point_light(DVec3::Y * height));
        let map = map(&trace(&kit.world(), MapKind::Global, 300_000));
        for x in [0.0, 0.6, 1.2] {
            let p = DVec3::new(x, 0.0, 0.3 * x);
            let distance = (p - DVec3::Y * height).length();
            let cos = height / distance;
            let absorbed = float::f64::exp(-f64::from(sigma) * distance);
            let expected = FLUX * cos.powi(3) / (4.0 * PI * height * height) * absorbed;
            assert_close(irradiance(&map, p, DVec3::Y, 0.25), expected, 0.05, &format!("σ {sigma}, at {x}"));
        }
    }
}

#[test]
fn light_is_right_on_the_axis_of_a_disc() {
    let (radius, height, radiance) = (0.5, 1.0, 3.0);
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.5).surface("floor", floor(0.0, 6.0), "matte");
    let disc =
        ShapeDescription::Disc { center: DVec3::Y * height, normal: -DVec3::Y, radius, inner_radius: 0.0 };
    kit.lamp("lamp", disc, radiance as f32);
    let map = map(&trace(&kit.world(), MapKind::Global, 300_000));
    let expected = PI * radiance * radius * radius / (radius * radius + height * height);
    assert_close(irradiance(&map, DVec3::ZERO, DVec3::Y, 0.08), expected, 0.03, "on the axis");
}

/// A matte ball about the origin, a lamp in it off the center.
fn hollow(albedo: f32, radius: f64) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.matte("matte", albedo).surface("wall", sphere(DVec3::ZERO, radius), "matte");
    kit.light(point_light(DVec3::new(0.2, 0.7, -0.3) * radius));
    kit
}

#[test]
fn indirect_light_in_an_integrating_sphere_is_a_geometric_series() {
    let (radius, albedo) = (2.0, 0.7_f32);
    let world = hollow(albedo, radius).world();
    let photons = trace(&world, MapKind::Indirect, 200_000);
    assert!(photons.iter().all(|photon| photon.kind == PhotonKind::Indirect && photon.bounces > 0));
    let map = map(&photons);
    let mean_direct = FLUX / (4.0 * PI * radius * radius);
    let rho = f64::from(albedo);
    for n in [DVec3::X, -DVec3::Y, DVec3::new(0.48, 0.6, -0.64)] {
        let value = irradiance(&map, -n * radius, n, 0.5);
        assert_close(value, rho * mean_direct / (1.0 - rho), 0.04, &format!("indirect at {n}"));
    }
}

#[test]
fn the_power_that_arrives_at_the_wall_of_a_closed_room_is_a_geometric_series() {
    for (albedo, bodies) in [(0.5_f32, false), (0.9, false), (0.5, true), (0.9, true)] {
        let mut kit = hollow(albedo, 2.0);
        if bodies {
            kit.medium("glass", 1.5).solid("lens", sphere(DVec3::new(0.3, -0.4, 0.2), 0.8), "glass");
        }
        let photons = trace(&kit.world(), MapKind::Global, 100_000);
        let expected = FLUX / (1.0 - f64::from(albedo));
        assert_close(power(&photons), expected, 0.01, &format!("albedo {albedo}, with glass: {bodies}"));
        let mean = power(&photons) / photons.len() as f64;
        let unequal =
            photons.iter().find(|photon| (f64::from(photon.flux.mean(3)) / mean - 1.0).abs() > 1e-3);
        assert!(unequal.is_none(), "a photon of {unequal:?} among those of {mean} W");
    }
}

#[test]
fn parallel_light_in_a_mirror_cylinder_has_its_cusp_half_a_radius_from_the_axis() {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.5).surface("floor", floor(0.0, 1.0), "matte");
    kit.material("mirror", MaterialKind::PerfectSpecular { reflectance: ColorSource::Constant([1.0; 3]) });
    // The half at +x, lit from -x and from above.
    let cylinder =
        ShapeDescription::Cylinder { radius: 1.0, y: [0.0, 0.8], phi: [-0.5 * PI, 0.5 * PI], capped: false };
    kit.surface("band", cylinder, "mirror");
    kit.light(LightKind::Directional { direction: DVec3::new(1.0, -0.6, 0.0), irradiance: [1.0; 3] });
    let photons = caustics(&kit.world(), 300_000);
    let mut counts = [0_u32; 50];
    for photon in photons.iter().filter(|photon| photon.p.z.abs() < 0.004 && (0.0..1.0).contains(&photon.p.x))
    {
        counts[(photon.p.x * 50.0) as usize] += 1;
    }
    let brightest = (0..50).max_by_key(|&i| counts[i]).unwrap();
    let cusp = (brightest as f64 + 0.5) / 50.0;
    assert!((cusp - 0.5).abs() < 0.03, "cusp at {cusp}: {counts:?}");
}

#[test]
fn parallel_light_through_a_ball_lens_meets_half_a_radius_behind_it() {
    let radius = 1.0;
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.5).surface("floor", floor(-1.2, 4.0), "matte");
    kit.medium("glass", 1.5).solid("lens", sphere(DVec3::ZERO, radius), "glass");
    kit.light(LightKind::Directional { direction: -DVec3::Y, irradiance: [1.0; 3] });
    let photons = caustics(&kit.world(), 300_000);
    let mut foci = Vec::new();
    for photon in photons.iter().filter(|photon| photon.bounces == 2) {
        let (p, d) = (photon.p.as_dvec3(), photon.direction.as_dvec3());
        let slope = (d.x * d.x + d.z * d.z).sqrt();
        // Steeper rays meet the axis nearer to the lens, and flat ones have no certain place.
        if (0.02..0.06).contains(&slope) {
            let along = -(p.x * d.x + p.z * d.z) / (slope * slope);
            foci.push(-(p.y + along * d.y));
        }
    }
    let mean = foci.iter().sum::<f64>() / foci.len() as f64;
    assert!(foci.len() > 100, "only {} rays are near the axis", foci.len());
    assert_close(mean, 1.5 * radius, 0.005, "focus, measured from the center");
}

#[test]
fn caustic_photons_have_met_specular_surfaces_alone() {
    let mut kit = hollow(0.8, 2.0);
    kit.medium("glass", 1.5).solid("lens", sphere(DVec3::new(0.3, -0.4, 0.2), 0.8), "glass");
    let world = kit.world();
    let aimed = caustics(&world, 100_000);
    assert!(aimed.iter().all(|photon| photon.bounces > 0));
    let plain = of_kind(PhotonKind::Caustic, trace(&world, MapKind::Global, 400_000));
    assert_close(power(&aimed), power(&plain), 0.03, "power of the caustics, with and without projection");
    assert!(aimed.len() > plain.len() / 2, "{} of 100 000, {} of 400 000", aimed.len(), plain.len());
}

#[test]
fn caustics_throw_their_albedo_on_a_closed_wall() {
    let albedo = 0.6_f32;
    let mut kit = hollow(albedo, 2.0);
    kit.medium("glass", 1.5).solid("lens", sphere(DVec3::new(0.3, -0.4, 0.2), 0.8), "glass");
    let photons = trace(&kit.world(), MapKind::Caustic, 100_000);
    let first = power(&of_kind(PhotonKind::Caustic, photons.clone()));
    let second = power(&of_kind(PhotonKind::Indirect, photons));
    assert_close(second, f64::from(albedo) * first, 0.02, "power thrown by caustics");
}
