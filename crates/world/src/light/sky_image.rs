//! A latitude-longitude image of the sky, read with bilinear interpolation.
//!
//! Pixel centers hold the image's values; between them it is interpolated, across the seam too, and beyond the first
//! and last row it is constant. A *cell* is the square of a pixel: the light of a cell is the exact integral of the
//! interpolated image over its solid angle, so a cell that shines anywhere has a weight, and the sum is the energy.

use hyaline_math::{Vec2, Vec3, float, float::f64 as float64};
use hyaline_spectrum::Spectrum;
use std::f64::consts::{PI, TAU};

/// Radiance of the sky by direction: y is up, -z is the image's center, +x to its right, the first row on top.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyImage {
    width: u32,
    height: u32,
    pixels: Vec<Spectrum>,
}

impl SkyImage {
    /// An image of `width × height` radiances, rows from the top.
    ///
    /// Lanes that are negative or not finite are taken as 0. Returns `None` where the image is empty or the number of
    /// pixels is not its size.
    pub fn new(width: u32, height: u32, mut pixels: Vec<Spectrum>) -> Option<Self> {
        let size = width as usize * height as usize;
        if size == 0 || pixels.len() != size {
            return None;
        }
        for pixel in &mut pixels {
            *pixel = pixel.map(|x| if x > 0.0 && x.is_finite() { x } else { 0.0 });
        }
        Some(Self { width, height, pixels })
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Interpolated radiance.
    ///
    /// - `direction`: unit, image space.
    pub fn radiance(&self, direction: Vec3) -> Spectrum {
        let q = self.position_of(direction) - Vec2::splat(0.5);
        let base = q.floor();
        let f = q - base;
        let (x, y) = (base.x as i64, base.y as i64);
        let row = |y: i64| self.pixel(x, y) * (1.0 - f.x) + self.pixel(x + 1, y) * f.x;
        row(y) * (1.0 - f.y) + row(y + 1) * f.y
    }

    /// Pixel coordinates of a direction, from the top left corner: 0…width, 0…height.
    pub(super) fn position_of(&self, direction: Vec3) -> Vec2 {
        const INV_PI: f32 = std::f32::consts::FRAC_1_PI;
        let longitude = float::atan2(direction.x, -direction.z);
        // Unlike the arc cosine, atan2 is precise at the zenith.
        let polar_angle =
            float::atan2((direction.x * direction.x + direction.z * direction.z).sqrt(), direction.y);
        let uv = Vec2::new(0.5 + 0.5 * INV_PI * longitude, INV_PI * polar_angle);
        uv * Vec2::new(self.width as f32, self.height as f32)
    }

    /// The direction at a place in a cell.
    ///
    /// - `inside`: 0…1; equal areas are equal solid angles.
    pub(super) fn direction_in_cell(&self, cell: [u32; 2], inside: Vec2) -> Vec3 {
        let column = f64::from(cell[0]) + f64::from(inside.x);
        let [top, bottom] = self.cosines_of_row(cell[1]);
        let y = top + (bottom - top) * f64::from(inside.y);
        let r = ((1.0 - y) * (1.0 + y)).max(0.0).sqrt();
        let (sin, cos) = float64::sin_cos((column / f64::from(self.width) - 0.5) * TAU);
        Vec3::new((r * sin) as f32, y as f32, (-r * cos) as f32).normalize()
    }

    /// Solid angle of each cell of a row, sr.
    pub(super) fn solid_angle_of_cell(&self, row: u32) -> f64 {
        let [top, bottom] = self.cosines_of_row(row);
        TAU / f64::from(self.width) * (top - bottom)
    }

    /// Calls `visit` with the light of each cell, W m⁻², cells in the order of the pixels.
    pub(super) fn for_each_cell(&self, mut visit: impl FnMut([f64; 4])) {
        let column_angle = TAU / f64::from(self.width);
        for row in 0..self.height {
            let weights = self.row_weights(row);
            for column in 0..self.width {
                let mut light = [0.0; 4];
                for (dy, row_weight) in [-1, 0, 1].into_iter().zip(weights) {
                    // Mean of the interpolated values over the width of a pixel.
                    for (dx, column_weight) in [(-1, 0.125), (0, 0.75), (1, 0.125)] {
                        let pixel = self.pixel(i64::from(column) + dx, i64::from(row) + dy).to_lanes();
                        let weight = row_weight * column_weight * column_angle;
                        light = std::array::from_fn(|lane| light[lane] + weight * f64::from(pixel[lane]));
                    }
                }
                visit(light);
            }
        }
    }

    /// Integrals over a row's polar angles of the shares that the row above, the row, and the row below have in the
    /// interpolated value, times the sine.
    fn row_weights(&self, row: u32) -> [f64; 3] {
        let step = PI / f64::from(self.height);
        let top = f64::from(row) * step;
        let (middle, bottom) = (top + 0.5 * step, top + step);
        let sin_middle = float64::sin(middle);
        // ∫ (middle - θ) sin θ dθ = -(middle - θ) cos θ - sin θ, from top to middle; mirrored for the row below.
        let above = 0.5 * float64::cos(top) + (float64::sin(top) - sin_middle) / step;
        let below = -0.5 * float64::cos(bottom) + (float64::sin(bottom) - sin_middle) / step;
        let whole = float64::cos(top) - float64::cos(bottom);
        [above, whole - above - below, below]
    }

    /// Cosines of the polar angle at the upper and the lower edge of a row.
    fn cosines_of_row(&self, row: u32) -> [f64; 2] {
        let cosine = |edge: u32| float64::cos(f64::from(edge) / f64::from(self.height) * PI);
        [cosine(row), cosine(row + 1)]
    }

    /// A pixel; columns repeat, rows do not.
    fn pixel(&self, x: i64, y: i64) -> Spectrum {
        let column = x.rem_euclid(i64::from(self.width)) as usize;
        let row = y.clamp(0, i64::from(self.height) - 1) as usize;
        self.pixels[row * self.width as usize + column]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{Random, integrate_rectangle};

    fn random_sky(width: u32, height: u32) -> SkyImage {
        let mut random = Random::from_seed(5);
        let pixels = (0..width * height).map(|_| Spectrum::splat(random.uniform_f32())).collect();
        SkyImage::new(width, height, pixels).unwrap()
    }

    fn direction(longitude: f64, polar_angle: f64) -> Vec3 {
        let (sin, cos) = float64::sin_cos(polar_angle);
        let (sin_longitude, cos_longitude) = float64::sin_cos(longitude);
        Vec3::new((sin * sin_longitude) as f32, cos as f32, (-sin * cos_longitude) as f32)
    }

    #[test]
    fn the_image_s_center_is_minus_z_its_right_is_x_and_its_top_is_y() {
        let sky = random_sky(8, 4);
        assert!((sky.position_of(-Vec3::Z) - Vec2::new(4.0, 2.0)).length() < 1e-5);
        assert!((sky.position_of(Vec3::X) - Vec2::new(6.0, 2.0)).length() < 1e-5);
        assert!((sky.position_of(-Vec3::X) - Vec2::new(2.0, 2.0)).length() < 1e-5);
        assert!(sky.position_of(Vec3::Y).y < 1e-5);
        assert!((sky.position_of(-Vec3::Y).y - 4.0).abs() < 1e-5);
    }

    #[test]
    fn pixel_centers_have_the_pixel_s_value() {
        let sky = random_sky(6, 5);
        for (x, y) in [(0, 0), (5, 0), (3, 2), (0, 4), (5, 4)] {
            let longitude = ((f64::from(x) + 0.5) / 6.0 - 0.5) * TAU;
            let found = sky.radiance(direction(longitude, (f64::from(y) + 0.5) / 5.0 * PI));
            assert!((found[0] - sky.pixels[y as usize * 6 + x as usize][0]).abs() < 1e-5);
        }
    }

    #[test]
    fn directions_in_cells_are_where_the_cell_is() {
        let sky = random_sky(6, 5);
        for cell in [[0, 0], [5, 0], [2, 3], [5, 4]] {
            let q = sky.position_of(sky.direction_in_cell(cell, Vec2::new(0.25, 0.5)));
            assert!((q.x - cell[0] as f32 - 0.25).abs() < 1e-4);
            assert_eq!(q.y.floor() as u32, cell[1]);
        }
    }

    #[test]
    fn the_light_of_the_cells_is_the_integral_of_the_interpolated_image() {
        for (width, height) in [(1, 1), (2, 1), (5, 3), (16, 8)] {
            let sky = random_sky(width, height);
            let mut cells = Vec::new();
            sky.for_each_cell(|light| cells.push(light[0]));
            let edge = |i: u32, n: u32| f64::from(i) / f64::from(n);
            for (i, cell) in cells.iter().enumerate() {
                let (x, y) = (i as u32 % width, i as u32 / width);
                let u = [edge(x, width), edge(x + 1, width)];
                let v = [edge(y, height), edge(y + 1, height)];
                // Two panels, so that the kink at the pixel's center falls between them.
                let f = |u: f64, v: f64| {
                    let radiance = sky.radiance(direction((u - 0.5) * TAU, v * PI))[0];
                    f64::from(radiance) * float64::sin(v * PI) * TAU * PI
                };
                let expected = integrate_rectangle(f, u, v, 2, 2);
                assert!(
                    (cell - expected).abs() < 1e-5 * (1.0 + expected),
                    "{width}×{height} cell {i}: {cell} {expected}"
                );
            }
        }
    }

    #[test]
    fn bad_images_are_refused_and_bad_pixels_are_black() {
        assert!(SkyImage::new(0, 3, Vec::new()).is_none());
        assert!(SkyImage::new(2, 2, vec![Spectrum::ONE; 3]).is_none());
        let lanes = [f32::NAN, -1.0, f32::INFINITY, 2.0];
        let sky = SkyImage::new(1, 1, vec![Spectrum::from_lanes(lanes)]).unwrap();
        assert_eq!(sky.radiance(Vec3::Y).to_lanes(), [0.0, 0.0, 0.0, 2.0]);
    }
}
