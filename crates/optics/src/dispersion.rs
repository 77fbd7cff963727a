//! How the index of refraction depends on wavelength: the dispersion formulas of glass catalogues.

/// Fraunhofer's d line (helium), nm: the wavelength of the index that catalogues quote.
pub const LAMBDA_D: f64 = 587.5618;
/// Fraunhofer's F line (hydrogen), nm: the blue end of the Abbe number.
pub const LAMBDA_F: f64 = 486.1327;
/// Fraunhofer's C line (hydrogen), nm: the red end of the Abbe number.
pub const LAMBDA_C: f64 = 656.2725;

/// Index of refraction of a medium as a function of wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IndexModel {
    /// The same at all wavelengths.
    Constant(f64),
    /// By Sellmeier's formula.
    Sellmeier(Sellmeier),
    /// By Cauchy's formula.
    Cauchy(Cauchy),
    /// By index and Abbe number.
    Abbe(Abbe),
}

impl IndexModel {
    /// Index of refraction at a wavelength.
    ///
    /// - `lambda`: nm, in vacuum, > 0.
    ///
    /// Returns the index relative to vacuum (or to air, where the source of the coefficients says so).
    pub fn index(&self, lambda: f64) -> f64 {
        match self {
            Self::Constant(index) => *index,
            Self::Sellmeier(formula) => formula.index(lambda),
            Self::Cauchy(formula) => formula.index(lambda),
            Self::Abbe(pair) => pair.index(lambda),
        }
    }

    /// Abbe number V_d = (n_d - 1) / (n_F - n_C); infinite without dispersion.
    ///
    /// Source: ISO 7944.
    pub fn abbe_number(&self) -> f64 {
        (self.index(LAMBDA_D) - 1.0) / (self.index(LAMBDA_F) - self.index(LAMBDA_C))
    }

    /// Whether the index is a finite number above 0 all over the visible range, 360 to 830 nm; coefficients typed
    /// wrongly put a resonance there.
    pub fn is_usable(&self) -> bool {
        (360..=830).all(|lambda| {
            let index = self.index(f64::from(lambda));
            index.is_finite() && index > 0.0
        })
    }
}

/// n² = 1 + Σ b λ² / (λ² - c), λ in µm.
///
/// Source: Sellmeier, Annalen der Physik 219, 1871; in this form in the Schott catalogue, TIE-29.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sellmeier {
    /// Strengths, 1.
    pub b: [f64; 3],
    /// Squared wavelengths of the resonances, µm².
    pub c: [f64; 3],
}

impl Sellmeier {
    /// Index of refraction at `lambda`, nm; not a number where the formula gives n² < 0, close to a resonance.
    pub fn index(&self, lambda: f64) -> f64 {
        let squared = squared_micrometers(lambda);
        let terms = self.b.iter().zip(&self.c).map(|(b, c)| b * squared / (squared - c));
        (1.0 + terms.sum::<f64>()).sqrt()
    }
}

/// n = a + b / λ² + c / λ⁴, λ in µm.
///
/// Source: Born & Wolf, Principles of Optics, 7th ed., §2.3.4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cauchy {
    /// Index at infinite wavelength, 1.
    pub a: f64,
    /// µm².
    pub b: f64,
    /// µm⁴.
    pub c: f64,
}

impl Cauchy {
    /// Index of refraction at `lambda`, nm.
    pub fn index(&self, lambda: f64) -> f64 {
        let squared = squared_micrometers(lambda);
        self.a + (self.b + self.c / squared) / squared
    }
}

/// An index and an Abbe number, as glass catalogues put it in short.
///
/// Source: ISO 7944.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abbe {
    /// Index at the d line.
    pub nd: f64,
    /// V_d = (n_d - 1) / (n_F - n_C), not 0; infinite means no dispersion.
    pub abbe: f64,
}

