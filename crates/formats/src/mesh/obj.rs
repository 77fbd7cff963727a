//! Wavefront OBJ: `v`, `vt`, `vn`, `f` (also with negative indices), `usemtl`; the rest is passed over.
//!
//! Corners with the same position, texture coordinate and normal become one vertex. Normals are kept only where every
//! corner has one; corners without texture coordinates get (0, 0) where others have some. `usemtl` makes slots.

use super::{MAX_COUNT, fan};
use crate::Result;
use hyaline_scene::{MeshData, SceneError, Source};

/// No texture coordinate or normal; also the end of a chain.
const NONE: u32 = u32::MAX;

/// Reads an OBJ file; `file` is its place as a whole.
pub(super) fn read(bytes: &[u8], file: &Source) -> Result<MeshData> {
    let mut reader = Reader::default();
    for (index, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        reader.line(line).map_err(|message| {
            let line = u32::try_from(index + 1).unwrap_or(u32::MAX);
            SceneError::at(&Source { line, ..file.clone() }, message)
        })?;
    }
    Ok(reader.finish())
}

type Checked<T> = std::result::Result<T, String>;

/// A vertex of the mesh: which entries of the file it joins, and the next one of the same position.
#[derive(Clone, Copy, Debug)]
struct Joined {
    position: u32,
    uv: u32,
    normal: u32,
    next: u32,
}

#[derive(Debug, Default)]
struct Reader {
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    /// First vertex of each position.
    chains: Vec<u32>,
    vertices: Vec<Joined>,
    triangles: Vec<[u32; 3]>,
    face_slots: Vec<u16>,
    slots: Vec<String>,
    slot: u16,
    corners: Vec<u32>,
}

impl Reader {
    fn line(&mut self, line: &[u8]) -> Checked<()> {
        let line = line.trim_ascii();
        if line.is_empty() || line[0] == b'#' {
            return Ok(());
        }
        let text = std::str::from_utf8(line).map_err(|_| "not a text".to_owned())?;
        let mut words = text.split_ascii_whitespace();
        match words.next().unwrap_or_default() {
            "v" => {
                self.positions.push(numbers(words, 3)?);
                self.chains.push(NONE);
                if self.positions.len() > MAX_COUNT { Err("too many vertices".to_owned()) } else { Ok(()) }
            }
            "vt" => {
                self.uvs.push(numbers(words, 1)?);
                Ok(())
            }
            "vn" => {
                self.normals.push(numbers(words, 3)?);
                Ok(())
            }
            "f" => self.face(words),
            "usemtl" => self.use_material(text["usemtl".len()..].trim()),
            _ => Ok(()),
        }
    }

    fn use_material(&mut self, name: &str) -> Checked<()> {
        if self.slots.is_empty() && !self.triangles.is_empty() {
            // The faces before the first `usemtl` have a slot of their own, without a name.
            self.slots.push(String::new());
        }
        let known = self.slots.iter().position(|slot| slot == name);
        let index = known.unwrap_or_else(|| {
            self.slots.push(name.to_owned());
            self.slots.len() - 1
        });
        self.slot = u16::try_from(index).map_err(|_| "more than 65536 materials".to_owned())?;
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Checked<()> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for word in words {
            corners.push(self.corner(word)?);
        }
        if corners.len() < 3 {
            return Err(format!("a face of {} corners", corners.len()));
        }
        fan(&corners, &mut self.triangles);
        self.face_slots.resize(self.triangles.len(), self.slot);
        self.corners = corners;
        if self.triangles.len() > MAX_COUNT { Err("too many faces".to_owned()) } else { Ok(()) }
    }

    /// The vertex that `position/uv/normal` means.
    fn corner(&mut self, word: &str) -> Checked<u32> {
        let mut parts = word.split('/');
        let position = index(parts.next(), self.positions.len(), "vertex")?;
        if position == NONE {
            return Err(format!("'{}' has no vertex", word.chars().take(24).collect::<String>()));
        }
        let uv = index(parts.next(), self.uvs.len(), "texture coordinate")?;
        let normal = index(parts.next(), self.normals.len(), "normal")?;
        let mut next = self.chains[position as usize];
        while next != NONE {
            let vertex = self.vertices[next as usize];
            if (vertex.uv, vertex.normal) == (uv, normal) {
                return Ok(next);
            }
            next = vertex.next;
        }
        let new = u32::try_from(self.vertices.len()).ok().filter(|new| *new != NONE);
        let new = new.ok_or_else(|| "too many vertices".to_owned())?;
        let first = std::mem::replace(&mut self.chains[position as usize], new);
        self.vertices.push(Joined { position, uv, normal, next: first });
        Ok(new)
    }

    fn finish(self) -> MeshData {
        let vertices = &self.vertices;
        let with_normals = vertices.iter().all(|vertex| vertex.normal != NONE);
        let with_uvs = vertices.iter().any(|vertex| vertex.uv != NONE);
        let uv = |vertex: &Joined| self.uvs.get(vertex.uv as usize).copied().unwrap_or_default();
        let keep_slots = !self.slots.is_empty();
        MeshData {
            positions: vertices.iter().map(|vertex| self.positions[vertex.position as usize]).collect(),
            normals: match with_normals {
                true => vertices.iter().map(|vertex| self.normals[vertex.normal as usize]).collect(),
                false => Vec::new(),
            },
            uvs: if with_uvs { vertices.iter().map(uv).collect() } else { Vec::new() },
            face_slots: if keep_slots { self.face_slots } else { Vec::new() },
            slots: if keep_slots { self.slots } else { Vec::new() },
            triangles: self.triangles,
        }
    }
}

/// The first `N` numbers of a line; those from `least` on may be absent.
fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>, least: usize) -> Checked<[f32; N]> {
    let mut values = [0.0; N];
    for (i, value) in values.iter_mut().enumerate() {
        let Some(word) = words.next() else {
            if i >= least {
                break;
            }
            return Err(format!("{i} numbers where {least} are needed"));
        };
        *value = match word.parse::<f32>() {
            Ok(number) if number.is_finite() => number,
            _ => {
                return Err(format!(
                    "'{}' is not a finite number",
                    word.chars().take(24).collect::<String>()
                ));
            }
        };
    }
    Ok(values)
}

/// An index of a file, which counts from 1, or backwards from -1; `NONE` where there is none.
fn index(part: Option<&str>, count: usize, what: &str) -> Checked<u32> {
    let Some(text) = part.filter(|text| !text.is_empty()) else { return Ok(NONE) };
    let error = || {
        format!(
            "{what} index '{}' is out of range, there are {count}",
            text.chars().take(24).collect::<String>()
        )
    };
    let number: i64 = text.parse().map_err(|_| error())?;
    let position = if number > 0 { number - 1 } else { count as i64 + number };
    match u32::try_from(position) {
        Ok(position) if number != 0 && (position as usize) < count => Ok(position),
        _ => Err(error()),
    }
}
