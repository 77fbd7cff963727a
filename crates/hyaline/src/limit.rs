//! Which passes a run may make, from the limits given.

use crate::cli::RenderArguments;
use hyaline_render::Limits;
use hyaline_scene::Settings;

/// Number of passes where nobody says anything.
pub(crate) const DEFAULT_PASSES: u32 = 64;

/// The limits of the command line, else the file's where it is to be obeyed, else the scene's passes, else 64.
///
/// `--spp N` is passes 0..N; together with `--passes A..B` it is the first N of those.
pub(crate) fn limits(arguments: &RenderArguments, settings: &Settings) -> Limits {
    let count = arguments.spp.map(|spp| spp.get());
    let passes = match (&arguments.passes, count) {
        (Some(passes), None) => passes.clone(),
        (Some(passes), Some(count)) => passes.start..passes.end.min(passes.start.saturating_add(count)),
        (None, Some(count)) => 0..count,
        (None, None) if arguments.time.is_some() || arguments.error.is_some() => 0..u32::MAX,
        (None, None) => 0..default_count(arguments, settings),
    };
    Limits { passes, time: arguments.time, error: arguments.error }
}

/// Number of passes where the command line gives no limit.
fn default_count(arguments: &RenderArguments, settings: &Settings) -> u32 {
    let of_file = settings.file_integrator.as_ref().and_then(|file| file.spp);
    let of_file = of_file.filter(|_| arguments.as_file);
    of_file.or(settings.passes).unwrap_or(DEFAULT_PASSES).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::Parser;
    use hyaline_scene::FileIntegrator;
    use std::time::Duration;

    fn limits_of(words: &str, settings: &Settings) -> Limits {
        let words = std::iter::once("hyaline").chain(words.split_whitespace());
        limits(&Cli::parse_from(words).render, settings)
    }

    #[test]
    fn samples_per_pixel_are_passes_from_zero() {
        assert_eq!(limits_of("--spp 16", &Settings::default()).passes, 0..16);
    }

    #[test]
    fn the_first_of_several_limits_counts() {
        let limits = limits_of("--passes 8..64 --spp 16 --time 2m", &Settings::default());
        assert_eq!(limits.passes, 8..24);
        assert_eq!(limits.time, Some(Duration::from_secs(120)));
    }

    #[test]
    fn time_alone_leaves_the_count_open() {
        assert_eq!(limits_of("--time 3", &Settings::default()).passes, 0..u32::MAX);
    }

    #[test]
    fn an_error_alone_leaves_the_count_open_and_goes_with_other_limits() {
        let limits = limits_of("--error 1e-3", &Settings::default());
        assert_eq!((limits.passes, limits.error), (0..u32::MAX, Some(1e-3)));
        let limits = limits_of("--error 1e-3 --spp 100 --time 5", &Settings::default());
        assert_eq!((limits.passes, limits.error), (0..100, Some(1e-3)));
    }

    #[test]
    fn the_scene_then_the_default_decide_where_nothing_is_said() {
        assert_eq!(limits_of("", &Settings::default()).passes, 0..64);
        let settings = Settings { passes: Some(5), ..Settings::default() };
        assert_eq!(limits_of("", &settings).passes, 0..5);
    }

    #[test]
    fn the_count_of_an_imported_file_is_obeyed_on_demand_only() {
        let file = FileIntegrator { name: "path".into(), max_depth: None, spp: Some(7) };
        let settings = Settings { file_integrator: Some(file), ..Settings::default() };
        assert_eq!(limits_of("", &settings).passes, 0..64);
        assert_eq!(limits_of("--as-file", &settings).passes, 0..7);
        assert_eq!(limits_of("--as-file --spp 3", &settings).passes, 0..3);
    }
}
