//! Vessels and liquids are closed, hold what they should, and never share a boundary.

use super::*;
use crate::shape::compose::tests::{assert_closed, boundary, profile_contains, profile_volume, volume, walk};
use hyaline_math::DVec3;
use hyaline_testkit::Random;

fn tumbler(rim: Rim, fill: &[(f64, f64)]) -> VesselSpec {
    let fill = fill.iter().map(|&(level, meniscus)| FillSpec { level: Level::Fraction(level), meniscus });
    VesselSpec {
        outer: Profile::lines(&[[0.035, 0.0], [0.035, 0.1]]).unwrap(),
        wall: 0.003,
        base: 0.008,
        rim,
        fill: fill.collect(),
    }
}

/// Vessels of many forms, each with liquids.
fn vessels() -> Vec<(&'static str, VesselSpec)> {
    let fill = |levels: &[(f64, f64)]| {
        levels.iter().map(|&(level, meniscus)| FillSpec { level: Level::Fraction(level), meniscus }).collect()
    };
    let spec = |outer: Result<Profile, ShapeError>, wall, base, rim, levels: &[(f64, f64)]| VesselSpec {
        outer: outer.unwrap(),
        wall,
        base,
        rim,
        fill: fill(levels),
    };
    let beer = Profile::lines(&[[0.030, 0.0], [0.036, 0.10]]);
    let narrowing = Profile::lines(&[[0.04, 0.0], [0.04, 0.05], [0.02, 0.09], [0.02, 0.13]]);
    let curved = Profile::smooth(&[[0.02, 0.0], [0.035, 0.03], [0.03, 0.07], [0.033, 0.1]]);
    let wine = Profile::smooth(&[
        [0.035, 0.0],
        [0.03, 0.003],
        [0.004, 0.012],
        [0.004, 0.02],
        [0.004, 0.06],
        [0.004, 0.07],
        [0.03, 0.1],
        [0.036, 0.13],
        [0.028, 0.17],
    ]);
    vec![
        ("tumbler", tumbler(Rim::Flat, &[(0.6, 0.0)])),
        ("round tumbler", tumbler(Rim::Round, &[(0.6, 0.002)])),
        ("oil on water", tumbler(Rim::Round, &[(0.4, 0.001), (0.7, 0.002)])),
        ("brimful", tumbler(Rim::Flat, &[(1.0, 0.0)])),
        ("beer", spec(beer.clone(), 0.0025, 0.008, Rim::Round, &[(0.75, 0.002)])),
        ("brimful beer", spec(beer, 0.0025, 0.008, Rim::Flat, &[(0.5, 0.002), (1.0, 0.0)])),
        ("bottle", spec(narrowing.clone(), 0.002, 0.004, Rim::Round, &[(0.5, 0.001), (0.9, 0.001)])),
        ("brimful bottle", spec(narrowing, 0.002, 0.004, Rim::Round, &[(1.0, 0.0)])),
        ("curved", spec(curved, 0.002, 0.006, Rim::Round, &[(0.3, 0.0), (0.6, 0.001), (0.8, 0.0)])),
        ("wine", spec(wine, 0.0015, 0.074, Rim::Round, &[(0.4, 0.001)])),
        ("fishbowl", spec(Profile::sphere_bowl(0.12, 0.05, 0.08), 0.004, 0.006, Rim::Round, &[(0.7, 0.003)])),
        ("flask", spec(Profile::sphere_bowl(0.12, 0.0, 0.08), 0.004, 0.0, Rim::Flat, &[(0.7, 0.003)])),
        ("funnel", spec(Profile::lines(&[[0.0, 0.0], [0.05, 0.1]]), 0.002, 0.0, Rim::Round, &[(0.6, 0.001)])),
        (
            "martini",
            spec(Profile::lines(&[[0.01, 0.0], [0.06, 0.03]]), 0.002, 0.004, Rim::Round, &[(0.6, 0.001)]),
        ),
    ]
}

