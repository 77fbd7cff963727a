//! A parsed TOML text whose every key and value knows its place.

use crate::Result;
use crate::place::Places;
use hyaline_scene::{SceneError, Source};
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Deepest nesting of tables and arrays.
const MAX_DEPTH: usize = 64;
/// Most dots in a row of keys: nesting is taken apart recursively by the TOML reader.
const MAX_DOTS: usize = 64;

/// A value and its place.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// What was said.
    pub(crate) value: Value,
    /// Where.
    pub(crate) source: Source,
}

/// A value.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// Text.
    String(String),
    /// A whole number.
    Integer(i64),
    /// Another number; NaN and infinity are still possible here.
    Float(f64),
    /// `true` or `false`.
    Boolean(bool),
    /// A list.
    Array(Vec<Node>),
    /// Keys with values, in the order of the file.
    Table(Vec<Entry>),
}

/// A key with its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// The key.
    pub(crate) key: String,
    /// Place of the key.
    pub(crate) source: Source,
    /// The value.
    pub(crate) node: Node,
}

impl Node {
    /// A table without entries.
    pub(crate) fn empty_table(source: Source) -> Self {
        Self { value: Value::Table(Vec::new()), source }
    }
}

impl Value {
    /// What kind of value it is, with an article.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Value::String(_) => "a string",
            Value::Integer(_) => "a whole number",
            Value::Float(_) => "a number",
            Value::Boolean(_) => "true or false",
            Value::Array(_) => "an array",
            Value::Table(_) => "a table",
        }
    }
}

/// Parses a whole TOML text; `file` is its name in messages.
///
/// # Errors
/// The first fault of syntax, with its place.
pub(crate) fn parse(text: &str, file: &Arc<str>) -> Result<Node> {
    let places = Places::new(file.clone(), text);
    refuse_long_keys(text, &places)?;
    let table = DeTable::parse(text).map_err(|error| syntax_error(&places, &error))?;
    let source = Source::file(file.clone());
    let converter = Converter { source: &|span| places.source(span) };
    Ok(Node { value: converter.table(table.into_inner(), 0)?, source })
}

/// Parses one TOML value; everything in it gets the place `source`. `None` where it is not TOML.
///
/// # Errors
/// Values that TOML knows and scenes do not.
pub(crate) fn parse_value(text: &str, source: &Source) -> Result<Option<Node>> {
    if refuse_long_keys(text, &Places::new(source.file.clone(), text)).is_err() {
        return Ok(None);
    }
    let Ok(value) = DeValue::parse(text) else { return Ok(None) };
    Converter { source: &|_| source.clone() }.node(value, 0).map(Some)
}

/// Stops chains of dotted keys that would nest tables without bound.
fn refuse_long_keys(text: &str, places: &Places<'_>) -> Result<()> {
    let bytes = text.as_bytes();
    let (mut offset, mut dots) = (0, 0);
    while let Some(byte) = bytes.get(offset) {
        match byte {
            b'.' => dots += 1,
            b',' | b'=' | b'{' | b'}' | b'[' | b']' | b'\n' => dots = 0,
            b'#' => {
                let rest = &bytes[offset..];
                offset += rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
                continue;
            }
            b'"' | b'\'' => {
                offset = end_of_string(bytes, offset);
                continue;
            }
            _ => {}
        }
        offset += 1;
        if dots > MAX_DOTS {
            let source = places.source(offset - 1..offset);
            return Err(SceneError::at(&source, format!("more than {MAX_DOTS} dots in a row of keys")));
        }
    }
    Ok(())
}

/// Offset behind the string that starts at `start`, of one line or of several.
fn end_of_string(bytes: &[u8], start: usize) -> usize {
    let quote = bytes[start];
    let is_long = bytes[start..].starts_with(&[quote; 3]);
    let mut offset = start + if is_long { 3 } else { 1 };
    while let Some(byte) = bytes.get(offset) {
        match byte {
            b'\\' if quote == b'"' => offset += 1,
            b'\n' if !is_long => return offset,
            byte if *byte == quote && !is_long => return offset + 1,
            byte if *byte == quote && bytes[offset..].starts_with(&[quote; 3]) => return offset + 3,
            _ => {}
        }
        offset += 1;
    }
    bytes.len()
}

fn syntax_error(places: &Places<'_>, error: &toml::de::Error) -> SceneError {
    let source = places.source(error.span().unwrap_or(0..0));
    SceneError::at(&source, format!("not valid TOML: {}", error.message().replace('\n', " ")))
}

