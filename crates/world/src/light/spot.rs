//! A cone of light from a point.
//!
//! Everything is written in the versine `h = 1 - cos θ` of the angle from the axis, which keeps its precision in narrow
//! cones, where the cosine has none.

use super::point::from_point;
use super::{Cone, DirectSample, EmissionPdf, EmissionSample, UnitBox};
use hyaline_math::{Frame, Vec2, Vec3, float};
use hyaline_scene::SpotFalloff;
use hyaline_spectrum::Spectrum;
use std::f32::consts::{PI, TAU};

/// Light from one point into a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight {
    position: Vec3,
    frame: Frame,
    intensity: Spectrum,
    falloff: SpotFalloff,
    /// Where the intensity begins to fall, and where it ends.
    inner: Edge,
    outer: Edge,
}

/// A cone about the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    /// Half-angle, radians.
    angle: f32,
    /// 1 - cos of the angle.
    h: f32,
}

impl Edge {
    /// The cone of an angle limited to 0…`most`; no number gives 0.
    fn new(angle: f32, most: f32) -> Self {
        let angle = if angle > 0.0 { angle.min(most) } else { 0.0 };
        Self { angle, h: 2.0 * float::sin(0.5 * angle).powi(2) }
    }
}

impl SpotLight {
    /// A spot at `position`.
    ///
    /// - `axis`: unit direction of the cone's axis.
    /// - `intensity`: radiant intensity on the axis, W sr⁻¹.
    /// - `outer_angle`, `inner_angle`: half-angles, radians; the outer one is clamped to 0…π, the inner one to
    ///   0…outer.
    pub fn new(
        position: Vec3,
        axis: Vec3,
        intensity: Spectrum,
        outer_angle: f32,
        inner_angle: f32,
        falloff: SpotFalloff,
    ) -> Self {
        let outer = Edge::new(outer_angle, PI);
        let inner = Edge::new(inner_angle, outer.angle);
        Self { position, frame: Frame::from_normal(axis), intensity, falloff, inner, outer }
    }

    pub(super) fn sample_direct(&self, p: Vec3) -> Option<DirectSample> {
        from_point(self.position, p, |direction| self.intensity_toward(direction))
    }

    pub(super) fn position(&self) -> Vec3 {
        self.position
    }

    /// Intensity in a direction, unit.
    pub(super) fn intensity_toward(&self, direction: Vec3) -> Spectrum {
        self.intensity * self.factor(self.h_of(direction))
    }

    /// Of the outer cone, sr.
    pub(super) fn solid_angle(&self) -> f32 {
        TAU * self.outer.h
    }

    /// About the directions of `sample_emission`.
    pub(super) fn cone_of_emission(&self, unit_box: &UnitBox) -> Cone {
        let h = [unit_box.min.x, unit_box.max.x].map(|u| f64::from(self.sample_h(u as f32)));
        Cone::about_turned(&self.frame, h, unit_box)
    }

    pub(super) fn sample_emission(&self, u: Vec2) -> Option<EmissionSample> {
        let h = self.sample_h(u.x);
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
        let sin_theta = (h * (2.0 - h)).max(0.0).sqrt();
        let direction = self.frame.to_world(Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, 1.0 - h));
        let (factor, pdf_direction) = (self.factor(h), self.pdf_of_h(h));
        (factor > 0.0 && pdf_direction > 0.0).then(|| EmissionSample {
            origin: self.position,
            p_error: 0.0,
            n: None,
            direction: direction.normalize(),
            weight: self.intensity * (factor / pdf_direction),
            pdf_position: 1.0,
            pdf_direction,
            is_delta_position: true,
            is_delta_direction: false,
        })
    }

    pub(super) fn pdf_emission(&self, direction: Vec3) -> EmissionPdf {
        EmissionPdf { position: 1.0, direction: self.pdf_of_h(self.h_of(direction)) }
    }

    /// The intensity integrated over the cone, in closed form.
    pub(super) fn power(&self) -> Spectrum {
        self.intensity * (TAU * (self.inner.h + self.penumbra()))
    }

    /// Integral of the falling factor over h.
    fn penumbra(&self) -> f32 {
        match self.falloff {
            SpotFalloff::Smooth => 0.5 * (self.outer.h - self.inner.h),
            SpotFalloff::LinearInAngle if self.outer.angle <= self.inner.angle => 0.0,
            SpotFalloff::LinearInAngle => {
                // Integral of (outer - θ) / (outer - inner) sin θ, in f64 as its terms nearly cancel.
                let (inner, outer) = (f64::from(self.inner.angle), f64::from(self.outer.angle));
                let (sin_inner, cos_inner) = float::f64::sin_cos(inner);
                (cos_inner - (float::f64::sin(outer) - sin_inner) / (outer - inner)) as f32
            }
        }
    }

    /// 1 - cos of the angle between the axis and a unit direction.
    fn h_of(&self, direction: Vec3) -> f32 {
        0.5 * (direction - self.frame.n).length_squared()
    }

    /// Share of the axis's intensity, 0…1.
    fn factor(&self, h: f32) -> f32 {
        let ramp = self.ramp(h);
        match self.falloff {
            SpotFalloff::Smooth => ramp * ramp * (3.0 - 2.0 * ramp),
            SpotFalloff::LinearInAngle if ramp > 0.0 && ramp < 1.0 => {
                let angle = 2.0 * float::asin((0.5 * h).sqrt());
                ((self.outer.angle - angle) / (self.outer.angle - self.inner.angle)).clamp(0.0, 1.0)
            }
            SpotFalloff::LinearInAngle => ramp,
        }
    }

    /// 1 within the inner cone, 0 outside the outer one, linear in h between: the shape of the density.
    fn ramp(&self, h: f32) -> f32 {
        if h <= self.inner.h {
            1.0
        } else if h >= self.outer.h {
            0.0
        } else {
            (self.outer.h - h) / (self.outer.h - self.inner.h)
        }
    }

    /// Integral of the ramp over h.
    fn ramp_integral(&self) -> f32 {
        0.5 * (self.inner.h + self.outer.h)
    }

    /// Draws h with a density in proportion to the ramp.
    fn sample_h(&self, u: f32) -> f32 {
        let area = u * self.ramp_integral();
        if area < self.inner.h {
            return area;
        }
        let width = self.outer.h - self.inner.h;
        let left = (1.0 - 2.0 * (area - self.inner.h) / width).max(0.0);
        self.outer.h - width * left.sqrt()
    }

    /// Density of `sample_emission` per solid angle, sr⁻¹.
    fn pdf_of_h(&self, h: f32) -> f32 {
        let integral = TAU * self.ramp_integral();
        if integral > 0.0 { self.ramp(h) / integral } else { 0.0 }
    }
}
