//! Mesh files.

pub(crate) mod normals;
mod obj;
mod ply;
mod serialized;

#[cfg(test)]
mod tests;

use crate::Result;
use crate::ending;
use hyaline_scene::{MeshData, SceneError, Source};
use std::path::Path;
use std::sync::Arc;

/// Most vertices or triangles: indices are `u32`.
const MAX_COUNT: usize = u32::MAX as usize - 1;

/// Reads the content of a mesh file; the ending of its name tells the format.
///
/// # Errors
/// The format is unknown, the content damaged or empty.
pub(crate) fn read(path: &Path, bytes: &[u8]) -> Result<MeshData> {
    let source = Source::file(path.display().to_string());
    let mesh = match ending(path).as_str() {
        "ply" => ply::read(bytes, &source)?,
        "obj" => obj::read(bytes, &source)?,
        "serialized" => return Ok(part(path, bytes, 0)?.0),
        other => {
            let error = SceneError::at(&source, format!("meshes ending in '.{other}' can't be read"));
            return Err(error.with_remedy("the formats are .ply, .obj and .serialized"));
        }
    };
    not_empty(mesh, &source)
}

/// A mesh of a file, and whether the file wants it faceted.
#[derive(Clone, Debug)]
pub(crate) struct FileMesh {
    /// The triangles.
    pub(crate) mesh: Arc<MeshData>,
    /// Whether its faces are flat.
    pub(crate) flat: bool,
}

/// Reads one of the meshes of a `.serialized` file, counted from 0.
///
/// # Errors
/// As for [`read`]; there is no mesh of this number.
pub(crate) fn read_serialized(path: &Path, bytes: &[u8], index: u32) -> Result<FileMesh> {
    let (mesh, flat) = part(path, bytes, index)?;
    Ok(FileMesh { mesh: Arc::new(mesh), flat })
}

fn part(path: &Path, bytes: &[u8], index: u32) -> Result<(MeshData, bool)> {
    let source = Source::file(path.display().to_string());
    let (mesh, flat) = serialized::read(bytes, index).map_err(|message| SceneError::at(&source, message))?;
    Ok((not_empty(mesh, &source)?, flat))
}

fn not_empty(mesh: MeshData, source: &Source) -> Result<MeshData> {
    if mesh.positions.is_empty() || mesh.triangles.is_empty() {
        let what = if mesh.positions.is_empty() { "vertices" } else { "faces" };
        return Err(SceneError::at(source, format!("the mesh has no {what}")));
    }
    Ok(mesh)
}

/// Splits a polygon into a fan of triangles.
fn fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if let Some((first, rest)) = corners.split_first() {
        triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
    }
}