impl Abbe {
    /// Index of refraction at `lambda`, nm.
    pub fn index(&self, lambda: f64) -> f64 {
        self.to_cauchy().index(lambda)
    }

    /// The two-term Cauchy formula with this index and Abbe number.
    pub fn to_cauchy(&self) -> Cauchy {
        let principal_dispersion = (self.nd - 1.0) / self.abbe;
        let span = 1.0 / squared_micrometers(LAMBDA_F) - 1.0 / squared_micrometers(LAMBDA_C);
        let b = principal_dispersion / span;
        Cauchy { a: self.nd - b / squared_micrometers(LAMBDA_D), b, c: 0.0 }
    }
}

/// Square of a wavelength given in nm, in µm².
fn squared_micrometers(lambda: f64) -> f64 {
    (lambda * 1e-3) * (lambda * 1e-3)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BK7: IndexModel = IndexModel::Sellmeier(Sellmeier {
        b: [1.039_612_12, 0.231_792_344, 1.010_469_45],
        c: [0.006_000_698_67, 0.020_017_914_4, 103.560_653],
    });
    const SF11: IndexModel = IndexModel::Sellmeier(Sellmeier {
        b: [1.738_484_03, 0.311_168_974, 1.174_908_71],
        c: [0.013_606_860_4, 0.061_595_046_3, 121.922_711],
    });

    #[test]
    fn glasses_have_the_index_and_abbe_number_of_their_data_sheets() {
        for (glass, nd, abbe) in [(BK7, 1.5168, 64.17), (SF11, 1.784_72, 25.76)] {
            assert!((glass.index(LAMBDA_D) - nd).abs() < 5e-6, "{}", glass.index(LAMBDA_D));
            assert!((glass.abbe_number() - abbe).abs() < 5e-3, "{}", glass.abbe_number());
            assert!(glass.is_usable());
        }
        // Further lines of the N-BK7 data sheet: g and r.
        assert!((BK7.index(435.8343) - 1.526_68).abs() < 5e-6);
        assert!((BK7.index(706.5188) - 1.512_89).abs() < 5e-6);
    }

    #[test]
    fn an_abbe_pair_gives_back_its_numbers_and_stays_near_the_glass() {
        let pair = IndexModel::Abbe(Abbe { nd: 1.5168, abbe: 64.17 });
        assert!((pair.index(LAMBDA_D) - 1.5168).abs() < 1e-12);
        assert!((pair.abbe_number() - 64.17).abs() < 1e-9);
        for lambda in [400.0, 450.0, 550.0, 700.0] {
            assert!((pair.index(lambda) - BK7.index(lambda)).abs() < 1e-3);
        }
    }

    #[test]
    fn without_dispersion_all_wavelengths_are_alike() {
        let flat = IndexModel::Abbe(Abbe { nd: 1.4, abbe: f64::INFINITY });
        assert_eq!(flat.index(400.0), 1.4);
        assert_eq!(IndexModel::Constant(1.333).index(700.0), 1.333);
        assert_eq!(IndexModel::Constant(1.333).abbe_number(), f64::INFINITY);
    }

    #[test]
    fn cauchy_sums_its_terms() {
        let cauchy = IndexModel::Cauchy(Cauchy { a: 1.3, b: 0.003, c: 0.0001 });
        assert!((cauchy.index(500.0) - (1.3 + 0.012 + 0.0016)).abs() < 1e-12);
    }

    #[test]
    fn a_resonance_in_the_visible_is_not_usable() {
        let bad = IndexModel::Sellmeier(Sellmeier { b: [1.0, 0.0, 0.0], c: [0.25, 0.0, 0.0] });
        assert!(!bad.is_usable());
        assert!(!IndexModel::Constant(f64::NAN).is_usable());
        assert!(!IndexModel::Constant(0.0).is_usable());
        assert!(!IndexModel::Cauchy(Cauchy { a: -2.0, b: 0.01, c: 0.0 }).is_usable());
    }
}
