//! Tests of media: measured liquids by key and by name, `scale`, and phase functions without effect.

use crate::{load_mitsuba_text, load_toml_text};
use hyaline_scene::*;
use std::path::Path;

/// A scene of one ball; `rest` comes after it.
fn scene(ball: &str, rest: &str) -> Result<SceneDescription, SceneError> {
    let text = format!("camera = {{ from = [0, 0, 4] }}\nobject = {{ kind = 'sphere', {ball} }}\n{rest}");
    load_toml_text(&text, "a.toml", Path::new("."), &[])
}

fn load(keys: &str) -> Result<MediumDescription, SceneError> {
    scene("medium = 'm'", &format!("[media.m]\n{keys}")).map(|scene| scene.media[0].value.clone())
}

/// Absorption and scattering coefficients.
fn sigma(medium: &MediumDescription) -> (Rgb, Rgb) {
    let Absorption::SigmaA(sigma_a) = medium.absorption else { panic!("{:?}", medium.absorption) };
    (sigma_a, medium.scattering.as_ref().map_or([0.0; 3], |scattering| scattering.sigma_s))
}

fn assert_close(a: Rgb, b: Rgb) {
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-5 * b.abs()), "{a:?} and {b:?}");
}

#[test]
fn measured_liquids_come_in_scene_units() {
    let milk = load("measured = 'Whole Milk'\nconcentration = 0.5").unwrap();
    let scattering = milk.scattering.clone().unwrap();
    assert_eq!(scattering.sigma_s, [1275.0, 1605.0, 1885.0]);
    assert_eq!(scattering.phase, PhaseDescription::Isotropic);
    assert_close(sigma(&milk).0, [0.55, 1.2, 7.0]);
    assert!(matches!(milk.index, IndexDescription::Named(name) if name.value == "water"));
    let other = load("measured = 'merlot'\nior = 1.36\nsigma_s = 0").unwrap();
    assert_eq!((other.index, other.scattering), (IndexDescription::Constant(1.36), None));
    for (keys, message) in [
        ("measured = 'wohle milk'", "the nearest is 'whole milk'"),
        ("measured = 'coffe'", "the nearest is 'coffee'"),
        ("measured = 'merlot'\nconcentration = 0", "`concentration` must be above 0"),
        ("concentration = 0.5", "unknown key `concentration`"),
    ] {
        let error = load(keys).unwrap_err().to_string();
        assert!(error.contains(message) && error.contains("a.toml:"), "{keys}: {error}");
    }
}

#[test]
fn measured_scattering_grows_with_the_mean_cosine() {
    let plain = sigma(&load("measured = 'whole milk'").unwrap());
    for (phase, mean_cosine) in [
        ("g = 0.75", 0.75),
        ("g = -0.5", -0.5),
        ("g = 0", 0.0),
        ("phase = 'rayleigh'", 0.0),
        ("phase = { hg = 0.9 }", 0.9),
        ("phase = { double = [0.8, -0.4, 0.25] }", 0.5),
    ] {
        let (sigma_a, sigma_s) = sigma(&load(&format!("measured = 'whole milk'\n{phase}")).unwrap());
        assert_eq!(sigma_a, plain.0, "{phase}");
        assert_close(sigma_s, plain.1.map(|sigma| sigma / (1.0 - mean_cosine)));
    }
    let given = load("measured = 'whole milk'\ng = 0.75\nsigma_s = 3").unwrap();
    assert_eq!(sigma(&given).1, [3.0; 3], "a coefficient that is given is not reduced");
}

#[test]
fn liquids_need_no_description() {
    let vessel = "object = { kind = 'vessel', outer = [[3, 0], [4, 10]], medium = 'air', \
                  fill = [{ medium = 'whole milk', level = 0.5 }, { medium = 'Coffee', level = 0.7 }] }";
    let text =
        format!("unit = 'cm'\ncamera = {{ from = [0, 0, 40] }}\n{vessel}\n[world]\nmedium = 'sea water'");
    let scene_of = |text: &str| load_toml_text(text, "a.toml", Path::new("."), &[]).unwrap();
    let described = text.replace("[world]", "[media.'whole milk']\nmeasured = 'whole milk'\n[world]");
    let find = |scene: &SceneDescription, name: &str| {
        scene.media.iter().find(|medium| medium.name == name).map(|medium| medium.value.clone()).unwrap()
    };
    let implicit = scene_of(&text);
    let names: Vec<&str> = implicit.media.iter().map(|medium| medium.name.as_str()).collect();
    assert_eq!(names, ["sea water", "whole milk", "Coffee", "air"]);
    let (ours, theirs) = (find(&implicit, "whole milk"), find(&scene_of(&described), "whole milk"));
    assert_eq!((sigma(&ours), ours.priority), (sigma(&theirs), theirs.priority));
    assert_close(sigma(&ours).1, [25.5, 32.1, 37.7]);
    assert!(matches!(&ours.index, IndexDescription::Named(name) if name.value == "water"));
    assert_close(sigma(&find(&implicit, "Coffee")).0, [47.984, 65.751, 88.493]);
    assert_close(sigma(&find(&implicit, "sea water")).0, [0.31845, 0.31324, 0.30147]);
}

