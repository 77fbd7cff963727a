//! What photons could have made of the path so far: sums that the path carries along for its weights.
//!
//! Photons may be merged at every vertex of a path that is not singular. The density of each such way, over that of
//! drawing all directions from the eye, is the factor of the vertex, times those of the vertices between it and the light,
//! times that of the light (`weight`). So sums of squares are all there is to know of the way so far.
//!
//! Two things are known only further along the path. A photon that has been scattered widely on its way is gathered from a
//! larger radius on surfaces; so sums are kept apart until a wide vertex is passed. And a photon straight from a light is
//! merged by beams alone, as sampling the light does that better elsewhere; so what the last vertex counts is kept apart
//! until something lies between it and the light.

use super::radius::INDIRECT;
use hyaline_scattering::Medium;

/// What kind of photons a vertex merges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::integrator) enum Place {
    /// A surface: points, from a radius that depends on their way; none straight from a light.
    #[default]
    Surface,
    /// A medium with a grid: points, none straight from a light.
    Grid,
    /// A homogeneous medium: beams of any way.
    Beams,
}

impl Place {
    /// What a particle of a medium merges. Along a way through a grid nobody knows what a beam carries.
    pub(in crate::integrator) fn in_medium(medium: &Medium) -> Self {
        if medium.grid.is_some() { Self::Grid } else { Self::Beams }
    }
}

/// How the way beyond a vertex goes on to the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beyond {
    /// Through polished and nearly polished surfaces alone.
    Polished,
    /// Over a wide vertex, too.
    Wide,
}

/// Sums of squares, but for the factor of the light.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Merges {
    /// Surfaces with nothing but polished and nearly polished vertices since, but for the last vertex.
    polished: f32,
    /// All others but the last vertex.
    settled: f32,
    /// The last vertex that was not singular.
    last: f32,
    last_place: Place,
    /// Whether something singular has been met since.
    is_apart: bool,
    /// Whether the last vertex passed the path on as polished ones do: which photons come this way.
    is_specular: bool,
}

/// What is known of a vertex when a path passes it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passed {
    pub(super) place: Place,
    /// Its factors, see `weight`; on a surface `own` is for photons that have not been scattered widely.
    pub(super) own: f32,
    pub(super) across: f32,
    /// Whether it is nearly polished.
    pub(super) is_specular: bool,
}

/// What the square of a surface's factor gains where photons have been scattered widely.
const GAIN: f32 = INDIRECT * INDIRECT * INDIRECT * INDIRECT;

impl Merges {
    /// Sum over the vertices behind one that is not singular, seen from there.
    ///
    /// - `beyond`: the way to the light, that vertex included.
    pub(super) fn behind(&self, beyond: Beyond) -> f32 {
        let (polished, settled) = self.with_last();
        match beyond {
            Beyond::Polished => polished + settled,
            Beyond::Wide => polished * GAIN + settled,
        }
    }

    /// Whether there is nothing to merge behind.
    pub(super) fn is_empty(&self) -> bool {
        self.polished + self.settled + self.last == 0.0
    }

    /// Sum at a light that the path has come to.
    pub(super) fn at_light(&self) -> f32 {
        if self.is_apart || self.last_place == Place::Beams {
            return self.behind(Beyond::Polished);
        }
        self.polished + self.settled
    }

    /// Whether the vertex next to the light is polished or nearly so.
    pub(super) fn is_specular(&self) -> bool {
        self.is_specular
    }

    /// Passes a singular vertex.
    pub(super) fn pass_singular(&mut self) {
        (self.is_apart, self.is_specular) = (true, true);
    }

    /// Passes another vertex.
    pub(super) fn pass(&mut self, vertex: &Passed) {
        let across = vertex.across * vertex.across;
        let (polished, settled) = match vertex.is_specular {
            true => self.with_last(),
            false => (0.0, self.behind(Beyond::Wide)),
        };
        *self = Self {
            polished: polished * across,
            settled: settled * across,
            last: vertex.own * vertex.own,
            last_place: vertex.place,
            is_apart: false,
            is_specular: vertex.is_specular,
        };
    }

    fn with_last(&self) -> (f32, f32) {
        match self.last_place {
            Place::Surface => (self.polished + self.last, self.settled),
            Place::Grid | Place::Beams => (self.polished, self.settled + self.last),
        }
    }
}
