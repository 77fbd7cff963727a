//! Edges that are open only because the vertices on their two sides differ by a rounding.
//!
//! 1. The vertices of open edges go into a grid of cells as large as the tolerance.
//! 2. Each vertex is stood for by the first one within the tolerance, looked for in its own and the adjacent cells.
//! 3. Open edges that then pair up were a seam.

use super::edges::EdgeUse;
use hyaline_math::Vec3;
use std::collections::{BTreeMap, HashMap};

/// Vertices nearer to each other than this fraction of the mesh's size are meant to be one.
const TOLERANCE: f32 = 1e-6;

type Cell = [i64; 3];

/// How many open edges pair up once near vertices are one.
///
/// - `open`: uses of open edges; `size`: diagonal of the mesh's box, scene units.
pub(super) fn nearly_closed(positions: &[Vec3], open: &[EdgeUse], size: f32) -> usize {
    let tolerance = TOLERANCE * size;
    let stands_for = merge_near(positions, open, tolerance);
    let mut uses: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for edge in open {
        let [a, b] = [edge.low, edge.high].map(|vertex| stands_for[&vertex]);
        // An edge as short as the tolerance shrinks to a point and leaves no hole.
        *uses.entry((a.min(b), a.max(b))).or_default() += 1;
    }
    uses.iter().filter(|&(&(a, b), &count)| a == b || count > 1).map(|(_, &count)| count).sum()
}

/// For each vertex of the edges the first one that lies within `tolerance` of it.
fn merge_near(positions: &[Vec3], edges: &[EdgeUse], tolerance: f32) -> HashMap<u32, u32> {
    let mut vertices: Vec<u32> = edges.iter().flat_map(|edge| [edge.low, edge.high]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let cell_of = |p: Vec3| p.to_array().map(|x| (x / tolerance).floor() as i64);
    let mut first_in: HashMap<Cell, Vec<u32>> = HashMap::new();
    let mut stands_for = HashMap::new();
    for vertex in vertices {
        let p = positions[vertex as usize];
        let is_near = |other: &&u32| p.distance(positions[**other as usize]) <= tolerance;
        let near = around(cell_of(p)).filter_map(|cell| first_in.get(&cell)?.iter().find(is_near)).min();
        let representative = near.copied().unwrap_or(vertex);
        if near.is_none() {
            first_in.entry(cell_of(p)).or_default().push(vertex);
        }
        stands_for.insert(vertex, representative);
    }
    stands_for
}

/// A cell and those about it.
fn around(cell: Cell) -> impl Iterator<Item = Cell> {
    (0..27).map(move |i: i64| {
        let step = [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1];
        [0, 1, 2].map(|axis| cell[axis].saturating_add(step[axis]))
    })
}
