//! Includes, folders, aliases and parameters.

use super::SENSOR;
use crate::load;
use hyaline_scene::{IndexDescription, LightKind, SceneDescription, SceneError, ShapeDescription};
use std::fs;

/// Writes files into a folder and loads the first of them.
fn load_files(files: &[(&str, &str)]) -> Result<SceneDescription, SceneError> {
    load_with(files, &[])
}

fn load_with(files: &[(&str, &str)], overrides: &[(&str, &str)]) -> Result<SceneDescription, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let overrides: Vec<_> =
        overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    load(&folder.path().join(files[0].0), &overrides)
}

fn wrapped(body: &str) -> String {
    format!("<scene version='3.0.0'>{SENSOR}\n{body}</scene>")
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn includes_are_relative_to_the_file_that_says_them() {
    let scene = load_files(&[
        ("a/scene.xml", &wrapped("<include filename='parts/all.xml'/>")),
        (
            "a/parts/all.xml",
            "<scene version='3.0.0'><include filename='ball.xml'/><include filename='../b.xml'/></scene>",
        ),
        ("a/parts/ball.xml", "<shape type='sphere' id='ball'/>"),
        ("a/b.xml", "\u{feff}<shape type='cube' id='box'/>"),
    ]);
    let names: Vec<String> = scene.unwrap().objects.iter().map(|object| object.name.clone()).collect();
    assert_eq!(names, ["ball", "box"]);
}

#[test]
fn assets_are_found_beside_the_scene_then_beside_the_include() {
    let scene = load_files(&[
        ("scene.xml", &wrapped("<include filename='parts/all.xml'/>")),
        ("parts/all.xml", "<shape type='obj'><string name='filename' value='a.obj'/></shape>"),
        ("parts/a.obj", TRIANGLE),
    ]);
    assert_eq!(scene.unwrap().objects.len(), 1);
}

#[test]
fn folders_of_paths_come_first() {
    let two = TRIANGLE.to_owned() + "f 1 3 2\n";
    let scene = load_files(&[
        (
            "scene.xml",
            &wrapped(
                "<path value='meshes'/><shape type='obj'><string name='filename' value='a.obj'/></shape>",
            ),
        ),
        ("a.obj", TRIANGLE),
        ("meshes/a.obj", &two),
    ]);
    let scene = scene.unwrap();
    let ShapeDescription::Mesh { mesh, .. } = &scene.objects[0].shape else { panic!() };
    assert_eq!(mesh.triangles.len(), 2);
    let error = load_files(&[("scene.xml", &wrapped("<path value='none'/>"))]).unwrap_err().to_string();
    assert!(error.contains("scene.xml:2:1: <path>: there is no folder 'none'"), "{error}");
}

#[test]
fn files_that_include_themselves_are_named_with_the_whole_round() {
    let error = load_files(&[
        ("scene.xml", &wrapped("<include filename='a.xml'/>")),
        ("a.xml", "<scene version='3.0.0'><include filename='./b.xml'/></scene>"),
        ("b.xml", "<scene version='3.0.0'><include filename='a.xml'/></scene>"),
    ]);
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("b.xml:1:24: a file includes itself: a.xml includes ./b.xml includes 'a.xml'"),
        "{error}"
    );
    let own =
        load_files(&[("scene.xml", &wrapped("<include filename='scene.xml'/>"))]).unwrap_err().to_string();
    assert!(own.contains("includes itself") && own.contains("scene.xml:2:1"), "{own}");
}

#[test]
fn includes_in_each_other_end_somewhere() {
    let folder = tempfile::tempdir().unwrap();
    for i in 0..30 {
        let text = format!("<scene version='3.0.0'><include filename='{}.xml'/></scene>", i + 1);
        fs::write(folder.path().join(format!("{i}.xml")), text).unwrap();
    }
    let error = load(&folder.path().join("0.xml"), &[]).unwrap_err();
    assert!(error.message.contains("more than 16 includes within each other"), "{error}");
    // Two includes a file double with each file.
    for i in 0..30 {
        let next = format!("<include filename='{}.xml'/>", i + 1);
        let text = if i < 12 {
            format!("<scene version='3.0.0'>{next}{next}</scene>")
        } else {
            "<null/>".to_owned()
        };
        fs::write(folder.path().join(format!("{i}.xml")), text).unwrap();
    }
    let error = load(&folder.path().join("0.xml"), &[]).unwrap_err();
    assert!(error.message.contains("more than 256 includes"), "{error}");
}

