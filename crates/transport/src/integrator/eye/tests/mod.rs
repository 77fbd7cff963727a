//! Weights by brute force: for paths of the renderer's own photons, what each way to make them counts is compared with
//! densities worked out by hand, and must add up to one.

mod by_hand;
mod flight;
mod replay;
mod scenes;
mod ways;

use by_hand::{Finish, Turn};
use hyaline_math::DVec3;
use scenes::{Lighting, Making, Stage};

const LIGHTS: [Lighting; 6] = [
    Lighting::Discs,
    Lighting::ManyDiscs,
    Lighting::Point,
    Lighting::Spot,
    Lighting::Directional,
    Lighting::Sky,
];

/// Paths that a scene must be good for.
const PATHS: usize = 80;
/// Photons that may be sent for each of them.
const TRIES: usize = 100;

/// Paths that each kind of way made that counts at all.
#[derive(Debug, Default)]
struct Made {
    hits: usize,
    samples: usize,
    merges: usize,
    /// Merges behind something that scatters widely, on surfaces.
    indirect: usize,
    /// Merges of beams: all, and those straight from the light.
    beams: [usize; 2],
    /// Paths that may be merged at several vertices, two of which count.
    shared: usize,
}

impl Made {
    fn add(&mut self, turns: &[Turn], known: &ways::Shares) {
        let counts = |share: f64| usize::from(share > 0.01);
        self.hits += counts(known.hit);
        self.samples += counts(known.sample);
        for (i, &share) in known.merges.iter().enumerate() {
            let is_beam = matches!(turns[i].finish, Finish::Fog(_));
            self.merges += counts(share);
            self.beams[0] += usize::from(is_beam) * counts(share);
            self.beams[1] += usize::from(is_beam && i == 0) * counts(share);
            let is_indirect = !is_beam && turns[..i].iter().any(Turn::is_wide);
            self.indirect += usize::from(is_indirect) * counts(share);
        }
        self.shared += usize::from(known.merges.iter().filter(|&&share| share > 0.01).count() > 1);
    }
}

/// Checks a scene.
fn check(stage: &Stage, what: &str) -> Made {
    check_many(stage, PATHS, what)
}

fn check_many(stage: &Stage, number: usize, what: &str) -> Made {
    let mut made = Made::default();
    let paths = replay::compare_all(stage, (TRIES * number) as u32, number, |index, chain, found, known| {
        let sum: f64 = found.all().sum();
        let told =
            || format!("{what}, photon {index}: {found:?}, by hand {known:?}, over {:#?}", chain.turns);
        assert!((sum - 1.0).abs() < 1e-4, "{sum}, {}", told());
        for (found_share, known_share) in found.all().zip(known.all()) {
            let difference = (found_share - known_share).abs();
            assert!(difference < 2e-3 * known_share.sqrt() + 1e-6, "{}", told());
        }
        made.add(&chain.turns, known);
    });
    assert_eq!(paths, number, "{what}");
    made
}

#[test]
fn weights_through_polished_glass_add_up_to_one() {
    for light in LIGHTS {
        let plate = || Making::new(0.4).plate((0.6, "polished"), (0.9, "polished")).wall();
        check(&plate().lit(light), &format!("plate, {light:?}"));
        let ball = Making::new(0.4).ball(DVec3::new(0.1, 0.8, 0.0), 0.6, "polished").wall();
        check(&ball.lit(light), &format!("ball, {light:?}"));
    }
}

#[test]
fn weights_through_rough_glass_add_up_to_one() {
    for light in LIGHTS {
        for (bottom, top) in [("polished", "ground"), ("ground", "polished"), ("ground", "ground")] {
            let plate = Making::new(0.4).plate((0.6, bottom), (0.9, top)).wall();
            check(&plate.lit(light), &format!("plate {bottom} below and {top} above, {light:?}"));
        }
        let ball = Making::new(0.45).ball(DVec3::new(0.1, 0.8, 0.0), 0.6, "ground").wall();
        check(&ball.lit(light), &format!("ground ball, {light:?}"));
    }
}

#[test]
fn weights_over_wide_glass_add_up_to_one() {
    for light in LIGHTS {
        let plate = Making::new(0.6).plate((0.6, "polished"), (0.9, "ground")).wall();
        check(&plate.lit(light), &format!("wide plate, {light:?}"));
    }
}

#[test]
fn weights_in_fog_add_up_to_one() {
    for light in LIGHTS {
        for finish in ["polished", "ground"] {
            let plate = Making::new(0.4).fog().plate((0.6, "polished"), (0.9, finish)).wall();
            check(&plate.lit(light), &format!("fog about a plate {finish} above, {light:?}"));
        }
    }
}

#[test]
fn weights_in_smoke_add_up_to_one() {
    for light in LIGHTS {
        let plate = Making::new(0.4).smoke().plate((0.6, "polished"), (0.9, "ground")).wall();
        check(&plate.lit(light), &format!("smoke, {light:?}"));
    }
}

#[test]
fn each_way_counts_somewhere() {
    let plate = || Making::new(0.45).plate((0.6, "ground"), (0.9, "ground")).wall();
    let made = check_many(&plate().lit(Lighting::Discs), 10 * PATHS, "each way");
    println!("{made:?}");
    let few = [made.hits, made.samples, made.merges, made.indirect, made.shared];
    assert!(few.iter().all(|&paths| paths > 3), "{made:?}");
    let made = check_many(&plate().fog().lit(Lighting::Discs), 10 * PATHS, "each way in fog");
    assert!([made.hits, made.samples].iter().chain(&made.beams).all(|&paths| paths > 3), "{made:?}");
}
