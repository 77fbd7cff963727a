//! Media that scatter, for scenes built in code, and single scattering by quadrature.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part, and a test exports nothing")]

use crate::scene_kit::SceneKit;
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Transform};
use hyaline_scene::*;
use hyaline_testkit::integrate;
use hyaline_world::World;
use std::sync::Arc;

/// Adds a scattering medium.
pub fn volume(kit: &mut SceneKit, name: &str, ior: f64, sigma_a: Rgb, sigma_s: Rgb, g: f32) {
    let medium = MediumDescription {
        absorption: Absorption::SigmaA(sigma_a),
        scattering: Some(Scattering { sigma_s, phase: PhaseDescription::from_mean_cosine(g) }),
        ..MediumDescription::clear(name, IndexDescription::Constant(ior))
    };
    kit.description.media.push(medium.into());
}

/// Gives the last medium a grid that fills a box; `density` is told the cell.
pub fn grid(kit: &mut SceneKit, min: DVec3, max: DVec3, density: impl Fn([u32; 3]) -> f32) {
    let size = [12, 10, 9];
    let cells = (0..size[0] * size[1] * size[2])
        .map(|i| density([i % size[0], i / size[0] % size[1], i / (size[0] * size[1])]));
    let data = GridData { size, channels: 1, values: cells.collect() };
    let placement = Transform::translate(min).after(&Transform::scale(max - min).unwrap());
    let density = DensityGrid { density: Arc::new(data), albedo: None, placement };
    kit.description.media.last_mut().unwrap().density = Some(density);
}

/// Densities that change from cell to cell, a third of them 0.
pub fn uneven([x, y, z]: [u32; 3]) -> f32 {
    if x < 4 { 0.0 } else { ((x * 7 + y * 3 + z) % 11) as f32 * 0.2 }
}

pub const SIGMA_A: Rgb = [0.1, 0.4, 0.0];
pub const SIGMA_S: Rgb = [0.2, 0.9, 0.5];
pub const G: f32 = 0.55;

/// Single scattering of a lamp of this radiant intensity towards a place, by quadrature along a ray.
pub fn single_by_quadrature(
    ray: &Ray,
    lamp: DVec3,
    lane: usize,
    length: f64,
    intensity: impl Fn(DVec3) -> f64,
) -> f64 {
    let (sigma_s, sigma_t) = (f64::from(SIGMA_S[lane]), f64::from(SIGMA_A[lane] + SIGMA_S[lane]));
    let (o, d, g) = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::from(G));
    let integrand = |t: f64| {
        let to_lamp = lamp - (o + d * t);
        let r = to_lamp.length();
        // Light travels from the lamp, and on against the ray.
        let cos = (-to_lamp / r).dot(-d);
        let phase =
            (1.0 - g * g) / (4.0 * std::f64::consts::PI * float::powf(1.0 + g * g - 2.0 * g * cos, 1.5));
        sigma_s * phase * intensity(-to_lamp / r) / (r * r) * float::exp(-sigma_t * (t + r))
    };
    integrate(integrand, 0.0, length, 20_000)
}

pub fn fog_world(kit: &mut SceneKit) -> World {
    volume(kit, "fog", 1.0, SIGMA_A, SIGMA_S, G);
    kit.description.surrounding = Some("fog".into());
    kit.world()
}
