//! Wrong usage and unusable scenes end with code 2 and a clear first line; right usage leaves what was asked for.

use crate::support::{SCENE, Workshop, read_pfm};

#[test]
fn an_unknown_option_is_wrong_usage() {
    let run = Workshop::new().run("scene.toml --no-such-option");
    assert_eq!(run.code, Some(2));
    assert!(run.first_line().starts_with("error: ") && run.first_line().contains("--no-such-option"));
    assert_eq!(run.stdout, "");
}

#[test]
fn values_that_cannot_be_meant_are_wrong_usage() {
    let workshop = Workshop::new();
    for words in [
        "--spp 0",
        "--time -3",
        "--time soon",
        "--size 640",
        "--crop 1,2,1,4",
        "--crop 0,0,25,18",
        "--passes 4..4",
        "--exposure 0",
        "--error 0",
        "--error soon",
        "--threads 0",
        "--set nothing",
        "--set settings.smapler=independent",
        "--camera nobody",
        "--integrator nonsense",
        "-o picture.jpg",
        "-o absent/picture.png",
        "-o a.png -o a.png",
        "--film a.exr -o a.exr",
    ] {
        let run = workshop.run(&format!("scene.toml --spp 1 {words}"));
        assert_eq!(run.code, Some(2), "{words}\n{}", run.stderr);
        assert!(run.first_line().starts_with("error: "), "{words}\n{}", run.stderr);
    }
    assert_eq!(workshop.names(), ["scene.toml"]);
}

#[test]
fn what_is_planned_says_not_yet() {
    let workshop = Workshop::new();
    for words in ["view scene.toml", "view scene.toml --port 80"] {
        let run = workshop.run(words);
        assert_eq!(run.code, Some(2), "{words}");
        assert!(run.first_line().contains("not yet"), "{words}: {}", run.stderr);
    }
}

#[test]
fn an_absent_scene_is_named() {
    let run = Workshop::new().run("absent.toml");
    assert_eq!(run.code, Some(2));
    assert!(run.first_line().starts_with("error: ") && run.first_line().contains("absent.toml"));
}

#[test]
fn an_unknown_key_is_shown_with_its_place_and_the_nearest_one() {
    let workshop = Workshop::new();
    workshop.write("typo.toml", &SCENE.replace("radius = 0.3\nmedium", "raduis = 0.3\nmedium"));
    let run = workshop.run("typo.toml");
    let line = 1 + SCENE.lines().position(|line| line == "radius = 0.3").expect("the line is there");
    assert_eq!(run.code, Some(2));
    assert!(run.first_line().starts_with(&format!("error: typo.toml:{line}:1: ")), "{}", run.stderr);
    assert!(run.stderr.contains("raduis = 0.3\n") && run.stderr.contains("^^^^^^"), "{}", run.stderr);
    assert!(run.stderr.contains("radius"), "{}", run.stderr);
    assert_eq!(workshop.names(), ["scene.toml", "typo.toml"]);
}

#[test]
fn pictures_are_named_after_the_scene_where_nothing_is_said() {
    let workshop = Workshop::new();
    workshop.succeed("--spp 1 scene.toml");
    assert_eq!(workshop.names(), ["scene.exr", "scene.png", "scene.toml"]);
}

#[test]
fn outputs_are_those_asked_for_and_the_word_render_may_stand_first() {
    let workshop = Workshop::new();
    workshop.succeed("render -o a.pfm --spp 1 scene.toml -o b.png");
    assert_eq!(workshop.names(), ["a.pfm", "b.png", "scene.toml"]);
}

#[test]
fn the_word_render_may_stand_after_options() {
    let workshop = Workshop::new();
    workshop.succeed("-o a.pfm --spp 1 render scene.toml -o b.png");
    assert_eq!(workshop.names(), ["a.pfm", "b.png", "scene.toml"]);
    workshop.succeed("--diff d.png compare a.pfm a.pfm");
    assert_eq!(workshop.names(), ["a.pfm", "b.png", "d.png", "scene.toml"]);
}

#[test]
fn the_built_in_scene_needs_no_file() {
    let workshop = Workshop::new();
    let run = workshop.succeed("--spp 1 --size 32x24");
    assert_eq!(workshop.names(), ["glass-of-water.exr", "glass-of-water.png", "scene.toml"]);
    assert!(run.stderr.contains("glass-of-water.png") && run.stderr.contains("--help"), "{}", run.stderr);
    assert_eq!(run.stdout, "");
}

