//! Placed shapes: error bounds over scales and distances, rays that leave a surface, areas and densities.

use super::*;
use crate::shape::{Rectangle, RevolvedArc, RevolvedSegment, Sphere, WHOLE_TURN};
use hyaline_math::{DMat3, offset_origin};
use hyaline_testkit::{Random, chi_square};
use std::f64::consts::{FRAC_PI_2, PI};

fn shapes() -> Vec<Shape> {
    let part = [0.3, 2.8];
    vec![
        Shape::Sphere(Sphere::new(1.0).unwrap()),
        Shape::Sphere(Sphere::part(0.7, part, [0.4, 2.0]).unwrap()),
        Shape::Segment(RevolvedSegment::cylinder(0.5, [-0.5, 1.0], WHOLE_TURN).unwrap()),
        Shape::Segment(RevolvedSegment::cone(0.8, 1.1, part).unwrap()),
        Shape::Segment(RevolvedSegment::disc(1.0, 0.3, 0.2, WHOLE_TURN).unwrap()),
        Shape::Arc(RevolvedArc::torus(1.0, 0.3, WHOLE_TURN, WHOLE_TURN).unwrap()),
        Shape::Arc(RevolvedArc::torus(0.9, 0.02, [0.0, PI], part).unwrap()),
        Shape::Rectangle(
            Rectangle::new(DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.5, 0.1, 0.0), DVec3::new(0.0, 0.3, 0.4))
                .unwrap(),
        ),
    ]
}

fn random_rotation(random: &mut Random) -> Transform {
    Transform::rotate(random.direction().into(), random.between(0.0, 6.0)).unwrap()
}

fn similarity(random: &mut Random, scale: f64, offset: f64) -> Transform {
    let scaled = Transform::scale(DVec3::splat(scale)).unwrap();
    Transform::translate(DVec3::from(random.direction()) * offset)
        .after(&random_rotation(random).after(&scaled))
}

