//! All lights of a scene, and the choice among them.

use super::Light;
use hyaline_sampling::Distribution1d;

/// Share of the choices for direct light that go to all lights alike.
///
/// Power alone is a bad guide to what a light does at a place: that of an environment grows with the size of the
/// scene, that of a lamp nearby does not. With this share every one of n lights has a chance of at least 1 / 2n, so
/// neither the lamp nor the sky is starved, and no chance is less than half of what power alone would give.
pub const DIRECT_UNIFORM_SHARE: f32 = 0.5;

/// The lights of a scene.
#[derive(Clone, Debug, Default)]
pub struct LightSet {
    lights: Vec<Light>,
    environments: Vec<u32>,
    powerful: Vec<u32>,
    any_can_be_met: bool,
    direct: LightSampler,
    emission: LightSampler,
}

impl LightSet {
    /// Prepares the choice among some lights.
    ///
    /// - `lanes`: how many lanes of a spectrum count.
    pub fn new(lights: Vec<Light>, lanes: usize) -> Self {
        let powers: Vec<f32> = lights.iter().map(|light| light.power().mean(lanes)).collect();
        let is_environment = |light: &Light| matches!(light, Light::Environment(_));
        let environments = (0..).zip(&lights).filter(|(_, light)| is_environment(light)).map(|(i, _)| i);
        let direct = LightSampler::new(&powers, DIRECT_UNIFORM_SHARE);
        Self {
            environments: environments.collect(),
            powerful: (0..lights.len() as u32).filter(|&i| direct.probability(i as usize) > 0.0).collect(),
            any_can_be_met: lights.iter().any(Light::can_be_met),
            direct,
            emission: LightSampler::new(&powers, 0.0),
            lights,
        }
    }

    /// The lights, in the order they were given.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// A light by its index.
    ///
    /// # Panics
    /// Where there is no such light.
    pub fn get(&self, index: usize) -> &Light {
        &self.lights[index]
    }

    /// Whether there is a light that rays come to by themselves: one with a surface, or an environment.
    pub fn any_can_be_met(&self) -> bool {
        self.any_can_be_met
    }

    /// Indices of the lights that rays meet where they meet nothing else.
    pub fn environments(&self) -> &[u32] {
        &self.environments
    }

    /// The choice of a light to sample directly: by power and, in part, evenly.
    pub fn direct(&self) -> &LightSampler {
        &self.direct
    }

    /// Indices of the lights that have power.
    pub fn powerful(&self) -> &[u32] {
        &self.powerful
    }

    /// The choice of a light to emit from: by power, so that all photons carry about the same.
    pub fn emission(&self) -> &LightSampler {
        &self.emission
    }
}

/// A light that was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightChoice {
    /// Index of the light.
    pub index: usize,
    /// Chance of this choice, > 0…1; of several, how often the light is among them on the mean.
    pub probability: f32,
    /// The random number again, uniform in [0, 1) and independent of the choice.
    pub u: f32,
}

/// A choice among lights; lights without power are never chosen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightSampler {
    /// `None` where no light has power.
    distribution: Option<Distribution1d>,
}

impl LightSampler {
    /// The choice among lights of these powers.
    ///
    /// - `powers`: mean over lanes, W; what is not a positive number counts as 0, what is infinite as very much.
    /// - `uniform_share`: share of the choices, 0…1, that go to all lights with power alike; the rest goes by power.
    pub fn new(powers: &[f32], uniform_share: f32) -> Self {
        let valid = |&power: &f32| if power > 0.0 { f64::from(power.min(f32::MAX)) } else { 0.0 };
        let powers: Vec<f64> = powers.iter().map(valid).collect();
        let total: f64 = powers.iter().sum();
        let count = powers.iter().filter(|&&power| power > 0.0).count() as f64;
        let share = f64::from(uniform_share);
        let weights = powers
            .iter()
            .map(|&power| if power > 0.0 { share / count + (1.0 - share) * power / total } else { 0.0 });
        Self { distribution: Distribution1d::from_f64(weights).ok() }
    }

