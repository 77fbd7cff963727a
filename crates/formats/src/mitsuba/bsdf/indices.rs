//! Mitsuba's named indices of refraction.
//!
//! Values for the sodium D line at room temperature, as its documentation of `dielectric` tables them: measured
//! constants, kept as they are so that pictures compare.

use crate::nearest::nearest;

const INDICES: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.3330),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.470),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.5750),
    ("diamond", 2.419),
];

/// Index of air, which is outside where a file does not say what is.
pub(super) const AIR: f64 = 1.000_277;
/// Index of BK7, which is inside where a file does not say what is.
pub(super) const BK7: f64 = 1.5046;
/// Index inside of plastics where a file does not say.
pub(super) const POLYPROPYLENE: f64 = 1.49;

/// The index of a name; `Err` is the nearest name.
pub(super) fn by_name(name: &str) -> Result<f64, &'static str> {
    let found = INDICES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name.trim()));
    found
        .map(|(_, index)| *index)
        .ok_or_else(|| nearest(name, INDICES.iter().map(|(known, _)| *known)).unwrap_or("bk7"))
}
