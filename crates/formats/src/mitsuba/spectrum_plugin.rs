//! `<spectrum type="...">`: a single color as a plugin of its own.

use super::element::Element;
use super::spectrum::{Meaning, black_body, color_of};
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::Rgb;

/// The color of a plugin whose kind is one of [`super::names::SPECTRUM_KINDS`].
///
/// # Errors
/// Values that are not numbers, or not as many as wavelengths.
pub(super) fn read(plugin: Element<'_>, meaning: Meaning) -> Result<Rgb> {
    match plugin.kind() {
        "blackbody" => {
            let temperature = plugin.float("temperature", 5000.0, Limits::between(1.0, 1e6))?;
            Ok(black_body(temperature, plugin.float("scale", 1.0, Limits::NOT_NEGATIVE)?))
        }
        "regular" | "irregular" => sampled(plugin, meaning),
        _ => {
            let scale = plugin.float("scale", 1.0, Limits::NOT_NEGATIVE)? as f32;
            // Not `Element::color`, which would follow plugins within each other without end.
            let property = plugin.property("value").or_else(|| plugin.property("color"));
            let color = property.map_or(Ok([1.0; 3]), |property| property.color(meaning))?;
            Ok(color.map(|value| value * scale))
        }
    }
}

/// `values` at `wavelengths`, or evenly from `wavelength_min` to `wavelength_max`.
fn sampled(plugin: Element<'_>, meaning: Meaning) -> Result<Rgb> {
    let Some(property) = plugin.property("values") else {
        return Err(plugin.error(format!("{} needs `values`", plugin.title())));
    };
    let values = property.numbers(property.value()?)?;
    let wavelengths = match plugin.property("wavelengths") {
        Some(wavelengths) => wavelengths.numbers(wavelengths.value()?)?,
        None => {
            let bound = |names: [&str; 2], default: f64| {
                let name = names[usize::from(plugin.property(names[0]).is_none())];
                plugin.float(name, default, Limits::between(1.0, 1e6))
            };
            let first = bound(["wavelength_min", "lambda_min"], 360.0)?;
            let last = bound(["wavelength_max", "lambda_max"], 830.0)?;
            let step = (last - first) / (values.len().max(2) - 1) as f64;
            (0..values.len()).map(|i| first + step * i as f64).collect()
        }
    };
    if wavelengths.len() != values.len() {
        let message = format!("there are {} wavelengths for {} values", wavelengths.len(), values.len());
        return Err(property.error(message));
    }
    let samples: Vec<(f64, f64)> = wavelengths.into_iter().zip(values).collect();
    property.check_rising(&samples)?;
    Ok(color_of(&samples, meaning))
}
