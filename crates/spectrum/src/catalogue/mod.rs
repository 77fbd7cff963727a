//! Named substances: glasses, liquids and crystals by index of refraction, metals by complex index.
//!
//! Names are compared without regard to case, and a hyphen or underscore is a space.

mod dielectric;
mod metal;

pub use dielectric::{index_by_name, index_names};
pub use metal::{Conductor, LANE_WAVELENGTHS, conductor_by_name, conductor_names};

use hyaline_optics::{IndexModel, dispersion::LAMBDA_D};

/// The one index that `rgb` mode knows: that of the d line.
pub fn rgb_index(model: &IndexModel) -> f32 {
    model.index(LAMBDA_D) as f32
}

/// Whether two spellings name the same substance.
fn is_same_name(a: &str, b: &str) -> bool {
    let plain = |c: char| if matches!(c, '-' | '_') { ' ' } else { c.to_ascii_lowercase() };
    a.chars().map(plain).eq(b.chars().map(plain))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spelling_does_not_matter_but_the_name_does() {
        assert!(is_same_name("Fused_Silica", "fused silica"));
        assert!(is_same_name("N-BK7", "n bk7"));
        assert!(!is_same_name("bk7", "bk"));
        assert!(!is_same_name("", "bk"));
    }

    #[test]
    fn rgb_mode_takes_the_index_of_the_d_line() {
        assert_eq!(rgb_index(&IndexModel::Constant(1.5)), 1.5);
        assert_eq!(rgb_index(&index_by_name("bk7").unwrap()), 1.5168);
    }
}
