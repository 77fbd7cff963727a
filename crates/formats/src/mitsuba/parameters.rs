//! Parameters: what `<default>` gives and `--set default.NAME=VALUE` overrides, put in place of `$NAME`.
//!
//! A parameter may be made of others, so a few lines could ask for more text than memory holds: one replaced text and
//! all of them together are limited.

use crate::Result;
use crate::nearest::nearest;
use hyaline_scene::{SceneError, Source};
use std::cell::Cell;
use std::collections::BTreeMap;

/// Longest text that replacing may give, bytes.
const MAX_TEXT: usize = 1 << 16;
/// Most text that replacing may give in a scene, bytes.
const MAX_TOTAL: usize = 1 << 26;
/// What a key of `--set` begins with that means a parameter.
const PREFIX: &str = "default.";

/// The parameters of a scene.
#[derive(Debug, Default)]
pub(super) struct Parameters {
    values: BTreeMap<String, String>,
    /// Values of the command line, and whether the scene asked for them.
    given: BTreeMap<String, (String, Cell<bool>)>,
    total: Cell<usize>,
}

impl Parameters {
    /// Takes the parameters out of a list of overrides; returns them and the other overrides.
    pub(super) fn from_overrides(overrides: &[(String, String)]) -> (Self, Vec<(String, String)>) {
        let mut parameters = Self::default();
        let mut others = Vec::new();
        for (key, value) in overrides {
            match key.strip_prefix(PREFIX) {
                Some(name) => {
                    parameters.given.insert(name.to_owned(), (value.clone(), Cell::new(false)));
                }
                None => others.push((key.clone(), value.clone())),
            }
        }
        (parameters, others)
    }

    /// What `<default>` says: it counts where nothing else was said before.
    pub(super) fn define(&mut self, name: String, value: String) {
        self.values.entry(name).or_insert(value);
    }

    fn get(&self, name: &str) -> Option<&str> {
        let value = self.values.get(name).map(String::as_str);
        let Some((given, is_used)) = self.given.get(name) else { return value };
        is_used.set(true);
        Some(given)
    }

    /// A text with each `$name` replaced.
    ///
    /// # Errors
    /// A parameter has no value; the result is too long.
    pub(super) fn replace(&self, text: &str, source: &Source) -> Result<String> {
        let mut parts = text.split('$');
        let mut result = parts.next().unwrap_or_default().to_owned();
        if result.len() == text.len() {
            return Ok(result);
        }
        for part in parts {
            let length = part.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(part.len());
            let (name, rest) = part.split_at(length);
            let Some(value) = self.get(name) else {
                let error = SceneError::at(source, format!("the parameter '${name}' has no value"));
                let remedy = "or say --set default.NAME=VALUE";
                return Err(
                    error.with_remedy(format!("add <default name=\"{name}\" value=\"...\"/>, {remedy}"))
                );
            };
            result.push_str(value);
            result.push_str(rest);
            if result.len() > MAX_TEXT {
                let message = format!("the parameter '${name}' makes a text of more than {MAX_TEXT} bytes");
                return Err(SceneError::at(source, message));
            }
        }
        self.total.set(self.total.get() + result.len());
        if self.total.get() > MAX_TOTAL {
            let message = format!("the scene's parameters make more than {MAX_TOTAL} bytes of text");
            return Err(SceneError::at(source, message));
        }
        Ok(result)
    }

    /// Checks that the scene asked for everything that the command line gave.
    ///
    /// # Errors
    /// The first that it did not, with the nearest name.
    pub(super) fn check_used(&self) -> Result<()> {
        let is_known = |name: &str| self.values.contains_key(name);
        let unused = self.given.iter().find(|(name, (_, used))| !used.get() && !is_known(name));
        let Some((name, _)) = unused else { return Ok(()) };
        let error = SceneError::at(&Source::file("--set"), format!("the scene has no parameter '${name}'"));
        Err(match nearest(name, self.values.keys().map(String::as_str)) {
            Some(candidate) => error.with_remedy(format!("did you mean '{PREFIX}{candidate}'?")),
            None => error.with_remedy("it has no <default> at all"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_replace_their_names_and_first_come_counts() {
        let mut parameters = Parameters::default();
        parameters.define("n".to_owned(), "4".to_owned());
        parameters.define("n".to_owned(), "5".to_owned());
        parameters.define("n_2".to_owned(), "x".to_owned());
        let source = Source::built_in();
        assert_eq!(parameters.replace("a $n, $n_2.png", &source).unwrap(), "a 4, x.png");
        assert_eq!(parameters.replace("nothing", &source).unwrap(), "nothing");
        let error = parameters.replace("$m", &source).unwrap_err().to_string();
        assert!(error.contains("'$m' has no value") && error.contains("<default name=\"m\""), "{error}");
    }

    #[test]
    fn parameters_that_double_themselves_end_at_the_limit() {
        let mut parameters = Parameters::default();
        let source = Source::built_in();
        parameters.define("a0".to_owned(), "lol".repeat(10));
        for i in 0..40 {
            let text = format!("$a{i}$a{i}$a{i}$a{i}");
            match parameters.replace(&text, &source) {
                Ok(value) => parameters.define(format!("a{}", i + 1), value),
                Err(error) => return assert!(error.message.contains("65536 bytes"), "{error}"),
            }
        }
        panic!("the texts grow without end");
    }

    #[test]
    fn much_text_in_small_pieces_ends_at_the_limit_too() {
        let mut parameters = Parameters::default();
        parameters.define("a".to_owned(), "x".repeat(MAX_TEXT));
        let pieces = (0..2000).map(|_| parameters.replace("$a", &Source::built_in()));
        let error = pieces.filter_map(Result::err).next().unwrap();
        assert!(error.message.contains("67108864 bytes"), "{error}");
    }
}
