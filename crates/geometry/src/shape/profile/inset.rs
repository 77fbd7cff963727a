//! The curve parallel to a profile at some distance inside, as the inner side of a wall.
//!
//! 1. Every piece moves to the left hand of the walk: lines shift, arcs change their radius.
//! 2. Neighbors are cut or continued to where they meet (a miter), so the distance is the same everywhere.
//! 3. From the rim down, pieces are taken until the curve reaches the floor or the axis; the first piece is continued
//!    to get there if need be.

use super::meeting::{circle_circle, line_circle, line_line};
use super::{Piece, Profile, ShapeError};
use hyaline_math::DVec2;
use std::f64::consts::TAU;

/// Pieces parallel to `outer` at `distance` to the inside, walked up from height `floor` or the axis to the rim.
///
/// # Errors
/// Where nothing is left of the curve, it never comes down to the floor, or the profile is curved more tightly than
/// the distance allows.
pub(crate) fn inset(outer: &Profile, distance: f64, floor: f64) -> Result<Vec<Piece>, ShapeError> {
    let pieces = outer.pieces();
    let axis = 1e-12 * outer.size();
    let mut end = shifted_end(pieces, distance);
    if end.x <= axis {
        let r = outer.end().x;
        let remedy = format!("it leaves no opening at the rim, whose radius is {r}: give a thinner wall");
        return Err(ShapeError::out_of_range("wall", distance, remedy));
    }
    if end.y <= floor {
        let remedy = format!("it must be below the inner side of the rim, at height {}", end.y);
        return Err(ShapeError::out_of_range("height of the inner base", floor, remedy));
    }
    let mut downward = Vec::new();
    for i in (0..pieces.len()).rev() {
        let too_thick = || {
            let [r, y] = pieces[i].at(0.5).to_array();
            let remedy = format!(
                "the profile is too tightly curved for it near radius {r}, height {y}: give a thinner wall"
            );
            ShapeError::out_of_range("wall", distance, remedy)
        };
        let parallel = pieces[i].inset(distance).ok_or_else(too_thick)?;
        let start = if i > 0 { joint(&pieces[i - 1], &pieces[i], distance) } else { None };
        let last = parallel.unclamped(end, 1.0);
        let first =
            start.map_or(-continuation(&parallel, outer.size()), |start| parallel.unclamped(start, 0.0));
        if first >= last {
            return Err(too_thick());
        }
        let piece = parallel.trimmed(first, last);
        if let Some(lowest) = cut_at_bottom(&piece, floor, axis) {
            downward.push(lowest);
            downward.reverse();
            return Ok(downward);
        }
        if i > 0 {
            end = start.ok_or_else(too_thick)?;
        }
        downward.push(piece);
    }
    let remedy = "the wall's inner side never comes down to it: give a thicker base";
    Err(ShapeError::out_of_range("height of the inner base", floor, remedy))
}

/// The rim's end of the parallel curve.
fn shifted_end(pieces: &[Piece], distance: f64) -> DVec2 {
    let last = &pieces[pieces.len() - 1];
    last.to() - last.normal_at(1.0) * distance
}

/// By which fraction of itself a piece is continued before its start, to be sure to reach the floor or the axis.
fn continuation(piece: &Piece, size: f64) -> f64 {
    match *piece {
        Piece::Line { .. } => 4.0 * size / piece.length(),
        Piece::Arc { sweep, .. } => (0.999 * TAU / sweep.abs() - 1.0).max(0.0),
    }
}

/// The part of the piece above the last place where it comes to the floor or the axis, if it does.
fn cut_at_bottom(piece: &Piece, floor: f64, axis: f64) -> Option<Piece> {
    let starts_on_axis = (piece.from().x.abs() <= axis).then_some(0.0);
    let fractions = piece.at_height(floor).into_iter().chain(piece.at_radius(0.0)).chain(starts_on_axis);
    // A cut at the very end would leave nothing; the piece above was cut there already.
    let cut = fractions.filter(|&s| s < 1.0).reduce(f64::max)?;
    let rest = piece.trimmed(cut, 1.0);
    Some(match rest {
        Piece::Line { from, to } if (from.y - floor).abs() <= axis => {
            Piece::line(DVec2::new(from.x, floor), to)
        }
        Piece::Line { .. } | Piece::Arc { .. } => rest,
    })
}

/// Where the parallels of two neighbors meet.
fn joint(a: &Piece, b: &Piece, distance: f64) -> Option<DVec2> {
    let (n_a, n_b) = (a.normal_at(1.0), b.normal_at(0.0));
    let corner = b.from();
    let cosine = n_a.dot(n_b);
    let are_lines = matches!((a, b), (Piece::Line { .. }, Piece::Line { .. }));
    if are_lines || cosine > 1.0 - 1e-9 {
        return (cosine > -1.0 + 1e-9).then(|| corner - (n_a + n_b) * (distance / (1.0 + cosine)));
    }
    let meetings = match (a.inset(distance)?, b.inset(distance)?) {
        (Piece::Line { from: p, to }, Piece::Line { from: q, to: other }) => {
            line_line(p, to - p, q, other - q)
        }
        (Piece::Line { from, to }, Piece::Arc { center, radius, .. })
        | (Piece::Arc { center, radius, .. }, Piece::Line { from, to }) => {
            line_circle(from, to - from, center, radius)
        }
        (Piece::Arc { center, radius, .. }, Piece::Arc { center: other, radius: other_radius, .. }) => {
            circle_circle(center, radius, other, other_radius)
        }
    };
    let by_distance = |p: &DVec2, q: &DVec2| p.distance(corner).total_cmp(&q.distance(corner));
    meetings.into_iter().flatten().min_by(by_distance)
}
