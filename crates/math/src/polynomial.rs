//! Real roots of polynomials of degree 2 to 4 in an interval, in `f64`.
//!
//! The quadratic has its closed form. Above it, the roots of the derivative cut the interval into pieces on which the
//! polynomial is monotone; a piece whose ends differ in sign holds one root, which Newton's method finds, guarded by
//! the bracket. Source: Yuksel, High-Performance Polynomial Root Finding for Graphics, HPG 2022.

use std::ops::Deref;

/// Up to four real roots in ascending order; reads as a slice.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Roots {
    values: [f64; 4],
    count: usize,
}

impl Roots {
    /// Appends a root; they come in ascending order, and never more than the degree.
    fn push(&mut self, x: f64) {
        debug_assert!(self.last().is_none_or(|&last| last <= x));
        if self.count < self.values.len() {
            self.values[self.count] = x;
            self.count += 1;
        }
    }
}

impl Deref for Roots {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

/// Real roots of `c[0] + c[1] x + c[2] x²` with `a ≤ x ≤ b`.
///
/// - `c`: finite coefficients, constant first; leading ones may be 0.
/// - `a`, `b`: the interval; may be infinite.
///
/// Returns ascending roots; a double root twice. None where every coefficient is 0.
/// Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §1.8; discriminant after Jeannerod,
/// Louvet & Muller, Further analysis of Kahan's algorithm, Math. Comp. 82, 2013.
pub fn quadratic_roots(c: [f64; 3], a: f64, b: f64) -> Roots {
    roots_in(&to_unit_scale(c), a, b)
}

/// Real roots of the cubic with coefficients `c`, constant first, with `a ≤ x ≤ b`; else as `quadratic_roots`.
///
/// A tangential touch inside the interval gives two roots or none, never one.
pub fn cubic_roots(c: [f64; 4], a: f64, b: f64) -> Roots {
    roots_in(&to_unit_scale(c), a, b)
}

/// Real roots of the quartic with coefficients `c`, constant first, with `a ≤ x ≤ b`; else as `quadratic_roots`.
///
/// A tangential touch inside the interval gives two roots or none, never one.
pub fn quartic_roots(c: [f64; 5], a: f64, b: f64) -> Roots {
    roots_in(&to_unit_scale(c), a, b)
}

/// The root of a monotone function between `a < b`, by Newton's method guarded by bisection.
///
/// - `f`: value and slope; the values at `a` and `b` differ in sign (0 counts as either).
/// - `tolerance`: step below which the search ends; 0 goes on to the last digit.
///
/// Returns a point of [a, b], whatever `f` does.
/// Source: Press et al., Numerical Recipes, 3rd ed., §9.4.
pub fn bracketed_root(f: impl Fn(f64) -> (f64, f64), a: f64, b: f64, tolerance: f64) -> f64 {
    let (mut low, mut high) = (a, b);
    let (at_a, at_b) = (f(a).0, f(b).0);
    let rising = at_a < at_b;
    let secant = a - at_a * ((b - a) / (at_b - at_a));
    let mut x = if secant > low && secant < high { secant } else { low + 0.5 * (high - low) };
    let mut last_step = high - low;
    // Newton's steps halve and bisection halves the bracket, so this ends long before; the bound guards against NaN.
    for _ in 0..4096 {
        let (value, slope) = f(x);
        if value == 0.0 {
            return x;
        }
        if (value < 0.0) == rising {
            low = x
        } else {
            high = x
        }
        let newton = x - value / slope;
        let step = (newton - x).abs();
        let is_newton_safe = newton >= low && newton <= high && step <= 0.5 * last_step;
        let next = if is_newton_safe { newton } else { low + 0.5 * (high - low) };
        last_step = if is_newton_safe { step } else { 0.5 * (high - low) };
        if next == x || last_step <= tolerance || (!is_newton_safe && (next <= low || next >= high)) {
            return next;
        }
        x = next;
    }
    x
}

/// Coefficients of the same roots, the largest about 1, so that no product overflows or underflows; exact.
fn to_unit_scale<const N: usize>(c: [f64; N]) -> [f64; N] {
    let largest = c.iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
    // The power of two below the largest coefficient: its exponent bits alone.
    let unit = f64::from_bits(largest.to_bits() & (0x7ff << 52));
    if unit.is_normal() { c.map(|c| c / unit) } else { c }
}

/// Roots in [a, b] for coefficients of any degree up to 4, constant first.
fn roots_in(c: &[f64], a: f64, b: f64) -> Roots {
    let degree = c.iter().rposition(|&c| c != 0.0).unwrap_or(0);
    let c = &c[..=degree];
    match degree {
        0 => Roots::default(),
        1 => linear(c[0], c[1], a, b),
        2 => quadratic(c[0], c[1], c[2], a, b),
        _ => by_derivative(c, a, b),
    }
}

fn linear(c0: f64, c1: f64, a: f64, b: f64) -> Roots {
    let mut roots = Roots::default();
    let x = -c0 / c1;
    if x.is_finite() && a <= x && x <= b {
        roots.push(x);
    }
    roots
}

fn quadratic(c0: f64, c1: f64, c2: f64, a: f64, b: f64) -> Roots {
    let mut roots = Roots::default();
    let half = 0.5 * c1;
    let discriminant = difference_of_products(half, half, c0, c2);
    if discriminant >= 0.0 {
        // The sum of equal signs, so that nothing cancels.
        let q = -(half + discriminant.sqrt().copysign(half));
        let (x, y) = if q == 0.0 { (0.0, 0.0) } else { (q / c2, c0 / q) };
        for x in [x.min(y), x.max(y)] {
            if x.is_finite() && a <= x && x <= b {
                roots.push(x);
            }
        }
    }
    roots
}

/// `a b - c d` to within 1.5 units in the last place.
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let cd = c * d;
    a.mul_add(b, -cd) - c.mul_add(d, -cd)
}

