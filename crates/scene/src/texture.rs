//! Colors that vary over a surface.

use crate::Rgb;
use serde::{Serialize, Serializer};
use std::sync::Arc;

/// A named texture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TextureDescription {
    /// Name that materials refer to.
    pub name: String,
    /// What it is.
    pub kind: TextureKind,
    /// (u, v) of the surface to (u, v) of the texture: rows of a 2 x 3 matrix.
    pub uv_transform: [[f32; 3]; 2],
    /// What lies beyond the edges of an image.
    pub wrap: Wrap,
    /// How an image is read between the centers of its pixels.
    pub filter: TextureFilter,
}

impl TextureDescription {
    /// A texture laid out as the surface's own coordinates are, repeated.
    pub fn new(name: impl Into<String>, kind: TextureKind) -> Self {
        Self {
            name: name.into(),
            kind,
            uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            wrap: Wrap::default(),
            filter: TextureFilter::default(),
        }
    }
}

/// What lies beyond the edges of an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image mirrored.
    Mirror,
    /// Its outermost pixels.
    Clamp,
}

/// How an image is read between the centers of its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum TextureFilter {
    /// Between the four nearest pixels.
    #[default]
    Bilinear,
    /// The nearest pixel.
    Nearest,
}

/// The kinds of texture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum TextureKind {
    /// An image, repeated, v up.
    Image(Arc<ImageData>),
    /// A checkerboard: one period is two squares along u and v.
    Checker {
        /// Color of the squares about (0.25, 0.25).
        even: Rgb,
        /// Color of the others.
        odd: Rgb,
    },
}

/// Pixels, linear Rec. 709, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageData {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width × height` colors.
    pub pixels: Vec<Rgb>,
}

/// Serializes as a digest of size and content.
impl Serialize for ImageData {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.width.to_le_bytes());
        hasher.update(&self.height.to_le_bytes());
        hasher.update(bytemuck::cast_slice(&self.pixels));
        hasher.finalize().as_bytes().serialize(serializer)
    }
}
