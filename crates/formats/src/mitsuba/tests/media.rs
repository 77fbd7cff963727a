//! Media: coefficients, phase functions, grids, and where boundaries put them.

use super::{MEDIUM, SENSOR, close, load, scene};
use crate::load_mitsuba_text;
use hyaline_math::DVec3;
use hyaline_scene::{
    Absorption, BoundaryDescription, IndexDescription, MediumDescription, PhaseDescription, SceneDescription,
    SceneError,
};

/// The medium of a body that a text describes, and the messages about it.
fn medium(version: &str, kind: &str, properties: &str) -> (MediumDescription, Vec<String>) {
    let text = format!(
        "<scene version='{version}'>{SENSOR}<shape type='sphere'>\
         <medium name='interior' type='{kind}'>{properties}</medium></shape></scene>"
    );
    let scene = load(&text).unwrap_or_else(|error| panic!("{error}"));
    let notes = scene.notes.iter().map(|note| note.message.clone()).collect();
    (scene.media[0].value.clone(), notes)
}

fn sigma(medium: &MediumDescription) -> ([f32; 3], [f32; 3]) {
    let sigma_a = match medium.absorption {
        Absorption::SigmaA(sigma_a) => sigma_a,
        Absorption::None => [0.0; 3],
        _ => panic!("{:?}", medium.absorption),
    };
    (sigma_a, medium.scattering.as_ref().map_or([0.0; 3], |scattering| scattering.sigma_s))
}

#[test]
fn coefficients_are_read_in_both_spellings() {
    let of = |version: &str, text: &str| sigma(&medium(version, "homogeneous", text).0);
    assert_eq!(of("3.0.0", ""), ([0.25; 3], [0.75; 3]), "sigma_t is 1, the albedo 0.75");
    let scaled = "<float name='scale' value='2'/><rgb name='sigma_t' value='1, 2, 4'/><float name='albedo' value='0.5'/>";
    assert_eq!(of("3.0.0", scaled), ([1.0, 2.0, 4.0], [1.0, 2.0, 4.0]));
    let older = "<spectrum name='sigmaA' value='1, 2, 4'/><rgb name='sigmaS' value='8'/><float name='scale' value='0.5'/>";
    assert_eq!(of("0.6.0", older), ([0.5, 1.0, 2.0], [4.0; 3]));
    assert_eq!(of("0.6.0", "<rgb name='sigmaS' value='1'/>"), ([0.0; 3], [1.0; 3]));
    let constant = "<volume name='albedo' type='constvolume'><rgb name='value' value='0, 0.5, 1'/></volume>";
    assert_eq!(of("2.0.0", constant), ([1.0, 0.5, 0.0], [0.0, 0.5, 1.0]));
}

#[test]
fn materials_have_their_coefficients() {
    let (skin, notes) = medium(
        "0.5.0",
        "homogeneous",
        "<string name='material' value='Skin1'/><float name='scale' value='10'/>",
    );
    let (sigma_a, sigma_s) = sigma(&skin);
    assert!((sigma_a[2] - 4.8).abs() < 1e-5 && (sigma_s[0] - 7.4).abs() < 1e-5, "{sigma_a:?} {sigma_s:?}");
    assert!(notes.is_empty(), "{notes:?}");
    let forward =
        "<string name='material' value='skin1'/><phase type='hg'><float name='g' value='0.5'/></phase>";
    let (_, sigma_s) = sigma(&medium("0.5.0", "homogeneous", forward).0);
    assert!((sigma_s[0] - 1.48).abs() < 1e-5, "what was measured is (1 - g) σ_s: {sigma_s:?}");
    let (default, _) = medium("0.5.0", "homogeneous", "");
    assert!(
        (sigma(&default).1[0] - 0.74).abs() < 1e-6,
        "older versions take skin where a medium says nothing"
    );
    let (_, notes) = medium("0.5.0", "homogeneous", "<string name='material' value='lava'/>");
    assert!(notes[0].contains("'lava' is not known"), "{notes:?}");
}

