//! A picture in memory: linear colors of a window of a frame, and further named channels.

use crate::rect::Rect;

/// A picture of linear Rec. 709 radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Width of the full frame, pixels.
    pub width: u32,
    /// Height of the full frame, pixels.
    pub height: u32,
    /// The part of the frame that the picture holds: the crop.
    pub window: Rect,
    /// Colors, row by row over the window; `[window.area()]`.
    pub rgb: Vec<[f32; 3]>,
    /// Further channels of the same window.
    pub channels: Vec<Channel>,
    /// Named texts about the picture: version, digest, seed, passes, command.
    pub metadata: Vec<(String, String)>,
}

/// One number per pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Layer and component, as in `albedo.R`.
    pub name: String,
    /// The numbers, row by row over the window.
    pub samples: Samples,
}

/// The numbers of a channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Quantities.
    F32(Vec<f32>),
    /// Identities.
    U32(Vec<u32>),
}

impl Image {
    /// A picture of a whole frame.
    ///
    /// - `rgb`: row by row; missing pixels are black, excess ones are left out.
    pub fn new(width: u32, height: u32, mut rgb: Vec<[f32; 3]>) -> Self {
        let window = Rect { x0: 0, y0: 0, x1: width, y1: height };
        rgb.resize(window.area(), [0.0; 3]);
        Self { width, height, window, rgb, channels: Vec::new(), metadata: Vec::new() }
    }

    /// A picture of the same window without further channels and texts.
    pub fn with_rgb(&self, rgb: Vec<[f32; 3]>) -> Self {
        let Self { width, height, window, .. } = *self;
        Self { width, height, window, rgb, channels: Vec::new(), metadata: Vec::new() }
    }
}
