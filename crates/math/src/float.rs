//! Elementary functions that give the same bits on every machine, and rounding-error bounds.
//!
//! The system's libm picks FMA variants by processor; these are pure Rust, so a picture does not depend on
//! where it was rendered.

/// Sine of an angle in radians.
pub fn sin(x: f32) -> f32 {
    libm::sinf(x)
}

/// Cosine of an angle in radians.
pub fn cos(x: f32) -> f32 {
    libm::cosf(x)
}

/// Sine and cosine of an angle in radians.
pub fn sin_cos(x: f32) -> (f32, f32) {
    libm::sincosf(x)
}

/// Tangent of an angle in radians.
pub fn tan(x: f32) -> f32 {
    libm::tanf(x)
}

/// Arc sine in radians; the argument is clamped to -1…1.
pub fn asin(x: f32) -> f32 {
    libm::asinf(x.clamp(-1.0, 1.0))
}

/// Arc cosine in radians; the argument is clamped to -1…1.
pub fn acos(x: f32) -> f32 {
    libm::acosf(x.clamp(-1.0, 1.0))
}

/// Arc tangent in radians.
pub fn atan(x: f32) -> f32 {
    libm::atanf(x)
}

/// Angle of the point (x, y) in radians, -π…π.
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// e to the power x.
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// Natural logarithm.
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// `base` to the power `exponent`.
pub fn powf(base: f32, exponent: f32) -> f32 {
    libm::powf(base, exponent)
}

/// The same functions in `f64`, for shape solvers and compilation.
pub mod f64 {
    /// Sine of an angle in radians.
    pub fn sin(x: f64) -> f64 {
        libm::sin(x)
    }

    /// Cosine of an angle in radians.
    pub fn cos(x: f64) -> f64 {
        libm::cos(x)
    }

    /// Sine and cosine of an angle in radians.
    pub fn sin_cos(x: f64) -> (f64, f64) {
        libm::sincos(x)
    }

    /// Tangent of an angle in radians.
    pub fn tan(x: f64) -> f64 {
        libm::tan(x)
    }

    /// Arc sine in radians; the argument is clamped to -1…1.
    pub fn asin(x: f64) -> f64 {
        libm::asin(x.clamp(-1.0, 1.0))
    }

    /// Arc cosine in radians; the argument is clamped to -1…1.
    pub fn acos(x: f64) -> f64 {
        libm::acos(x.clamp(-1.0, 1.0))
    }

    /// Angle of the point (x, y) in radians, -π…π.
    pub fn atan2(y: f64, x: f64) -> f64 {
        libm::atan2(y, x)
    }

    /// e to the power x.
    pub fn exp(x: f64) -> f64 {
        libm::exp(x)
    }

    /// Natural logarithm.
    pub fn ln(x: f64) -> f64 {
        libm::log(x)
    }

    /// `base` to the power `exponent`.
    pub fn powf(base: f64, exponent: f64) -> f64 {
        libm::pow(base, exponent)
    }

    /// Cube root.
    pub fn cbrt(x: f64) -> f64 {
        libm::cbrt(x)
    }
}

/// Largest float below 1: random numbers in [0, 1) never exceed it.
pub const ONE_MINUS_EPSILON: f32 = 1.0 - f32::EPSILON / 2.0;

/// Bound on the relative error of `n` rounded `f32` operations in a row.
///
/// Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., lemma 3.1.
pub const fn gamma(n: u32) -> f32 {
    const UNIT_ROUNDOFF: f32 = f32::EPSILON / 2.0;
    (n as f32 * UNIT_ROUNDOFF) / (1.0 - n as f32 * UNIT_ROUNDOFF)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elementary_functions_agree_with_the_standard_library() {
        #[allow(clippy::disallowed_methods, reason = "the comparison is the point")]
        for i in -100..100 {
            let x = i as f32 * 0.173;
            assert!((sin(x) - x.sin()).abs() < 1e-6);
            assert!((exp(x * 0.1) - (x * 0.1).exp()).abs() < 1e-5);
            assert!((atan2(x, 1.5) - x.atan2(1.5)).abs() < 1e-6);
        }
    }

    #[test]
    fn arc_cosine_survives_rounding_past_one() {
        assert_eq!(acos(1.000_000_1), 0.0);
        assert!(f64::asin(1.0 + 1e-15).is_finite());
    }
}