#[test]
fn phase_functions_are_read() {
    let of = |phase: &str| {
        let (medium, notes) = medium("3.0.0", "homogeneous", phase);
        (medium.scattering.unwrap().phase, notes.len())
    };
    let hg = |g: f32| PhaseDescription::HenyeyGreenstein { g };
    assert_eq!(of("<phase type='isotropic'/>"), (PhaseDescription::Isotropic, 0));
    assert_eq!(of("<phase type='rayleigh'/>"), (PhaseDescription::Rayleigh, 0));
    assert_eq!(of("<phase type='hg'/>"), (hg(0.8), 0));
    assert_eq!(of("<phase type='hg'><float name='g' value='-0.5'/></phase>"), (hg(-0.5), 0));
    let double = |g1: f32, g2: f32, weight: f32| PhaseDescription::DoubleHenyeyGreenstein { g1, g2, weight };
    let forward = "<phase type='hg'><float name='g' value='0.5'/></phase>";
    let blend = format!(
        "<phase type='blendphase'><float name='weight' value='0.25'/><phase type='isotropic'/>{forward}</phase>"
    );
    assert_eq!(of(&blend), (double(0.0, 0.5, 0.25), 0));
    let named = "<phase type='blendphase'><float name='weight' value='0.25'/>\
                 <phase name='phase_1' type='isotropic'/><phase name='phase_0' type='hg'/></phase>";
    assert_eq!(of(named), (double(0.8, 0.0, 0.25), 0), "in the order of the names");
    let mixture = format!(
        "<phase type='mixturephase'><string name='weights' value='3, 1'/><phase type='hg'/>{forward}</phase>"
    );
    assert_eq!(of(&mixture), (double(0.8, 0.5, 0.25), 0));
    let air = format!(
        "<phase type='blendphase'><float name='weight' value='0.2'/><phase type='rayleigh'/>{forward}</phase>"
    );
    assert_eq!(of(&air), (PhaseDescription::Rayleigh, 1));
    // The table grows with the cosine: from 0 to 1, whose mean cosine is a third.
    let (PhaseDescription::HenyeyGreenstein { g }, 1) =
        of("<phase type='tabphase'><string name='values' value='0, 1, 2'/></phase>")
    else {
        panic!()
    };
    assert!((g - 1.0 / 3.0).abs() < 1e-6, "{g}");
    for other in ["kkay", "sggx", "microflake"] {
        assert_eq!(of(&format!("<phase type='{other}'/>")), (PhaseDescription::Isotropic, 1));
    }
}

/// A grid file of `f32`: 2 x 1 x 1 cells in the box from (0, 0, 0) to (2, 4, 6).
fn vol(channels: u32, values: &[f32]) -> Vec<u8> {
    let mut bytes = b"VOL\x03".to_vec();
    bytes.extend([1, 2, 1, 1, channels].iter().flat_map(|n: &u32| n.to_le_bytes()));
    bytes.extend([0f32, 0.0, 0.0, 2.0, 4.0, 6.0].iter().chain(values).flat_map(|n| n.to_le_bytes()));
    bytes
}

fn with_grids(version: &str, properties: &str) -> Result<SceneDescription, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: Vec<u8>| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("grey.vol", vol(1, &[1.0, 3.0]));
    write("one-hue.vol", vol(3, &[1.0, 2.0, 3.0, 2.0, 4.0, 6.0]));
    write("hues.vol", vol(3, &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0]));
    write("albedo.vol", vol(3, &[0.5, 0.0, 1.0, 0.5, 0.5, 0.0]));
    let text = format!(
        "<scene version='{version}'>{SENSOR}<shape type='cube'><bsdf type='null'/>\
         <medium name='interior' type='heterogeneous'>{properties}</medium></shape></scene>"
    );
    load_mitsuba_text(&text, "scene.xml", folder.path(), &[])
}

fn grid(name: &str, file: &str, more: &str) -> String {
    format!(
        "<volume name='{name}' type='gridvolume'><string name='filename' value='{file}.vol'/>{more}</volume>"
    )
}

