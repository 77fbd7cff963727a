//! Tests of Mitsuba scenes that can't be read.

use crate::load_mitsuba_text;
use hyaline_scene::{SceneDescription, SceneError};
use std::path::Path;

fn load(text: &str) -> Result<SceneDescription, SceneError> {
    load_mitsuba_text(text, "scene.xml", Path::new("."), &[])
}

const SENSOR: &str = "<sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>";

fn fault(body: &str) -> String {
    load(&format!("<scene version='3.0.0'>{SENSOR}\n{body}</scene>")).unwrap_err().to_string()
}

#[test]
fn faults_are_told_with_line_and_column() {
    let mut failures = Vec::new();
    for (body, place, message) in [
        (
            "<shape type='sphere'><ref id='glas'/></shape><bsdf type='null' id='glass'/>",
            "2:22",
            "did you mean 'glass'?",
        ),
        (
            "<shape type='sphere'>\n<float name='radius' value='x'/></shape>",
            "3:1",
            "must be a number, not 'x'",
        ),
        ("<shape type='sphere'>\n<float name='radius' value='nan'/></shape>", "3:1", "finite"),
        ("<shape type='sphere'>\n<float name='radius' value='0'/></shape>", "3:1", "`radius` must be"),
        (
            "<shape type='ply'><string name='filename' value='no.ply'/></shape>",
            "2:19",
            "there is no such file",
        ),
        ("<shape type='ply'/>", "2:1", "needs `filename`"),
        ("<shape type='sphere'><float name='radius' value='$r'/></shape>", "2:50", "'$r' has no value"),
        ("<shape type='sphere' id='a'/><shape type='cube' id='a'/>", "2:30", "two elements have the id 'a'"),
        (
            "<shape type='rectangle'><transform name='to_world'><scale value='0'/></transform></shape>",
            "2:52",
            "is 0",
        ),
        (
            "<shape type='rectangle'><transform name='to_world'><matrix value='1 2'/></transform></shape>",
            "2:52",
            "9 or 16",
        ),
        ("<shape type='sphere'>", "2:22", "not valid XML"),
        ("<shape type='sphere'><bsdf type='twosided'/></shape>", "2:22", "has no bsdf within"),
        (
            "<shape type='sphere'><bsdf type='dielectric'><string name='int_ior' value='watr'/></bsdf></shape>",
            "2:46",
            "'water'",
        ),
        (
            "<bsdf type='twosided' id='a'><ref id='a'/></bsdf><shape type='sphere'><ref id='a'/></shape>",
            "2:1",
            "one within itself",
        ),
        ("<include filename='none.xml'/>", "2:1", "there is no such file"),
    ] {
        let error = fault(body);
        if !error.starts_with(&format!("scene.xml:{place}")) || !error.contains(message) {
            failures.push(format!("{body}\nexpected {place} {message}\nfound {error}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    assert!(
        load("<scene version='3.0.0'><shape type='sphere'/></scene>")
            .unwrap_err()
            .message
            .contains("no camera")
    );
    assert!(load(&format!("<scene version='3.0.0'>{SENSOR}</scene>")).is_err());
    assert!(load("<mesh/>").unwrap_err().message.contains("not a Mitsuba scene"));
}

#[test]
fn bombs_do_not_go_off() {
    let entities = "<!DOCTYPE a [<!ENTITY b 'c'>]><scene version='3.0.0'>&b;</scene>";
    assert!(load(entities).unwrap_err().message.contains("DTD"), "{}", load(entities).unwrap_err());
    assert!(load(&format!("<scene>{}</scene>", "<bsdf type='twosided'>".repeat(300_000))).is_err());
    assert!(load(&format!("<scene>{}{}</scene>", "<a>".repeat(100), "</a>".repeat(100))).is_err());
    let steps = format!(
        "<scene><shape type='sphere'>{}{}",
        "<transform>".repeat(100_000),
        "</transform>".repeat(100_000)
    );
    assert!(load(&format!("{steps}</shape></scene>")).unwrap_err().message.contains("nested"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("self.xml");
    std::fs::write(
        &path,
        "<scene version='3.0.0'><include filename='self.xml'/><include filename='self.xml'/></scene>",
    )
    .unwrap();
    assert!(crate::load(&path, &[]).unwrap_err().message.contains("includes"));
}
