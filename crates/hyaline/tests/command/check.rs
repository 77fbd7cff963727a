//! `hyaline check` tells everything that is wrong or doubtful, with its place, and says so by its exit code.

use crate::support::{SCENE, Workshop};
use std::path::Path;

/// The scenes of the gallery that are quick to check.
fn gallery() -> Vec<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let entries = folder.read_dir().expect("the gallery is there");
    let mut scenes: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    scenes.retain(|path| !path.to_string_lossy().contains("mesh-1"));
    scenes.sort();
    scenes
}

#[test]
fn the_gallery_is_healthy() {
    let workshop = Workshop::new();
    assert!(gallery().len() > 10);
    for scene in gallery() {
        let run = workshop.run(&format!("check --strict {}", scene.display()));
        assert_eq!((run.code, run.stderr.contains("warning")), (Some(0), false), "{}", run.stderr);
    }
}

#[test]
fn every_fault_of_reading_is_told_in_the_order_of_the_file() {
    let workshop = Workshop::new();
    let faulty = SCENE
        .replace("size = [24, 18]", "size = [24]")
        .replace("ior = 1.5", "ior = -1")
        .replace("radius = 0.3\nmedium", "raduis = 0.3\nmedium")
        .replace("radiance = [20, 19, 17]", "radiance = \"bright\"");
    workshop.write("faulty.toml", &faulty);
    let run = workshop.run("check faulty.toml");
    assert_eq!(run.code, Some(2));
    let errors: Vec<&str> = run.stderr.lines().filter(|line| line.starts_with("error: ")).collect();
    assert_eq!(errors.len(), 4, "{}", run.stderr);
    for (error, word) in errors.iter().zip(["size", "ior", "raduis", "radiance"]) {
        assert!(error.starts_with("error: faulty.toml:") && error.contains(word), "{}", run.stderr);
    }
    assert!(run.stderr.contains("^^^^"), "{}", run.stderr);
}

#[test]
fn an_instance_of_a_faulty_object_is_no_fault_of_its_own() {
    let workshop = Workshop::new();
    let instance = "[[object]]\nname = \"twin\"\nkind = \"instance\"\nof = \"ball\"\n";
    let faulty = SCENE.replace("radius = 0.3\nmedium", "raduis = 0.3\nmedium");
    workshop.write("faulty.toml", &format!("{faulty}\n{instance}"));
    let run = workshop.run("check faulty.toml");
    assert_eq!(run.stderr.matches("error: ").count(), 1, "{}", run.stderr);
}

#[test]
fn every_fault_of_compiling_is_told() {
    let workshop = Workshop::new();
    let ball = "[[object]]\nkind = \"sphere\"\nradius = 1\nmedium = \"glas\"\n";
    let floor = "[[object]]\nkind = \"sphere\"\nradius = 1\nmaterial = \"mate\"\n";
    workshop.write("faulty.toml", &format!("{SCENE}\n{ball}\n{floor}"));
    let run = workshop.run("check faulty.toml");
    assert_eq!(run.code, Some(2));
    assert_eq!(run.stderr.matches("error: faulty.toml:").count(), 2, "{}", run.stderr);
    assert!(run.stderr.contains("'glas'") && run.stderr.contains("'mate'"), "{}", run.stderr);
    // Rendering ends at the first.
    assert_eq!(workshop.run("faulty.toml --spp 1").stderr.matches("error: ").count(), 1);
}

#[test]
fn strict_fails_on_warnings_and_on_nothing_less() {
    let workshop = Workshop::new();
    assert_eq!(workshop.run("check --strict scene.toml").code, Some(0));
    // The ball stands in another body of the same priority.
    let pond = "[media.water]\nior = \"water\"\n\n[[object]]\nname = \"pond\"\nkind = \"box\"\nmin = [-1, 0.1, -1]\nmax = [1, 0.4, 1]\nmedium = \"water\"\n";
    workshop.write("pond.toml", &format!("{SCENE}\n{pond}"));
    let run = workshop.run("check pond.toml");
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("warning: pond.toml:") && run.stderr.contains("priority"), "{}", run.stderr);
    assert_eq!(workshop.run("check --strict pond.toml").code, Some(1));
}

#[test]
fn what_a_file_asks_for_and_is_not_rendered_is_a_warning() {
    let workshop = Workshop::new();
    let scene = r#"<scene version="3.0.0">
        <sensor type="perspective"><float name="fov" value="40"/></sensor>
        <shape type="sphere"><bsdf type="hair"/></shape>
        <emitter type="constant"/>
    </scene>"#;
    workshop.write("hair.xml", scene);
    let run = workshop.run("check hair.xml --strict");
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("warning: hair.xml:") && run.stderr.contains("hair"), "{}", run.stderr);
}

#[test]
fn a_broken_mesh_is_told_by_name_and_a_body_inside_out_is_turned() {
    let workshop = Workshop::new();
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    workshop.write("open.obj", tetrahedron);
    workshop.write("closed.obj", &format!("{tetrahedron}f 2 3 4\n"));
    let turned: String = format!("{tetrahedron}f 2 3 4\n")
        .lines()
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            ["f", a, b, c] => format!("f {a} {c} {b}\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    workshop.write("turned.obj", &turned);
    let scene = |file: &str| {
        format!(
            "{SCENE}\n[[object]]\nname = \"gem\"\nkind = \"mesh\"\nfile = \"{file}\"\nmedium = \"glass\"\ntransform = {{ translate = [5, 5, 5] }}\n"
        )
    };
    for (file, code, word) in
        [("closed.obj", 0, ""), ("open.obj", 1, "3 open edges"), ("turned.obj", 0, "inside out")]
    {
        workshop.write("gem.toml", &scene(file));
        let run = workshop.run("check --strict gem.toml");
        assert_eq!(run.code, Some(code), "{file}: {}", run.stderr);
        assert!(
            run.stderr.contains(word) && (word.is_empty() || run.stderr.contains("'gem'")),
            "{}",
            run.stderr
        );
        assert_eq!(run.stderr.is_empty(), word.is_empty(), "{file}: {}", run.stderr);
    }
}
