//! Lights: what they are, what they show, what they stand in.

use super::{MEDIUM, close, load, scene};
use crate::load_mitsuba_text;
use hyaline_math::DVec3;
use hyaline_scene::{LightKind, SceneDescription, TextureKind};
use std::f32::consts::PI;

fn tan(angle: f64) -> f64 {
    let (sin, cos) = hyaline_math::float::f64::sin_cos(angle);
    sin / cos
}

/// A folder with a picture of 4 x 2 pixels.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut bytes = b"PF\n4 2\n-1.0\n".to_vec();
    (0..24).for_each(|i| bytes.extend((i as f32).to_le_bytes()));
    std::fs::write(folder.path().join("a.pfm"), bytes).unwrap();
    folder
}

fn with_files(body: &str) -> SceneDescription {
    let text = format!("<scene version='3.0.0'>{}\n{body}</scene>", super::SENSOR);
    load_mitsuba_text(&text, "scene.xml", folder().path(), &[]).unwrap_or_else(|error| panic!("{error}"))
}

const BITMAP: &str = "type='bitmap'><string name='filename' value='a.pfm'/></texture>";

#[test]
fn lamps_have_textures() {
    let scene = with_files(&format!(
        "<shape type='rectangle'><emitter type='area'><float name='scale' value='3'/>\
         <texture name='radiance' {BITMAP}</emitter></shape>"
    ));
    let emission = scene.objects[0].emission.as_ref().unwrap();
    assert_eq!(emission.color, [3.0; 3]);
    let name = emission.texture.as_ref().unwrap().value.clone();
    let texture = scene.textures.iter().find(|texture| texture.name == name).unwrap();
    assert!(matches!(&texture.kind, TextureKind::Image(image) if (image.width, image.height) == (4, 2)));
    assert_eq!(scene.notes, []);
}

#[test]
fn projectors_throw_their_picture_from_where_they_stand() {
    let projector = |irradiance: &str, more: &str| {
        let scene = with_files(&format!(
            "<emitter type='projector'><float name='scale' value='2'/><float name='fov' value='40'/>{more}{irradiance}\
             <transform name='to_world'><lookat origin='1, 2, 3' target='1, 2, 0' up='0, 1, 0'/></transform></emitter>"
        ));
        assert_eq!(scene.notes, []);
        scene.lights[0].kind.clone()
    };
    let LightKind::Projector { placement, fov, image, irradiance } =
        projector(&format!("<texture name='irradiance' {BITMAP}"), "")
    else {
        panic!()
    };
    assert!(close(placement.translation(), DVec3::new(1.0, 2.0, 3.0)));
    assert!(close(placement.vector(-DVec3::Z), -DVec3::Z) && close(placement.vector(DVec3::X), DVec3::X));
    assert!((fov.to_degrees() - 40.0).abs() < 1e-9 && image.is_some());
    assert_eq!(irradiance, [2.0 * PI; 3], "a white plane shows the texture's value as radiance");
    let plain = projector("<rgb name='irradiance' value='1, 2, 3'/>", "");
    assert!(matches!(plain, LightKind::Projector { image: None, irradiance, .. }
        if irradiance == [2.0 * PI, 4.0 * PI, 6.0 * PI]));
    // The picture is twice as wide as high.
    let tall =
        projector(&format!("<texture name='irradiance' {BITMAP}"), "<string name='fov_axis' value='y'/>");
    let LightKind::Projector { fov, .. } = tall else { panic!() };
    assert!((tan(fov / 2.0) - 2.0 * tan(20f64.to_radians())).abs() < 1e-12);
    let diagonal = projector(
        &format!("<texture name='irradiance' {BITMAP}"),
        "<string name='fov_axis' value='diagonal'/>",
    );
    let LightKind::Projector { fov, .. } = diagonal else { panic!() };
    assert!((tan(fov / 2.0) - 2.0 / 5f64.sqrt() * tan(20f64.to_radians())).abs() < 1e-12);
}

#[test]
fn environments_are_turned_and_scaled() {
    let scene = with_files(
        "<emitter type='envmap' id='sky'><string name='filename' value='a.pfm'/><float name='scale' value='0.5'/>\
         <transform name='to_world'><rotate y='1' angle='90'/></transform></emitter>",
    );
    let LightKind::Environment { radiance, image, placement, .. } = &scene.lights[0].kind else { panic!() };
    assert_eq!((*radiance, image.as_ref().unwrap().as_str()), ([0.5; 3], "sky/image"));
    // Mitsuba's center is +z, which the turn takes to +x; ours is -z of image space.
    assert!(close(placement.vector(DVec3::X), -DVec3::Z), "{}", placement.vector(DVec3::X));
    assert!(close(placement.vector(DVec3::Y), DVec3::Y));
}

