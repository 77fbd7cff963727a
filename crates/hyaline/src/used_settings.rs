//! Which settings an integrator uses: all that its films depend on, and what to tell of the others.

use hyaline_scene::{Located, MediumDescription, PhotonMapSettings, ProjectionMaps, Settings, Techniques};
use hyaline_transport::RenderSettings;
use hyaline_transport::integrator::debug::shows_photons;

/// The settings that decide on the pictures of an integrator, in words that differ where they do.
pub(crate) fn in_words(integrator: &str, settings: &RenderSettings) -> String {
    let mut words = format!("sampler {:?}, max_depth {:?}", settings.sampler, settings.max_depth);
    if integrator == WHITTED {
        let RenderSettings { min_weight, light_samples, .. } = settings;
        words.push_str(&format!(", min_weight {min_weight}, light_samples {light_samples}"));
    }
    if integrator == DEBUG {
        words.push_str(&format!(", debug {:?}", settings.debug));
    }
    if MARCHING.contains(&integrator) {
        words.push_str(&format!(", march {:?}", settings.march));
    }
    if PATHS.contains(&integrator) && settings.techniques != Techniques::default() {
        words.push_str(&format!(", {:?}", settings.techniques));
    }
    if uses_photon_map(integrator, settings) {
        words.push_str(&format!(", photon_map {:?}", settings.photon_map));
    }
    words
}

/// What an integrator leaves out of the light that media send out, where the scene has such light.
pub(crate) fn unseen_light(integrator: &str, media: &[Located<MediumDescription>]) -> Option<String> {
    if !MARCHING.contains(&integrator) {
        return None;
    }
    let shines = |medium: &MediumDescription| medium.emission != [0.0; 3];
    let names: Vec<String> =
        media.iter().filter(|medium| shines(medium)).map(|medium| format!("'{}'", medium.name)).collect();
    let list = names.join(", ");
    (!names.is_empty()).then(|| {
        format!("'{integrator}' shows media that shine, but not all that they light: {list}; 'merging' and 'path' do")
    })
}

/// Settings that were changed and do nothing with the integrator chosen, one line each.
pub(crate) fn idle(integrator: &str, given: &Settings, settings: &RenderSettings) -> Vec<String> {
    let mut lines = Vec::new();
    let mut tell = |is_idle: bool, key: &str, user: &str| {
        if is_idle {
            lines.push(format!("settings.{key} does nothing here: {user}"));
        }
    };
    let is_whitted = integrator == WHITTED;
    tell(given.min_weight.is_some() && !is_whitted, "min_weight", "only 'whitted' uses it");
    tell(given.light_samples.is_some() && !is_whitted, "light_samples", "only 'whitted' uses it");
    tell(
        given.march != Default::default() && !MARCHING.contains(&integrator),
        "march",
        "only 'whitted' and 'photon-map' use it",
    );
    tell(
        given.techniques != Techniques::default() && !PATHS.contains(&integrator),
        "without",
        "only 'path' and 'merging' use it",
    );
    tell(given.debug != Default::default() && integrator != DEBUG, "debug", "only 'debug' uses it");
    let uses_photons = uses_photon_map(integrator, settings);
    let PhotonMapSettings { projection, projection_cells, final_gather, gather_rays, exclude_direct, .. } =
        given.photon_map;
    let defaults = PhotonMapSettings::default();
    tell(
        given.photon_map != defaults && !uses_photons,
        "photon_map",
        "only 'photon-map' and the views of photons of 'debug' use it",
    );
    tell(
        uses_photons && projection_cells != defaults.projection_cells && projection != ProjectionMaps::Cells,
        "photon_map.projection_cells",
        "it needs projection = \"cells\"",
    );
    tell(
        uses_photons && gather_rays != defaults.gather_rays && !final_gather,
        "photon_map.gather_rays",
        "it needs final_gather = true",
    );
    tell(
        uses_photons && exclude_direct && !final_gather,
        "photon_map.exclude_direct",
        "without final_gather direct light is never looked up",
    );
    lines
}

const WHITTED: &str = "whitted";
const DEBUG: &str = "debug";
const PHOTON_MAP: &str = "photon-map";
/// Those that trace paths from the eye.
const PATHS: [&str; 2] = ["path", "merging"];
/// Those that march through media.
const MARCHING: [&str; 2] = [WHITTED, PHOTON_MAP];

