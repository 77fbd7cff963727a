//! The connected pieces of a mesh, and how they lie in each other.
//!
//! 1. Faces that share an edge belong to one shell (union-find over the edges).
//! 2. Of the largest closed shells, those whose boxes overlap are compared: points of the one are looked at from
//!    within the other, by winding number.
//! 3. A shell in another that faces inward is a hollow, which is as it should be; one that faces inward in the open is
//!    inside out; one that faces outward within another is counted twice; one partly in another crosses it.

use super::Marked;
use super::edges::EdgeUse;
use super::winding::winding_number;
use crate::mesh::Mesh;
use hyaline_math::{Bounds, DVec3};

/// Shells that are compared with each other, at most: the largest.
const MOST_COMPARED: usize = 64;

/// Points of a shell that are looked at.
const PROBES: usize = 8;

/// Connected pieces of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShellHealth {
    /// Number of pieces.
    pub count: usize,
    /// Closed shells that face inward and lie within one that faces outward: hollows.
    pub hollow: usize,
    /// Closed shells that face inward and lie in no other: inside out.
    pub inside_out: Marked,
    /// Closed shells that face outward and lie within another that does: counted twice.
    pub doubled: Marked,
    /// Closed shells that lie partly within another.
    pub crossing: Marked,
}

/// A connected piece.
struct Shell {
    faces: Vec<u32>,
    is_closed: bool,
    bounds: Bounds,
    volume: f64,
}

/// How a shell lies in another.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Apart,
    Within,
    Across,
}

impl ShellHealth {
    /// - `uses`: of all edges, sorted.
    pub(super) fn new(mesh: &Mesh, uses: &[EdgeUse]) -> Self {
        let mut shells = shells(mesh, uses);
        let mut health = Self { count: shells.len(), ..Self::default() };
        shells.retain(|shell| shell.is_closed);
        // The sort is stable, so shells of the same size stay in the order of their faces.
        shells.sort_by_key(|shell| std::cmp::Reverse(shell.faces.len()));
        shells.truncate(MOST_COMPARED);
        for (i, shell) in shells.iter().enumerate() {
            let (mut depth, mut crosses) = (0, false);
            for other in shells.iter().enumerate().filter(|&(j, _)| j != i).map(|(_, other)| other) {
                match place(mesh, shell, other) {
                    Place::Apart => {}
                    Place::Within => depth += if other.volume < 0.0 { -1 } else { 1 },
                    Place::Across => crosses = true,
                }
            }
            let fault = match (crosses, shell.volume < 0.0, depth) {
                (true, _, _) => &mut health.crossing,
                (false, true, 1..) => {
                    health.hollow += 1;
                    continue;
                }
                (false, true, _) => &mut health.inside_out,
                (false, false, 1..) => &mut health.doubled,
                (false, false, _) => continue,
            };
            fault.mark(mesh.corners(shell.faces[0])[0]);
        }
        health
    }
}

/// All shells, in the order of their first faces.
fn shells(mesh: &Mesh, uses: &[EdgeUse]) -> Vec<Shell> {
    let mut parents: Vec<u32> = (0..mesh.face_count() as u32).collect();
    let mut open = vec![false; mesh.face_count()];
    for edge in uses.chunk_by(|a, b| a.edge() == b.edge()) {
        for edge_use in &edge[1..] {
            join(&mut parents, edge[0].face, edge_use.face);
        }
        if edge.len() % 2 == 1 {
            edge.iter().for_each(|edge_use| open[edge_use.face as usize] = true);
        }
    }
    let mut index_of_root = vec![u32::MAX; mesh.face_count()];
    let mut shells: Vec<Shell> = Vec::new();
    let center = mesh.bounds().center().as_dvec3();
    for face in 0..mesh.face_count() as u32 {
        let root = root(&mut parents, face) as usize;
        if index_of_root[root] == u32::MAX {
            index_of_root[root] = shells.len() as u32;
            shells.push(Shell { faces: Vec::new(), is_closed: true, bounds: Bounds::EMPTY, volume: 0.0 });
        }
        let shell = &mut shells[index_of_root[root] as usize];
        let corners = mesh.corners(face);
        shell.faces.push(face);
        shell.is_closed &= !open[face as usize];
        shell.bounds = shell.bounds.union(Bounds::from_points(corners));
        let [a, b, c] = corners.map(|p| p.as_dvec3() - center);
        shell.volume += a.dot(b.cross(c)) / 6.0;
    }
    shells
}

fn root(parents: &mut [u32], mut face: u32) -> u32 {
    while parents[face as usize] != face {
        let grandparent = parents[parents[face as usize] as usize];
        parents[face as usize] = grandparent;
        face = grandparent;
    }
    face
}

/// Puts two faces into one set; the lowest face stands for it.
fn join(parents: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(parents, a), root(parents, b));
    parents[a.max(b) as usize] = a.min(b);
}

/// How `shell` lies in `other`, by the winding number of `other` about points of `shell`.
fn place(mesh: &Mesh, shell: &Shell, other: &Shell) -> Place {
    if !shell.bounds.overlaps(&other.bounds) {
        return Place::Apart;
    }
    let corners = |face: u32| mesh.corners(face).map(|p| p.as_dvec3());
    let (mut within, mut outside) = (false, false);
    for probe in 0..PROBES.min(shell.faces.len()) {
        let face = shell.faces[probe * shell.faces.len() / PROBES.min(shell.faces.len())];
        let p = corners(face).iter().sum::<DVec3>() / 3.0;
        let winding = winding_number(other.faces.iter().map(|&face| corners(face)), p).abs();
        // Half a turn: the point lies on the other shell, and tells nothing.
        if (winding - winding.round()).abs() < 0.25 {
            *(if winding > 0.5 { &mut within } else { &mut outside }) = true;
        }
    }
    match (within, outside) {
        (true, true) => Place::Across,
        (true, false) => Place::Within,
        (false, _) => Place::Apart,
    }
}
