//! The line of a file that an error is about, with the fault underlined.

use crate::scene_source;
use hyaline_scene::Source;

/// The line at `source` and a mark under the fault; `None` where place or file are not to be had.
pub(crate) fn underlined(source: &Source) -> Option<String> {
    if source.line == 0 {
        return None;
    }
    let text = scene_source::text_of(&source.file)?;
    let line = text.lines().nth(source.line as usize - 1)?;
    Some(mark(line, source.line, source.column, source.length))
}

/// Two lines: `line` with its number, and carets under `length` bytes from `column`; none where `column` is 0.
fn mark(line: &str, number: u32, column: u32, length: u32) -> String {
    let number = number.to_string();
    let gutter = " ".repeat(number.len());
    let shown: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut excerpt = format!(" {number} | {}\n", shown.trim_end());
    if column > 0 {
        let before = column as usize - 1;
        let room = shown.trim_end().chars().count().saturating_sub(before).max(1);
        let carets = "^".repeat((length as usize).clamp(1, room));
        excerpt.push_str(&format!(" {gutter} | {}{carets}\n", " ".repeat(before.min(shown.chars().count()))));
    }
    excerpt
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fault_is_underlined() {
        assert_eq!(mark("color = 3", 12, 1, 5), " 12 | color = 3\n    | ^^^^^\n");
    }

    #[test]
    fn a_place_beyond_the_line_does_no_harm() {
        assert_eq!(mark("ab", 1, 90, 50), " 1 | ab\n   |   ^\n");
        assert_eq!(mark("ab", 1, 0, 50), " 1 | ab\n");
    }
}
