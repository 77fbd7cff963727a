//! The cheapest 8-wide tree that follows a binary one.
//!
//! 1. From the leaves up: the cost of each subtree as at most i trees, for i = 1 to 7. One tree is a leaf or a node
//!    whose eight slots are shared out between the two children; several trees are shared out likewise.
//! 2. From the root down: nodes and leaves as those choices say.
//!
//! Source: Ylitie, Karras, Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, HPG 2017,
//! §3.1, eqs. 1-4.

use super::binary::{self, BinaryNode};
use super::node::{Child, MAX_DEPTH, Node, Tree, WIDTH};
use super::partition;
use super::simd::{collect_in_large_pages, with_capacity_in_large_pages};
use hyaline_math::Bounds;
use rayon::prelude::*;

/// Expected time to visit a node, in some unit.
const NODE_COST: f32 = 1.0;

/// Expected time to visit a leaf, in the same unit; a block takes as long for one triangle as for eight.
const LEAF_COST: f32 = 1.4;

/// Most trees that a subtree is split into.
const SPLITS: usize = WIDTH - 1;

/// More primitives than this are built in parts: memory while building, against the reach of reinsertion.
const LARGEST_WHOLE: usize = 1 << 20;

/// Primitives of a part, at most: few enough that what reinsertion jumps about in is mostly in the caches.
const LARGEST_PART: usize = 1 << 18;

/// Builds a tree over boxes, with at most `leaf_size` of them in a leaf; also tells which each leaf holds, ascending.
pub(crate) fn build(boxes: &[Bounds], leaf_size: u32) -> (Tree, Leaves) {
    let limit = if boxes.len() <= LARGEST_WHOLE { LARGEST_WHOLE } else { LARGEST_PART };
    build_in_parts(boxes, leaf_size, limit)
}

/// The same with parts of at most `limit` primitives.
pub(super) fn build_in_parts(boxes: &[Bounds], leaf_size: u32, limit: usize) -> (Tree, Leaves) {
    if boxes.is_empty() {
        return (Tree { nodes: Vec::new(), root: None, bounds: Bounds::EMPTY }, Leaves::default());
    }
    let built = if boxes.len() <= limit {
        binary::optimized(boxes).map(|binary| build_from(&binary, leaf_size))
    } else {
        build_parts(boxes, leaf_size, limit)
    };
    match built.filter(|(tree, _)| depth(&tree.nodes) <= MAX_DEPTH) {
        Some(built) => built,
        // As deep as the binary tree at most, which is less than 32 here.
        None => build_from(&binary::halved(boxes), leaf_size),
    }
}

fn build_from(binary: &[BinaryNode], leaf_size: u32) -> (Tree, Leaves) {
    let plans = plan(binary, leaf_size);
    let mut emitter = Emitter { binary, plans: &plans, nodes: Vec::new(), leaves: Leaves::default() };
    let root = emitter.emit();
    let nodes = collect_in_large_pages(emitter.nodes.into_iter());
    (Tree { nodes, root: Some(root), bounds: binary[0].bounds }, emitter.leaves)
}

/// A tree for each part, and one over them all.
fn build_parts(boxes: &[Bounds], leaf_size: u32, limit: usize) -> Option<(Tree, Leaves)> {
    let parts: Option<Vec<(Tree, Leaves)>> = partition::parts(boxes, limit)
        .into_par_iter()
        .map(|part| {
            let own: Vec<Bounds> = part.iter().map(|&i| boxes[i as usize]).collect();
            let (tree, mut leaves) = build_from(&binary::optimized(&own)?, leaf_size);
            leaves.primitives.iter_mut().for_each(|i| *i = part[*i as usize]);
            Some((tree, leaves))
        })
        .collect();
    let parts = parts?;
    let bounds: Vec<Bounds> = parts.iter().map(|(tree, _)| tree.bounds).collect();
    Some(joined(build_from(&binary::halved(&bounds), 1), parts))
}