#[test]
fn only_regular_files_are_opened_wherever_they_are() {
    let error = |name: &str| {
        let body = format!("<include filename='{name}'/>");
        load_files(&[("a/scene.xml", &wrapped(&body)), ("b.xml", "<shape type='sphere'/>")])
    };
    assert!(error("../b.xml").is_ok(), "a scene may use what lies beside its folder");
    let device = error("/dev/zero").unwrap_err().to_string();
    assert!(device.contains("it is not a regular file"), "{device}");
    assert!(error("..").unwrap_err().message.contains("not a regular file"));
    let foreign = error("/etc/hostname").map(|_| ()).unwrap_err().to_string();
    assert!(foreign.contains("not valid XML") || foreign.contains("no such file"), "{foreign}");
    let mesh = wrapped("<shape type='ply'><string name='filename' value='/dev/null'/></shape>");
    assert!(load_files(&[("scene.xml", &mesh)]).unwrap_err().message.contains("not a regular file"));
}

#[test]
fn faults_in_files_tell_where_the_file_was_named() {
    let scene = wrapped("\n<shape type='obj'><string name='filename' value='a.obj'/></shape>");
    let error =
        load_files(&[("scene.xml", &scene), ("a.obj", "v 0 0 0\nf 1 2 3\n")]).unwrap_err().to_string();
    assert!(error.contains("a.obj:2: vertex index '2' is out of range"), "{error}");
    assert!(error.contains("scene.xml:3:19)"), "{error}");
    let include = wrapped("<include filename='a.xml'/>");
    let error =
        load_files(&[("scene.xml", &include), ("a.xml", "<shape type='sphere'><float/>")]).unwrap_err();
    assert!(error.to_string().contains("a.xml:1:"), "{error}");
}

#[test]
fn aliases_are_other_names() {
    let shape = "<shape type='sphere'><ref id='b'/></shape>";
    let bsdf = "<bsdf type='dielectric' id='a'><float name='int_ior' value='1.3'/><float name='ext_ior' value='1'/></bsdf>";
    let scene =
        load_files(&[("scene.xml", &wrapped(&format!("{bsdf}<alias id='a' as='b'/>{shape}<null/>")))])
            .unwrap();
    assert_eq!(scene.media[0].index, IndexDescription::Constant(1.3));
    assert_eq!(scene.notes, []);
    let error = |body: &str| load_files(&[("scene.xml", &wrapped(body))]).unwrap_err().to_string();
    assert!(error("<alias id='c' as='d'/>").contains("2:1: nothing above has the id 'c'"));
    assert!(error(&format!("{bsdf}<alias id='a' as='a'/>")).contains("two elements have the id 'a'"));
}

#[test]
fn parameters_are_set_from_outside() {
    let text = wrapped(
        "<default name='r' value='2'/><default name='kind' value='sphere'/>\
         <shape type='$kind'><float name='radius' value='$r'/></shape>",
    );
    let radius = |overrides: &[(&str, &str)]| -> Result<f64, SceneError> {
        let scene = load_with(&[("scene.xml", &text)], overrides)?;
        match &scene.objects[0].shape {
            ShapeDescription::Sphere { radius, .. } => Ok(*radius),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(radius(&[]), Ok(2.0));
    assert_eq!(radius(&[("default.r", "3"), ("film.size", "[8, 8]")]), Ok(3.0));
    let error = radius(&[("default.rr", "3")]).unwrap_err().to_string();
    assert!(error.contains("no parameter '$rr'") && error.contains("'default.r'"), "{error}");
    let without = wrapped("<shape type='sphere'><float name='radius' value='$r'/></shape>");
    assert!(load_with(&[("scene.xml", &without)], &[("default.r", "3")]).is_ok());
}

#[test]
fn parameters_that_double_themselves_do_not_fill_the_memory() {
    let mut body = String::from("<default name='a0' value='lollollol'/>");
    for i in 0..60 {
        body += &format!("<default name='a{}' value='$a{i}$a{i}$a{i}$a{i}'/>", i + 1);
    }
    let error = load_files(&[("scene.xml", &wrapped(&body))]).unwrap_err();
    assert!(error.message.contains("65536 bytes"), "{error}");
}

#[test]
fn entities_are_refused_in_includes_too() {
    let bomb = "<!DOCTYPE a [<!ENTITY b 'c'><!ENTITY d '&b;&b;&b;'>]><shape type='sphere' id='&d;'/>";
    let files = [("scene.xml", &*wrapped("<include filename='a.xml'/>")), ("a.xml", bomb)];
    let error = load_files(&files).unwrap_err();
    assert!(error.message.contains("a DTD is not read"), "{error}");
    let outside = "<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]><scene version='3.0.0'>&b;</scene>";
    assert!(load_files(&[("scene.xml", outside)]).unwrap_err().message.contains("a DTD is not read"));
}

#[test]
fn the_veach_scene_of_another_author_names_what_it_hides() {
    // That author's own way of commenting out.
    let text = wrapped(
        "<emitter type='constant'><hide name='radiance' value='5'/><rgb name='radiance' value='2'/></emitter>",
    );
    let scene = load_files(&[("scene.xml", &text)]).unwrap();
    assert!(matches!(scene.lights[0].kind, LightKind::Environment { radiance: [2.0, 2.0, 2.0], .. }));
    let note = scene.notes[0].to_string();
    assert!(note.contains("scene.xml:2:26: the element <hide>"), "{note}");
}
