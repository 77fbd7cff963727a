//! Complex indices of refraction of metals.

mod measured;

use super::is_same_name;
use measured::METALS;

/// Complex index of a metal in the lanes of `rgb` mode, relative to vacuum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Index of refraction per lane, 1.
    pub eta: [f32; 3],
    /// Extinction index per lane, 1.
    pub k: [f32; 3],
}

/// Wavelengths, nm, at which the red, green and blue lane of `rgb` mode see a metal.
///
/// With them the reflectances at normal incidence come within 0.08 of those integrated over the spectrum and converted
/// to linear Rec. 709, in Akenine-Möller et al., Real-Time Rendering, 4th ed., table 9.2.
pub const LANE_WAVELENGTHS: [f32; 3] = [630.0, 550.0, 465.0];

/// Complex index of a named metal, by its English name or chemical symbol.
///
/// Returns `None` for unknown names.
/// Source: given beside each table, measured values interpolated linearly to `LANE_WAVELENGTHS`.
pub fn conductor_by_name(name: &str) -> Option<Conductor> {
    let metal = METALS.iter().find(|metal| metal.names.iter().any(|known| is_same_name(known, name)))?;
    let lanes = LANE_WAVELENGTHS.map(|lambda| metal.at(lambda));
    Some(Conductor { eta: lanes.map(|(n, _)| n), k: lanes.map(|(_, k)| k) })
}

/// The first spelling of all names that `conductor_by_name` knows, for error messages.
pub fn conductor_names() -> impl Iterator<Item = &'static str> {
    METALS.iter().map(|metal| metal.names[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_optics::fresnel_conductor;

    fn normal_reflectance(name: &str) -> [f32; 3] {
        let metal = conductor_by_name(name).unwrap_or_else(|| panic!("{name}"));
        [0, 1, 2].map(|lane| fresnel_conductor(1.0, metal.eta[lane], metal.k[lane]))
    }

    #[test]
    fn gold_is_yellow_and_copper_is_red() {
        let [r, g, b] = normal_reflectance("gold");
        assert!(r > g && g > b && (0.9..1.0).contains(&r) && b < 0.45, "{r} {g} {b}");
        let [r, g, b] = normal_reflectance("Cu");
        assert!(r > g && g > b && r > 0.88 && g < 0.7, "{r} {g} {b}");
    }

    #[test]
    fn silver_and_aluminum_reflect_all_colors() {
        assert!(normal_reflectance("Ag").iter().all(|&f| f > 0.95));
        assert!(normal_reflectance("aluminium").iter().all(|&f| (0.9..0.95).contains(&f)));
    }

    #[test]
    fn metals_have_about_the_color_of_their_spectrum() {
        // Real-Time Rendering, 4th ed., table 9.2, linear Rec. 709.
        let published = [
            ("gold", [1.022, 0.782, 0.344]),
            ("silver", [0.972, 0.960, 0.915]),
            ("copper", [0.955, 0.638, 0.538]),
            ("aluminum", [0.913, 0.922, 0.924]),
            ("iron", [0.562, 0.565, 0.578]),
            ("chromium", [0.549, 0.556, 0.554]),
        ];
        for (name, want) in published {
            let got = normal_reflectance(name);
            let far = got.iter().zip(want).any(|(got, want): (&f32, f32)| (got - want).abs() > 0.08);
            assert!(!far, "{name}: {got:?} not {want:?}");
        }
    }

    #[test]
    fn further_metals_are_as_bright_as_their_luster() {
        // Mean of the lanes at normal incidence, rounded: a slip in a row of the table shows.
        for (name, reflectance) in [
            ("titanium", 0.56),
            ("vanadium", 0.56),
            ("tungsten", 0.49),
            ("rhodium", 0.76),
            ("molybdenum", 0.57),
            ("niobium", 0.55),
            ("mercury", 0.77),
        ] {
            let mean = normal_reflectance(name).iter().sum::<f32>() / 3.0;
            assert!((mean - reflectance).abs() < 0.04, "{name}: {mean}");
        }
        let [r, g, b] = normal_reflectance("TiN");
        assert!(r > g + 0.1 && g > b + 0.05, "{r} {g} {b}");
    }

    #[test]
    fn measured_rows_ascend_and_are_hit_exactly() {
        for metal in &METALS {
            assert!(metal.measured.windows(2).all(|pair| pair[0].0 < pair[1].0), "{:?}", metal.names);
            for &(lambda, n, k) in metal.measured {
                let (got_n, got_k) = metal.at(lambda);
                assert!((got_n - n).abs() < 1e-6 && (got_k - k).abs() < 1e-6);
            }
            assert_eq!(metal.at(300.0), (metal.measured[0].1, metal.measured[0].2));
        }
    }

    #[test]
    fn names_and_symbols_are_known() {
        for name in conductor_names() {
            assert!(conductor_by_name(name).is_some());
        }
        // Those that readers of other formats write.
        for name in [
            "silver",
            "aluminium",
            "gold",
            "chromium",
            "copper",
            "mercury",
            "molybdenum",
            "niobium",
            "nickel",
            "rhodium",
            "titanium nitride",
            "vanadium",
            "tungsten",
        ] {
            assert!(conductor_by_name(name).is_some(), "{name}");
        }
        assert_eq!(conductor_by_name("AU"), conductor_by_name("Gold"));
        assert_eq!(conductor_by_name("aluminium"), conductor_by_name("Al"));
        assert_eq!(conductor_by_name("mithril"), None);
    }
}