#[test]
fn lights_are_placed_by_position_or_transform() {
    let scene = scene(
        "<emitter type='point'><transform name='toWorld'><translate x='4'/></transform></emitter>\
         <emitter type='directional'><transform name='to_world'><rotate x='1' angle='90'/></transform></emitter>",
    );
    assert!(
        matches!(scene.lights[0].kind, LightKind::Point { position, .. } if close(position, 4.0 * DVec3::X))
    );
    assert!(
        matches!(scene.lights[1].kind, LightKind::Directional { direction, .. } if close(direction, -DVec3::Y))
    );
}

#[test]
fn lights_that_there_are_not_are_listed() {
    for kind in ["sunsky", "sun", "sky", "collimated", "directionalarea"] {
        let scene = scene(&format!(
            "<shape type='sphere'/><emitter type='{kind}'><float name='turbidity' value='3'/></emitter>"
        ));
        let notes: Vec<&str> = scene.notes.iter().map(|note| note.message.as_str()).collect();
        assert_eq!(notes, [format!("emitter '{kind}' is not supported and left out")]);
        assert!(scene.lights.is_empty());
    }
}

#[test]
fn an_emitter_for_shapes_may_stand_apart() {
    let scene = scene(
        "<emitter type='area' id='e'><rgb name='radiance' value='7'/></emitter>\
         <shape type='sphere'><ref id='e'/></shape>",
    );
    assert_eq!(scene.objects[0].emission.as_ref().unwrap().color, [7.0; 3]);
    assert!(scene.lights.is_empty() && scene.notes.is_empty(), "{:?}", scene.notes);
}

#[test]
fn lamps_stand_in_the_medium_outside_of_them() {
    // The lamp comes first, the boundary that tells the index of its medium later.
    let scene = scene(&format!(
        "{MEDIUM}<shape type='sphere' id='lamp'><emitter type='area'/><ref name='exterior' id='juice'/></shape>\
         <shape type='sphere' id='dim'><emitter type='area'/></shape>\
         <shape type='cube'><bsdf type='dielectric'><float name='int_ior' value='1.33'/>\
         <float name='ext_ior' value='1'/></bsdf><ref name='interior' id='juice'/></shape>\
         <emitter type='point'><ref id='juice'/></emitter>"
    ));
    assert_eq!(scene.notes, []);
    let medium =
        |i: usize| scene.objects[i].emission.as_ref().unwrap().medium.as_ref().map(|m| m.value.as_str());
    assert_eq!((medium(0), medium(1)), (Some("juice"), None));
    assert_eq!(scene.lights[0].medium.as_ref().unwrap().value, "juice");
    assert_eq!(scene.media.len(), 1, "one medium, with the index of the boundary");
}

#[test]
fn hidden_emitters_light_but_are_not_seen() {
    let text = "<scene version='0.6.0'><integrator type='path'><boolean name='hideEmitters' value='true'/></integrator>\
                <sensor type='perspective'/><shape type='sphere'><emitter type='area'/></shape>\
                <emitter type='constant'/></scene>";
    let scene = load(text).unwrap();
    assert!(!scene.objects[0].emission.as_ref().unwrap().visible_to_camera);
    assert!(matches!(scene.lights[0].kind, LightKind::Environment { visible_to_camera: false, .. }));
    let shown = load(&text.replace("true", "false")).unwrap();
    assert!(shown.objects[0].emission.as_ref().unwrap().visible_to_camera);
}

#[test]
fn what_shines_inwards_shines_to_both_sides() {
    let scene = scene(
        "<shape type='sphere'><boolean name='flip_normals' value='true'/><emitter type='area'/></shape>\
         <shape type='rectangle'><boolean name='flip_normals' value='true'/><emitter type='area'/></shape>",
    );
    assert!(scene.objects[0].emission.as_ref().unwrap().two_sided);
    assert!(!scene.objects[1].emission.as_ref().unwrap().two_sided, "its normal is turned");
    assert_eq!(scene.notes.len(), 1);
}
