//! The bounds behind the maps: what is drawn from a cell lies within the beam that the cell is judged by.

use super::ball::{Ball, merged};
use super::beam::Beam;
use super::grid::Grid;
use super::*;
use hyaline_geometry::mesh::{MeshData, generate};
use hyaline_geometry::shape::{RevolvedArc, RevolvedSegment, Sphere, WHOLE_TURN};
use hyaline_geometry::{Mesh, Primitive, Shape, bvh::MeshBvh};
use hyaline_math::{DVec2, DVec3, Frame, Transform};
use hyaline_scene::SpotFalloff;
use hyaline_testkit::Random;
use hyaline_world::light::{
    Cone, DiscPatch, PointLight, ProjectorLight, ShapeLight, ShiningSides, Slide, SpotLight, UnitBox,
};
use std::f64::consts::PI;
use std::sync::Arc;

fn pair(random: &mut Random) -> Vec2 {
    Vec2::new(random.uniform_f32(), random.uniform_f32())
}

fn vector(random: &mut Random) -> DVec3 {
    DVec3::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-2.0, 2.0))
}

/// A box of a grid of halves, quarters, …
fn random_box(random: &mut Random) -> UnitBox {
    let size = f64::from(1 << (random.bits() % 7));
    let cell = DVec2::new((random.uniform() * size).floor(), (random.uniform() * size).floor());
    UnitBox { min: cell / size, max: (cell + 1.0) / size }
}

fn holds(cone: &Cone, direction: Vec3) -> bool {
    let half_chord = 0.5 * cone.axis.distance(direction.as_dvec3().normalize());
    2.0 * hyaline_math::float::f64::asin(half_chord) <= cone.half_angle
}

#[test]
fn directions_of_a_box_lie_in_its_cone() {
    let spot = |outer: f32, inner: f32| {
        let axis = Vec3::new(0.48, -0.6, 0.64);
        Light::Spot(SpotLight::new(Vec3::ONE, axis, Spectrum::ONE, outer, inner, SpotFalloff::Smooth))
    };
    let point = Light::Point(PointLight { position: Vec3::ONE, intensity: Spectrum::ONE });
    let mut random = Random::from_seed(1);
    let pixels = (0..9 * 6).map(|i| Spectrum::splat(if i % 4 == 0 { 0.0 } else { random.uniform_f32() }));
    let slide = Slide::new(9, 6, pixels.collect(), 3);
    let place = Transform::rotate(DVec3::new(1.0, 2.0, -0.5), 0.8).unwrap();
    let projector = Light::Projector(ProjectorLight::new(&place, 1.4, Spectrum::ONE, slide));
    let mut widths = 0.0;
    for light in [point, projector, spot(0.6, 0.3), spot(2.9, 0.0), spot(0.02, 0.02)] {
        for _ in 0..3000 {
            let unit_box = random_box(&mut random);
            let cone = light.cone_of_emission(&unit_box);
            widths += cone.half_angle;
            for _ in 0..6 {
                let u = unit_box.at(pair(&mut random).as_dvec2()).as_vec2();
                if let Some(sample) = light.sample_emission(Vec2::ZERO, u) {
                    assert!(holds(&cone, sample.direction), "{unit_box:?} {cone:?} {}", sample.direction);
                }
            }
        }
    }
    assert!(widths < 15_000.0 * 1.0, "cones about everything would pass, too: {widths}");
}

#[test]
fn directions_from_a_surface_lie_in_the_cone_of_their_box() {
    let flat = Primitive::new(Shape::Sphere(Sphere::new(1.0).unwrap()));
    let mut random = Random::from_seed(2);
    for sides in [ShiningSides::Outer, ShiningSides::Both] {
        let light = Light::Shape(ShapeLight::new(flat, Spectrum::ONE, sides));
        for _ in 0..4000 {
            let unit_box = random_box(&mut random);
            let sample = flat.sample_area(pair(&mut random));
            let frame = Frame::from_normal(sample.n);
            let cone = light.cone_at(&frame, &unit_box);
            for _ in 0..6 {
                let u = unit_box.at(pair(&mut random).as_dvec2()).as_vec2();
                let emission = light.emission_at(&sample, &frame, u).unwrap();
                assert!(holds(&cone, emission.direction), "{unit_box:?} {cone:?} {}", emission.direction);
            }
        }
    }
}

