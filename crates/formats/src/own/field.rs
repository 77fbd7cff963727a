//! A value under a key, and its conversion to numbers, colors, vectors and choices.

use super::document::{Node, Value};
use super::table::Table;
use crate::color::parse_hex;
use crate::limits::{LARGEST_LENGTH, Limits, SMALLEST_LENGTH};
use crate::nearest::advice;
use crate::{Result, unit};
use hyaline_math::DVec3;
use hyaline_scene::{Located, Rgb, SceneError, Source};

/// Largest float below which every whole number is one: 2^53.
const LARGEST_WHOLE_FLOAT: f64 = 9_007_199_254_740_992.0;

/// A value with the key it stands under; items of an array keep the array's key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field<'a> {
    /// The key.
    pub(crate) key: &'a str,
    /// The value.
    pub(crate) node: &'a Node,
}

impl<'a> Field<'a> {
    /// Place of the value.
    pub(crate) fn source(&self) -> &'a Source {
        &self.node.source
    }

    /// A fault of this value.
    pub(crate) fn error(&self, message: impl Into<String>) -> SceneError {
        SceneError::at(self.source(), message)
    }

    /// The fault that this value is not of the expected type.
    pub(crate) fn wrong_type(&self, expected: &str) -> SceneError {
        self.error(format!("`{}` must be {expected}, not {}", self.key, self.node.value.kind()))
    }

    /// Text.
    pub(crate) fn string(&self) -> Result<&'a str> {
        match &self.node.value {
            Value::String(text) => Ok(text),
            _ => Err(self.wrong_type("a string")),
        }
    }

    /// A name of something, with its place.
    pub(crate) fn name(&self) -> Result<Located<String>> {
        let name = self.string()?;
        if name.is_empty() {
            return Err(self.error(format!("`{}` is empty; give a name", self.key)));
        }
        Ok(Located::new(name.to_owned(), self.source().clone()))
    }

    /// `true` or `false`.
    pub(crate) fn boolean(&self) -> Result<bool> {
        match self.node.value {
            Value::Boolean(boolean) => Ok(boolean),
            _ => Err(self.wrong_type("true or false")),
        }
    }

    /// A whole number from `low` to `high`; `2e6` is one, too.
    pub(crate) fn integer(&self, low: i64, high: i64) -> Result<i64> {
        let integer = match self.node.value {
            Value::Integer(integer) => integer,
            // TOML takes every number with an exponent for a float; up to 2^53 none is rounded.
            Value::Float(float) if float.fract() == 0.0 && float.abs() <= LARGEST_WHOLE_FLOAT => float as i64,
            _ => return Err(self.wrong_type("a whole number")),
        };
        if (low..=high).contains(&integer) {
            return Ok(integer);
        }
        Err(self.error(format!("`{}` must be from {low} to {high}, not {integer}", self.key)))
    }

    /// A whole number from `low` on.
    pub(crate) fn count(&self, low: u32) -> Result<u32> {
        self.integer(i64::from(low), i64::from(u32::MAX)).map(|count| count as u32)
    }

    /// A finite number within limits.
    pub(crate) fn number(&self, limits: Limits) -> Result<f64> {
        self.check(self.any_number()?, limits)
    }

    /// A finite number within limits that `f32` can hold.
    pub(crate) fn number_f32(&self, limits: Limits) -> Result<f32> {
        let number = self.number(limits)? as f32;
        if number.is_finite() { Ok(number) } else { Err(self.error(format!("`{}` is too large", self.key))) }
    }

    /// An angle in degrees within limits, in radians.
    pub(crate) fn angle(&self, degrees: Limits) -> Result<f64> {
        Ok(self.number(degrees)?.to_radians())
    }

    /// A length in scene units: a number, or a string with a unit. `metres` is the length of a scene unit.
    pub(crate) fn length(&self, metres: f64, limits: Limits) -> Result<f64> {
        let length = match &self.node.value {
            Value::String(text) => {
                let length = unit::parse_length(text);
                length.map_err(|fault| self.error(format!("`{}` {fault}", self.key)))? / metres
            }
            Value::Integer(_) | Value::Float(_) => self.any_number()?,
            _ => return Err(self.wrong_type("a length: a number, or a string such as \"2 mm\"")),
        };
        let length = self.check(length, limits)?;
        if length.abs() > LARGEST_LENGTH {
            return Err(self.error(format!("`{}` is beyond {LARGEST_LENGTH:e} scene units", self.key)));
        }
        let is_lost = length.abs() < SMALLEST_LENGTH && !limits.contain(0.0);
        if is_lost { Err(self.error(format!("`{}` is too small to count", self.key))) } else { Ok(length) }
    }

    /// A number that may yet be NaN or infinite.
    fn any_number(&self) -> Result<f64> {
        match self.node.value {
            Value::Integer(integer) => Ok(integer as f64),
            Value::Float(float) => Ok(float),
            _ => Err(self.wrong_type("a number")),
        }
    }

    fn check(&self, number: f64, limits: Limits) -> Result<f64> {
        if limits.contain(number) {
            return Ok(number);
        }
        Err(self.error(format!("`{}` must be {}, not {number}", self.key, limits.words())))
    }

    /// The items of an array.
    pub(crate) fn items(&self) -> Result<Vec<Field<'a>>> {
        let Value::Array(items) = &self.node.value else { return Err(self.wrong_type("an array")) };
        Ok(items.iter().map(|node| Field { key: self.key, node }).collect())
    }

    /// The items of an array, or a single value taken for an array of one.
    pub(crate) fn items_or_one(&self) -> Result<Vec<Field<'a>>> {
        if matches!(self.node.value, Value::Array(_)) { self.items() } else { Ok(vec![*self]) }
    }

    /// An array of exactly `N` values, each converted.
    pub(crate) fn array<const N: usize, T>(
        &self,
        convert: impl FnMut(Field<'a>) -> Result<T>,
    ) -> Result<[T; N]> {
        let items = self.items()?;
        let count = items.len();
        let items: [Field<'a>; N] = items
            .try_into()
            .map_err(|_| self.error(format!("`{}` must have {N} values, not {count}", self.key)))?;
        let converted = items.into_iter().map(convert).collect::<Result<Vec<T>>>()?;
        converted.try_into().map_err(|_| self.wrong_type("an array"))
    }

    /// The values of a table with free keys, in order.
    pub(crate) fn entries(&self) -> Result<Vec<(Field<'a>, &'a Source)>> {
        let Value::Table(entries) = &self.node.value else { return Err(self.wrong_type("a table")) };
        Ok(entries
            .iter()
            .map(|entry| (Field { key: &entry.key, node: &entry.node }, &entry.source))
            .collect())
    }

    /// A table with known keys; `what` names it in messages.
    pub(crate) fn table(&self, what: impl Into<String>) -> Result<Table<'a>> {
        Table::new(what, *self)
    }

    /// A point or offset: three lengths, in scene units.
    pub(crate) fn point(&self, metres: f64) -> Result<DVec3> {
        self.array(|item| item.length(metres, Limits::ANY)).map(DVec3::from_array)
    }

    /// A direction: three numbers that are not all 0; the length is free.
    pub(crate) fn direction(&self) -> Result<DVec3> {
        let direction = DVec3::from_array(self.array(|item| item.number(Limits::between(-1e15, 1e15)))?);
        match direction.try_normalize() {
            Some(_) => Ok(direction),
            None => Err(self.error(format!("`{}` is a direction and must not be zero", self.key))),
        }
    }

    /// A color within limits: three linear values, `"#rrggbb"` in sRGB, or a number for a grey.
    pub(crate) fn color(&self, limits: Limits) -> Result<Rgb> {
        match &self.node.value {
            Value::Array(_) => self.array(|item| item.number_f32(limits)),
            Value::String(text) => {
                let color = parse_hex(text).ok_or_else(|| {
                    let message = format!("`{}` is \"{text}\", which is no color", self.key);
                    self.error(message).with_remedy("write [r, g, b], \"#rrggbb\" or a number for a grey")
                })?;
                for value in color {
                    self.check(f64::from(value), limits)?;
                }
                Ok(color)
            }
            Value::Integer(_) | Value::Float(_) => self.number_f32(limits).map(|grey| [grey; 3]),
            _ => Err(self.wrong_type("a color: [r, g, b], \"#rrggbb\" or a number")),
        }
    }

    /// One of several words.
    pub(crate) fn choice<T: Copy>(&self, choices: &[(&'static str, T)]) -> Result<T> {
        let word = self.string()?;
        let found = choices.iter().find(|(name, _)| *name == word).map(|(_, value)| *value);
        found.ok_or_else(|| self.no_such_choice(&choices.iter().map(|(name, _)| *name).collect::<Vec<_>>()))
    }

    /// The fault that this word is none of `names`.
    pub(crate) fn no_such_choice(&self, names: &[&'static str]) -> SceneError {
        let word = self.string().unwrap_or_default();
        self.error(format!("unknown {} '{word}'", self.key)).with_remedy(advice(word, names))
    }
}

#[cfg(test)]
#[path = "field_tests.rs"]
mod tests;