    /// Chooses a light; `None` where none has power.
    ///
    /// - `u`: uniform in [0, 1).
    pub fn sample(&self, u: f32) -> Option<LightChoice> {
        let pick = self.distribution.as_ref()?.sample(u);
        Some(LightChoice { index: pick.index, probability: pick.probability, u: pick.u })
    }

    /// Chance that a light is chosen, 0…1.
    pub fn probability(&self, index: usize) -> f32 {
        self.distribution.as_ref().map_or(0.0, |distribution| distribution.probability(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{EnvironmentLight, PointLight, SceneSphere};
    use hyaline_math::Vec3;
    use hyaline_spectrum::Spectrum;
    use hyaline_testkit::{Random, chi_square};

    #[test]
    fn lights_are_chosen_at_their_probabilities() {
        let powers = [1.0, 0.0, 10.0, f32::NAN, 1e-6, -3.0];
        for share in [0.0, DIRECT_UNIFORM_SHARE, 1.0] {
            let sampler = LightSampler::new(&powers, share);
            let mut random = Random::from_seed(1);
            let mut counts = [0.0; 6];
            for _ in 0..100_000 {
                let choice = sampler.sample(random.uniform_f32()).unwrap();
                assert_eq!(choice.probability, sampler.probability(choice.index));
                assert!((0.0..1.0).contains(&choice.u));
                counts[choice.index] += 1.0;
            }
            let expected: [f64; 6] = std::array::from_fn(|i| 1e5 * f64::from(sampler.probability(i)));
            assert!(chi_square(&counts, &expected, 5.0).p_value > 1e-3, "share {share}: {counts:?}");
            assert_eq!([counts[1], counts[3], counts[5]], [0.0; 3]);
        }
    }

    #[test]
    fn neither_a_faint_nor_a_strong_light_is_starved() {
        let sampler = LightSampler::new(&[1e-9, 1e9], DIRECT_UNIFORM_SHARE);
        assert!((sampler.probability(0) - 0.25).abs() < 1e-6);
        assert!((sampler.probability(1) - 0.75).abs() < 1e-6);
    }

    #[test]
    fn the_choice_to_emit_goes_by_power() {
        let light = |power: f32| {
            let intensity = Spectrum::splat(power / (4.0 * std::f32::consts::PI));
            Light::Point(PointLight { position: Vec3::ZERO, intensity })
        };
        let set = LightSet::new(vec![light(1.0), light(3.0)], 3);
        assert!((set.emission().probability(1) - 0.75).abs() < 1e-6);
        assert!((set.direct().probability(1) - 0.625).abs() < 1e-6);
    }

    #[test]
    fn lights_without_power_are_left_out() {
        let light =
            |power: f32| Light::Point(PointLight { position: Vec3::ZERO, intensity: Spectrum::splat(power) });
        let of = |powers: &[f32]| LightSet::new(powers.iter().map(|&power| light(power)).collect(), 3);
        assert_eq!(of(&[1.0, 0.0, 3.0]).powerful(), [0, 2]);
        assert!(of(&[]).powerful().is_empty());
    }

    #[test]
    fn without_light_nothing_is_chosen() {
        for set in [LightSet::new(Vec::new(), 3), LightSet::default()] {
            assert_eq!(set.direct().sample(0.5), None);
            assert_eq!(set.emission().probability(0), 0.0);
            assert!(set.environments().is_empty());
        }
        assert_eq!(LightSampler::new(&[0.0, 0.0], 0.5).sample(0.3), None);
        assert_eq!(LightSampler::new(&[f32::INFINITY], 0.5).sample(0.3).unwrap().probability, 1.0);
    }

    #[test]
    fn all_surroundings_are_found() {
        let scene = SceneSphere { center: Vec3::ZERO, radius: 1.0 };
        let sky = |l: f32| Light::Environment(EnvironmentLight::from_constant(Spectrum::splat(l), scene));
        let set = LightSet::new(vec![sky(1.0), sky(2.0)], 3);
        assert_eq!(set.environments(), [0, 1]);
    }
}
