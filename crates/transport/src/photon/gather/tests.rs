//! Estimates in fields of photons whose density is known.
//!
//! Photons are independent of each other: that the n - 1 within the n-th give the right mean holds for such, not for
//! low-discrepancy points, which give about n - 1/2 in the disc of the n-th.

use super::*;
use hyaline_math::{Vec2, float};
use hyaline_scattering::bsdf::{Bsdf, Matte, Sides};
use hyaline_testkit::Random;
use std::f32::consts::PI;

const KERNELS: [Kernel; 4] =
    [Kernel::Constant, Kernel::Cone { k: 1.1 }, Kernel::Gaussian, Kernel::Epanechnikov];

const ANY: fn(PhotonKind) -> bool = |_| true;

fn estimate(kernel: Kernel, nearest: usize) -> Estimate {
    Estimate { kernel, nearest, max_radius: 0.2, collection: Collection::Disc { thickness: 0.25 } }
}

fn photon(p: Vec3, direction: Vec3, flux: f32) -> Photon {
    let flux = Spectrum::from_rgb([flux, 0.5 * flux, 0.25 * flux]);
    Photon { p, direction, flux, kind: PhotonKind::Indirect, bounces: 1 }
}

/// Photons on the unit square at height `z`, with a total flux of `total` in the first lane.
fn sheet(count: usize, z: f32, direction: Vec3, total: f32, random: &mut Random) -> Vec<Photon> {
    let place = |random: &mut Random| Vec3::new(random.uniform_f32(), random.uniform_f32(), z);
    (0..count).map(|_| photon(place(random), direction, total / count as f32)).collect()
}

fn matte(n: Vec3, wo: Vec3) -> SurfaceBsdf {
    let matte = Bsdf::Matte(Matte { reflectance: Spectrum::splat(0.6) });
    SurfaceBsdf::new(matte, n, n, wo, Sides::Both, 3)
}

fn hit(p: Vec3, n: Vec3) -> SurfaceHit {
    SurfaceHit { t: 1.0, p, p_error: 1e-7, ng: n, n, uv: Vec2::ZERO, item: 0, primitive: 0 }
}

/// Centers of `side` × `side` cells that cover the middle of the unit square.
fn cells(side: usize) -> impl Iterator<Item = Vec2> {
    let at = move |i: usize| 0.1 + 0.8 * (i as f32 + 0.5) / side as f32;
    (0..side * side).map(move |i| Vec2::new(at(i % side), at(i / side)))
}

#[test]
fn an_even_field_on_a_plane_gives_one_radiance_with_every_kernel_and_number() {
    let mut random = Random::from_seed(1);
    let slanted = Vec3::new(0.6, 0.0, -0.8);
    let map = PhotonMap::from_photons(&sheet(600_000, 0.0, slanted, 3.0, &mut random), 32);
    let (wo, mut scratch) = (Vec3::new(0.0, 0.6, 0.8), Nearest::new());
    for nearest in [20, 50, 200] {
        for kernel in KERNELS {
            let side = (400_000.0 / nearest as f32).sqrt() as usize;
            let mut sum = 0.0;
            for cell in cells(side) {
                let hit = hit(cell.extend(0.0), Vec3::Z);
                let bsdf = matte(Vec3::Z, wo);
                let gathered = estimate(kernel, nearest).radiance(&map, &hit, &bsdf, wo, ANY, &mut scratch);
                assert_eq!(gathered.found, nearest as u32);
                sum += f64::from(gathered.value[0]);
            }
            let ratio = sum / (side * side) as f64 / f64::from(3.0 * 0.6 / PI);
            assert!((ratio - 1.0).abs() < 0.005, "{kernel:?}, {nearest} nearest: {ratio}");
        }
    }
}

#[test]
fn an_even_field_in_a_medium_gives_one_radiance_with_every_kernel_and_number() {
    let mut random = Random::from_seed(2);
    let place = |random: &mut Random| Vec3::from_array([(); 3].map(|()| random.uniform_f32()));
    let count = 400_000;
    let photons: Vec<Photon> =
        (0..count).map(|_| photon(place(&mut random), Vec3::X, 2.0 / count as f32)).collect();
    let map = PhotonMap::from_photons(&photons, 32);
    let mut scratch = Nearest::new();
    for nearest in [20, 50, 200] {
        for kernel in KERNELS {
            let centers: Vec<Vec3> = (0..400_000 / nearest).map(|_| 0.1 + 0.8 * place(&mut random)).collect();
            let sum: f64 = centers.iter().fold(0.0, |sum, &p| {
                let phase = |_| 0.25 / PI;
                sum + f64::from(
                    estimate(kernel, nearest).volume(&map, p, phase, Clip::whole, &mut scratch).value[0],
                )
            });
            let ratio = sum / centers.len() as f64 / f64::from(2.0 * 0.25 / PI);
            assert!((ratio - 1.0).abs() < 0.005, "{kernel:?}, {nearest} nearest: {ratio}");
        }
    }
}

