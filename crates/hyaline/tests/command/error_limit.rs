//! `--error`: the render ends when its picture is good enough, at the same pass however it is run.

use crate::support::Workshop;

#[test]
fn a_render_ends_when_its_estimated_error_is_small_enough() {
    let workshop = Workshop::new();
    let run = workshop.succeed("scene.toml --error 0.02 --threads 1 --film a.film -o a.exr --json");
    let report = run.json();
    let (passes, error) = (report["passes"].as_u64().unwrap(), report["error"].as_f64().unwrap());
    assert!(error < 0.02 && passes >= 8, "{passes} passes, {error}");
    assert!(run.stderr.contains("estimated relmse"), "{}", run.stderr);
    // The estimate is of what `compare` measures.
    workshop.succeed("scene.toml --spp 2000 --seed 7 -o reference.exr");
    let relmse = workshop.succeed("compare a.exr reference.exr --json").json()["relmse"].as_f64().unwrap();
    assert!((0.8..8.0).contains(&(error / relmse)), "estimated {error}, found {relmse}");
    // The same pass ends it with other threads, in parts, and as a count.
    workshop.succeed("scene.toml --error 0.02 --threads 2 --film b.film -o b.png");
    workshop.succeed("scene.toml --spp 5 --film c.film -o c.png");
    workshop.succeed("scene.toml --error 0.02 --resume c.film -o c.png");
    workshop.succeed(&format!("scene.toml --passes 0..{passes} --film d.film -o d.png"));
    for other in ["b.film", "c.film", "d.film"] {
        workshop.assert_same("a.film", other);
    }
    // A film that is good enough is left as it is.
    workshop.succeed("scene.toml --error 0.02 --resume c.film -o c.png");
    workshop.assert_same("a.film", "c.film");
}

#[test]
fn the_first_limit_reached_ends_the_render() {
    let workshop = Workshop::new();
    let report = workshop.succeed("scene.toml --error 1e-9 --spp 9 -o a.png --json").json();
    assert_eq!(report["passes"], 9);
    assert!(report["error"].as_f64().is_some_and(|error| error > 1e-9));
    let report = workshop.succeed("scene.toml --error 1e9 --spp 90 -o a.png --json").json();
    assert_eq!(report["passes"], 8);
    let report = workshop.succeed("scene.toml --spp 1 -o a.png --json").json();
    assert!(report.get("error").is_none());
}
