//! Tests of finishes: each element against the description that it becomes.

mod blends;
mod metals;
mod principled;
mod reliefs;
mod replacements;

use crate::load_mitsuba_text;
use hyaline_scene::*;
use std::path::Path;

const SENSOR: &str = "<sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>";

fn load_in(folder: &Path, version: &str, body: &str) -> Result<SceneDescription, SceneError> {
    let text = format!("<scene version='{version}'>{SENSOR}\n{body}</scene>");
    load_mitsuba_text(&text, "scene.xml", folder, &[])
}

/// A scene of version 3 with a sphere of this finish.
fn scene(bsdf: &str) -> SceneDescription {
    load_in(Path::new("."), "3.0.0", &format!("<shape type='sphere' id='ball'>{bsdf}</shape>"))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn fault(bsdf: &str) -> String {
    let error =
        load_in(Path::new("."), "3.0.0", &format!("<shape type='sphere'>{bsdf}</shape>")).unwrap_err();
    error.to_string()
}

/// The material of a scene's first object.
fn finish(scene: &SceneDescription) -> &MaterialDescription {
    material(scene, &scene.objects[0].material)
}

fn material<'a>(scene: &'a SceneDescription, name: &str) -> &'a MaterialDescription {
    let found = scene.materials.iter().find(|material| material.name == name);
    found.unwrap_or_else(|| panic!("no material '{name}'"))
}

fn texture<'a>(scene: &'a SceneDescription, name: &str) -> &'a TextureDescription {
    scene
        .textures
        .iter()
        .find(|texture| texture.name == name)
        .unwrap_or_else(|| panic!("no texture '{name}'"))
}

fn notes(scene: &SceneDescription) -> Vec<String> {
    scene.notes.iter().map(ToString::to_string).collect()
}

/// A finish that is read without a note.
fn clean(bsdf: &str) -> MaterialDescription {
    let scene = scene(bsdf);
    assert_eq!(scene.notes, [], "{bsdf}");
    finish(&scene).clone()
}

fn constant(value: f32) -> ScalarSource {
    ScalarSource::Constant(value)
}

fn grey(value: f32) -> ColorSource {
    ColorSource::Constant([value; 3])
}

fn sides(scene: &SceneDescription) -> (Option<f64>, Option<f64>) {
    let BoundaryDescription::Interface { outside, inside } = &scene.objects[0].boundary else {
        panic!("no interface")
    };
    let index = |side: &Option<Located<String>>| {
        let name = side.as_ref()?;
        let medium = scene.media.iter().find(|medium| medium.name == name.value).unwrap();
        match medium.index {
            IndexDescription::Constant(index) => Some(index),
            _ => None,
        }
    };
    (index(outside), index(inside))
}

/// A checkerboard of two greys under a name.
fn checker(name: &str, even: f32, odd: f32) -> String {
    format!(
        "<texture type='checkerboard' name='{name}'><float name='color0' value='{even}'/>\
         <float name='color1' value='{odd}'/></texture>"
    )
}

#[test]
fn named_indices_are_mitsubas() {
    for (name, index) in [
        ("vacuum", 1.0),
        ("helium", 1.000_036),
        ("hydrogen", 1.000_132),
        ("air", 1.000_277),
        ("carbon dioxide", 1.000_45),
        ("water", 1.333),
        ("acetone", 1.36),
        ("ethanol", 1.361),
        ("carbon tetrachloride", 1.461),
        ("glycerol", 1.4729),
        ("benzene", 1.501),
        ("silicone oil", 1.520_45),
        ("bromine", 1.661),
        ("water ice", 1.31),
        ("fused quartz", 1.458),
        ("pyrex", 1.47),
        ("acrylic glass", 1.49),
        ("polypropylene", 1.49),
        ("bk7", 1.5046),
        ("sodium chloride", 1.544),
        ("amber", 1.55),
        ("pet", 1.575),
        ("diamond", 2.419),
    ] {
        let scene = scene(&format!(
            "<bsdf type='dielectric'><string name='int_ior' value='{name}'/><float name='ext_ior' value='1.2'/></bsdf>"
        ));
        assert_eq!(sides(&scene), (Some(1.2), (name != "vacuum").then_some(index)), "{name}");
    }
    let error = fault("<bsdf type='dielectric'><string name='int_ior' value='diamont'/></bsdf>");
    assert!(error.contains("scene.xml:2:") && error.contains("did you mean 'diamond'?"), "{error}");
}

#[test]
fn dielectrics_are_bk7_in_air_unless_told_otherwise() {
    let plain = scene("<bsdf type='dielectric'/>");
    assert_eq!(sides(&plain), (Some(1.000_277), Some(1.5046)));
    let tint = (grey(1.0), grey(1.0));
    assert_eq!(finish(&plain).kind, MaterialKind::Dielectric { roughness: constant(0.0), tint });
    let rough = scene(
        "<bsdf type='roughdielectric'><string name='distribution' value='ggx'/><float name='alpha' value='0.09'/>\
         <float name='int_ior' value='1.33'/><float name='ext_ior' value='1.5'/>\
         <rgb name='specular_reflectance' value='0.9'/><rgb name='specular_transmittance' value='0.8'/></bsdf>",
    );
    assert_eq!(rough.notes, []);
    assert_eq!(sides(&rough), (Some(1.5), Some(1.33)));
    let MaterialKind::Dielectric { roughness: ScalarSource::Constant(roughness), tint } =
        &finish(&rough).kind
    else {
        panic!("not rough")
    };
    assert!((roughness - 0.3).abs() < 1e-6, "alpha is roughness squared");
    assert_eq!(*tint, (grey(0.9), grey(0.8)));
}

