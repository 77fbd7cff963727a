//! Where pieces of a profile meet that should not.

use super::Piece;
use hyaline_math::DVec2;

/// The first two pieces that meet elsewhere than in a joint, and where.
///
/// - `tolerance`: distance below which points count as one.
pub(super) fn first_meeting(pieces: &[Piece], tolerance: f64) -> Option<(usize, usize, DVec2)> {
    let last = pieces.len() - 1;
    let is_closed = pieces[0].from().distance(pieces[last].to()) <= tolerance;
    for (i, a) in pieces.iter().enumerate() {
        for (j, b) in pieces.iter().enumerate().skip(i + 1) {
            let mut joints = Vec::new();
            if j == i + 1 {
                joints.push((a.to(), a.tangent_at(1.0), b.tangent_at(0.0)));
            }
            if i == 0 && j == last && is_closed {
                joints.push((a.from(), b.tangent_at(1.0), a.tangent_at(0.0)));
            }
            if let Some(p) = meeting(a, b, &joints, tolerance) {
                return Some((i, j, p));
            }
        }
    }
    None
}

/// A point that both pieces hold, joints left out; a joint (point, tangent in, tangent out) may not turn back.
fn meeting(a: &Piece, b: &Piece, joints: &[(DVec2, DVec2, DVec2)], tolerance: f64) -> Option<DVec2> {
    let turned_back = joints.iter().find(|(_, into, out)| {
        into.dot(*out) < 0.0 && into.perp_dot(*out).abs() < 1e-9 && is_line(a) && is_line(b)
    });
    if let Some((p, ..)) = turned_back {
        return Some(*p);
    }
    let ends_on_other = [(a, b), (b, a)].into_iter().flat_map(|(one, other)| {
        [one.from(), one.to()].into_iter().filter(move |&p| other.distance(p) <= tolerance)
    });
    // Rounding spreads a joint at a small angle along both pieces.
    let is_joint = |p: DVec2| joints.iter().any(|(joint, ..)| joint.distance(p) <= 1e3 * tolerance);
    ends_on_other.chain(crossings(a, b)).find(|&p| !is_joint(p))
}

fn is_line(piece: &Piece) -> bool {
    matches!(piece, Piece::Line { .. })
}

/// Points in which two pieces cross; touching ends may be missed.
fn crossings(a: &Piece, b: &Piece) -> Vec<DVec2> {
    let candidates = match (*a, *b) {
        (Piece::Line { from, to }, Piece::Line { from: other, to: other_to }) => {
            line_line(from, to - from, other, other_to - other)
        }
        (Piece::Line { from, to }, Piece::Arc { center, radius, .. })
        | (Piece::Arc { center, radius, .. }, Piece::Line { from, to }) => {
            line_circle(from, to - from, center, radius)
        }
        (Piece::Arc { center, radius, .. }, Piece::Arc { center: other, radius: other_radius, .. }) => {
            circle_circle(center, radius, other, other_radius)
        }
    };
    let size = a.from().abs().max(b.from().abs()).max_element() + a.length() + b.length();
    let holds = |piece: &Piece, p: DVec2| piece.distance(p) <= 1e-12 * size;
    candidates.into_iter().flatten().filter(|&p| holds(a, p) && holds(b, p)).collect()
}

/// Meeting point of two unbounded lines, each a point and a direction.
pub(super) fn line_line(p: DVec2, d: DVec2, q: DVec2, e: DVec2) -> [Option<DVec2>; 2] {
    let cross = d.perp_dot(e);
    let t = (q - p).perp_dot(e) / cross;
    [t.is_finite().then_some(p + d * t), None]
}

/// Meeting points of an unbounded line and a circle.
pub(super) fn line_circle(p: DVec2, d: DVec2, center: DVec2, radius: f64) -> [Option<DVec2>; 2] {
    let closest = p + d * ((center - p).dot(d) / d.length_squared());
    let distance = closest.distance(center);
    let half = ((radius - distance) * (radius + distance)).sqrt();
    let step = d.normalize_or_zero() * half;
    [half.is_finite().then_some(closest - step), half.is_finite().then_some(closest + step)]
}

/// Meeting points of two circles; none where they are the same.
pub(super) fn circle_circle(a: DVec2, radius_a: f64, b: DVec2, radius_b: f64) -> [Option<DVec2>; 2] {
    let between = b - a;
    let distance = between.length();
    let along = 0.5 * (distance + (radius_a - radius_b) * (radius_a + radius_b) / distance);
    let across = ((radius_a - along) * (radius_a + along)).sqrt();
    let unit = between / distance;
    let point = |side: f64| a + unit * along + unit.perp() * (across * side);
    [across.is_finite().then(|| point(-1.0)), across.is_finite().then(|| point(1.0))]
}