/// Puts a tree in the place of each leaf of `upper`, which holds their numbers.
fn joined((upper, order): (Tree, Leaves), parts: Vec<(Tree, Leaves)>) -> (Tree, Leaves) {
    let node_count = parts.iter().map(|(tree, _)| tree.nodes.len()).sum::<usize>() + upper.nodes.len();
    let mut nodes = with_capacity_in_large_pages(node_count);
    nodes.extend(upper.nodes);
    let upper_count = nodes.len();
    let mut leaves = Leaves::default();
    let mut roots = Vec::with_capacity(parts.len());
    for (tree, part) in parts {
        let (first_node, first_leaf) = (nodes.len(), leaves.len());
        let place = |child: Child| {
            if child.is_leaf() {
                Child::leaf(first_leaf + child.index())
            } else {
                Child::node(first_node + child.index())
            }
        };
        roots.extend(tree.root.map(place));
        nodes.extend(tree.nodes.into_iter().map(|node| Node { children: node.children.map(place), ..node }));
        leaves.append(&part);
    }
    let root_of = |child: Child| {
        if child.is_leaf() { roots[order.get(child.index())[0] as usize] } else { child }
    };
    for node in &mut nodes[..upper_count] {
        node.children = node.children.map(root_of);
    }
    (Tree { nodes, root: upper.root.map(root_of), bounds: upper.bounds }, leaves)
}

/// The primitives of each leaf.
#[derive(Debug, Default)]
pub(crate) struct Leaves {
    primitives: Vec<u32>,
    ends: Vec<usize>,
}

impl Leaves {
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    pub(crate) fn get(&self, leaf: usize) -> &[u32] {
        let start = if leaf == 0 { 0 } else { self.ends[leaf - 1] };
        &self.primitives[start..self.ends[leaf]]
    }

    /// Adds the leaves of another part.
    fn append(&mut self, other: &Self) {
        let start = self.primitives.len();
        self.primitives.extend(&other.primitives);
        self.ends.extend(other.ends.iter().map(|end| start + end));
    }

    /// Adds a leaf; returns its index.
    fn push(&mut self, primitives: impl Iterator<Item = u32>) -> usize {
        let start = self.primitives.len();
        self.primitives.extend(primitives);
        self.primitives[start..].sort_unstable();
        self.ends.push(self.primitives.len());
        self.ends.len() - 1
    }
}

/// What to make of a subtree.
#[derive(Clone, Copy, Debug, Default)]
struct Plan {
    /// Least cost as at most i + 1 trees.
    costs: [f32; SPLITS],
    /// Trees for the left child where there are at most i + 1, 0 where fewer are no worse; index 0 is for a node with
    /// eight slots.
    lefts: [u8; SPLITS],
    is_leaf: bool,
}

/// The best plan of each subtree.
fn plan(binary: &[BinaryNode], leaf_size: u32) -> Vec<Plan> {
    let area = |node: &BinaryNode| {
        let size = node.bounds.size().as_dvec3();
        size.x * size.y + size.y * size.z + size.z * size.x
    };
    // Relative to the root, so that costs neither overflow nor vanish.
    let whole = area(&binary[0]).max(f64::MIN_POSITIVE);
    let mut plans = vec![Plan::default(); binary.len()];
    for i in (0..binary.len()).rev() {
        let node = &binary[i];
        let share = (area(node) / whole) as f32;
        let leaf_cost = if node.count <= leaf_size { share * LEAF_COST } else { f32::INFINITY };
        plans[i] = if node.is_leaf() {
            Plan { costs: [leaf_cost; SPLITS], lefts: [0; SPLITS], is_leaf: true }
        } else {
            plan_inner(&plans[i + 1], &plans[node.link as usize], leaf_cost, share * NODE_COST)
        };
    }
    plans
}

