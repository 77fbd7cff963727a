//! Complex indices of refraction of metals.

use super::is_same_name;

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

/// Measured values of one metal.
struct Metal {
    names: &'static [&'static str],
    /// Wavelength in nm, ascending; n; k.
    measured: &'static [(f32, f32, f32)],
}

impl Metal {
    /// (n, k) at `lambda`, nm, linear between the measured values and constant beyond them.
    fn at(&self, lambda: f32) -> (f32, f32) {
        let after = self.measured.partition_point(|row| row.0 < lambda).clamp(1, self.measured.len() - 1);
        let (low, high) = (self.measured[after - 1], self.measured[after]);
        let t = ((lambda - low.0) / (high.0 - low.0)).clamp(0.0, 1.0);
        (low.1 + t * (high.1 - low.1), low.2 + t * (high.2 - low.2))
    }
}

#[allow(clippy::approx_constant, reason = "a measured 3.14 is not π")]
const METALS: [Metal; 7] = [
    // Johnson & Christy, Optical constants of the noble metals, Phys. Rev. B 6, 1972, table I.
    Metal {
        names: &["gold", "Au"],
        measured: &[
            (430.5, 1.45, 1.948),
            (450.9, 1.38, 1.914),
            (471.4, 1.31, 1.849),
            (495.9, 1.04, 1.833),
            (520.9, 0.62, 2.081),
            (548.6, 0.43, 2.455),
            (582.1, 0.29, 2.863),
            (616.8, 0.21, 3.272),
            (659.5, 0.14, 3.697),
        ],
    },
    Metal {
        names: &["silver", "Ag"],
        measured: &[
            (430.5, 0.04, 2.462),
            (450.9, 0.04, 2.657),
            (471.4, 0.05, 2.869),
            (495.9, 0.05, 3.093),
            (520.9, 0.05, 3.324),
            (548.6, 0.06, 3.586),
            (582.1, 0.05, 3.858),
            (616.8, 0.06, 4.152),
            (659.5, 0.05, 4.483),
        ],
    },
    Metal {
        names: &["copper", "Cu"],
        measured: &[
            (430.5, 1.25, 2.305),
            (450.9, 1.24, 2.397),
            (471.4, 1.25, 2.483),
            (495.9, 1.22, 2.564),
            (520.9, 1.18, 2.608),
            (548.6, 1.02, 2.577),
            (582.1, 0.70, 2.704),
            (616.8, 0.30, 3.205),
            (659.5, 0.22, 3.747),
        ],
    },
    // Rakić, Algorithm for the determination of intrinsic optical constants of metal films, Appl. Opt. 34, 1995.
    Metal {
        names: &["aluminum", "aluminium", "Al"],
        measured: &[
            (442.8, 0.6079, 5.3676),
            (476.87, 0.7278, 5.7781),
            (516.6, 0.8734, 6.2418),
            (563.57, 1.0728, 6.7839),
            (619.93, 1.366, 7.4052),
            (652.25, 1.5724, 7.7354),
        ],
    },
    // Johnson & Christy, Optical constants of transition metals, Phys. Rev. B 9, 1974, table I.
    Metal {
        names: &["iron", "Fe"],
        measured: &[
            (451.0, 2.59, 2.77),
            (471.0, 2.67, 2.82),
            (496.0, 2.74, 2.88),
            (521.0, 2.86, 2.91),
            (549.0, 2.95, 2.93),
            (582.0, 2.94, 2.99),
            (617.0, 2.88, 3.05),
            (659.0, 2.92, 3.10),
        ],
    },
    Metal {
        names: &["chromium", "chrome", "Cr"],
        measured: &[
            (451.0, 2.33, 3.14),
            (471.0, 2.51, 3.24),
            (496.0, 2.75, 3.30),
            (521.0, 2.94, 3.33),
            (549.0, 3.18, 3.33),
            (582.0, 3.22, 3.30),
            (617.0, 3.17, 3.30),
            (659.0, 3.09, 3.34),
        ],
    },
    Metal {
        names: &["nickel", "Ni"],
        measured: &[
            (451.0, 1.73, 2.95),
            (471.0, 1.78, 3.09),
            (496.0, 1.82, 3.25),
            (521.0, 1.85, 3.42),
            (549.0, 1.92, 3.61),
            (582.0, 1.96, 3.80),
            (617.0, 1.99, 4.02),
            (659.0, 1.99, 4.26),
        ],
    },
];

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
        assert_eq!(conductor_by_name("AU"), conductor_by_name("Gold"));
        assert_eq!(conductor_by_name("aluminium"), conductor_by_name("Al"));
        assert_eq!(conductor_by_name("mithril"), None);
    }
}
