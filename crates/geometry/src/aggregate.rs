//! All geometry of a scene, and the three questions a ray can ask of it.
//!
//! Two levels: a tree over the items, and for each mesh a tree over its faces in the space of the mesh, which
//! instances share. Distances are always those along the ray in the world.

use crate::bvh::{
    self, Any, Closest, Every, Lanes, MeshBvh, Query, SimdLevel, Sink, SlabRay, Tree, VerifiedLevel, Visitor,
};
use crate::hit::{Candidate, SurfaceHit, Tangents};
use crate::mesh::triangle::LocalRay;
use crate::primitive::Primitive;
use hyaline_math::{Bounds, Ray, Transform, Vec2, Vec3};
use std::ops::ControlFlow;
use std::sync::Arc;

/// One object of a scene.
#[derive(Clone, Debug)]
pub struct Item {
    /// Its geometry.
    pub geometry: ItemGeometry,
    /// Kinds of rays that see it: a query whose mask has no bit in common passes through.
    pub mask: u8,
}

/// The geometry of an item.
#[derive(Clone, Debug)]
pub enum ItemGeometry {
    /// An analytic shape, placed in the world.
    Shape(Primitive),
    /// A mesh.
    Mesh {
        /// The mesh and its tree, which other items may share.
        mesh: Arc<MeshBvh>,
        /// From the mesh to the world; `None` where the mesh is in world space.
        transform: Option<Transform>,
    },
}

impl ItemGeometry {
    /// The box about the geometry in the world.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Shape(shape) => shape.bounds(),
            Self::Mesh { mesh, transform: None } => mesh.mesh().bounds(),
            Self::Mesh { mesh, transform: Some(transform) } => placed_bounds(mesh.mesh(), transform),
        }
    }
}

/// Items and the tree over them.
#[derive(Clone, Debug)]
pub struct Aggregate {
    items: Vec<Item>,
    tree: Tree,
    level: VerifiedLevel,
}

impl Aggregate {
    /// Builds the tree over the items; it uses the best instructions of this processor.
    pub fn build(items: Vec<Item>) -> Self {
        let boxes: Vec<Bounds> = items.iter().map(|item| within_range(item.geometry.bounds())).collect();
        let (mut tree, leaves) = bvh::build(&boxes, 1);
        tree.relabel(|leaf| leaves.get(leaf)[0] as usize);
        Self { items, tree, level: VerifiedLevel::new(SimdLevel::detect()) }
    }

    /// The same geometry, searched with other instructions; the best ones where the processor lacks them. Hits are
    /// the same bit for bit.
    pub fn with_simd_level(mut self, level: SimdLevel) -> Self {
        self.level = VerifiedLevel::new(level);
        self
    }

    /// The instructions in use.
    pub fn simd_level(&self) -> SimdLevel {
        self.level.level()
    }

    /// The nearest crossing with `t_min < t < t_max`; of several at the same distance that of the lowest item, then
    /// of the lowest primitive. A negative `t_min` counts as 0.
    ///
    /// - `mask`: which items to look at.
    pub fn closest(&self, ray: &Ray, mask: u8) -> Option<Candidate> {
        let ray = forward(ray);
        let mut sink = Closest::new(&ray);
        self.search(&ray, mask, &mut sink);
        sink.into_hit()
    }

    /// Whether there is a crossing with `t_min < t < t_max`. A negative `t_min` counts as 0.
    ///
    /// - `mask`: which items to look at.
    pub fn occluded(&self, ray: &Ray, mask: u8) -> bool {
        let ray = forward(ray);
        let mut sink = Any { t_max: ray.t_max, is_hit: false };
        self.search(&ray, mask, &mut sink);
        sink.is_hit
    }

    /// Passes each crossing with `t_min < t < t_max` to `visit` once, in no order. A negative `t_min` counts as 0.
    ///
    /// - `mask`: which items to look at.
    pub fn crossings(&self, ray: &Ray, mask: u8, visit: &mut impl FnMut(Candidate)) {
        let ray = forward(ray);
        self.search(&ray, mask, &mut Every { t_max: ray.t_max, visit });
    }

    /// The surface at a crossing that a query gave for this ray.
    ///
    /// # Panics
    /// Where the aggregate has no such item or primitive.
    pub fn surface(&self, ray: &Ray, hit: &Candidate) -> SurfaceHit {
        match &self.items[hit.item as usize].geometry {
            ItemGeometry::Shape(shape) => {
                SurfaceHit { item: hit.item, primitive: 0, ..shape.surface_at(ray, hit.t) }
            }
            ItemGeometry::Mesh { mesh, transform } => mesh.mesh().surface(hit, transform.as_ref()),
        }
    }

    /// The surface at a crossing, moved a little along a flat face where an edge is so near that a ray might start
    /// behind the next face: for surfaces that rays leave on the side they came from.
    ///
    /// - `hit`: what `surface` gave for this crossing.
    ///
    /// # Panics
    /// Where the aggregate has no such item or primitive.
    pub fn off_the_edges(&self, hit: SurfaceHit, candidate: &Candidate) -> SurfaceHit {
        match &self.items[hit.item as usize].geometry {
            ItemGeometry::Shape(shape) => shape.off_the_edges(hit),
            ItemGeometry::Mesh { mesh, transform } => {
                mesh.mesh().off_the_edges(hit, candidate.barycentric, transform.as_ref())
            }
        }
    }

