//! Small-scale form: textures that turn the shading normal.

use crate::texture::Texture;
use hyaline_geometry::{SurfaceHit, Tangents};
use hyaline_math::{Frame, Vec3};

/// What turns the shading normal, and nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relief {
    /// Heights above the surface.
    Bump {
        /// Index of the texture whose luminance is the height.
        texture: u32,
        /// Factor on the heights, scene units.
        scale: f32,
    },
    /// Normals in the frame of the surface's parameters, -1…1 kept as 0…1.
    Normals {
        /// Index of the texture.
        texture: u32,
    },
    /// Slopes along the tangents by u and v.
    Slopes {
        /// Index of the texture.
        texture: u32,
        /// Factor on the slopes.
        scale: f32,
    },
}

impl Relief {
    /// The normal to shade with: unit, on the side of the geometric normal; where relief would turn it away from that
    /// side, the normal without relief.
    pub fn normal(&self, textures: &[Texture], hit: &SurfaceHit, tangents: &Tangents) -> Vec3 {
        let turned = match *self {
            Self::Bump { texture, scale } => {
                hit.n - gradient(textures[texture as usize].gradient(hit.uv), tangents) * scale
            }
            Self::Normals { texture } => {
                let local = Vec3::from_array(textures[texture as usize].color(hit.uv)) * 2.0 - Vec3::ONE;
                frame(hit.n, tangents).to_world(local)
            }
            Self::Slopes { texture, scale } => {
                let [s_u, s_v, _] = textures[texture as usize].color(hit.uv);
                frame(hit.n, tangents).to_world(Vec3::new(-s_u * scale, -s_v * scale, 1.0))
            }
        };
        turned.try_normalize().filter(|n| n.dot(hit.ng) > 0.0).unwrap_or(hit.n)
    }
}

/// The gradient along the surface of a height whose derivatives by u and v are given.
fn gradient(by_uv: hyaline_math::Vec2, tangents: &Tangents) -> Vec3 {
    let area = tangents.dpdu.cross(tangents.dpdv);
    // The vectors of the dual basis: each has the product 1 with its own tangent and 0 with the other.
    let (by_u, by_v) = (tangents.dpdv.cross(area), area.cross(tangents.dpdu));
    (by_u * by_uv.x + by_v * by_uv.y) / area.length_squared()
}

/// Unit tangents by u and v about the shading normal, at right angles; left-handed where the parameters are.
fn frame(n: Vec3, tangents: &Tangents) -> Frame {
    let along_u = tangents.dpdu - n * n.dot(tangents.dpdu);
    let s = along_u.try_normalize().unwrap_or(Frame::from_normal(n).s);
    let t = n.cross(s);
    Frame { s, t: if t.dot(tangents.dpdv) < 0.0 { -t } else { t }, n }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_math::Vec2;
    use hyaline_scene::{ImageData, TextureDescription, TextureKind};
    use std::sync::Arc;

    fn hit(uv: Vec2) -> SurfaceHit {
        let (p, ng) = (Vec3::ZERO, Vec3::Z);
        SurfaceHit { t: 1.0, p, p_error: 0.0, ng, n: ng, uv, item: 0, primitive: 0 }
    }

    /// A texture of 64 × 64 pixels with the value of `f` at their (u, v).
    fn image(f: impl Fn(f32, f32) -> [f32; 3]) -> Texture {
        let at = |i: u32| (i as f32 + 0.5) / 64.0;
        let pixels = (0..64 * 64).map(|i| f(at(i % 64), 1.0 - at(i / 64))).collect();
        let image = ImageData { width: 64, height: 64, pixels };
        Texture::new(&TextureDescription::new("t", TextureKind::Image(Arc::new(image))))
    }

    /// A stretched and skewed plane z = 0.
    fn skewed() -> Tangents {
        Tangents { dpdu: Vec3::new(2.0, 0.0, 0.0), dpdv: Vec3::new(0.5, 3.0, 0.0) }
    }

    #[test]
    fn a_slope_of_heights_tilts_the_normal_by_its_angle() {
        // Heights that grow by 0.4 per unit of u and 0.9 per unit of v.
        let textures = [image(|u, v| [0.4 * u + 0.9 * v; 3])];
        let bump = Relief::Bump { texture: 0, scale: 2.0 };
        let n = bump.normal(&textures, &hit(Vec2::new(0.4, 0.6)), &skewed());
        // z = a x + b y with 2 a = 0.8 along u and 0.5 a + 3 b = 1.8 along v.
        let (a, b) = (0.4, 1.6 / 3.0);
        assert!((n - Vec3::new(-a, -b, 1.0).normalize()).length() < 1e-4, "{n}");
        // A plane whose parameters turn the other way round is the same plane.
        let mirrored = Tangents { dpdu: skewed().dpdv, dpdv: skewed().dpdu };
        let swapped = [image(|u, v| [0.9 * u + 0.4 * v; 3])];
        let m = bump.normal(&swapped, &hit(Vec2::new(0.6, 0.4)), &mirrored);
        assert!((n - m).length() < 1e-4, "{m}");
    }

    #[test]
    fn normals_and_slopes_lie_in_the_frame_of_the_parameters() {
        let want = Vec3::new(0.48, -0.36, 0.8);
        let textures = [image(|_, _| (want * 0.5 + 0.5).to_array()), image(|_, _| [-0.3, 0.225, 0.0])];
        let straight = Tangents { dpdu: Vec3::X * 5.0, dpdv: Vec3::Y * 0.1 };
        for relief in [Relief::Normals { texture: 0 }, Relief::Slopes { texture: 1, scale: 2.0 }] {
            let n = relief.normal(&textures, &hit(Vec2::splat(0.5)), &straight);
            assert!((n - want).length() < 1e-5, "{relief:?}: {n}");
            let mirrored = Tangents { dpdv: -straight.dpdv, ..straight };
            let n = relief.normal(&textures, &hit(Vec2::splat(0.5)), &mirrored);
            assert!((n - Vec3::new(0.48, 0.36, 0.8)).length() < 1e-5, "{relief:?}: {n}");
        }
    }

    #[test]
    fn relief_never_turns_a_surface_inside_out() {
        let textures = [image(|_, _| [0.5, 0.5, 0.0]), image(|_, _| [f32::NAN; 3])];
        for texture in [0, 1] {
            let n = Relief::Normals { texture }.normal(&textures, &hit(Vec2::splat(0.5)), &skewed());
            assert_eq!(n, Vec3::Z);
        }
    }
}