fn uses_photon_map(integrator: &str, settings: &RenderSettings) -> bool {
    integrator == PHOTON_MAP || (integrator == DEBUG && shows_photons(settings.debug))
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_render::render_settings;
    use hyaline_scene::DebugView;

    fn more_photons() -> Settings {
        let photon_map = PhotonMapSettings { caustic_photons: 7, ..Default::default() };
        Settings { photon_map, ..Default::default() }
    }

    fn words(integrator: &str, settings: &Settings) -> String {
        in_words(integrator, &render_settings(settings))
    }

    fn idle_keys(integrator: &str, settings: &Settings) -> Vec<String> {
        let lines = idle(integrator, settings, &render_settings(settings));
        lines.iter().map(|line| line.split(' ').next().unwrap_or_default().to_owned()).collect()
    }

    #[test]
    fn only_those_who_use_photons_depend_on_their_settings() {
        let (plain, changed) = (Settings::default(), more_photons());
        for (integrator, debug, depends) in [
            ("path", DebugView::Normal, false),
            ("whitted", DebugView::Normal, false),
            ("photon-map", DebugView::Normal, true),
            ("debug", DebugView::Normal, false),
            ("debug", DebugView::PhotonMap, true),
        ] {
            let (plain, changed) =
                (Settings { debug, ..plain.clone() }, Settings { debug, ..changed.clone() });
            let differs = words(integrator, &plain) != words(integrator, &changed);
            assert_eq!(differs, depends, "{integrator} {debug:?}");
            let told = idle_keys(integrator, &changed).contains(&"settings.photon_map".to_owned());
            assert_eq!(told, !depends, "{integrator} {debug:?}");
        }
    }

    #[test]
    fn other_settings_count_where_they_are_used() {
        let weighty = Settings { min_weight: Some(0.1), light_samples: Some(9), ..Default::default() };
        assert_ne!(words("whitted", &weighty), words("whitted", &Settings::default()));
        assert_eq!(words("path", &weighty), words("path", &Settings::default()));
        assert_eq!(idle_keys("path", &weighty), ["settings.min_weight", "settings.light_samples"]);
        assert_eq!(idle_keys("whitted", &weighty), Vec::<String>::new());
        let march = Settings { march: hyaline_scene::MarchStep::Fixed { length: 1.0 }, ..Default::default() };
        assert_ne!(words("whitted", &march), words("whitted", &Settings::default()));
        assert_eq!(idle_keys("path", &march), ["settings.march"]);
        let depth = Settings { debug: DebugView::Depth, ..Default::default() };
        assert_ne!(words("debug", &depth), words("debug", &Settings::default()));
        assert_eq!(idle_keys("path", &depth), ["settings.debug"]);
    }

    #[test]
    fn settings_that_other_settings_put_out_of_use_are_told() {
        let mut settings = Settings::default();
        settings.photon_map.projection_cells = 9;
        settings.photon_map.gather_rays = 9;
        assert_eq!(idle_keys("photon-map", &settings), Vec::<String>::new());
        settings.photon_map.projection = ProjectionMaps::None;
        settings.photon_map.final_gather = false;
        settings.photon_map.exclude_direct = true;
        let keys = ["projection_cells", "gather_rays", "exclude_direct"];
        let keys = keys.map(|key| format!("settings.photon_map.{key}"));
        assert_eq!(idle_keys("photon-map", &settings), keys);
    }

    #[test]
    fn integrators_that_miss_light_of_media_name_the_media() {
        use hyaline_scene::IndexDescription;
        let clear = |name: &str| MediumDescription::clear(name, IndexDescription::Constant(1.0));
        let plasma = MediumDescription { emission: [1.0; 3], ..clear("plasma") };
        let media: Vec<Located<_>> = vec![clear("water").into(), plasma.into()];
        for integrator in ["whitted", "photon-map"] {
            let warning = unseen_light(integrator, &media).unwrap();
            assert!(warning.contains("'plasma'") && !warning.contains("water"), "{warning}");
            assert_eq!(unseen_light(integrator, &media[..1]), None);
        }
        assert_eq!(unseen_light("merging", &media), None);
        assert_eq!(unseen_light("path", &media), None);
    }
}
