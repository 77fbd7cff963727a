//! A mesh with its tree, and the search for its crossings.

use super::collapse;
use super::node::{BLOCK, Block, Tree};
use super::query::Sink;
use super::ray::{FilterRay, SlabRay};
use super::simd::{Lanes, prefetch, with_capacity_in_large_pages};
use super::traverse::{Visitor, traverse};
use crate::hit::Candidate;
use crate::mesh::Mesh;
use crate::mesh::triangle::LocalRay;
use hyaline_math::Bounds;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// A mesh and the tree over its faces; many instances can share one.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshBvh {
    mesh: Mesh,
    tree: Tree,
    blocks: Vec<Block>,
}

impl MeshBvh {
    /// Builds the tree; the same for any number of threads.
    pub fn new(mesh: Mesh) -> Self {
        let faces = 0..mesh.face_count() as u32;
        let boxes: Vec<Bounds> =
            faces.into_par_iter().map(|face| Bounds::from_points(mesh.corners(face))).collect();
        let (tree, leaves) = collapse::build(&boxes, BLOCK as u32);
        drop(boxes);
        let mut blocks = with_capacity_in_large_pages(leaves.len());
        blocks.par_extend((0..leaves.len()).into_par_iter().map(|leaf| block(&mesh, leaves.get(leaf))));
        Self { mesh, tree, blocks }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Memory of the tree, without the mesh, bytes.
    pub fn tree_size(&self) -> usize {
        size_of_val(&self.tree.nodes[..]) + size_of_val(&self.blocks[..])
    }

    /// Gives the crossings of the ray to the sink.
    #[inline(always)]
    pub(crate) fn search<L: Lanes, K: Sink>(
        &self,
        lanes: L,
        ray: &LocalRay,
        slabs: &SlabRay,
        item: u32,
        sink: &mut K,
    ) -> ControlFlow<()> {
        let registers = lanes.prepare_triangles(&FilterRay::new(ray, slabs, &self.tree));
        let mut faces = Faces { lanes, registers, blocks: &self.blocks, ray, item, sink };
        traverse(lanes, &self.tree, slabs, &mut faces)
    }
}

/// The block of some faces, at most eight.
fn block(mesh: &Mesh, faces: &[u32]) -> Block {
    let mut block = Block::empty();
    for (lane, &face) in faces.iter().enumerate() {
        block.set(lane, face, mesh.corners(face));
    }
    block
}

/// Tests the triangles of the leaves.
struct Faces<'a, L: Lanes, K> {
    lanes: L,
    registers: L::Triangles,
    blocks: &'a [Block],
    ray: &'a LocalRay,
    item: u32,
    sink: &'a mut K,
}

impl<L: Lanes, K: Sink> Visitor for Faces<'_, L, K> {
    const IS_ORDERED: bool = K::IS_ORDERED;

    #[inline(always)]
    fn limit(&self) -> f32 {
        self.sink.limit()
    }

    #[inline(always)]
    fn prefetch(&self, index: usize) {
        prefetch(self.blocks, index);
    }

    #[inline(always)]
    fn leaf(&mut self, index: usize) -> ControlFlow<()> {
        let block = &self.blocks[index];
        let mut lanes = self.lanes.filter(&self.registers, block, self.sink.limit());
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize & (BLOCK - 1);
            lanes &= lanes - 1;
            if let Some(hit) = self.ray.turned_triangle(block.corners(lane, self.ray.axes)) {
                let (primitive, barycentric) = (block.faces[lane], hit.barycentric);
                self.sink.take(Candidate { t: hit.t, item: self.item, primitive, barycentric })?;
            }
        }
        ControlFlow::Continue(())
    }
}