#[test]
fn a_setting_of_the_scene_can_be_set() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 1 -o a.pfm --set film.size=[10,6]");
    let (width, height, _) = read_pfm(&workshop.path("a.pfm"));
    assert_eq!((width, height), (10, 6));
}

#[test]
fn settings_that_do_nothing_with_the_integrator_are_told() {
    let workshop = Workshop::new();
    let run = workshop.succeed("scene.toml --spp 1 -o a.png --set settings.photon_map.caustic_photons=2e6");
    assert!(run.stderr.contains("note: settings.photon_map does nothing here"), "{}", run.stderr);
    let run = workshop.succeed("scene.toml --spp 1 -o a.png");
    assert!(!run.stderr.contains("note:"), "{}", run.stderr);
}

#[test]
fn a_debug_view_is_chosen_by_its_word() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 1 --integrator debug --set settings.debug=depth -o a.pfm");
    let (width, height, depths) = read_pfm(&workshop.path("a.pfm"));
    let [ball, ..] = depths[height / 2 * width + width / 2];
    assert!((1.5..2.0).contains(&ball), "the ball is {ball} from the camera");
}

#[test]
fn the_report_has_the_agreed_keys_on_the_last_line() {
    let run = Workshop::new().succeed("scene.toml --spp 2 --json -o a.png");
    let report = run.json();
    assert_eq!(report["passes"], 2);
    assert_eq!(report["spp"], 2);
    for key in ["load", "build", "prepare", "render"] {
        assert!(report["seconds"][key].as_f64().is_some_and(|seconds| seconds >= 0.0), "{key}");
    }
    assert!(report["rays"].as_u64().is_some_and(|rays| rays >= 2 * 24 * 18));
    assert!(report["photons"].as_u64().is_some_and(|photons| photons > 0));
    assert!(report["warnings"].is_array());
    #[cfg(target_os = "linux")]
    assert!(report["peak_memory_bytes"].as_u64().is_some_and(|bytes| bytes > 1 << 20));
}

#[test]
fn the_report_tells_what_each_photon_map_took() {
    let workshop = Workshop::new();
    let photons =
        "--set settings.photon_map.caustic_photons=3000 --set settings.photon_map.global_photons=2e3";
    let words = format!("scene.toml --spp 1 --integrator photon-map {photons} --json -o a.png");
    let run = workshop.succeed(&words);
    let maps = &run.json()["photon_maps"];
    assert_eq!(maps["caustic"]["emitted"], 3000);
    assert_eq!(maps["global"]["emitted"], 2000);
    for map in ["caustic", "global"] {
        assert!(maps[map]["stored"].as_u64().is_some_and(|stored| stored > 0), "{map}");
        assert!(maps[map]["bytes"].as_u64().is_some_and(|bytes| bytes > 0), "{map}");
        assert!(maps[map]["look_ups"].as_u64().is_some_and(|look_ups| look_ups > 0), "{map}");
    }
    assert!(run.stderr.contains("photons kept: caustic "), "{}", run.stderr);
    let run = workshop.succeed("scene.toml --spp 1 --json -o a.png");
    assert!(run.json().get("photon_maps").is_none());
}

#[test]
fn a_time_limit_ends_the_run_and_the_passes_are_told() {
    let run = Workshop::new().succeed("scene.toml --time 500ms --json -o a.png");
    let report = run.json();
    assert!(report["passes"].as_u64().is_some_and(|passes| passes >= 1));
    let seconds = |key: &str| report["seconds"][key].as_f64().unwrap();
    assert!(seconds("build") + seconds("prepare") + seconds("render") < 5.0);
}

#[test]
fn check_tells_what_was_read() {
    let workshop = Workshop::new();
    let run = workshop.succeed("check scene.toml");
    for word in ["24", "18", "ball", "floor", "lamp", "sky", "glass"] {
        assert!(run.stdout.contains(word), "{word} is missing in\n{}", run.stdout);
    }
    assert_eq!(workshop.run("check absent.toml").code, Some(2));
    assert_eq!(workshop.names(), ["scene.toml"]);
}
