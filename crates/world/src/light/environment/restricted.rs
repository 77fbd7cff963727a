//! Directions to some parts of the sky: a choice by the sky's light, times a factor for each block of the sky.
//!
//! A constant sky is cut into blocks of equal solid angle, an image into blocks of whole pixels, so that the choice
//! among an image's pixels keeps their importance.

use super::{EnvironmentLight, ImageSky, Sky, mean};
use crate::light::{Cone, UnitBox};
use hyaline_math::{DVec2, Frame, Vec2, Vec3};
use hyaline_sampling::{Distribution2d, warp};
use hyaline_spectrum::Spectrum;
use std::f64::consts::{PI, TAU};

/// A direction to the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyDirection {
    /// Unit, the way one looks; light travels the other way.
    pub from: Vec3,
    /// Density, sr⁻¹.
    pub pdf_w: f32,
    /// The block it lies in: row × columns + column.
    pub block: usize,
}

/// A choice of directions to the sky that favors some of its blocks: see `EnvironmentLight::restricted`.
#[derive(Clone, Debug, PartialEq)]
pub struct RestrictedSky {
    /// Over the pixels of an image, over the blocks of a constant sky.
    cells: Distribution2d,
    blocks: [u32; 2],
    memory: usize,
    /// Share of the sky's light, each block times its factor.
    pub kept: f64,
}

impl RestrictedSky {
    /// Memory, bytes.
    pub fn memory(&self) -> usize {
        self.memory
    }
}

impl EnvironmentLight {
    /// Columns and rows of the blocks that the sky is cut into when each axis is to have about `count` of them; an
    /// image has no more than pixels.
    pub fn blocks(&self, count: u32) -> [u32; 2] {
        match &self.sky {
            Sky::Constant(_) => [count.max(1); 2],
            Sky::Image(sky) => [sky.image.width(), sky.image.height()].map(|size| count.clamp(1, size)),
        }
    }

    /// About the directions to a block, given by its column and row.
    pub fn cone_of_block(&self, blocks: [u32; 2], block: [u32; 2]) -> Cone {
        match &self.sky {
            Sky::Constant(_) => {
                let size = DVec2::new(f64::from(blocks[0]), f64::from(blocks[1]));
                let min = DVec2::new(f64::from(block[0]), f64::from(block[1]));
                let unit_box = UnitBox { min: min / size, max: (min + 1.0) / size };
                let world = Frame { s: Vec3::X, t: Vec3::Y, n: Vec3::Z };
                Cone::about_turned(&world, [2.0 * unit_box.min.x, 2.0 * unit_box.max.x], &unit_box)
            }
            Sky::Image(sky) => sky.cone_of_block(blocks, block),
        }
    }

    /// The choice of directions by the sky's light, times a factor for each block; `None` where nothing is left.
    ///
    /// - `blocks`: columns and rows, as `blocks` gave them.
    /// - `factors`: row by row, each ≥ 0.
    pub fn restricted(&self, blocks: [u32; 2], factors: &[f32]) -> Option<RestrictedSky> {
        let (width, weights) = match &self.sky {
            Sky::Constant(_) => (blocks[0] as usize, vec![1.0; factors.len()]),
            Sky::Image(sky) => (sky.image.width() as usize, sky.weights()),
        };
        let block_of = |i: usize| match &self.sky {
            Sky::Constant(_) => i,
            Sky::Image(sky) => sky.block_of_pixel(blocks, [(i % width) as u32, (i / width) as u32]),
        };
        let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        let weights: Vec<f32> =
            weights.iter().enumerate().map(|(i, weight)| weight * factors[block_of(i)]).collect();
        let kept = weights.iter().map(|&weight| f64::from(weight)).sum::<f64>() / total;
        let cells = Distribution2d::new(width, &weights).ok()?;
        // A step count for each cell.
        let memory = size_of_val(&weights[..]);
        Some(RestrictedSky { cells, blocks, memory, kept })
    }

    /// Chooses a direction from a restricted choice among this sky's.
    ///
    /// - `u`: two uniform random numbers in [0, 1).
    pub fn sample_restricted(&self, sky: &RestrictedSky, u: Vec2) -> SkyDirection {
        let pick = sky.cells.sample(u);
        match &self.sky {
            Sky::Constant(_) => SkyDirection {
                from: warp::sample_sphere(pick.uv),
                pdf_w: pick.pdf * warp::pdf_sphere(),
                block: pick.y * sky.blocks[0] as usize + pick.x,
            },
            Sky::Image(image) => {
                let (from, pdf_w) = image.direction_of(&pick);
                let block = image.block_of_pixel(sky.blocks, [pick.x as u32, pick.y as u32]);
                SkyDirection { from, pdf_w, block }
            }
        }
    }

    /// Chooses a direction to the sky by its light alone; `None` where the sky is black.
    ///
    /// - `u`: two uniform random numbers in [0, 1).
    pub fn sample_unrestricted(&self, u: Vec2) -> Option<SkyDirection> {
        self.sample_direction(u).map(|(from, pdf_w)| SkyDirection { from, pdf_w, block: 0 })
    }

    /// The radiance of a sampled direction over its density, W m⁻²: flux per area that light crosses.
    pub fn irradiance_of(&self, direction: &SkyDirection) -> Spectrum {
        self.radiance(direction.from) / direction.pdf_w
    }
}

impl ImageSky {
    /// The light of each pixel's cell, mean over the lanes that count.
    fn weights(&self) -> Vec<f32> {
        let mut weights = Vec::with_capacity(self.image.width() as usize * self.image.height() as usize);
        self.image.for_each_cell(|light| weights.push(mean(light, self.lanes)));
        weights
    }

    fn block_of_pixel(&self, blocks: [u32; 2], pixel: [u32; 2]) -> usize {
        let along = |axis: usize, size: u32| {
            (u64::from(pixel[axis]) * u64::from(blocks[axis]) / u64::from(size)) as usize
        };
        along(1, self.image.height()) * blocks[0] as usize + along(0, self.image.width())
    }

    fn cone_of_block(&self, blocks: [u32; 2], block: [u32; 2]) -> Cone {
        // The first pixel of a block, and the first of the next, as a fraction of the axis.
        let edges = |axis: usize, size: u32| {
            let first = |block: u32| (u64::from(block) * u64::from(size)).div_ceil(u64::from(blocks[axis]));
            [block[axis], block[axis] + 1].map(|block| first(block) as f64 / f64::from(size))
        };
        let phi = edges(0, self.image.width()).map(|x| (x - 0.5) * TAU);
        let theta = edges(1, self.image.height()).map(|y| y * PI);
        // Directions are -z cos φ + x sin φ about the pole y.
        let to_world = self.to_image.transpose();
        let frame = Frame { s: to_world * -Vec3::Z, t: to_world * Vec3::X, n: to_world * Vec3::Y };
        Cone::about_patch(&frame, theta, phi)
    }
}
