//! Exact sums of passes, merging, developing, image files and image comparison.
//!
//! A `Film` adds numbered passes in fixed point, so that any partition of the passes, merged in any order, is the same
//! film byte for byte. `develop` makes an `Image` of it, `image_file` writes that, `compare` measures it.

mod atomic;
pub mod compare;
mod convolution;
mod decode;
pub mod develop;
pub mod difference;
mod encode;
mod error;
mod error_estimate;
mod film;
mod fixed;
pub mod flip;
mod header;
mod image;
pub mod image_file;
mod pass_set;
mod rect;
mod sample;
mod shared_noise;
mod sums;
pub mod tile_test;

pub use atomic::write_atomically;
pub use compare::{Comparison, SizeMismatch, compare};
pub use develop::{develop, standard_error, variance_of_mean};
pub use difference::difference_image;
pub use error::FilmError;
pub use error_estimate::error_estimate;
pub use film::Film;
pub use header::{DigestPart, FilmHeader};
pub use image::{Channel, Image, Samples};
pub use image_file::{ImageError, ImageFormat, read_image, write_image};
pub use pass_set::PassSet;
pub use rect::Rect;
pub use sample::PixelSample;
pub use shared_noise::with_shared_noise;
pub use tile_test::{TileFailure, TileTest, tile_test};
