//! Linear Rec. 709 and its display form sRGB.

use hyaline_math::float;

/// Linear value of an sRGB component.
///
/// - `encoded`: 0…1; larger and negative values follow the formula.
///
/// Source: IEC 61966-2-1:1999, §5.2.
pub fn srgb_to_linear(encoded: f32) -> f32 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { float::powf((encoded + 0.055) / 1.055, 2.4) }
}

/// sRGB component of a linear value, the inverse of `srgb_to_linear`.
///
/// - `linear`: 0…1; larger and negative values follow the formula.
///
/// Source: IEC 61966-2-1:1999, §5.3.
pub fn linear_to_srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * float::powf(linear, 1.0 / 2.4) - 0.055 }
}

/// Linear value of an 8-bit sRGB component, 0…1.
pub fn srgb8_to_linear(encoded: u8) -> f32 {
    srgb_to_linear(f32::from(encoded) / 255.0)
}

/// Nearest 8-bit sRGB component of a linear value; clipped to 0…1, not a number becomes 0.
pub fn linear_to_srgb8(linear: f32) -> u8 {
    // The cast saturates, and takes NaN to 0.
    (255.0 * linear_to_srgb(linear.max(0.0)) + 0.5) as u8
}

/// Luminance of a linear Rec. 709 color, 1 for white.
///
/// Source: ITU-R BT.709-6, table 3, item 3.2.
pub fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Linear Rec. 709 color written as "#rrggbb" or "#rgb", which are sRGB.
///
/// Returns `None` for anything else.
/// Source: W3C, CSS Color Module Level 4, §5.2.
pub fn parse_hex(text: &str) -> Option<[f32; 3]> {
    let digits = text.strip_prefix('#')?;
    if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let component = |range: std::ops::Range<usize>| u8::from_str_radix(&digits[range], 16).ok();
    let encoded = match digits.len() {
        // A single digit stands for itself twice: f is ff.
        3 => [component(0..1)? * 17, component(1..2)? * 17, component(2..3)? * 17],
        6 => [component(0..2)?, component(2..4)?, component(4..6)?],
        _ => return None,
    };
    Some(encoded.map(srgb8_to_linear))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_convert() {
        assert_eq!([srgb_to_linear(0.0), srgb_to_linear(1.0)], [0.0, 1.0]);
        assert!((srgb_to_linear(0.5) - 0.214_041_14).abs() < 1e-6);
        assert!((linear_to_srgb(0.18) - 0.461_356).abs() < 1e-5);
        assert!((linear_to_srgb(0.002) - 0.025_84).abs() < 1e-7);
    }

    #[test]
    fn every_byte_survives_the_round_trip() {
        for byte in 0..=255 {
            assert_eq!(linear_to_srgb8(srgb8_to_linear(byte)), byte);
        }
    }

    #[test]
    fn the_two_branches_meet() {
        assert!((srgb_to_linear(0.040_45) - srgb_to_linear(0.040_451)).abs() < 1e-6);
        assert!((linear_to_srgb(0.003_130_8) - linear_to_srgb(0.003_130_9)).abs() < 1e-5);
        for i in -10..=40 {
            let x = i as f32 * 0.05;
            assert!((srgb_to_linear(linear_to_srgb(x)) - x).abs() < 1e-5 * x.abs().max(1.0));
        }
    }

    #[test]
    fn bytes_clip_what_a_display_cannot_show() {
        assert_eq!([-1.0, f32::NAN, 7.0, f32::INFINITY].map(linear_to_srgb8), [0, 0, 255, 255]);
    }

    #[test]
    fn white_has_luminance_one() {
        assert!((luminance([1.0; 3]) - 1.0).abs() < 1e-6);
        assert!((luminance([0.0, 1.0, 0.0]) - 0.7152).abs() < 1e-7);
    }

    #[test]
    fn hexadecimal_colors_are_srgb() {
        assert_eq!(parse_hex("#ffffff"), Some([1.0; 3]));
        assert_eq!(parse_hex("#000"), Some([0.0; 3]));
        assert_eq!(parse_hex("#F80"), parse_hex("#ff8800"));
        let [r, g, b] = parse_hex("#804000").unwrap();
        assert!((r - 0.215_861).abs() < 1e-5 && (g - 0.051_269).abs() < 1e-5 && b == 0.0);
        for bad in ["", "#", "ffffff", "#ffff", "#fffffff", "#ggg", "#+12", "#éé", "#12 456"] {
            assert_eq!(parse_hex(bad), None, "{bad}");
        }
    }
}
