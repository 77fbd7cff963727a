//! Tests of all cameras: where pixels look, and how the lens is covered.

use super::*;
use hyaline_math::Vec3;
use hyaline_scene::FovAxis;
use hyaline_testkit::{Random, chi_square_square};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

const FOV: f64 = 1.0;
const HALF: Vec2 = Vec2::splat(0.5);

fn camera(projection: Projection, width: u32, height: u32) -> Camera {
    placed(Transform::IDENTITY, projection, width, height)
}

fn placed(placement: Transform, projection: Projection, width: u32, height: u32) -> Camera {
    let description = CameraDescription { name: "test".into(), placement, projection, medium: None };
    Camera::new(&description, width, height)
}

fn perspective(fov_axis: FovAxis) -> Projection {
    Projection::Perspective { fov: FOV, fov_axis }
}

fn thin_lens() -> Projection {
    Projection::ThinLens { fov: FOV, fov_axis: FovAxis::Y, lens_radius: 0.25, focus_distance: 3.0 }
}

fn all_projections() -> [Projection; 5] {
    [
        perspective(FovAxis::X),
        thin_lens(),
        Projection::Orthographic { height: 4.0 },
        Projection::Fisheye { fov: PI },
        Projection::Spherical { longitude: TAU, latitude: PI },
    ]
}

fn direction(camera: &Camera, x: f32, y: f32) -> Vec3 {
    camera.ray(Vec2::new(x, y), HALF).expect("the camera sees something there").direction
}

fn angle(a: Vec3, b: Vec3) -> f64 {
    let (a, b) = (a.as_dvec3(), b.as_dvec3());
    hyaline_math::float::f64::atan2(a.cross(b).length(), a.dot(b))
}

#[test]
fn every_camera_looks_along_its_axis_at_the_film_s_center() {
    for projection in all_projections() {
        let camera = camera(projection.clone(), 640, 480);
        let ray = camera.ray(Vec2::new(320.0, 240.0), HALF).unwrap();
        assert!((ray.direction - -Vec3::Z).length() < 1e-6, "{projection:?}");
        assert!(ray.origin.length() < 1e-6, "{projection:?}");
    }
}

#[test]
fn every_camera_shows_right_on_the_right_and_up_at_the_top() {
    for projection in all_projections() {
        let camera = camera(projection.clone(), 640, 480);
        let seen = |x: f32, y: f32| camera.ray(Vec2::new(x, y), HALF).unwrap().at(2.0);
        let center = seen(320.0, 240.0);
        assert!(seen(400.0, 240.0).x > center.x + 0.01, "{projection:?}");
        assert!((seen(400.0, 240.0).y - center.y).abs() < 1e-5, "{projection:?}");
        assert!(seen(320.0, 160.0).y > center.y + 0.01, "{projection:?}");
        assert!((seen(320.0, 160.0).x - center.x).abs() < 1e-5, "{projection:?}");
    }
}

#[test]
fn placement_turns_and_moves_every_camera_alike() {
    let (from, to) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-2.0, 1.0, 5.0));
    let placement = Transform::look_at(from, to, DVec3::Y).unwrap();
    for projection in all_projections() {
        let here = camera(projection.clone(), 640, 480).ray(Vec2::new(400.0, 200.0), HALF).unwrap();
        let there = placed(placement, projection, 640, 480).ray(Vec2::new(400.0, 200.0), HALF).unwrap();
        let moved = placement.point(here.origin.as_dvec3()).as_vec3();
        let turned = placement.vector(here.direction.as_dvec3()).as_vec3();
        assert!((there.origin - moved).length() < 1e-6);
        assert!((there.direction - turned).length() < 1e-6);
        assert!((there.direction.length() - 1.0).abs() < 1e-6);
    }
}

