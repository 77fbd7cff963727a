//! Light starts in the medium that its light stands in.

mod scene_kit;

use hyaline_math::{DVec3, Transform, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scene::*;
use hyaline_transport::photon::PhotonEmitter;
use hyaline_transport::photon::emission::start_numbers;
use hyaline_world::World;
use scene_kit::{SceneKit, cuboid, floor, rectangle, sphere, tumbler};

/// Air, glass, water and fog, in this order.
fn media() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.medium("air", 1.0).medium("glass", 1.5).medium("water", 1.33).medium("fog", 1.0);
    for (medium, priority) in kit.description.media.iter_mut().zip([3, 0, 1, 2]) {
        medium.priority = priority;
    }
    kit.description.surrounding = Some("air".into());
    kit
}

fn point(kit: &mut SceneKit, position: DVec3) {
    kit.light(LightKind::Point { position, intensity: [1.0; 3] });
}

/// Names of the media that photons of the only light start in, without repetition.
fn start_media(kit: &SceneKit) -> Vec<&str> {
    let world = kit.world();
    let emitter = PhotonEmitter::new(&world, ProjectionMaps::None, 8);
    let mut found = Vec::new();
    for number in 0..60 {
        let mut sampler = Sampler::new(SamplerKind::Sobol, 1, (0, 0), number);
        let medium = emitter.emit_from(start_numbers(&mut sampler)).unwrap().set.active().index();
        if !found.contains(&medium) {
            found.push(medium);
        }
    }
    found.sort_unstable();
    found.iter().map(|&medium| kit.description.media[medium - 1].name.as_str()).collect()
}

#[test]
fn a_lamp_in_a_hollow_glass_ball_shines_into_its_air() {
    let shell = |kit: &mut SceneKit| {
        kit.solid("glass", sphere(DVec3::ZERO, 1.0), "glass").solid(
            "hollow",
            sphere(DVec3::ZERO, 0.9),
            "air",
        );
    };
    let mut kit = media();
    shell(&mut kit);
    kit.lamp("lamp", sphere(DVec3::X * 0.3, 0.1), 1.0);
    assert_eq!(start_media(&kit), ["air"]);
    let mut kit = media();
    shell(&mut kit);
    point(&mut kit, DVec3::X * 0.95);
    assert_eq!(start_media(&kit), ["glass"], "within the wall");
    let mut kit = media();
    shell(&mut kit);
    kit.lamp("lamp", sphere(DVec3::X * 2.0, 0.1), 1.0);
    assert_eq!(start_media(&kit), ["air"], "outside");
}

#[test]
fn lamps_under_a_water_surface_shine_into_water_and_above_it_into_air() {
    for (height, medium) in [(-0.5, "water"), (0.5, "air")] {
        let place = DVec3::new(0.3, height, 0.0);
        let lamp_shape = rectangle(place, DVec3::X * 0.2, DVec3::Z * 0.2);
        let mut lamp = media();
        lamp.interface("sea", floor(0.0, 5.0), None, Some("water")).lamp("lamp", lamp_shape, 1.0);
        assert_eq!(start_media(&lamp), [medium]);
        let mut bulb = media();
        bulb.interface("sea", floor(0.0, 5.0), None, Some("water"));
        point(&mut bulb, place);
        assert_eq!(start_media(&bulb), [medium]);
    }
}

#[test]
fn a_spot_in_fog_and_a_lamp_in_a_tumbler_s_water_are_where_they_are() {
    let mut kit = media();
    kit.solid("cloud", cuboid(DVec3::splat(-2.0), DVec3::splat(2.0)), "fog");
    kit.light(LightKind::Spot {
        position: DVec3::new(0.5, 1.0, 0.2),
        direction: -DVec3::Y,
        intensity: [1.0; 3],
        outer_angle: 0.5,
        inner_angle: 0.3,
        falloff: SpotFalloff::Smooth,
    });
    assert_eq!(start_media(&kit), ["fog"]);
    let mut kit = media();
    kit.solid("tumbler", tumbler(RimKind::Round, &[("water", 0.8, 0.0)], 1.0), "glass");
    kit.lamp("pearl", sphere(DVec3::new(0.005, 0.04, 0.0), 0.004), 1.0);
    assert_eq!(start_media(&kit), ["water"]);
}