#[test]
fn where_few_photons_are_all_count_and_the_largest_radius_holds() {
    let at = |x| photon(Vec3::new(x, 0.0, 0.0), -Vec3::Z, 128.0);
    let map = PhotonMap::from_photons(&[at(0.0), at(0.1), at(0.15), at(5.0)], 32);
    let gathered =
        estimate(Kernel::Constant, 10).irradiance(&map, Vec3::ZERO, Vec3::Z, ANY, &mut Nearest::new());
    assert_eq!(gathered.found, 3);
    assert!((gathered.radius - 0.2).abs() < 1e-6);
    assert!((gathered.value[0] / (3.0 * 128.0 / (PI * 0.04)) - 1.0).abs() < 1e-5);
}

#[test]
fn the_photon_that_fixes_the_radius_is_not_counted() {
    let at = |x| photon(Vec3::new(x, 0.0, 0.0), -Vec3::Z, 128.0);
    let map = PhotonMap::from_photons(&[at(0.01), at(0.05), at(0.1), at(0.15)], 32);
    let gathered =
        estimate(Kernel::Constant, 3).irradiance(&map, Vec3::ZERO, Vec3::Z, ANY, &mut Nearest::new());
    assert_eq!((gathered.found, gathered.radius), (3, 0.1));
    assert!((gathered.value[0] / (2.0 * 128.0 / (PI * 0.01)) - 1.0).abs() < 1e-5);
}

#[test]
fn each_side_of_a_thin_wall_is_estimated_as_if_the_other_were_not_there() {
    let mut random = Random::from_seed(3);
    let mut photons = sheet(20_000, 0.0005, -Vec3::Z, 1.0, &mut random);
    photons.extend(sheet(200_000, -0.0005, Vec3::Z, 100.0, &mut random));
    let map = PhotonMap::from_photons(&photons, 32);
    let mut scratch = Nearest::new();
    for (n, expected) in [(Vec3::Z, 1.0), (-Vec3::Z, 100.0)] {
        for collection in [Collection::Sphere, Collection::Disc { thickness: 0.5 }] {
            let estimate = Estimate { collection, ..estimate(Kernel::Constant, 100) };
            let (mut radiance, mut irradiance) = (0.0, 0.0);
            for cell in cells(16) {
                let p = cell.extend(0.0005 * n.z);
                let hit = hit(p, n);
                radiance +=
                    estimate.radiance(&map, &hit, &matte(n, n), n, ANY, &mut scratch).value[0] / 256.0;
                irradiance += estimate.irradiance(&map, p, n, ANY, &mut scratch).value[0] / 256.0;
            }
            assert!((irradiance / expected - 1.0).abs() < 0.02, "{irradiance} for {expected}");
            assert!((radiance * PI / 0.6 / expected - 1.0).abs() < 0.02, "{radiance} for {expected}");
        }
    }
}

#[test]
fn a_surface_that_light_crosses_takes_photons_of_both_sides() {
    let mut random = Random::from_seed(4);
    let mut photons = sheet(1000, 0.0, -Vec3::Z, 1.0, &mut random);
    photons.extend(sheet(1000, 0.0, Vec3::Z, 1.0, &mut random));
    let map = PhotonMap::from_photons(&photons, 32);
    let ground_glass = Bsdf::dielectric(1.5, Spectrum::ONE, Spectrum::ONE, 0.4);
    let bsdf = SurfaceBsdf::new(ground_glass, Vec3::Z, Vec3::Z, Vec3::Z, Sides::Both, 3);
    let (estimate, mut scratch) = (estimate(Kernel::Constant, 2001), Nearest::new());
    let at = hit(Vec3::new(0.5, 0.5, 0.0), Vec3::Z);
    let both = estimate.radiance(&map, &at, &bsdf, Vec3::Z, ANY, &mut scratch);
    let one = estimate.radiance(&map, &at, &matte(Vec3::Z, Vec3::Z), Vec3::Z, ANY, &mut scratch);
    let ratio = both.found as f32 / one.found as f32;
    assert!((ratio - 2.0).abs() < 0.3, "{ratio}");
    assert!(both.value[0] > 0.0);
}

