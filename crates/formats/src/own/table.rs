//! A table that remembers which of its keys were asked for, so that the others can be refused.

use super::document::{Entry, Node, Value};
use super::field::Field;
use crate::Result;
use crate::nearest::{advice, is_similar};
use hyaline_scene::{SceneError, Source};

/// A table being read.
///
/// Each `take` makes its key a known one; `finish` refuses the keys that nobody asked for. Keys must therefore be
/// asked for whether or not they are needed.
#[derive(Debug)]
pub(crate) struct Table<'a> {
    /// What it describes, for messages: "camera", "sphere 'ball'".
    pub(crate) what: String,
    /// Place of the table.
    pub(crate) source: &'a Source,
    entries: &'a [Entry],
    asked: Vec<&'static str>,
}

impl<'a> Table<'a> {
    /// Starts to read a table.
    ///
    /// # Errors
    /// The value is no table.
    pub(crate) fn new(what: impl Into<String>, field: Field<'a>) -> Result<Self> {
        let Value::Table(entries) = &field.node.value else { return Err(field.wrong_type("a table")) };
        Ok(Self { what: what.into(), source: &field.node.source, entries, asked: Vec::new() })
    }

    /// Starts to read the document.
    pub(crate) fn root(node: &'a Node) -> Result<Self> {
        Self::new("scene", Field { key: "scene", node })
    }

    /// The value of a key, if it is there.
    pub(crate) fn take(&mut self, key: &'static str) -> Option<Field<'a>> {
        self.asked.push(key);
        self.entries
            .iter()
            .find(|entry| entry.key == key)
            .map(|entry| Field { key: &entry.key, node: &entry.node })
    }

    /// The value of a key, converted; `default` where the key is absent.
    ///
    /// # Errors
    /// Those of `convert`.
    pub(crate) fn read<T>(
        &mut self,
        key: &'static str,
        default: T,
        convert: impl FnOnce(Field<'a>) -> Result<T>,
    ) -> Result<T> {
        self.take(key).map_or(Ok(default), convert)
    }

    /// The value of a key, converted, if it is there.
    ///
    /// # Errors
    /// Those of `convert`.
    pub(crate) fn read_some<T>(
        &mut self,
        key: &'static str,
        convert: impl FnOnce(Field<'a>) -> Result<T>,
    ) -> Result<Option<T>> {
        self.take(key).map(convert).transpose()
    }

    /// The value of a key that has to be there; `example` shows how to write it.
    ///
    /// # Errors
    /// The key is absent; where an unknown key looks like it, that one is named.
    pub(crate) fn require(&mut self, key: &'static str, example: &str) -> Result<Field<'a>> {
        if let Some(field) = self.take(key) {
            return Ok(field);
        }
        let slip = |entry: &&Entry| !self.asked.contains(&entry.key.as_str()) && is_similar(&entry.key, key);
        if let Some(entry) = self.entries.iter().find(slip) {
            return Err(self.unknown(entry));
        }
        Err(SceneError::at(self.source, format!("{} needs `{key}`", self.what))
            .with_remedy(format!("add `{key} = {example}`")))
    }

    /// The only one of several keys that exclude each other, if one is there.
    ///
    /// # Errors
    /// Two of them are there.
    pub(crate) fn take_one(&mut self, keys: &[&'static str]) -> Result<Option<Field<'a>>> {
        let mut found: Option<Field<'a>> = None;
        for key in keys {
            let Some(field) = self.take(key) else { continue };
            if let Some(first) = found {
                return Err(
                    field.error(format!("`{}` and `{}` exclude each other; keep one", first.key, field.key))
                );
            }
            found = Some(field);
        }
        Ok(found)
    }

    /// Ends reading.
    ///
    /// # Errors
    /// A key that nobody asked for.
    pub(crate) fn finish(self) -> Result<()> {
        match self.entries.iter().find(|entry| !self.asked.contains(&entry.key.as_str())) {
            Some(entry) => Err(self.unknown(entry)),
            None => Ok(()),
        }
    }

    fn unknown(&self, entry: &Entry) -> SceneError {
        SceneError::at(&entry.source, format!("unknown key `{}` in {}", entry.key, self.what))
            .with_remedy(advice(&entry.key, &self.asked))
    }
}

#[cfg(test)]
mod tests {
    use super::super::document;
    use super::*;

    fn with_table<T>(text: &str, check: impl FnOnce(Table<'_>) -> T) -> T {
        let root = document::parse(text, &"a.toml".into()).unwrap();
        check(Table::root(&root).unwrap())
    }

    #[test]
    fn keys_that_nobody_asked_for_are_refused_with_the_nearest_known_one() {
        let error = with_table("radius = 1\ncentre = 2\n", |mut table| {
            table.take("radius");
            table.take("center");
            table.finish().unwrap_err()
        });
        let text = error.to_string();
        assert!(
            text.starts_with("a.toml:2:1: unknown key `centre` in scene; did you mean 'center'?"),
            "{text}"
        );
    }

    #[test]
    fn a_missing_key_names_the_slip_that_stands_for_it() {
        let slip = with_table("fiel = 1", |mut table| table.require("file", "\"a.ply\"").unwrap_err());
        assert!(slip.to_string().contains("unknown key `fiel`"), "{slip}");
        let missing = with_table("x = 1", |mut table| table.require("file", "\"a.ply\"").unwrap_err());
        assert!(missing.to_string().contains("scene needs `file`; add `file = \"a.ply\"`"), "{missing}");
    }

    #[test]
    fn exclusive_keys_exclude_each_other() {
        with_table("a = 1\nb = 2\n", |mut table| assert!(table.take_one(&["a", "b"]).is_err()));
        with_table("b = 2\n", |mut table| assert_eq!(table.take_one(&["a", "b"]).unwrap().unwrap().key, "b"));
    }
}
