//! The body of a binary PLY file.

use super::builder::{Builder, Target, Vertex, VertexLayout, index_property};
use super::header::{Element, Encoding, Header, Property, Scalar};
use crate::Result;
use hyaline_scene::{MeshData, SceneError, Source};

/// Order of bytes.
pub(super) trait Endian {
    /// Reads 2 bytes.
    fn two(bytes: [u8; 2]) -> u16;
    /// Reads 4 bytes.
    fn four(bytes: [u8; 4]) -> u32;
    /// Reads 8 bytes.
    fn eight(bytes: [u8; 8]) -> u64;
}

/// Lowest byte first.
pub(super) struct Little;
/// Highest byte first.
pub(super) struct Big;

impl Endian for Little {
    fn two(bytes: [u8; 2]) -> u16 {
        u16::from_le_bytes(bytes)
    }
    fn four(bytes: [u8; 4]) -> u32 {
        u32::from_le_bytes(bytes)
    }
    fn eight(bytes: [u8; 8]) -> u64 {
        u64::from_le_bytes(bytes)
    }
}

impl Endian for Big {
    fn two(bytes: [u8; 2]) -> u16 {
        u16::from_be_bytes(bytes)
    }
    fn four(bytes: [u8; 4]) -> u32 {
        u32::from_be_bytes(bytes)
    }
    fn eight(bytes: [u8; 8]) -> u64 {
        u64::from_be_bytes(bytes)
    }
}

/// Reads what follows the header, from byte `body` on.
pub(super) fn read<E: Endian>(header: &Header, bytes: &[u8], body: usize, file: &Source) -> Result<MeshData> {
    let mut cursor = Cursor { bytes, offset: body };
    read_elements::<E>(header, &mut cursor)
        .map_err(|message| SceneError::at(file, format!("at byte {}: {message}", cursor.offset)))
}

type Checked<T> = std::result::Result<T, String>;

fn read_elements<E: Endian>(header: &Header, cursor: &mut Cursor<'_>) -> Checked<MeshData> {
    let mut builder = Builder::new(header)?;
    for element in &header.elements {
        let least = element.count.saturating_mul(element.least_size(Encoding::LittleEndian));
        if least > cursor.bytes.len() - cursor.offset {
            return Err(truncated(element));
        }
        match element.name.as_str() {
            "vertex" => read_vertices::<E>(element, cursor, &mut builder)?,
            "face" => read_faces::<E>(element, cursor, &mut builder)?,
            _ if element.properties.is_empty() => {}
            _ => {
                for _ in 0..element.count {
                    skip::<E>(element, &element.properties, cursor)?;
                }
            }
        }
    }
    Ok(builder.finish())
}

fn truncated(element: &Element) -> String {
    format!("the file ends before its {} of element '{}'", element.count, element.name)
}

fn read_vertices<E: Endian>(
    element: &Element,
    cursor: &mut Cursor<'_>,
    builder: &mut Builder,
) -> Checked<()> {
    let layout = VertexLayout::new(element)?;
    builder.reserve_vertices(&layout, element.count);
    if element.properties.iter().any(|property| property.list.is_some()) {
        for _ in 0..element.count {
            let mut vertex = Vertex::default();
            for (property, target) in element.properties.iter().zip(&layout.targets) {
                match property.list {
                    Some(_) => skip::<E>(element, std::slice::from_ref(property), cursor)?,
                    None => vertex.set(*target, cursor.number::<E>(property.scalar, element)? as f32),
                }
            }
            builder.push_vertex(&layout, vertex)?;
        }
        return Ok(());
    }
    // Records of one size: the properties lie at fixed offsets.
    let mut stride = 0;
    let mut fields: Vec<(usize, Scalar, Target)> = Vec::new();
    for (property, target) in element.properties.iter().zip(&layout.targets) {
        if *target != Target::Skip {
            fields.push((stride, property.scalar, *target));
        }
        stride += property.scalar.size();
    }
    for record in cursor.take(stride * element.count, element)?.chunks_exact(stride) {
        let mut vertex = Vertex::default();
        for (offset, scalar, target) in &fields {
            vertex.set(*target, decode::<E>(*scalar, &record[*offset..]) as f32);
        }
        builder.push_vertex(&layout, vertex)?;
    }
    Ok(())
}

fn read_faces<E: Endian>(element: &Element, cursor: &mut Cursor<'_>, builder: &mut Builder) -> Checked<()> {
    let position = index_property(element)?;
    let property = &element.properties[position];
    let length = property.list.unwrap_or(Scalar::U8);
    builder.reserve_triangles(element.count);
    let mut corners = Vec::new();
    for _ in 0..element.count {
        skip::<E>(element, &element.properties[..position], cursor)?;
        let count = Builder::corner_count(cursor.number::<E>(length, element)? as i64)?;
        let size = property.scalar.size();
        corners.clear();
        for index in cursor.take(count * size, element)?.chunks_exact(size) {
            corners.push(builder.index(decode::<E>(property.scalar, index) as i64)?);
        }
        builder.push_face(&corners)?;
        skip::<E>(element, &element.properties[position + 1..], cursor)?;
    }
    Ok(())
}

/// Passes over some properties of a record.
fn skip<E: Endian>(element: &Element, properties: &[Property], cursor: &mut Cursor<'_>) -> Checked<()> {
    for property in properties {
        let count = match property.list {
            None => 1,
            Some(length) => cursor.number::<E>(length, element)?.max(0.0) as usize,
        };
        cursor.take(count.saturating_mul(property.scalar.size()), element)?;
    }
    Ok(())
}

/// The first number of `bytes`, which are enough for it; `f64` holds every value of every type.
#[inline]
fn decode<E: Endian>(scalar: Scalar, bytes: &[u8]) -> f64 {
    fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
        bytes.first_chunk().copied().unwrap_or([0; N])
    }
    match scalar {
        Scalar::I8 => f64::from(i8::from_le_bytes(first(bytes))),
        Scalar::U8 => f64::from(u8::from_le_bytes(first(bytes))),
        Scalar::I16 => f64::from(E::two(first(bytes)) as i16),
        Scalar::U16 => f64::from(E::two(first(bytes))),
        Scalar::I32 => f64::from(E::four(first(bytes)) as i32),
        Scalar::U32 => f64::from(E::four(first(bytes))),
        Scalar::F32 => f64::from(f32::from_bits(E::four(first(bytes)))),
        Scalar::F64 => f64::from_bits(E::eight(first(bytes))),
    }
}

/// Bytes with a position.
struct Cursor<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl<'a> Cursor<'a> {
    #[inline]
    fn take(&mut self, length: usize, element: &Element) -> Checked<&'a [u8]> {
        let taken = self.bytes[self.offset..].get(..length).ok_or_else(|| truncated(element))?;
        self.offset += length;
        Ok(taken)
    }

    #[inline]
    fn number<E: Endian>(&mut self, scalar: Scalar, element: &Element) -> Checked<f64> {
        self.take(scalar.size(), element).map(|bytes| decode::<E>(scalar, bytes))
    }
}