#[test]
fn the_field_of_view_spans_the_extent_it_is_given_for() {
    let cases: [(FovAxis, [f32; 2], [f32; 2]); 5] = [
        (FovAxis::X, [0.0, 120.0], [320.0, 120.0]),
        (FovAxis::Y, [160.0, 0.0], [160.0, 240.0]),
        (FovAxis::Diagonal, [0.0, 0.0], [320.0, 240.0]),
        (FovAxis::Smaller, [160.0, 0.0], [160.0, 240.0]),
        (FovAxis::Larger, [0.0, 120.0], [320.0, 120.0]),
    ];
    for (axis, a, b) in cases {
        let wide = camera(perspective(axis), 320, 240);
        let spanned = angle(direction(&wide, a[0], a[1]), direction(&wide, b[0], b[1]));
        assert!((spanned - FOV).abs() < 1e-6, "{axis:?} spans {spanned}");
    }
    // On a film that stands upright, the smaller extent is the width.
    let tall = camera(perspective(FovAxis::Smaller), 240, 320);
    let spanned = angle(direction(&tall, 0.0, 160.0), direction(&tall, 240.0, 160.0));
    assert!((spanned - FOV).abs() < 1e-6);
}

#[test]
fn perspective_corners_lie_where_the_tangent_puts_them() {
    let camera = camera(perspective(FovAxis::Y), 320, 200);
    let t = hyaline_math::float::tan(0.5);
    let expected = Vec3::new(-1.6 * t, t, -1.0).normalize();
    assert!((direction(&camera, 0.0, 0.0) - expected).length() < 1e-6);
    let expected = Vec3::new(1.6 * t, -t, -1.0).normalize();
    assert!((direction(&camera, 320.0, 200.0) - expected).length() < 1e-6);
}

#[test]
fn all_rays_of_a_lens_meet_in_the_plane_of_focus() {
    let lens = camera(thin_lens(), 320, 240);
    let pinhole = camera(perspective(FovAxis::Y), 320, 240);
    let mut random = Random::from_seed(1);
    for film in [Vec2::new(160.0, 120.0), Vec2::new(3.5, 200.25), Vec2::new(320.0, 0.0)] {
        let sharp = direction(&pinhole, film.x, film.y);
        let focus = sharp * (3.0 / -sharp.z);
        for _ in 0..1000 {
            let u = Vec2::new(random.uniform_f32(), random.uniform_f32());
            let ray = lens.ray(film, u).unwrap();
            assert!(ray.origin.z == 0.0 && ray.origin.length() <= 0.25 * 1.000_001);
            let reached = ray.at(3.0 / -ray.direction.z);
            assert!((reached - focus).length() < 2e-6, "{film} {u}: {reached} for {focus}");
        }
    }
}

#[test]
fn lens_points_are_uniform_on_the_disc() {
    let lens = camera(thin_lens(), 320, 240);
    let mut random = Random::from_seed(2);
    let sample = || {
        let u = Vec2::new(random.uniform_f32(), random.uniform_f32());
        let p = lens.ray(Vec2::new(20.0, 30.0), u).unwrap().origin.as_dvec3() / 0.25;
        let azimuth = hyaline_math::float::f64::atan2(p.y, p.x);
        [(p.x * p.x + p.y * p.y).min(1.0), (azimuth / TAU + 0.5).clamp(0.0, 1.0)]
    };
    let result = chi_square_square(sample, |_| 1.0, 100_000, 20, 24);
    assert!(result.p_value > 1e-3, "{result:?}");
}

#[test]
fn parallel_rays_are_parallel_and_their_origins_span_the_height() {
    let camera = camera(Projection::Orthographic { height: 4.0 }, 300, 200);
    let ray = |x: f32, y: f32| camera.ray(Vec2::new(x, y), HALF).unwrap();
    for (film, origin) in
        [([0.0, 0.0], [-3.0, 2.0]), ([300.0, 200.0], [3.0, -2.0]), ([150.0, 50.0], [0.0, 1.0])]
    {
        let ray = ray(film[0], film[1]);
        assert_eq!(ray.direction, -Vec3::Z);
        assert!((ray.origin - Vec3::new(origin[0], origin[1], 0.0)).length() < 1e-6);
    }
}

