//! Mesh files.

mod obj;
mod ply;

#[cfg(test)]
mod tests;

use crate::Result;
use crate::ending;
use hyaline_scene::{MeshData, SceneError, Source};
use std::path::Path;

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
        other => {
            let error = SceneError::at(&source, format!("meshes ending in '.{other}' can't be read"));
            return Err(error.with_remedy("the formats are .ply and .obj"));
        }
    };
    if mesh.positions.is_empty() || mesh.triangles.is_empty() {
        let what = if mesh.positions.is_empty() { "vertices" } else { "faces" };
        return Err(SceneError::at(&source, format!("the mesh has no {what}")));
    }
    Ok(mesh)
}

/// Splits a polygon into a fan of triangles.
fn fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if let Some((first, rest)) = corners.split_first() {
        triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
    }
}
