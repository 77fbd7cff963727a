//! Numbers, vectors and colors in attributes.

use super::spectrum::{Meaning, black_body, color_of};
use super::tree::Property;
use crate::Result;
use crate::color::{linear_from_srgb, parse_hex};
use hyaline_math::DVec3;
use hyaline_scene::{Rgb, SceneError};

/// Largest number that is taken seriously: products of it stay finite.
const LARGEST: f64 = 1e30;

impl Property {
    /// An attribute's text.
    pub(super) fn text(&self, key: &str) -> Option<&str> {
        self.attributes.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }

    /// The text of `value`.
    pub(super) fn value(&self) -> Result<&str> {
        self.text("value").ok_or_else(|| self.error(format!("<{}> needs the attribute `value`", self.tag)))
    }

    /// A fault of this value.
    pub(super) fn error(&self, message: impl Into<String>) -> SceneError {
        SceneError::at(&self.source, message)
    }

    /// What messages call it.
    pub(super) fn title(&self) -> String {
        if self.name.is_empty() { format!("<{}>", self.tag) } else { format!("`{}`", self.name) }
    }

    /// A finite number from a text.
    pub(super) fn parse(&self, text: &str) -> Result<f64> {
        match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() && number.abs() <= LARGEST => Ok(number),
            Ok(number) => Err(self.error(format!("{} must be a finite number, not {number}", self.title()))),
            Err(_) => {
                let shown: String = text.chars().take(24).collect();
                Err(self.error(format!("{} must be a number, not '{shown}'", self.title())))
            }
        }
    }

    /// Numbers between commas or spaces.
    pub(super) fn numbers(&self, text: &str) -> Result<Vec<f64>> {
        let words = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty());
        words.map(|word| self.parse(word)).collect()
    }

    /// A triple from the attribute `key`.
    pub(super) fn triple(&self, key: &str) -> Result<Option<DVec3>> {
        let Some(text) = self.text(key) else { return Ok(None) };
        match self.numbers(text)?.as_slice() {
            [x, y, z] => Ok(Some(DVec3::new(*x, *y, *z))),
            other => Err(self.error(format!("{} must have 3 numbers, not {}", self.title(), other.len()))),
        }
    }

    /// A vector from `value`, which may be one number for all, or from `x`, `y`, `z`, each `missing` where absent.
    pub(super) fn vector(&self, missing: f64) -> Result<DVec3> {
        if let Some(text) = self.text("value")
            && let [all] = self.numbers(text)?.as_slice()
        {
            return Ok(DVec3::splat(*all));
        }
        if let Some(vector) = self.triple("value")? {
            return Ok(vector);
        }
        let coordinate = |key: &str| self.text(key).map_or(Ok(missing), |text| self.parse(text));
        Ok(DVec3::new(coordinate("x")?, coordinate("y")?, coordinate("z")?))
    }

    /// A color from a float, rgb, srgb, spectrum or blackbody.
    ///
    /// - `meaning`: of a spectrum by wavelengths.
    pub(super) fn color(&self, meaning: Meaning) -> Result<Rgb> {
        if self.tag == "blackbody" {
            return self.black_body();
        }
        let text = self.text("value").or(self.text("intensity"));
        let text = text.ok_or_else(|| self.error(format!("<{}> needs the attribute `value`", self.tag)))?;
        if text.trim().starts_with('#') {
            let error = || self.error(format!("{} is no color", self.title()));
            return parse_hex(text.trim()).ok_or_else(error);
        }
        if text.contains(':') {
            return self.spectrum(text, meaning);
        }
        let color = match self.numbers(text)?.as_slice() {
            [grey] => [*grey as f32; 3],
            [r, g, b] => [*r as f32, *g as f32, *b as f32],
            other => {
                return Err(self.error(format!(
                    "{} must have 1 or 3 numbers, not {}",
                    self.title(),
                    other.len()
                )));
            }
        };
        Ok(if self.tag == "srgb" { color.map(linear_from_srgb) } else { color })
    }

    /// Pairs `wavelength:value`, wavelengths in nm and rising.
    fn spectrum(&self, text: &str, meaning: Meaning) -> Result<Rgb> {
        let words = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|pair| !pair.is_empty());
        let pair = |word: &str| match word.split_once(':') {
            Some((wavelength, value)) => Ok((self.parse(wavelength)?, self.parse(value)?)),
            None => Err(self.error(format!("{} must have pairs 'wavelength:value'", self.title()))),
        };
        let samples = words.map(pair).collect::<Result<Vec<(f64, f64)>>>()?;
        self.check_rising(&samples)?;
        Ok(color_of(&samples, meaning))
    }

    /// Wavelengths must rise.
    pub(super) fn check_rising(&self, samples: &[(f64, f64)]) -> Result<()> {
        match samples.windows(2).any(|pair| pair[0].0 >= pair[1].0) {
            true => Err(self.error(format!("the wavelengths of {} must rise", self.title()))),
            false => Ok(()),
        }
    }

    fn black_body(&self) -> Result<Rgb> {
        let need = || self.error("<blackbody> needs the attribute `temperature`, in kelvin");
        // Version 0.5 also writes "5000K".
        let text = self.text("temperature").ok_or_else(need)?.trim_end_matches(['k', 'K']);
        let temperature = self.parse(text)?;
        if !(1.0..=1e6).contains(&temperature) {
            return Err(self.error(format!("a temperature must be from 1 to 1000000 K, not {temperature}")));
        }
        let scale =
            self.text("scale").or(self.text("multiplier")).map_or(Ok(1.0), |scale| self.parse(scale))?;
        Ok(black_body(temperature, scale))
    }
}
