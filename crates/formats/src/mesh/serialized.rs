//! Mitsuba's `.serialized` files: several meshes, each a zlib stream, with a dictionary of their places at the end.
//!
//! 1. The last four bytes count the meshes; before them stand their offsets, 8 bytes each (4 in version 3).
//! 2. At an offset: the magic number 0x041C, the version (3 or 4), then the compressed mesh.
//! 3. Uncompressed: in version 4 the name up to a zero byte; flags; the counts of vertices and triangles; positions,
//!    normals, texture coordinates, colors, as far as the flags say, in single or double precision; indices.
//!
//! All numbers are little-endian. Source: documentation of `serialized` in Mitsuba 0.6.

use super::MAX_COUNT;
use flate2::read::ZlibDecoder;
use hyaline_scene::MeshData;
use std::io::Read;

const MAGIC: u16 = 0x041c;
const HAS_NORMALS: u32 = 0x0001;
const HAS_UVS: u32 = 0x0002;
const HAS_COLORS: u32 = 0x0008;
const FACE_NORMALS: u32 = 0x0010;
const SINGLE: u32 = 0x1000;
const DOUBLE: u32 = 0x2000;

/// Deflate makes nothing larger than this many times its compressed size.
/// Source: zlib's technical details, maximum expansion factor.
const MAX_EXPANSION: u64 = 1032;
/// Longest name of a mesh, bytes.
const MAX_NAME: usize = 1 << 16;
/// Values that are read at once.
const CHUNK: usize = 1 << 14;

type Checked<T> = Result<T, String>;

/// Reads a mesh of a file; the flag tells that it is to be faceted.
///
/// - `index`: which mesh, from 0.
///
/// # Errors
/// What is wrong with it, in words.
pub(super) fn read(bytes: &[u8], index: u32) -> Checked<(MeshData, bool)> {
    let (compressed, version) = stream(bytes, index)?;
    let mut stream = Stream {
        decoder: ZlibDecoder::new(compressed),
        left: (compressed.len() as u64).saturating_mul(MAX_EXPANSION),
        is_double: false,
    };
    if version == 4 {
        stream.skip_name()?;
    }
    let flags = u32::from_le_bytes(stream.bytes()?);
    stream.is_double = match (flags & SINGLE != 0, flags & DOUBLE != 0) {
        (true, false) => false,
        (false, true) => true,
        _ => return Err("the mesh says neither single nor double precision".to_owned()),
    };
    let vertices = stream.count("vertices")?;
    let triangles = stream.count("triangles")?;
    let positions = stream.vectors::<3>(vertices)?;
    let normals = if flags & HAS_NORMALS != 0 { stream.vectors::<3>(vertices)? } else { Vec::new() };
    let uvs = if flags & HAS_UVS != 0 { stream.vectors::<2>(vertices)? } else { Vec::new() };
    if flags & HAS_COLORS != 0 {
        stream.vectors::<3>(vertices)?;
    }
    let triangles = stream.triangles(triangles, vertices)?;
    let mesh = MeshData { positions, normals, uvs, triangles, face_slots: Vec::new(), slots: Vec::new() };
    Ok((mesh, flags & FACE_NORMALS != 0))
}

/// The compressed bytes of a mesh, and the version that they are written in.
fn stream(bytes: &[u8], index: u32) -> Checked<(&[u8], u16)> {
    let too_short = || "the file ends before its meshes do".to_owned();
    let short = |at: usize| -> Checked<u16> {
        let pair = bytes.get(at..at.saturating_add(2)).ok_or_else(too_short)?;
        Ok(u16::from_le_bytes([pair[0], pair[1]]))
    };
    if short(0)? != MAGIC {
        return Err("not a serialized mesh".to_owned());
    }
    let version = short(2)?;
    let width = match version {
        3 => 4,
        4 => 8,
        other => return Err(format!("version {other} of serialized meshes can't be read, only 3 and 4")),
    };
    let end = bytes.len().checked_sub(4).ok_or_else(too_short)?;
    let number = |at: usize, width: usize| -> Checked<u64> {
        let digits = bytes.get(at..at.saturating_add(width)).ok_or_else(too_short)?;
        Ok(digits.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte)))
    };
    let count = number(end, 4)?;
    if u64::from(index) >= count {
        return Err(format!("there is no mesh {index} in a file of {count}, counted from 0"));
    }
    let table = usize::try_from(count).ok().and_then(|count| end.checked_sub(count.checked_mul(width)?));
    let table = table.ok_or_else(too_short)?;
    let offset = |index: u64| -> Checked<usize> {
        let offset = number(table + index as usize * width, width)?;
        usize::try_from(offset).ok().filter(|offset| *offset <= table).ok_or_else(too_short)
    };
    let start = offset(u64::from(index))?;
    let stop = if u64::from(index) + 1 < count { offset(u64::from(index) + 1)? } else { table };
    if short(start)? != MAGIC || short(start + 2)? != version {
        return Err(format!("mesh {index} does not begin where the file's dictionary says"));
    }
    Ok((bytes.get(start + 4..stop).ok_or_else(too_short)?, version))
}

