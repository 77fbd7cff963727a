//! Tests of `[settings.photon_map]` and of `debug`: every key is read, and what can't be meant is refused.

use crate::{load_mitsuba_text, load_toml_text};
use hyaline_scene::{
    Collection, DebugView, MarchStep, NearestPhotons, PhotonKernel, PhotonMapSettings, ProjectionMaps,
    SceneDescription, SceneError, Settings,
};
use std::path::Path;

const SCENE: &str = "camera = { from = [0, 0, 4] }\nlight = { kind = 'point', power = 1 }\nunit = 'mm'\n";

fn load(text: &str, overrides: &[(&str, &str)]) -> Result<SceneDescription, SceneError> {
    let overrides: Vec<_> =
        overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    load_toml_text(text, "scene.toml", Path::new("."), &overrides)
}

/// The settings of a scene with `line` in the table.
fn photon_map(line: &str) -> Result<PhotonMapSettings, SceneError> {
    load(&format!("{SCENE}[settings.photon_map]\n{line}\n"), &[]).map(|scene| scene.settings.photon_map)
}

/// The settings of a scene without any, `key` overridden.
fn overridden(key: &str, value: &str) -> Result<Settings, SceneError> {
    load(SCENE, &[(key, value)]).map(|scene| scene.settings)
}

#[test]
fn every_setting_is_read() {
    let text = include_str!("../../tests/scenes/everything.toml");
    let expected = PhotonMapSettings {
        caustic_photons: 2_000_000,
        global_photons: 300_000,
        volume_photons: 0,
        nearest: NearestPhotons { caustic: 80, global: 120, volume: 40 },
        max_radius: Some(0.005),
        kernel: PhotonKernel::Cone { k: 1.5 },
        collection: Collection::Disc { thickness: 0.1 },
        leaf_size: 16,
        projection: ProjectionMaps::Objects,
        projection_cells: 32,
        final_gather: false,
        gather_rays: 4,
        exclude_direct: true,
        exclude_single_scattering: false,
        max_bounces: 20,
    };
    assert_eq!(load(text, &[]).unwrap().settings.photon_map, expected);
    assert_eq!(photon_map("").unwrap(), PhotonMapSettings::default());
}

#[test]
fn short_forms_mean_the_defaults_of_the_long_ones() {
    let nearest = photon_map("nearest = 50").unwrap().nearest;
    assert_eq!(nearest, NearestPhotons { caustic: 50, global: 50, volume: 50 });
    let nearest = photon_map("nearest = { caustic = 50 }").unwrap().nearest;
    assert_eq!(nearest, NearestPhotons { caustic: 50, ..NearestPhotons::default() });
    for (word, kernel) in [
        ("constant", PhotonKernel::Constant),
        ("cone", PhotonKernel::default()),
        ("gaussian", PhotonKernel::Gaussian),
        ("epanechnikov", PhotonKernel::Epanechnikov),
    ] {
        assert_eq!(photon_map(&format!("kernel = '{word}'")).unwrap().kernel, kernel, "{word}");
    }
    assert_eq!(photon_map("collection = 'sphere'").unwrap().collection, Collection::Sphere);
    assert_eq!(photon_map("collection = 'disc'").unwrap().collection, Collection::default());
    assert_eq!(photon_map("projection = 'none'").unwrap().projection, ProjectionMaps::None);
    assert_eq!(photon_map("max_radius = 'auto'").unwrap().max_radius, None);
    assert_eq!(photon_map("max_radius = 3").unwrap().max_radius, Some(3.0));
    assert_eq!(photon_map("max_radius = '2 cm'").unwrap().max_radius, Some(20.0), "a unit is a millimeter");
}

#[test]
fn whole_numbers_may_be_written_with_an_exponent_or_with_underscores() {
    for text in ["2e6", "2_000_000", "2000000", "2000000.0"] {
        let settings = overridden("settings.photon_map.caustic_photons", text).unwrap();
        assert_eq!(settings.photon_map.caustic_photons, 2_000_000, "{text}");
    }
    let error = overridden("settings.photon_map.caustic_photons", "1.5").unwrap_err().to_string();
    assert!(error.contains("must be a whole number"), "{error}");
}

