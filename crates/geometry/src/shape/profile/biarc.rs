//! A smooth curve of arcs through points: two arcs between neighbors, tangents from circles through three points.
//!
//! Source: Bolton, Biarc curves, Computer-Aided Design 7(2), 1975; the joint with equal legs.

use super::Piece;
use hyaline_math::DVec2;

/// Arcs, or lines where they are nearly straight, through distinct points. Points on a circle give that circle.
pub(super) fn through(points: &[DVec2]) -> Vec<Piece> {
    let tangents = tangents(points);
    let mut pieces = Vec::new();
    for (ends, tangents) in points.windows(2).zip(tangents.windows(2)) {
        biarc(ends[0], tangents[0], ends[1], tangents[1], &mut pieces);
    }
    pieces
}

/// Unit tangents at the points, along the walk.
fn tangents(points: &[DVec2]) -> Vec<DVec2> {
    let last = points.len() - 1;
    let inner = |i: usize| {
        // Inversion about the middle point turns the circle through three points into a line along its tangent there.
        let (before, after) = (points[i] - points[i - 1], points[i + 1] - points[i]);
        let tangent = before / before.length_squared() + after / after.length_squared();
        tangent.try_normalize().unwrap_or_else(|| before.perp().normalize())
    };
    let size = points.iter().fold(0.0, |size, p| f64::max(size, p.abs().max_element()));
    let is_on_axis = |i: usize| points[i].x <= 1e-9 * size;
    let end = |i: usize, neighbor: usize| {
        let chord = points[i.max(neighbor)] - points[i.min(neighbor)];
        let along = chord.normalize();
        if is_on_axis(i) && chord.x != 0.0 {
            return DVec2::new(chord.x.signum(), 0.0);
        }
        // The tangents at both ends of an arc mirror each other about its chord.
        let other = if last == 1 { along } else { inner(neighbor) };
        2.0 * other.dot(along) * along - other
    };
    let tangent = |i: usize| match i {
        0 => end(0, 1),
        i if i == last => end(last, last - 1),
        i => inner(i),
    };
    (0..=last).map(tangent).collect()
}

/// Two arcs from `from` to `to` with the given unit tangents and a common tangent where they join.
fn biarc(from: DVec2, tangent_from: DVec2, to: DVec2, tangent_to: DVec2, pieces: &mut Vec<Piece>) {
    let chord = to - from;
    let sum = chord.dot(tangent_from + tangent_to);
    let spread = 2.0 * (1.0 - tangent_from.dot(tangent_to));
    // Leg of both arcs' tangent triangles: the positive root of spread d² + 2 sum d = chord², without cancellation.
    let root = (sum * sum + spread * chord.length_squared()).sqrt();
    let leg = chord.length_squared() / (sum + root);
    if !(leg.is_finite() && leg > 0.0) {
        pieces.push(Piece::line(from, to));
        return;
    }
    let joint = 0.5 * (from + to + leg * (tangent_from - tangent_to));
    let whole = Piece::tangent_arc(from, tangent_from, to);
    if whole.tangent_at(1.0).distance(tangent_to) < 1e-12 {
        pieces.push(whole);
        return;
    }
    pieces.push(Piece::tangent_arc(from, tangent_from, joint));
    pieces.push(Piece::tangent_arc(to, -tangent_to, joint).reversed());
}
