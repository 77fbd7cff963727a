//! The outlines of the liquids in a vessel.
//!
//! From the axis below the inner base, out to a curve inside the glass, up along it to beside the contact with the
//! wall, inward through the wall, down the meniscus and level to the axis. Each liquid runs at its own depth.

use super::{Cavity, FillSpec, LOWEST, Level, level_from_axis};
use crate::shape::ShapeError;
use crate::shape::profile::{Piece, Profile, inset};
use hyaline_math::DVec2;
use hyaline_math::float::f64::{acos, atan2, cos, sin};

/// Angle at which a meniscus meets the wall, 20°, as of water on glass that is not perfectly clean; less where the
/// wall leans out so far that a meniscus would not rise.
const CONTACT_ANGLE: f64 = 0.349_065_850_398_866;

/// Where a liquid's surface lies.
struct Surface {
    /// Height of the flat part.
    flat: f64,
    /// Height of the contact with the wall.
    contact: f64,
    /// How deep in the glass the liquid runs, as a fraction of the wall.
    depth: f64,
}

/// The closed outline of each liquid, from the lowest up.
pub(super) fn liquid_profiles(cavity: &Cavity) -> Result<Vec<Profile>, ShapeError> {
    let surfaces = surfaces(cavity)?;
    let outline = |i: usize| {
        // An upper liquid reaches half-way into the one below, the lowest into the glass.
        let floor = match i {
            0 => cavity.base - cavity.spec.base.min(cavity.spec.wall) * surfaces[0].depth,
            1 => 0.5 * (cavity.bottom() + surfaces[0].flat),
            i => 0.5 * (surfaces[i - 2].flat + surfaces[i - 1].flat),
        };
        liquid_profile(cavity, &surfaces[i], floor)
    };
    (0..surfaces.len()).map(outline).collect()
}

/// Heights of all surfaces, checked.
fn surfaces(cavity: &Cavity) -> Result<Vec<Surface>, ShapeError> {
    let fill = &cavity.spec.fill;
    let mut below = cavity.bottom();
    let mut surfaces = Vec::new();
    for (i, spec) in fill.iter().enumerate() {
        let flat = level_height(cavity, spec.level)?;
        if flat <= below + 1e-9 * cavity.spec.outer.size() {
            let remedy = format!(
                "it must be above {below}, where what is below ends; list liquids from the lowest up"
            );
            return Err(ShapeError::out_of_range("height of a liquid's surface", flat, remedy));
        }
        let contact = flat + meniscus_height(cavity, spec, flat)?;
        below = contact;
        surfaces.push(Surface { flat, contact, depth: (i + 1) as f64 / (fill.len() + 1) as f64 });
    }
    Ok(surfaces)
}

fn level_height(cavity: &Cavity, level: Level) -> Result<f64, ShapeError> {
    let (bottom, top) = (cavity.bottom(), cavity.top());
    match level {
        Level::Fraction(fraction) if fraction > 0.0 && fraction <= 1.0 => {
            // Exact at both ends.
            Ok(bottom * (1.0 - fraction) + top * fraction)
        }
        Level::Fraction(fraction) => {
            let remedy = "give a fraction of the inner height, above 0 and at most 1";
            Err(ShapeError::out_of_range("level", fraction, remedy))
        }
        Level::Height(height) if height > bottom && height <= top => Ok(height),
        Level::Height(height) => {
            let remedy = format!("give a height above {bottom}, the inner base, and at most {top}, the rim");
            Err(ShapeError::out_of_range("level", height, remedy))
        }
    }
}

fn meniscus_height(cavity: &Cavity, spec: &FillSpec, flat: f64) -> Result<f64, ShapeError> {
    let room = cavity.top() - flat;
    if spec.meniscus >= 0.0 && spec.meniscus <= room {
        return Ok(spec.meniscus);
    }
    let remedy = format!("give a height from 0 to {room}, which is left up to the rim, or a lower level");
    Err(ShapeError::out_of_range("meniscus", spec.meniscus, remedy))
}

