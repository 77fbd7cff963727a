//! A photon at rest: what is known of it where it met a surface or was scattered, in 20 bytes.
//!
//! The position stays in `f32`, as estimates divide by areas as small as rounding allows. Beside it:
//!
//! 1. Flux: four 8-bit mantissas under one exponent, the smallest that holds the largest lane. Each mantissa is rounded
//!    up with a probability equal to what would be cut off, by a hash of the position, so that the mean of many photons
//!    is right however dim a lane is. No lane is off by more than 1/127 of the largest.
//! 2. Direction: the octahedron's square, 1023 × 1023 places. The axes are exact; no direction is off by more than a
//!    quarter of a degree.
//! 3. Kind and number of bounces together, as a kind has no bounces, or at least one: 16 values.

use bytemuck::{Pod, Zeroable};
use hyaline_math::{Vec2, Vec3};
use hyaline_sampling::Rng;
use hyaline_spectrum::Spectrum;

/// What a photon met before it came here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhotonKind {
    /// Nothing: it came straight from the light, at most through boundaries that don't bend it.
    Direct,
    /// Polished or nearly polished surfaces only, one at least.
    Caustic,
    /// Something that scatters, at least once.
    Indirect,
}

/// A photon where it met a surface or was scattered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// Where, scene units.
    pub p: Vec3,
    /// The way it traveled, unit: toward the surface.
    pub direction: Vec3,
    /// Power, W per lane, ≥ 0. On a surface what arrives; in a medium what leaves: the single-scattering albedo is in it.
    pub flux: Spectrum,
    /// What it met before.
    pub kind: PhotonKind,
    /// Bounces before this place; more than 7 (`Caustic`) or 8 (`Indirect`) are kept as that, and 0 if `Direct`.
    pub bounces: u32,
}

/// A photon without its position, as maps keep it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct PackedPhoton {
    /// Flux of each lane over the scale.
    mantissas: [u8; 4],
    /// From the lowest bit: 10 and 10 bits of direction, 4 of kind and bounces, 8 of the exponent.
    word: u32,
}

/// Steps from the middle of the octahedron's square to its edge.
const DIRECTION_STEPS: f32 = 511.0;

/// Exponents are kept with this added; that of the least scale is 1, and 0 means no flux.
const EXPONENT_BIAS: i32 = 127;

impl Photon {
    /// The photon as maps keep it: its position and the rest.
    pub fn pack(&self) -> (Vec3, PackedPhoton) {
        let (mantissas, exponent) = pack_flux(self.flux, dither(self.p));
        let [x, y] = pack_direction(self.direction);
        let history = pack_history(self.kind, self.bounces);
        (self.p, PackedPhoton { mantissas, word: x | y << 10 | history << 20 | exponent << 24 })
    }
}

impl PackedPhoton {
    /// The photon, with the rounding of its record.
    pub fn unpack(self, p: Vec3) -> Photon {
        Photon {
            p,
            direction: self.direction(),
            flux: self.flux(),
            kind: self.kind(),
            bounces: self.bounces(),
        }
    }

    /// Power, W per lane.
    #[inline]
    pub fn flux(self) -> Spectrum {
        // The exponent of a stored photon is that of an `f32`, so its bits are the scale.
        let scale = f32::from_bits((self.word >> 24) << 23);
        Spectrum::from_lanes(self.mantissas.map(|mantissa| f32::from(mantissa) * scale))
    }

    /// The way it traveled, unit.
    #[inline]
    pub fn direction(self) -> Vec3 {
        self.octahedron_point().normalize()
    }

    /// Whether it arrived from the side that `n` points to.
    #[inline]
    pub fn arrives_from(self, n: Vec3) -> bool {
        self.octahedron_point().dot(n) < 0.0
    }

    /// What it met before.
    #[inline]
    pub fn kind(self) -> PhotonKind {
        match self.history() {
            0 => PhotonKind::Direct,
            1..=7 => PhotonKind::Caustic,
            _ => PhotonKind::Indirect,
        }
    }

    /// Bounces before this place, as far as they are kept: see [`Photon::bounces`].
    #[inline]
    pub fn bounces(self) -> u32 {
        match self.history() {
            history @ 0..=7 => history,
            history => history - 7,
        }
    }

    fn history(self) -> u32 {
        self.word >> 20 & 15
    }

