//! Every shape against the equation of its surface, marched along random lines in `f64`.

use super::*;
use hyaline_math::float::f64::{atan2, sin_cos};
use hyaline_testkit::{Random, chi_square};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A shape with an independent description of the same surface.
struct Case {
    shape: Shape,
    /// Zero on the surface, unbounded; of unit slope there.
    equation: Box<dyn Fn(DVec3) -> f64>,
    /// (radius, height) at a fraction of the profile.
    profile: Box<dyn Fn(f64) -> DVec2>,
    /// Fraction of the profile, possibly outside 0…1, of a point (radius, height) on it.
    fraction: Box<dyn Fn(DVec2) -> f64>,
    phi: [f64; 2],
    length: f64,
}

fn wrapped_fraction(angle: f64, [start, end]: [f64; 2]) -> f64 {
    // Angles outside the range go past 1, those just before the start come out near the whole turn.
    (angle - start).rem_euclid(TAU) / (end - start)
}

fn random_range(random: &mut Random) -> [f64; 2] {
    if random.uniform() < 0.3 {
        return WHOLE_TURN;
    }
    let start = random.between(-6.0, 6.0);
    [start, start + random.between(0.1, 6.2)]
}

fn sphere_case(random: &mut Random) -> Case {
    let radius = random.between(0.2, 2.0);
    let low = random.between(-FRAC_PI_2, 1.0);
    let latitude = if random.uniform() < 0.3 {
        [-FRAC_PI_2, FRAC_PI_2]
    } else {
        [low, random.between(low + 0.1, FRAC_PI_2)]
    };
    let phi = random_range(random);
    let span = latitude[1] - latitude[0];
    Case {
        shape: Shape::Sphere(Sphere::between_latitudes(radius, phi, latitude).unwrap()),
        equation: Box::new(move |p| p.length() - radius),
        profile: Box::new(move |v| {
            let (sin, cos) = sin_cos(latitude[0] + v * span);
            radius * DVec2::new(cos.max(0.0), sin)
        }),
        fraction: Box::new(move |q| (atan2(q.y, q.x) - latitude[0]) / span),
        phi,
        length: radius * span,
    }
}

fn segment_case(random: &mut Random) -> Case {
    let mut height = || if random.uniform() < 0.2 { 0.5 } else { random.between(-1.0, 1.0) };
    let (y0, y1) = (height(), height());
    let r0 = random.between(0.0, 1.5);
    let r1 = if random.uniform() < 0.2 && y0 != y1 { r0 } else { random.between(0.0, 1.5) };
    let r1 = if random.uniform() < 0.1 { 0.0 } else { r1 };
    let phi = random_range(random);
    let (start, end) = (DVec2::new(r0, y0), DVec2::new(r1, y1));
    let along = end - start;
    let n = DVec2::new(along.y, -along.x).normalize();
    Case {
        shape: Shape::Segment(RevolvedSegment::new(start.into(), end.into(), phi).unwrap()),
        equation: Box::new(move |p| n.dot(DVec2::new(axis_distance(p), p.y) - start)),
        profile: Box::new(move |v| start + along * v),
        fraction: Box::new(move |q| (q - start).dot(along) / along.length_squared()),
        phi,
        length: along.length(),
    }
}

fn arc_case(random: &mut Random) -> Case {
    let radius = random.between(0.05, 0.8);
    let center = DVec2::new(random.between(-0.3, 1.5), random.between(-1.0, 1.0));
    let theta = if center.x >= radius && random.uniform() < 0.5 {
        random_range(random)
    } else {
        // The part of the circle on the right side of the axis.
        let widest = hyaline_math::float::f64::acos((-center.x / radius).clamp(-1.0, 1.0));
        let end = random.between(0.2, 1.0) * widest;
        [-random.between(0.2, 1.0) * widest, end]
    };
    if center.x <= -0.9 * radius {
        return arc_case(random);
    }
    let phi = random_range(random);
    Case {
        shape: Shape::Arc(RevolvedArc::new(center.into(), radius, theta, phi).unwrap()),
        equation: Box::new(move |p| (DVec2::new(axis_distance(p), p.y) - center).length() - radius),
        profile: Box::new(move |v| {
            let (sin, cos) = sin_cos(theta[0] + v * (theta[1] - theta[0]));
            let q = center + radius * DVec2::new(cos, sin);
            DVec2::new(q.x.max(0.0), q.y)
        }),
        fraction: Box::new(move |q| wrapped_fraction(atan2(q.y - center.y, q.x - center.x), theta)),
        phi,
        length: radius * (theta[1] - theta[0]),
    }
}

