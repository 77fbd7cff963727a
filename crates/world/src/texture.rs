//! Colors that vary over a surface.

use hyaline_math::Vec2;
use hyaline_scene::{ImageData, TextureDescription, TextureKind};
use std::sync::Arc;

/// A texture, ready to be looked up.
#[derive(Clone, Debug)]
pub struct Texture {
    kind: TextureKind,
    uv_transform: [[f32; 3]; 2],
}

impl Texture {
    /// Takes a description over.
    pub fn new(description: &TextureDescription) -> Self {
        Self { kind: description.kind.clone(), uv_transform: description.uv_transform }
    }

    /// Color at surface coordinates `uv`, linear Rec. 709.
    pub fn color(&self, uv: Vec2) -> [f32; 3] {
        let [a, b] = self.uv_transform;
        let uv = Vec2::new(a[0] * uv.x + a[1] * uv.y + a[2], b[0] * uv.x + b[1] * uv.y + b[2]);
        match &self.kind {
            TextureKind::Image(image) => bilinear(image, uv),
            TextureKind::Checker { even, odd } => checker(uv, *even, *odd),
        }
    }

    /// Luminance at surface coordinates `uv`.
    pub fn scalar(&self, uv: Vec2) -> f32 {
        hyaline_spectrum::color::luminance(self.color(uv))
    }

    /// The image, where the texture is one.
    pub fn image(&self) -> Option<&Arc<ImageData>> {
        match &self.kind {
            TextureKind::Image(image) => Some(image),
            TextureKind::Checker { .. } => None,
        }
    }
}

/// Two squares a period along each axis.
fn checker(uv: Vec2, even: [f32; 3], odd: [f32; 3]) -> [f32; 3] {
    let is_first_half = |x: f32| x - x.floor() < 0.5;
    if is_first_half(uv.x) == is_first_half(uv.y) { even } else { odd }
}

/// Bilinear look-up with repetition; v points up, rows go down.
fn bilinear(image: &ImageData, uv: Vec2) -> [f32; 3] {
    let (width, height) = (image.width as i64, image.height as i64);
    let x = (uv.x - uv.x.floor()) * width as f32 - 0.5;
    let y = (1.0 - (uv.y - uv.y.floor())) * height as f32 - 0.5;
    let (x0, y0) = (x.floor(), y.floor());
    let (fx, fy) = (x - x0, y - y0);
    let pixel = |dx: i64, dy: i64| {
        let column = (x0 as i64 + dx).rem_euclid(width) as usize;
        let row = (y0 as i64 + dy).rem_euclid(height) as usize;
        image.pixels[row * width as usize + column]
    };
    let (a, b, c, d) = (pixel(0, 0), pixel(1, 0), pixel(0, 1), pixel(1, 1));
    std::array::from_fn(|i| {
        let upper = a[i] + (b[i] - a[i]) * fx;
        let lower = c[i] + (d[i] - c[i]) * fx;
        upper + (lower - upper) * fy
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(kind: TextureKind) -> Texture {
        Texture::new(&TextureDescription::new("t", kind))
    }

    #[test]
    fn a_checker_alternates_along_both_axes() {
        let t = texture(TextureKind::Checker { even: [1.0; 3], odd: [0.0; 3] });
        assert_eq!(t.color(Vec2::new(0.25, 0.25)), [1.0; 3]);
        assert_eq!(t.color(Vec2::new(0.75, 0.25)), [0.0; 3]);
        assert_eq!(t.color(Vec2::new(0.75, -0.25)), [1.0; 3]);
    }

    #[test]
    fn the_first_row_of_an_image_is_at_the_top() {
        let pixels = vec![[1.0; 3], [1.0; 3], [0.0; 3], [0.0; 3]];
        let t = texture(TextureKind::Image(Arc::new(ImageData { width: 2, height: 2, pixels })));
        assert_eq!(t.color(Vec2::new(0.5, 0.75)), [1.0; 3]);
        assert_eq!(t.color(Vec2::new(0.5, 0.25)), [0.0; 3]);
        assert_eq!(t.color(Vec2::new(0.1, 0.5)), [0.5; 3]);
    }
}
