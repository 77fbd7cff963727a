//! Composed solids are closed: every line goes in and out by turns, and is inside where it should be.

use super::*;
use crate::shape::Crossings;
use hyaline_math::Bounds;
use hyaline_testkit::Random;

/// Crossings of a line with all parts, ascending: distance, and whether the line enters.
pub(crate) fn boundary(parts: &[Primitive], o: DVec3, d: DVec3) -> Vec<(f64, bool)> {
    let mut all = Vec::new();
    let mut found = Crossings::new();
    for part in parts {
        let (origin, direction) = (part.transform.inverse_point(o), part.transform.inverse_vector(d));
        part.shape.crossings(origin, direction, f64::NEG_INFINITY, f64::INFINITY, &mut found);
        for &t in found.as_slice() {
            let n = part.shape.surface_at(origin + direction * t).n;
            let outward = if part.flipped { -n } else { n };
            all.push((t, part.transform.normal(outward).dot(d) < 0.0));
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

/// Checks on `count` random lines that the parts enclose the points that `contains` says; it may abstain.
pub(crate) fn assert_closed(
    parts: &[Primitive],
    contains: impl Fn(DVec3) -> Option<bool>,
    count: usize,
    seed: u64,
) {
    let bounds = parts.iter().fold(Bounds::EMPTY, |bounds, part| bounds.union(part.bounds()));
    let (center, radius) = (bounds.center().as_dvec3(), f64::from(bounds.radius()));
    let mut random = Random::from_seed(seed);
    let (mut chords, mut judged) = (0, 0);
    for _ in 0..count {
        let toward =
            center + 0.8 * radius * DVec3::from_array(std::array::from_fn(|_| random.between(-1.0, 1.0)));
        let d = DVec3::from(random.direction());
        let o = toward - d * 4.0 * radius;
        let boundary = boundary(parts, o, d);
        assert_eq!(boundary.len() % 2, 0, "{o} {d} {boundary:?}");
        for (i, (_, enters)) in boundary.iter().enumerate() {
            assert_eq!(*enters, i % 2 == 0, "{o} {d} {boundary:?}");
        }
        for (i, pair) in boundary.windows(2).enumerate() {
            let middle = o + d * (0.5 * (pair[0].0 + pair[1].0));
            if let Some(is_inside) = contains(middle) {
                assert_eq!(is_inside, i % 2 == 0, "{middle} on {o} {d}");
                judged += 1;
            }
            chords += 1;
        }
    }
    assert!(judged > count / 4 && judged > chords / 2, "{judged} of {chords} chords judged");
}

/// The volume enclosed, by a grid of parallel lines.
pub(crate) fn volume(parts: &[Primitive], steps: usize) -> f64 {
    let bounds = parts.iter().fold(Bounds::EMPTY, |bounds, part| bounds.union(part.bounds()));
    let (center, radius) = (bounds.center().as_dvec3(), f64::from(bounds.radius()));
    let d = DVec3::new(0.48, 0.6, 0.64);
    let (u, v) = (DVec3::new(0.8, 0.0, -0.6), d.cross(DVec3::new(0.8, 0.0, -0.6)));
    let step = 2.0 * radius / steps as f64;
    let at = |i: usize| (i as f64 + 0.5) * step - radius;
    let mut sum = 0.0;
    for i in 0..steps * steps {
        let o = center + u * at(i / steps) + v * at(i % steps);
        sum += boundary(parts, o, d).iter().map(|(t, enters)| if *enters { -t } else { *t }).sum::<f64>();
    }
    sum * step * step
}

/// Distance of a point from a box's surface, below 0 inside.
fn box_distance(p: DVec3, min: DVec3, max: DVec3) -> f64 {
    let q = (p - 0.5 * (min + max)).abs() - 0.5 * (max - min);
    q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
}

fn decided(distance: f64, margin: f64) -> Option<bool> {
    (distance.abs() > margin).then_some(distance < 0.0)
}

#[test]
fn boxes_are_closed() {
    let (min, max) = (DVec3::new(-0.3, 0.1, -0.2), DVec3::new(0.5, 0.4, 0.9));
    let parts = cuboid(min, max).unwrap();
    assert_eq!(parts.len(), 6);
    assert_closed(&parts, |p| decided(box_distance(p, min, max), 1e-9), 100_000, 1);
    let size = max - min;
    assert!(
        (parts.iter().map(Primitive::area).sum::<f64>()
            - 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x))
            .abs()
            < 1e-12
    );
}

#[test]
fn rounded_boxes_are_closed() {
    let (min, max) = (DVec3::new(-0.3, 0.1, -0.2), DVec3::new(0.5, 0.4, 0.9));
    for (radius, count) in [(0.05, 26), (1e-4, 26), (0.15, 18)] {
        let parts = rounded_cuboid(min, max, radius).unwrap();
        // At the largest radius nothing flat is left along y: four faces and four edges are gone.
        assert_eq!(parts.len(), count);
        let inner = |p: DVec3| decided(box_distance(p, min + radius, max - radius) - radius, 1e-9);
        assert_closed(&parts, inner, 100_000, 2);
    }
    let ball = rounded_cuboid(DVec3::splat(-1.0), DVec3::splat(1.0), 1.0).unwrap();
    assert_eq!(ball.len(), 8);
    assert_closed(&ball, |p| decided(p.length() - 1.0, 1e-9), 20_000, 3);
    let area: f64 = ball.iter().map(Primitive::area).sum();
    assert!((area - 4.0 * PI).abs() < 1e-12);
}

#[test]
fn rounded_boxes_have_the_volume_of_steiner() {
    let (size, radius) = (DVec3::new(0.8, 0.3, 1.1), 0.07);
    let parts = rounded_cuboid(DVec3::ZERO, size, radius).unwrap();
    let f = size - 2.0 * radius;
    let surface = 2.0 * (f.x * f.y + f.y * f.z + f.z * f.x);
    let expected = f.x * f.y * f.z
        + surface * radius
        + PI * radius * radius * (f.x + f.y + f.z)
        + 4.0 / 3.0 * PI * radius * radius * radius;
    let volume = volume(&parts, 400);
    assert!((volume / expected - 1.0).abs() < 1e-3, "{volume} {expected}");
}

#[test]
fn cylinders_and_cones_are_closed_when_capped() {
    let parts = cylinder(0.4, [1.0, -0.5], Ends::Capped).unwrap();
    let distance = |p: DVec3| (DVec2::new(p.x, p.z).length() - 0.4).max((p.y - 0.25).abs() - 0.75);
    assert_closed(&parts, |p| decided(distance(p), 1e-9), 100_000, 4);
    let parts = cone(0.4, 1.2, Ends::Capped).unwrap();
    let distance = |p: DVec3| (DVec2::new(p.x, p.z).length() - 0.4 * (1.0 - p.y / 1.2)).max(-p.y);
    assert_closed(&parts, |p| decided(distance(p), 1e-9), 100_000, 5);
    assert_eq!(cylinder(0.4, [0.0, 1.0], Ends::Open).unwrap().len(), 1);
    assert_eq!(cone(0.4, 1.0, Ends::Open).unwrap().len(), 1);
}

#[test]
fn tori_are_closed() {
    let parts = torus(0.5, 0.2, WHOLE_TURN, WHOLE_TURN).unwrap();
    let distance = |p: DVec3| DVec2::new(DVec2::new(p.x, p.z).length() - 0.5, p.y).length() - 0.2;
    assert_closed(&parts, |p| decided(distance(p), 1e-9), 100_000, 6);
    let expected = 2.0 * PI * PI * 0.5 * 0.04;
    assert!((volume(&parts, 300) / expected - 1.0).abs() < 1e-3);
}

/// Whether a point is inside a closed profile turned about y, by the chain cut into short lines.
pub(crate) fn profile_contains(profile: &Profile) -> impl Fn(DVec3) -> Option<bool> {
    let steps = 150;
    let mut polygon: Vec<DVec2> = Vec::new();
    for piece in profile.pieces() {
        polygon.extend((0..steps).map(|i| piece.at(f64::from(i) / f64::from(steps))));
    }
    polygon.push(profile.end());
    let margin = 1e-4 * profile.size();
    move |p| {
        let q = DVec2::new(DVec2::new(p.x, p.z).length(), p.y);
        let mut crossings = 0;
        for (i, &b) in polygon.iter().enumerate() {
            let a = polygon[(i + polygon.len() - 1) % polygon.len()];
            let t = ((q - a).dot(b - a) / a.distance_squared(b).max(1e-300)).clamp(0.0, 1.0);
            let is_axis = a.x.max(b.x) < 1e-9;
            if !is_axis && q.distance(a + (b - a) * t) < margin {
                return None;
            }
            if (a.y <= q.y) != (b.y <= q.y) && a.x + (b.x - a.x) * (q.y - a.y) / (b.y - a.y) > q.x {
                crossings += 1;
            }
        }
        Some(crossings % 2 == 1)
    }
}

/// Volume of a closed profile turned about y, by Pappus over short lines.
pub(crate) fn profile_volume(profile: &Profile) -> f64 {
    let cone = |a: DVec2, b: DVec2| PI / 3.0 * (b.y - a.y) * (a.x * a.x + a.x * b.x + b.x * b.x);
    let piece_volume = |piece: &Piece| {
        let at = |i: u32| piece.at(f64::from(i) / 2000.0);
        (0..2000).map(|i| cone(at(i), at(i + 1))).sum::<f64>()
    };
    profile.pieces().iter().map(piece_volume).sum()
}

#[test]
fn surfaces_of_revolution_are_closed() {
    let vase = [[0.0, 0.0], [0.3, 0.0], [0.4, 0.3], [0.15, 0.7], [0.2, 1.0], [0.0, 1.1]];
    for (seed, profile) in [(7, Profile::lines(&vase)), (8, Profile::smooth(&vase))] {
        let profile = profile.unwrap();
        let parts = revolution(&profile, WHOLE_TURN, Ends::Open).unwrap();
        assert_closed(&parts, profile_contains(&profile), 30_000, seed);
        let expected = profile_volume(&profile);
        assert!((volume(&parts, 300) / expected - 1.0).abs() < 2e-3);
    }
    let open = Profile::smooth(&vase[1..5]).unwrap();
    let parts = revolution(&open, WHOLE_TURN, Ends::Capped).unwrap();
    let capped = capped_profile(&open).unwrap();
    assert_closed(&parts, profile_contains(&capped), 30_000, 9);
}

#[test]
fn smooth_profiles_have_no_crease() {
    let points = [[0.0, 0.0], [0.3, 0.05], [0.4, 0.3], [0.15, 0.7], [0.2, 1.0], [0.0, 1.1]];
    let profile = Profile::smooth(&points).unwrap();
    for pair in profile.pieces().windows(2) {
        assert!(pair[0].tangent_at(1.0).distance(pair[1].tangent_at(0.0)) < 1e-9);
    }
    assert!(profile.pieces()[0].normal_at(0.0).distance(-DVec2::Y) < 1e-12);
    for point in points {
        let nearest =
            profile.pieces().iter().map(|piece| piece.distance(point.into())).fold(f64::MAX, f64::min);
        assert!(nearest < 1e-15);
    }
}

#[test]
fn profiles_on_a_circle_about_the_axis_become_spheres() {
    let points: Vec<[f64; 2]> = (0..=8)
        .map(|i| hyaline_math::float::f64::sin_cos(f64::from(i) * PI / 8.0))
        .map(|(sin, cos)| [if sin < 1e-15 { 0.0 } else { sin }, 3.0 - cos])
        .collect();
    let parts = revolution(&Profile::smooth(&points).unwrap(), WHOLE_TURN, Ends::Open).unwrap();
    assert!(parts.len() <= 16);
    assert_closed(&parts, |p| decided((p - 3.0 * DVec3::Y).length() - 1.0, 1e-9), 20_000, 10);
}

/// Walks through the parts from hit to hit as a renderer does; whether each hit enters.
pub(crate) fn walk(parts: &[Primitive], mut ray: hyaline_math::Ray) -> Vec<bool> {
    let mut entered = Vec::new();
    while entered.len() < 64 {
        let hits = parts.iter().filter_map(|part| part.closest(&ray).map(|t| (t, part)));
        let Some((t, part)) = hits.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        let hit = part.surface_at(&ray, t);
        entered.push(hit.ng.dot(ray.direction) < 0.0);
        ray.origin = hyaline_math::offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
    }
    entered
}

#[test]
fn rays_in_the_seams_go_in_and_out_once() {
    use hyaline_math::{Ray, Vec3};
    let parts = rounded_cuboid(DVec3::ZERO, DVec3::ONE, 0.25).unwrap();
    let sharp = cuboid(DVec3::ZERO, DVec3::ONE).unwrap();
    for (x, y) in [(0.25, 0.25), (0.25, 0.5), (0.75, 0.25), (0.75, 0.75), (0.5, 0.5)] {
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let (mut origin, mut direction) = (Vec3::ZERO, Vec3::ZERO);
                origin[axis] = 0.5 - 3.0 * sign;
                origin[(axis + 1) % 3] = x;
                origin[(axis + 2) % 3] = y;
                direction[axis] = sign;
                let ray = Ray::new(origin, direction);
                assert_eq!(walk(&parts, ray), [true, false], "{origin} {direction}");
                assert_eq!(walk(&sharp, ray), [true, false], "{origin} {direction}");
            }
        }
    }
    // Through opposite edges of the sharp box.
    let diagonal = Vec3::new(1.0, 1.0, 0.0).normalize();
    assert_eq!(walk(&sharp, Ray::new(Vec3::new(-1.0, -1.0, 0.5), diagonal)), [true, false]);
}

