//! Lights: each can be sampled from a point, asked for what it sends, and made to emit.
//!
//! Light that a ray meets and light that is sampled are one and the same: `radiance_from` and `radiance_of_sky` give
//! what `sample_direct` gives in the same direction, and `pdf_direct` is the density of `sample_direct`, so that the
//! two can be weighed against each other.

mod cone;
mod directional;
mod environment;
mod media;
mod mesh;
mod point;
mod projector;
mod sample;
mod set;
mod shape;
mod sky_image;
mod sphere;
mod spot;
mod surface;
#[cfg(test)]
mod tests;

pub use cone::{Cone, DiscPatch, UnitBox};
pub use directional::DirectionalLight;
pub use environment::{EnvironmentLight, RestrictedSky, SkyDirection};
pub use media::LightMedia;
pub use mesh::MeshLight;
pub use point::PointLight;
pub use projector::{ProjectorLight, Slide};
pub use sample::{DirectSample, EmissionPdf, EmissionSample, LightPoint, SceneSphere};
pub use set::{DIRECT_UNIFORM_SHARE, LightChoice, LightSampler, LightSet};
pub use shape::ShapeLight;
pub use sky_image::SkyImage;
pub use spot::SpotLight;
pub use surface::ShiningSides;

use hyaline_geometry::{AreaSample, SurfaceHit};
use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_spectrum::Spectrum;

/// A light of any kind.
#[allow(clippy::large_enum_variant, reason = "there are few lights, and all are used in place")]
#[derive(Clone, Debug)]
pub enum Light {
    /// Shines alike in all directions.
    Point(PointLight),
    /// A cone of light.
    Spot(SpotLight),
    /// An image thrown from a point.
    Projector(ProjectorLight),
    /// Parallel light from infinitely far.
    Directional(DirectionalLight),
    /// An analytic shape that shines.
    Shape(ShapeLight),
    /// A mesh that shines.
    Mesh(MeshLight),
    /// Light from every direction of the surroundings.
    Environment(EnvironmentLight),
}

impl Light {
    /// Chooses a direction from which light comes to a point, occlusion not considered.
    ///
    /// - `p`: the point to be lit, world space.
    /// - `u`: two uniform random numbers in [0, 1).
    ///
    /// Returns `None` where the choice brings no light: the far side of a lamp, outside a spot's cone. Of the sky, the
    /// radiance may be 0, too.
    pub fn sample_direct(&self, p: Vec3, u: Vec2) -> Option<DirectSample> {
        match self {
            Self::Point(light) => light.sample_direct(p),
            Self::Spot(light) => light.sample_direct(p),
            Self::Projector(light) => light.sample_direct(p),
            Self::Directional(light) => Some(light.sample_direct()),
            Self::Shape(light) => light.sample_direct(p, u),
            Self::Mesh(light) => light.sample_direct(p, u),
            Self::Environment(light) => light.sample_direct(u),
        }
    }

    /// Density with which `sample_direct` chooses a direction that a ray took by other means.
    ///
    /// - `p`: where the ray started.
    /// - `wi`: its direction, unit.
    /// - `hit`: where it met this light; `None` where it met nothing, which asks for the sky.
    ///
    /// Returns sr⁻¹; 0 for lights that rays cannot meet, and where `sample_direct` would bring no light.
    pub fn pdf_direct(&self, p: Vec3, wi: Vec3, hit: Option<&SurfaceHit>) -> f32 {
        match (self, hit) {
            (Self::Shape(light), Some(hit)) => light.pdf_direct(p, wi, hit),
            (Self::Mesh(light), Some(hit)) => light.pdf_direct(p, wi, hit),
            (Self::Environment(light), None) => light.pdf_direct(wi),
            (Self::Shape(_) | Self::Mesh(_), None) | (Self::Environment(_), Some(_)) => 0.0,
            (Self::Point(_) | Self::Spot(_) | Self::Projector(_) | Self::Directional(_), _) => 0.0,
        }
    }

    /// Radiance that leaves the surface of a light.
    ///
    /// - `hit`: the place on this light.
    /// - `w`: the direction the light leaves in, unit, away from the surface.
    ///
    /// Returns 0 for lights without a surface, and on the inner side of those that shine from the outer side only.
    pub fn radiance_from(&self, hit: &SurfaceHit, w: Vec3) -> Spectrum {
        match self {
            Self::Shape(light) => light.radiance_from(hit, w),
            Self::Mesh(light) => light.radiance_from(hit, w),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projector(_)
            | Self::Directional(_)
            | Self::Environment(_) => Spectrum::ZERO,
        }
    }

    /// Radiance that comes from the surroundings.
    ///
    /// - `direction`: unit, the way one looks.
    ///
    /// Returns 0 for all lights but an environment.
    pub fn radiance_of_sky(&self, direction: Vec3) -> Spectrum {
        match self {
            Self::Environment(light) => light.radiance(direction),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projector(_)
            | Self::Directional(_)
            | Self::Shape(_)
            | Self::Mesh(_) => Spectrum::ZERO,
        }
    }

    /// Chooses a place and a direction in which light starts.
    ///
    /// - `u_position`, `u_direction`: two uniform random numbers in [0, 1) each.
    ///
    /// Lights at infinity emit from a disc that faces the scene and covers it. Returns `None` where the choice has no
    /// light.
    pub fn sample_emission(&self, u_position: Vec2, u_direction: Vec2) -> Option<EmissionSample> {
        match self {
            Self::Point(light) => Some(light.sample_emission(u_direction)),
            Self::Spot(light) => light.sample_emission(u_direction),
            Self::Projector(light) => light.sample_emission(u_direction),
            Self::Directional(light) => Some(light.sample_emission(u_position)),
            Self::Shape(light) => light.sample_emission(u_position, u_direction),
            Self::Mesh(light) => light.sample_emission(u_position, u_direction),
            Self::Environment(light) => light.sample_emission(u_position, u_direction),
        }
    }

