//! Films are sums: of any grouping, in any order, through any file.

use super::*;
use crate::header::tests::header;
use crate::sample::PixelSample;

/// Numbers in 0…1 from a counter.
fn noise(counter: u64) -> f32 {
    let x = (counter ^ (counter >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (x >> 40) as f32 / (1 << 24) as f32
}

/// The sample of a pass at a pixel: all magnitudes, some misses, rarely a NaN.
pub(crate) fn sample(pass: u32, x: u32, y: u32) -> PixelSample {
    let n = |k: u64| noise((u64::from(pass) << 40) + (u64::from(x) << 24) + (u64::from(y) << 8) + k);
    if n(0) < 0.2 {
        return PixelSample { beauty: [n(1), n(2), n(3)], ..PixelSample::default() };
    }
    let magnitude = 10.0_f32.powi((n(4) * 18.0) as i32 - 9);
    let broken = if n(5) < 0.01 { f32::NAN } else { 0.0 };
    PixelSample {
        beauty: [magnitude * n(6), -0.1 * magnitude * n(7), magnitude + broken],
        albedo: [n(8), n(9), n(10)],
        normal: [n(11) - 0.5, 0.5 - n(12), n(13)],
        depth: Some(1e3 * n(14)),
        object: (n(15) * 5.0) as u32,
    }
}

fn add_pass(film: &mut Film, pass: u32) {
    let crop = film.header.crop;
    // Tiles of three rows, last first.
    let starts: Vec<u32> = (crop.y0..crop.y1).step_by(3).collect();
    for y0 in starts.into_iter().rev() {
        let tile = Rect { y0, y1: (y0 + 3).min(crop.y1), ..crop };
        let samples: Vec<PixelSample> = tile.pixels().map(|(x, y)| sample(pass, x, y)).collect();
        film.add_tile(pass, tile, &samples);
    }
    film.finish_pass(pass).expect("new pass");
}

/// A film of the given passes.
pub(crate) fn film(passes: impl IntoIterator<Item = u32>) -> Film {
    let mut film = Film::new(header(13, 10)).expect("possible frame");
    passes.into_iter().for_each(|pass| add_pass(&mut film, pass));
    film
}

#[test]
fn any_partition_merged_in_any_order_is_the_same_film() {
    let whole = film(0..16);
    assert!(whole.nonfinite() > 0);
    let bytes = whole.to_bytes();
    for round in 0..60_u64 {
        let part_count = 1 + (noise(round) * 6.0) as usize;
        let part_of = |pass: u32| (noise(round * 100 + u64::from(pass)) * part_count as f32) as usize;
        let mut parts: Vec<Film> = (0..part_count)
            .map(|part| {
                let mut passes: Vec<u32> = (0..16).filter(|&pass| part_of(pass) == part).collect();
                passes.sort_by_key(|&pass| noise(round * 1000 + u64::from(pass)).to_bits());
                film(passes)
            })
            .collect();
        while parts.len() > 1 {
            let pick = |k: u64, n: usize| (noise(round * 10_000 + k) * n as f32) as usize;
            let taken = parts.swap_remove(pick(1, parts.len()));
            let target = pick(2, parts.len());
            parts[target].merge(&taken).expect("disjoint");
        }
        assert!(parts[0].to_bytes() == bytes, "round {round}");
    }
}

#[test]
fn tiles_may_come_in_any_shape() {
    let whole = film(3..4);
    let mut tiled = Film::new(whole.header.clone()).expect("possible");
    for (x0, x1) in [(7, 13), (0, 7)] {
        for (y0, y1) in [(0, 1), (1, 10)] {
            let tile = Rect { x0, y0, x1, y1 };
            let samples: Vec<PixelSample> = tile.pixels().map(|(x, y)| sample(3, x, y)).collect();
            tiled.add_tile(3, tile, &samples);
        }
    }
    tiled.finish_pass(3).expect("new");
    assert_eq!(tiled, whole);
}

#[test]
fn a_film_of_a_crop_holds_the_pixels_of_the_whole() {
    let whole = film(0..4);
    let crop = Rect { x0: 5, y0: 2, x1: 11, y1: 7 };
    let mut part = Film::new(FilmHeader { crop, ..header(13, 10) }).expect("possible");
    (0..4).for_each(|pass| add_pass(&mut part, pass));
    for (i, (x, y)) in crop.pixels().enumerate() {
        assert_eq!(part.pixels[i], whole.pixels[(y * 13 + x) as usize]);
    }
    assert!(part.clone().merge(&whole).is_err());
}

#[test]
fn films_survive_their_files() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("a.film");
    for original in [film([]), film([0]), film([0, 1, 2, 9, u32::MAX])] {
        original.write(&path).expect("written");
        assert_eq!(Film::read(&path).expect("read"), original);
    }
    assert!(matches!(Film::read(&folder.path().join("missing.film")), Err(FilmError::Io(_))));
}

#[test]
fn a_pass_is_never_counted_twice() {
    let mut a = film(0..4);
    let before = a.clone();
    let error = a.merge(&film([7, 3])).expect_err("overlap");
    assert_eq!(error.to_string(), "pass 3 would be counted twice");
    assert_eq!(a, before);
    assert!(matches!(a.finish_pass(2), Err(FilmError::PassTwice(2))));
}

#[test]
fn films_of_different_pictures_do_not_merge() {
    let mut other = header(13, 10);
    other.seed = 9;
    let error = film([0]).merge(&Film::new(other).expect("possible")).expect_err("other seed");
    assert!(error.to_string().contains("seed is 1 in one and 9 in the other"), "{error}");
}

#[test]
fn broken_samples_count_as_black_and_are_counted() {
    let mut film = Film::new(header(2, 1)).expect("possible");
    let good = PixelSample { beauty: [1.0; 3], depth: Some(2.0), object: 4, ..PixelSample::default() };
    let bad = PixelSample { beauty: [1.0, f32::INFINITY, 1.0], ..good };
    let far = PixelSample { depth: Some(f32::NAN), ..good };
    film.add_tile(0, film.header.crop, &[good, bad]);
    film.finish_pass(0).expect("new");
    film.add_tile(1, film.header.crop, &[good, far]);
    film.finish_pass(1).expect("new");
    assert_eq!(film.nonfinite(), 2);
    assert_eq!(film.pixels[1], PixelSums::default());
    assert_eq!((film.pixels[0].hits, film.pixels[0].object.id()), (2, 4));
}

#[test]
fn truncated_and_damaged_films_are_refused() {
    let bytes = film(0..3).to_bytes();
    for length in 0..bytes.len() {
        assert!(Film::from_bytes(&bytes[..length]).is_err(), "cut to {length} bytes");
    }
    for i in 0..8000 {
        let mut damaged = bytes.clone();
        let bit = (noise(i) * (8 * bytes.len()) as f32) as usize;
        damaged[bit / 8] ^= 1 << (bit % 8);
        assert!(Film::from_bytes(&damaged).is_err(), "bit {bit}");
    }
    assert!(matches!(Film::from_bytes(b"PNG"), Err(FilmError::NotAFilm)));
    let mut newer = bytes.clone();
    newer[8] = 2;
    assert!(matches!(Film::from_bytes(&newer), Err(FilmError::Version(2))));
}

#[test]
fn forged_films_with_a_right_checksum_never_panic() {
    let bytes = film(0..3).to_bytes();
    let content = &bytes[..bytes.len() - 32];
    let seal = |mut content: Vec<u8>| {
        let hash = blake3::hash(&content);
        content.extend(hash.as_bytes());
        content
    };
    let mut readable = 0;
    for i in 0..20_000_u64 {
        let mut forged = content.to_vec();
        // Half of the changes go to the header, where they hurt most.
        let reach = if i % 2 == 0 { forged.len() } else { 120 };
        for k in 0..1 + i % 3 {
            let at = (noise(10 * i + k) * reach as f32) as usize;
            forged[at] = (noise(10 * i + k + 5) * 256.0) as u8;
        }
        if i % 5 == 0 {
            forged.truncate((noise(10 * i + 9) * forged.len() as f32) as usize);
        }
        if let Ok(film) = Film::from_bytes(&seal(forged)) {
            readable += 1;
            let mut merged = film.clone();
            // Whatever the sums are, using the film does not panic either.
            let _ = merged.merge(&crate::film::tests::film([9]));
            crate::develop(&merged);
            crate::standard_error(&merged);
        }
    }
    assert!(readable > 1000, "the test reaches the sums");
}
