//! The descent of a ray through a tree, nearest child first.

use super::node::{Child, Node, Tree};
use super::ray::{BoxRay, SlabRay};
use super::simd::{Lanes, Nears, Stack, prefetch};
use std::ops::ControlFlow;

/// What to do at the leaves.
pub(crate) trait Visitor {
    /// Whether near children should come first.
    const IS_ORDERED: bool;
    /// Boxes that begin beyond this distance are skipped; it may shrink.
    fn limit(&self) -> f32;
    /// Begins to load a leaf that will be visited soon.
    fn prefetch(&self, index: usize);
    /// Visits a leaf; `Break` ends the descent.
    fn leaf(&mut self, index: usize) -> ControlFlow<()>;
}

/// Visits the leaves whose boxes the ray meets between its `t_min`, or 0 if that is negative, and the limit.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, V: Visitor>(
    lanes: L,
    tree: &Tree,
    ray: &SlabRay,
    visitor: &mut V,
) -> ControlFlow<()> {
    let Some(mut current) = tree.root else {
        return ControlFlow::Continue(());
    };
    if current.is_leaf() {
        return visitor.leaf(current.index());
    }
    let boxes = lanes.prepare_boxes(&BoxRay::new(ray, tree));
    let mut stack = Stack::new();
    loop {
        let mut next = Some(current);
        while let Some(child) = next
            && !child.is_leaf()
        {
            let node = &tree.nodes[child.index()];
            // What it holds is asked for last, but should be on its way with the boxes.
            prefetch(&node.children, 0);
            let (nears, hits) = lanes.hit_boxes(&boxes, node, visitor.limit());
            next = choose(tree, visitor, &mut stack, node, &nears, hits);
        }
        if let Some(leaf) = next {
            visitor.leaf(leaf.index())?;
        }
        loop {
            match stack.pop() {
                None => return ControlFlow::Continue(()),
                Some(entry) if near_of(entry) <= visitor.limit() => {
                    current = child_of(entry);
                    break;
                }
                Some(_) => {}
            }
        }
    }
}

/// The nearest child that was hit; the others go on the stack, the nearest on top. One child hit is the most frequent
/// case, and two the next.
#[inline(always)]
fn choose<V: Visitor>(
    tree: &Tree,
    visitor: &V,
    stack: &mut Stack,
    node: &Node,
    nears: &Nears,
    mut hits: u32,
) -> Option<Child> {
    if hits == 0 {
        return None;
    }
    let mut take = || {
        let slot = hits.trailing_zeros() as usize & 7;
        hits &= hits - 1;
        (entry(nears.0[slot], node.children[slot]), hits != 0)
    };
    let (first, has_second) = take();
    if !has_second {
        return Some(child_of(first));
    }
    // Most of the time is spent waiting for memory; this lets the children wait together.
    let warm = |entry: u64| {
        let child = child_of(entry);
        if child.is_leaf() {
            visitor.prefetch(child.index());
        } else {
            prefetch(&tree.nodes, child.index());
        }
    };
    let (second, mut has_more) = take();
    warm(first);
    warm(second);
    let start = stack.len();
    let is_swapped = V::IS_ORDERED && first < second;
    let (far, mut near) = if is_swapped { (second, first) } else { (first, second) };
    stack.push(far);
    while has_more {
        let (other, rest) = take();
        has_more = rest;
        warm(other);
        let is_nearer = !V::IS_ORDERED || other < near;
        stack.push(if is_nearer { near } else { other });
        near = if is_nearer { other } else { near };
        if V::IS_ORDERED && !is_nearer {
            stack.sink_last(start);
        }
    }
    Some(child_of(near))
}

/// A stack entry; a later one in the order of integers is a farther one, since distances are not negative.
#[inline(always)]
fn entry(near: f32, child: Child) -> u64 {
    u64::from(near.to_bits()) << 32 | u64::from(child.bits())
}

#[inline(always)]
fn near_of(entry: u64) -> f32 {
    f32::from_bits((entry >> 32) as u32)
}

#[inline(always)]
fn child_of(entry: u64) -> Child {
    Child::from_bits(entry as u32)
}
