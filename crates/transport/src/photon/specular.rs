//! What counts as specular, for photons and for paths of the eye alike: the one line between what the maps hold and
//! what is traced.
//!
//! At a specular surface nothing is stored and nothing is looked up: light is traced on, by photons and from the
//! eye. All other surfaces are ends of caustics. Both sides must draw the line at the same place, else light that
//! one leaves to the other would be lost or counted twice.

use hyaline_scattering::SurfaceBsdf;
use hyaline_world::NEARLY_POLISHED;

/// Lobes narrower than this, on the scale of GGX, are traced like a mirror's: too few photons would fall into them
/// for an estimate, and few rays need to be traced through them for a smooth picture.
///
/// It is the GGX width of the roughness up to which photons are aimed at a finish.
pub const NARROW_LOBE: f32 = NEARLY_POLISHED * NEARLY_POLISHED;

/// Whether photons are not kept at the surface and the eye looks on through it.
pub fn is_specular(bsdf: &SurfaceBsdf) -> bool {
    bsdf.lobe_width() < NARROW_LOBE
}

/// Whether a direction drawn at a surface goes on a specular chain: all of a specular surface, and the polished part
/// of a coated one.
///
/// - `is_delta`: whether the direction was the only one of its branch.
pub fn is_specular_event(bsdf: &SurfaceBsdf, is_delta: bool) -> bool {
    is_delta || is_specular(bsdf)
}
