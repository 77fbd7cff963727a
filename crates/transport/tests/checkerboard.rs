//! A checkerboard seen through each object of the gallery is the one that an f64 tracer sees, which knows only Snell's
//! law, Fresnel's equations and the shapes: the furnace is blind to wrong directions, this is not.

mod looking_through;
mod scene_kit;
mod snell_tracer;

use hyaline_math::{DVec2, DVec3, Vec3};
use hyaline_scene::{
    BoundaryDescription, FillLayer, MeshData, RimKind, ShapeDescription, VesselDescription, VesselProfile,
};
use looking_through::{Rays, assert_same_view};
use scene_kit::*;
use snell_tracer::body::Body;
use snell_tracer::surface::Triangle;
use snell_tracer::vessel::{Liquid, Outside, Vessel};
use snell_tracer::{Medium, Scene};
use std::f64::consts::TAU;

const GLASS: Medium = 1;
const WATER: Medium = 2;
const ICE: Medium = 3;
const OIL: Medium = 4;
const IOR: [f64; 5] = [1.0, 1.5, 1.333, 1.31, 1.47];

/// A kit with the media of `IOR`, the strongest with the highest priority.
fn media() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.absorbing_medium("glass", IOR[GLASS], [0.0; 3], 4)
        .absorbing_medium("water", IOR[WATER], [0.0; 3], 1)
        .absorbing_medium("ice", IOR[ICE], [0.0; 3], 3)
        .absorbing_medium("oil", IOR[OIL], [0.0; 3], 2);
    kit
}

fn around(radius: f64) -> Rays {
    Rays::Towards { center: DVec3::ZERO, radius }
}

#[test]
fn through_a_ball() {
    let mut kit = media();
    let center = DVec3::new(0.1, -0.05, 0.2);
    kit.solid("ball", sphere(center, 0.8), "glass");
    let scene = Scene::of_bodies(vec![(Body::Ball { center, radius: 0.8 }, GLASS)], &IOR, 1.0);
    assert_same_view(&kit, &scene, &around(0.9), "ball");
}

#[test]
fn through_a_box() {
    let mut kit = media();
    let (min, max) = (DVec3::new(-0.5, -0.6, -0.4), DVec3::new(0.7, 0.3, 0.5));
    kit.solid("box", cuboid(min, max), "glass");
    let scene = Scene::of_bodies(vec![(Body::Cuboid { min, max }, GLASS)], &IOR, 1.0);
    assert_same_view(&kit, &scene, &around(0.6), "box");
}

#[test]
fn through_a_rounded_box() {
    let mut kit = media();
    let (min, max, radius) = (DVec3::new(-0.5, -0.6, -0.4), DVec3::new(0.7, 0.3, 0.5), 0.15);
    kit.solid("box", ShapeDescription::Box { min, max, radius }, "glass");
    let scene = Scene::of_bodies(vec![(Body::RoundedCuboid { min, max, radius }, GLASS)], &IOR, 1.0);
    assert_same_view(&kit, &scene, &around(0.6), "rounded box");
}

#[test]
fn through_a_thick_pane_and_a_stack_that_touches() {
    let mut kit = media();
    let layers = [
        (-0.4, -0.2, "glass", GLASS),
        (0.1, 0.2, "ice", ICE),
        (0.2, 0.35, "oil", OIL),
        (0.35, 0.4, "water", WATER),
    ];
    let mut bodies = Vec::new();
    for (low, high, medium, id) in layers {
        let (min, max) = (DVec3::new(-0.8, -0.7, low), DVec3::new(0.8, 0.9, high));
        kit.solid(medium, cuboid(min, max), medium);
        bodies.push((Body::Cuboid { min, max }, id));
    }
    assert_same_view(&kit, &Scene::of_bodies(bodies, &IOR, 1.0), &around(0.7), "panes");
}

#[test]
fn through_balls_within_balls_and_from_the_innermost() {
    let mut kit = media();
    let off = DVec3::new(0.1, 0.05, -0.05);
    kit.solid("outer", sphere(DVec3::ZERO, 0.9), "water").solid("middle", sphere(off, 0.6), "oil").solid(
        "inner",
        sphere(off * 2.0, 0.35),
        "glass",
    );
    let ball = |center, radius| Body::Ball { center, radius };
    let bodies = vec![(ball(off * 2.0, 0.35), GLASS), (ball(off, 0.6), OIL), (ball(DVec3::ZERO, 0.9), WATER)];
    let scene = Scene::of_bodies(bodies, &IOR, 1.0);
    assert_same_view(&kit, &scene, &around(0.9), "nested balls");
    assert_same_view(&kit, &scene, &Rays::From(DVec3::new(0.25, 0.2, -0.15)), "nested balls from within");
}