#[test]
fn a_pane_has_the_ratio_of_its_indices() {
    let pane = clean(
        "<bsdf type='thindielectric'><float name='int_ior' value='1.6'/><float name='ext_ior' value='1.25'/>\
         <rgb name='specular_transmittance' value='0.7'/></bsdf>",
    );
    assert_eq!(pane.kind, MaterialKind::ThinDielectric { ior: 1.28, tint: grey(0.7) });
    assert!(pane.two_sided);
    let noted = scene("<bsdf type='thindielectric'>\n<rgb name='specular_reflectance' value='0.7'/></bsdf>");
    assert!(
        notes(&noted)[0].contains("`specular_reflectance` of bsdf 'thindielectric'"),
        "{:?}",
        noted.notes
    );
}

#[test]
fn plastics_are_a_base_under_a_coat() {
    let smooth = clean("<bsdf type='plastic'/>");
    let ior = (1.49 / 1.000_277) as f32;
    let plastic = |roughness, nonlinear| MaterialKind::Plastic {
        diffuse: grey(0.5),
        specular: grey(1.0),
        ior,
        roughness,
        nonlinear,
    };
    assert_eq!(smooth.kind, plastic(constant(0.0), false));
    assert!(!smooth.two_sided);
    let rough = "<string name='distribution' value='ggx'/><float name='alpha' value='0.25'/>\
                 <boolean name='nonlinear' value='true'/></bsdf>";
    assert_eq!(clean(&format!("<bsdf type='roughplastic'>{rough}")).kind, plastic(constant(0.5), true));
    let polarizing = scene(&format!("<bsdf type='pplastic'>{rough}"));
    assert_eq!(finish(&polarizing).kind, plastic(constant(0.5), true));
    assert_eq!(polarizing.notes.len(), 1);
    let colored = clean(
        "<bsdf type='plastic'><rgb name='diffuse_reflectance' value='0.1, 0.2, 0.3'/>\
         <rgb name='specular_reflectance' value='0.9'/><float name='int_ior' value='1.5'/>\
         <float name='ext_ior' value='1.2'/></bsdf>",
    );
    let diffuse = ColorSource::Constant([0.1, 0.2, 0.3]);
    assert_eq!(
        colored.kind,
        MaterialKind::Plastic {
            diffuse,
            specular: grey(0.9),
            ior: 1.25,
            roughness: constant(0.0),
            nonlinear: false
        }
    );
}

#[test]
fn a_texture_of_alpha_becomes_one_of_its_square_root() {
    let scene = scene(&format!(
        "<bsdf type='roughplastic'><string name='distribution' value='ggx'/>{}</bsdf>",
        checker("alpha", 0.25, 0.09)
    ));
    assert_eq!(scene.notes, []);
    let MaterialKind::Plastic { roughness: ScalarSource::Texture(name), .. } = &finish(&scene).kind else {
        panic!("no texture of roughness")
    };
    let TextureKind::Checker { even, odd } = texture(&scene, name).kind else { panic!("no checker") };
    assert!((even[0] - 0.5).abs() < 1e-6 && (odd[2] - 0.3).abs() < 1e-6, "{even:?} {odd:?}");
    assert_eq!(scene.textures.len(), 2, "the file's own, and ours");
}

#[test]
fn distributions_other_than_ours_are_noted_once() {
    let body = "<shape type='sphere'><bsdf type='roughplastic'/></shape>\n\
                <shape type='sphere'><bsdf type='roughconductor'/></shape>\n\
                <shape type='sphere'><bsdf type='roughplastic'><string name='distribution' value='as'/>\
                <float name='alpha_u' value='0.1'/><float name='alpha_v' value='0.3'/></bsdf></shape>";
    let scene = load_in(Path::new("."), "3.0.0", body).unwrap();
    let notes = notes(&scene);
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert_eq!(notes[0], "scene.xml:2:22: the microfacet distribution 'beckmann' is replaced by 'ggx'");
    assert_eq!(notes[1], "scene.xml:4:48: the microfacet distribution 'as' is replaced by 'ggx'");
    assert!(notes[2].starts_with("scene.xml:4:22: anisotropic roughness"));
    let MaterialKind::Plastic { roughness: ScalarSource::Constant(roughness), .. } =
        material(&scene, &scene.objects[2].material).kind
    else {
        panic!("no plastic")
    };
    assert!((roughness * roughness - 0.2).abs() < 1e-6, "the mean of the widths");
}

#[test]
fn phong_and_null_of_older_versions_are_read() {
    let text = "<shape type='sphere'><bsdf type='phong'><float name='exponent' value='50'/>\
                <rgb name='diffuseReflectance' value='0.3'/><rgb name='specularReflectance' value='0.4'/></bsdf></shape>\
                <shape type='sphere'><bsdf type='null'/></shape>";
    let scene = load_in(Path::new("."), "0.6.0", text).unwrap();
    assert_eq!(scene.notes, []);
    let phong = MaterialKind::Phong { diffuse: grey(0.3), specular: grey(0.4), exponent: constant(50.0) };
    assert_eq!(finish(&scene).kind, phong);
    assert_eq!(material(&scene, &scene.objects[1].material).kind, MaterialKind::PassThrough);
}
