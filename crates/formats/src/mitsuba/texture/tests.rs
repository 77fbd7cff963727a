//! Tests of textures: files, layouts, and what stands for what can't be read.

use crate::load_mitsuba_text;
use hyaline_scene::*;

/// A folder with `a.png`, grey 128 over white; `a.pfm`, one pixel of three colors.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[128, 255]).unwrap();
    std::fs::write(folder.path().join("a.png"), bytes).unwrap();
    let mut pfm = b"PF 1 1 -1.0\n".to_vec();
    [0.1f32, 0.2, 0.3].iter().for_each(|value| pfm.extend(value.to_le_bytes()));
    std::fs::write(folder.path().join("a.pfm"), pfm).unwrap();
    folder
}

/// A scene with a matte sphere, whose reflectance is this texture.
fn scene(texture: &str) -> SceneDescription {
    load(texture).unwrap_or_else(|error| panic!("{error}"))
}

fn load(texture: &str) -> Result<SceneDescription, SceneError> {
    let texture = texture.replacen("<texture", "<texture name='reflectance'", 1);
    let text = format!(
        "<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>\n\
         <shape type='sphere'><bsdf type='diffuse'>{texture}</bsdf></shape></scene>"
    );
    load_mitsuba_text(&text, "scene.xml", folder().path(), &[])
}

/// The texture of the sphere.
fn texture(scene: &SceneDescription) -> &TextureDescription {
    let MaterialKind::Matte { reflectance: ColorSource::Texture(name) } = &scene.materials[0].kind else {
        panic!("{:?}", scene.materials[0].kind)
    };
    scene.textures.iter().find(|texture| texture.name == name.value).unwrap()
}

fn constant(scene: &SceneDescription) -> Rgb {
    match &scene.materials[0].kind {
        MaterialKind::Matte { reflectance: ColorSource::Constant(color) } => *color,
        other => panic!("{other:?}"),
    }
}

fn bitmap(file: &str, values: &str) -> SceneDescription {
    scene(&format!("<texture type='bitmap'>\n<string name='filename' value='{file}'/>{values}</texture>"))
}

fn pixel(scene: &SceneDescription) -> Rgb {
    match &texture(scene).kind {
        TextureKind::Image(image) => image.pixels[0],
        TextureKind::Checker { .. } => panic!("no image"),
    }
}

fn only_note(scene: &SceneDescription) -> String {
    assert_eq!(scene.notes.len(), 1, "{:?}", scene.notes);
    scene.notes[0].to_string()
}

#[test]
fn values_are_taken_as_the_file_says() {
    let encoded = 128.0f32 / 255.0;
    for (values, expected) in [
        ("", 0.215_860_5),
        ("<boolean name='raw' value='true'/>", encoded),
        ("<float name='gamma' value='1'/>", encoded),
        ("<float name='gamma' value='-1'/>", 0.215_860_5),
        ("<float name='gamma' value='2'/>", encoded * encoded),
    ] {
        let scene = bitmap("a.png", values);
        assert_eq!(scene.notes, []);
        assert!((pixel(&scene)[0] - expected).abs() < 1e-6, "{values}: {:?}", pixel(&scene));
    }
    assert_eq!(pixel(&bitmap("a.pfm", "")), [0.1, 0.2, 0.3]);
}

#[test]
fn edges_and_filters_are_read() {
    let read = |values: &str| {
        let scene = bitmap("a.pfm", values);
        (texture(&scene).wrap, texture(&scene).filter, scene.notes.len())
    };
    let value = |name: &str, value: &str| format!("<string name='{name}' value='{value}'/>");
    assert_eq!(read(""), (Wrap::Repeat, TextureFilter::Bilinear, 0));
    assert_eq!(read(&value("wrap_mode", "mirror")), (Wrap::Mirror, TextureFilter::Bilinear, 0));
    assert_eq!(read(&value("wrapMode", "clamp")), (Wrap::Clamp, TextureFilter::Bilinear, 0));
    assert_eq!(read(&value("wrap_mode", "zero")), (Wrap::Clamp, TextureFilter::Bilinear, 1));
    assert_eq!(read(&value("filter_type", "nearest")), (Wrap::Repeat, TextureFilter::Nearest, 0));
    assert_eq!(read(&value("filterType", "ewa")), (Wrap::Repeat, TextureFilter::Bilinear, 0));
    let differing = value("wrapModeU", "clamp") + &value("wrapModeV", "repeat");
    assert_eq!(read(&differing), (Wrap::Clamp, TextureFilter::Bilinear, 1));
}

