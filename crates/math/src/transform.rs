//! Affine maps between object space and world space, with their inverses.

use crate::{DMat3, DVec3};
use glam::DAffine3;
use serde::{Deserialize, Serialize};

/// An invertible affine map, in `f64` so that thin walls survive scaling.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transform {
    forward: DAffine3,
    inverse: DAffine3,
}

impl Transform {
    /// The map that changes nothing.
    pub const IDENTITY: Self = Self { forward: DAffine3::IDENTITY, inverse: DAffine3::IDENTITY };

    /// From a linear part and a translation.
    ///
    /// Returns `None` where the map is singular or not finite.
    pub fn from_parts(linear: DMat3, translation: DVec3) -> Option<Self> {
        let forward = DAffine3 { matrix3: linear, translation };
        let inverse = forward.inverse();
        let finite = forward.is_finite() && inverse.is_finite() && linear.determinant() != 0.0;
        finite.then_some(Self { forward, inverse })
    }

    /// From the rows of a 4 x 4 matrix that acts on column vectors, as Mitsuba writes it.
    ///
    /// Returns `None` where the map is singular, not finite, or projective.
    pub fn from_rows(m: [[f64; 4]; 4]) -> Option<Self> {
        if m[3] != [0.0, 0.0, 0.0, 1.0] {
            return None;
        }
        let column = |c: usize| DVec3::new(m[0][c], m[1][c], m[2][c]);
        Self::from_parts(DMat3::from_cols(column(0), column(1), column(2)), column(3))
    }

    /// Moves by `offset`.
    pub fn translate(offset: DVec3) -> Self {
        Self { forward: DAffine3::from_translation(offset), inverse: DAffine3::from_translation(-offset) }
    }

    /// Scales each axis; `None` where a factor is 0 or not finite.
    pub fn scale(factors: DVec3) -> Option<Self> {
        Self::from_parts(DMat3::from_diagonal(factors), DVec3::ZERO)
    }

    /// Turns by `angle` radians about `axis`, right-handed; `None` where the axis has no length.
    pub fn rotate(axis: DVec3, angle: f64) -> Option<Self> {
        let axis = axis.try_normalize()?;
        let (sin, cos) = crate::float::f64::sin_cos(angle);
        // Rodrigues' formula, written out so that the result does not depend on the system's libm.
        let k = DMat3::from_cols(
            DVec3::new(0.0, axis.z, -axis.y),
            DVec3::new(-axis.z, 0.0, axis.x),
            DVec3::new(axis.y, -axis.x, 0.0),
        );
        Self::from_parts(DMat3::IDENTITY + k * sin + k * k * (1.0 - cos), DVec3::ZERO)
    }

    /// Takes the y axis to `y`, the z axis as near to `z_hint` as it can, the origin to `origin`; no scaling.
    /// `None` where `y` has no length.
    pub fn from_y_axis(origin: DVec3, y: DVec3, z_hint: DVec3) -> Option<Self> {
        let y = y.try_normalize()?;
        let x = y.cross(z_hint).try_normalize().unwrap_or_else(|| y.any_orthonormal_vector());
        Self::from_parts(DMat3::from_cols(x, y, x.cross(y)), origin)
    }

    /// A camera's placement: local -z looks from `from` to `to`, local y is as near to `up` as it can be.
    /// `None` where the points coincide or `up` is parallel to the view.
    pub fn look_at(from: DVec3, to: DVec3, up: DVec3) -> Option<Self> {
        let back = (from - to).try_normalize()?;
        let right = up.cross(back).try_normalize()?;
        Self::from_parts(DMat3::from_cols(right, back.cross(right), back), from)
    }

    /// This map after `first`.
    pub fn after(&self, first: &Self) -> Self {
        Self { forward: self.forward * first.forward, inverse: first.inverse * self.inverse }
    }

    /// The inverse map.
    pub fn inverse(&self) -> Self {
        Self { forward: self.inverse, inverse: self.forward }
    }

    /// Image of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.forward.transform_point3(p)
    }

    /// Image of a direction or difference of points; lengths change with the map.
    pub fn vector(&self, v: DVec3) -> DVec3 {
        self.forward.transform_vector3(v)
    }

    /// Image of a normal: perpendicular to the image of the surface, not of unit length.
    pub fn normal(&self, n: DVec3) -> DVec3 {
        self.inverse.matrix3.transpose() * n
    }

    /// Preimage of a point.
    pub fn inverse_point(&self, p: DVec3) -> DVec3 {
        self.inverse.transform_point3(p)
    }

    /// Preimage of a direction.
    pub fn inverse_vector(&self, v: DVec3) -> DVec3 {
        self.inverse.transform_vector3(v)
    }

    /// The linear part.
    pub fn linear(&self) -> DMat3 {
        self.forward.matrix3
    }

    /// Bound on how much longer a vector is in object space than in the world: the Frobenius norm of the inverse.
    pub fn inverse_norm(&self) -> f64 {
        let m = &self.inverse.matrix3;
        (m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()).sqrt()
    }

    /// The image of the origin.
    pub fn translation(&self) -> DVec3 {
        self.forward.translation
    }

    /// Whether the map mirrors: right hands become left hands.
    pub fn is_mirroring(&self) -> bool {
        self.forward.matrix3.determinant() < 0.0
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_perpendicular_under_uneven_scaling() {
        let t = Transform::scale(DVec3::new(3.0, 1.0, 0.5)).unwrap();
        let (a, b) = (DVec3::new(1.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 1.0));
        let n = a.cross(b);
        assert!(t.normal(n).dot(t.vector(a)).abs() < 1e-12);
        assert!(t.normal(n).dot(t.vector(b)).abs() < 1e-12);
    }

    #[test]
    fn look_at_points_minus_z_at_the_target() {
        let t = Transform::look_at(DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, -3.0), DVec3::Y).unwrap();
        assert!((t.vector(-DVec3::Z) - -DVec3::Z).length() < 1e-12);
        assert!((t.vector(DVec3::X) - DVec3::X).length() < 1e-12);
        assert!(Transform::look_at(DVec3::ZERO, DVec3::Y, DVec3::Y).is_none());
    }

    #[test]
    fn rotation_is_right_handed() {
        let t = Transform::rotate(DVec3::Z, std::f64::consts::FRAC_PI_2).unwrap();
        assert!((t.vector(DVec3::X) - DVec3::Y).length() < 1e-12);
        assert!(!t.is_mirroring());
    }

    #[test]
    fn singular_maps_are_refused() {
        assert!(Transform::scale(DVec3::new(1.0, 0.0, 1.0)).is_none());
        assert!(Transform::scale(DVec3::new(1.0, f64::NAN, 1.0)).is_none());
    }
}