#[test]
fn the_sides_of_a_glowing_body_shine_into_what_is_on_them() {
    let mut kit = media();
    kit.solid("sea", cuboid(DVec3::splat(-2.0), DVec3::splat(2.0)), "water");
    kit.lamp("ember", sphere(DVec3::ZERO, 0.5), 1.0);
    let ember = kit.description.objects.last_mut().unwrap();
    ember.boundary = BoundaryDescription::Solid { medium: "fog".into() };
    assert_eq!(start_media(&kit), ["water"]);
    kit.description.objects.last_mut().unwrap().emission.as_mut().unwrap().two_sided = true;
    assert_eq!(start_media(&kit), ["water", "fog"]);
    let world = kit.world();
    let emitter = PhotonEmitter::new(&world, ProjectionMaps::None, 8);
    for number in 0..100 {
        let mut sampler = Sampler::new(SamplerKind::Sobol, 1, (0, 0), number);
        let photon = emitter.emit_from(start_numbers(&mut sampler)).unwrap();
        let goes_in = photon.ray.origin.dot(photon.ray.direction) < 0.0;
        let medium = &kit.description.media[photon.set.active().index() - 1].name;
        assert_eq!(medium, if goes_in { "fog" } else { "water" });
    }
}

#[test]
fn a_light_that_sees_no_boundary_is_in_what_it_declares() {
    let mut kit = media();
    kit.lamp("lamp", sphere(DVec3::ZERO, 0.5), 1.0);
    assert_eq!(start_media(&kit), ["air"]);
    kit.description.objects[0].emission.as_mut().unwrap().medium = Some("fog".into());
    assert_eq!(start_media(&kit), ["fog"]);
    let mut kit = media();
    point(&mut kit, DVec3::Y);
    kit.description.lights[0].medium = Some("water".into());
    assert_eq!(start_media(&kit), ["water"]);
    kit.description.lights[0].medium = Some("mercury".into());
    let error = World::compile(&kit.description).unwrap_err().to_string();
    assert!(error.contains("mercury"), "{error}");
}

#[test]
fn light_from_infinity_starts_in_the_medium_of_the_world() {
    let mut kit = media();
    kit.description.surrounding = Some("fog".into());
    kit.solid("ball", sphere(DVec3::ZERO, 1.0), "glass").sky(1.0);
    assert_eq!(start_media(&kit), ["fog"]);
    let mut kit = media();
    kit.solid("ball", sphere(DVec3::ZERO, 1.0), "glass");
    kit.light(LightKind::Directional { direction: DVec3::X, irradiance: [1.0; 3] });
    assert_eq!(start_media(&kit), ["air"]);
}

#[test]
fn a_lamp_that_is_half_under_water_is_in_doubt() {
    let notes = |height: f64| {
        let mut kit = media();
        kit.interface("sea", floor(0.0, 5.0), None, Some("water"));
        kit.lamp("buoy", sphere(DVec3::Y * height, 0.5), 1.0);
        let (_, notes) = World::compile(&kit.description).unwrap();
        notes.iter().filter(|note| note.message.contains("light 'buoy'")).count()
    };
    assert_eq!([notes(0.0), notes(2.0), notes(-2.0)], [1, 0, 0]);
}

#[test]
fn photons_of_a_lamp_start_off_its_surface() {
    let mut kit = media();
    kit.lamp("lamp", sphere(DVec3::ZERO, 0.5), 1.0);
    kit.description.objects[0].placement = Transform::translate(DVec3::new(1000.0, 30.0, -7.0));
    let world = kit.world();
    let emitter = PhotonEmitter::new(&world, ProjectionMaps::None, 8);
    for number in 0..2000 {
        let mut sampler = Sampler::new(SamplerKind::Sobol, 1, (0, 0), number);
        let photon = emitter.emit_from(start_numbers(&mut sampler)).unwrap();
        assert!(world.geometry.closest(&photon.ray, u8::MAX).is_none(), "{photon:?}");
        assert!((photon.ray.origin - Vec3::new(1000.0, 30.0, -7.0)).length() < 0.501);
    }
}
