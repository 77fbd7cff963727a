//! Rays traced through balls and prisms against geometrical optics.

mod by_hand;
mod following;
mod scene_kit;

use by_hand::reflected;
use following::{Way, follow, ray};
use hyaline_math::DVec3;
use hyaline_math::float::f64 as float;
use hyaline_scene::{MeshData, ShapeDescription};
use hyaline_spectrum::catalogue;
use hyaline_world::World;
use scene_kit::*;
use std::f64::consts::PI;
use std::sync::Arc;

fn ball(n: f64, radius: f64) -> World {
    let mut kit = SceneKit::new();
    kit.camera(DVec3::Z * 5.0 * radius, DVec3::ZERO);
    kit.medium("ball", n).solid("ball", sphere(DVec3::ZERO, radius), "ball");
    kit.world()
}

#[test]
fn a_ball_lens_has_its_focus_half_a_radius_behind_it() {
    for radius in [0.004, 1.0, 250.0] {
        let world = ball(1.5, radius);
        for h in [0.02_f64, 0.1, 0.3, 0.6, 0.9, 0.99] {
            let incoming = ray(DVec3::new(h * radius, 0.0, 3.0 * radius), -DVec3::Z);
            let out = follow(&world, incoming, &[Way::Transmit, Way::Transmit]).unwrap();
            let crossing = out.origin - out.direction * (out.origin.x / out.direction.x);
            // The ray is turned by i - r at each surface, and passes the center at the distance h again.
            let turn = 2.0 * (float::asin(h) - float::asin(h / 1.5));
            let expected = h / float::sin(turn);
            let got = -crossing.z / radius;
            assert!((got - expected).abs() < 1e-5 / h, "height {h}: focus at {got}, expected {expected}");
            assert!(crossing.y.abs() < 1e-6 * radius);
            if h < 0.05 {
                assert!((got - 1.5).abs() < 1e-3, "near the axis the focus is at {got} R");
            }
        }
    }
}

/// A prism along z, its cross section an equilateral triangle about the origin with the apex up.
fn prism() -> ShapeDescription {
    let corner = |i: u32, z: f32| {
        let (sin, cos) = float::sin_cos(PI * (0.5 + 2.0 * f64::from(i) / 3.0));
        [cos as f32, sin as f32, z]
    };
    let positions = [-3.0, 3.0].into_iter().flat_map(|z| (0..3).map(move |i| corner(i, z))).collect();
    let mut triangles = vec![[0, 2, 1], [3, 4, 5]];
    for (a, b) in [(0, 1), (1, 2), (2, 0)] {
        triangles.extend([[a, b, b + 3], [a, b + 3, a + 3]]);
    }
    let mesh = MeshData { positions, triangles, ..MeshData::default() };
    ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: true }
}

#[test]
fn a_prism_deviates_least_where_light_passes_it_symmetrically() {
    let (n, apex): (f64, f64) = (1.5168, PI / 3.0);
    let mut kit = SceneKit::new();
    kit.camera(DVec3::new(0.0, 0.0, 20.0), DVec3::ZERO);
    kit.medium("glass", n).solid("prism", prism(), "glass");
    let world = kit.world();
    // The left face, its outward normal, and a tangent towards the apex.
    let normal = DVec3::new(-float::cos(PI / 6.0), float::sin(PI / 6.0), 0.0);
    let tangent = DVec3::new(0.5, float::cos(PI / 6.0), 0.0);
    let deviation = |incidence: f64| {
        let (sin, cos) = float::sin_cos(incidence);
        let direction = tangent * sin - normal * cos;
        let face = normal * 0.5;
        let out = follow(&world, ray(face - direction * 2.0, direction), &[Way::Transmit, Way::Transmit])?;
        // By Snell's law at both faces.
        let inside = float::asin(sin / n);
        let leaving = float::asin(n * float::sin(apex - inside));
        let angle = float::acos(out.direction.dot(direction));
        assert!((angle - (incidence + leaving - apex)).abs() < 2e-6, "incidence {incidence}: {angle}");
        Some((angle, incidence))
    };
    let tested: Vec<(f64, f64)> =
        (0..=400).filter_map(|i| deviation((38.0 + 0.05 * f64::from(i)).to_radians())).collect();
    assert_eq!(tested.len(), 401);
    let (least, at) = tested.iter().copied().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let expected = 2.0 * float::asin(n * float::sin(apex / 2.0)) - apex;
    assert!((expected.to_degrees() - 38.65).abs() < 0.005);
    assert!((least - expected).abs() < 2e-6, "{} for {}", least.to_degrees(), expected.to_degrees());
    // Symmetry: light passes parallel to the base, at an incidence of asin(n sin(A / 2)). The minimum is flat.
    assert!((at - float::asin(n * float::sin(apex / 2.0))).abs() < 0.02);
}

