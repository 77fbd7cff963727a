//! `principled` and `principledthin`.

use super::*;

fn principled(values: &str) -> SceneDescription {
    scene(&format!(
        "<bsdf type='principled' id='p'><rgb name='base_color' value='0.25, 0.36, 0.49'/>\
         <float name='roughness' value='0.3'/>{values}</bsdf>"
    ))
}

const COLOR: ColorSource = ColorSource::Constant([0.25, 0.36, 0.49]);

#[test]
fn without_metal_and_glass_it_is_plastic() {
    let scene = principled("<float name='eta' value='1.4'/>");
    let plastic = MaterialKind::Plastic {
        diffuse: COLOR,
        specular: grey(1.0),
        ior: 1.4,
        roughness: constant(0.3),
        nonlinear: false,
    };
    assert_eq!((finish(&scene).name.as_str(), &finish(&scene).kind), ("p", &plastic));
    assert_eq!(notes(&scene).len(), 1);
    assert!(notes(&scene)[0].contains("replaced by a blend of plastic, metal and glass"));
}

#[test]
fn the_index_follows_from_the_reflectance_at_normal_incidence() {
    let MaterialKind::Plastic { ior, .. } = finish(&principled("")).kind else { panic!("no plastic") };
    assert!((ior - 1.5).abs() < 1e-6, "specular is 0.5, which is 4 %: {ior}");
    let scene = principled("<float name='specular' value='0.3125'/>");
    let MaterialKind::Plastic { ior, .. } = finish(&scene).kind else { panic!("no plastic") };
    let r = (ior - 1.0) / (ior + 1.0);
    assert!((r * r - 0.025).abs() < 1e-6);
}

#[test]
fn as_metal_it_is_a_tinted_conductor_of_its_roughness() {
    let scene = principled("<float name='metallic' value='1'/>");
    let metal = Metal::Indices { eta: [0.0; 3], k: [1.0; 3] };
    assert_eq!(finish(&scene).kind, MaterialKind::Conductor { metal, roughness: constant(0.3), tint: COLOR });
    assert!(matches!(scene.objects[0].boundary, BoundaryDescription::None));
}

#[test]
fn as_glass_it_takes_the_root_of_its_color_at_each_boundary() {
    let scene = principled("<float name='spec_trans' value='1'/><float name='eta' value='1.4'/>");
    assert_eq!(scene.notes, [], "this maps as it is");
    assert_eq!(sides(&scene), (None, Some(1.4)));
    let MaterialKind::Dielectric { roughness, tint: (reflected, ColorSource::Constant(through)) } =
        &finish(&scene).kind
    else {
        panic!("no glass")
    };
    assert_eq!((roughness, reflected), (&constant(0.3), &grey(1.0)));
    assert!(through.iter().zip([0.5, 0.6, 0.7]).all(|(got, want)| (got - want).abs() < 1e-6), "{through:?}");
}

#[test]
fn shares_become_blends() {
    let scene = principled("<float name='metallic' value='0.25'/><float name='spec_trans' value='0.5'/>");
    let MaterialKind::Blend { first, second, weight } = &finish(&scene).kind else { panic!("no blend") };
    assert_eq!((second.as_str(), weight), ("conductor", &constant(0.25)));
    let MaterialKind::Blend { first, second, weight } = &material(&scene, first).kind else { panic!() };
    assert_eq!((first.as_str(), second.as_str(), weight), ("plastic", "dielectric", &constant(0.5)));
    assert_eq!(sides(&scene), (None, Some(1.5)));
}

#[test]
fn textures_stay_textures() {
    let text = format!(
        "<bsdf type='principled'>{}{}{}<float name='spec_trans' value='1'/></bsdf>",
        checker("base_color", 0.25, 0.81),
        checker("roughness", 0.1, 0.2),
        checker("metallic", 0.0, 1.0)
    );
    let scene = scene(&text);
    let MaterialKind::Blend { first, weight: ScalarSource::Texture(metallic), .. } = &finish(&scene).kind
    else {
        panic!("no blend")
    };
    assert_eq!(texture(&scene, metallic).kind, TextureKind::Checker { even: [0.0; 3], odd: [1.0; 3] });
    let MaterialKind::Dielectric { roughness: ScalarSource::Texture(roughness), tint } =
        &material(&scene, first).kind
    else {
        panic!("no glass")
    };
    let kind = &texture(&scene, roughness).kind;
    assert_eq!(*kind, TextureKind::Checker { even: [0.1; 3], odd: [0.2; 3] }, "Mitsuba's roughness is ours");
    let ColorSource::Texture(through) = &tint.1 else { panic!("no texture") };
    let TextureKind::Checker { even, odd } = texture(&scene, through).kind else { panic!() };
    assert!((even[0] - 0.5).abs() < 1e-6 && (odd[0] - 0.9).abs() < 1e-6);
}

#[test]
fn lobes_that_are_left_out_are_named_where_they_are_not_zero() {
    let scene = principled(
        "<float name='clearcoat' value='0'/><float name='clearcoat_gloss' value='0.5'/>\n\
         <float name='sheen' value='0.5'/>\n<float name='spec_tint' value='1'/>",
    );
    let notes = notes(&scene);
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert_eq!(notes[0], "scene.xml:3:1: `sheen` of bsdf 'principled' is not supported and ignored");
    assert_eq!(notes[1], "scene.xml:4:1: `spec_tint` of bsdf 'principled' is not supported and ignored");
}

#[test]
fn the_thin_one_has_a_pane_for_glass() {
    let scene = scene(
        "<bsdf type='principledthin'><rgb name='base_color' value='0.9'/><float name='spec_trans' value='0.75'/>\
         <float name='eta' value='1.3'/></bsdf>",
    );
    let MaterialKind::Blend { second, weight, .. } = &finish(&scene).kind else { panic!("no blend") };
    assert_eq!(*weight, constant(0.75));
    assert_eq!(material(&scene, second).kind, MaterialKind::ThinDielectric { ior: 1.3, tint: grey(0.9) });
    assert!(matches!(scene.objects[0].boundary, BoundaryDescription::None));
}