#[test]
fn fisheye_angles_grow_with_the_distance_from_the_center() {
    let fov = 1.5 * PI;
    let camera = camera(Projection::Fisheye { fov }, 300, 200);
    for (x, y) in [(0.0, 0.0), (25.0, 0.0), (0.0, -50.0), (-60.0, 45.0), (70.0, 71.0)] {
        let seen = direction(&camera, 150.0 + x, 100.0 + y);
        let expected = f64::from((x * x + y * y).sqrt()) / 100.0 * 0.5 * fov;
        assert!((angle(seen, -Vec3::Z) - expected).abs() < 1e-6, "({x}, {y})");
        // The azimuth about the axis is the film's.
        assert!((seen.x * -y - seen.y * x).abs() < 1e-4);
        assert!(seen.x * x >= 0.0 && seen.y * -y >= 0.0);
    }
}

#[test]
fn a_fisheye_is_black_outside_its_circle() {
    let camera = camera(Projection::Fisheye { fov: PI }, 300, 200);
    let sees = |x: f32, y: f32| camera.ray(Vec2::new(x, y), HALF).is_some();
    assert!(sees(249.0, 100.0) && sees(150.0, 1.0));
    assert!(!sees(251.0, 100.0) && !sees(230.0, 180.0) && !sees(0.0, 0.0));
}

#[test]
fn a_spherical_camera_is_linear_in_longitude_and_latitude() {
    let camera = camera(Projection::Spherical { longitude: TAU, latitude: PI }, 400, 200);
    assert!((direction(&camera, 300.0, 100.0) - Vec3::X).length() < 1e-6);
    assert!((direction(&camera, 100.0, 100.0) - -Vec3::X).length() < 1e-6);
    assert!((direction(&camera, 0.0, 100.0) - Vec3::Z).length() < 1e-6);
    assert!((direction(&camera, 77.0, 0.0) - Vec3::Y).length() < 1e-6);
    for i in 0..40 {
        for j in 0..20 {
            let d = direction(&camera, i as f32 * 10.0 + 5.0, j as f32 * 10.0 + 5.0).as_dvec3();
            let longitude = hyaline_math::float::f64::atan2(d.x, -d.z);
            let latitude = hyaline_math::float::f64::atan2(d.y, d.x.hypot(d.z));
            assert!((longitude - (f64::from(i) - 19.5) / 40.0 * TAU).abs() < 1e-6);
            assert!((latitude - (9.5 - f64::from(j)) / 20.0 * PI).abs() < 1e-6);
        }
    }
}

#[test]
fn a_patch_of_the_sphere_ends_where_its_angles_say() {
    let camera = camera(Projection::Spherical { longitude: PI, latitude: FRAC_PI_2 }, 400, 200);
    assert!((direction(&camera, 400.0, 100.0) - Vec3::X).length() < 1e-6);
    assert!((angle(direction(&camera, 200.0, 0.0), -Vec3::Z) - FRAC_PI_4).abs() < 1e-6);
}

#[test]
fn spread_is_the_distance_between_neighboring_pixels() {
    for projection in all_projections() {
        let camera = camera(projection.clone(), 640, 480);
        let at = |x: f32, y: f32| camera.ray(Vec2::new(x, y), HALF).unwrap().at(2.0);
        let across = (at(321.0, 240.0) - at(320.0, 240.0)).length();
        let down = (at(320.0, 241.0) - at(320.0, 240.0)).length();
        let width = camera.spread().width_at(2.0);
        assert!((across.max(down) / width - 1.0).abs() < 2e-3, "{projection:?}: {across} for {width}");
    }
}

#[test]
fn an_empty_film_is_no_reason_to_panic() {
    for projection in all_projections() {
        assert!(camera(projection, 0, 0).ray(HALF, HALF).is_some());
    }
}