#[test]
fn impossible_objects_are_refused_with_reasons() {
    let refused = |result: Result<Vec<Primitive>, ShapeError>, words: &str| {
        let message = result.unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    refused(cuboid(DVec3::ONE, DVec3::ZERO), "edge of a box");
    refused(cuboid(DVec3::ZERO, DVec3::new(1.0, f64::NAN, 1.0)), "edge of a box");
    refused(rounded_cuboid(DVec3::ZERO, DVec3::ONE, 0.6), "at most half the shortest edge, 0.5");
    refused(rounded_cuboid(DVec3::ZERO, DVec3::ONE, -0.1), "edge radius");
    refused(cylinder(0.0, [0.0, 1.0], Ends::Capped), "radius is 0");
    refused(cylinder(1.0, [1.0, 1.0], Ends::Capped), "1 distinct points");
    refused(cone(1.0, f64::INFINITY, Ends::Capped), "height is inf");
    refused(torus(0.5, 0.6, WHOLE_TURN, WHOLE_TURN), "must not cross the axis");
    let u_turn =
        Profile::lines(&[[0.1, 0.0], [0.5, 0.0], [0.5, 1.0], [0.1, 1.0], [0.1, 0.5], [0.4, 0.5]]).unwrap();
    assert!(revolution(&u_turn, WHOLE_TURN, Ends::Open).is_ok());
    let hook = Profile::lines(&[[0.1, 0.0], [0.5, 0.0], [0.5, 1.0], [0.3, 0.5], [0.3, -0.5]]);
    refused(hook.and_then(|p| revolution(&p, WHOLE_TURN, Ends::Capped)), "meets itself");
}