#[test]
fn layouts_of_all_versions_are_understood() {
    let rows = |values: &str| {
        let text = format!("<texture type='checkerboard'>{values}</texture>");
        texture(&scene(&text)).uv_transform
    };
    assert_eq!(rows(""), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let old = "<float name='uscale' value='2'/><float name='vscale' value='3'/><float name='uoffset' value='0.5'/>\
               <float name='voffset' value='0.25'/>";
    assert_eq!(rows(old), [[2.0, 0.0, 0.5], [0.0, 3.0, 0.25]]);
    let new = "<transform name='to_uv'><scale x='2' y='3'/><translate x='0.5' y='0.25'/></transform>";
    assert_eq!(rows(new), rows(old));
    let scene = bitmap("a.pfm", old);
    assert_eq!(texture(&scene).uv_transform, [[2.0, 0.0, 0.5], [0.0, -3.0, 0.75]], "its v points down");
}

#[test]
fn a_checkerboard_has_its_first_color_at_the_origin() {
    let board =
        scene("<texture type='checkerboard' id='board'><rgb name='color0' value='0.1, 0.2, 0.3'/></texture>");
    assert_eq!(texture(&board).name, "board");
    assert_eq!(texture(&board).kind, TextureKind::Checker { even: [0.1, 0.2, 0.3], odd: [0.2; 3] });
}

#[test]
fn a_factor_multiplies_what_is_within() {
    let scaled = |inner: &str| {
        scene(&format!("<texture type='scale'><float name='scale' value='0.5'/>{inner}</texture>"))
    };
    let image = scaled("<texture type='bitmap'><string name='filename' value='a.pfm'/></texture>");
    assert_eq!(pixel(&image), [0.05, 0.1, 0.15]);
    assert_eq!(constant(&scaled("<rgb name='value' value='0.2, 0.4, 0.6'/>")), [0.1, 0.2, 0.3]);
    let loops = "<texture type='scale' id='a'><ref id='a'/></texture>";
    assert!(load(loops).unwrap_err().message.contains("one within itself"));
}

#[test]
fn one_channel_becomes_grey() {
    assert_eq!(pixel(&bitmap("a.pfm", "<string name='channel' value='g'/>")), [0.2; 3]);
    let alpha = bitmap("a.pfm", "<string name='channel' value='a'/>");
    assert!(only_note(&alpha).contains("the channel 'a' of an image is not read"));
}

#[test]
fn spectra_that_are_the_same_everywhere_are_constants() {
    assert_eq!(
        constant(&scene("<texture type='uniform'><float name='value' value='0.3'/></texture>")),
        [0.3; 3]
    );
    assert_eq!(
        constant(&scene("<texture type='srgb'><rgb name='color' value='0.1, 0.2, 0.3'/></texture>")),
        [0.1, 0.2, 0.3]
    );
}

#[test]
fn what_can_not_be_read_is_grey_and_named_with_its_place() {
    for (file, reason) in
        [("no.png", "there is no such file"), ("a.tga", "images ending in '.tga' can't be read")]
    {
        let scene = bitmap(file, "");
        assert_eq!(constant(&scene), [0.5; 3]);
        assert_eq!(
            only_note(&scene),
            format!("scene.xml:3:1: the image '{file}' is replaced by grey: {reason}")
        );
    }
    for kind in ["mesh_attribute", "vertexcolors", "gridtexture", "wireframe", "curvature", "volume"] {
        let scene = scene(&format!("<texture type='{kind}'><string name='name' value='x'/></texture>"));
        assert_eq!(constant(&scene), [0.5; 3]);
        assert!(
            only_note(&scene).contains(&format!("texture '{kind}' can't be read and is replaced by grey"))
        );
    }
    let damaged = load("<texture type='bitmap'/>").unwrap_err().to_string();
    assert!(damaged.contains("needs `filename`"), "{damaged}");
}

#[test]
fn a_texture_that_is_referred_to_twice_is_one() {
    let text = "<scene version='3.0.0'><sensor type='perspective'/>\
                <texture type='bitmap' id='t'><string name='filename' value='a.pfm'/></texture>\
                <bsdf type='roughplastic' id='b'><string name='distribution' value='ggx'/>\
                <ref name='diffuse_reflectance' id='t'/><ref name='alpha' id='t'/></bsdf>\
                <shape type='sphere'><ref id='b'/></shape><shape type='cube'><ref id='b'/></shape></scene>";
    let scene = load_mitsuba_text(text, "scene.xml", folder().path(), &[]).unwrap();
    let names: Vec<&str> = scene.textures.iter().map(|texture| texture.name.as_str()).collect();
    assert_eq!(names, ["t", "t/roughness"]);
    assert_eq!(scene.materials.len(), 1);
}
