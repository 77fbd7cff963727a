//! Follows one ray through smooth boundaries, reflected or transmitted at each as told.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part, and a test exports nothing")]

use hyaline_math::{DVec3, Ray, Vec3, offset_origin};
use hyaline_transport::Stats;
use hyaline_transport::walk::{self, Event};
use hyaline_world::{World, mask};

/// What the ray does at a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Reflect,
    Transmit,
}

/// A ray that has come through.
pub struct Followed {
    /// Where it met boundaries.
    pub points: Vec<DVec3>,
    /// A point and the unit direction of its last piece.
    pub origin: DVec3,
    pub direction: DVec3,
    /// Radiance that arrives at the start for a radiance of 1 against the last piece.
    pub weight: f64,
}

/// A ray, given in f64.
pub fn ray(origin: DVec3, direction: DVec3) -> Ray {
    Ray::new(origin.as_vec3(), direction.normalize().as_vec3().normalize())
}

/// Follows `ray` from where the first camera is; `None` where it meets no boundary, or can't go the way it is told.
pub fn follow(world: &World, ray: Ray, ways: &[Way]) -> Option<Followed> {
    let mut set = world.camera_media[0].clone();
    let mut stats = Stats::default();
    let (mut ray, mut points, mut weight) = (ray, Vec::new(), 1.0);
    for way in ways {
        let Event::Surface(vertex) = walk::advance(world, &ray, mask::PATH, &mut set, &mut stats) else {
            return None;
        };
        let branches = vertex.bsdf.branches(-ray.direction);
        let branch = branches.iter().flatten().find(|b| b.transmits == (*way == Way::Transmit))?;
        points.push(vertex.hit.p.as_dvec3());
        weight *= f64::from((vertex.transmittance * branch.weight).mean(world.lanes));
        if branch.transmits {
            vertex.commit(world, &mut set);
        }
        let start: Vec3 = offset_origin(vertex.hit.p, vertex.hit.p_error, vertex.hit.ng, branch.wi);
        ray = Ray::new(start, branch.wi);
    }
    assert!(stats.never_entered.is_empty(), "left what was never entered");
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    Some(Followed { points, origin, direction, weight })
}