#[test]
fn grids_of_extinction_become_densities() {
    let scene = with_grids(
        "3.0.0",
        &(grid("sigma_t", "grey", "") + "<float name='scale' value='4'/><float name='albedo' value='0.5'/>"),
    );
    let medium = &scene.unwrap().media[0].value;
    assert_eq!(sigma(medium), ([2.0; 3], [2.0; 3]), "coefficients where the density is 1");
    let density = medium.density.as_ref().unwrap();
    assert_eq!((density.density.size, &density.density.values[..]), ([2, 1, 1], &[1.0, 3.0][..]));
    assert_eq!(density.placement.point(DVec3::ONE), DVec3::ONE, "the unit cube, not the file's box");
    let moved = "<boolean name='use_grid_bbox' value='true'/><transform name='to_world'><translate x='1'/></transform>";
    let scene = with_grids("3.0.0", &grid("sigma_t", "grey", moved)).unwrap();
    let placement = scene.media[0].density.as_ref().unwrap().placement;
    assert_eq!(placement.point(DVec3::ONE), DVec3::new(3.0, 4.0, 6.0));
    assert_eq!(scene.notes, []);
}

#[test]
fn older_grids_have_their_outermost_points_on_their_box() {
    let text = "<string name='method' value='woodcock'/>".to_owned() + &grid("density", "grey", "");
    let scene = with_grids("0.6.0", &text).unwrap();
    let placement = scene.media[0].density.as_ref().unwrap().placement;
    // Centers of the two cells along x lie at a quarter and at three quarters of the unit cube.
    assert!(close(placement.point(DVec3::new(0.25, 0.5, 0.5)), DVec3::new(0.0, 2.0, 3.0)));
    assert!(close(placement.point(DVec3::new(0.75, 0.5, 0.5)), DVec3::new(2.0, 2.0, 3.0)));
    let boxed = "<point name='min' x='0' y='0' z='0'/><point name='max' x='1' y='1' z='1'/>";
    let scene = with_grids("0.6.0", &grid("density", "grey", boxed)).unwrap();
    let placement = scene.media[0].density.as_ref().unwrap().placement;
    assert!(close(placement.point(DVec3::new(0.75, 0.5, 0.5)), DVec3::new(1.0, 0.5, 0.5)));
}

#[test]
fn hues_of_grids_become_part_of_the_coefficients() {
    let scene =
        with_grids("3.0.0", &(grid("sigma_t", "one-hue", "") + "<float name='albedo' value='0'/>")).unwrap();
    assert_eq!(sigma(&scene.media[0].value).0, [0.5, 1.0, 1.5]);
    let density = scene.media[0].density.as_ref().unwrap();
    assert_eq!((density.density.channels, &density.density.values[..]), (1, &[2.0, 4.0][..]));
    assert_eq!(scene.notes, []);
    let scene = with_grids("3.0.0", &grid("sigma_t", "hues", "")).unwrap();
    assert!(scene.notes[0].message.contains("different hues"), "{}", scene.notes[0]);
}

#[test]
fn grids_of_albedo_go_with_the_density() {
    let both = with_grids("3.0.0", &(grid("sigma_t", "grey", "") + &grid("albedo", "albedo", ""))).unwrap();
    let density = both.media[0].density.as_ref().unwrap();
    assert_eq!(density.albedo.as_ref().unwrap().channels, 3);
    assert_eq!(sigma(&both.media[0].value).1, [0.5, 0.25, 0.5], "where nothing else is known, the mean");
    let alone = with_grids("3.0.0", &grid("albedo", "albedo", "")).unwrap();
    let density = alone.media[0].density.as_ref().unwrap();
    assert_eq!((density.density.size, &density.density.values[..]), ([1; 3], &[1.0][..]));
    let apart = "<transform name='to_world'><translate x='1'/></transform>";
    let apart =
        with_grids("3.0.0", &(grid("sigma_t", "grey", "") + &grid("albedo", "albedo", apart))).unwrap();
    assert!(apart.media[0].density.as_ref().unwrap().albedo.is_none());
    assert!(apart.notes[0].message.contains("lies elsewhere"), "{}", apart.notes[0]);
    let error = with_grids("3.0.0", &grid("albedo", "grey", "")).unwrap_err().to_string();
    assert!(error.contains("`albedo` must be from 0 to 1, but the grid has 3"), "{error}");
}