fn by_derivative(c: &[f64], a: f64, b: f64) -> Roots {
    let mut roots = Roots::default();
    let bound = cauchy_bound(c);
    let (a, b) = (a.max(-bound), b.min(bound));
    if a.partial_cmp(&b).is_none_or(std::cmp::Ordering::is_gt) {
        return roots;
    }
    let (slope, degree) = derivative(c);
    let mut knots = [a; 5];
    let mut count = 1;
    for &x in roots_in(&slope[..degree], a, b).iter() {
        knots[count] = x;
        count += 1;
    }
    knots[count] = b;
    let knots = &knots[..=count];
    let f = |x: f64| horner(c, x);
    for (i, pair) in knots.windows(2).enumerate() {
        let (low, high) = (f(pair[0]).0, f(pair[1]).0);
        // A value of 0 counts as positive within the interval, so that both pieces about a touch agree; at the
        // interval's ends it is a root in any case.
        let at_start = i == 0 && low == 0.0 && high != 0.0;
        let at_end = i + 2 == knots.len() && high == 0.0 && low != 0.0;
        if at_start || at_end {
            roots.push(if at_start { pair[0] } else { pair[1] });
        } else if (low < 0.0) != (high < 0.0) {
            roots.push(bracketed_root(f, pair[0], pair[1], 0.0));
        }
    }
    roots
}

/// No root is larger. Source: Cauchy, Exercices de mathématiques 4, 1829.
fn cauchy_bound(c: &[f64]) -> f64 {
    let leading = c[c.len() - 1].abs();
    let largest = c[..c.len() - 1].iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
    (1.0 + largest / leading).min(f64::MAX)
}

/// Coefficients of the derivative, and their number.
fn derivative(c: &[f64]) -> ([f64; 4], usize) {
    let mut slope = [0.0; 4];
    for (i, &c) in c.iter().enumerate().skip(1) {
        slope[i - 1] = i as f64 * c;
    }
    (slope, c.len() - 1)
}

/// Value and slope.
fn horner(c: &[f64], x: f64) -> (f64, f64) {
    c.iter().rev().fold((0.0, 0.0), |(value, slope), &c| (value * x + c, slope * x + value))
}

#[cfg(test)]
mod tests;