fn cases(seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::from_seed(seed);
    (0..count)
        .map(|i| match i % 3 {
            0 => sphere_case(&mut random),
            1 => segment_case(&mut random),
            _ => arc_case(&mut random),
        })
        .collect()
}

impl Case {
    /// Whether the point is in the part; `None` within a hair of its border.
    fn holds(&self, p: DVec3) -> Option<bool> {
        let hair = 1e-6;
        let v = (self.fraction)(DVec2::new(axis_distance(p), p.y));
        let u = wrapped_fraction(atan2(p.x, p.z), self.phi);
        let turn = TAU / (self.phi[1] - self.phi[0]);
        let is_whole = self.phi == WHOLE_TURN;
        let near = |x: f64, ends: &[f64]| ends.iter().any(|end| (x - end).abs() < hair);
        let v_turn = match self.shape {
            Shape::Arc(_) => (self.fraction)((self.profile)(-1e-9)),
            _ => f64::INFINITY,
        };
        let is_closed = v_turn < 1.0 + hair;
        if (!is_closed && near(v, &[0.0, 1.0, v_turn])) || (!is_whole && near(u, &[0.0, 1.0, turn])) {
            return None;
        }
        Some((is_closed || (0.0..=1.0).contains(&v)) && (is_whole || u <= 1.0))
    }

    /// The surface's crossings in `t_min..t_max` by marching and bisection; close pairs are missed.
    fn march(&self, o: DVec3, d: DVec3, t_min: f64, t_max: f64, steps: usize) -> Vec<f64> {
        let f = |t: f64| (self.equation)(o + d * t);
        let at = |i: usize| t_min + (t_max - t_min) * i as f64 / steps as f64;
        let mut roots = Vec::new();
        for i in 0..steps {
            let (mut a, mut b) = (at(i), at(i + 1));
            if (f(a) < 0.0) != (f(b) < 0.0) {
                while 0.5 * (a + b) > a && 0.5 * (a + b) < b {
                    let middle = 0.5 * (a + b);
                    if (f(middle) < 0.0) == (f(a) < 0.0) { a = middle } else { b = middle }
                }
                roots.push(a);
            }
        }
        roots
    }
}

fn random_line(random: &mut Random) -> (DVec3, DVec3) {
    let toward = DVec3::from_array(std::array::from_fn(|_| random.between(-1.2, 1.2)));
    let o = DVec3::from(random.direction()) * 5.0;
    ((o), (toward - o) * random.between(0.1, 0.4))
}

#[test]
fn crossings_are_those_of_the_marched_equation() {
    let mut random = Random::from_seed(7);
    let (mut found_total, mut part_total) = (0, 0);
    for case in cases(1, 600) {
        for _ in 0..30 {
            let (o, d) = random_line(&mut random);
            let (t_min, t_max) = (0.0, 12.0 / d.length());
            let mut found = Crossings::new();
            case.shape.crossings(o, d, t_min, t_max, &mut found);
            let found = found.as_slice();
            let step = (t_max - t_min) / 1500.0;
            for &t in found {
                let p = o + d * t;
                assert!((case.equation)(p).abs() < 1e-14 * 8.0, "off by {:e}", (case.equation)(p));
                assert_ne!(case.holds(p), Some(false), "{:?} {p}", case.shape);
            }
            for t in case.march(o, d, t_min, t_max, 1500) {
                part_total += 1;
                if case.holds(o + d * t) == Some(true) {
                    let error = found.iter().map(|x| (x - t).abs()).fold(f64::INFINITY, f64::min);
                    // Bisection is as uncertain as the equation's rounding over its slope.
                    assert!(error < 1e-6 && (error < 1e-9 || has_close_pair(found, step)), "{error:e}");
                    found_total += 1;
                }
            }
        }
    }
    assert!(found_total > 2_000 && part_total > found_total, "{found_total} {part_total}");
}

fn has_close_pair(t: &[f64], step: f64) -> bool {
    t.windows(2).any(|pair| pair[1] - pair[0] < step)
}

