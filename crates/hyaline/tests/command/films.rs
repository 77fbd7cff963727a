//! Films: what may be merged and resumed, and what is kept when a run is interrupted.

use crate::support::{SCENE, Workshop};

#[test]
fn films_of_different_renders_do_not_merge_and_the_difference_is_named() {
    let workshop = Workshop::new();
    workshop.write("other.toml", &SCENE.replace("radius = 0.3", "radius = 0.29"));
    workshop.succeed("scene.toml --passes 0..1 --film a.film -o a.png");
    workshop.succeed("other.toml --passes 1..2 --film scene.film -o a.png");
    workshop.succeed("scene.toml --passes 1..2 --film seed.film -o a.png --seed 5");
    workshop.succeed("scene.toml --passes 1..2 --film crop.film -o a.png --crop 0,0,8,8");
    workshop.succeed("scene.toml --passes 1..2 --film integrator.film -o a.png --integrator whitted");
    for difference in ["scene", "seed", "crop", "integrator"] {
        let run = workshop.run(&format!("merge a.film {difference}.film -o merged.film"));
        assert_eq!(run.code, Some(2), "{difference}");
        assert!(run.first_line().contains(difference), "{difference}: {}", run.stderr);
    }
    assert!(!workshop.path("merged.film").exists());
}

#[test]
fn no_pass_is_counted_twice() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --passes 0..3 --film a.film -o a.png");
    workshop.succeed("scene.toml --passes 2..4 --film b.film -o a.png");
    assert_eq!(workshop.run("merge a.film b.film -o c.film").code, Some(2));
    assert_eq!(workshop.run("merge a.film a.film -o c.film").code, Some(2));
}

#[test]
fn an_existing_film_is_not_overwritten_unless_resumed() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 1 --film a.film -o a.png");
    let before = workshop.bytes("a.film");
    let run = workshop.run("scene.toml --spp 2 --film a.film -o a.png");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("--resume"), "{}", run.stderr);
    assert!(workshop.bytes("a.film") == before);
    workshop.succeed("scene.toml --spp 2 --resume a.film --film b.film -o a.png");
    assert!(workshop.bytes("a.film") == before);
    assert!(workshop.bytes("b.film") != before);
}

#[test]
fn a_film_that_is_not_the_one_resumed_is_not_overwritten() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 1 --film a.film -o a.png");
    workshop.succeed("scene.toml --passes 5..6 --film b.film -o a.png");
    let before = workshop.bytes("b.film");
    for resumed in ["a.film", "absent.film"] {
        let run = workshop.run(&format!("scene.toml --spp 2 --resume {resumed} --film b.film -o a.png"));
        assert_eq!(run.code, Some(2), "{resumed}");
        assert!(run.first_line().contains("b.film"), "{}", run.stderr);
    }
    assert!(workshop.bytes("b.film") == before);
    workshop.succeed("scene.toml --spp 2 --resume a.film --film ./a.film -o a.png");
}

#[test]
fn an_absent_film_to_resume_is_a_fresh_start_with_a_note() {
    let workshop = Workshop::new();
    let run = workshop.succeed("scene.toml --spp 1 --resume a.film -o a.png");
    assert!(run.stderr.contains("a.film"), "{}", run.stderr);
    assert!(workshop.path("a.film").exists());
}

#[test]
fn a_film_of_another_scene_or_a_damaged_one_is_not_resumed() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 1 --film a.film -o a.png");
    let run = workshop.run("scene.toml --spp 2 --seed 9 --resume a.film -o a.png");
    assert_eq!(run.code, Some(2));
    assert!(run.first_line().contains("seed"), "{}", run.stderr);
    let mut bytes = workshop.bytes("a.film");
    bytes.truncate(bytes.len() / 2);
    std::fs::write(workshop.path("a.film"), bytes).unwrap();
    assert_eq!(workshop.run("scene.toml --spp 2 --resume a.film -o a.png").code, Some(2));
    assert_eq!(workshop.run("develop a.film -o a.png").code, Some(2));
}

#[test]
fn developing_a_film_gives_the_picture_of_the_render() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 3 --film a.film -o a.pfm --exposure 2");
    workshop.succeed("develop a.film -o b.pfm --exposure 2");
    workshop.assert_same("a.pfm", "b.pfm");
    assert_eq!(workshop.run("develop a.film -o b.film").code, Some(2));
}

#[test]
fn compare_finds_a_picture_equal_to_itself_and_refuses_other_sizes() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 2 -o a.exr -o a.pfm");
    workshop.succeed("scene.toml --spp 2 --seed 3 -o b.exr");
    workshop.succeed("scene.toml --spp 1 --size 8x8 -o small.exr");
    let figures = workshop.succeed("compare a.exr a.pfm --json").json();
    for key in ["mse", "relmse", "relmse_trimmed", "flip", "nonfinite"] {
        assert_eq!(figures[key].as_f64(), Some(0.0), "{key}");
    }
    assert_eq!(figures["mean_ratio"], 1.0);
    let figures = workshop.succeed("compare a.exr b.exr --json --diff diff.png").json();
    assert!(figures["mse"].as_f64().is_some_and(|mse| mse > 0.0));
    assert!(workshop.path("diff.png").exists());
    assert_eq!(workshop.run("compare a.exr small.exr --json").code, Some(2));
    assert_eq!(workshop.run("compare a.exr absent.exr").code, Some(2));
}
