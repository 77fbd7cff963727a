//! Colors that vary over a surface.

use hyaline_math::Vec2;
use hyaline_scene::{ImageData, TextureDescription, TextureFilter, TextureKind, Wrap};
use hyaline_spectrum::color::luminance;
use std::sync::Arc;

/// Step of differences where a texture has no pixels, in its own coordinates.
const STEP_WITHOUT_PIXELS: f32 = 1e-3;

/// A texture, ready to be looked up.
#[derive(Clone, Debug)]
pub struct Texture {
    kind: TextureKind,
    uv_transform: [[f32; 3]; 2],
    wrap: Wrap,
    filter: TextureFilter,
}

impl Texture {
    /// Takes a description over.
    pub fn new(description: &TextureDescription) -> Self {
        Self {
            kind: description.kind.clone(),
            uv_transform: description.uv_transform,
            wrap: description.wrap,
            filter: description.filter,
        }
    }

    /// Color at surface coordinates `uv`, linear Rec. 709.
    pub fn color(&self, uv: Vec2) -> [f32; 3] {
        self.color_at(self.own_coordinates(uv))
    }

    /// Luminance at surface coordinates `uv`.
    pub fn scalar(&self, uv: Vec2) -> f32 {
        luminance(self.color(uv))
    }

    /// Derivatives of the luminance by the surface coordinates, as differences over a pixel: those of a surface
    /// through the pixels that has no edges along them.
    pub fn gradient(&self, uv: Vec2) -> Vec2 {
        let (st, step) = (self.own_coordinates(uv), self.pixel());
        let slope = |axis: Vec2| {
            let half = axis * step * 0.5;
            let difference = luminance(self.color_at(st + half)) - luminance(self.color_at(st - half));
            difference / step.dot(axis)
        };
        let (by_s, by_t) = (slope(Vec2::X), slope(Vec2::Y));
        let [a, b] = self.uv_transform;
        Vec2::new(by_s * a[0] + by_t * b[0], by_s * a[1] + by_t * b[1])
    }

    /// The image, where the texture is one.
    pub fn image(&self) -> Option<&Arc<ImageData>> {
        match &self.kind {
            TextureKind::Image(image) => Some(image),
            TextureKind::Checker { .. } => None,
        }
    }

    /// Size of a pixel in the texture's coordinates.
    fn pixel(&self) -> Vec2 {
        match &self.kind {
            TextureKind::Image(image) => 1.0 / Vec2::new(image.width as f32, image.height as f32),
            TextureKind::Checker { .. } => Vec2::splat(STEP_WITHOUT_PIXELS),
        }
    }

    fn own_coordinates(&self, uv: Vec2) -> Vec2 {
        let [a, b] = self.uv_transform;
        Vec2::new(a[0] * uv.x + a[1] * uv.y + a[2], b[0] * uv.x + b[1] * uv.y + b[2])
    }

    fn color_at(&self, st: Vec2) -> [f32; 3] {
        match &self.kind {
            TextureKind::Image(image) => match self.filter {
                TextureFilter::Bilinear => bilinear(image, st, self.wrap),
                TextureFilter::Nearest => nearest(image, st, self.wrap),
            },
            TextureKind::Checker { even, odd } => checker(st, *even, *odd),
        }
    }
}

/// Two squares a period along each axis.
fn checker(uv: Vec2, even: [f32; 3], odd: [f32; 3]) -> [f32; 3] {
    let is_first_half = |x: f32| x - x.floor() < 0.5;
    if is_first_half(uv.x) == is_first_half(uv.y) { even } else { odd }
}

/// Where a coordinate falls within the image, 0…1.
fn wrapped(x: f32, wrap: Wrap) -> f32 {
    match wrap {
        Wrap::Repeat => x - x.floor(),
        Wrap::Mirror => 1.0 - (x - 2.0 * (0.5 * x).floor() - 1.0).abs(),
        Wrap::Clamp => x.clamp(0.0, 1.0),
    }
}

/// The pixel at an index up to one outside of 0…`count` - 1. A mirrored image goes on with its outermost pixel.
fn wrapped_index(i: i64, count: i64, wrap: Wrap) -> usize {
    match wrap {
        Wrap::Repeat => i.rem_euclid(count) as usize,
        Wrap::Mirror | Wrap::Clamp => i.clamp(0, count - 1) as usize,
    }
}

/// Column and row, fractions of pixels from the upper left corner; v points up, rows go down.
fn in_pixels(image: &ImageData, uv: Vec2, wrap: Wrap) -> (f32, f32) {
    let (u, v) = (wrapped(uv.x, wrap), wrapped(uv.y, wrap));
    (u * image.width as f32, (1.0 - v) * image.height as f32)
}

fn pixel(image: &ImageData, column: i64, row: i64, wrap: Wrap) -> [f32; 3] {
    let column = wrapped_index(column, image.width.into(), wrap);
    let row = wrapped_index(row, image.height.into(), wrap);
    image.pixels[row * image.width as usize + column]
}

fn nearest(image: &ImageData, uv: Vec2, wrap: Wrap) -> [f32; 3] {
    let (x, y) = in_pixels(image, uv, wrap);
    pixel(image, x.floor() as i64, y.floor() as i64, wrap)
}

fn bilinear(image: &ImageData, uv: Vec2, wrap: Wrap) -> [f32; 3] {
    let (x, y) = in_pixels(image, uv, wrap);
    let (x, y) = (x - 0.5, y - 0.5);
    let (x0, y0) = (x.floor(), y.floor());
    let (fx, fy) = (x - x0, y - y0);
    let at = |dx: i64, dy: i64| pixel(image, x0 as i64 + dx, y0 as i64 + dy, wrap);
    let (a, b, c, d) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1));
    std::array::from_fn(|i| {
        let upper = a[i] + (b[i] - a[i]) * fx;
        let lower = c[i] + (d[i] - c[i]) * fx;
        upper + (lower - upper) * fy
    })
}

#[cfg(test)]
mod tests;
