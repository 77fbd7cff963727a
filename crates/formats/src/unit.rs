//! Lengths with units, and the unit of a scene.

/// Unit names and their lengths in metres.
const UNITS: [(&str, f64); 13] = [
    ("nm", 1e-9),
    ("um", 1e-6),
    ("µm", 1e-6),
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("dm", 1e-1),
    ("m", 1.0),
    ("km", 1e3),
    ("in", 0.0254),
    ("ft", 0.3048),
    ("yd", 0.9144),
    ("mi", 1609.344),
    ("thou", 2.54e-5),
];

/// Length of a unit in metres.
pub(crate) fn metres(unit: &str) -> Option<f64> {
    UNITS.iter().find(|(name, _)| *name == unit).map(|(_, metres)| *metres)
}

/// Names of all units.
pub(crate) fn names() -> Vec<&'static str> {
    UNITS.iter().map(|(name, _)| *name).collect()
}

/// A length such as `2 mm` in metres.
///
/// # Errors
/// What is wrong with it, to be put after the name of the value.
pub(crate) fn parse_length(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let number = text.trim_end_matches(char::is_alphabetic);
    let unit = &text[number.len()..];
    let count: f64 = number
        .trim()
        .parse()
        .map_err(|_| format!("is '{text}', which is no length; write a number and a unit, as in \"2 mm\""))?;
    if unit.is_empty() {
        return Err(format!(
            "is \"{text}\" without a unit; write {text} without quotes or add a unit, as in \"2 mm\""
        ));
    }
    let metres = metres(unit)
        .ok_or_else(|| format!("has the unknown unit '{unit}'; the units are {}", names().join(", ")))?;
    Ok(count * metres)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_read_with_every_unit() {
        for (text, expected) in [
            ("2 mm", 0.002),
            ("20 cm", 0.2),
            ("1 in", 0.0254),
            ("3 ft", 0.9144),
            ("1.5 km", 1500.0),
            ("5e-1m", 0.5),
            (" -7µm ", -7e-6),
        ] {
            let length = parse_length(text).unwrap();
            assert!((length - expected).abs() < 1e-12 * expected.abs(), "{text}: {length}");
        }
    }

    #[test]
    fn malformed_lengths_say_what_is_wrong() {
        assert!(parse_length("2 parsec").unwrap_err().contains("unknown unit 'parsec'"));
        assert!(parse_length("mm").unwrap_err().contains("no length"));
        assert!(parse_length("12").unwrap_err().contains("without a unit"));
        assert!(parse_length("").is_err());
    }
}
