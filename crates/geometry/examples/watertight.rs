//! Looks for leaks in closed meshes with far more rays than the tests have time for.
//!
//! `cargo run --release -p hyaline-geometry --example watertight -- 100000000`

#[path = "../tests/closed/mod.rs"]
mod closed;

use closed::{Closed, SCALES};
use hyaline_testkit::Random;
use rayon::prelude::*;
use std::ops::Add;

/// Rays that one task traces.
const TASK: u64 = 100_000;

/// What was found.
#[derive(Clone, Copy, Default)]
struct Found {
    rays: u64,
    /// Rays that got out of a mesh without crossing it.
    from_inside: u64,
    /// Rays from outside that crossed a mesh an odd number of times.
    from_outside: u64,
    /// Chains of refractions that met a face from the wrong side; the medium set repairs that, so it is no leak.
    astray: u64,
    /// Chains of diffuse reflections inside acute meshes that got out.
    reflected_out: u64,
}

impl Add for Found {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            from_inside: self.from_inside + other.from_inside,
            from_outside: self.from_outside + other.from_outside,
            astray: self.astray + other.astray,
            reflected_out: self.reflected_out + other.reflected_out,
        }
    }
}

fn main() {
    let wanted: u64 = std::env::args().nth(1).and_then(|arg| arg.parse().ok()).unwrap_or(10_000_000);
    let meshes: Vec<Closed> = SCALES.into_iter().flat_map(Closed::all).collect();
    let acute: Vec<Closed> = SCALES.into_iter().flat_map(Closed::acute).collect();
    let found = (0..wanted.div_ceil(TASK))
        .into_par_iter()
        .map(|task| look(&meshes[task as usize % meshes.len()], &acute[task as usize % acute.len()], task))
        .reduce(Found::default, Found::add);
    println!(
        "{} rays through {} meshes: {} leaks from inside, {} from outside, {} by reflection, {} chains astray",
        found.rays,
        meshes.len() + acute.len(),
        found.from_inside,
        found.from_outside,
        found.reflected_out,
        found.astray
    );
    std::process::exit(i32::from(found.from_inside + found.from_outside + found.reflected_out > 0));
}

fn look(closed: &Closed, acute: &Closed, task: u64) -> Found {
    let mut random = Random::from_seed(1000 + task);
    let mut found = Found::default();
    while found.rays < TASK {
        found.from_inside += u64::from(closed.leaks_from_inside(&closed.ray_from_inside(&mut random)));
        let outside = closed.ray_from_outside(&mut random);
        found.from_outside += u64::from(closed.crossings(&outside) % 2 == 1);
        let (count, fits) = closed.follow(&mut random, 64);
        found.astray += u64::from(!fits);
        let (bounces, stays) = acute.bounce(&mut random, 8);
        found.reflected_out += u64::from(!stays);
        found.rays += 2 + count as u64 + bounces as u64;
    }
    found
}
