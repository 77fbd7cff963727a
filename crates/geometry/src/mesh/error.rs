//! What can be wrong with a mesh, in words that name the vertex or face.

use super::{MAX_COORDINATE, MAX_FACES, MeshData};
use hyaline_math::Vec3;
use rayon::prelude::*;
use std::fmt;

/// Why a mesh was refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// There are no faces.
    Empty,
    /// Every face is degenerate.
    NoFaceHasAnArea {
        /// Number of faces given.
        face_count: usize,
    },
    /// More faces than the tree can index.
    TooManyFaces {
        /// Number of faces given.
        face_count: usize,
    },
    /// A face refers to a vertex that does not exist.
    IndexOutOfRange {
        /// The face.
        face: usize,
        /// The index it holds.
        index: u32,
        /// Number of vertices given.
        vertex_count: usize,
    },
    /// A coordinate of a vertex is NaN or infinite.
    NonFinitePosition {
        /// The vertex.
        vertex: usize,
    },
    /// A coordinate of a vertex exceeds `MAX_COORDINATE`.
    PositionTooLarge {
        /// The vertex.
        vertex: usize,
    },
    /// A texture coordinate is NaN or infinite.
    NonFiniteUv {
        /// The vertex.
        vertex: usize,
    },
    /// A list has not one entry for each vertex or face.
    WrongLength {
        /// What the list holds.
        list: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the mesh has no faces"),
            Self::NoFaceHasAnArea { face_count } => {
                write!(f, "none of the {face_count} faces of the mesh has an area")
            }
            Self::TooManyFaces { face_count } => {
                write!(f, "the mesh has {face_count} faces, more than {MAX_FACES}; split it")
            }
            Self::IndexOutOfRange { face, index, vertex_count } => {
                write!(
                    f,
                    "face {face} refers to vertex {index}, but there are {vertex_count} vertices (from 0)"
                )
            }
            Self::NonFinitePosition { vertex } => {
                write!(f, "the position of vertex {vertex} is not finite")
            }
            Self::PositionTooLarge { vertex } => {
                write!(f, "the position of vertex {vertex} is beyond {MAX_COORDINATE:e}; scale the mesh down")
            }
            Self::NonFiniteUv { vertex } => {
                write!(f, "the texture coordinates of vertex {vertex} are not finite")
            }
            Self::WrongLength { list, expected, found } => {
                write!(f, "the mesh has {found} {list}, but needs {expected}")
            }
        }
    }
}

impl std::error::Error for MeshError {}

/// The first thing wrong with the data, degenerate faces aside.
pub(super) fn check(data: &MeshData) -> Result<(), MeshError> {
    let face_count = data.triangles.len();
    if face_count == 0 {
        return Err(MeshError::Empty);
    }
    if face_count > MAX_FACES {
        return Err(MeshError::TooManyFaces { face_count });
    }
    check_positions(data)?;
    check_faces(data)?;
    let vertex_count = data.positions.len();
    check_length("normals", data.normals.as_ref().map(Vec::len), vertex_count)?;
    check_length("texture coordinates", data.uvs.as_ref().map(Vec::len), vertex_count)?;
    check_length("material slots", data.face_slots.as_ref().map(Vec::len), face_count)?;
    match data.uvs.iter().flatten().position(|uv| !uv.is_finite()) {
        Some(vertex) => Err(MeshError::NonFiniteUv { vertex }),
        None => Ok(()),
    }
}

fn check_positions(data: &MeshData) -> Result<(), MeshError> {
    let is_within = |p: &Vec3| p.is_finite() && p.abs().max_element() <= MAX_COORDINATE;
    match data.positions.par_iter().position_first(|p| !is_within(p)) {
        Some(vertex) if data.positions[vertex].is_finite() => Err(MeshError::PositionTooLarge { vertex }),
        Some(vertex) => Err(MeshError::NonFinitePosition { vertex }),
        None => Ok(()),
    }
}

fn check_faces(data: &MeshData) -> Result<(), MeshError> {
    let vertex_count = data.positions.len();
    let beyond = |indices: &[u32; 3]| indices.iter().copied().find(|&i| i as usize >= vertex_count);
    let found = data.triangles.par_iter().enumerate();
    match found.find_map_first(|(face, indices)| beyond(indices).map(|index| (face, index))) {
        Some((face, index)) => Err(MeshError::IndexOutOfRange { face, index, vertex_count }),
        None => Ok(()),
    }
}

fn check_length(list: &'static str, found: Option<usize>, expected: usize) -> Result<(), MeshError> {
    match found {
        Some(found) if found != expected => Err(MeshError::WrongLength { list, expected, found }),
        _ => Ok(()),
    }
}