/// Angle of the primary rainbow from the antisolar point, degrees, traced: the largest over all impact parameters.
fn rainbow(n: f64) -> f64 {
    let world = ball(n, 1.0);
    let ways = [Way::Transmit, Way::Reflect, Way::Transmit];
    let angle = |b: f64| {
        let out = follow(&world, ray(DVec3::new(b, 0.0, 4.0), -DVec3::Z), &ways).unwrap();
        // Sunlight travels along -z, the way to the antisolar point; the drop is seen in the direction -out.
        float::acos((-out.direction).dot(-DVec3::Z)).to_degrees()
    };
    (0..=2000).map(|i| angle(0.75 + 0.0001 * f64::from(i))).fold(0.0, f64::max)
}

#[test]
fn the_primary_rainbow_stands_at_42_degrees() {
    let bow = rainbow(1.333);
    assert!((bow - 42.08).abs() < 0.01, "the bow is at {bow}°");
}

#[test]
fn the_rainbow_is_red_outside_and_violet_inside() {
    let water = catalogue::index_by_name("water").unwrap();
    let (red, violet) = (rainbow(water.index(700.0)), rainbow(water.index(400.0)));
    assert!((red - violet - 1.7).abs() < 0.2, "red at {red}°, violet at {violet}°");
    assert!((red - 42.4).abs() < 0.1 && (violet - 40.6).abs() < 0.1, "red at {red}°, violet at {violet}°");
}

#[test]
fn a_smooth_surface_reflects_by_the_table_of_fresnel() {
    // physics: the angle of incidence, and the fraction reflected by indices 1.5, 1.333 and 2.42.
    let table = [
        (0.0_f64, [0.04, 0.02037319, 0.17239492]),
        (30.0, [0.04152263, 0.02143647, 0.17388297]),
        (45.0, [0.05023991, 0.02789836, 0.18152106]),
        (60.0, [0.08918671, 0.05969092, 0.21159757]),
        (75.0, [0.25306056, 0.21237758, 0.33062717]),
        (85.0, [0.61279965, 0.58352348, 0.62162162]),
        (89.9, [0.98991188, 0.98906762, 0.98922756]),
    ];
    for (column, n) in [1.5, 1.333, 2.42].into_iter().enumerate() {
        let world = dark_block(n);
        for (degrees, expected) in table {
            let (sin, cos) = float::sin_cos(degrees.to_radians());
            assert!((reflected(cos, n) - expected[column]).abs() < 1e-7);
            let incoming = ray(DVec3::new(-sin, cos, 0.0), DVec3::new(sin, -cos, 0.0));
            let moments = estimate(&world, incoming, 40_000);
            assert_mean(&moments, expected[column], &format!("n = {n} at {degrees}°"));
            // Near grazing the cosine of a direction in f32 is worth four digits.
            let way = follow(&world, incoming, &[Way::Reflect]).unwrap();
            assert!((way.weight - expected[column]).abs() < 1e-5, "n = {n} at {degrees}°: {}", way.weight);
        }
    }
}

#[test]
fn half_the_light_vanishes_at_the_angle_of_brewster() {
    let angle = float::atan2(1.5, 1.0);
    assert!((angle.to_degrees() - 56.3099).abs() < 1e-4);
    let (sin, cos) = float::sin_cos(angle);
    let incoming = ray(DVec3::new(-sin, cos, 0.0), DVec3::new(sin, -cos, 0.0));
    // r_par = 0; what is left is half the square of r_perp = (1 - n²) / (1 + n²).
    let expected = 0.5 * (1.25_f64 / 3.25).powi(2);
    let world = dark_block(1.5);
    assert_mean(&estimate(&world, incoming, 200_000), expected, "Brewster");
    assert!((follow(&world, incoming, &[Way::Reflect]).unwrap().weight - expected).abs() < 1e-6);
    // The refracted ray is at right angles to the reflected one.
    let bent = follow(&world, incoming, &[Way::Transmit]).unwrap().direction;
    assert!(bent.dot(DVec3::new(sin, cos, 0.0)).abs() < 1e-6);
}

/// A block below y = 0 that swallows all that enters it, under a sky of radiance 1.
fn dark_block(n: f64) -> World {
    let mut kit = SceneKit::new();
    kit.camera(DVec3::Y, DVec3::ZERO).sky(1.0);
    let block = cuboid(DVec3::new(-50.0, -50.0, -50.0), DVec3::new(50.0, 0.0, 50.0));
    kit.absorbing_medium("ink", n, [100.0; 3], 0).solid("block", block, "ink");
    kit.world()
}
