//! Photons as caustics leave them, and the places at which a picture asks for them.

use hyaline_math::{Vec3, float};
use hyaline_testkit::Random;
use std::f32::consts::TAU;

/// Photons: 40 % of them in caustics on the floor of a room of edge 2, the rest spread over floor, walls and a ball.
pub(crate) fn photons(count: usize) -> Vec<Vec3> {
    let mut random = Random::from_seed(11);
    (0..count)
        .map(|_| match random.uniform() {
            u if u < 0.15 => cusped_curve(&mut random),
            u if u < 0.25 => ring(&mut random),
            u if u < 0.40 => spot(&mut random),
            _ => background(&mut random),
        })
        .collect()
}

/// Places along the rows of a picture that looks down on the floor, the walls' feet and the ball; neighbors in a row are
/// neighbors in the list.
pub(crate) fn along_pixels(count: usize) -> Vec<Vec3> {
    let side = (count as f64).sqrt() as usize;
    (0..side * side)
        .map(|pixel| {
            let (column, row) = (pixel % side, pixel / side);
            let x = 2.2 * (column as f32 + 0.5) / side as f32 - 1.1;
            let z = 2.2 * (row as f32 + 0.5) / side as f32 - 1.1;
            seen_from_above(x, z)
        })
        .collect()
}

/// The same places, shuffled.
pub(crate) fn scattered(count: usize) -> Vec<Vec3> {
    let mut random = Random::from_seed(12);
    let mut places = along_pixels(count);
    for i in (1..places.len()).rev() {
        places.swap(i, (random.uniform() * (i + 1) as f64) as usize);
    }
    places
}

/// The surface under a place of the picture: beyond the floor it climbs the wall.
fn seen_from_above(x: f32, z: f32) -> Vec3 {
    let beyond = (x.abs().max(z.abs()) - 1.0).max(0.0);
    let height2 = BALL_RADIUS * BALL_RADIUS - (x - BALL.x).powi(2) - (z - BALL.z).powi(2);
    let y = if height2 > 0.0 { BALL.y + height2.sqrt() } else { 8.0 * beyond };
    Vec3::new(x.clamp(-1.0, 1.0), y, z.clamp(-1.0, 1.0))
}

const BALL: Vec3 = Vec3::new(0.45, 0.25, -0.4);
const BALL_RADIUS: f32 = 0.25;

/// A nephroid, bright on its inner side.
fn cusped_curve(random: &mut Random) -> Vec3 {
    let (sin, cos) = float::sin_cos(TAU * random.uniform_f32());
    let (sin3, cos3) = (3.0 * sin - 4.0 * sin * sin * sin, 4.0 * cos * cos * cos - 3.0 * cos);
    let inward = 1.0 - 0.3 * random.uniform_f32().powi(4);
    Vec3::new(0.09 * (3.0 * cos - cos3) * inward - 0.4, 0.0, 0.09 * (3.0 * sin - sin3) * inward + 0.3)
}

/// A thin ring.
fn ring(random: &mut Random) -> Vec3 {
    let (sin, cos) = float::sin_cos(TAU * random.uniform_f32());
    let radius = 0.3 + 0.004 * (random.uniform_f32() + random.uniform_f32() - 1.0);
    Vec3::new(0.5 + radius * cos, 0.0, 0.5 + radius * sin)
}

/// One of 30 spots of different sizes.
fn spot(random: &mut Random) -> Vec3 {
    let i = (random.uniform() * 30.0) as u32;
    let mut own = Random::from_seed(u64::from(i));
    let center = Vec3::new(own.uniform_f32() * 1.8 - 0.9, 0.0, own.uniform_f32() * 1.8 - 0.9);
    let size = 0.005 + 0.06 * own.uniform_f32();
    let (sin, cos) = float::sin_cos(TAU * random.uniform_f32());
    center + Vec3::new(cos, 0.0, sin) * (size * random.uniform_f32())
}

/// Floor, four walls, or ball.
fn background(random: &mut Random) -> Vec3 {
    let (a, b) = (2.0 * random.uniform_f32() - 1.0, 2.0 * random.uniform_f32() - 1.0);
    match (random.uniform() * 10.0) as u32 {
        0..=4 => Vec3::new(a, 0.0, b),
        5 => Vec3::new(-1.0, 1.0 + a, b),
        6 => Vec3::new(1.0, 1.0 + a, b),
        7 => Vec3::new(a, 1.0 + b, -1.0),
        8 => Vec3::new(a, 1.0 + b, 1.0),
        _ => BALL + BALL_RADIUS * Vec3::from_array(random.direction().map(|x| x as f32)),
    }
}
