//! Triangle meshes as files hold them.

use serde::{Serialize, Serializer};

/// Vertices and triangles; polygons are split by the reader.
///
/// Normals and texture coordinates, where present, are one per vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Positions, scene units.
    pub positions: Vec<[f32; 3]>,
    /// Normals, one per vertex, or empty.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates, one per vertex, or empty.
    pub uvs: Vec<[f32; 2]>,
    /// Vertex indices, counter-clockwise seen from the outside.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `slots`, one per triangle, or empty where all faces are alike.
    pub face_slots: Vec<u16>,
    /// Names of the materials that the file gives to its faces.
    pub slots: Vec<String>,
}

impl MeshData {
    /// A digest of the content, for telling scenes apart.
    pub fn digest(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        let parts: [&[u8]; 5] = [
            bytemuck::cast_slice(&self.positions),
            bytemuck::cast_slice(&self.normals),
            bytemuck::cast_slice(&self.uvs),
            bytemuck::cast_slice(&self.triangles),
            bytemuck::cast_slice(&self.face_slots),
        ];
        for part in parts {
            hasher.update(&(part.len() as u64).to_le_bytes());
            hasher.update(part);
        }
        for slot in &self.slots {
            hasher.update(slot.as_bytes());
            hasher.update(&[0]);
        }
        *hasher.finalize().as_bytes()
    }
}

/// Serializes as its digest: a scene's identity needs no more.
impl Serialize for MeshData {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.digest().serialize(serializer)
    }
}