#[test]
fn settings_can_be_overridden_one_by_one() {
    let settings = overridden("settings.photon_map.nearest.global", "7").unwrap().photon_map;
    assert_eq!(settings.nearest, NearestPhotons { global: 7, ..NearestPhotons::default() });
    let settings = overridden("settings.photon_map.kernel", "gaussian").unwrap().photon_map;
    assert_eq!(settings.kernel, PhotonKernel::Gaussian);
    let settings = overridden("settings.photon_map.kernel.cone", "2").unwrap().photon_map;
    assert_eq!(settings.kernel, PhotonKernel::Cone { k: 2.0 });
    assert_eq!(overridden("settings.debug", "photon-maps").unwrap().debug, DebugView::PhotonMap);
}

#[test]
fn settings_of_an_imported_scene_can_be_overridden_too() {
    let text = "<scene version='3.0.0'><sensor type='perspective'/><emitter type='constant'/></scene>";
    let overrides = [("caustic_photons", "2e6"), ("nearest.volume", "9"), ("max_radius", "2 mm")]
        .map(|(key, value)| (format!("settings.photon_map.{key}"), value.to_owned()));
    let scene = load_mitsuba_text(text, "scene.xml", Path::new("."), &overrides).unwrap();
    let settings = scene.settings.photon_map;
    assert_eq!((settings.caustic_photons, settings.nearest.volume), (2_000_000, 9));
    assert_eq!(settings.max_radius, Some(0.002));
    let overrides = [("settings.debug".to_owned(), "media".to_owned())];
    let scene = load_mitsuba_text(text, "scene.xml", Path::new("."), &overrides).unwrap();
    assert_eq!(scene.settings.debug, DebugView::Medium);
}

#[test]
fn what_is_out_of_range_or_unknown_is_refused_where_it_stands() {
    for (line, word) in [
        ("caustic_photons = -1", "from 0 to"),
        ("caustic_photons = 2e9", "from 0 to"),
        ("caustic_photon = 5", "'caustic_photons'"),
        ("nearest = 1", "from 2 to"),
        ("nearest = { globl = 5 }", "'global'"),
        ("max_radius = 0", "above 0"),
        ("max_radius = 'atuo'", "\"auto\""),
        ("max_radius = '3'", "without a unit"),
        ("kernel = 'cones'", "did you mean 'cone'?"),
        ("kernel = { cone = 0.9 }", "1 or more"),
        ("kernel = { gaussian = 1 }", "needs `cone`"),
        ("collection = 'disk'", "'disc'"),
        ("collection = { disc = 2 }", "at most 1"),
        ("leaf_size = 0", "from 1"),
        ("projection = 'cell'", "'cells'"),
        ("projection_cells = 100000", "from 1 to"),
        ("final_gather = 1", "true or false"),
        ("gather_rays = 0", "from 1"),
        ("max_bounces = 0", "from 1"),
    ] {
        let error = photon_map(line).unwrap_err().to_string();
        assert!(error.starts_with("scene.toml:5:") && error.contains(word), "{line}: {error}");
    }
    let error = overridden("settings.debug", "normal").unwrap_err().to_string();
    assert!(error.contains("did you mean 'normals'?"), "{error}");
}

#[test]
fn marches_are_adaptive_or_a_length() {
    let march = |value: &str| overridden("settings.march", value).map(|settings| settings.march);
    assert_eq!(load(SCENE, &[]).unwrap().settings.march, MarchStep::Adaptive { stations: 4.0 });
    assert_eq!(march("adaptive").unwrap(), MarchStep::Adaptive { stations: 4.0 });
    assert_eq!(march("{ adaptive = 1 }").unwrap(), MarchStep::Adaptive { stations: 1.0 });
    assert_eq!(march("2 cm").unwrap(), MarchStep::Fixed { length: 20.0 });
    assert_eq!(march("0.5").unwrap(), MarchStep::Fixed { length: 0.5 });
    for (value, message) in [
        ("0", "`march` must be above 0"),
        ("-1", "`march` must be above 0"),
        ("{ adaptive = 0.5 }", "`adaptive` must be from 1 to 1000"),
        ("{ adaptiv = 2 }", "did you mean 'adaptive'"),
        ("adaptiv", "which is no length"),
    ] {
        let error = march(value).unwrap_err().to_string();
        assert!(error.contains(message), "{value}: {error}");
    }
}
