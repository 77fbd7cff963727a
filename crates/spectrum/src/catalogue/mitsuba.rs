//! The indices that Mitsuba 3 knows by name, so that its scenes render as they do there.

use super::is_same_name;

/// Index of refraction that Mitsuba 3 gives a name, at about 589 nm and without dispersion.
///
/// Returns `None` for names that Mitsuba 3 does not know.
/// Source: documentation of Mitsuba 3, plugin `dielectric`, table of named indices, after Hecht, Optics, 4th ed.
pub fn mitsuba_index_by_name(name: &str) -> Option<f64> {
    TABLE.iter().find(|(known, _)| is_same_name(known, name)).map(|(_, index)| *index)
}

/// All names that `mitsuba_index_by_name` knows, for error messages.
pub fn mitsuba_index_names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|(name, _)| *name)
}

const TABLE: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{index_by_name, rgb_index};

    #[test]
    fn names_give_the_constants_of_mitsuba() {
        assert_eq!(mitsuba_index_by_name("bk7"), Some(1.5046));
        assert_eq!(mitsuba_index_by_name("Water"), Some(1.333));
        assert_eq!(mitsuba_index_by_name("sapphire"), None);
        assert_eq!(mitsuba_index_names().count(), 23);
    }

    #[test]
    fn every_name_of_mitsuba_is_ours_too_with_about_the_same_index() {
        for name in mitsuba_index_names() {
            let ours = rgb_index(&index_by_name(name).unwrap_or_else(|| panic!("{name}")));
            let theirs = mitsuba_index_by_name(name).unwrap() as f32;
            // Mitsuba's BK7 is low by 0.012; everything else agrees to a few thousandths.
            let tolerance = if name == "bk7" { 0.0125 } else { 0.003 };
            assert!((ours - theirs).abs() < tolerance, "{name}: {ours} and {theirs}");
        }
    }
}