#[test]
fn through_bodies_that_overlap() {
    let mut kit = media();
    let (min, max) = (DVec3::new(-0.2, -0.2, -0.3), DVec3::new(1.1, 0.3, 0.3));
    let (left, below) = (DVec3::new(-0.4, 0.2, 0.0), DVec3::new(0.0, -0.5, 0.2));
    kit.solid("water", sphere(DVec3::ZERO, 0.8), "water")
        .solid("oil", sphere(below, 0.5), "oil")
        .solid("ice", cuboid(min, max), "ice")
        .solid("glass", sphere(left, 0.45), "glass");
    let ball = |center, radius| Body::Ball { center, radius };
    let bodies = vec![
        (ball(left, 0.45), GLASS),
        (Body::Cuboid { min, max }, ICE),
        (ball(below, 0.5), OIL),
        (ball(DVec3::ZERO, 0.8), WATER),
    ];
    assert_same_view(&kit, &Scene::of_bodies(bodies, &IOR, 1.0), &around(0.9), "overlapping bodies");
}

#[test]
fn through_interfaces_within_each_other() {
    let mut kit = media();
    let off = DVec3::new(0.1, 0.0, 0.2);
    kit.interface("outer", sphere(DVec3::ZERO, 0.9), None, Some("water"))
        .interface("inner", sphere(off, 0.6), Some("water"), Some("glass"))
        .interface("bubble", sphere(off, 0.3), Some("glass"), None);
    let ball = |center, radius| Body::Ball { center, radius };
    let bodies = vec![(ball(off, 0.3), 0), (ball(off, 0.6), GLASS), (ball(DVec3::ZERO, 0.9), WATER)];
    assert_same_view(&kit, &Scene::of_bodies(bodies, &IOR, 1.0), &around(0.9), "interfaces");
}

#[test]
fn through_a_torus() {
    let mut kit = media();
    let (major_radius, minor_radius) = (0.6, 0.25);
    let whole = [0.0, TAU];
    kit.solid(
        "torus",
        ShapeDescription::Torus { major_radius, minor_radius, phi: whole, theta: whole },
        "glass",
    );
    let scene = Scene::of_bodies(vec![(Body::Torus { major_radius, minor_radius }, GLASS)], &IOR, 1.0);
    assert_same_view(&kit, &scene, &around(0.9), "torus");
}

