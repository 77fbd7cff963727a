//! Wrappers and blends.

use super::*;

const RED: &str = "<bsdf type='diffuse' id='red'><rgb name='reflectance' value='0.8, 0, 0'/></bsdf>";
const BLUE: &str = "<bsdf type='diffuse' id='blue'><rgb name='reflectance' value='0, 0, 0.8'/></bsdf>";
const GLASS: &str = "<bsdf type='dielectric' id='glass'><float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf>";

/// Names of the parts, and the share of the second.
fn blend(material: &MaterialDescription) -> (&str, &str, ScalarSource) {
    match &material.kind {
        MaterialKind::Blend { first, second, weight } => (first, second, weight.clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn one_bsdf_within_twosided_serves_both_sides_and_a_second_the_back() {
    assert!(!clean(RED).two_sided);
    let both = clean(&format!("<bsdf type='twosided'>{RED}</bsdf>"));
    assert_eq!((both.name.as_str(), both.two_sided, both.back), ("red", true, None));
    let scene = scene(&format!("<bsdf type='twosided' id='card'>{RED}{BLUE}</bsdf>"));
    assert_eq!(scene.notes, []);
    let card = finish(&scene);
    assert_eq!((card.name.as_str(), card.back.as_ref().unwrap().value.as_str()), ("card", "blue"));
    let back = ColorSource::Constant([0.0, 0.0, 0.8]);
    assert_eq!(material(&scene, "blue").kind, MaterialKind::Matte { reflectance: back });
}

#[test]
fn a_mask_makes_holes() {
    let plain = clean(&format!("<bsdf type='mask'>{RED}</bsdf>"));
    assert_eq!(plain.opacity, constant(0.5), "Mitsuba's default");
    let number = clean(&format!("<bsdf type='mask'><float name='opacity' value='0.3'/>{RED}</bsdf>"));
    assert_eq!((number.opacity, &number.kind), (constant(0.3), &plain.kind));
    let cut = scene(&format!("<bsdf type='mask'>{}{RED}</bsdf>", checker("opacity", 0.0, 1.0)));
    assert_eq!(cut.notes, []);
    let ScalarSource::Texture(name) = &finish(&cut).opacity else { panic!("no texture") };
    assert_eq!(texture(&cut, name).kind, TextureKind::Checker { even: [0.0; 3], odd: [1.0; 3] });
    let twice = format!(
        "<bsdf type='mask'><float name='opacity' value='0.5'/><bsdf type='mask'>\
         <float name='opacity' value='0.5'/>{GLASS}</bsdf></bsdf>"
    );
    let scene = scene(&twice);
    assert_eq!((finish(&scene).opacity.clone(), sides(&scene)), (constant(0.25), (None, Some(1.5))));
}

#[test]
fn a_blend_is_named_after_its_parts_and_weighs_the_second() {
    let scene = scene(&format!(
        "<bsdf type='blendbsdf' id='paint'><float name='weight' value='0.2'/>{RED}{BLUE}</bsdf>"
    ));
    assert_eq!(scene.notes, []);
    assert_eq!(blend(finish(&scene)), ("red", "blue", constant(0.2)));
    assert_eq!(finish(&scene).name, "paint");
    let half = clean(&format!("<bsdf type='blendbsdf'>{RED}{BLUE}</bsdf>"));
    assert_eq!(blend(&half).2, constant(0.5));
    let named = format!(
        "<bsdf type='blendbsdf'><float name='weight' value='0.2'/>{}{}</bsdf>",
        RED.replace("<bsdf", "<bsdf name='bsdf_1'"),
        BLUE.replace("<bsdf", "<bsdf name='bsdf_0'")
    );
    assert_eq!(blend(&clean(&named)).0, "blue", "Mitsuba sorts by name");
    let varied =
        super::scene(&format!("<bsdf type='blendbsdf'>{}{RED}{BLUE}</bsdf>", checker("weight", 0.0, 1.0)));
    assert!(matches!(blend(finish(&varied)).2, ScalarSource::Texture(_)));
    assert_eq!(varied.notes, []);
}

#[test]
fn a_blend_takes_its_media_from_the_part_that_has_them() {
    let scene = scene(&format!("<bsdf type='blendbsdf'>{RED}{GLASS}</bsdf>"));
    assert_eq!(sides(&scene), (None, Some(1.5)));
    assert!(finish(&scene).two_sided && !material(&scene, "red").two_sided, "each part minds its own back");
    let other = GLASS.replace("1.5", "1.7").replace("glass", "flint");
    let quarrel = super::scene(&format!("<bsdf type='blendbsdf'>{GLASS}{other}</bsdf>"));
    assert_eq!(sides(&quarrel), (None, Some(1.5)));
    assert!(notes(&quarrel)[0].contains("dielectrics of different indices"));
}

#[test]
fn twosided_reaches_the_parts_of_a_blend() {
    let scene = scene(&format!("<bsdf type='twosided'><bsdf type='blendbsdf'>{RED}{BLUE}</bsdf></bsdf>"));
    assert!(["red", "blue"].iter().all(|name| material(&scene, name).two_sided));
    assert!(finish(&scene).two_sided);
}

#[test]
fn a_mixture_becomes_nested_blends_with_the_same_shares() {
    let mixture = |weights: &str| {
        let text = format!(
            "<shape type='sphere'><bsdf type='mixturebsdf' id='mix'><string name='weights' value='{weights}'/>\
             {RED}{BLUE}{GLASS}</bsdf></shape>"
        );
        load_in(Path::new("."), "0.6.0", &text)
    };
    let scene = mixture("0.5, 0.25, 0.25").unwrap();
    let (inner, last, weight) = blend(finish(&scene));
    assert_eq!((last, weight), ("glass", constant(0.25)));
    let (first, second, ScalarSource::Constant(share)) = blend(material(&scene, inner)) else { panic!() };
    assert_eq!((first, second), ("red", "blue"));
    assert!((share - 1.0 / 3.0).abs() < 1e-6, "{share}");
    let dim = mixture("0.25, 0.25, 0").unwrap();
    let (rest, black, ScalarSource::Constant(lost)) = blend(finish(&dim)) else { panic!() };
    assert_eq!((black, lost), ("black", 0.5));
    assert_eq!(blend(material(&dim, rest)), ("red", "blue", constant(0.5)), "what has no share is left out");
    let bright = mixture("1, 1, 2").unwrap();
    assert_eq!(blend(finish(&bright)).2, constant(0.5));
    assert!(notes(&bright)[0].contains("above 1 and scaled to 1"));
    assert!(mixture("1, 2").unwrap_err().message.contains("2 numbers for 3 bsdfs"));
    assert!(mixture("1, -1, 1").unwrap_err().message.contains("0 or more"));
}

#[test]
fn a_coat_over_a_matte_finish_is_plastic_and_over_others_left_out() {
    let coated = |coat: &str, inner: &str| {
        let text = format!("<shape type='sphere'><bsdf {coat}{inner}</bsdf></shape>");
        load_in(Path::new("."), "0.6.0", &text).unwrap()
    };
    let lacquer =
        coated("type='coating'><float name='intIOR' value='1.7'/><float name='extIOR' value='1'/>", RED);
    assert_eq!(lacquer.notes, []);
    let diffuse = ColorSource::Constant([0.8, 0.0, 0.0]);
    let plastic = |roughness| MaterialKind::Plastic {
        diffuse: diffuse.clone(),
        specular: grey(1.0),
        ior: 1.7,
        roughness,
        nonlinear: true,
    };
    assert_eq!(finish(&lacquer).kind, plastic(constant(0.0)));
    let rough = "type='roughcoating'><string name='distribution' value='ggx'/><float name='alpha' value='0.25'/>\
                 <float name='intIOR' value='1.7'/><float name='extIOR' value='1'/><rgb name='sigmaA' value='1'/>";
    let rough = coated(rough, RED);
    assert_eq!(finish(&rough).kind, plastic(constant(0.5)));
    assert!(notes(&rough)[0].contains("absorption of the coat"), "{:?}", rough.notes);
    let metal = coated("type='coating'>", "<bsdf type='conductor'/>");
    assert!(matches!(finish(&metal).kind, MaterialKind::Conductor { .. }));
    assert!(notes(&metal)[0].contains("the coat of bsdf 'coating' is left out"));
}

#[test]
fn what_is_nested_wrongly_is_an_error_with_its_place() {
    for (bsdf, message) in [
        ("<bsdf type='mask'/>", "bsdf 'mask' has no bsdf within"),
        (&*format!("<bsdf type='blendbsdf'>{RED}</bsdf>"), "needs two bsdfs within, not 1"),
        ("<bsdf type='blendbsdf' id='a'><ref id='a'/><ref id='a'/></bsdf>", "one within itself"),
        (&*format!("<bsdf type='mixturebsdf'>{RED}</bsdf>"), "needs `weights`"),
        (&*format!("<bsdf type='bumpmap'>{RED}</bsdf>"), "has no texture within"),
    ] {
        let error = fault(bsdf);
        assert!(error.starts_with("scene.xml:2:") && error.contains(message), "{error}");
    }
}
