//! Drinking glasses, bowls and bottles with what is in them, as closed solids for a renderer with priorities.
//!
//! The glass is one solid: base, outer wall, rim, inner wall, inner base. Each liquid is a solid that reaches part of
//! the way into the glass, so that no two boundaries coincide: **the glass must outrank every liquid**, and then the
//! visible boundaries are glass-liquid along the inner wall, glass-air above it and liquid-air on top. An upper
//! liquid reaches down into the lower one: **`liquids[0]` must outrank `liquids[1]`, and so on.**

mod liquid;
#[cfg(test)]
mod tests;

use crate::Primitive;
use crate::shape::compose::{Ends, revolution};
use crate::shape::profile::{Piece, Profile, inset};
use crate::shape::{ShapeError, WHOLE_TURN};
use hyaline_math::DVec2;
use hyaline_math::float::f64::atan2;
use liquid::liquid_profiles;
use std::f64::consts::{FRAC_PI_2, PI};

/// A vessel: its outside, its thickness and its filling. Lengths in scene units.
#[derive(Clone, Debug, PartialEq)]
pub struct VesselSpec {
    /// The outside from the base's outer edge up to the rim: `Profile::lines`, `smooth` or `sphere_bowl`. It starts
    /// at the height on which the vessel stands; a start on the axis makes a vessel that is round or pointed below.
    pub outer: Profile,
    /// Thickness of the wall, measured across it, > 0.
    pub wall: f64,
    /// Height of the inner base above the start of the profile, > 0; 0 is allowed where the profile starts on the
    /// axis and the wall closes the vessel below.
    pub base: f64,
    /// Form of the rim.
    pub rim: Rim,
    /// Liquids from the lowest up.
    pub fill: Vec<FillSpec>,
}

/// Form of the rim, which joins the ends of the outer and the inner wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rim {
    /// Half a torus, tangent to both sides of the wall; it stands half a wall above the profile's end.
    #[default]
    Round,
    /// Cut square to the wall: an annulus on an upright wall, a cone on a slanted one.
    Flat,
}

/// One liquid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FillSpec {
    /// Where its flat surface is.
    pub level: Level,
    /// How far it climbs the wall, scene units; 0 is flat to the wall.
    pub meniscus: f64,
}

/// Height of a liquid's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// Fraction of the way from the inner base up to the inner end of the rim, above 0, at most 1.
    Fraction(f64),
    /// Height in the coordinates of the profile.
    Height(f64),
}

/// A vessel's surfaces, about the y axis, at the heights of its profile; normals of each solid point outward.
#[derive(Clone, Debug, PartialEq)]
pub struct Vessel {
    /// The closed surface of the glass.
    pub glass: Vec<Primitive>,
    /// The closed surface of each liquid, from the lowest up.
    pub liquids: Vec<Vec<Primitive>>,
    /// The glass's cross section, walked with the outside on the right hand.
    pub glass_profile: Profile,
    /// The cross section of each liquid.
    pub liquid_profiles: Vec<Profile>,
    /// Height of the bottom of the cavity on the axis, and of the inner end of the rim.
    pub inner_heights: [f64; 2],
}

/// The inside of a vessel.
struct Cavity<'a> {
    spec: &'a VesselSpec,
    /// The inner wall, walked up.
    wall: Vec<Piece>,
    /// Height of the plane that cuts the inner wall off below, if the wall reaches it.
    base: f64,
}

impl VesselSpec {
    /// Builds the surfaces.
    ///
    /// # Errors
    /// Where a thickness is not finite and above 0, the wall leaves no cavity or is too thick for the curves of the
    /// profile, the glass would cross itself, a level is outside the cavity or not above the one below, or a meniscus
    /// does not fit.
    pub fn build(&self) -> Result<Vessel, ShapeError> {
        let cavity = self.cavity()?;
        let glass_profile = self.glass_profile(&cavity)?;
        let liquid_profiles = liquid_profiles(&cavity)?;
        let turned = |profile: &Profile| revolution(profile, WHOLE_TURN, Ends::Open);
        Ok(Vessel {
            glass: turned(&glass_profile)?,
            liquids: liquid_profiles.iter().map(turned).collect::<Result<_, _>>()?,
            inner_heights: [cavity.bottom(), cavity.top()],
            glass_profile,
            liquid_profiles,
        })
    }

    /// Radius below which a point counts as one of the axis.
    fn axis(&self) -> f64 {
        1e-12 * self.outer.size()
    }

    fn cavity(&self) -> Result<Cavity<'_>, ShapeError> {
        let quantity = |name, value: f64, is_valid: bool| {
            let remedy = "give a finite thickness above 0";
            if is_valid && value.is_finite() {
                Ok(())
            } else {
                Err(ShapeError::out_of_range(name, value, remedy))
            }
        };
        let is_closed_below = self.outer.start().x <= self.axis();
        quantity("wall", self.wall, self.wall > 0.0)?;
        quantity("base", self.base, self.base > 0.0 || (is_closed_below && self.base == 0.0))?;
        let base = self.outer.start().y + self.base;
        Ok(Cavity { spec: self, wall: inset(&self.outer, self.wall, base)?, base })
    }

    /// The glass from the axis below, around, to the axis above the base.
    fn glass_profile(&self, cavity: &Cavity) -> Result<Profile, ShapeError> {
        let mut pieces = vec![];
        level_from_axis(self.outer.start(), self.axis(), &mut pieces);
        pieces.extend_from_slice(self.outer.pieces());
        let (outer_end, inner_end) = (self.outer.end(), cavity.wall[cavity.wall.len() - 1].to());
        pieces.push(match self.rim {
            Rim::Flat => Piece::line(outer_end, inner_end),
            Rim::Round => {
                let outward = outer_end - inner_end;
                let start = atan2(outward.y, outward.x);
                Piece::arc(0.5 * (outer_end + inner_end), 0.5 * self.wall, start, PI)
            }
        });
        let mut inner = vec![];
        level_from_axis(cavity.wall[0].from(), self.axis(), &mut inner);
        inner.extend_from_slice(&cavity.wall);
        pieces.extend(inner.iter().rev().map(Piece::reversed));
        Profile::named(
            "the outline of the glass",
            "make the wall or the base thinner, or the vessel wider",
            pieces,
        )
    }
}

impl Cavity<'_> {
    /// Height of the lowest point on the axis.
    fn bottom(&self) -> f64 {
        self.wall[0].from().y
    }

    /// Height of the inner end of the rim.
    fn top(&self) -> f64 {
        self.wall[self.wall.len() - 1].to().y
    }

    /// The place on the inner wall, counted from below, at height `y`: the piece and the fraction.
    fn wall_at(&self, y: f64) -> Option<(&Piece, f64)> {
        let top = &self.wall[self.wall.len() - 1];
        if (y - self.top()).abs() <= self.spec.axis() {
            return Some((top, 1.0));
        }
        self.wall.iter().find_map(|piece| piece.at_height(y).first().map(|&s| (piece, s)))
    }
}

/// Adds the level line from the axis to `p`, unless `p` is on it.
fn level_from_axis(p: DVec2, axis: f64, pieces: &mut Vec<Piece>) {
    if p.x > axis {
        pieces.push(Piece::line(DVec2::new(0.0, p.y), p));
    }
}

/// Angle of a circle's lowest point.
const LOWEST: f64 = -FRAC_PI_2;
