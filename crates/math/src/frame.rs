//! An orthonormal frame about a normal.

use crate::Vec3;

/// Right-handed orthonormal basis; `n` is the local z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// First tangent.
    pub s: Vec3,
    /// Second tangent, `n × s`.
    pub t: Vec3,
    /// Normal, unit.
    pub n: Vec3,
}

impl Frame {
    /// A frame about the unit vector `n`, tangents free.
    ///
    /// Source: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
    pub fn from_normal(n: Vec3) -> Self {
        let sign = 1.0_f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        let s = Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
        let t = Vec3::new(b, sign + n.y * n.y * a, -n.y);
        Self { s, t, n }
    }

    /// World vector to local coordinates.
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }

    /// Local coordinates to a world vector.
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        for n in
            [Vec3::Z, -Vec3::Z, Vec3::X, Vec3::new(0.48, -0.6, -0.64), Vec3::new(1e-8, 0.0, -1.0).normalize()]
        {
            let frame = Frame::from_normal(n);
            assert!((frame.s.cross(frame.t) - n).length() < 1e-6);
            assert!((frame.s.length() - 1.0).abs() < 1e-6);
            let v = Vec3::new(0.3, -0.2, 0.9);
            assert!((frame.to_world(frame.to_local(v)) - v).length() < 1e-6);
        }
    }
}
