//! The header of a PLY file: its elements and their properties.

use crate::Result;
use hyaline_scene::{SceneError, Source};

/// Most bytes of a header.
const MAX_HEADER: usize = 1 << 16;

/// How the numbers after the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// As text.
    Ascii,
    /// Lowest byte first.
    LittleEndian,
    /// Highest byte first.
    BigEndian,
}

/// Number types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Scalar::I8,
            "uchar" | "uint8" => Scalar::U8,
            "short" | "int16" => Scalar::I16,
            "ushort" | "uint16" => Scalar::U16,
            "int" | "int32" => Scalar::I32,
            "uint" | "uint32" => Scalar::U32,
            "float" | "float32" => Scalar::F32,
            "double" | "float64" => Scalar::F64,
            _ => return None,
        })
    }
}

/// A property of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    /// Its name.
    pub(super) name: String,
    /// Type of its values.
    pub(super) scalar: Scalar,
    /// Type of the length in front of a list; `None` is a single value.
    pub(super) list: Option<Scalar>,
}

/// A run of equal records.
#[derive(Clone, Debug)]
pub(super) struct Element {
    /// Its name.
    pub(super) name: String,
    /// How many records the header promises.
    pub(super) count: usize,
    /// What a record consists of.
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Fewest bytes of a record: lists may be empty. `ascii` takes a digit and a space for each number.
    pub(super) fn least_size(&self, encoding: Encoding) -> usize {
        let size = |property: &Property| match encoding {
            Encoding::Ascii => 2,
            _ => property.list.unwrap_or(property.scalar).size(),
        };
        self.properties.iter().map(size).sum()
    }
}

/// A header.
#[derive(Clone, Debug)]
pub(super) struct Header {
    /// How numbers are written.
    pub(super) encoding: Encoding,
    /// The elements in the order of the file.
    pub(super) elements: Vec<Element>,
}

/// Parses the header; returns it and the offset of what follows.
pub(super) fn parse(bytes: &[u8], file: &Source) -> Result<(Header, usize)> {
    let mut offset = 0;
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    for line in 1.. {
        let place = Source { line, ..file.clone() };
        let error = |message: &str| Err(SceneError::at(&place, message));
        let rest = &bytes[offset..bytes.len().min(MAX_HEADER)];
        let Some(length) = rest.iter().position(|byte| *byte == b'\n') else {
            return error(if line == 1 { "not a PLY file" } else { "the PLY header has no end" });
        };
        offset += length + 1;
        let Ok(text) = std::str::from_utf8(&rest[..length]) else {
            return error("not a text in a PLY header");
        };
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match (line, words.as_slice()) {
            (1, ["ply"]) => {}
            (1, _) => return error("not a PLY file: the first line must be `ply`"),
            (_, ["format", name, _]) => {
                encoding = Some(match *name {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => return error("an unknown PLY format"),
                });
            }
            (_, ["comment" | "obj_info", ..] | []) => {}
            (_, ["element", name, count]) => {
                let Ok(count) = count.parse() else { return error("the count of an element is no number") };
                elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new() });
            }
            (_, ["property", words @ ..]) => {
                let Some(element) = elements.last_mut() else {
                    return error("a property before any element");
                };
                let property = match words {
                    ["list", length, scalar, name] => {
                        (Scalar::from_name(scalar), Some(Scalar::from_name(length)), name)
                    }
                    [scalar, name] => (Scalar::from_name(scalar), None, name),
                    _ => return error("a property without type and name"),
                };
                let (Some(scalar), list, name) = property else {
                    return error("an unknown type of property");
                };
                let list = match list {
                    Some(None | Some(Scalar::F32 | Scalar::F64)) => {
                        return error("an unknown type of a list's length");
                    }
                    Some(length) => length,
                    None => None,
                };
                element.properties.push(Property { name: (*name).to_owned(), scalar, list });
            }
            (_, ["end_header"]) => {
                let Some(encoding) = encoding else { return error("the PLY header names no format") };
                return Ok((Header { encoding, elements }, offset));
            }
            _ => return error("an unknown line in a PLY header"),
        }
    }
    Err(SceneError::at(file, "the PLY header has no end"))
}