#[test]
fn described_media_come_before_liquids_of_their_name() {
    let own = scene("medium = 'milk'", "[media.milk]\nsigma_a = 1\n[media.cream]\nsigma_a = 2").unwrap();
    assert_eq!((own.media.len(), sigma(&own.media[0]).0), (2, [1.0; 3]));
    let slip = scene("medium = 'Milk'", "[media.milk]\nsigma_a = 1").unwrap();
    assert_eq!(slip.media.len(), 1, "left to be found by the world, which knows what is near");
    let sides = scene("interface = { outside = 'beer', inside = 'wine' }", "").unwrap();
    assert_eq!(sides.media.len(), 2);
}

#[test]
fn liquids_can_be_named_over_imported_scenes() {
    let text = "<scene version='3.0.0'><sensor type='perspective'/><shape type='sphere' id='ball'/></scene>";
    let overrides = [("object.ball.medium".to_owned(), "milk".to_owned())];
    let scene = load_mitsuba_text(text, "a.xml", Path::new("."), &overrides).unwrap();
    assert_close(sigma(&scene.media.last().unwrap().value).1, [2550.0, 3210.0, 3770.0]);
}

#[test]
fn a_scale_multiplies_absorption_and_scattering() {
    let medium = load("sigma_a = [1, 2, 3]\nsigma_s = 4\nemission = 5\nscale = 2.5").unwrap();
    assert_eq!(sigma(&medium), ([2.5, 5.0, 7.5], [10.0; 3]));
    assert_eq!(medium.emission, [5.0; 3], "as in Mitsuba");
    let milk = load("measured = 'whole milk'\nscale = 0.001\ng = 0.5").unwrap();
    assert_close(sigma(&milk).1, [5.1, 6.42, 7.54]);
    let color = load("color = { rgb = 0.5, at = 3 }\nscale = 2").unwrap().absorption;
    assert_eq!(color, Absorption::ColorAt { color: [0.5; 3], distance: 1.5 });
    let filter = load("filter = 0.5\nscale = 4").unwrap().absorption;
    assert_eq!(filter, Absorption::ColorAt { color: [0.5; 3], distance: 0.25 });
    let none = load("filter = 0.5\nsigma_s = 1\nscale = 0").unwrap();
    assert_eq!((none.absorption, none.scattering), (Absorption::None, None));
    let text = "<scene version='3.0.0'><sensor type='perspective'/><medium type='homogeneous' id='fog'/>\
                <shape type='sphere'><ref name='interior' id='fog'/></shape></scene>";
    let overrides = [("media.fog.scale".to_owned(), "2".to_owned())];
    let fog = load_mitsuba_text(text, "a.xml", Path::new("."), &overrides).unwrap();
    assert_eq!(sigma(&fog.media[0]), ([0.5; 3], [1.5; 3]));
}

#[test]
fn scales_that_cannot_be_are_refused() {
    for (keys, message) in [
        ("sigma_s = 1\nscale = -1", "`scale` must be 0 or more, not -1"),
        ("sigma_s = 1\nscale = inf", "`scale` must be 0 or more, not inf"),
        ("sigma_s = 1\nscale = nan", "`scale` must be 0 or more, not NaN"),
        ("sigma_s = 1\nscale = 1e300", "`scale` is too large"),
        ("sigma_s = 1e30\nscale = 1e30", "coefficients too large; lower `scale`"),
        ("sigma_a = 1e30\nscale = 1e30", "coefficients too large; lower `scale`"),
    ] {
        let error = load(keys).unwrap_err().to_string();
        assert!(error.contains(message) && error.contains("a.toml:5"), "{keys}: {error}");
    }
}

#[test]
fn a_phase_function_of_what_scatters_nothing_is_doubted() {
    let notes = |keys: &str| scene("medium = 'm'", &format!("[media.m]\n{keys}")).unwrap().notes;
    for (keys, key) in [("g = 0.5", "`g`"), ("sigma_a = 1\nphase = 'rayleigh'", "`phase`")] {
        let notes = notes(keys);
        assert!(notes.len() == 1 && notes[0].severity == Severity::Warning, "{keys}: {notes:?}");
        assert!(notes[0].message.contains("medium 'm' scatters nothing") && notes[0].message.contains(key));
        assert!(notes[0].source.as_ref().is_some_and(|source| source.line >= 4));
    }
    assert_eq!(notes("sigma_s = 1\ng = 0.5"), []);
}