#[test]
fn nothing_is_found_that_marching_does_not_find_but_close_pairs() {
    let mut random = Random::from_seed(8);
    for case in cases(2, 600) {
        for _ in 0..30 {
            let (o, d) = random_line(&mut random);
            let (t_min, t_max) = (0.0, 12.0 / d.length());
            let mut found = Crossings::new();
            case.shape.crossings(o, d, t_min, t_max, &mut found);
            let marched = case.march(o, d, t_min, t_max, 1500);
            let step = (t_max - t_min) / 1500.0;
            let lonely = |t: f64| marched.iter().all(|x| (x - t).abs() > 1e-6);
            for &t in found.as_slice() {
                if lonely(t) {
                    // Both crossings of a near touch lie within one step; the other may be outside the part.
                    let n = case.shape.surface_at(o + d * t).n.dot(d.normalize());
                    assert!(n.abs() < 0.3 || case.holds(o + d * t).is_none(), "{:?} {n} {step}", case.shape);
                }
            }
        }
    }
}

#[test]
fn only_crossings_strictly_inside_the_interval_are_kept() {
    let mut random = Random::from_seed(9);
    let mut tested = 0;
    for case in cases(3, 300) {
        let (o, d) = random_line(&mut random);
        let mut found = Crossings::new();
        case.shape.crossings(o, d, f64::NEG_INFINITY, f64::INFINITY, &mut found);
        let all = found.as_slice().to_vec();
        assert!(all.windows(2).all(|pair| pair[0] <= pair[1]));
        for (i, &t) in all.iter().enumerate() {
            tested += 1;
            case.shape.crossings(o, d, t, f64::INFINITY, &mut found);
            assert_eq!(found.as_slice(), &all[i + 1..]);
            case.shape.crossings(o, d, f64::NEG_INFINITY, t, &mut found);
            assert_eq!(found.as_slice(), &all[..i]);
        }
    }
    assert!(tested > 100);
}

#[test]
fn surface_points_lie_on_the_surface_and_normals_are_its_gradient() {
    let mut random = Random::from_seed(10);
    for case in cases(4, 600) {
        let (on, n) = case.shape.sample_area(DVec2::new(random.uniform(), random.uniform()));
        assert!((case.equation)(on).abs() < 2e-15 && case.holds(on) != Some(false));
        let point = case.shape.surface_at(on + DVec3::from(random.direction()) * 1e-7);
        assert!((case.equation)(point.p).abs() < 2e-15);
        assert!(point.n.distance(n) < 1e-4 && (point.n.length() - 1.0).abs() < 1e-14);
        let h = 1e-6;
        let gradient = DVec3::AXES.map(|axis| {
            ((case.equation)(point.p + axis * h) - (case.equation)(point.p - axis * h)) / (2.0 * h)
        });
        assert!(axis_distance(point.p) < 1e-3 || point.n.distance(gradient.into()) < 1e-5);
    }
}

#[test]
fn surface_coordinates_are_fractions_and_have_their_derivatives() {
    let mut random = Random::from_seed(11);
    for case in cases(5, 600) {
        let (u, v) = (random.between(0.01, 0.99), random.between(0.01, 0.99));
        let span = case.phi[1] - case.phi[0];
        let at = |u: f64, v: f64| {
            let q = (case.profile)(v);
            revolved_point(q.x, q.y, case.phi[0] + u * span).0
        };
        let point = case.shape.surface_at(at(u, v));
        assert!(point.uv.distance(DVec2::new(u, v)) < 1e-7, "{} for {u} {v}", point.uv);
        let h = 1e-5;
        let by_u = (at(u + h, v) - at(u - h, v)) / (2.0 * h);
        let by_v = (at(u, v + h) - at(u, v - h)) / (2.0 * h);
        assert!(point.dpdu.distance(by_u) < 1e-6, "{} for {by_u}", point.dpdu);
        assert!(point.dpdv.distance(by_v) < 1e-6, "{} for {by_v}", point.dpdv);
        assert!(point.dpdu.dot(point.n).abs() < 1e-12 && point.dpdv.dot(point.n).abs() < 1e-12);
    }
}

#[test]
fn bounds_and_support_are_tight() {
    let mut random = Random::from_seed(12);
    for case in cases(6, 120) {
        let span = case.phi[1] - case.phi[0];
        let points: Vec<DVec3> = (0..=200)
            .flat_map(|i| (0..=100).map(move |j| (f64::from(i) / 200.0, f64::from(j) / 100.0)))
            .map(|(u, v)| {
                let q = (case.profile)(v);
                revolved_point(q.x, q.y, case.phi[0] + u * span).0
            })
            .collect();
        let v = DVec3::from(random.direction());
        let brute = points.iter().map(|p| v.dot(*p)).fold(f64::NEG_INFINITY, f64::max);
        let support = case.shape.support(v);
        assert!(support > brute - 1e-12 && support < brute + 2e-3, "{support} {brute} {:?}", case.shape);
        let (low, high) = case.shape.bounds();
        assert!(points.iter().all(|p| p.cmpge(low - 1e-12).all() && p.cmple(high + 1e-12).all()));
    }
}