#[test]
fn glass_and_liquids_are_closed_solids() {
    for (seed, (name, spec)) in vessels().into_iter().enumerate() {
        let vessel = spec.build().unwrap_or_else(|error| panic!("{name}: {error}"));
        let count = if name == "round tumbler" { 100_000 } else { 10_000 };
        let seed = 100 + 10 * seed as u64;
        assert_closed(&vessel.glass, profile_contains(&vessel.glass_profile), count, seed);
        for (i, (liquid, profile)) in vessel.liquids.iter().zip(&vessel.liquid_profiles).enumerate() {
            assert_closed(liquid, profile_contains(profile), count, seed + 1 + i as u64);
        }
    }
}

#[test]
fn volumes_of_a_straight_glass_are_the_closed_forms() {
    let (r, h, wall, base) = (0.035_f64, 0.1, 0.003_f64, 0.008);
    let flat = tumbler(Rim::Flat, &[(0.5, 0.0)]).build().unwrap();
    let shell = PI * (r * r * h - (r - wall).powi(2) * (h - base));
    assert!((volume(&flat.glass, 600) / shell - 1.0).abs() < 3e-3);
    assert!((profile_volume(&flat.glass_profile) / shell - 1.0).abs() < 1e-12);
    // Half a wall into the wall and the base.
    let water = PI * (r - 0.5 * wall).powi(2) * (0.5 * (h - base) + 0.5 * wall);
    assert!((profile_volume(&flat.liquid_profiles[0]) / water - 1.0).abs() < 1e-12);
    assert!((volume(&flat.liquids[0], 400) / water - 1.0).abs() < 1e-3);
    let round = tumbler(Rim::Round, &[]).build().unwrap();
    let rim = 2.0 * PI * (r - 0.5 * wall) * 0.5 * PI * (0.5 * wall).powi(2);
    assert!((volume(&round.glass, 600) / (shell + rim) - 1.0).abs() < 3e-3);
    assert!((profile_volume(&round.glass_profile) / (shell + rim) - 1.0).abs() < 1e-6);
    assert!(round.liquids.is_empty());
}

#[test]
fn a_fishbowl_is_a_spherical_shell() {
    let (r, wall) = (0.12_f64, 0.004);
    let spec = VesselSpec {
        outer: Profile::sphere_bowl(r, 0.05, 0.08).unwrap(),
        wall,
        base: 0.006,
        rim: Rim::Flat,
        fill: vec![],
    };
    let vessel = spec.build().unwrap();
    let center = DVec2::new(0.0, (r * r - 0.05 * 0.05).sqrt());
    let inner = spec.cavity().unwrap().wall;
    assert_eq!(inner.len(), 1);
    assert!((0..=10).all(|i| {
        let p = inner[0].at(f64::from(i) / 10.0);
        (p.distance(center) - (r - wall)).abs() < 1e-15
    }));
    assert!(vessel.glass.iter().filter(|part| matches!(part.shape, crate::Shape::Sphere(_))).count() == 2);
}

/// What is at a place, by priority: 0 glass, 1.. liquids, `None` air; from the solids entered along the line.
fn media(vessel: &Vessel, o: DVec3, d: DVec3) -> Vec<(f64, Option<usize>)> {
    let solids = std::iter::once(&vessel.glass).chain(&vessel.liquids);
    let mut events: Vec<(f64, usize, bool)> = solids
        .enumerate()
        .flat_map(|(solid, parts)| {
            boundary(parts, o, d).into_iter().map(move |(t, enters)| (t, solid, enters))
        })
        .collect();
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut inside = vec![false; vessel.liquids.len() + 1];
    let mut result = Vec::new();
    for (t, solid, enters) in events {
        assert_ne!(inside[solid], enters);
        inside[solid] = enters;
        result.push((t, inside.iter().position(|&inside| inside)));
    }
    result
}

