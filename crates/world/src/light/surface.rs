//! What all lights with a surface have in common: the same radiance everywhere and in all directions of a side.

use super::{Cone, DirectSample, EmissionSample, LightPoint, UnitBox};
use hyaline_geometry::AreaSample;
use hyaline_math::{DVec2, Frame, Vec2, Vec3, float::ONE_MINUS_EPSILON};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;
use std::f32::consts::PI;

/// Which sides of a surface shine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShiningSides {
    /// The one the normals point to.
    #[default]
    Outer,
    /// Both.
    Both,
}

/// Diffuse light from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SurfaceEmission {
    /// Radiance, W sr⁻¹ m⁻².
    pub(super) radiance: Spectrum,
    pub(super) sides: ShiningSides,
}

impl SurfaceEmission {
    /// Radiance that leaves a place with the outward normal `n` in the direction `w`.
    pub(super) fn radiance_toward(&self, n: Vec3, w: Vec3) -> Spectrum {
        if self.shines_toward(n, w) { self.radiance } else { Spectrum::ZERO }
    }

    /// Whether light leaves a place with the outward normal `n` in the direction `w`.
    pub(super) fn shines_toward(&self, n: Vec3, w: Vec3) -> bool {
        match self.sides {
            ShiningSides::Outer => n.dot(w) > 0.0,
            ShiningSides::Both => n.dot(w) != 0.0,
        }
    }

    /// The light that a point of the surface, chosen by area, sends to `p`.
    pub(super) fn direct_by_area(&self, p: Vec3, sample: &AreaSample) -> Option<DirectSample> {
        let target = LightPoint { p: sample.p, p_error: sample.p_error, n: sample.n };
        let to_light = sample.p - p;
        let wi = to_light.try_normalize()?;
        let pdf_w = self.pdf_by_area(p, wi, (sample.p, sample.n), sample.pdf_a);
        self.direct(wi, to_light.length(), target, pdf_w)
    }

    /// The light that `target` sends to a point from which it lies in the direction `wi`.
    ///
    /// - `pdf_w`: density of `wi`, sr⁻¹.
    pub(super) fn direct(
        &self,
        wi: Vec3,
        distance: f32,
        target: LightPoint,
        pdf_w: f32,
    ) -> Option<DirectSample> {
        let radiance = self.radiance_toward(target.n, -wi);
        let found = !radiance.is_zero() && pdf_w > 0.0 && pdf_w.is_finite();
        let target = Some(target);
        found.then_some(DirectSample { wi, distance, target, radiance, pdf_w, is_delta: false })
    }

    /// Density per solid angle at `p` of the place `q` with normal `n` when its density by area is `pdf_a`, sr⁻¹.
    pub(super) fn pdf_by_area(&self, p: Vec3, wi: Vec3, (q, n): (Vec3, Vec3), pdf_a: f32) -> f32 {
        if !self.shines_toward(n, -wi) {
            return 0.0;
        }
        (q - p).length_squared() * pdf_a / n.dot(wi).abs()
    }

    /// Light that starts at a point chosen by area, in a direction chosen by the cosine.
    ///
    /// - `frame`: about the outward normal.
    pub(super) fn emission(&self, sample: &AreaSample, frame: &Frame, u: Vec2) -> Option<EmissionSample> {
        let (side, u) = self.choose_side(u);
        let local = warp::sample_cosine_hemisphere(u);
        let direction = frame.to_world(Vec3::new(local.x, local.y, side * local.z));
        let pdf_direction = self.pdf_of_direction(sample.n, direction);
        (pdf_direction > 0.0).then(|| EmissionSample {
            origin: sample.p,
            p_error: sample.p_error,
            n: Some(sample.n),
            direction,
            weight: self.power(1.0 / sample.pdf_a),
            pdf_position: sample.pdf_a,
            pdf_direction,
            is_delta_position: false,
            is_delta_direction: false,
        })
    }

    /// About the directions of `emission` for random numbers in a box.
    pub(super) fn cone(&self, frame: &Frame, unit_box: &UnitBox) -> Cone {
        let half = |from: f64| {
            let stretched = |u: DVec2| DVec2::new(2.0 * u.x - from, u.y);
            UnitBox { min: stretched(unit_box.min), max: stretched(unit_box.max) }
        };
        match self.sides {
            ShiningSides::Outer => Cone::about_cosine(frame, 1.0, unit_box),
            ShiningSides::Both if unit_box.max.x <= 0.5 => Cone::about_cosine(frame, 1.0, &half(0.0)),
            ShiningSides::Both if unit_box.min.x >= 0.5 => Cone::about_cosine(frame, -1.0, &half(1.0)),
            ShiningSides::Both => Cone::ALL,
        }
    }

    /// Density of the direction of `emission` at a place with the outward normal `n`, sr⁻¹.
    pub(super) fn pdf_of_direction(&self, n: Vec3, direction: Vec3) -> f32 {
        let cosine = n.dot(direction);
        match self.sides {
            ShiningSides::Outer => cosine.max(0.0) / PI,
            ShiningSides::Both => cosine.abs() / (2.0 * PI),
        }
    }

    /// All light of a surface of this area, W.
    pub(super) fn power(&self, area: f32) -> Spectrum {
        let sides = match self.sides {
            ShiningSides::Outer => 1.0,
            ShiningSides::Both => 2.0,
        };
        self.radiance * (PI * area * sides)
    }

    /// +1 for the outer side, -1 for the inner one, and what the choice leaves of `u`.
    fn choose_side(&self, u: Vec2) -> (f32, Vec2) {
        match self.sides {
            ShiningSides::Outer => (1.0, u),
            ShiningSides::Both if u.x < 0.5 => (1.0, Vec2::new(2.0 * u.x, u.y)),
            ShiningSides::Both => (-1.0, Vec2::new((2.0 * u.x - 1.0).min(ONE_MINUS_EPSILON), u.y)),
        }
    }
}
