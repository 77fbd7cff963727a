//! The laws of light at boundaries and in media, as pure functions.
//!
//! Each law is written once, here. Directions point away from the surface; `eta` is the index of the far side over
//! that of the side the ray arrives from.

pub mod attenuation;
pub mod diffuse_fresnel;
pub mod dispersion;
pub mod fresnel;
pub mod microfacet;
pub mod phase;
pub mod refraction;

pub use attenuation::{sigma_from_color_at_distance, sigma_from_filter, transmittance};
pub use diffuse_fresnel::diffuse_fresnel;
pub use dispersion::{Abbe, Cauchy, IndexModel, Sellmeier};
pub use fresnel::{fresnel_conductor, fresnel_dielectric};
pub use microfacet::Ggx;
pub use refraction::{cos_t, reflect, refract};
