//! The same passes give the same bytes: in one go or in parts, on any number of threads, in crops.

use crate::support::{Workshop, read_pfm};

#[test]
fn passes_in_parts_merged_in_any_order_are_the_whole() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --passes 0..16 --film whole.film -o whole.pfm -o whole.png");
    for (name, passes) in [("a", "0..5"), ("b", "5..6"), ("c", "6..16")] {
        workshop.succeed(&format!("scene.toml --passes {passes} --film {name}.film -o {name}.png"));
    }
    for order in ["a b c", "c a b", "b c a"] {
        let films: Vec<String> = order.split(' ').map(|name| format!("{name}.film")).collect();
        workshop.succeed(&format!("merge {} -o merged.film -o merged.pfm", films.join(" ")));
        workshop.assert_same("merged.film", "whole.film");
        workshop.assert_same("merged.pfm", "whole.pfm");
    }
}

#[test]
fn a_resumed_film_is_the_whole() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 16 --film whole.film -o whole.pfm");
    workshop.succeed("scene.toml --spp 4 --film part.film -o part.png");
    workshop.succeed("scene.toml --passes 9..12 --resume part.film -o part.png");
    let run = workshop.succeed("scene.toml --spp 16 --resume part.film -o part.pfm --json");
    assert_eq!(run.json()["passes"], 16);
    workshop.assert_same("part.film", "whole.film");
    workshop.assert_same("part.pfm", "whole.pfm");
}

#[test]
fn merging_in_parts_on_other_threads_is_the_whole() {
    let workshop = Workshop::new();
    let merging = "scene.toml --integrator merging";
    for threads in [1, 2] {
        for (name, passes) in [("whole", "0..8"), ("a", "0..3"), ("b", "3..8")] {
            let run = workshop.succeed(&format!(
                "{merging} --threads {threads} --passes {passes} --film {name}{threads}.film -o {name}.png --json"
            ));
            assert!(run.json()["photons"].as_u64().is_some_and(|photons| photons > 0));
        }
    }
    // Parts made on one thread and on two, put together either way.
    for (a, b) in [("a1", "b1"), ("a2", "b2"), ("b1", "a2")] {
        workshop.succeed(&format!("merge {a}.film {b}.film -o merged.film -o merged.pfm"));
        workshop.assert_same("merged.film", "whole1.film");
    }
    workshop.assert_same("whole1.film", "whole2.film");
}

#[test]
fn threads_and_time_limits_change_no_bit() {
    let workshop = Workshop::new();
    for threads in [1, 2, 7] {
        workshop.succeed(&format!(
            "scene.toml --spp 9 --threads {threads} --film {threads}.film -o {threads}.pfm"
        ));
    }
    workshop.assert_same("1.film", "2.film");
    workshop.assert_same("1.film", "7.film");
    workshop.assert_same("1.pfm", "7.pfm");

    let report = workshop.succeed("scene.toml --time 300ms --film timed.film -o timed.pfm --json").json();
    workshop
        .succeed(&format!("scene.toml --passes 0..{} --film counted.film -o counted.pfm", report["passes"]));
    workshop.assert_same("timed.film", "counted.film");
}

#[test]
fn a_crop_is_the_whole_pictures_pixels() {
    let workshop = Workshop::new();
    for integrator in ["path", "whitted"] {
        workshop.succeed(&format!("scene.toml --spp 3 --integrator {integrator} -o whole.pfm"));
        workshop
            .succeed(&format!("scene.toml --spp 3 --integrator {integrator} --crop 3,5,21,8 -o crop.pfm"));
        let (width, _, whole) = read_pfm(&workshop.path("whole.pfm"));
        let (crop_width, crop_height, crop) = read_pfm(&workshop.path("crop.pfm"));
        assert_eq!((crop_width, crop_height), (18, 3));
        let expected: Vec<[f32; 3]> =
            (5..8).flat_map(|y| whole[y * width + 3..y * width + 21].to_vec()).collect();
        assert_eq!(crop, expected, "{integrator}");
        assert!(crop.iter().flatten().any(|value| *value > 0.0));
    }
}

#[test]
fn another_seed_is_another_picture() {
    let workshop = Workshop::new();
    workshop.succeed("scene.toml --spp 2 --seed 1 -o a.pfm");
    workshop.succeed("scene.toml --spp 2 --seed 2 -o b.pfm");
    assert!(workshop.bytes("a.pfm") != workshop.bytes("b.pfm"));
}