#[test]
fn every_place_in_a_straight_glass_holds_what_it_should() {
    let vessel = tumbler(Rim::Flat, &[(0.4, 0.0), (0.7, 0.0)]).build().unwrap();
    let [bottom, top] = vessel.inner_heights;
    assert_eq!([bottom, top], [0.008, 0.1]);
    let levels = [0.4, 0.7].map(|level| bottom + level * (top - bottom));
    let expected = |p: DVec3| {
        let r = DVec2::new(p.x, p.z).length();
        match p.y {
            y if r > 0.035 || !(0.0..=0.1).contains(&y) => None,
            y if r > 0.032 || y < bottom => Some(0),
            y if y < levels[0] => Some(1),
            y if y < levels[1] => Some(2),
            _ => None,
        }
    };
    let mut random = Random::from_seed(1);
    let mut seen = [0; 4];
    for _ in 0..100_000 {
        let toward =
            DVec3::from_array(std::array::from_fn(|i| [0.035, 0.05, 0.035][i] * random.between(-1.0, 1.0)));
        let d = DVec3::from(random.direction());
        let o = toward + DVec3::Y * 0.05 - d;
        let media = media(&vessel, o, d);
        for pair in media.windows(2) {
            assert!(pair[1].0 - pair[0].0 > 1e-12, "boundaries coincide: {pair:?}");
            // At the edges a chord may be too short to tell its middle from its ends.
            if pair[1].0 - pair[0].0 > 1e-9 {
                let medium = expected(o + d * (0.5 * (pair[0].0 + pair[1].0)));
                assert_eq!(pair[0].1, medium);
                seen[medium.map_or(3, |m| m)] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 10_000), "{seen:?}");
}

#[test]
fn no_two_boundaries_coincide() {
    let mut random = Random::from_seed(2);
    for (name, spec) in vessels() {
        let vessel = spec.build().unwrap();
        let size = spec.outer.size();
        for _ in 0..5_000 {
            let toward = DVec3::from_array(std::array::from_fn(|_| size * random.between(-0.5, 0.5)));
            let d = DVec3::from(random.direction());
            let media = media(&vessel, toward + DVec3::Y * 0.5 * size - d, d);
            let gap = media.windows(2).map(|pair| pair[1].0 - pair[0].0).fold(f64::MAX, f64::min);
            assert!(gap > 1e-12 * size, "{name}: {gap:e}");
        }
    }
}

#[test]
fn rays_through_the_axis_pass_as_all_others_do() {
    let mut random = Random::from_seed(4);
    for (name, spec) in vessels() {
        let vessel = spec.build().unwrap();
        let size = spec.outer.size();
        for parts in std::iter::once(&vessel.glass).chain(&vessel.liquids) {
            for i in 0..2_000 {
                let (sin, cos) = hyaline_math::float::f64::sin_cos(if i == 0 {
                    -FRAC_PI_2
                } else {
                    random.between(0.0, 7.0)
                });
                let d = DVec3::new(0.0, sin, cos);
                let o = DVec3::Y * size * random.between(0.0, 1.1) - d * 3.0 * size;
                let mut boundary = boundary(parts, o, d);
                // Down the axis an apex counts twice.
                boundary.dedup_by(|a, b| i == 0 && a.1 == b.1 && (a.0 - b.0).abs() < 1e-12 * size);
                let by_turns = boundary.iter().enumerate().all(|(i, (_, enters))| *enters == (i % 2 == 0));
                assert!(by_turns && boundary.len().is_multiple_of(2), "{name}: {o} {d} {boundary:?}");
            }
        }
        let down = hyaline_math::Ray::new(hyaline_math::Vec3::Y, -hyaline_math::Vec3::Y);
        assert_eq!(walk(&vessel.glass, down), [true, false], "{name}");
    }
}

#[test]
fn liquids_reach_into_the_glass_and_not_out_of_it() {
    let mut random = Random::from_seed(3);
    for (name, spec) in vessels() {
        let vessel = spec.build().unwrap();
        let in_glass = profile_contains(&vessel.glass_profile);
        let size = spec.outer.size();
        let cavity = spec.cavity().unwrap();
        for (i, profile) in vessel.liquid_profiles.iter().enumerate() {
            let in_liquid = profile_contains(profile);
            for _ in 0..3_000 {
                let (r, y) = (random.between(0.0, size), random.between(-0.1, 1.2) * size);
                let p = DVec3::new(r, y, 0.0);
                if in_liquid(p) != Some(true) || in_glass(p) != Some(false) {
                    continue;
                }
                // In the liquid and not in the glass: in the cavity, below the surface, right of no wall.
                let (piece, s) = cavity.wall_at(y).unwrap_or_else(|| panic!("{name}: liquid {i} at {r} {y}"));
                assert!(r < piece.at(s).x && y > cavity.bottom(), "{name}: liquid {i} at {r} {y}");
            }
        }
    }
}

#[test]
fn a_meniscus_climbs_as_high_as_asked_and_meets_the_flat_part_smoothly() {
    let (level, meniscus) = (0.6, 0.002);
    let vessel = tumbler(Rim::Flat, &[(level, meniscus)]).build().unwrap();
    let flat = 0.008 + level * 0.092;
    let profile = &vessel.liquid_profiles[0];
    let arc = profile.pieces().iter().find(|piece| matches!(piece, Piece::Arc { .. })).unwrap();
    let at_wall = arc.at(arc.at_radius(0.032)[0]);
    assert!((at_wall.y - (flat + meniscus)).abs() < 1e-15);
    let angle = hyaline_math::float::f64::acos(arc.tangent_at(arc.at_radius(0.032)[0]).dot(-DVec2::Y));
    assert!((angle.to_degrees() - 20.0).abs() < 1e-9, "{}", angle.to_degrees());
    assert!(arc.tangent_at(1.0).distance(-DVec2::X) < 1e-12 && (arc.to().y - flat).abs() < 1e-15);
    // Liquid below, so outward is up.
    assert!(arc.normal_at(1.0).distance(DVec2::Y) < 1e-12);
}

#[test]
fn walls_have_the_same_thickness_everywhere() {
    for (name, spec) in vessels() {
        let cavity = spec.cavity().unwrap();
        for p in cavity.wall.iter().flat_map(|piece| (1..50).map(|i| piece.at(f64::from(i) / 50.0))) {
            let distance = spec.outer.pieces().iter().map(|piece| piece.distance(p)).fold(f64::MAX, f64::min);
            // At a flat base the wall's foot is nearer to the profile's end than to the wall that goes on below.
            assert!(distance > spec.wall - 1e-12 && distance < 1.3 * spec.wall, "{name}: {distance}");
        }
    }
}

#[test]
fn impossible_vessels_are_refused_with_reasons() {
    let refused = |change: &dyn Fn(&mut VesselSpec), words: &str| {
        let mut spec = tumbler(Rim::Round, &[(0.4, 0.001), (0.7, 0.001)]);
        change(&mut spec);
        let message = spec.build().map(|_| ()).expect_err(words).to_string();
        assert!(message.contains(words), "{message}");
    };
    let set = |level: Level, meniscus: f64| vec![FillSpec { level, meniscus }];
    refused(&|spec| spec.wall = 0.04, "wall is 0.04: it leaves no opening");
    refused(&|spec| spec.wall = 0.0, "wall is 0");
    refused(&|spec| spec.wall = f64::NAN, "wall is NaN");
    refused(&|spec| spec.base = -0.001, "base is -0.001");
    refused(&|spec| spec.base = 0.0, "base is 0");
    refused(&|spec| spec.base = 0.2, "height of the inner base is 0.2");
    refused(&|spec| spec.fill[1].level = Level::Fraction(1.2), "level is 1.2");
    refused(&|spec| spec.fill[0].level = Level::Fraction(0.0), "level is 0");
    refused(&|spec| spec.fill[0].level = Level::Fraction(f64::NAN), "level is NaN");
    refused(&|spec| spec.fill[0].level = Level::Height(0.2), "level is 0.2");
    refused(&|spec| spec.fill.swap(0, 1), "from the lowest up");
    refused(&|spec| spec.fill[0].meniscus = 0.05, "height of a liquid's surface");
    refused(&|spec| spec.fill[1].meniscus = 0.05, "meniscus is 0.05");
    refused(&|spec| spec.fill[1].meniscus = -0.001, "meniscus is -0.001");
    refused(&|spec| spec.fill = set(Level::Fraction(0.2), 0.06), "does not fit between");
    let tight = |spec: &mut VesselSpec| {
        spec.outer = Profile::sphere_bowl(0.05, 0.0, 0.03).unwrap();
        spec.wall = 0.06;
    };
    refused(&tight, "wall is 0.06");
    let pinched = |spec: &mut VesselSpec| {
        spec.outer =
            Profile::lines(&[[0.03, 0.0], [0.04, 0.05], [0.0415, 0.051], [0.04, 0.052], [0.04, 0.1]])
                .unwrap();
    };
    refused(&pinched, "too tightly curved");
}