    /// The direction, with its length measured along the axes.
    #[inline]
    fn octahedron_point(self) -> Vec3 {
        let at = |shift: u32| ((self.word >> shift & 1023) as f32 - DIRECTION_STEPS) / DIRECTION_STEPS;
        let (x, y) = (at(0), at(10));
        let z = 1.0 - x.abs() - y.abs();
        // Below the middle the corners of the square are folded down.
        let fold = (-z).max(0.0);
        Vec3::new(x - fold.copysign(x), y - fold.copysign(y), z)
    }
}

/// Kind and bounces in 4 bits: 0 direct, 1…7 caustic, 8…15 indirect.
fn pack_history(kind: PhotonKind, bounces: u32) -> u32 {
    match kind {
        PhotonKind::Direct => 0,
        PhotonKind::Caustic => bounces.clamp(1, 7),
        PhotonKind::Indirect => 7 + bounces.clamp(1, 8),
    }
}

/// The nearest place of the octahedron's square, 0…1022 each way.
///
/// Source: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014.
fn pack_direction(direction: Vec3) -> [u32; 2] {
    let on_octahedron = direction / direction.abs().element_sum();
    let Vec3 { x, y, z } = on_octahedron;
    let square = if z < 0.0 {
        Vec2::new((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y))
    } else {
        Vec2::new(x, y)
    };
    // A direction that is not a number ends in a corner; `as` saturates.
    (square * DIRECTION_STEPS + DIRECTION_STEPS + 0.5).to_array().map(|steps| (steps as u32).min(1022))
}

/// Mantissas and the biased exponent of their scale. Negative lanes count as 0; so does a flux that is not finite.
fn pack_flux(flux: Spectrum, dither: [f32; 4]) -> ([u8; 4], u32) {
    let largest = flux.max_lane(4);
    if !(flux.is_finite() && largest > 0.0) {
        return ([0; 4], 0);
    }
    let exponent = scale_exponent(largest);
    // In `f64`, as the inverse of the least scale is beyond `f32`.
    let inverse = f64::from_bits(((1023 - exponent) as u64) << 52);
    let units = |lane: usize| f64::from(flux[lane].max(0.0)) * inverse;
    let mantissas = std::array::from_fn(|lane| (units(lane) + f64::from(dither[lane])) as u8);
    (mantissas, (exponent + EXPONENT_BIAS) as u32)
}

/// The least exponent for which no lane exceeds 255 units, so that dithering never leaves 8 bits.
fn scale_exponent(largest: f32) -> i32 {
    // largest is in [2^e, 2^(e+1)), so that it is 128…256 units of 2^(e-7).
    let exponent = (largest.to_bits() >> 23) as i32 - 127 - 7;
    let is_above = largest.to_bits() & 0x7f_ffff > 0x7f_0000;
    (exponent + i32::from(is_above)).max(1 - EXPONENT_BIAS)
}