/// The triangles of a mesh for the tracer, with the normals at their corners or their own.
fn triangles(shape: &ShapeDescription) -> Vec<Triangle> {
    let ShapeDescription::Mesh { mesh, flat } = shape else { panic!("{shape:?} is no mesh") };
    let mesh: &MeshData = mesh;
    let at = |list: &[[f32; 3]], index: u32| Vec3::from(list[index as usize]).as_dvec3();
    let own = |corners: [DVec3; 3]| (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let whole = mesh.triangles.iter().map(|&indices| {
        let corners = indices.map(|index| at(&mesh.positions, index));
        let normals =
            if *flat { [own(corners).normalize(); 3] } else { indices.map(|i| at(&mesh.normals, i)) };
        Triangle { corners, normals }
    });
    // At the poles half the triangles of a ball of rings have no area but for roundings.
    whole.filter(|triangle| own(triangle.corners).length() > 1e-5).collect()
}

#[test]
fn through_a_faceted_mesh() {
    let ShapeDescription::Mesh { mesh, .. } = ball_mesh(Vec3::new(0.1, 0.0, -0.1), 0.8, 6) else {
        unreachable!()
    };
    let shape = ShapeDescription::Mesh { mesh, flat: true };
    let scene = Scene::of_bodies(vec![(Body::Hull(triangles(&shape)), GLASS)], &IOR, 1.0);
    let mut kit = media();
    kit.solid("gem", shape, "glass");
    assert_same_view(&kit, &scene, &around(0.9), "faceted mesh");
}

#[test]
fn through_a_mesh_with_smooth_normals() {
    let shape = ball_mesh(Vec3::new(0.1, 0.0, -0.1), 0.8, 16);
    let scene = Scene::of_bodies(vec![(Body::Hull(triangles(&shape)), GLASS)], &IOR, 1.0);
    let mut kit = media();
    kit.solid("lens", shape, "glass");
    assert_same_view(&kit, &scene, &around(0.8), "smooth mesh");
}

/// The tumbler of the kit in decimeters, measured with a ruler.
fn measured_tumbler(has_round_rim: bool, liquids: &[(Medium, f64, f64)]) -> Vessel {
    Vessel {
        outside: Outside::Straight { foot: DVec2::new(0.3, 0.0), lip: DVec2::new(0.36, 1.0) },
        wall: 0.025,
        base: 0.08,
        has_round_rim,
        glass: GLASS,
        liquids: liquids
            .iter()
            .map(|&(medium, level, meniscus)| Liquid { medium, level, meniscus })
            .collect(),
    }
}

fn kit_with_tumbler(rim: RimKind, fill: &[(&str, f64, f64)]) -> SceneKit {
    let mut kit = media();
    kit.object("tumbler", tumbler(rim, fill, 10.0), BoundaryDescription::None, "dielectric");
    kit
}

fn around_the_tumbler() -> Rays {
    Rays::Towards { center: DVec3::Y * 0.5, radius: 0.6 }
}

#[test]
fn through_a_tumbler_of_water_with_a_flat_rim() {
    let kit = kit_with_tumbler(RimKind::Flat, &[("water", 0.75, 0.0)]);
    let scene = measured_tumbler(false, &[(WATER, 0.75, 0.0)]).scene(&IOR, 1.0);
    assert_same_view(&kit, &scene, &around_the_tumbler(), "flat tumbler");
}

#[test]
fn through_a_tumbler_of_water_with_a_round_rim_and_a_meniscus_and_from_under_water() {
    let kit = kit_with_tumbler(RimKind::Round, &[("water", 0.75, 0.002)]);
    let scene = measured_tumbler(true, &[(WATER, 0.75, 0.02)]).scene(&IOR, 1.0);
    assert_same_view(&kit, &scene, &around_the_tumbler(), "round tumbler");
    assert_same_view(
        &kit,
        &scene,
        &Rays::From(DVec3::new(0.05, 0.6, -0.1)),
        "round tumbler from under water",
    );
    // The rim and the meniscus are thin: look at them more closely.
    for (height, what) in [(1.0, "rim"), (0.78, "meniscus")] {
        let rays = Rays::Towards { center: DVec3::new(0.34, height, 0.0), radius: 0.05 };
        assert_same_view(&kit, &scene, &rays, what);
    }
}

#[test]
fn through_a_tumbler_of_oil_on_water() {
    let kit = kit_with_tumbler(RimKind::Round, &[("water", 0.4, 0.0015), ("oil", 0.7, 0.001)]);
    let scene = measured_tumbler(true, &[(WATER, 0.4, 0.015), (OIL, 0.7, 0.01)]).scene(&IOR, 1.0);
    assert_same_view(&kit, &scene, &around_the_tumbler(), "two liquids");
}

#[test]
#[should_panic(expected = "wrong wall")]
fn a_wall_half_a_percent_too_thick_is_noticed() {
    let kit = kit_with_tumbler(RimKind::Round, &[("water", 0.75, 0.002)]);
    let right = measured_tumbler(true, &[(WATER, 0.75, 0.02)]);
    let wrong = Vessel { wall: 1.005 * right.wall, ..right };
    assert_same_view(&kit, &wrong.scene(&IOR, 1.0), &around_the_tumbler(), "wrong wall");
}

#[test]
fn through_a_fishbowl() {
    let mut kit = media();
    let shape = ShapeDescription::Vessel(VesselDescription {
        profile: VesselProfile::Bowl { radius: 1.0, foot: 0.5, opening: 0.65 },
        wall: 0.03,
        base: 0.05,
        rim: RimKind::Round,
        medium: "glass".into(),
        fill: vec![FillLayer { medium: "water".into(), level: 0.72, meniscus: 0.02 }],
    });
    kit.object("bowl", shape, BoundaryDescription::None, "dielectric");
    let vessel = Vessel {
        outside: Outside::Spherical { radius: 1.0, foot: 0.5, opening: 0.65 },
        wall: 0.03,
        base: 0.05,
        has_round_rim: true,
        glass: GLASS,
        liquids: vec![Liquid { medium: WATER, level: 0.72, meniscus: 0.02 }],
    };
    let rays = Rays::Towards { center: DVec3::Y * 0.85, radius: 1.0 };
    assert_same_view(&kit, &vessel.scene(&IOR, 1.0), &rays, "fishbowl");
}
