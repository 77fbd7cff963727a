//! PLY: ascii, binary little and big endian.
//!
//! Of `vertex` the properties x y z, nx ny nz and (u v | s t | texture_u texture_v) are read, of `face` the list
//! `vertex_indices` (or `vertex_index`); everything else is skipped. Polygons become fans. Nothing is allocated on the
//! header's word alone: counts are checked against the bytes that are there.

mod ascii;
mod binary;
mod builder;
mod header;

use crate::Result;
use header::Encoding;
use hyaline_scene::{MeshData, Source};

/// Reads a PLY file; `source` is its place as a whole.
pub(super) fn read(bytes: &[u8], source: &Source) -> Result<MeshData> {
    let (header, body) = header::parse(bytes, source)?;
    match header.encoding {
        Encoding::Ascii => ascii::read(&header, bytes, body, source),
        Encoding::LittleEndian => binary::read::<binary::Little>(&header, bytes, body, source),
        Encoding::BigEndian => binary::read::<binary::Big>(&header, bytes, body, source),
    }
}