#[test]
fn points_of_the_disc_lie_in_the_disc_of_their_box() {
    let mut random = Random::from_seed(3);
    let mut areas = 0.0;
    for _ in 0..5000 {
        let unit_box = random_box(&mut random);
        let (center, radius) = DiscPatch::of_box(&unit_box).disc();
        areas += radius;
        for _ in 0..6 {
            let u = unit_box.at(pair(&mut random).as_dvec2()).as_vec2();
            let q = hyaline_sampling::warp::sample_disc(u).as_dvec2();
            assert!(q.distance(center) <= radius, "{unit_box:?}: {q} for {center} {radius}");
        }
    }
    assert!(areas < 5000.0 * 0.5, "discs about everything would pass, too: {areas}");
}

fn shapes() -> Vec<Primitive> {
    let turn = Transform::rotate(DVec3::new(1.0, 2.0, -0.5), 0.8).unwrap();
    let even = turn.after(&Transform::scale(DVec3::splat(1.7)).unwrap());
    let uneven = turn.after(&Transform::scale(DVec3::new(1.0, -0.5, 0.8)).unwrap());
    let rectangle =
        hyaline_geometry::shape::Rectangle::new(DVec3::X, DVec3::X * 2.0, DVec3::new(0.3, 0.5, 0.0));
    let shapes = [
        Shape::Sphere(Sphere::new(0.7).unwrap()),
        Shape::Sphere(Sphere::part(0.8, [1.0, 4.0], [0.5, 2.5]).unwrap()),
        Shape::Rectangle(rectangle.unwrap()),
        Shape::Segment(RevolvedSegment::disc(0.7, 0.0, 0.3, WHOLE_TURN).unwrap()),
        Shape::Segment(RevolvedSegment::cylinder(0.4, [-0.5, 1.5], [0.3, 4.0]).unwrap()),
        Shape::Arc(RevolvedArc::torus(0.7, 0.25, WHOLE_TURN, WHOLE_TURN).unwrap()),
        Shape::Arc(RevolvedArc::torus(0.5, 0.5, WHOLE_TURN, [1.0, 5.0]).unwrap()),
    ];
    let placements = [Transform::IDENTITY, even, uneven];
    shapes.iter().flat_map(|&s| placements.map(|placement| Primitive::new(s).placed(&placement))).collect()
}

#[test]
fn places_of_a_part_of_a_shape_lie_in_its_ball_and_their_normals_in_its_cone() {
    let mut random = Random::from_seed(4);
    for primitive in shapes() {
        let whole = f64::from(primitive.bounds().radius());
        for count in [1, 2, 7, 64] {
            let parts = patch::cut(&primitive, count);
            let area: f64 = parts.iter().map(|(b, _)| (b.max.x - b.min.x) * (b.max.y - b.min.y)).sum();
            assert!((area - 1.0).abs() < 1e-9, "parts make up the whole");
            let mut largest: f64 = 0.0;
            for (unit_box, part) in &parts {
                largest = largest.max(part.ball.radius);
                for _ in 0..30 {
                    let u = unit_box.at(pair(&mut random).as_dvec2()).as_vec2();
                    let sample = primitive.sample_area(u);
                    assert!(part.ball.contains(sample.p.as_dvec3()), "{primitive:?} {unit_box:?} {part:?}");
                    assert!(
                        holds(&part.normals.widened(2e-6), sample.n),
                        "{primitive:?} {unit_box:?} {part:?}"
                    );
                }
            }
            assert!(count < 64 || largest < 0.6 * whole, "{primitive:?}: {largest} of {whole}");
        }
    }
}

#[test]
fn places_of_a_cluster_lie_in_its_ball_and_the_shares_add_up() {
    let corners =
        [Vec3::ZERO, Vec3::X * 4.0, Vec3::new(0.1, 0.1, 0.0), Vec3::new(0.0, 0.3, 0.2), Vec3::Y * 3.0];
    let few = MeshData {
        positions: corners.to_vec(),
        triangles: vec![[0, 1, 4], [0, 2, 3], [2, 3, 4]],
        ..MeshData::default()
    };
    let many = generate::displaced_sphere(Vec3::X, 1.0, 3000, 0.1);
    let placement = Transform::scale(DVec3::new(1.0, 2.0, -0.5)).unwrap();
    let mut random = Random::from_seed(5);
    for data in [few, many] {
        let mesh = Arc::new(MeshBvh::new(Mesh::new(data).unwrap()));
        for transform in [None, Some(placement)] {
            let sampler = hyaline_geometry::mesh::MeshSampler::new(mesh.clone(), transform);
            let faces: Vec<u32> = (0..mesh.mesh().face_count() as u32).collect();
            let clusters = cluster::cut(mesh.mesh(), transform.as_ref(), &faces, 64);
            let pieces = || clusters.iter().flat_map(|c| c.pieces.iter().map(move |piece| (c, piece)));
            let share: f64 = pieces().map(|(_, piece)| f64::from(piece.share)).sum();
            assert!((share - 1.0).abs() < 1e-5 && clusters.len() > 16, "{share}, {}", clusters.len());
            for (cluster, piece) in pieces() {
                let u = piece.unit_box().at(pair(&mut random).as_dvec2()).as_vec2();
                let sample = sampler.sample_face(piece.face, u);
                assert!(cluster.patch.ball.contains(sample.p.as_dvec3()), "{piece:?} {:?}", cluster.patch);
                assert!(holds(&cluster.patch.normals.widened(2e-6), sample.n), "{piece:?}");
            }
        }
    }
}

