//! Bump and normal maps.

use super::*;

/// A folder with `n.pfm`: an upright normal and one that leans along u by 3 : 4, both encoded; and `n.png` of bytes.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut pfm = b"PF 2 1 -1.0\n".to_vec();
    [0.5f32, 0.5, 1.0, 0.8, 0.5, 0.9].iter().for_each(|value| pfm.extend(value.to_le_bytes()));
    std::fs::write(folder.path().join("n.pfm"), pfm).unwrap();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[128, 128, 255]).unwrap();
    std::fs::write(folder.path().join("n.png"), bytes).unwrap();
    folder
}

fn load(folder: &tempfile::TempDir, version: &str, bsdf: &str) -> SceneDescription {
    load_in(folder.path(), version, &format!("<shape type='sphere'>{bsdf}</shape>"))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn pixels<'a>(scene: &'a SceneDescription, name: &str) -> &'a [Rgb] {
    match &texture(scene, name).kind {
        TextureKind::Image(image) => &image.pixels,
        TextureKind::Checker { .. } => panic!("no image"),
    }
}

const MATTE: &str = "<bsdf type='diffuse' id='cloth'/>";

#[test]
fn a_bump_map_has_heights_and_a_factor() {
    let scene = scene(&format!(
        "<bsdf type='bumpmap'>{}<float name='scale' value='-0.5'/>{MATTE}</bsdf>",
        checker("arbitrary", 0.0, 2.0)
    ));
    assert_eq!(scene.notes, []);
    let Some(Relief::Bump { height, scale }) = &finish(&scene).relief else { panic!("no bump map") };
    assert_eq!(*scale, -0.5);
    assert_eq!(texture(&scene, height).kind, TextureKind::Checker { even: [0.0; 3], odd: [2.0; 3] });
    assert!(matches!(finish(&scene).kind, MaterialKind::Matte { .. }) && finish(&scene).name == "cloth");
}

#[test]
fn in_older_versions_a_texture_scales_the_heights() {
    let inner = checker("value", 0.25, 1.0);
    let bsdf = format!(
        "<bsdf type='bumpmap'><texture type='scale'><float name='scale' value='4'/>{inner}</texture>{MATTE}</bsdf>"
    );
    let scene = load(&folder(), "0.6.0", &bsdf);
    assert_eq!(scene.notes, []);
    let Some(Relief::Bump { height, scale: 1.0 }) = &finish(&scene).relief else { panic!("no bump map") };
    assert_eq!(texture(&scene, height).kind, TextureKind::Checker { even: [1.0; 3], odd: [4.0; 3] });
}

#[test]
fn a_normal_map_is_plain_numbers() {
    let normal_map = |values: &str| {
        let texture = format!(
            "<texture type='bitmap' name='normalmap'><string name='filename' value='n.png'/>{values}</texture>"
        );
        load(&folder(), "3.0.0", &format!("<bsdf type='normalmap'>{texture}{MATTE}</bsdf>"))
    };
    let scene = normal_map("<boolean name='raw' value='true'/>");
    assert_eq!(scene.notes, []);
    let Some(Relief::Normals { texture }) = &finish(&scene).relief else { panic!("no normal map") };
    assert_eq!(pixels(&scene, texture), [[128.0 / 255.0, 128.0 / 255.0, 1.0]]);
    let slip = normal_map("");
    let Some(Relief::Normals { texture }) = &finish(&slip).relief else { panic!("no normal map") };
    assert!((pixels(&slip, texture)[0][0] - 0.21586).abs() < 1e-4, "as the file says");
    assert!(notes(&slip)[0].contains("taken as sRGB") && slip.notes.len() == 1, "{:?}", slip.notes);
    assert_eq!(normal_map("<float name='gamma' value='1'/>").notes, [], "the older word for raw");
}

#[test]
fn a_normal_map_of_the_research_branch_becomes_slopes_before_it_is_interpolated() {
    let bsdf = |values: &str| {
        format!(
            "<bsdf type='normalmap'><string name='filename' value='n.pfm'/>{values}<bsdf type='dielectric'/></bsdf>"
        )
    };
    let scene = load(&folder(), "2.0.0", &bsdf("<boolean name='use_slopes' value='true'/>"));
    assert_eq!(scene.notes, []);
    let Some(Relief::Slopes { texture: name, scale: 1.0 }) = &finish(&scene).relief else {
        panic!("no slopes")
    };
    let [upright, leaning] = pixels(&scene, name) else { panic!("two pixels") };
    assert_eq!(*upright, [0.0; 3]);
    assert!((leaning[0] + 0.75).abs() < 1e-6 && leaning[1] == 0.0, "n = (0.6, 0, 0.8): {leaning:?}");
    assert_eq!(texture(&scene, name).uv_transform, [[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]], "rows go down");
    let normals = load(
        &folder(),
        "2.0.0",
        &bsdf("<boolean name='use_slopes' value='false'/><float name='tiles' value='4'/>"),
    );
    let Some(Relief::Normals { texture: name }) = &finish(&normals).relief else { panic!("no normals") };
    assert_eq!(pixels(&normals, name)[1], [0.8, 0.5, 0.9]);
    assert_eq!(texture(&normals, name).uv_transform[0], [4.0, 0.0, 0.0]);
    assert!(matches!(load(&folder(), "2.0.0", &bsdf("")).materials[0].relief, Some(Relief::Slopes { .. })));
}

#[test]
fn without_its_image_a_relief_is_flat_and_noted() {
    let bsdf = format!(
        "<bsdf type='normalmap'>\n<string name='filename' value='absent.exr'/><float name='tiles' value='4'/>{MATTE}</bsdf>"
    );
    let scene = load(&folder(), "2.0.0", &bsdf);
    assert_eq!(finish(&scene).relief, None);
    let expected = "scene.xml:3:1: the image 'absent.exr' is replaced by grey: there is no such file";
    assert_eq!(notes(&scene), [expected]);
}

#[test]
fn of_two_reliefs_the_inner_one_counts() {
    let scene = scene(&format!(
        "<bsdf type='bumpmap'>{}<bsdf type='bumpmap'>{}<float name='scale' value='3'/>{MATTE}</bsdf></bsdf>",
        checker("a", 0.0, 1.0),
        checker("b", 0.0, 1.0)
    ));
    assert!(matches!(finish(&scene).relief, Some(Relief::Bump { scale: 3.0, .. })));
    assert!(notes(&scene)[0].contains("only the inner one counts"));
}
