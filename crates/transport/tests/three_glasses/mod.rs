//! One straight glass of water with a flat rim, built in four ways that are the same bodies.
#![allow(unreachable_pub, reason = "the module is a part of a test, not of a library")]

use crate::scene_kit::SceneKit;
use crate::snell_tracer::{Medium, Scene, Surface};
use hyaline_math::{DVec2, DVec3, Transform};
use hyaline_scene::{
    BoundaryDescription, FillLayer, ProfileCurve, RimKind, ShapeDescription, ShapePart, VesselDescription,
    VesselProfile,
};
use std::f64::consts::TAU;

pub const RADIUS: f64 = 0.035;
pub const HEIGHT: f64 = 0.1;
pub const WALL: f64 = 0.0025;
pub const BASE: f64 = 0.008;
/// Height of the water's surface: three quarters of the inner height.
pub const WATER_LINE: f64 = BASE + 0.75 * (HEIGHT - BASE);
pub const INNER_RADIUS: f64 = RADIUS - WALL;

pub const AIR: Medium = 1;
pub const GLASS: Medium = 2;
pub const WATER: Medium = 3;

/// How the glass is put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// A vessel with a fill.
    Vessel,
    /// A cylinder of glass, in it one of air, in that one of water: each wins over the one before.
    Carved,
    /// A hollow body of glass; the water reaches into its walls and base, where the glass wins.
    Poured,
    /// Sheets that name the media on both sides.
    Interfaces,
}

pub const WAYS: [Way; 4] = [Way::Vessel, Way::Carved, Way::Poured, Way::Interfaces];

/// The glass and nothing else; the world is filled with air.
pub fn glass_of_water(way: Way) -> SceneKit {
    let mut kit = SceneKit::new();
    let ranks = match way {
        Way::Carved => [2, 1, 3],
        Way::Vessel | Way::Poured | Way::Interfaces => [0, 2, 1],
    };
    kit.absorbing_medium("air", 1.0, [0.0; 3], ranks[0])
        .absorbing_medium("glass", 1.5, [6.0, 2.0, 4.0], ranks[1])
        .absorbing_medium("water", 1.333, [12.0, 4.0, 1.0], ranks[2]);
    kit.description.surrounding = Some("air".into());
    match way {
        Way::Vessel => vessel(&mut kit),
        Way::Carved => carved(&mut kit),
        Way::Poured => poured(&mut kit),
        Way::Interfaces => interfaces(&mut kit),
    }
    kit
}

fn vessel(kit: &mut SceneKit) {
    let shape = ShapeDescription::Vessel(VesselDescription {
        profile: VesselProfile::Points {
            outer: vec![[RADIUS, 0.0], [RADIUS, HEIGHT]],
            curve: ProfileCurve::Lines,
        },
        wall: WALL,
        base: BASE,
        rim: RimKind::Flat,
        medium: "glass".into(),
        fill: vec![FillLayer { medium: "water".into(), level: 0.75, meniscus: 0.0 }],
    });
    kit.object("glass", shape, BoundaryDescription::None, "dielectric");
}

fn carved(kit: &mut SceneKit) {
    // The air sticks out at the top: there it bounds nothing but air.
    kit.solid("glass", cylinder(RADIUS, 0.0, HEIGHT, true), "glass")
        .solid("hollow", cylinder(INNER_RADIUS, BASE, 1.1 * HEIGHT, true), "air")
        .solid("water", cylinder(INNER_RADIUS, BASE, WATER_LINE, true), "water");
}

fn poured(kit: &mut SceneKit) {
    let profile = vec![
        [0.0, 0.0],
        [RADIUS, 0.0],
        [RADIUS, HEIGHT],
        [INNER_RADIUS, HEIGHT],
        [INNER_RADIUS, BASE],
        [0.0, BASE],
    ];
    kit.solid("glass", ShapeDescription::Revolution { profile, curve: ProfileCurve::Lines }, "glass").solid(
        "water",
        cylinder(RADIUS - 0.5 * WALL, 0.5 * BASE, WATER_LINE, true),
        "water",
    );
}

fn interfaces(kit: &mut SceneKit) {
    let outside = vec![
        cylinder(RADIUS, 0.0, HEIGHT, false),
        disc(RADIUS, 0.0, 0.0, -1.0),
        disc(RADIUS, INNER_RADIUS, HEIGHT, 1.0),
    ];
    kit.interface("glass to air, outside", compound(outside), None, Some("glass"))
        .interface(
            "glass to air, inside",
            cylinder(INNER_RADIUS, WATER_LINE, HEIGHT, false),
            Some("glass"),
            None,
        )
        .interface("water to air", disc(INNER_RADIUS, 0.0, WATER_LINE, 1.0), None, Some("water"));
    let floor =
        compound(vec![cylinder(INNER_RADIUS, BASE, WATER_LINE, false), disc(INNER_RADIUS, 0.0, BASE, -1.0)]);
    kit.interface("glass to water", floor, Some("glass"), Some("water"));
}

fn cylinder(radius: f64, low: f64, high: f64, capped: bool) -> ShapeDescription {
    ShapeDescription::Cylinder { radius, y: [low, high], phi: [0.0, TAU], capped }
}

fn disc(radius: f64, inner_radius: f64, height: f64, up: f64) -> ShapeDescription {
    ShapeDescription::Disc { center: DVec3::Y * height, normal: DVec3::Y * up, radius, inner_radius }
}

fn compound(shapes: Vec<ShapeDescription>) -> ShapeDescription {
    let part = |shape| ShapePart { shape, placement: Transform::IDENTITY };
    ShapeDescription::Compound { parts: shapes.into_iter().map(part).collect() }
}

/// The same glass for the f64 tracer; 0 is no medium here.
pub fn traced_glass() -> Scene {
    let plane = |height: f64| Surface::Plane { point: DVec3::Y * height, normal: DVec3::Y };
    let wall = |radius: f64| Surface::Cone { radius, slope: 0.0 };
    let medium_at = |p: DVec3| {
        let r = DVec2::new(p.x, p.z).length();
        match (r < INNER_RADIUS && p.y > BASE, r < RADIUS && p.y > 0.0 && p.y < HEIGHT) {
            (true, _) if p.y < WATER_LINE => WATER,
            (false, true) => GLASS,
            _ => AIR,
        }
    };
    Scene {
        surfaces: vec![
            plane(0.0),
            plane(BASE),
            plane(WATER_LINE),
            plane(HEIGHT),
            wall(RADIUS),
            wall(INNER_RADIUS),
        ],
        medium_at: Box::new(medium_at),
        ior: vec![1.0, 1.0, 1.5, 1.333],
        size: HEIGHT,
        room: 6.0 * HEIGHT,
    }
}