#[test]
fn emission_follows_its_grid() {
    let shining = grid("sigma_t", "grey", "") + &grid("emission", "grey", "");
    let scene = with_grids("3.0.0", &shining).unwrap();
    assert_eq!((scene.media[0].emission, scene.notes.len()), ([1.0; 3], 0));
    let other =
        with_grids("3.0.0", &(grid("sigma_t", "grey", "") + &grid("emission", "one-hue", ""))).unwrap();
    assert_eq!((other.media[0].emission, other.notes.len()), ([1.5, 3.0, 4.5], 1));
    let plain = medium("3.0.0", "homogeneous", "<rgb name='emission' value='1, 2, 3'/>");
    assert_eq!((plain.0.emission, plain.1.len()), ([1.0, 2.0, 3.0], 0));
}

#[test]
fn volumes_that_there_are_not_are_listed() {
    let scene = with_grids(
        "0.6.0",
        "<volume name='density' type='hgridvolume'/><volume name='orientation' type='gridvolume'/>",
    );
    let notes: Vec<String> = scene.unwrap().notes.iter().map(|note| note.message.clone()).collect();
    assert!(notes.iter().any(|note| note.contains("'hgridvolume' can't be read")), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("in medium 'heterogeneous'")), "{notes:?}");
    let error = with_grids("3.0.0", &grid("sigma_t", "none", "")).unwrap_err().to_string();
    assert!(error.contains("scene.xml:1:") && error.contains("there is no such file"), "{error}");
}

fn sides(scene: &SceneDescription, object: usize) -> (Option<&str>, Option<&str>) {
    match &scene.objects[object].boundary {
        BoundaryDescription::Interface { outside, inside } => (
            outside.as_ref().map(|name| name.value.as_str()),
            inside.as_ref().map(|name| name.value.as_str()),
        ),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_boundary_without_refraction_has_one_index_on_both_sides() {
    // Smoke in water: the boundary between them is read before the one that says the water's index.
    let scene = scene(&format!(
        "{MEDIUM}<medium type='homogeneous' id='smoke'/>\
         <shape type='sphere'><bsdf type='null'/><ref name='interior' id='smoke'/><ref name='exterior' id='juice'/></shape>\
         <shape type='cube'><bsdf type='dielectric'><float name='int_ior' value='1.33'/>\
         <float name='ext_ior' value='1'/></bsdf><ref name='interior' id='juice'/></shape>"
    ));
    assert_eq!(sides(&scene, 0), (Some("juice"), Some("smoke")));
    assert_eq!(scene.media.len(), 2);
    assert!(scene.media.iter().all(|medium| medium.index == IndexDescription::Constant(1.33)));
}

#[test]
fn fog_in_air_has_the_index_of_air() {
    let scene = scene(&format!(
        "{MEDIUM}<shape type='cube'><ref name='interior' id='juice'/></shape>\
         <shape type='sphere'><bsdf type='dielectric'/></shape>"
    ));
    assert_eq!(scene.surrounding.as_ref().unwrap().value, "index 1.000277");
    assert_eq!(sides(&scene, 0), (None, Some("juice")));
    let juice = scene.media.iter().find(|medium| medium.name == "juice").unwrap();
    assert_eq!(juice.index, IndexDescription::Constant(1.000_277));
}

#[test]
fn media_at_opaque_shapes_say_nothing() {
    let scene = scene(&format!(
        "{MEDIUM}<shape type='sphere'><bsdf type='diffuse'/><ref name='exterior' id='juice'/>\
         <medium name='interior' type='homogeneous'/></shape>"
    ));
    assert_eq!(scene.objects[0].boundary, BoundaryDescription::None);
    assert!(scene.media.is_empty() && scene.notes.is_empty(), "{:?}", scene.notes);
}
