//! Coefficients of the materials that versions 0.5 and 0.6 know by name.
//!
//! In 1/mm, as the scattering is: reduced, so that it goes with an isotropic phase function. `scale` of the medium
//! turns them into 1 / scene unit.

use hyaline_scene::Rgb;

/// Name, reduced scattering coefficient, absorption coefficient.
///
/// Source: Jensen, Marschner, Levoy & Hanrahan, A Practical Model for Subsurface Light Transport, SIGGRAPH 2001, fig. 5.
const PRESETS: [(&str, Rgb, Rgb); 12] = [
    ("apple", [2.29, 2.39, 1.97], [0.0030, 0.0034, 0.046]),
    ("chicken1", [0.15, 0.21, 0.38], [0.015, 0.077, 0.19]),
    ("chicken2", [0.19, 0.25, 0.32], [0.018, 0.088, 0.20]),
    ("cream", [7.38, 5.47, 3.15], [0.0002, 0.0028, 0.0163]),
    ("ketchup", [0.18, 0.07, 0.03], [0.061, 0.97, 1.45]),
    ("marble", [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071]),
    ("potato", [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12]),
    ("skimmilk", [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142]),
    ("skin1", [0.74, 0.88, 1.01], [0.032, 0.17, 0.48]),
    ("skin2", [1.09, 1.59, 1.79], [0.013, 0.070, 0.145]),
    ("spectralon", [11.6, 20.4, 14.9], [0.0, 0.0, 0.0]),
    ("wholemilk", [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014]),
];

/// Scattering and absorption coefficients of a material, 1/mm; `None` where it is not known.
pub(super) fn coefficients(name: &str) -> Option<(Rgb, Rgb)> {
    let plain: String = name.chars().filter(|c| c.is_ascii_alphanumeric()).collect();
    let found = PRESETS.iter().find(|(known, _, _)| known.eq_ignore_ascii_case(&plain));
    found.map(|(_, sigma_s, sigma_a)| (*sigma_s, *sigma_a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_however_they_are_written() {
        assert_eq!(coefficients("Skin1"), Some(([0.74, 0.88, 1.01], [0.032, 0.17, 0.48])));
        assert_eq!(coefficients("Whole milk"), coefficients("wholemilk"));
        assert_eq!(coefficients("Pepsi"), None);
    }
}
