//! Tests of materials and textures in TOML: every key against the description, every fault with its words.

use crate::load_toml_text;
use hyaline_scene::*;
use std::path::Path;

const HEAD: &str = "camera = { from = [0, 0, 4] }\nobject = { kind = 'sphere' }\n";

fn load(text: &str) -> Result<SceneDescription, SceneError> {
    load_toml_text(&format!("{HEAD}{text}"), "scene.toml", Path::new("."), &[])
}

/// The material `m` of these keys.
fn material(keys: &str) -> MaterialDescription {
    let scene = load(&format!("[materials.m]\n{keys}")).unwrap_or_else(|error| panic!("{error}"));
    find(&scene, "m").clone()
}

fn find<'a>(scene: &'a SceneDescription, name: &str) -> &'a MaterialDescription {
    let found = scene.materials.iter().find(|material| material.name == name);
    found.unwrap_or_else(|| panic!("no material '{name}'"))
}

fn constant(value: f32) -> ScalarSource {
    ScalarSource::Constant(value)
}

fn grey(value: f32) -> ColorSource {
    ColorSource::Constant([value; 3])
}

/// A folder with `a.pfm`, two pixels in linear light, and `a.png`, one grey pixel of 128 of 255.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut pfm = b"Pf 2 1 -1.0\n".to_vec();
    [0.25f32, 1.0].iter().for_each(|value| pfm.extend(value.to_le_bytes()));
    std::fs::write(folder.path().join("a.pfm"), pfm).unwrap();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[128]).unwrap();
    std::fs::write(folder.path().join("a.png"), bytes).unwrap();
    folder
}

fn load_in(folder: &tempfile::TempDir, text: &str) -> Result<SceneDescription, SceneError> {
    load_toml_text(&format!("{HEAD}{text}"), "scene.toml", folder.path(), &[])
}

fn texture<'a>(scene: &'a SceneDescription, name: &str) -> &'a TextureDescription {
    scene
        .textures
        .iter()
        .find(|texture| texture.name == name)
        .unwrap_or_else(|| panic!("no texture '{name}'"))
}

#[test]
fn plastic_has_a_base_and_a_coat() {
    let plain = MaterialKind::Plastic {
        diffuse: grey(0.5),
        specular: grey(1.0),
        ior: 1.5,
        roughness: constant(0.0),
        nonlinear: false,
    };
    assert_eq!(material("kind = 'plastic'").kind, plain);
    let text = "kind = 'plastic'\ncolor = [0.1, 0.2, 0.3]\nspecular = 0.5\nior = 1.33\nroughness = 0.25\nnonlinear = true";
    let full = MaterialKind::Plastic {
        diffuse: ColorSource::Constant([0.1, 0.2, 0.3]),
        specular: grey(0.5),
        ior: 1.33,
        roughness: constant(0.25),
        nonlinear: true,
    };
    assert_eq!(material(text).kind, full);
}

#[test]
fn a_blend_names_its_parts_or_describes_them() {
    let scene = load(
        "[materials.m]\nkind = 'blend'\nfirst = 'wood'\nsecond = { kind = 'mirror', color = 0.9 }\nweight = 0.25\n\
         [materials.wood]\nkind = 'matte'",
    )
    .unwrap();
    let MaterialKind::Blend { first, second, weight } = &find(&scene, "m").kind else { panic!("no blend") };
    assert_eq!((first.value.as_str(), second.value.as_str(), weight), ("wood", "m/second", &constant(0.25)));
    assert_eq!(find(&scene, "m/second").kind, MaterialKind::PerfectSpecular { reflectance: grey(0.9) });
    let half = load("[materials.m]\nkind = 'blend'\nfirst = { kind = 'matte' }\nsecond = { kind = 'matte' }")
        .unwrap();
    assert!(matches!(&find(&half, "m").kind, MaterialKind::Blend { weight, .. } if *weight == constant(0.5)));
}

#[test]
fn holes_backs_and_straight_shadows_have_defaults_that_change_nothing() {
    let plain = material("kind = 'matte'");
    assert_eq!((plain.two_sided, &plain.back, &plain.relief), (true, &None, &None));
    assert_eq!((plain.opacity, plain.straight_shadows), (constant(1.0), false));
    let scene = load(
        "[materials.m]\nkind = 'matte'\nopacity = { checker = [0, 1], scale = 8 }\nback = { kind = 'black' }\n\
         [materials.glass]\nkind = 'dielectric'\nstraight_shadows = true",
    )
    .unwrap();
    let leaf = find(&scene, "m");
    assert_eq!(leaf.back.as_ref().unwrap().value, "m/back");
    assert_eq!(find(&scene, "m/back").kind, MaterialKind::Black);
    let ScalarSource::Texture(holes) = &leaf.opacity else { panic!("no texture of holes") };
    assert_eq!(texture(&scene, holes).kind, TextureKind::Checker { even: [0.0; 3], odd: [1.0; 3] });
    assert!(find(&scene, "glass").straight_shadows);
}

