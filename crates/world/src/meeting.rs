//! What a ray meets at a hit: the surface, what coincides with it, and what crossing it changes.

use crate::World;
use crate::material::Material;
use hyaline_geometry::{Candidate, ItemGeometry, SurfaceHit};
use hyaline_math::ray::offset_distance;
use hyaline_math::{Ray, Vec3, offset_origin};
use hyaline_scattering::{
    BoundaryKind, Crossing, MediumId, MediumSet, ObjectId, Side, Sides, SurfaceBsdf, SurfaceCrossing,
};
use smallvec::{SmallVec, smallvec};

/// What crossing a surface changes; an opaque surface changes nothing.
#[derive(Clone, Debug)]
pub struct Encounter {
    /// The boundary; `None` where no media meet.
    pub crossing: Option<Crossing>,
    /// Whether it is settled that the ray meets no hole: what lies behind would have been met instead.
    pub(crate) is_solid_there: bool,
    /// Whether the ray is in the tip of a wedge between the surface and an opaque one, too narrow for the start of
    /// another ray: it ends there.
    pub(crate) is_wedged: bool,
    surfaces: SmallVec<[SurfaceCrossing; 2]>,
}

impl Encounter {
    /// A surface that bounds no medium.
    fn opaque() -> Self {
        Self { crossing: None, is_solid_there: false, is_wedged: false, surfaces: SmallVec::new() }
    }

    /// Takes a path across: `set` becomes what holds on the other side.
    pub fn commit(&self, world: &World, set: &mut MediumSet) {
        set.commit(&world.boundaries, &self.surfaces);
    }
}

impl World {
    /// The surface at `candidate` and what crossing it changes for a path inside `set`.
    ///
    /// Boundaries that coincide within the error of the hit are crossed together: the next ray starts beyond all of
    /// them. Where an opaque surface is among them it is what the ray meets: it touches the body from inside.
    ///
    /// - `visible`: mask of the items that the ray sees.
    /// - `never_entered`: told the solids that the path leaves without having entered them; `set` is repaired.
    pub fn meet(
        &self,
        ray: &Ray,
        candidate: &Candidate,
        set: &mut MediumSet,
        visible: u8,
        never_entered: &mut impl FnMut(ObjectId),
    ) -> (SurfaceHit, Encounter) {
        let hit = self.geometry.surface(ray, candidate);
        let item = &self.items[hit.item as usize];
        if self.boundaries.of(item.object) == BoundaryKind::None {
            let hit = self.geometry.off_the_edges(hit, candidate);
            return self.meet_sheet(ray, hit, set, visible, never_entered);
        }
        let side = Side::from_cosine(ray.direction.dot(hit.ng));
        let mut surfaces = smallvec![(item.object, side)];
        // At the outline of a body rounding may swap the faces that a ray enters and leaves by.
        let is_swapped = side == Side::Leaving && self.is_unentered(item.object, set);
        if (item.may_coincide || is_swapped)
            && let Some(opaque) = self.gather(ray, &hit, visible, is_swapped, &mut surfaces)
        {
            // The ray goes away from the opaque surface, which a way through this one would cross against it.
            if ray.direction.dot(opaque.ng) * hit.ng.dot(opaque.ng) * ray.direction.dot(hit.ng) < 0.0 {
                return (hit, Encounter { is_wedged: true, ..Encounter::opaque() });
            }
            // At the foot of a wall the path is inside the body when it meets what the body stands on; on a label
            // stuck to a bottle it is not.
            let back = offset_origin(opaque.p, opaque.p_error, opaque.ng, -ray.direction);
            if side == Side::Entering && (back - hit.p).dot(hit.ng) < 0.0 {
                set.commit(&self.boundaries, &surfaces[..1]);
            }
            return (opaque, Encounter { is_solid_there: true, ..Encounter::opaque() });
        }
        let crossing = Some(set.crossing(&self.boundaries, &surfaces, never_entered));
        (hit, Encounter { crossing, surfaces, ..Encounter::opaque() })
    }

    /// The same for those who look and carry no light: the surface, and what crossing it changes where media meet there.
    pub fn look_at(
        &self,
        ray: &Ray,
        candidate: &Candidate,
        set: &mut MediumSet,
        visible: u8,
    ) -> (SurfaceHit, Option<Encounter>) {
        let item = &self.items[candidate.item as usize];
        // A sheet that lies on a boundary may have a hole there.
        if self.boundaries.of(item.object) == BoundaryKind::None && !item.may_coincide {
            return (self.geometry.surface(ray, candidate), None);
        }
        // What was never entered is told by the rays that carry light.
        let (hit, encounter) = self.meet(ray, candidate, set, visible, &mut |_| ());
        let is_boundary = encounter.crossing.is_some();
        (hit, is_boundary.then_some(encounter))
    }

