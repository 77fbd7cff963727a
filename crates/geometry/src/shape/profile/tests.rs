//! Profiles that are no profiles are refused, and pieces keep their geometry.

use super::*;
use hyaline_math::float::f64::sin_cos;
use hyaline_testkit::Random;

fn message(result: Result<Profile, ShapeError>) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn profiles_that_cross_themselves_are_refused() {
    let crossing = [[0.1, 0.0], [0.5, 1.0], [0.5, 0.0], [0.1, 1.0]];
    let text = message(Profile::lines(&crossing));
    assert!(text.contains("meets itself near radius 0.3") && text.contains("pieces 0 and 2"), "{text}");
    let back = [[0.1, 0.0], [0.5, 0.0], [0.2, 0.0]];
    assert!(message(Profile::lines(&back)).contains("meets itself"));
    let touching = [[0.1, 0.0], [0.5, 0.0], [0.5, 1.0], [0.3, 0.0]];
    assert!(message(Profile::lines(&touching)).contains("meets itself"));
    let overlapping = [[0.1, 0.0], [0.5, 0.0], [0.5, 1.0], [0.6, 1.0], [0.6, 0.0], [0.4, 0.0]];
    assert!(message(Profile::lines(&overlapping)).contains("meets itself"));
}

#[test]
fn arcs_that_cross_are_found() {
    let (a, b) = (DVec2::new(0.5, 0.0), DVec2::new(0.5, 0.3));
    let lower = Piece::arc(a, 0.3, -1.0, 3.0);
    let line = Piece::line(lower.to(), DVec2::new(0.1, 0.8));
    let upper = Piece::tangent_arc(line.to(), DVec2::new(1.0, 0.0), DVec2::new(0.75, 0.0));
    assert!(message(Profile::from_pieces(vec![lower, line, upper])).contains("meets itself"));
    let far = Piece::arc(b, 0.6, 2.0, -1.0);
    assert!(message(Profile::from_pieces(vec![lower, far])).contains("gap"));
}

#[test]
fn closed_outlines_are_profiles() {
    let square = [[0.2, 0.0], [0.4, 0.0], [0.4, 0.2], [0.2, 0.2], [0.2, 0.0]];
    assert_eq!(Profile::lines(&square).unwrap().pieces().len(), 4);
    let ring = Piece::arc(DVec2::new(0.5, 0.0), 0.1, 0.0, std::f64::consts::TAU);
    assert!(Profile::from_pieces(vec![ring]).is_ok());
}

#[test]
fn bad_numbers_are_refused() {
    assert!(message(Profile::lines(&[[0.1, 0.0], [f64::NAN, 1.0]])).contains("NaN"));
    assert!(message(Profile::lines(&[[0.1, 0.0], [0.1, f64::INFINITY]])).contains("height"));
    assert!(message(Profile::lines(&[[0.1, 0.0], [-0.1, 1.0]])).contains("-0.1"));
    assert!(message(Profile::lines(&[[0.1, 0.0], [0.1, 0.0]])).contains("1 distinct"));
    assert!(message(Profile::lines(&[])).contains("0 distinct"));
    assert!(Profile::from_pieces(vec![]).is_err());
    let nan = Piece::arc(DVec2::new(0.5, f64::NAN), 0.1, 0.0, 1.0);
    assert!(Profile::from_pieces(vec![nan]).is_err());
    let across = Piece::arc(DVec2::new(0.05, 0.0), 0.1, 0.0, 3.0);
    assert!(message(Profile::from_pieces(vec![across])).contains("one side of the axis"));
    assert!(message(Profile::sphere_bowl(0.1, 0.2, 0.05)).contains("base radius"));
    assert!(message(Profile::sphere_bowl(0.1, 0.02, 0.1)).contains("opening radius"));
}

#[test]
fn repeated_points_count_once() {
    let points = [[0.1, 0.0], [0.1, 0.0], [0.2, 1.0], [0.2, 1.0]];
    assert_eq!(Profile::lines(&points).unwrap().pieces().len(), 1);
}

#[test]
fn tangent_arcs_leave_along_the_tangent_and_arrive() {
    let mut random = Random::from_seed(1);
    for _ in 0..10_000 {
        let (sin, cos) = sin_cos(random.between(0.0, 7.0));
        let tangent = DVec2::new(cos, sin);
        let from = DVec2::new(random.between(1.0, 2.0), random.uniform());
        let to = DVec2::new(random.between(1.0, 2.0), random.uniform());
        let piece = Piece::tangent_arc(from, tangent, to);
        assert!(piece.from().distance(from) < 1e-10 && piece.to().distance(to) < 1e-10);
        assert!(piece.tangent_at(0.0).distance(tangent) < 1e-5);
    }
}

#[test]
fn nearest_points_and_level_crossings_are_those_of_a_fine_chain() {
    let mut random = Random::from_seed(2);
    for _ in 0..300 {
        let center = DVec2::new(random.between(1.0, 2.0), random.between(-1.0, 1.0));
        let sweep = random.between(-6.2, 6.2);
        let piece = Piece::arc(center, random.between(0.1, 1.0), random.between(-9.0, 9.0), sweep);
        let p = DVec2::new(random.between(0.0, 3.0), random.between(-2.0, 2.0));
        let chain: Vec<DVec2> = (0..=4000).map(|i| piece.at(f64::from(i) / 4000.0)).collect();
        let brute = chain.iter().map(|q| q.distance(p)).fold(f64::MAX, f64::min);
        assert!((piece.distance(p) - brute).abs() < 1e-3 && piece.distance(p) <= brute + 1e-12);
        let lowest = chain.iter().map(|q| q.x).fold(f64::MAX, f64::min);
        assert!((piece.least_radius() - lowest).abs() < 1e-5);
        let crossings = chain.windows(2).filter(|pair| (pair[0].y < p.y) != (pair[1].y < p.y)).count();
        let levels = piece.at_height(p.y);
        assert_eq!(levels.len(), crossings);
        assert!(levels.iter().all(|&s| (piece.at(s).y - p.y).abs() < 1e-12));
    }
}

#[test]
fn insets_keep_their_distance() {
    let outer = [[0.30, 0.0], [0.45, 0.1], [0.5, 0.5], [0.4, 0.8], [0.42, 1.0]];
    for profile in [Profile::lines(&outer).unwrap(), Profile::smooth(&outer).unwrap()] {
        for distance in [0.001, 0.02, 0.05] {
            let inner = inset(&profile, distance, 0.15).unwrap();
            assert!((inner[0].from().y - 0.15).abs() < 1e-15);
            let tip = profile.end() - profile.pieces()[profile.pieces().len() - 1].normal_at(1.0) * distance;
            assert!(inner[inner.len() - 1].to().distance(tip) < 1e-14);
            for pair in inner.windows(2) {
                assert!(pair[0].to().distance(pair[1].from()) < 1e-14);
            }
            for p in inner.iter().flat_map(|piece| (0..=50).map(|i| piece.at(f64::from(i) / 50.0))) {
                let nearest = profile.pieces().iter().map(|piece| piece.distance(p)).fold(f64::MAX, f64::min);
                // At a corner that bends inward the miter stands farther off.
                assert!(nearest > distance - 1e-12 && nearest < distance * 1.2, "{nearest} {distance}");
            }
        }
    }
}