#[test]
fn no_ray_of_a_beam_meets_a_ball_that_the_beam_can_t_reach() {
    let mut random = Random::from_seed(6);
    let (mut reached, mut missed) = (0, 0);
    for _ in 0..20_000 {
        let origins = Ball { center: vector(&mut random), radius: random.between(0.0, 0.5) };
        let axis = DVec3::from_array(random.direction());
        let cone = Cone { axis, half_angle: random.between(0.0, 1.0).powi(3) * PI };
        let target = Ball { center: vector(&mut random), radius: random.between(0.0, 0.7) };
        let beam = Beam::new(origins, cone);
        let may_meet = beam.may_meet(&target);
        for _ in 0..20 {
            let direction =
                (axis + DVec3::from_array(random.direction()) * random.uniform() * 2.0).normalize();
            let origin = origins.center + DVec3::from_array(random.direction()) * origins.radius;
            let offset = target.center - origin;
            let along = offset.dot(direction);
            let is_met = along > 0.0 && (offset - direction * along).length() < target.radius;
            if holds(&cone, direction.as_vec3()) && is_met {
                assert!(may_meet, "{origins:?} {cone:?} {target:?}");
                reached += 1;
            }
        }
        missed += u32::from(!may_meet);
    }
    assert!(reached > 2000 && missed > 5000, "{reached} {missed}");
}

#[test]
fn points_are_drawn_from_yes_cells_alone_and_from_all_of_them_alike() {
    let target = Ball { center: DVec3::new(0.3, 0.6, 0.0), radius: 0.22 };
    for size in [1, 5, 64, 100] {
        let grid = Grid::new(size, &[target], &|unit_box: &UnitBox| {
            let (low, high) = (unit_box.min, unit_box.max);
            move |target: &Ball| {
                let center = target.center.truncate();
                center.clamp(low, high).distance(center) < target.radius
            }
        });
        let mut random = Random::from_seed(u64::from(size));
        let mut counts = vec![0.0; (size * size) as usize];
        let draws = 300.0 * grid.fraction() * f64::from(size * size);
        for _ in 0..draws as u32 {
            let cell = (grid.sample(pair(&mut random)).unwrap() * size as f32).as_uvec2();
            counts[(cell.y * size + cell.x) as usize] += 1.0;
        }
        let expected: Vec<f64> = (0..size * size)
            .map(|i| {
                let low = DVec2::new(f64::from(i % size), f64::from(i / size)) / f64::from(size);
                let near = target.center.truncate().clamp(low, low + 1.0 / f64::from(size));
                let is_yes = near.distance(target.center.truncate()) < target.radius;
                if is_yes { 300.0 } else { 0.0 }
            })
            .collect();
        assert_eq!(expected.iter().sum::<f64>().round(), draws.round(), "{size}");
        assert!(counts.iter().zip(&expected).all(|(n, e)| *n == 0.0 || *e > 0.0), "{size}");
        if size > 1 {
            assert!(hyaline_testkit::chi_square(&counts, &expected, 5.0).p_value > 1e-3, "{size}");
        }
    }
}

#[test]
fn balls_that_are_merged_still_cover_those_they_are_made_of() {
    let mut random = Random::from_seed(8);
    let balls: Vec<Ball> =
        (0..3000).map(|_| Ball { center: vector(&mut random), radius: random.between(0.0, 0.1) }).collect();
    let few = merged(balls.clone(), 256);
    assert!(few.len() <= 256 && few.len() > 200);
    let covers = |a: &Ball, b: &Ball| a.center.distance(b.center) + b.radius <= a.radius * (1.0 + 1e-12);
    assert!(balls.iter().all(|ball| few.iter().any(|large| covers(large, ball))));
    assert!(few.iter().all(|ball| ball.radius < 1.5), "neighbors are put together");
}
