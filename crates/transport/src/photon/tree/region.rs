//! Where queries look: a ball, or a disc.

use hyaline_math::Vec3;

/// Where a query looks: a ball, or a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Center.
    pub center: Vec3,
    /// Radius, scene units, ≥ 0; may be infinite. What lies on the edge is inside.
    pub radius: f32,
    /// What makes a disc of the ball.
    pub disc: Option<Disc>,
}

/// A disc: the part of a ball close to a plane through its center.
///
/// Its proportions are fixed, and what is nearest is found by growing it: the distance of a point is the radius of the
/// smallest disc that holds it, the larger of its distance from the center and of that from the plane over `thickness`.
/// So the disc through the k-th photon rejects, by its own size, what a disc of the largest radius would let in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Normal of the plane, unit.
    pub normal: Vec3,
    /// Half its thickness as a fraction of its radius, 0…1; less than 1/1000 is taken for that, as surfaces are not
    /// known better.
    pub thickness: f32,
}

/// Least thickness of a disc.
const MIN_THICKNESS: f32 = 1e-3;

/// What distances are measured from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe {
    pub(super) center: [f32; 3],
    /// Normal of the disc over its thickness.
    pub(super) normal: [f32; 3],
    pub(super) is_disc: bool,
    /// Squared distances below this are inside.
    pub(super) limit: f32,
}

impl Probe {
    /// `None` where nothing can be inside.
    pub(super) fn new(region: &Region) -> Option<Self> {
        if !(region.center.is_finite() && region.radius >= 0.0) {
            return None;
        }
        let normal =
            region.disc.map_or(Vec3::ZERO, |disc| disc.normal / disc.thickness.clamp(MIN_THICKNESS, 1.0));
        let limit = (region.radius * region.radius).next_up();
        let is_disc = region.disc.is_some();
        Some(Self { center: region.center.to_array(), normal: normal.to_array(), is_disc, limit })
    }
}