/// A stretched, sheared, turned and perhaps mirrored map.
fn uneven(random: &mut Random) -> Transform {
    let linear = DMat3::from_cols(
        DVec3::new(random.between(0.5, 2.0), random.between(-0.3, 0.3), 0.2),
        DVec3::new(random.between(-0.3, 0.3), random.between(0.3, 1.0), -0.2),
        DVec3::new(0.1, random.between(-0.3, 0.3), random.between(0.5, 1.5)),
    );
    let mirror = if random.uniform() < 0.5 { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
    Transform::from_parts(DMat3::from_diagonal(mirror) * linear, DVec3::new(0.3, -0.2, 0.5)).unwrap()
}

fn primitive(shape: Shape, transform: Transform) -> Primitive {
    Primitive { transform, ..Primitive::new(shape) }
}

/// A ray from `distance` away to somewhere near a random surface point.
fn random_ray(random: &mut Random, primitive: &Primitive, distance: f64, blur: f64) -> Ray {
    let target = primitive.shape.sample_area(DVec2::new(random.uniform(), random.uniform())).0;
    let target = primitive.transform.point(target + DVec3::from(random.direction()) * blur);
    let direction = DVec3::from(random.direction()).as_vec3().normalize();
    Ray::new((target - direction.as_dvec3() * distance).as_vec3(), direction)
}

/// Distance of a world point from the unbounded surface, for maps that scale evenly.
fn true_distance(primitive: &Primitive, p: Vec3, scale: f64) -> f64 {
    let p = primitive.transform.inverse_point(p.as_dvec3());
    p.distance(primitive.shape.surface_at(p).p) * scale
}

#[test]
fn the_error_bound_holds_over_scales_and_distances() {
    let mut random = Random::from_seed(1);
    let mut hits = 0;
    for scale in [1e-3, 1e-2, 1.0, 30.0, 1e4] {
        for (offset, distance) in [(0.0, 2.0), (0.5, 300.0), (10.0, 3.0), (1000.0, 1.0), (0.0, 1e4)] {
            for shape in shapes() {
                let primitive = primitive(shape, similarity(&mut random, scale, offset * scale));
                for _ in 0..200 {
                    let ray = random_ray(&mut random, &primitive, distance * scale, 0.05);
                    let mut found = Vec::new();
                    primitive.crossings(&ray, &mut |t| found.push(t));
                    assert_eq!(primitive.closest(&ray), found.first().copied());
                    for t in found {
                        let hit = primitive.surface_at(&ray, t);
                        let error = true_distance(&primitive, hit.p, scale);
                        assert!(error <= f64::from(hit.p_error), "{error:e} > {:e}", hit.p_error);
                        let magnitude = f64::from(hit.p.length()) + 3.0 * scale * f64::EPSILON;
                        assert!(f64::from(hit.p_error) < 4.0 * f64::from(f32::EPSILON) * magnitude);
                        let along = (hit.p.as_dvec3() - ray.origin.as_dvec3()).dot(ray.direction.as_dvec3());
                        assert!(
                            (along - f64::from(t)).abs() < 2e-6 * (f64::from(t) + scale * (1.0 + offset))
                        );
                        hits += 1;
                    }
                }
            }
        }
    }
    assert!(hits > 20_000, "{hits}");
}

#[test]
fn distances_are_strictly_within_the_interval() {
    let mut random = Random::from_seed(2);
    let mut tested = 0;
    for shape in shapes() {
        let primitive = primitive(shape, similarity(&mut random, 0.1, 0.2));
        for _ in 0..2_000 {
            let ray = random_ray(&mut random, &primitive, 0.7, 0.0);
            let mut found = Vec::new();
            primitive.crossings(&ray, &mut |t| found.push(t));
            for (i, &t) in found.iter().enumerate() {
                let before = primitive.closest(&Ray { t_max: t, ..ray });
                assert_eq!(before, found[..i].first().copied().filter(|x| *x < t));
                let after = primitive.closest(&Ray { t_min: t, ..ray });
                assert_eq!(after, found[i + 1..].iter().copied().find(|x| *x > t));
                tested += 1;
            }
        }
    }
    assert!(tested > 10_000);
}

#[test]
fn a_ray_that_leaves_a_surface_does_not_meet_it_at_the_same_place() {
    let mut random = Random::from_seed(3);
    for scale in [1e-3, 1.0, 1e3] {
        for offset in [0.0, 1.0, 100.0] {
            for shape in shapes() {
                let primitive = primitive(shape, similarity(&mut random, scale, offset * scale));
                for _ in 0..1_000 {
                    let ray = random_ray(&mut random, &primitive, 2.0 * scale, 0.0);
                    let Some(t) = primitive.closest(&ray) else { continue };
                    let hit = primitive.surface_at(&ray, t);
                    let direction = DVec3::from(random.direction()).as_vec3().normalize();
                    let next = Ray::new(offset_origin(hit.p, hit.p_error, hit.ng, direction), direction);
                    let Some(again) = primitive.closest(&next) else { continue };
                    // Chords of these shapes are at least this long, by their least radius of curvature.
                    let cosine = direction.dot(hit.ng).abs();
                    let chord = 2.0 * scale as f32 * 0.02 * cosine;
                    let blur = 40.0 * f32::EPSILON * hit.p.length();
                    assert!(
                        cosine < 0.02 || again > 0.9 * chord - blur,
                        "{again} after {cosine} at {scale} {offset}"
                    );
                }
            }
        }
    }
}

#[test]
fn normals_point_outward_under_any_map() {
    let mut random = Random::from_seed(4);
    for _ in 0..2_000 {
        let transform = uneven(&mut random);
        let ball = primitive(Shape::Sphere(Sphere::new(1.0).unwrap()), transform);
        let center = transform.translation().as_vec3();
        let ray = random_ray(&mut random, &ball, 9.0, 0.0);
        let Some(t) = ball.closest(&ray) else { continue };
        let hit = ball.surface_at(&ray, t);
        assert!(hit.ng.dot(hit.p - center) > 0.0 && hit.ng.dot(ray.direction) < 1e-3);
        let inner = Primitive { flipped: true, ..ball }.surface_at(&ray, t);
        assert_eq!(inner.ng, -hit.ng);
        let tangents = ball.tangents(hit.p);
        assert!((hit.ng.length() - 1.0).abs() < 1e-6 && tangents.dpdu.normalize().dot(hit.ng).abs() < 1e-6);
        assert!(tangents.dpdv.normalize().dot(hit.ng).abs() < 1e-6);
        assert_eq!(hit.n, hit.ng);
        let sample = ball.sample_area(Vec2::new(random.uniform_f32(), random.uniform_f32()));
        assert!(sample.n.dot(sample.p - center) > 0.0);
    }
}

#[test]
fn bounds_hold_every_hit_and_are_tight() {
    let mut random = Random::from_seed(5);
    for shape in shapes() {
        for _ in 0..20 {
            let primitive = primitive(shape, uneven(&mut random));
            let bounds = primitive.bounds();
            let mut seen = Bounds::EMPTY;
            for _ in 0..4_000 {
                let p = primitive.sample_area(Vec2::new(random.uniform_f32(), random.uniform_f32())).p;
                assert!(p.cmpge(bounds.min).all() && p.cmple(bounds.max).all());
                seen = seen.including(p);
            }
            assert!((bounds.size() - seen.size()).max_element() < 0.25 * bounds.size().max_element());
        }
    }
}

#[test]
fn world_areas_are_those_of_closed_forms() {
    let ball = Shape::Sphere(Sphere::new(1.0).unwrap());
    let spheroid = primitive(ball, Transform::scale(DVec3::new(1.0, 2.0, 1.0)).unwrap());
    let e = 0.75_f64.sqrt();
    let expected = 2.0 * PI * (1.0 + 2.0 / e * hyaline_math::float::f64::asin(e));
    assert!((spheroid.area() / expected - 1.0).abs() < 1e-8);
    let turned = primitive(ball, Transform::scale(DVec3::new(1.0, 1.0, 2.0)).unwrap());
    assert!((turned.area() / expected - 1.0).abs() < 1e-6, "{}", turned.area() / expected);
    let half = primitive(ball, Transform::scale(DVec3::splat(0.5)).unwrap());
    assert!((half.area() - PI).abs() < 1e-12);
    let disc = Shape::Segment(RevolvedSegment::disc(1.0, 0.0, 0.0, WHOLE_TURN).unwrap());
    let ellipse = primitive(disc, Transform::scale(DVec3::new(3.0, 7.0, 0.5)).unwrap());
    assert!((ellipse.area() - 1.5 * PI).abs() < 1e-9);
    let square = Shape::Rectangle(Rectangle::new(DVec3::ZERO, DVec3::X, DVec3::Z).unwrap());
    let parallelogram = primitive(square, Transform::scale(DVec3::new(3.0, 7.0, 0.5)).unwrap());
    assert!((parallelogram.area() - 6.0).abs() < 1e-9);
}

#[test]
fn sampled_densities_add_up_to_the_area_under_uneven_maps() {
    let mut random = Random::from_seed(6);
    for shape in shapes() {
        let primitive = primitive(shape, uneven(&mut random));
        let area = primitive.area();
        let mut inverse_density = 0.0;
        let count = 40_000;
        // Summed over the samples in an octant, 1/pdf over their number is the area there, which lines measure too.
        let middle = primitive.bounds().center();
        let cell = |p: Vec3| (0..3).map(|i| usize::from(p[i] > middle[i]) << i).sum::<usize>();
        let mut areas = [0.0; 8];
        for _ in 0..count {
            let sample = primitive.sample_area(Vec2::new(random.uniform_f32(), random.uniform_f32()));
            assert!(sample.pdf_a > 0.0 && sample.pdf_a.is_finite());
            areas[cell(sample.p)] += 1.0 / f64::from(sample.pdf_a) / f64::from(count);
            inverse_density += 1.0 / f64::from(sample.pdf_a) / f64::from(count);
        }
        assert!((inverse_density / area - 1.0).abs() < 0.02);
        let measured = octant_areas(&primitive, &mut random, cell);
        for (found, expected) in areas.iter().zip(measured) {
            assert!((found - expected).abs() < 0.03 * area, "{found} {expected} of {area}");
        }
    }
}

/// World area in each cell by Cauchy's formula: random lines meet a surface in proportion to its area.
fn octant_areas(primitive: &Primitive, random: &mut Random, cell: impl Fn(Vec3) -> usize) -> [f64; 8] {
    let bounds = primitive.bounds();
    let (center, radius) = (bounds.center(), bounds.radius());
    let count = 400_000;
    let mut areas = [0.0; 8];
    for _ in 0..count {
        let d = DVec3::from(random.direction()).as_vec3();
        let frame = hyaline_math::Frame::from_normal(d);
        let (a, b) = loop {
            let (a, b) = (random.between(-1.0, 1.0) as f32, random.between(-1.0, 1.0) as f32);
            if a * a + b * b < 1.0 {
                break (a, b);
            }
        };
        let ray = Ray::new(center + radius * (frame.s * a + frame.t * b - 2.0 * d), d);
        // Mean crossings per unit of line density are half the area.
        primitive.crossings(&ray, &mut |t| {
            areas[cell(ray.at(t))] += 2.0 * PI * f64::from(radius).powi(2) / f64::from(count);
        });
    }
    areas
}

#[test]
fn samples_of_a_stretched_cylinder_pass_chi_square() {
    // Stretched along its axis a cylinder stays uniform; stretched across, the density follows the ellipse's arc.
    let shape = Shape::Segment(RevolvedSegment::cylinder(1.0, [0.0, 1.0], WHOLE_TURN).unwrap());
    let primitive = primitive(shape, Transform::scale(DVec3::new(3.0, 2.0, 1.0)).unwrap());
    let mut random = Random::from_seed(7);
    let (n, count) = (32, 100_000);
    let mut observed = vec![0.0; n];
    let mut expected = vec![0.0; n];
    let at = |phi: f64| {
        let (sin, cos) = hyaline_math::float::f64::sin_cos(phi);
        Vec3::new(3.0 * sin as f32, 0.0, cos as f32)
    };
    let step = 4.0 * FRAC_PI_2 / n as f64;
    for _ in 0..count {
        let sample = primitive.sample_area(Vec2::new(random.uniform_f32(), random.uniform_f32()));
        let phi = hyaline_math::float::f64::atan2(f64::from(sample.p.x) / 3.0, sample.p.z.into());
        let i = ((phi.rem_euclid(4.0 * FRAC_PI_2) / step) as usize).min(n - 1);
        observed[i] += 1.0;
        // The density is constant along the axis: a strip's chance is density × strip's area, averaged over the strip.
        let (a, b) = (at(phi - 1e-3), at(phi + 1e-3));
        let speed = f64::from(a.distance(b)) / 2e-3;
        let chance = f64::from(sample.pdf_a) * speed * 2.0 * step;
        assert!((chance * n as f64 - 1.0).abs() < 1e-3, "{chance}");
    }
    expected.fill(f64::from(count) / n as f64);
    let result = chi_square(&observed, &expected, 5.0);
    assert!(result.p_value > 1e-3, "{result:?}");
}

#[test]
fn placing_twice_is_placing_by_the_product() {
    let mut random = Random::from_seed(8);
    let (a, b) = (uneven(&mut random), uneven(&mut random));
    let twice = primitive(shapes()[5], a).placed(&b);
    let p = DVec3::new(0.3, 0.4, 0.5);
    assert!(twice.transform.point(p).distance(b.point(a.point(p))) < 1e-12);
}
