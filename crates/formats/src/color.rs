//! Colors as files spell them, to linear Rec. 709.

use hyaline_math::float;
use hyaline_scene::Rgb;

/// An sRGB-encoded value to a linear one, both 0…1.
///
/// Source: IEC 61966-2-1:1999, §5.2.
pub(crate) fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { float::powf((encoded + 0.055) / 1.055, 2.4) }
}

/// `#rrggbb` or `#rgb`, which are sRGB, to a linear color; `None` where it is neither.
pub(crate) fn parse_hex(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#')?;
    let nibbles = digits.chars().map(|c| c.to_digit(16)).collect::<Option<Vec<u32>>>()?;
    let bytes = match nibbles.as_slice() {
        [r, g, b] => [r * 17, g * 17, b * 17],
        [r1, r0, g1, g0, b1, b0] => [r1 * 16 + r0, g1 * 16 + g0, b1 * 16 + b0],
        _ => return None,
    };
    Some(bytes.map(|byte| linear_from_srgb(byte as f32 / 255.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_colors_are_srgb() {
        assert_eq!(parse_hex("#ffffff"), Some([1.0; 3]));
        assert_eq!(parse_hex("#f00"), Some([1.0, 0.0, 0.0]));
        let middle = parse_hex("#808080").unwrap()[0];
        assert!((middle - 0.215_860_5).abs() < 1e-6, "{middle}");
        assert_eq!(parse_hex("#12345"), None);
        assert_eq!(parse_hex("#gggggg"), None);
        assert_eq!(parse_hex("red"), None);
    }
}
