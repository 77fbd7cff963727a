//! Tests of Mitsuba scenes.

mod emitters;
mod files;
mod media;
mod shapes;
mod values;

use crate::load_mitsuba_text;
use hyaline_math::DVec3;
use hyaline_scene::*;
use std::path::Path;

fn load(text: &str) -> Result<SceneDescription, SceneError> {
    load_mitsuba_text(text, "scene.xml", Path::new("."), &[])
}

const SENSOR: &str = "<sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>";

/// A scene of version 3 with a camera on its first line, and `body`.
fn scene(body: &str) -> SceneDescription {
    load(&format!("<scene version='3.0.0'>{SENSOR}\n{body}</scene>"))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn close(a: DVec3, b: DVec3) -> bool {
    (a - b).length() < 1e-9
}

fn camera(transform: &str) -> CameraDescription {
    let text = format!(
        "<scene version='3.0.0'><sensor type='perspective'><transform name='to_world'>{transform}</transform>\
         </sensor><shape type='sphere'/></scene>"
    );
    load(&text).unwrap().cameras[0].value.clone()
}

#[test]
fn look_at_becomes_a_camera_that_looks_along_minus_z() {
    let camera = camera("<lookat origin='1, 2, 3' target='1, 2, -3' up='0, 1, 0'/>").placement;
    assert!(close(camera.point(DVec3::ZERO), DVec3::new(1.0, 2.0, 3.0)));
    assert!(close(camera.vector(-DVec3::Z), -DVec3::Z), "it looks at the target");
    assert!(close(camera.vector(DVec3::X), DVec3::X), "x is to the right");
    assert!(close(camera.vector(DVec3::Y), DVec3::Y));
    assert!(!camera.is_mirroring());
}

#[test]
fn matrices_act_on_columns_and_are_written_by_rows() {
    let look_at = camera("<lookat origin='3, 1, 2' target='0, 0.5, 0' up='0, 1, 0'/>").placement;
    let forward = DVec3::new(-3.0, -0.5, -2.0).normalize();
    let left = DVec3::Y.cross(forward).normalize();
    let up = forward.cross(left);
    let row = |i: usize, t: f64| format!("{} {} {} {t} ", left[i], up[i], forward[i]);
    let text = format!("<matrix value='{}{}{}0 0 0 1'/>", row(0, 3.0), row(1, 1.0), row(2, 2.0));
    let matrix = camera(&text).placement;
    for v in [DVec3::X, DVec3::Y, DVec3::Z] {
        assert!(close(matrix.vector(v), look_at.vector(v)));
    }
    let scene = scene(
        "<shape type='rectangle'><transform name='to_world'>\
         <matrix value='0 2 0 5  0 0 3 6  4 0 0 7  0 0 0 1'/></transform></shape>",
    );
    let placement = scene.objects[0].placement;
    assert!(close(placement.point(DVec3::X), DVec3::new(5.0, 6.0, 11.0)));
    assert!(close(placement.point(DVec3::Y), DVec3::new(7.0, 6.0, 7.0)));
    let nine = camera("<matrix value='1 0 0  0 1 0  0 0 1'/>").placement;
    assert!(close(nine.vector(-DVec3::Z), DVec3::Z), "Mitsuba's cameras look along +z");
}

#[test]
fn steps_of_a_transform_apply_in_order() {
    let scene = scene(
        "<shape type='sphere'><transform name='to_world'><scale value='2'/><rotate y='1' angle='90'/>\
         <translate x='1' y='2'/></transform></shape>",
    );
    assert!(close(scene.objects[0].placement.point(DVec3::X), DVec3::new(1.0, 2.0, -2.0)));
}

#[test]
fn film_filter_and_field_of_view_are_obeyed() {
    let text = "<scene version='3.0.0'><integrator type='volpath'><integer name='max_depth' value='48'/></integrator>\
                <sensor type='thinlens' id='eye'><string name='fov_axis' value='larger'/><float name='fov' value='30'/>\
                <float name='aperture_radius' value='0.02'/><float name='focus_distance' value='3'/>\
                <sampler type='multijitter'><integer name='sample_count' value='64'/></sampler>\
                <film type='hdrfilm'><integer name='width' value='100'/><integer name='height' value='50'/>\
                <integer name='crop_offset_x' value='10'/><integer name='crop_width' value='20'/>\
                <rfilter type='tent'/></film></sensor><shape type='sphere'/></scene>";
    let scene = load(text).unwrap();
    assert_eq!(scene.notes, []);
    assert_eq!((scene.film.width, scene.film.height, scene.film.crop), (100, 50, Some([10, 0, 30, 50])));
    assert_eq!(scene.film.filter, PixelFilter::Tent(1.0));
    let asked = FileIntegrator { name: "volpath".to_owned(), max_depth: Some(48), spp: Some(64) };
    assert_eq!(scene.settings.file_integrator, Some(asked));
    assert_eq!(scene.cameras[0].name, "eye");
    let fov = 30f64.to_radians();
    let (fov_axis, lens_radius, focus_distance) = (FovAxis::Larger, 0.02, 3.0);
    assert_eq!(
        scene.cameras[0].projection,
        Projection::ThinLens { fov, fov_axis, lens_radius, focus_distance }
    );
}

#[test]
fn without_a_field_of_view_a_50_mm_lens_counts() {
    let Projection::Perspective { fov, fov_axis } = camera("").projection else { panic!("not perspective") };
    assert_eq!(fov_axis, FovAxis::Diagonal);
    assert!((fov.to_degrees() - 46.793).abs() < 1e-3, "{}", fov.to_degrees());
}

const MEDIUM: &str = "<medium type='homogeneous' id='juice'><float name='scale' value='2'/>\
                      <rgb name='sigma_t' value='1, 2, 3'/><rgb name='albedo' value='0, 0.5, 0'/></medium>";

#[test]
fn a_dielectric_names_the_media_of_both_sides() {
    let scene = scene(&format!(
        "{MEDIUM}<shape type='sphere' id='ball'><bsdf type='dielectric'><float name='int_ior' value='1.5'/>\
         <float name='ext_ior' value='1'/></bsdf></shape>\
         <shape type='sphere' id='drop'><bsdf type='dielectric'><float name='int_ior' value='1.5'/>\
         <float name='ext_ior' value='1.33'/></bsdf><ref name='exterior' id='juice'/></shape>\
         <shape type='sphere' id='bubble'><bsdf type='dielectric'><float name='int_ior' value='1'/>\
         <float name='ext_ior' value='1.4'/></bsdf><ref name='exterior' id='juice'/></shape>"
    ));
    assert_eq!(scene.notes, []);
    let sides = |i: usize| match &scene.objects[i].boundary {
        BoundaryDescription::Interface { outside, inside } => {
            (outside.as_ref().map(|n| n.value.clone()), inside.as_ref().map(|n| n.value.clone()))
        }
        other => panic!("{other:?}"),
    };
    let name = |text: &str| Some(text.to_owned());
    assert_eq!(sides(0), (None, name("index 1.5")), "outside is the world");
    assert_eq!(sides(1), (name("juice"), name("index 1.5")), "one medium for one content");
    assert_eq!(sides(2), (name("juice @ 1.4"), None), "another index is another medium");
    assert_eq!(scene.media.len(), 3);
    let juice = scene.media.iter().find(|medium| medium.name == "juice").unwrap();
    assert_eq!(juice.index, IndexDescription::Constant(1.33));
    assert_eq!(juice.absorption, Absorption::SigmaA([2.0, 2.0, 6.0]));
    assert_eq!(
        juice.scattering,
        Some(Scattering { sigma_s: [0.0, 2.0, 0.0], phase: PhaseDescription::Isotropic })
    );
    assert_eq!(scene.surrounding, None);
}

#[test]
fn where_boundaries_say_air_the_world_is_air() {
    let scene = scene("<shape type='sphere'><bsdf type='dielectric'/></shape>");
    let BoundaryDescription::Interface { outside, .. } = &scene.objects[0].boundary else { panic!() };
    assert_eq!(scene.surrounding.as_ref().unwrap().value, outside.as_ref().unwrap().value);
    assert_eq!(scene.media[1].index, IndexDescription::Constant(1.000_277));
}

#[test]
fn the_camera_stands_in_the_medium_it_names() {
    let text = format!(
        "<scene version='3.0.0'>{MEDIUM}<sensor type='perspective'><ref name='medium' id='juice'/></sensor>\
         <shape type='sphere'><bsdf type='dielectric'><string name='int_ior' value='water'/>\
         <float name='ext_ior' value='1'/></bsdf><ref name='interior' id='juice'/></shape></scene>"
    );
    let scene = load(&text).unwrap();
    assert_eq!(scene.cameras[0].medium.as_ref().unwrap().value, "juice", "with the index of its boundary");
    assert_eq!(scene.media.len(), 1);
}

#[test]
fn a_boundary_without_refraction_passes_light_through() {
    for bsdf in ["<bsdf type='null'/>", ""] {
        let scene =
            scene(&format!("{MEDIUM}<shape type='cube'>{bsdf}<ref name='interior' id='juice'/></shape>"));
        let object = &scene.objects[0];
        assert!(
            matches!(&object.boundary, BoundaryDescription::Interface { outside: None, inside: Some(name) }
            if name.value == "juice")
        );
        let material =
            scene.materials.iter().find(|material| material.name == object.material.value).unwrap();
        assert_eq!(material.kind, MaterialKind::PassThrough);
    }
}

#[test]
fn finishes_are_read() {
    let kind = |bsdf: &str| {
        let scene = scene(&format!("<shape type='sphere'>{bsdf}</shape>"));
        (scene.materials[0].kind.clone(), scene.materials[0].two_sided, scene.notes.len())
    };
    let constant = |value: [f32; 3]| ColorSource::Constant(value);
    let matte = "<bsdf type='diffuse'><rgb name='reflectance' value='0.1, 0.2, 0.3'/></bsdf>";
    let reflectance = constant([0.1, 0.2, 0.3]);
    assert_eq!(
        kind(matte),
        (MaterialKind::Matte { reflectance: reflectance.clone() }, false, 0),
        "one-sided"
    );
    assert_eq!(
        kind(&format!("<bsdf type='twosided'>{matte}</bsdf>")),
        (MaterialKind::Matte { reflectance }, true, 0)
    );
    let mirror = "<bsdf type='conductor'><string name='material' value='none'/>\
                  <rgb name='specular_reflectance' value='0.9'/></bsdf>";
    assert_eq!(kind(mirror).0, MaterialKind::PerfectSpecular { reflectance: constant([0.9; 3]) });
    let gold = "<bsdf type='roughconductor'><string name='material' value='Au'/><float name='alpha' value='0.25'/>\
                <string name='distribution' value='ggx'/></bsdf>";
    assert!(
        matches!(kind(gold), (MaterialKind::Conductor { metal: Metal::Named(name), roughness, .. }, _, 0)
        if name.value == "gold" && roughness == ScalarSource::Constant(0.5)),
        "alpha is roughness squared"
    );
    let rough = "<bsdf type='roughdielectric'><float name='alpha' value='0.04'/>\
                 <string name='distribution' value='ggx'/></bsdf>";
    assert!(matches!(kind(rough).0, MaterialKind::Dielectric { roughness: ScalarSource::Constant(r), .. }
        if (r - 0.2).abs() < 1e-6));
    let thin = "<bsdf type='thindielectric'><float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf>";
    assert!(matches!(kind(thin), (MaterialKind::ThinDielectric { ior: 1.5, .. }, true, 0)));
    assert!(matches!(kind("<bsdf type='plastic'/>"), (MaterialKind::Plastic { .. }, false, 0)));
    assert!(matches!(kind("<bsdf type='hair'/>"), (MaterialKind::Matte { .. }, false, 1)));
}

#[test]
fn emitters_are_read() {
    let scene = scene(
        "<shape type='rectangle'><emitter type='area'><rgb name='radiance' value='1, 2, 3'/></emitter></shape>\
         <emitter type='constant'><rgb name='radiance' value='0.5'/></emitter>\
         <emitter type='point'><point name='position' x='1' y='2' z='3'/><rgb name='intensity' value='4'/></emitter>\
         <emitter type='spot'><transform name='to_world'><lookat origin='0, 1, 0' target='0, 0, 0' up='1, 0, 0'/>\
         </transform><float name='cutoff_angle' value='40'/></emitter>\
         <emitter type='directional'><vector name='direction' x='0' y='-1' z='0'/></emitter>\
         <emitter type='sunsky'/>",
    );
    let emission = scene.objects[0].emission.as_ref().unwrap();
    assert_eq!((emission.color, emission.two_sided), ([1.0, 2.0, 3.0], false));
    let LightKind::Spot { direction, inner_angle, outer_angle, falloff, .. } = scene.lights[2].kind else {
        panic!()
    };
    assert!(close(direction, -DVec3::Y));
    assert!((outer_angle.to_degrees() - 40.0).abs() < 1e-9 && (inner_angle.to_degrees() - 30.0).abs() < 1e-9);
    assert_eq!(falloff, SpotFalloff::LinearInAngle);
    assert_eq!(scene.lights.len(), 4);
    assert_eq!(scene.notes.len(), 1);
    assert!(scene.notes[0].to_string().starts_with("scene.xml:2:"), "{}", scene.notes[0]);
}

#[test]
fn what_is_not_supported_is_noted_once_with_its_place() {
    let scene = scene(
        "<shape type='sphere'><float name='strange' value='1'/></shape>\n\
         <shape type='sphere'><float name='strange' value='2'/></shape>\n<shape type='hair'/>\n<hide/>",
    );
    let notes: Vec<String> = scene.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert_eq!(notes[0], "scene.xml:4:1: shape 'hair' is not supported and left out");
    assert_eq!(notes[1], "scene.xml:2:22: `strange` of shape 'sphere' is not supported and ignored");
    assert!(notes[2].starts_with("scene.xml:5:1: the element <hide>"));
    assert!(scene.notes.iter().all(|note| note.severity == Severity::Warning));
}

#[test]
fn parameters_and_older_names_are_understood() {
    let text = "<scene version='0.6.0'><default name='n' value='1.4'/><sensor type='perspective'>\
                <transform name='toWorld'><lookAt origin='0, 0, 5' target='0, 0, 0' up='0, 1, 0'/></transform>\
                </sensor><shape type='sphere'><bsdf type='dielectric'><float name='intIOR' value='$n'/>\
                <float name='extIOR' value='1'/></bsdf></shape></scene>";
    let scene = load(text).unwrap();
    assert_eq!(scene.notes, []);
    assert_eq!(scene.media[0].index, IndexDescription::Constant(1.4));
    assert!(close(scene.cameras[0].placement.translation(), DVec3::new(0.0, 0.0, 5.0)));
}

#[test]
fn flipped_normals_swap_sides() {
    let scene = scene(
        "<shape type='sphere'><boolean name='flip_normals' value='true'/><bsdf type='dielectric'>\
         <float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf></shape>\
         <shape type='rectangle'><boolean name='flip_normals' value='true'/></shape>",
    );
    assert!(matches!(
        &scene.objects[0].boundary,
        BoundaryDescription::Interface { outside: Some(_), inside: None }
    ));
    let ShapeDescription::Rectangle { half_u, half_v, .. } = scene.objects[1].shape else { panic!() };
    assert!(close(half_u.cross(half_v), -DVec3::Z));
}

#[test]
fn cylinders_stand_between_their_ends() {
    let scene = scene(
        "<shape type='cylinder'><point name='p0' x='1' y='0' z='0'/><point name='p1' x='1' y='0' z='3'/>\
         <float name='radius' value='0.5'/></shape>",
    );
    let ShapeDescription::Cylinder { radius, y, capped, .. } = scene.objects[0].shape else { panic!() };
    assert_eq!((radius, y, capped), (0.5, [0.0, 3.0], false));
    let top = scene.objects[0].placement.point(DVec3::new(0.0, 3.0, 0.0));
    assert!(close(top, DVec3::new(1.0, 0.0, 3.0)), "{top}");
}

#[test]
fn overrides_reach_what_can_be_changed() {
    let text = format!(
        "<scene version='3.0.0'>{MEDIUM}{SENSOR}<shape type='sphere' id='ball'><bsdf type='dielectric'>\
         <float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf>\
         <ref name='interior' id='juice'/></shape><shape type='sphere' id='lamp'><emitter type='area'/></shape></scene>"
    );
    let set = |key: &str, value: &str| {
        load_mitsuba_text(&text, "scene.xml", Path::new("."), &[(key.to_owned(), value.to_owned())])
    };
    assert_eq!(set("film.size", "[32, 16]").unwrap().film.width, 32);
    let cropped = text.replace("<rfilter", "<integer name='crop_width' value='700'/><rfilter");
    let smaller = [("film.size".to_owned(), "[32, 16]".to_owned())];
    assert!(
        load_mitsuba_text(&cropped, "scene.xml", Path::new("."), &smaller)
            .unwrap_err()
            .message
            .contains("crop")
    );
    assert_eq!(set("settings.passes", "4").unwrap().settings.passes, Some(4));
    assert!(
        matches!(set("camera.fov", "20").unwrap().cameras[0].projection, Projection::Perspective { fov, .. }
        if (fov - 20f64.to_radians()).abs() < 1e-12)
    );
    let moved = set("camera.from", "[0, 0, 9]").unwrap().cameras[0].placement.translation();
    assert!(close(moved, DVec3::new(0.0, 0.0, 9.0)));
    assert_eq!(set("media.juice.ior", "1.3").unwrap().media[0].index, IndexDescription::Constant(1.3));
    let lamp =
        set("object.lamp.emission.radiance", "[4, 5, 6]").unwrap().objects[1].emission.clone().unwrap();
    assert_eq!(lamp.color, [4.0, 5.0, 6.0]);
    assert_eq!(set("object.ball.material", "black").unwrap().objects[0].material.value, "black");
    for (key, message) in [
        ("object.bal.material", "did you mean 'ball'?"),
        ("object.ball.materail", "'material'"),
        ("camera.fovv", "'fov'"),
        ("lamp.power", "unknown key `lamp`"),
    ] {
        let error = set(key, "1").unwrap_err().to_string();
        assert!(error.contains(message) && error.contains(key), "{error}");
    }
}