/// What a zlib stream holds, read piece by piece.
struct Stream<'a> {
    decoder: ZlibDecoder<&'a [u8]>,
    /// Bytes that may still come: what is announced beyond them is not believed, let alone allocated.
    left: u64,
    is_double: bool,
}

impl Stream<'_> {
    fn fill(&mut self, buffer: &mut [u8]) -> Checked<()> {
        let error = |error: std::io::Error| format!("the compressed mesh is damaged: {error}");
        self.decoder.read_exact(buffer).map_err(error)?;
        self.left = self.left.saturating_sub(buffer.len() as u64);
        Ok(())
    }

    fn bytes<const N: usize>(&mut self) -> Checked<[u8; N]> {
        let mut buffer = [0; N];
        self.fill(&mut buffer)?;
        Ok(buffer)
    }

    fn skip_name(&mut self) -> Checked<()> {
        for _ in 0..MAX_NAME {
            if self.bytes::<1>()? == [0] {
                return Ok(());
            }
        }
        Err("the name of the mesh has no end".to_owned())
    }

    fn count(&mut self, what: &str) -> Checked<usize> {
        let count = u64::from_le_bytes(self.bytes()?);
        usize::try_from(count)
            .ok()
            .filter(|count| *count <= MAX_COUNT)
            .ok_or_else(|| format!("a mesh of {count} {what} can't be read"))
    }

    /// Checks that `count` items of `width` bytes may still come.
    fn expect(&self, count: usize, width: usize) -> Checked<()> {
        if (count as u64).saturating_mul(width as u64) <= self.left {
            return Ok(());
        }
        Err("the mesh announces more than its file can hold".to_owned())
    }

    /// Reads `count` items of `width` bytes each.
    fn items(
        &mut self,
        count: usize,
        width: usize,
        mut take: impl FnMut(&[u8]) -> Checked<()>,
    ) -> Checked<()> {
        self.expect(count, width)?;
        let mut buffer = vec![0; CHUNK.min(count) * width];
        let mut left = count;
        while left > 0 {
            let part = &mut buffer[..left.min(CHUNK) * width];
            left -= part.len() / width;
            self.fill(part)?;
            part.chunks_exact(width).try_for_each(&mut take)?;
        }
        Ok(())
    }

    fn vectors<const N: usize>(&mut self, count: usize) -> Checked<Vec<[f32; N]>> {
        let is_double = self.is_double;
        let width = if is_double { 8 } else { 4 };
        self.expect(count, N * width)?;
        let mut vectors = Vec::with_capacity(count.min(CHUNK));
        self.items(count, N * width, |item| {
            let vector: [f32; N] = std::array::from_fn(|i| match is_double {
                true => f64::from_le_bytes(item[8 * i..8 * i + 8].try_into().unwrap_or_default()) as f32,
                false => f32::from_le_bytes(item[4 * i..4 * i + 4].try_into().unwrap_or_default()),
            });
            vectors.push(vector);
            match vector.iter().all(|value| value.is_finite()) {
                true => Ok(()),
                false => Err(format!("vertex {} has a number that is not finite", vectors.len() - 1)),
            }
        })?;
        Ok(vectors)
    }

    fn triangles(&mut self, count: usize, vertices: usize) -> Checked<Vec<[u32; 3]>> {
        self.expect(count, 12)?;
        let mut triangles = Vec::with_capacity(count.min(CHUNK));
        self.items(count, 12, |item| {
            let index = |i: usize| u32::from_le_bytes(item[4 * i..4 * i + 4].try_into().unwrap_or_default());
            let triangle = [index(0), index(1), index(2)];
            triangles.push(triangle);
            match triangle.iter().find(|index| **index as usize >= vertices) {
                None => Ok(()),
                Some(bad) => {
                    let number = triangles.len() - 1;
                    Err(format!("triangle {number} has the vertex {bad}, but there are {vertices}"))
                }
            }
        })?;
        Ok(triangles)
    }
}