    /// The same at a surface that bounds no medium. Where it lies on a boundary and has holes, as a label on a bottle
    /// has, a ray that meets a hole meets the boundary.
    fn meet_sheet(
        &self,
        ray: &Ray,
        hit: SurfaceHit,
        set: &mut MediumSet,
        visible: u8,
        never_entered: &mut impl FnMut(ObjectId),
    ) -> (SurfaceHit, Encounter) {
        if !(self.items[hit.item as usize].may_coincide && self.default_material(&hit).has_holes()) {
            return (hit, Encounter::opaque());
        }
        match self.boundary_behind(ray, &hit, visible) {
            Some(behind) if self.is_hole(ray, &hit) => self.meet(ray, &behind, set, visible, never_entered),
            behind => (hit, Encounter { is_solid_there: behind.is_some(), ..Encounter::opaque() }),
        }
    }

    /// The first boundary of a medium that a ray which goes on from `hit` would have passed over.
    fn boundary_behind(&self, ray: &Ray, hit: &SurfaceHit, visible: u8) -> Option<Candidate> {
        let next_start = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        let mut nearest: Option<Candidate> = None;
        self.geometry.crossings(&jumped_over(ray, hit), visible, &mut |other: Candidate| {
            let surface = self.geometry.surface(ray, &other);
            let is_passed = (next_start - surface.p).dot(surface.ng) * ray.direction.dot(surface.ng) >= 0.0;
            let object = self.items[other.item as usize].object;
            if is_passed
                && self.boundaries.of(object) != BoundaryKind::None
                && nearest.is_none_or(|first| (other.t, other.item) < (first.t, first.item))
            {
                nearest = Some(other);
            }
        });
        nearest
    }

    /// Whether `object` is a solid that a path within `set` has not entered.
    fn is_unentered(&self, object: ObjectId, set: &MediumSet) -> bool {
        matches!(self.boundaries.of(object), BoundaryKind::Solid { .. }) && !set.holds(object)
    }

    /// Adds the boundaries that are crossed together with that of `hit`; returns the first opaque surface that is met
    /// instead, if any.
    ///
    /// - `is_swapped`: whether the ray leaves at `hit` what it has not entered.
    fn gather(
        &self,
        ray: &Ray,
        hit: &SurfaceHit,
        visible: u8,
        is_swapped: bool,
        surfaces: &mut SmallVec<[SurfaceCrossing; 2]>,
    ) -> Option<SurfaceHit> {
        let leap = Leap::over(ray, hit);
        let object_hit = self.items[hit.item as usize].object;
        let mut opaque: Option<(f32, SurfaceHit)> = None;
        self.geometry.crossings(&leap.ray, visible, &mut |other: Candidate| {
            if (other.item, other.primitive) == (hit.item, hit.primitive) {
                return;
            }
            let surface = self.geometry.surface(&leap.ray, &other);
            let object = self.items[other.item as usize].object;
            if self.boundaries.of(object) != BoundaryKind::None {
                if !(is_swapped && object == object_hit) && leap.crosses(ray, other.t, &surface) {
                    surfaces.push((object, Side::from_cosine(leap.ray.direction.dot(surface.ng))));
                }
            } else if opaque.is_none_or(|(t, first)| (other.t, other.item) < (t, first.item))
                && !self.is_hole(ray, &surface)
            {
                let surface = SurfaceHit { t: hit.t, ..surface };
                opaque = Some((other.t, self.geometry.off_the_edges(surface, &other)));
            }
        });
        if is_swapped {
            self.gather_swapped(ray, hit, visible, surfaces);
        }
        opaque.map(|(_, surface)| surface)
    }