/// Four numbers in [0, 1) that depend on the position alone.
fn dither(p: Vec3) -> [f32; 4] {
    let [x, y, z] = p.to_array().map(|coordinate| u64::from(coordinate.to_bits()));
    let bits = Rng::new(x << 32 | y, z).next_u64();
    [0, 16, 32, 48].map(|shift| (bits >> shift & 0xffff) as f32 / 65536.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{Moments, Random};

    fn photon(p: Vec3, direction: Vec3, flux: [f32; 4]) -> Photon {
        let flux = Spectrum::from_lanes(flux);
        Photon { p, direction, flux, kind: PhotonKind::Direct, bounces: 0 }
    }

    fn random_point(random: &mut Random) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| 10.0 * random.uniform_f32() - 5.0))
    }

    fn packed_flux(flux: [f32; 4], random: &mut Random) -> [f32; 4] {
        photon(random_point(random), Vec3::Z, flux).pack().1.flux().to_lanes()
    }

    #[test]
    fn a_photon_takes_20_bytes() {
        assert_eq!(size_of::<(Vec3, PackedPhoton)>(), 20);
    }

    #[test]
    fn no_lane_is_off_by_more_than_a_127th_of_the_largest() {
        let mut random = Random::from_seed(1);
        for size in [1e-37_f32, 1e-30, 1e-6, 1.0, 255.0, 256.0, 1e20, 3e38] {
            for _ in 0..5000 {
                let flux = [size, size * random.uniform_f32(), size * random.uniform_f32().powi(8), 0.0];
                let flux = flux.map(|lane| lane * (0.5 + 0.5 * random.uniform_f32()));
                let largest = flux.into_iter().fold(0.0, f32::max);
                for (lane, packed) in flux.into_iter().zip(packed_flux(flux, &mut random)) {
                    assert!((lane - packed).abs() <= largest / 127.0 + f32::MIN_POSITIVE, "{lane} {packed}");
                }
            }
        }
    }

    #[test]
    fn packing_keeps_the_mean_of_every_lane() {
        let mut random = Random::from_seed(2);
        for flux in [[1.0, 0.503, 0.003, 0.0], [0.9999, 0.1, 0.0101, 1e-4], [1e-30, 7e-31, 1e-33, 0.0]] {
            let mut moments = [(); 4].map(|()| Moments::new());
            for _ in 0..100_000 {
                for (moments, lane) in moments.iter_mut().zip(packed_flux(flux, &mut random)) {
                    moments.push(f64::from(lane));
                }
            }
            for (moments, lane) in moments.iter().zip(flux) {
                let error = (moments.mean() - f64::from(lane)).abs();
                assert!(
                    error <= 4.0 * moments.variance_of_mean().sqrt() + 1e-7 * f64::from(lane),
                    "{lane} {error}"
                );
            }
        }
    }

    #[test]
    fn the_record_depends_on_the_photon_alone() {
        let photon = photon(Vec3::new(0.1, 0.2, 0.3), Vec3::X, [0.3, 0.2, 0.1, 0.0]);
        assert_eq!(photon.pack(), photon.pack());
    }

    #[test]
    fn flux_that_is_no_number_or_negative_is_none() {
        let mut random = Random::from_seed(3);
        for flux in [[f32::NAN, 1.0, 1.0, 0.0], [f32::INFINITY, 1.0, 1.0, 0.0], [-1.0; 4], [0.0; 4]] {
            assert_eq!(packed_flux(flux, &mut random), [0.0; 4]);
        }
        assert_eq!(packed_flux([1.0, -1.0, 0.5, 0.0], &mut random)[1], 0.0);
    }

    #[test]
    fn no_direction_is_off_by_more_than_a_quarter_of_a_degree() {
        let mut random = Random::from_seed(4);
        let mut largest = 0.0_f64;
        for _ in 0..300_000 {
            let direction = Vec3::from_array(random.direction().map(|x| x as f32));
            let packed = photon(Vec3::ZERO, direction, [1.0; 4]).pack().1;
            assert!((packed.direction().length() - 1.0).abs() < 1e-6);
            largest = largest.max(f64::from(packed.direction().distance(direction)).to_degrees());
        }
        assert!(largest < 0.25 && largest > 0.2, "{largest}");
    }

    #[test]
    fn directions_along_the_axes_are_exact() {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            for direction in [axis, -axis] {
                assert_eq!(photon(Vec3::ZERO, direction, [1.0; 4]).pack().1.direction(), direction);
            }
        }
    }

    #[test]
    fn a_photon_arrives_from_the_side_that_it_traveled_away_from() {
        let mut random = Random::from_seed(5);
        for _ in 0..10_000 {
            let direction = Vec3::from_array(random.direction().map(|x| x as f32));
            let n = Vec3::from_array(random.direction().map(|x| x as f32));
            let packed = photon(Vec3::ZERO, direction, [1.0; 4]).pack().1;
            if direction.dot(n).abs() > 0.01 {
                assert_eq!(packed.arrives_from(n), direction.dot(n) < 0.0);
            }
        }
    }

    #[test]
    fn kinds_and_bounces_are_kept() {
        let mut photon = photon(Vec3::ONE, -Vec3::Z, [1.0; 4]);
        let known = [
            (PhotonKind::Direct, 0, 0),
            (PhotonKind::Caustic, 1, 1),
            (PhotonKind::Caustic, 7, 7),
            (PhotonKind::Caustic, 100, 7),
            (PhotonKind::Indirect, 1, 1),
            (PhotonKind::Indirect, 8, 8),
            (PhotonKind::Indirect, 1000, 8),
        ];
        for (kind, bounces, kept) in known {
            (photon.kind, photon.bounces) = (kind, bounces);
            let (p, packed) = photon.pack();
            let unpacked = packed.unpack(p);
            assert_eq!((unpacked.kind, unpacked.bounces), (kind, kept));
            assert_eq!((unpacked.p, unpacked.direction), (photon.p, photon.direction));
        }
    }
}
