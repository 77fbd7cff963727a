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

/// Characters of a line that are shown, at most: a file may hold a mesh in one line.
const WIDTH: usize = 120;
/// Characters that are shown before the fault in a line that is longer.
const BEFORE: usize = 40;

/// Two lines: `line` with its number, and carets under `length` bytes from `column`; none where `column` is 0. Of a long line
/// what is about the fault.
fn mark(line: &str, number: u32, column: u32, length: u32) -> String {
    let number = number.to_string();
    let gutter = " ".repeat(number.len());
    let all: Vec<char> = line.trim_end().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let fault = (column as usize).saturating_sub(1).min(all.len());
    let start = if all.len() <= WIDTH { 0 } else { fault.saturating_sub(BEFORE) };
    let end = all.len().min(start + WIDTH);
    let (opening, ending) = (if start > 0 { "…" } else { "" }, if end < all.len() { "…" } else { "" });
    let shown = String::from_iter(&all[start..end]);
    let mut excerpt = format!(" {number} | {opening}{shown}{ending}\n");
    if column > 0 {
        let carets = "^".repeat((length as usize).clamp(1, (end - fault).max(1)));
        let before = " ".repeat(fault - start + opening.chars().count());
        excerpt.push_str(&format!(" {gutter} | {before}{carets}\n"));
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

    #[test]
    fn of_a_long_line_the_part_about_the_fault_is_shown() {
        let line = "x".repeat(100_000) + "bad" + &"y".repeat(100_000);
        let excerpt = mark(&line, 1, 100_001, 3);
        let lines: Vec<&str> = excerpt.lines().collect();
        assert_eq!(lines[0], format!(" 1 | …{}bad{}…", "x".repeat(BEFORE), "y".repeat(WIDTH - BEFORE - 3)));
        assert_eq!(lines[1], format!("   | {}^^^", " ".repeat(1 + BEFORE)));
        let start = mark(&line, 1, 1, 200_000);
        assert!(start.starts_with(" 1 | xxx") && start.chars().count() < 3 * WIDTH, "{start}");
    }
}