    /// Adds the other faces of a body that a ray leaves without having entered it: at its outline both lie within the
    /// error of the hit along the ray, and the one that it enters by may lie behind all that the ray leaps over.
    fn gather_swapped(
        &self,
        ray: &Ray,
        hit: &SurfaceHit,
        visible: u8,
        surfaces: &mut SmallVec<[SurfaceCrossing; 2]>,
    ) {
        let next_start = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        let object_hit = self.items[hit.item as usize].object;
        self.geometry.crossings(&jumped_over(ray, hit), visible, &mut |other: Candidate| {
            let is_same_body = self.items[other.item as usize].object == object_hit;
            if !is_same_body || (other.item, other.primitive) == (hit.item, hit.primitive) {
                return;
            }
            let surface = self.geometry.surface(ray, &other);
            let cosine = ray.direction.dot(surface.ng);
            let is_passed = (next_start - surface.p).dot(surface.ng) * cosine >= 0.0;
            if is_passed || cosine < 0.0 {
                surfaces.push((object_hit, Side::from_cosine(cosine)));
            }
        });
    }

    /// Suffern's local term of a simple transparent surface; `None` where it has none.
    ///
    /// - `wo`: where the path came from, unit, away from the surface.
    pub fn local_term(&self, hit: &SurfaceHit, wo: Vec3) -> Option<SurfaceBsdf> {
        let bsdf = self.default_material(hit).local_term()?;
        Some(SurfaceBsdf::new(bsdf, hit.n, hit.ng, wo, Sides::Both, self.lanes))
    }

    /// Whether a surface without media lets light through: a thin pane.
    pub fn is_thin(&self, hit: &SurfaceHit) -> bool {
        self.default_material(hit).is_thin()
    }

    /// Index of refraction of a medium.
    pub fn ior(&self, medium: MediumId) -> f32 {
        self.media[medium.0 as usize].ior
    }

    /// The finish in force: that of the surface hit, or of the object whose boundary wins where several coincide.
    pub(crate) fn material_of(&self, hit: &SurfaceHit, encounter: &Encounter) -> u32 {
        let item = &self.items[hit.item as usize];
        match encounter.crossing {
            Some(Crossing::Boundary { owner, .. }) if owner != item.object => {
                self.object_materials[owner.0 as usize]
            }
            _ => self.material_at(item.material, hit),
        }
    }

    /// The material of the surface itself.
    pub(crate) fn default_material(&self, hit: &SurfaceHit) -> &Material {
        &self.materials[self.material_at(self.items[hit.item as usize].material, hit) as usize]
    }

    /// The finish of a face, where a mesh has several.
    fn material_at(&self, default: u32, hit: &SurfaceHit) -> u32 {
        let slots = &self.items[hit.item as usize].slot_materials;
        if slots.is_empty() {
            return default;
        }
        match &self.geometry.items()[hit.item as usize].geometry {
            ItemGeometry::Mesh { mesh, .. } => {
                let slot = mesh.mesh().face_slot(hit.primitive);
                slots.get(slot as usize).copied().unwrap_or(default)
            }
            ItemGeometry::Shape(_) => default,
        }
    }
}

/// The way through a surface that no ray looks at: from where a reflected ray starts to where one that goes on does.
struct Leap {
    start: Vec3,
    end: Vec3,
    /// Along the way, from a little before its start to a little beyond its end: nothing opaque that touches them is
    /// missed.
    ray: Ray,
}

impl Leap {
    fn over(ray: &Ray, hit: &SurfaceHit) -> Self {
        let start = offset_origin(hit.p, hit.p_error, hit.ng, -ray.direction);
        let end = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        let (way, margin) = (end - start, 0.25 * (end - start));
        let length = way.length();
        let along = Ray::new(start - margin, way / length);
        Self { start, end, ray: Ray { t_max: 1.5 * length, time: ray.time, ..along } }
    }

    /// Whether who takes the way gets to the other side of a boundary that it meets at `t`. Where a body and another
    /// meet in a wedge, a reflected ray may start in the other one: that boundary is not crossed with this one.
    fn crosses(&self, ray: &Ray, t: f32, boundary: &SurfaceHit) -> bool {
        let ng = boundary.ng;
        let cosine = self.ray.direction.dot(ng);
        let height = |p: Vec3| (p - boundary.p).dot(ng) * cosine;
        let same_sense = cosine * ray.direction.dot(ng) >= 0.0;
        height(self.start) < 0.0 && height(self.end) >= 0.0 && (same_sense || t > 0.5 * self.ray.t_max)
    }
}

/// The part of a ray that the start of the next one jumps over where it goes on from `hit`.
fn jumped_over(ray: &Ray, hit: &SurfaceHit) -> Ray {
    let jump = offset_distance(hit.p, hit.p_error) / hit.ng.dot(ray.direction).abs().max(1e-3);
    Ray { t_min: hit.t.next_down(), t_max: (hit.t + jump).next_up().min(ray.t_max), ..*ray }
}