#[test]
fn kinds_that_are_not_asked_for_do_not_count() {
    let mut random = Random::from_seed(5);
    let mut photons = sheet(50_000, 0.0, -Vec3::Z, 1.0, &mut random);
    let caustic = sheet(50_000, 0.0, -Vec3::Z, 7.0, &mut random);
    photons.extend(caustic.into_iter().map(|p| Photon { kind: PhotonKind::Caustic, ..p }));
    let map = PhotonMap::from_photons(&photons, 32);
    let mut scratch = Nearest::new();
    let mean = cells(16).fold(0.0, |sum, cell| {
        let is_wanted = |kind| kind == PhotonKind::Caustic;
        let estimate = estimate(Kernel::Constant, 100);
        sum + estimate.irradiance(&map, cell.extend(0.0), Vec3::Z, is_wanted, &mut scratch).value[0] / 256.0
    });
    assert!((mean / 7.0 - 1.0).abs() < 0.02, "{mean}");
}

#[test]
fn a_disc_leaves_out_what_a_ball_takes_from_the_wall_beside() {
    let mut random = Random::from_seed(6);
    let mut photons = sheet(100_000, 0.0, -Vec3::Z, 1.0, &mut random);
    // A wall along x = 0, lit by light that also comes from above.
    let wall = sheet(100_000, 0.0, Vec3::new(-0.8, 0.0, -0.6), 1.0, &mut random);
    photons.extend(wall.into_iter().map(|p| Photon { p: Vec3::new(0.0, p.p.y, p.p.x), ..p }));
    let map = PhotonMap::from_photons(&photons, 32);
    let mut scratch = Nearest::new();
    let mut mean = |collection| {
        let estimate = Estimate { collection, max_radius: 0.03, ..estimate(Kernel::Constant, 10_000) };
        (0..200).fold(0.0, |sum, i| {
            let p = Vec3::new(0.02, 0.1 + 0.004 * i as f32, 0.0);
            sum + estimate.irradiance(&map, p, Vec3::Z, ANY, &mut scratch).value[0] / 200.0
        })
    };
    let (ball, disc) = (mean(Collection::Sphere), mean(Collection::Disc { thickness: 0.05 }));
    // Of the ball's disc on the floor 5/6 or so is floor, and the wall adds a good part; the thin disc sees next to none.
    let floor = 1.0 - (float::acos(2.0 / 3.0) - 2.0 / 3.0 * (5.0_f32 / 9.0).sqrt()) / PI;
    assert!(ball > 1.1 * floor, "{ball} {floor}");
    assert!((disc / floor - 1.0).abs() < 0.06, "{disc} {floor}");
}

#[test]
fn photons_that_coincide_give_a_finite_estimate() {
    for place in [Vec3::ZERO, Vec3::ONE] {
        let map = PhotonMap::from_photons(&[photon(place, -Vec3::Z, 1.0); 100], 32);
        let mut scratch = Nearest::new();
        let on_surface = estimate(Kernel::Gaussian, 50).irradiance(&map, place, Vec3::Z, ANY, &mut scratch);
        assert!(on_surface.value.is_finite() && on_surface.value[0] > 0.0);
        let in_medium =
            estimate(Kernel::Gaussian, 50).volume(&map, place, |_| 1.0, Clip::whole, &mut scratch);
        assert!(in_medium.value.is_finite() && in_medium.value[0] > 0.0);
    }
}

#[test]
fn an_empty_map_gives_nothing() {
    let map = PhotonMap::from_photons(&[], 32);
    let unlimited = Estimate { max_radius: f32::INFINITY, ..estimate(Kernel::Cone { k: 1.0 }, 50) };
    for estimate in [estimate(Kernel::Constant, 50), unlimited] {
        let gathered = estimate.irradiance(&map, Vec3::ZERO, Vec3::Z, ANY, &mut Nearest::new());
        assert_eq!((gathered.value, gathered.found), (Spectrum::ZERO, 0));
    }
}