    /// Derivatives of the surface point at a hit by its coordinates.
    ///
    /// # Panics
    /// Where the aggregate has no such item or primitive.
    pub fn tangents(&self, hit: &SurfaceHit) -> Tangents {
        match &self.items[hit.item as usize].geometry {
            ItemGeometry::Shape(shape) => shape.tangents(hit.p),
            ItemGeometry::Mesh { mesh, transform } => mesh.mesh().tangents(hit.primitive, transform.as_ref()),
        }
    }

    /// The box about everything; empty where there is nothing.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds
    }

    /// The items, as they were given.
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    fn search<K: Sink>(&self, ray: &Ray, mask: u8, sink: &mut K) {
        self.level.run(Search { aggregate: self, ray, mask, sink });
    }
}

/// Boxes beyond this are cut off, so that products with a ray's direction stay finite.
const MAX_REACH: f32 = 1e18;

/// The box without infinities.
fn within_range(bounds: Bounds) -> Bounds {
    let limit = Vec3::splat(MAX_REACH);
    Bounds { min: bounds.min.clamp(-limit, limit), max: bounds.max.clamp(-limit, limit) }
}

/// The box about a placed mesh: about the images of the corners of the mesh's box, rounded outward.
fn placed_bounds(mesh: &crate::Mesh, transform: &Transform) -> Bounds {
    let local = mesh.bounds();
    let corners = (0..8).map(|i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { local.min[axis] } else { local.max[axis] };
        transform.point(Vec3::new(pick(0), pick(1), pick(2)).as_dvec3())
    });
    let (low, high) = corners
        .fold((hyaline_math::DVec3::INFINITY, hyaline_math::DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(p), high.max(p))
        });
    // Roundings of the map and of the conversion to f32 are well below this.
    let margin = f64::from(f32::EPSILON) * low.abs().max(high.abs()).max_element();
    Bounds { min: (low - margin).as_vec3(), max: (high + margin).as_vec3() }
}

/// The ray without the part behind its origin.
fn forward(ray: &Ray) -> Ray {
    Ray { t_min: ray.t_min.max(0.0), ..*ray }
}

/// A search of the whole aggregate.
struct Search<'a, K> {
    aggregate: &'a Aggregate,
    ray: &'a Ray,
    mask: u8,
    sink: &'a mut K,
}

impl<K: Sink> Query for Search<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let local = LocalRay::from_world(self.ray);
        let tree = &self.aggregate.tree;
        let slabs = SlabRay::new(&local);
        let items = &self.aggregate.items;
        let mut leaves = Leaves {
            lanes,
            items,
            ray: self.ray,
            local: &local,
            slabs: &slabs,
            mask: self.mask,
            sink: self.sink,
        };
        // Whether the sink broke off is of no interest: it knows what it took.
        let _ = bvh::traverse(lanes, tree, &slabs, &mut leaves);
    }
}

/// Searches the items of the leaves.
struct Leaves<'a, L, K> {
    lanes: L,
    items: &'a [Item],
    ray: &'a Ray,
    local: &'a LocalRay,
    slabs: &'a SlabRay,
    mask: u8,
    sink: &'a mut K,
}

impl<L: Lanes, K: Sink> Visitor for Leaves<'_, L, K> {
    const IS_ORDERED: bool = K::IS_ORDERED;

    #[inline(always)]
    fn limit(&self) -> f32 {
        self.sink.limit()
    }

    #[inline(always)]
    fn prefetch(&self, _: usize) {}

    #[inline(always)]
    fn leaf(&mut self, index: usize) -> ControlFlow<()> {
        let item = &self.items[index];
        if item.mask & self.mask == 0 {
            return ControlFlow::Continue(());
        }
        match &item.geometry {
            ItemGeometry::Shape(shape) => self.shape(shape, index as u32),
            ItemGeometry::Mesh { mesh, transform } => match transform {
                None => mesh.search(self.lanes, self.local, self.slabs, index as u32, self.sink),
                Some(transform) => {
                    let local = LocalRay::from_placed(self.ray, transform);
                    mesh.search(self.lanes, &local, &SlabRay::new(&local), index as u32, self.sink)
                }
            },
        }
    }
}

impl<L: Lanes, K: Sink> Leaves<'_, L, K> {
    #[inline(always)]
    fn shape(&mut self, shape: &Primitive, item: u32) -> ControlFlow<()> {
        let candidate = |t| Candidate { t, item, primitive: 0, barycentric: Vec2::ZERO };
        if K::WANTS_EVERY {
            let sink = &mut *self.sink;
            // A sink that wants every crossing never breaks off.
            shape.crossings(self.ray, &mut |t| {
                let _ = sink.take(candidate(t));
            });
            return ControlFlow::Continue(());
        }
        // A hit at the limit itself is still of use where the item is a lower one.
        let t_max = self.sink.limit().next_up().min(self.ray.t_max);
        match shape.closest(&Ray { t_max, ..*self.ray }) {
            Some(t) => self.sink.take(candidate(t)),
            None => ControlFlow::Continue(()),
        }
    }
}

#[cfg(test)]
mod tests;