    /// Densities with which `sample_emission` starts light at a place in a direction; 1 for what it has no choice of.
    ///
    /// - `n`: normal of the light at the place, unit, outward; unused by lights without a surface.
    /// - `direction`: unit, the way the light travels.
    pub fn pdf_emission(&self, n: Vec3, direction: Vec3) -> EmissionPdf {
        match self {
            Self::Point(_) => PointLight::pdf_emission(),
            Self::Spot(light) => light.pdf_emission(direction),
            Self::Projector(light) => light.pdf_emission(direction),
            Self::Directional(light) => light.pdf_emission(),
            Self::Shape(light) => light.pdf_emission(n, direction),
            Self::Mesh(light) => light.pdf_emission(n, direction),
            Self::Environment(light) => light.pdf_emission(direction),
        }
    }

    /// Starts light at a place of the light's surface, in a direction chosen by the cosine.
    ///
    /// - `sample`: the place, and the density at which it was chosen from the whole surface.
    /// - `frame`: about the place's outward normal.
    /// - `u`: two uniform random numbers in [0, 1).
    ///
    /// `sample_emission` does this at places of its own choice. Returns `None` for lights without a surface.
    pub fn emission_at(&self, sample: &AreaSample, frame: &Frame, u: Vec2) -> Option<EmissionSample> {
        match self {
            Self::Shape(light) => light.emission_at(sample, frame, u),
            Self::Mesh(light) => light.emission_at(sample, frame, u),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projector(_)
            | Self::Directional(_)
            | Self::Environment(_) => None,
        }
    }

    /// About all directions that `emission_at` gives random numbers in a box; all directions for lights without a
    /// surface.
    pub fn cone_at(&self, frame: &Frame, unit_box: &UnitBox) -> Cone {
        match self {
            Self::Shape(light) => light.cone_at(frame, unit_box),
            Self::Mesh(light) => light.cone_at(frame, unit_box),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projector(_)
            | Self::Directional(_)
            | Self::Environment(_) => Cone::ALL,
        }
    }

    /// The point that all light starts from; `None` for lights that are no point.
    pub fn position(&self) -> Option<Vec3> {
        match self {
            Self::Point(light) => Some(light.position),
            Self::Spot(light) => Some(light.position()),
            Self::Projector(light) => Some(light.position()),
            Self::Directional(_) | Self::Shape(_) | Self::Mesh(_) | Self::Environment(_) => None,
        }
    }

    /// About all directions that `sample_emission` of a light that is a point gives a box of `u_direction`; all
    /// directions for other lights.
    pub fn cone_of_emission(&self, unit_box: &UnitBox) -> Cone {
        match self {
            Self::Point(_) => PointLight::cone_of_emission(unit_box),
            Self::Spot(light) => light.cone_of_emission(unit_box),
            Self::Projector(light) => light.cone_of_emission(unit_box),
            Self::Directional(_) | Self::Shape(_) | Self::Mesh(_) | Self::Environment(_) => Cone::ALL,
        }
    }

    /// What a light that is a point sends in a direction, W sr⁻¹; 0 for other lights.
    pub fn intensity(&self, direction: Vec3) -> Spectrum {
        match self {
            Self::Point(light) => light.intensity,
            Self::Spot(light) => light.intensity_toward(direction),
            Self::Projector(light) => light.intensity_toward(direction),
            Self::Directional(_) | Self::Shape(_) | Self::Mesh(_) | Self::Environment(_) => Spectrum::ZERO,
        }
    }

    /// Solid angle that a light that is a point shines into, sr; 0 for other lights.
    pub fn solid_angle(&self) -> f32 {
        match self {
            Self::Point(_) => 4.0 * std::f32::consts::PI,
            Self::Spot(light) => light.solid_angle(),
            Self::Projector(light) => light.solid_angle(),
            Self::Directional(_) | Self::Shape(_) | Self::Mesh(_) | Self::Environment(_) => 0.0,
        }
    }

    /// Whether rays come to it by themselves: it has a surface or is an environment. Others only sampling finds.
    pub fn can_be_met(&self) -> bool {
        match self {
            Self::Shape(_) | Self::Mesh(_) | Self::Environment(_) => true,
            Self::Point(_) | Self::Spot(_) | Self::Projector(_) | Self::Directional(_) => false,
        }
    }

    /// Whether it is a surface that shines on both sides.
    pub fn is_two_sided(&self) -> bool {
        match self {
            Self::Shape(light) => light.is_two_sided(),
            Self::Mesh(light) => light.is_two_sided(),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projector(_)
            | Self::Directional(_)
            | Self::Environment(_) => false,
        }
    }

    /// All the light it sends out, W; for lights at infinity, what crosses the scene's bounding sphere.
    pub fn power(&self) -> Spectrum {
        match self {
            Self::Point(light) => light.power(),
            Self::Spot(light) => light.power(),
            Self::Projector(light) => light.power(),
            Self::Directional(light) => light.power(),
            Self::Shape(light) => light.power(),
            Self::Mesh(light) => light.power(),
            Self::Environment(light) => light.power(),
        }
    }
}
