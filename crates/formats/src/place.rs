//! Byte offsets of a text to lines and columns.

use hyaline_scene::Source;
use std::ops::Range;
use std::sync::Arc;

/// A text with its name, able to say where in it something stands.
#[derive(Debug)]
pub(crate) struct Places<'a> {
    file: Arc<str>,
    text: &'a [u8],
    line_starts: Vec<usize>,
}

impl<'a> Places<'a> {
    /// Indexes the lines of `text`; `file` is its name in messages.
    pub(crate) fn new(file: Arc<str>, text: &'a str) -> Self {
        let text = text.as_bytes();
        let newlines = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(i, _)| i + 1);
        Self { file, text, line_starts: std::iter::once(0).chain(newlines).collect() }
    }

    /// Place of a range of bytes; columns count characters, the length ends with the line.
    pub(crate) fn source(&self, range: Range<usize>) -> Source {
        let start = range.start.min(self.text.len());
        let line = self.line_starts.partition_point(|first| *first <= start).max(1);
        let line_start = self.line_starts[line - 1];
        let line_end = self.line_starts.get(line).map_or(self.text.len(), |next| next - 1);
        let is_character_start = |byte: &&u8| (**byte & 0b1100_0000) != 0b1000_0000;
        let column = 1 + self.text[line_start..start].iter().filter(is_character_start).count();
        let end = range.end.min(line_end).max(start + 1);
        Source {
            file: self.file.clone(),
            line: saturate(line),
            column: saturate(column),
            length: saturate(end - start),
        }
    }
}

fn saturate(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_and_in_characters() {
        let places = Places::new("a".into(), "x = 1\ny = \"äö\" # z\n");
        let at = |range| {
            let source = places.source(range);
            (source.line, source.column, source.length)
        };
        assert_eq!(at(0..1), (1, 1, 1));
        assert_eq!(at(6..7), (2, 1, 1));
        assert_eq!(at(17..18), (2, 10, 1));
        assert_eq!(at(4..40), (1, 5, 1), "the length ends with the line");
        assert_eq!(at(400..500), (3, 1, 1), "past the end is the end");
    }
}