#[test]
fn relief_is_heights_normals_or_slopes() {
    let folder = folder();
    let relief = |text: &str| {
        let scene = load_in(&folder, &format!("unit = 'm'\n[materials.m]\nkind = 'matte'\n{text}")).unwrap();
        let relief = find(&scene, "m").relief.clone().unwrap();
        let (Relief::Bump { height: name, .. }
        | Relief::Normals { texture: name }
        | Relief::Slopes { texture: name, .. }) = &relief;
        (texture(&scene, name).clone(), relief)
    };
    let (heights, bump) = relief("bump = { image = 'a.pfm', height = '2 mm', scale = 3 }");
    assert!(matches!(bump, Relief::Bump { scale, .. } if (scale - 0.002).abs() < 1e-9));
    assert_eq!(heights.uv_transform, [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0]], "`scale` lays out, `height` lifts");
    let value = |texture: &TextureDescription| match &texture.kind {
        TextureKind::Image(image) => image.pixels[0][0],
        TextureKind::Checker { .. } => panic!("no image"),
    };
    let (plain, normals) = relief("normals = { image = 'a.png' }");
    assert!(matches!(normals, Relief::Normals { .. }));
    assert_eq!(value(&plain), 128.0 / 255.0, "normals are plain numbers");
    let (decoded, _) = relief("normals = { image = 'a.png', encoding = 'srgb' }");
    assert!((value(&decoded) - 0.2158605).abs() < 1e-6);
    assert!(matches!(
        relief("slopes = { image = 'a.pfm', factor = -0.5 }").1,
        Relief::Slopes { scale: -0.5, .. }
    ));
    assert!(matches!(relief("slopes = { image = 'a.pfm' }").1, Relief::Slopes { scale: 1.0, .. }));
}

#[test]
fn images_say_what_lies_beyond_their_edges_and_between_their_pixels() {
    let folder = folder();
    let text = "[textures.t]\nkind = 'image'\nfile = 'a.pfm'\nwrap = 'mirror'\nfilter = 'nearest'\n\
                [textures.plain]\nkind = 'image'\nfile = 'a.pfm'\n\
                [materials.m]\nkind = 'matte'\ncolor = { image = 'a.png', wrap = 'clamp' }";
    let scene = load_in(&folder, text).unwrap();
    let read = |name: &str| (texture(&scene, name).wrap, texture(&scene, name).filter);
    assert_eq!(read("t"), (Wrap::Mirror, TextureFilter::Nearest));
    assert_eq!(read("plain"), (Wrap::Repeat, TextureFilter::Bilinear));
    let MaterialKind::Matte { reflectance: ColorSource::Texture(name) } = &find(&scene, "m").kind else {
        panic!("no texture")
    };
    assert_eq!(read(name), (Wrap::Clamp, TextureFilter::Bilinear));
}

#[test]
fn faults_of_materials_name_their_place_and_a_remedy() {
    let folder = folder();
    for (keys, message) in [
        ("kind = 'plastik'", "did you mean 'plastic'?"),
        ("kind = 'plastic'\nroughnes = 0.1", "did you mean 'roughness'?"),
        ("kind = 'plastic'\nior = 0", "`ior` must be above 0 and at most 100, not 0"),
        ("kind = 'plastic'\nroughness = 1.5", "`roughness` must be from 0 to 1, not 1.5"),
        ("kind = 'plastic'\nnonlinear = 1", "`nonlinear` must be true or false"),
        ("kind = 'blend'\nsecond = 'a'", "needs `first`"),
        ("kind = 'blend'\nfirst = 'a'\nsecond = 'b'\nweight = -1", "`weight` must be from 0 to 1, not -1"),
        ("kind = 'matte'\nopacity = 2", "`opacity` must be from 0 to 1, not 2"),
        ("kind = 'matte'\nstraight_shadows = true", "`straight_shadows` is for finishes that refract"),
        ("kind = 'dielectric'\nback = 'a'", "a transparent finish has no `back`"),
        ("kind = 'matte'\nbump = { image = 'a.pfm' }", "needs `height`; add `height = \"1 mm\"`"),
        ("kind = 'matte'\nbump = { height = 1 }", "needs `texture`, `checker` or `image`"),
        ("kind = 'matte'\nnormals = { image = 'a.pfm', height = 1 }", "unknown key `height` in `normals`"),
        ("kind = 'matte'\nslopes = { image = 'a.pfm', factr = 1 }", "did you mean 'factor'?"),
        (
            "kind = 'matte'\nnormals = { image = 'a.pfm' }\nslopes = { image = 'a.pfm' }",
            "`normals` and `slopes` exclude each other",
        ),
        ("kind = 'matte'\ncolor = { image = 'a.pfm', wrap = 'repet' }", "did you mean 'repeat'?"),
        ("kind = 'matte'\ncolor = { image = 'a.pfm', filter = 'cubic' }", "unknown filter 'cubic'"),
        ("kind = 'matte'\ncolor = { checker = [0, 1], wrap = 'clamp' }", "unknown key `wrap`"),
    ] {
        let error = load_in(&folder, &format!("[materials.m]\n{keys}")).unwrap_err().to_string();
        assert!(error.contains(message), "{keys}: {error}");
        assert!(error.starts_with("scene.toml:"), "{error}");
    }
}
