//! What photons could have made of the path so far: a sum that the path carries along for its weights.
//!
//! Photons may be merged at every vertex of a path that is not singular. The density of each such way, over that of
//! drawing all directions from the eye, is the factor of the vertex, times those of the vertices between it and the light,
//! times that of the light (`weight`). So one sum of squares is all there is to know of the way so far.
//!
//! A photon straight from a light is never merged, as sampling the light does that better: what the last vertex counts
//! is kept apart until something lies between it and the light.

/// The sum, but for the factor of the light.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Merges {
    /// Squares of the ways to merge at vertices before the last that is not singular.
    earlier: f32,
    /// Square of the way to merge at that one.
    last: f32,
    /// Whether something singular has been met since.
    is_apart: bool,
    /// Whether the last vertex passed the path on as polished ones do: which photons come this way.
    is_specular: bool,
}

impl Merges {
    /// Sum over the vertices behind one that is not singular, seen from there: all of them.
    pub(super) fn behind(&self) -> f32 {
        self.earlier + self.last
    }

    /// Sum at a light that the path has come to.
    pub(super) fn at_light(&self) -> f32 {
        if self.is_apart { self.behind() } else { self.earlier }
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
    ///
    /// - `own`, `across`: its factors, see `weight`.
    /// - `is_specular`: whether it is nearly polished.
    pub(super) fn pass(&mut self, own: f32, across: f32, is_specular: bool) {
        *self =
            Self { earlier: self.behind() * across * across, last: own * own, is_apart: false, is_specular };
    }
}