/// Turns the TOML reader's tree into ours.
struct Converter<'a> {
    source: &'a dyn Fn(std::ops::Range<usize>) -> Source,
}

impl Converter<'_> {
    fn node(&self, spanned: Spanned<DeValue<'_>>, depth: usize) -> Result<Node> {
        let source = (self.source)(spanned.span());
        if depth > MAX_DEPTH {
            return Err(SceneError::at(&source, format!("nested more than {MAX_DEPTH} deep")));
        }
        let value = match spanned.into_inner() {
            DeValue::String(text) => Value::String(text.into_owned()),
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(integer) => Value::Integer(integer),
                Err(_) => return Err(SceneError::at(&source, "a whole number that is too large")),
            },
            DeValue::Float(float) => match float.as_str().parse() {
                Ok(float) => Value::Float(float),
                Err(_) => return Err(SceneError::at(&source, "not a number")),
            },
            DeValue::Boolean(boolean) => Value::Boolean(boolean),
            DeValue::Datetime(_) => {
                return Err(SceneError::at(&source, "dates and times mean nothing in a scene"));
            }
            DeValue::Array(array) => {
                Value::Array(array.into_iter().map(|item| self.node(item, depth + 1)).collect::<Result<_>>()?)
            }
            DeValue::Table(table) => self.table(table, depth + 1)?,
        };
        Ok(Node { value, source })
    }

    fn table(&self, table: DeTable<'_>, depth: usize) -> Result<Value> {
        let mut pairs: Vec<_> = table.into_iter().collect();
        pairs.sort_by_key(|(key, _)| key.span().start);
        let entries = pairs.into_iter().map(|(key, value)| {
            let source = (self.source)(key.span());
            Ok(Entry { key: key.into_inner().into_owned(), source, node: self.node(value, depth)? })
        });
        Ok(Value::Table(entries.collect::<Result<_>>()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_text(text: &str) -> Result<Node> {
        parse(text, &Arc::from("a.toml"))
    }

    #[test]
    fn keys_keep_their_order_and_know_their_places() {
        let root = parse_text("z = 1\n[a]\nb = [1.5,\n  true]\n").unwrap();
        let Value::Table(entries) = root.value else { panic!("not a table") };
        assert_eq!((entries[0].key.as_str(), entries[1].key.as_str()), ("z", "a"));
        let Value::Table(inner) = &entries[1].node.value else { panic!("not a table") };
        assert_eq!((inner[0].source.line, inner[0].source.column), (3, 1));
        let Value::Array(items) = &inner[0].node.value else { panic!("not an array") };
        assert_eq!((items[1].source.line, items[1].source.column), (4, 3));
        assert!(matches!(items[1].value, Value::Boolean(true)));
    }

    #[test]
    fn faults_of_syntax_have_a_place() {
        let error = parse_text("a = 1\nb = [1, 2\n").unwrap_err();
        assert!(error.source.unwrap().line >= 2);
        let error = parse_text("a = 1\na = 2\n").unwrap_err();
        assert_eq!(error.source.unwrap().line, 2);
        assert_eq!(parse_text("\n\nd = 2020-01-01").unwrap_err().source.unwrap().line, 3);
        assert_eq!(parse_text("i = 99999999999999999999").unwrap_err().source.unwrap().column, 5);
    }

    #[test]
    fn bottomless_nesting_is_refused() {
        assert!(parse_text(&format!("{}a = 1", "a.".repeat(200_000))).is_err());
        assert!(parse_text(&format!("a = {}", "[".repeat(200_000))).is_err());
        assert!(parse_text(&format!("[{}a]", "a.".repeat(200_000))).is_err());
        let hidden = format!("x = {{ a = \"\"\"\n\"\"\", {}b = 1 }}", "b.".repeat(200_000));
        assert!(parse_text(&hidden).unwrap_err().message.contains("dots in a row"));
        let harmless = format!("# {0}\na = '{0}'\nb = \"{0}\\\"{0}\"\n", ".".repeat(100));
        assert!(parse_text(&harmless).is_ok(), "dots in comments and strings are no keys");
        assert!(parse_text(&format!("a = {}1{}", "{a = ".repeat(70), "}".repeat(70))).is_err());
        assert!(
            parse_value(&format!("{{{}a = 1}}", "a.".repeat(200_000)), &Source::built_in())
                .unwrap()
                .is_none()
        );
    }
}
