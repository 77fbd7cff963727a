//! Weights by brute force: for paths of the renderer's own photons, what each way to make them counts is compared with
//! densities worked out by hand, and must add up to one.

mod by_hand;
mod replay;
mod scenes;
mod ways;

use hyaline_math::DVec3;
use scenes::{Lighting, Making, Stage};
use ways::Shares;

const LIGHTS: [Lighting; 5] =
    [Lighting::Discs, Lighting::Point, Lighting::Spot, Lighting::Directional, Lighting::Sky];

/// Paths that a scene must be good for.
const PATHS: usize = 60;
/// Photons that may be sent for them.
const TRIES: u32 = 6000;

/// Checks a scene; returns how many paths each way made that counts at all.
fn check(stage: &Stage, what: &str) -> [usize; 3] {
    let mut made = [0; 3];
    let paths = replay::compare_all(stage, TRIES, PATHS, |index, found, known| {
        let Shares { hit, sample, merge } = found;
        let sum = hit + sample + merge;
        assert!((sum - 1.0).abs() < 1e-4, "{what}, photon {index}: {found:?} add up to {sum}");
        let pairs = [(hit, known.hit), (sample, known.sample), (merge, known.merge)];
        for (way, (found_share, known_share)) in pairs.into_iter().enumerate() {
            let difference = (found_share - known_share).abs();
            assert!(difference < 2e-3, "{what}, photon {index}: {found:?}, by hand {known:?}");
            made[way] += usize::from(known_share > 0.01);
        }
    });
    assert_eq!(paths, PATHS, "{what}");
    made
}

#[test]
fn weights_through_polished_glass_add_up_to_one() {
    for light in LIGHTS {
        let plate = || Making::new(0.4).plate((0.6, "polished"), (0.9, "polished"));
        check(&plate().lit(light), &format!("plate, {light:?}"));
        let ball = Making::new(0.4).ball(DVec3::new(0.1, 0.8, 0.0), 0.6, "polished");
        check(&ball.lit(light), &format!("ball, {light:?}"));
    }
}

#[test]
fn weights_through_rough_glass_add_up_to_one() {
    for light in LIGHTS {
        for (bottom, top) in [("polished", "ground"), ("ground", "polished"), ("ground", "ground")] {
            let plate = Making::new(0.4).plate((0.6, bottom), (0.9, top));
            check(&plate.lit(light), &format!("plate {bottom} below and {top} above, {light:?}"));
        }
        let ball = Making::new(0.45).ball(DVec3::new(0.1, 0.8, 0.0), 0.6, "ground");
        check(&ball.lit(light), &format!("ground ball, {light:?}"));
    }
}

#[test]
fn weights_in_fog_add_up_to_one() {
    for light in LIGHTS {
        for finish in ["polished", "ground"] {
            let plate = Making::new(0.4).fog().plate((0.6, "polished"), (0.9, finish));
            check(&plate.lit(light), &format!("fog below a plate {finish} above, {light:?}"));
        }
    }
}

#[test]
fn each_way_counts_somewhere() {
    let plate = Making::new(0.45).plate((0.6, "ground"), (0.9, "ground"));
    let made = check(&plate.lit(Lighting::Discs), "each way");
    assert!(made.iter().all(|&paths| paths > 3), "{made:?}");
}
