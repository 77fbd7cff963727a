//! What surfaces separate, and what a path finds where it crosses some of them.

use crate::{Medium, MediumId};

/// Index of an object in the world's list of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectId(pub u32);

/// What an object's surface separates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundaryKind {
    /// No media: an opaque or a thin thing.
    None,
    /// A closed body of one medium; bodies may overlap.
    Solid {
        /// What it is made of.
        medium: MediumId,
        /// Of overlapping solids the one of highest priority is there; among equals that of the highest object id.
        priority: i32,
    },
    /// A sheet, open or closed, that names the media on both sides.
    Interface {
        /// Medium on the side the geometric normal points to.
        outside: MediumId,
        /// Medium on the other side.
        inside: MediumId,
    },
}

/// The boundary of every object.
#[derive(Clone, Debug, Default)]
pub struct Boundaries {
    pub(super) kinds: Vec<BoundaryKind>,
}

impl Boundaries {
    /// A table; an object's id is its index.
    pub fn new(kinds: Vec<BoundaryKind>) -> Self {
        Self { kinds }
    }

    /// The boundary of an object; `None` for one that the table does not hold.
    pub fn of(&self, object: ObjectId) -> BoundaryKind {
        self.kinds.get(object.0 as usize).copied().unwrap_or(BoundaryKind::None)
    }

    pub(super) fn solid(&self, object: ObjectId) -> Option<Solid> {
        match self.of(object) {
            BoundaryKind::Solid { medium, priority } => Some(Solid { priority, object, medium }),
            BoundaryKind::None | BoundaryKind::Interface { .. } => None,
        }
    }
}

/// Which way a ray crosses a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Against the geometric normal: from the outside to the inside.
    Entering,
    /// Along the geometric normal.
    Leaving,
}

impl Side {
    /// From the cosine between the ray's direction and the geometric normal.
    pub fn from_cosine(direction_dot_ng: f32) -> Self {
        if direction_dot_ng < 0.0 { Self::Entering } else { Self::Leaving }
    }

    /// The other way.
    pub fn reversed(self) -> Self {
        match self {
            Self::Entering => Self::Leaving,
            Self::Leaving => Self::Entering,
        }
    }
}

/// A surface in the way of a ray.
pub type SurfaceCrossing = (ObjectId, Side);

/// What one or more coinciding surfaces are to a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// Nothing: they lie inside a solid of higher rank, or cancel each other. The path goes straight on, and commits.
    Hidden,
    /// A boundary.
    Boundary {
        /// Medium on the side the ray comes from.
        from: MediumId,
        /// Medium on the far side.
        to: MediumId,
        /// The object whose finish applies.
        owner: ObjectId,
    },
}

impl Crossing {
    /// Whether nothing bends or reflects here by itself, because both sides have the same index; the finish may
    /// still do something.
    ///
    /// - `media`: all media, indexed by `MediumId`.
    ///
    /// # Panics
    /// Where a medium id is beyond the list.
    pub fn is_index_matched(&self, media: &[Medium]) -> bool {
        match *self {
            Self::Hidden => true,
            Self::Boundary { from, to, .. } => media[from.index()].is_index_matched(&media[to.index()]),
        }
    }
}

/// A solid, ordered by rank: fields in the order that decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Solid {
    pub(super) priority: i32,
    pub(super) object: ObjectId,
    pub(super) medium: MediumId,
}

/// The side by which a path crosses `object`; `None` where it does not, or both ways at once.
pub(super) fn net_side(surfaces: &[SurfaceCrossing], object: ObjectId) -> Option<Side> {
    let mut sides = surfaces.iter().filter(|surface| surface.0 == object).map(|surface| surface.1);
    let first = sides.next()?;
    sides.all(|side| side == first).then_some(first)
}

/// Each object that is crossed, once.
pub(super) fn net_crossings(surfaces: &[SurfaceCrossing]) -> impl Iterator<Item = SurfaceCrossing> {
    surfaces.iter().enumerate().filter_map(|(i, &(object, _))| {
        let is_first = surfaces[..i].iter().all(|earlier| earlier.0 != object);
        if is_first { net_side(surfaces, object).map(|side| (object, side)) } else { None }
    })
}

/// Highest id among the objects that satisfy `condition`.
pub(super) fn highest(
    surfaces: &[SurfaceCrossing],
    condition: impl Fn(ObjectId) -> bool,
) -> Option<ObjectId> {
    surfaces.iter().map(|surface| surface.0).filter(|&object| condition(object)).max()
}