#[test]
fn areas_are_the_integral_of_the_turned_profile() {
    for case in cases(7, 300) {
        let n = 4000;
        let mean_r =
            (0..n).map(|i| (case.profile)((f64::from(i) + 0.5) / f64::from(n)).x).sum::<f64>() / f64::from(n);
        let expected = (case.phi[1] - case.phi[0]) * case.length * mean_r;
        assert!((case.shape.area() / expected - 1.0).abs() < 1e-6);
    }
}

#[test]
fn samples_are_uniform_by_area() {
    let mut random = Random::from_seed(13);
    let mut p_values = Vec::new();
    for case in cases(8, 60) {
        let (nu, nv, count) = (6, 12, 20_000);
        let mut observed = vec![0.0; nu * nv];
        for _ in 0..count {
            let (p, _) = case.shape.sample_area(DVec2::new(random.uniform(), random.uniform()));
            let uv = case.shape.surface_at(p).uv;
            let cell = |x: f64, n: usize| ((x * n as f64) as usize).min(n - 1);
            observed[cell(uv.x, nu) * nv + cell(uv.y, nv)] += 1.0;
        }
        let weight = |j: usize| {
            (0..50)
                .map(|k| (case.profile)((j as f64 + (f64::from(k) + 0.5) / 50.0) / nv as f64).x)
                .sum::<f64>()
        };
        let total: f64 = (0..nv).map(weight).sum::<f64>() * nu as f64;
        let expected: Vec<f64> =
            (0..nu * nv).map(|cell| f64::from(count) * weight(cell % nv) / total).collect();
        p_values.push(chi_square(&observed, &expected, 5.0).p_value);
    }
    let least = p_values.iter().copied().fold(1.0, f64::min);
    assert!(least > 1e-4, "{least}");
    let mean = p_values.iter().sum::<f64>() / p_values.len() as f64;
    assert!((mean - 0.5).abs() < 0.15, "{mean}");
}

#[test]
fn neighbors_share_their_common_end() {
    // A ray exactly through the seam of a quarter sphere and of the cylinder below it meets at least one of each pair.
    let (phi, radius) = ([0.0, FRAC_PI_2], 0.3);
    let octant = Shape::Sphere(Sphere::between_latitudes(radius, phi, [0.0, FRAC_PI_2]).unwrap());
    let quarter = Shape::Segment(RevolvedSegment::cylinder(radius, [-1.0, 0.0], phi).unwrap());
    let mut random = Random::from_seed(14);
    for _ in 0..10_000 {
        let (seam, _) = revolved_point(radius, 0.0, random.between(0.0, FRAC_PI_2));
        let d = DVec3::from(random.direction());
        let o = seam - d * random.between(0.1, 1e4);
        let mut found = Crossings::new();
        let hits = [octant, quarter].map(|shape| {
            shape.crossings(o, d, 0.0, f64::INFINITY, &mut found);
            found.as_slice().iter().filter(|&&t| (o + d * t).distance(seam) < 1e-6).count()
        });
        // Grazing rays may turn aside before the seam.
        let grazes = d.dot(seam).abs() < 1e-3 * radius;
        assert!(grazes || hits[0] + hits[1] >= 1, "{o} {d}");
    }
}

#[test]
fn degenerate_lines_meet_nothing_and_do_not_panic() {
    let mut found = Crossings::new();
    for case in cases(9, 60) {
        for bad in [f64::NAN, f64::INFINITY, 0.0] {
            let lines = [
                (DVec3::ZERO, DVec3::splat(bad)),
                (DVec3::splat(1.0 / bad), DVec3::X),
                (DVec3::new(bad, f64::NAN, 0.0), DVec3::new(0.0, 1.0, bad)),
            ];
            for (o, d) in lines {
                case.shape.crossings(o, d, 0.0, f64::INFINITY, &mut found);
                assert!(found.as_slice().iter().all(|t| t.is_finite()));
            }
        }
    }
}
