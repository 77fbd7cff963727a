//! What one pass says of one pixel.

/// One sample of one pixel: the radiance, and what the first surface looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelSample {
    /// Radiance, linear Rec. 709.
    pub beauty: [f32; 3],
    /// Reflectance of the first surface, 0…1; 0 where nothing was hit.
    pub albedo: [f32; 3],
    /// Shading normal of the first surface, unit, facing the camera; 0 where nothing was hit.
    pub normal: [f32; 3],
    /// Distance of the first surface, scene units; `None` where nothing was hit.
    pub depth: Option<f32>,
    /// Index of the first surface's object, counted from 1; 0 where nothing was hit.
    pub object: u32,
}