fn liquid_profile(cavity: &Cavity, surface: &Surface, floor: f64) -> Result<Profile, ShapeError> {
    let spec = cavity.spec;
    let side = inset(&spec.outer, spec.wall * (1.0 - surface.depth), floor)?;
    let mut pieces = vec![];
    level_from_axis(side[0].from(), spec.axis(), &mut pieces);
    let depth = 0.5 * surface.depth * spec.wall;
    let (top, (piece, s)) = join(cavity, surface, &side, depth)?;
    pieces.extend_from_slice(&side[..piece]);
    let last = side[piece].trimmed(0.0, s);
    if last.length() > spec.axis() {
        pieces.push(last);
    }
    pieces.push(Piece::line(side[piece].at(s), top[0].from()));
    pieces.extend(top);
    Profile::named("the outline of a liquid", "change its level or lower its meniscus", pieces)
}

/// The surface, and the place on the liquid's side that it is joined to by a line inside the glass.
fn join(
    cavity: &Cavity,
    surface: &Surface,
    side: &[Piece],
    depth: f64,
) -> Result<(Vec<Piece>, (usize, f64)), ShapeError> {
    let deep = top(cavity, surface, depth)?;
    let (piece, s) = foot(side, deep[0].from());
    if piece < side.len() - 1 || s < 1.0 - 1e-9 {
        return Ok((deep, (piece, s)));
    }
    // In a brimful glass the surface ends at the wall itself, and the line slopes down so as not to run in the rim.
    let lower = (1.0 - depth / side[piece].length()).max(0.5);
    Ok((top(cavity, surface, 0.0)?, (piece, lower)))
}

/// The surface from `depth` inside the wall to the axis, walked inward.
fn top(cavity: &Cavity, surface: &Surface, depth: f64) -> Result<Vec<Piece>, ShapeError> {
    let unreachable = || {
        let remedy = "the inner wall has no point at this height: change the level";
        ShapeError::out_of_range("height of a liquid's contact with the wall", surface.contact, remedy)
    };
    let (piece, s) = cavity.wall_at(surface.contact).ok_or_else(unreachable)?;
    let contact = piece.at(s);
    let rise = surface.contact - surface.flat;
    if rise == 0.0 {
        let start = DVec2::new(contact.x + depth, surface.flat);
        return Ok(vec![Piece::line(start, DVec2::new(0.0, surface.flat))]);
    }
    let along = piece.tangent_at(s);
    let slope = atan2(along.y, along.x);
    let contact_angle = CONTACT_ANGLE.min(0.5 * slope);
    let turn = slope - contact_angle;
    let radius = rise / (1.0 - cos(turn));
    let center = DVec2::new(contact.x - radius * sin(turn), surface.flat + radius);
    check_fit(cavity, surface, center, radius)?;
    // On into the wall along the same circle, by at most half the contact angle and about `depth`.
    let cosine = (cos(contact_angle) + depth / radius).min(1.0);
    let further = (contact_angle - acos(cosine)).min(0.5 * contact_angle);
    let sweep = turn + if depth > 0.0 { further } else { 0.0 };
    let arc = Piece::arc(center, radius, LOWEST + sweep, -sweep);
    Ok(vec![arc, Piece::line(arc.to(), DVec2::new(0.0, surface.flat))])
}

/// The circle of a meniscus must leave a flat part and stay inside the wall.
fn check_fit(cavity: &Cavity, surface: &Surface, center: DVec2, radius: f64) -> Result<(), ShapeError> {
    let rise = surface.contact - surface.flat;
    let fits = |height: f64| {
        let y = surface.flat + height * rise;
        let on_circle = center.x + ((2.0 * radius - (y - surface.flat)) * (y - surface.flat)).max(0.0).sqrt();
        cavity.wall_at(y).is_some_and(|(piece, s)| on_circle < piece.at(s).x)
    };
    if center.x > cavity.spec.axis() && [0.0, 0.25, 0.5, 0.75].into_iter().all(fits) {
        return Ok(());
    }
    let remedy = "it does not fit between the wall and the axis here: give a lower one";
    Err(ShapeError::out_of_range("meniscus", rise, remedy))
}

/// The point of the curve nearest to `p`: its piece and the fraction.
fn foot(curve: &[Piece], p: DVec2) -> (usize, f64) {
    let distances = curve.iter().map(|piece| piece.distance(p));
    let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i);
    (nearest, curve[nearest].nearest(p))
}
