//! Density and choice of a guide.

use super::*;
use hyaline_testkit::Random;

const LEAST_GAIN: f64 = 8.0;

fn numbers(random: &mut Random) -> [f32; START_NUMBERS] {
    std::array::from_fn(|_| random.uniform_f32())
}

/// Light in one corner of two of the axes.
fn corner() -> Guide {
    let mut random = Random::from_seed(5);
    let found: Vec<Found> = (0..4000)
        .map(|_| {
            let numbers = numbers(&mut random);
            let is_there = numbers[1] < 0.1 && numbers[3] > 0.8;
            Found { numbers, worth: if is_there { 1.0 + numbers[0] } else { 0.0 } }
        })
        .collect();
    Guide::learn(&found, LEAST_GAIN)
}

#[test]
fn numbers_are_drawn_with_the_density_that_is_told() {
    let guide = corner();
    let mut random = Random::from_seed(6);
    const CELLS: usize = 8;
    let cell = |u: f32| (u * CELLS as f32) as usize;
    let (mut drawn, mut told) = ([[0.0; CELLS]; CELLS], [[0.0; CELLS]; CELLS]);
    const N: usize = 400_000;
    let mut rounded = 0;
    for _ in 0..N {
        let u = numbers(&mut random);
        let (at, density) = guide.warp(u);
        rounded += usize::from(guide.density(&at) != density);
        drawn[cell(at[1])][cell(at[3])] += 1.0;
        told[cell(u[1])][cell(u[3])] += f64::from(guide.density(&u));
    }
    assert!(
        rounded < N / 10_000,
        "only numbers that are rounded to the edge of a box lie in the next: {rounded}"
    );
    // Both sides are counts with noise of their own; the told one, of evenly spread numbers, has the larger.
    for (drawn, told) in drawn.iter().flatten().zip(told.iter().flatten()) {
        let sigma = (told * (1.0 + told * (CELLS * CELLS) as f64 / N as f64)).sqrt();
        assert!((drawn - told).abs() < 5.0 * sigma, "{drawn} {told}");
    }
}

#[test]
fn photons_go_where_light_was_found() {
    let guide = corner();
    let mut random = Random::from_seed(7);
    let hits = (0..10_000).filter(|_| {
        let at = guide.warp(numbers(&mut random)).0;
        at[1] < 0.1 && at[3] > 0.8
    });
    let share = hits.count() as f64 / 1e4;
    assert!(share > 0.3, "2 % unguided, {share} guided");
}

#[test]
fn nothing_is_left_out() {
    let guide = corner();
    let mut random = Random::from_seed(8);
    let least = (0..10_000).map(|_| guide.density(&numbers(&mut random))).fold(f32::MAX, f32::min);
    assert!(least >= EVEN_SHARE as f32 * 0.999, "{least}");
}

#[test]
fn nothing_found_is_nothing_known() {
    let mut random = Random::from_seed(9);
    let none = [Found { numbers: numbers(&mut random), worth: 0.0 }; 100];
    assert_eq!(Guide::learn(&none, LEAST_GAIN), Guide::default());
    assert_eq!(Guide::learn(&[], LEAST_GAIN), Guide::default());
    let u = numbers(&mut random);
    assert_eq!(Guide::default().warp(u), (u, 1.0));
}

#[test]
fn light_that_is_found_nearly_everywhere_needs_no_guide() {
    let mut random = Random::from_seed(10);
    let found: Vec<Found> = (0..4000)
        .map(|_| numbers(&mut random))
        .map(|numbers| Found { numbers, worth: 1.0 + numbers[2] })
        .collect();
    assert_eq!(Guide::learn(&found, LEAST_GAIN), Guide::default());
}
