//! Balls that reach beyond their medium: only the part within it holds photons, and only photons of that part count.
//!
//! Rays to both sides along three axes at right angles, turned at random, find how far the medium goes. What of the
//! kernel's weight lies within that reach, on the mean over the rays, is the share of the ball that counts: at a flat wall
//! exactly half, as opposite rays make up for each other. Photons behind a surface that a ray met, on the other side of its
//! tangent plane, are left out.

use super::kernel::Kernel;
use crate::extent::{LEAST_SHARE, end_of_medium};
use crate::stats::Stats;
use hyaline_math::{Frame, Ray, Vec2, Vec3, float};
use hyaline_sampling::warp;
use hyaline_scattering::MediumSet;
use hyaline_world::World;

/// What of a ball counts.
#[derive(Clone, Debug)]
pub struct Clip {
    /// Share of the kernel's weight within the medium, above 0, at most 1.
    pub share: f32,
    /// Planes that end the medium: normals to the inside, and their distance from the origin along them.
    planes: [(Vec3, f32); 6],
    /// How many of them there are.
    count: usize,
}

impl Clip {
    /// All of the ball, whatever its radius.
    pub fn whole(_radius: f32) -> Self {
        Self { share: 1.0, planes: [(Vec3::ZERO, 0.0); 6], count: 0 }
    }

    /// The part of a ball about `p` that is in the same medium.
    ///
    /// - `set`: what `p` is in.
    /// - `u`: uniform in [0, 1)², and one more number: they turn the rays.
    pub fn of_medium(
        world: &World,
        (p, radius): (Vec3, f32),
        set: &MediumSet,
        kernel: Kernel,
        (u, turn): (Vec2, f32),
        stats: &mut Stats,
    ) -> Self {
        let mut clip = Self::whole(radius);
        let mut share = 0.0;
        for direction in axes(u, turn).into_iter().flat_map(|axis| [axis, -axis]) {
            let ray = Ray { t_max: radius, ..Ray::new(p, direction) };
            let reach = match end_of_medium(world, ray, set, &mut stats.rays) {
                None => radius,
                Some((t, end, normal)) => {
                    let inside = if normal.dot(direction) > 0.0 { -normal } else { normal };
                    clip.planes[clip.count] = (inside, inside.dot(end));
                    clip.count += 1;
                    t
                }
            };
            share += kernel.ball_share((reach / radius).min(1.0)) / 6.0;
        }
        clip.share = share.clamp(LEAST_SHARE, 1.0);
        clip
    }

    /// Whether a photon at `p` counts.
    pub(super) fn holds(&self, p: Vec3) -> bool {
        self.planes[..self.count].iter().all(|(normal, distance)| normal.dot(p) >= *distance)
    }
}

/// Three axes at right angles, turned at random.
fn axes(u: Vec2, turn: f32) -> [Vec3; 3] {
    let frame = Frame::from_normal(warp::sample_sphere(u));
    let (sin, cos) = float::sin_cos(std::f32::consts::TAU * turn);
    [Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0), Vec3::Z].map(|axis| frame.to_world(axis))
}
