//! A profile: a chain of lines and arcs in the (r, y) half-plane, to be turned about y.

mod biarc;
mod inset;
mod meeting;
mod piece;

pub(crate) use inset::inset;
pub use piece::Piece;

use super::ShapeError;
use super::error::{finite, not_negative, positive};
use hyaline_math::DVec2;
use hyaline_math::float::f64::acos;

/// A chain of lines and arcs that does not cross itself, walked with its outside on the right hand.
///
/// It may start or end on the axis, and may return to its start.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    pieces: Vec<Piece>,
}

impl Profile {
    /// Straight lines through points (radius, height). Points that repeat their predecessor are dropped.
    ///
    /// # Errors
    /// Where a number is not finite, a radius is below 0, fewer than two distinct points remain, or the lines cross
    /// or touch each other.
    pub fn lines(points: &[[f64; 2]]) -> Result<Self, ShapeError> {
        let points = distinct(points)?;
        Self::from_pieces(points.windows(2).map(|pair| Piece::line(pair[0], pair[1])).collect())
    }

    /// A curve of arcs with a continuous tangent through points (radius, height). A smooth start or end on the axis
    /// leaves it at a right angle, so that the turned surface has a normal there.
    ///
    /// # Errors
    /// As `lines`; also where the curve between two points crosses the axis.
    pub fn smooth(points: &[[f64; 2]]) -> Result<Self, ShapeError> {
        Self::from_pieces(biarc::through(&distinct(points)?))
    }

    /// The outside of a bowl that is a part of a sphere and stands at height 0, from the base's edge up to the rim.
    ///
    /// - `base_radius`: of the flat base; 0 for a bowl that is round below.
    /// - `opening_radius`: of the rim, which is above the sphere's center.
    ///
    /// # Errors
    /// Where a radius is not finite, or the base or the opening is not narrower than the sphere.
    pub fn sphere_bowl(radius: f64, base_radius: f64, opening_radius: f64) -> Result<Self, ShapeError> {
        positive("radius of a bowl", radius)?;
        not_negative("base radius of a bowl", base_radius)?;
        positive("opening radius of a bowl", opening_radius)?;
        for (quantity, r) in
            [("base radius of a bowl", base_radius), ("opening radius of a bowl", opening_radius)]
        {
            if r >= radius {
                let remedy = format!("it must be below the sphere's radius, {radius}");
                return Err(ShapeError::out_of_range(quantity, r, remedy));
            }
        }
        let center = DVec2::new(0.0, (radius * radius - base_radius * base_radius).sqrt());
        let start = -acos(base_radius / radius);
        let sweep = acos(opening_radius / radius) - start;
        Self::from_pieces(vec![Piece::arc(center, radius, start, sweep)])
    }

    /// A chain of given pieces, each starting where the last one ends.
    ///
    /// # Errors
    /// Where a number is not finite, a piece has no length or crosses the axis, two neighbors do not join, or pieces
    /// cross or touch each other.
    pub fn from_pieces(pieces: Vec<Piece>) -> Result<Self, ShapeError> {
        Self::named("the profile", "give points in the order of a walk along the outline", pieces)
    }

    /// As `from_pieces`, with the name and the remedy that a crossing is reported with.
    pub(crate) fn named(
        name: &'static str,
        remedy: &'static str,
        pieces: Vec<Piece>,
    ) -> Result<Self, ShapeError> {
        if pieces.is_empty() {
            return Err(ShapeError::TooFewPoints { count: 0 });
        }
        let size = size(&pieces);
        for piece in &pieces {
            positive("length of a profile's piece", piece.length())?;
            if piece.least_radius() < -1e-9 * size {
                let remedy =
                    "the profile must stay on one side of the axis; a smooth curve needs more points here";
                return Err(ShapeError::out_of_range("radius of a profile", piece.least_radius(), remedy));
            }
        }
        for pair in pieces.windows(2) {
            let gap = pair[0].to().distance(pair[1].from());
            if gap > 5e-10 * size {
                let remedy = "each piece must start where the last one ends";
                return Err(ShapeError::out_of_range("gap between pieces of a profile", gap, remedy));
            }
        }
        if let Some((first, second, at)) = meeting::first_meeting(&pieces, 1e-9 * size) {
            return Err(ShapeError::CrossesItself { profile: name, first, second, at: at.into(), remedy });
        }
        Ok(Self { pieces })
    }

    /// The pieces in the order of the walk.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// First point, (radius, height).
    pub fn start(&self) -> DVec2 {
        self.pieces[0].from()
    }

    /// Last point, (radius, height).
    pub fn end(&self) -> DVec2 {
        self.pieces[self.pieces.len() - 1].to()
    }

    /// Largest radius or absolute height.
    pub fn size(&self) -> f64 {
        size(&self.pieces)
    }

    /// The same curve walked backward: inside and outside change places.
    pub fn reversed(&self) -> Self {
        Self { pieces: self.pieces.iter().rev().map(Piece::reversed).collect() }
    }
}

fn size(pieces: &[Piece]) -> f64 {
    let points = pieces.iter().flat_map(|piece| [piece.from(), piece.at(0.5), piece.to()]);
    points.fold(0.0, |size, p| f64::max(size, p.abs().max_element()))
}

/// The points without repetitions, checked.
fn distinct(points: &[[f64; 2]]) -> Result<Vec<DVec2>, ShapeError> {
    for [r, y] in points {
        not_negative("radius of a profile's point", *r)?;
        finite("height of a profile's point", *y)?;
    }
    let size = points.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    let mut distinct: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
    distinct.dedup_by(|a, b| a.distance(*b) <= 1e-9 * size);
    if distinct.len() < 2 {
        return Err(ShapeError::TooFewPoints { count: distinct.len() });
    }
    Ok(distinct)
}

#[cfg(test)]
mod tests;
