//! Conductors: by name, by indices, perfect.

use super::*;

fn conductor(scene: &SceneDescription) -> (Metal, ScalarSource) {
    match &finish(scene).kind {
        MaterialKind::Conductor { metal, roughness, .. } => (metal.clone(), roughness.clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn metals_of_the_catalogue_go_by_our_names() {
    for (theirs, ours) in [
        ("Ag", "silver"),
        ("Al", "aluminium"),
        ("Au", "gold"),
        ("Cr", "chromium"),
        ("Cu", "copper"),
        ("Cu_palik", "copper"),
        ("Hg", "mercury"),
        ("Mo", "molybdenum"),
        ("Nb_palik", "niobium"),
        ("Ni_palik", "nickel"),
        ("Rh", "rhodium"),
        ("TiN_palik", "titanium nitride"),
        ("V_palik", "vanadium"),
        ("W", "tungsten"),
    ] {
        let scene =
            scene(&format!("<bsdf type='conductor'><string name='material' value='{theirs}'/></bsdf>"));
        assert_eq!(scene.notes, [], "{theirs}");
        assert!(matches!(conductor(&scene).0, Metal::Named(name) if name.value == ours), "{theirs}");
    }
}

#[test]
fn a_metal_that_is_lacking_is_named_with_what_replaces_it() {
    for (theirs, words) in [("TiC_palik", "has no measured values here"), ("unobtainium", "is not known")] {
        let scene =
            scene(&format!("<bsdf type='conductor'>\n<string name='material' value='{theirs}'/></bsdf>"));
        let expected = format!("scene.xml:3:1: the metal '{theirs}' {words} and is replaced by aluminium");
        assert_eq!(notes(&scene), [expected]);
        assert!(matches!(conductor(&scene).0, Metal::Named(name) if name.value == "aluminium"));
    }
}

#[test]
fn indices_are_relative_to_what_is_outside() {
    let scene = scene(
        "<bsdf type='conductor'><rgb name='eta' value='1, 2, 3'/><rgb name='k' value='4, 5, 6'/>\
         <float name='ext_eta' value='2'/></bsdf>",
    );
    assert_eq!(scene.notes, []);
    assert_eq!(conductor(&scene).0, Metal::Indices { eta: [0.5, 1.0, 1.5], k: [2.0, 2.5, 3.0] });
}

#[test]
fn without_a_metal_version_3_takes_a_perfect_one_and_older_ones_copper() {
    let mirror = clean("<bsdf type='conductor'><rgb name='specular_reflectance' value='0.9'/></bsdf>");
    assert_eq!(mirror.kind, MaterialKind::PerfectSpecular { reflectance: grey(0.9) });
    let rough = "<bsdf type='roughconductor'><string name='distribution' value='ggx'/></bsdf>";
    let (metal, roughness) = conductor(&scene(rough));
    assert_eq!(metal, Metal::Indices { eta: [0.0; 3], k: [1.0; 3] }, "which reflects everything");
    assert_eq!(roughness, constant(0.1f32.sqrt()));
    let old =
        load_in(Path::new("."), "0.5.0", "<shape type='sphere'><bsdf type='conductor'/></shape>").unwrap();
    assert!(matches!(conductor(&old).0, Metal::Named(name) if name.value == "copper"));
}

#[test]
fn an_anisotropic_metal_takes_the_mean_of_its_widths_and_says_so() {
    let scene = scene(
        "<bsdf type='roughconductor'><string name='distribution' value='ggx'/><string name='material' value='Au'/>\
         <float name='alpha_u' value='0.05'/><float name='alpha_v' value='0.27'/></bsdf>",
    );
    let (_, ScalarSource::Constant(roughness)) = conductor(&scene) else { panic!("no constant") };
    assert!((roughness - 0.4).abs() < 1e-6);
    assert_eq!(scene.notes.len(), 1);
}

#[test]
fn textures_of_indices_are_noted() {
    let scene = scene(&format!(
        "<bsdf type='conductor'>{}{}</bsdf>",
        checker("eta", 1.0, 2.0),
        checker("specular_reflectance", 0.5, 1.0)
    ));
    assert_eq!(notes(&scene).len(), 1, "{:?}", notes(&scene));
    assert!(notes(&scene)[0].contains("texture 'checkerboard' in bsdf 'conductor' is not supported"));
}
