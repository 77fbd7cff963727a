//! The body of an ascii PLY file.

use super::builder::{Builder, Vertex, VertexLayout, index_property};
use super::header::{Element, Encoding, Header};
use crate::Result;
use hyaline_scene::{MeshData, SceneError, Source};

/// Reads what follows the header, from byte `body` on.
pub(super) fn read(header: &Header, bytes: &[u8], body: usize, file: &Source) -> Result<MeshData> {
    let first_line = 1 + bytes[..body].iter().filter(|byte| **byte == b'\n').count();
    let mut words = Words { bytes, offset: body, line: first_line };
    let result = read_elements(header, &mut words);
    result.map_err(|message| {
        let line = u32::try_from(words.line).unwrap_or(u32::MAX);
        SceneError::at(&Source { line, ..file.clone() }, message)
    })
}

fn read_elements(header: &Header, words: &mut Words<'_>) -> std::result::Result<MeshData, String> {
    let mut builder = Builder::new(header)?;
    for element in &header.elements {
        let left = words.bytes.len() - words.offset;
        // The last number needs no space after it.
        if element.count.saturating_mul(element.least_size(Encoding::Ascii)) > left + 1 {
            return Err(truncated(element));
        }
        match element.name.as_str() {
            "vertex" => read_vertices(element, words, &mut builder)?,
            "face" => read_faces(element, words, &mut builder)?,
            _ if element.properties.is_empty() => {}
            _ => {
                for _ in 0..element.count {
                    skip_record(element, words)?;
                }
            }
        }
    }
    Ok(builder.finish())
}

fn read_vertices(
    element: &Element,
    words: &mut Words<'_>,
    builder: &mut Builder,
) -> std::result::Result<(), String> {
    let layout = VertexLayout::new(element)?;
    builder.reserve_vertices(&layout, element.count);
    for _ in 0..element.count {
        let mut vertex = Vertex::default();
        for (property, target) in element.properties.iter().zip(&layout.targets) {
            if property.list.is_some() {
                words.skip_list(element)?;
            } else {
                vertex.set(*target, words.number(element)? as f32);
            }
        }
        builder.push_vertex(&layout, vertex)?;
    }
    Ok(())
}

fn read_faces(
    element: &Element,
    words: &mut Words<'_>,
    builder: &mut Builder,
) -> std::result::Result<(), String> {
    let indices = index_property(element)?;
    let mut corners = Vec::new();
    for _ in 0..element.count {
        for (i, property) in element.properties.iter().enumerate() {
            if property.list.is_none() {
                words.number(element)?;
            } else if i != indices {
                words.skip_list(element)?;
            } else {
                corners.clear();
                for _ in 0..Builder::corner_count(words.integer(element)?)? {
                    corners.push(builder.index(words.integer(element)?)?);
                }
            }
        }
        builder.push_face(&corners)?;
    }
    Ok(())
}

fn skip_record(element: &Element, words: &mut Words<'_>) -> std::result::Result<(), String> {
    for property in &element.properties {
        match property.list {
            Some(_) => words.skip_list(element)?,
            None => drop(words.number(element)?),
        }
    }
    Ok(())
}

fn truncated(element: &Element) -> String {
    format!("the file ends before its {} of element '{}'", element.count, element.name)
}

/// The words of a text, with the line of the last one.
struct Words<'a> {
    bytes: &'a [u8],
    offset: usize,
    line: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self, element: &Element) -> std::result::Result<&'a str, String> {
        while let Some(byte) = self.bytes.get(self.offset)
            && byte.is_ascii_whitespace()
        {
            self.line += usize::from(*byte == b'\n');
            self.offset += 1;
        }
        let rest = &self.bytes[self.offset..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if length == 0 {
            return Err(truncated(element));
        }
        self.offset += length;
        std::str::from_utf8(&rest[..length]).map_err(|_| "not a text".to_owned())
    }

    fn number(&mut self, element: &Element) -> std::result::Result<f64, String> {
        let word = self.next(element)?;
        word.parse().map_err(|_| format!("'{}' is not a number", shown(word)))
    }

    fn integer(&mut self, element: &Element) -> std::result::Result<i64, String> {
        let word = self.next(element)?;
        word.parse().map_err(|_| format!("'{}' is not a whole number", shown(word)))
    }

    fn skip_list(&mut self, element: &Element) -> std::result::Result<(), String> {
        for _ in 0..self.integer(element)? {
            self.number(element)?;
        }
        Ok(())
    }
}

/// A word as messages may show it.
fn shown(word: &str) -> String {
    word.chars().take(24).collect()
}
