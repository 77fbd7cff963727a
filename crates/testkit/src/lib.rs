//! Statistics for tests: chi-square, Welch's t, quadrature, on plain f64.
//!
//! Nothing here reaches a picture, so the functions may differ in the last bit between machines, and misuse
//! panics: a test that cannot decide must not pass.

pub mod chi_square;
pub mod moments;
pub mod quadrature;
pub mod random;
pub mod significance;
pub mod special;

pub use chi_square::{ChiSquare, chi_square, chi_square_sphere, chi_square_square};
pub use moments::Moments;
pub use quadrature::{integrate, integrate_rectangle, integrate_sphere};
pub use random::Random;
pub use significance::{sidak, welch_t, z_test};
