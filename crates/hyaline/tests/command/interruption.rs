//! Signals: what there is gets written, and the film can be resumed.

use crate::support::Workshop;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Passes that take far longer than a test waits.
const LONG: u32 = 100_000;

/// Waits until the first checkpoint is there.
fn wait_for_film(workshop: &Workshop, child: &mut Child) {
    let start = Instant::now();
    while !workshop.path("part.film").exists() {
        assert!(child.try_wait().expect("a child").is_none(), "the run ended without a film");
        assert!(start.elapsed() < Duration::from_secs(60), "no film after a minute");
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn send(signal: &str, child: &Child) {
    let status = Command::new("kill").arg(signal).arg(child.id().to_string()).status().expect("kill runs");
    assert!(status.success());
}

/// Interrupts a long run with `signal`; returns its exit code.
fn interrupt(workshop: &Workshop, signal: &str) -> Option<i32> {
    let mut child = workshop.start(&format!("scene.toml --spp {LONG} --film part.film -o part.png"));
    wait_for_film(workshop, &mut child);
    send(signal, &child);
    child.wait().expect("the run ends").code()
}

/// Resumes the film, and compares with a run of the same length that was not interrupted.
fn assert_resumes(workshop: &Workshop) {
    let begun = workshop.succeed("scene.toml --passes 0..1 --resume part.film -o part.png --json").json();
    let begun = begun["passes"].as_u64().expect("a number");
    assert!((1..u64::from(LONG)).contains(&begun), "{begun} passes were made");
    let spp = begun + 5;
    workshop.succeed(&format!("scene.toml --spp {spp} --resume part.film -o part.pfm"));
    workshop.succeed(&format!("scene.toml --spp {spp} --film whole.film -o whole.pfm"));
    workshop.assert_same("part.film", "whole.film");
    workshop.assert_same("part.pfm", "whole.pfm");
}

#[test]
fn a_terminated_run_writes_what_there_is_and_can_be_resumed() {
    let workshop = Workshop::new();
    assert_eq!(interrupt(&workshop, "-TERM"), Some(143));
    assert_eq!(workshop.names(), ["part.film", "part.png", "scene.toml"]);
    assert_resumes(&workshop);
}

#[test]
fn an_interrupted_run_says_so() {
    assert_eq!(interrupt(&Workshop::new(), "-INT"), Some(130));
}

#[test]
fn a_killed_run_leaves_a_whole_film() {
    let workshop = Workshop::new();
    assert_eq!(interrupt(&workshop, "-KILL"), None);
    assert_resumes(&workshop);
}
