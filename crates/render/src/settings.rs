//! What a description says about rendering, in the words of the integrators.

use hyaline_transport::RenderSettings;

/// The settings of a description; what it leaves open gets the integrators' defaults.
pub fn render_settings(description: &hyaline_scene::Settings) -> RenderSettings {
    let defaults = RenderSettings::default();
    RenderSettings {
        seed: description.seed,
        sampler: match description.sampler {
            hyaline_scene::SamplerKind::Sobol => hyaline_sampling::SamplerKind::Sobol,
            hyaline_scene::SamplerKind::Independent => hyaline_sampling::SamplerKind::Independent,
        },
        max_depth: description.max_depth,
        min_weight: description.min_weight.unwrap_or(defaults.min_weight),
        light_samples: description.light_samples.unwrap_or(defaults.light_samples).max(1),
        march: description.march,
        photon_map: description.photon_map,
        debug: description.debug,
        techniques: description.techniques,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_description_means_the_defaults() {
        assert_eq!(render_settings(&hyaline_scene::Settings::default()), RenderSettings::default());
    }
}
