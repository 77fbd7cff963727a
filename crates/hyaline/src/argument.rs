//! Values of options: from text, with a clear word on what was expected.

use std::num::NonZeroUsize;
use std::ops::Range;
use std::time::Duration;

/// Most pixels along one side of a picture.
pub(crate) const MAX_SIDE: u32 = 65_536;

/// Most threads that can be asked for: more than any machine has, and few enough to start.
const MAX_THREADS: usize = 1024;

/// A number of threads: 1…[`MAX_THREADS`].
pub(crate) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    text.trim()
        .parse::<NonZeroUsize>()
        .ok()
        .filter(|count| count.get() <= MAX_THREADS)
        .ok_or_else(|| format!("expected a number of threads from 1 to {MAX_THREADS}, not '{text}'"))
}

/// A time: `30`, `30s`, `1.5m`, `1h`, `500ms`; more than 0.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let wanted = || format!("expected a time such as 30, 30s, 2m or 1h, not '{text}'");
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match &text[digits.len()..] {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err(wanted()),
    };
    let seconds = digits.trim().parse::<f64>().map_err(|_| wanted())? * factor;
    match Duration::try_from_secs_f64(seconds) {
        Ok(Duration::ZERO) => Err("expected a time of more than 0".into()),
        Ok(duration) => Ok(duration),
        Err(error) => Err(format!("'{text}' is no time: {error}")),
    }
}

/// Width and height: `640x480`; each 1…[`MAX_SIDE`].
pub(crate) fn size(text: &str) -> Result<(u32, u32), String> {
    let wanted = || format!("expected WIDTHxHEIGHT such as 640x480, not '{text}'");
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wanted)?;
    let width = width.trim().parse().map_err(|_| wanted())?;
    let height = height.trim().parse().map_err(|_| wanted())?;
    match (width, height) {
        (1..=MAX_SIDE, 1..=MAX_SIDE) => Ok((width, height)),
        _ => Err(format!("each side must have 1 to {MAX_SIDE} pixels")),
    }
}

/// A part of the picture: `x0,y0,x1,y1` with x0 < x1 and y0 < y1.
pub(crate) fn crop(text: &str) -> Result<[u32; 4], String> {
    let wanted = || format!("expected x0,y0,x1,y1 such as 10,20,110,80, not '{text}'");
    let numbers: Vec<u32> =
        text.split(',').map(|part| part.trim().parse()).collect::<Result<_, _>>().map_err(|_| wanted())?;
    let crop: [u32; 4] = numbers.try_into().map_err(|_| wanted())?;
    match crop {
        [x0, y0, x1, y1] if x0 < x1 && y0 < y1 => Ok(crop),
        _ => Err("holds no pixel: x0 < x1 and y0 < y1 are needed (x1 and y1 are exclusive)".into()),
    }
}

/// Passes `A..B`, that is A, ..., B-1, with A < B.
pub(crate) fn passes(text: &str) -> Result<Range<u32>, String> {
    let wanted = || format!("expected A..B such as 0..16, not '{text}'");
    let (first, end) = text.split_once("..").ok_or_else(wanted)?;
    let first = first.trim().parse().map_err(|_| wanted())?;
    let end = end.trim().parse().map_err(|_| wanted())?;
    if first >= end {
        return Err("holds no pass: A..B is A, ..., B-1".into());
    }
    Ok(first..end)
}

/// A factor on radiance, > 0.
pub(crate) fn exposure(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(factor) if factor > 0.0 && factor.is_finite() => Ok(factor),
        _ => Err(format!("expected a factor of more than 0, not '{text}'")),
    }
}

/// A relative squared error, > 0.
pub(crate) fn error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error.is_finite() => Ok(error),
        _ => Err(format!("expected an error of more than 0 such as 1e-3, not '{text}'")),
    }
}

/// `KEY=VALUE`, the key not empty.
pub(crate) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err(format!("expected KEY=VALUE such as settings.sampler=independent, not '{text}'")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_with_and_without_a_unit() {
        let seconds = |text| duration(text).map(|time| time.as_secs_f64());
        assert_eq!(seconds("30"), Ok(30.0));
        assert_eq!(seconds("30s"), Ok(30.0));
        assert_eq!(seconds("2m"), Ok(120.0));
        assert_eq!(seconds("1.5h"), Ok(5400.0));
        assert_eq!(seconds("500ms"), Ok(0.5));
    }

    #[test]
    fn what_is_no_time_is_refused() {
        for text in ["", "s", "0", "-3", "nan", "inf", "1e300", "3 weeks", "2m30"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_are_width_then_height() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for text in ["640", "0x10", "10x", "axb", "70000x2", "-1x4"] {
            assert!(size(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_crop_holds_a_pixel() {
        assert_eq!(crop("1,2,3,4"), Ok([1, 2, 3, 4]));
        for text in ["1,2,3", "1,2,1,4", "1,4,3,2", "1,2,3,4,5", "a,b,c,d"] {
            assert!(crop(text).is_err(), "{text}");
        }
    }

    #[test]
    fn passes_end_before_the_second_number() {
        assert_eq!(passes("4..16"), Ok(4..16));
        for text in ["4", "4..4", "5..4", "..4", "4..", "0..99999999999"] {
            assert!(passes(text).is_err(), "{text}");
        }
    }

    #[test]
    fn an_error_is_a_positive_number() {
        assert_eq!(error("1e-3"), Ok(1e-3));
        for text in ["0", "-1", "nan", "inf", "1%", ""] {
            assert!(error(text).is_err(), "{text}");
        }
    }

    #[test]
    fn an_assignment_splits_at_the_first_equals_sign() {
        assert_eq!(assignment("a.b = x=y"), Ok(("a.b".into(), "x=y".into())));
        assert!(assignment("a.b").is_err());
        assert!(assignment("=x").is_err());
    }
}