/// The best plan of an inner node, from those of its children.
fn plan_inner(left: &Plan, right: &Plan, leaf_cost: f32, node_cost: f32) -> Plan {
    // The cheapest way to share out `slots`: cost, trees on the left.
    let share_out = |slots: usize| {
        let mut best = (f32::INFINITY, 1);
        for on_left in 1..slots {
            let cost = left.costs[on_left - 1] + right.costs[slots - on_left - 1];
            if cost < best.0 {
                best = (cost, on_left as u8);
            }
        }
        best
    };
    let (children_cost, on_left) = share_out(WIDTH);
    let mut plan = Plan { is_leaf: leaf_cost <= children_cost + node_cost, ..Plan::default() };
    plan.lefts[0] = on_left;
    plan.costs[0] = leaf_cost.min(children_cost + node_cost);
    for slots in 2..=SPLITS {
        let (cost, on_left) = share_out(slots);
        let is_better = cost < plan.costs[slots - 2];
        plan.costs[slots - 1] = if is_better { cost } else { plan.costs[slots - 2] };
        plan.lefts[slots - 1] = if is_better { on_left } else { 0 };
    }
    plan
}

/// Writes the nodes of a plan.
struct Emitter<'a> {
    binary: &'a [BinaryNode],
    plans: &'a [Plan],
    nodes: Vec<Node>,
    leaves: Leaves,
}

impl Emitter<'_> {
    /// Writes all nodes, parents before children; returns the root.
    fn emit(&mut self) -> Child {
        if self.plans[0].is_leaf {
            return self.emit_leaf(0);
        }
        // Each entry is a subtree to become a node, and the node and slot that refer to it.
        let mut pending = vec![(0, None::<(usize, usize)>)];
        while let Some((subtree, referrer)) = pending.pop() {
            let here = self.nodes.len();
            self.nodes.push(Node::empty());
            if let Some((node, slot)) = referrer {
                self.nodes[node].children[slot] = Child::node(here);
            }
            let first_pending = pending.len();
            for (slot, child) in self.children(subtree).into_iter().enumerate() {
                let is_leaf = self.plans[child].is_leaf;
                let link = if is_leaf { self.emit_leaf(child) } else { Child::node(0) };
                self.nodes[here].set(slot, &self.binary[child].bounds, link);
                if !is_leaf {
                    pending.push((child, Some((here, slot))));
                }
            }
            pending[first_pending..].reverse();
        }
        Child::node(0)
    }

    /// The subtrees, at most eight, that become the children of a node.
    fn children(&self, subtree: usize) -> Vec<usize> {
        let mut children = Vec::with_capacity(WIDTH);
        let mut pending = vec![];
        let open = |node: usize, slots: usize, on_left: u8, pending: &mut Vec<(usize, usize)>| {
            let on_left = on_left as usize;
            pending.push((self.binary[node].link as usize, slots - on_left));
            pending.push((node + 1, on_left));
        };
        open(subtree, WIDTH, self.plans[subtree].lefts[0], &mut pending);
        while let Some((node, mut slots)) = pending.pop() {
            while slots > 1 && self.plans[node].lefts[slots - 1] == 0 {
                slots -= 1;
            }
            if slots == 1 {
                children.push(node);
            } else {
                open(node, slots, self.plans[node].lefts[slots - 1], &mut pending);
            }
        }
        children
    }

    fn emit_leaf(&mut self, subtree: usize) -> Child {
        // A subtree of n leaves takes 2 n - 1 entries of the depth-first order.
        let end = subtree + 2 * self.binary[subtree].count as usize - 1;
        let leaves = self.binary[subtree..end].iter().filter(|node| node.is_leaf());
        Child::leaf(self.leaves.push(leaves.map(|node| node.link)))
    }
}

/// Levels of nodes.
fn depth(nodes: &[Node]) -> usize {
    let mut depths = vec![1; nodes.len()];
    let mut deepest = 0;
    for (i, node) in nodes.iter().enumerate() {
        deepest = deepest.max(depths[i]);
        for child in node.children.iter().filter(|child| !child.is_leaf() && child.index() > i) {
            depths[child.index()] = depths[i] + 1;
        }
    }
    deepest
}
