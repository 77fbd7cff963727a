//! Measured indices of metals between 450 and 650 nm, each with its source.

/// Measured values of one metal.
pub(super) struct Metal {
    /// English name, further spellings, chemical symbol.
    pub(super) names: &'static [&'static str],
    /// Wavelength in nm, ascending; n; k.
    pub(super) measured: &'static [(f32, f32, f32)],
}

impl Metal {
    /// (n, k) at `lambda`, nm, linear between the measured values and constant beyond them.
    pub(super) fn at(&self, lambda: f32) -> (f32, f32) {
        let after = self.measured.partition_point(|row| row.0 < lambda).clamp(1, self.measured.len() - 1);
        let (low, high) = (self.measured[after - 1], self.measured[after]);
        let t = ((lambda - low.0) / (high.0 - low.0)).clamp(0.0, 1.0);
        (low.1 + t * (high.1 - low.1), low.2 + t * (high.2 - low.2))
    }
}

#[allow(clippy::approx_constant, reason = "a measured 3.14 is not π")]
pub(super) const METALS: [Metal; 15] = [
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
    Metal {
        names: &["titanium", "Ti"],
        measured: &[
            (451.0, 2.27, 3.04),
            (471.0, 2.32, 3.10),
            (496.0, 2.36, 3.19),
            (521.0, 2.44, 3.30),
            (549.0, 2.54, 3.43),
            (582.0, 2.60, 3.58),
            (617.0, 2.67, 3.72),
            (659.0, 2.76, 3.84),
        ],
    },
    Metal {
        names: &["vanadium", "V"],
        measured: &[
            (451.0, 3.59, 3.46),
            (471.0, 3.81, 3.38),
            (496.0, 3.92, 3.26),
            (521.0, 3.86, 3.18),
            (549.0, 4.00, 3.04),
            (582.0, 3.83, 3.00),
            (617.0, 3.54, 3.02),
            (659.0, 3.25, 3.09),
        ],
    },
    // Weaver, Olson & Lynch, Optical properties of crystalline tungsten, Phys. Rev. B 12, 1975, read from the figure.
    Metal {
        names: &["tungsten", "wolfram", "W"],
        measured: &[
            (448.7, 3.314, 2.511),
            (465.0, 3.325, 2.574),
            (492.1, 3.380, 2.664),
            (511.1, 3.433, 2.700),
            (529.8, 3.490, 2.716),
            (548.9, 3.522, 2.739),
            (573.9, 3.526, 2.794),
            (602.4, 3.562, 2.866),
            (626.0, 3.607, 2.906),
            (646.0, 3.657, 2.925),
        ],
    },
    // Weaver, Olson & Lynch, Phys. Rev. B 15, 1977; in Palik, Handbook of Optical Constants of Solids, 1985.
    Metal {
        names: &["rhodium", "Rh"],
        measured: &[
            (459.2, 1.80, 4.49),
            (476.9, 1.85, 4.55),
            (495.9, 1.88, 4.65),
            (516.6, 1.90, 4.78),
            (539.1, 1.94, 4.94),
            (563.6, 2.00, 5.11),
            (590.4, 2.05, 5.30),
            (619.9, 2.12, 5.51),
            (652.6, 2.20, 5.76),
        ],
    },
    // Kirillova, Nomerovannaya & Noskov, Optical properties of molybdenum single crystals, Sov. Phys. JETP 33, 1971.
    Metal {
        names: &["molybdenum", "Mo"],
        measured: &[
            (450.0, 2.84, 3.51),
            (475.0, 2.95, 3.64),
            (500.0, 3.15, 3.73),
            (525.0, 3.22, 3.74),
            (550.0, 3.47, 3.56),
            (575.0, 3.42, 3.55),
            (600.0, 3.38, 3.56),
            (650.0, 3.45, 3.67),
        ],
    },
    // Golovashkin, Leksina, Motulevich & Shubin, Sov. Phys. JETP 29, 1969, at 293 K.
    Metal {
        names: &["niobium", "Nb"],
        measured: &[
            (460.0, 2.00, 3.00),
            (480.0, 2.02, 3.04),
            (500.0, 2.13, 3.07),
            (520.0, 2.20, 3.08),
            (540.0, 2.23, 3.15),
            (560.0, 2.29, 3.17),
            (580.0, 2.29, 3.23),
            (600.0, 2.27, 3.25),
            (620.0, 2.28, 3.25),
            (640.0, 2.27, 3.30),
        ],
    },
    // Inagaki, Arakawa & Williams, Optical properties of liquid mercury, Phys. Rev. B 23, 1981.
    Metal {
        names: &["mercury", "Hg"],
        measured: &[
            (442.80, 1.0270, 3.8019),
            (476.86, 1.1860, 4.0898),
            (516.60, 1.3833, 4.4061),
            (563.56, 1.6209, 4.7505),
            (619.92, 1.9099, 5.1495),
            (688.80, 2.2842, 5.5819),
        ],
    },
    // Pflüger & Fink, in Palik, Handbook of Optical Constants of Solids II, 1991.
    Metal {
        names: &["titanium nitride", "TiN"],
        measured: &[(413.3, 1.74, 1.04), (495.9, 1.20, 1.65), (619.9, 1.32, 2.69), (826.6, 1.82, 3.81)],
    },
];
