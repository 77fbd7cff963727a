//! The three questions a ray can ask, and what each does with a hit.

use crate::hit::Candidate;
use hyaline_math::Ray;
use std::ops::ControlFlow;

/// Takes the hits of a ray as they are found.
pub(crate) trait Sink {
    /// Whether each crossing is wanted, not just one.
    const WANTS_EVERY: bool;
    /// Whether near boxes should come first.
    const IS_ORDERED: bool;
    /// Hits beyond this distance are of no use.
    fn limit(&self) -> f32;
    /// Takes a hit; `Break` ends the search.
    fn take(&mut self, hit: Candidate) -> ControlFlow<()>;
}

/// Keeps the nearest hit; of several at the same distance, that of the lowest item and primitive.
pub(crate) struct Closest {
    best: Candidate,
}

impl Closest {
    pub(crate) fn new(ray: &Ray) -> Self {
        let barycentric = hyaline_math::Vec2::ZERO;
        Self { best: Candidate { t: ray.t_max, item: u32::MAX, primitive: u32::MAX, barycentric } }
    }

    pub(crate) fn into_hit(self) -> Option<Candidate> {
        (self.best.item != u32::MAX).then_some(self.best)
    }
}

impl Sink for Closest {
    const WANTS_EVERY: bool = false;
    const IS_ORDERED: bool = true;

    #[inline(always)]
    fn limit(&self) -> f32 {
        self.best.t
    }

    #[inline(always)]
    fn take(&mut self, hit: Candidate) -> ControlFlow<()> {
        let is_nearer = hit.t < self.best.t;
        let is_first =
            hit.t == self.best.t && (hit.item, hit.primitive) < (self.best.item, self.best.primitive);
        if is_nearer || is_first {
            self.best = hit;
        }
        ControlFlow::Continue(())
    }
}

/// Stops at the first hit, wherever it is.
pub(crate) struct Any {
    pub(crate) t_max: f32,
    pub(crate) is_hit: bool,
}

impl Sink for Any {
    const WANTS_EVERY: bool = false;
    const IS_ORDERED: bool = false;

    #[inline(always)]
    fn limit(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn take(&mut self, _: Candidate) -> ControlFlow<()> {
        self.is_hit = true;
        ControlFlow::Break(())
    }
}

/// Passes each hit on.
pub(crate) struct Every<'a, F> {
    pub(crate) t_max: f32,
    pub(crate) visit: &'a mut F,
}

impl<F: FnMut(Candidate)> Sink for Every<'_, F> {
    const WANTS_EVERY: bool = true;
    const IS_ORDERED: bool = false;

    #[inline(always)]
    fn limit(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn take(&mut self, hit: Candidate) -> ControlFlow<()> {
        (self.visit)(hit);
        ControlFlow::Continue(())
    }
}
