//! Tests of the TOML format: every key is read, every fault is found where it stands.

use crate::load_toml_text;
use hyaline_math::DVec3;
use hyaline_scene::*;
use std::path::Path;

fn load(text: &str) -> Result<SceneDescription, SceneError> {
    load_toml_text(text, "scene.toml", Path::new("."), &[])
}

fn load_with(text: &str, key: &str, value: &str) -> Result<SceneDescription, SceneError> {
    load_toml_text(text, "scene.toml", Path::new("."), &[(key.to_owned(), value.to_owned())])
}

/// A scene with a camera and `text`.
fn scene(text: &str) -> SceneDescription {
    let text = format!("camera = {{ from = [0, 0, 4] }}\n{text}");
    load(&text).unwrap_or_else(|error| panic!("{error}"))
}

/// The error of a scene with a camera on the first line and `text` from the second on.
fn fault(text: &str) -> String {
    load(&format!("camera = {{ from = [0, 0, 4] }}\n{text}")).unwrap_err().to_string()
}

fn close(a: DVec3, b: DVec3) -> bool {
    (a - b).length() < 1e-9
}

#[test]
fn the_sketch_of_the_format_is_read() {
    let scene = load(include_str!("../../tests/scenes/sketch.toml")).unwrap();
    assert_eq!(scene.notes, []);
    let camera = &scene.cameras[0];
    assert!(close(camera.placement.point(DVec3::ZERO), DVec3::new(0.0, 0.16, 0.42)));
    assert!(matches!(camera.projection, Projection::Perspective { fov, fov_axis: FovAxis::Y }
        if (fov - 24f64.to_radians()).abs() < 1e-12));
    let water = scene.media.iter().find(|medium| medium.name == "water").unwrap();
    assert!(matches!(&water.index, IndexDescription::Named(name) if name.value == "water"));
    let color = Absorption::ColorAt { color: [0.85, 0.95, 1.0], distance: 0.2 };
    assert_eq!(water.absorption, color);
    assert_eq!(scene.media.iter().find(|medium| medium.name == "glass").unwrap().priority, 1);
    let ShapeDescription::Vessel(vessel) = &scene.objects[0].shape else { panic!("no vessel") };
    let outer = vec![[0.030, 0.0], [0.036, 0.10]];
    assert_eq!(vessel.profile, VesselProfile::Points { outer, curve: ProfileCurve::Lines });
    assert_eq!((vessel.wall, vessel.base, vessel.rim), (0.0025, 0.008, RimKind::Round));
    assert_eq!((vessel.fill[0].level, vessel.fill[0].meniscus), (0.75, 0.002));
    assert_eq!(scene.objects[0].material.value, "dielectric");
    let finish = scene.materials.iter().find(|material| material.name == "dielectric").unwrap();
    assert!(matches!(finish.kind, MaterialKind::Dielectric { .. }));
    let lamp = &scene.objects[2];
    assert_eq!(lamp.emission.as_ref().unwrap().color, [400.0, 380.0, 350.0]);
    let ShapeDescription::Disc { center, normal, .. } = lamp.shape else { panic!("no disc") };
    assert!(close(normal, (DVec3::new(0.0, 0.05, 0.0) - center).normalize()), "`to` aims the lamp");
}

#[test]
fn every_key_is_read() {
    let scene = load(include_str!("../../tests/scenes/everything.toml")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.notes, []);
    assert_eq!(scene.settings.integrator.as_deref(), Some("whitted"));
    assert_eq!((scene.settings.passes, scene.settings.seed), (Some(8), 7));
    assert_eq!(scene.settings.sampler, SamplerKind::Independent);
    assert_eq!((scene.settings.min_weight, scene.settings.max_depth), (Some(0.01), Some(32)));
    assert_eq!(scene.settings.light_samples, Some(4));
    assert_eq!(scene.settings.debug, DebugView::Crossings);
    assert_eq!(scene.settings.photon_map.caustic_photons, 2_000_000, "the other keys: photon_map.rs");
    assert_eq!((scene.film.width, scene.film.height, scene.film.crop), (320, 200, Some([10, 20, 30, 40])));
    assert_eq!(scene.film.filter, PixelFilter::Gaussian { sigma: 0.6, radius: 2.0 });
    assert_eq!(scene.film.exposure, 1.5);
    assert_eq!(scene.cameras.len(), 5);
    let kinds: Vec<&Projection> = scene.cameras.iter().map(|camera| &camera.projection).collect();
    assert!(matches!(kinds[0], Projection::Perspective { fov_axis: FovAxis::Diagonal, .. }));
    assert!(matches!(kinds[1], Projection::ThinLens { lens_radius: 0.01, focus_distance: 2.5, .. }));
    assert!(matches!(kinds[2], Projection::Orthographic { height: 3.0 }));
    assert!(matches!(kinds[3], Projection::Fisheye { fov } if (fov - 150f64.to_radians()).abs() < 1e-12));
    assert!(matches!(kinds[4], Projection::Spherical { .. }));
    assert_eq!(scene.cameras[4].medium.as_ref().unwrap().value, "water");
    let index = |name: &str| &scene.media.iter().find(|medium| medium.name == name).unwrap().index;
    assert_eq!(*index("flint"), IndexDescription::Abbe { nd: 1.62, abbe: 36.4 });
    assert_eq!(*index("cauchy"), IndexDescription::Cauchy { a: 1.5, b: 0.004, c: 0.0 });
    assert!(matches!(index("sellmeier"), IndexDescription::Sellmeier { .. }));
    let fog = scene.media.iter().find(|medium| medium.name == "fog").unwrap();
    assert_eq!(
        fog.scattering,
        Some(Scattering { sigma_s: [0.5; 3], phase: PhaseDescription::HenyeyGreenstein { g: 0.4 } })
    );
    assert_eq!(fog.absorption, Absorption::SigmaA([0.1, 0.2, 0.3]));
    assert_eq!(scene.surrounding.as_ref().unwrap().value, "fog");
    assert_eq!(scene.textures.len(), 3, "two named and one on the spot");
    assert_eq!(scene.textures[0].uv_transform, [[4.0, 0.0, 0.5], [0.0, 2.0, 0.0]]);
    let kinds: Vec<_> = scene.lights.iter().map(|light| std::mem::discriminant(&light.kind)).collect();
    assert_eq!(kinds.len(), 5);
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    for name in ["ball", "disc-2", "annulus-3", "sheet", "corner", "copy", "lamp", "sphere-light-7"] {
        assert!(names.contains(&name), "{name} is not among {names:?}");
    }
    let object = |name: &str| scene.objects.iter().find(|object| object.name == name).unwrap();
    assert!(
        matches!(&object("sheet").boundary, BoundaryDescription::Interface { outside: Some(air), inside: Some(_) }
        if air.value == "air"),
        "air within fog is a medium of its own"
    );
    assert!(scene.media.iter().any(|m| m.name == "air" && m.index == IndexDescription::Constant(1.0)));
    assert_eq!(object("copy").boundary, object("ball").boundary, "an instance takes over the medium");
    assert_eq!(object("copy").material.value, object("ball").material.value);
    assert!(close(object("copy").placement.point(DVec3::X), DVec3::new(1.0, 0.0, -2.0)), "scale, turn, move");
}

#[test]
fn defaults_need_no_tuning() {
    let scene = scene("object = [{ kind = 'sphere' }, { kind = 'box', medium = 'air' }]\n");
    assert_eq!((scene.film.width, scene.film.height, scene.film.exposure), (640, 480, 1.0));
    assert!(matches!(scene.objects[0].shape, ShapeDescription::Sphere { radius: 1.0, .. }));
    assert_eq!(scene.objects[0].name, "sphere-1");
    let material = scene.materials.iter().find(|material| material.name == scene.objects[0].material.value);
    assert!(matches!(material.unwrap().kind, MaterialKind::Matte { .. }));
    assert_eq!(scene.objects[1].material.value, "dielectric");
    assert!(close(scene.cameras[0].placement.vector(-DVec3::Z), -DVec3::Z), "it looks at the origin");
    assert_eq!(scene.surrounding, None);
}

#[test]
fn rectangles_face_their_normal_with_v_up() {
    for normal in ["[0, 1, 0]", "[0, -1, 0]", "[0, 0, 1]", "[1, 2, 3]"] {
        let scene = scene(&format!("object = {{ kind = 'rectangle', normal = {normal}, size = [2, 4] }}"));
        let ShapeDescription::Rectangle { half_u, half_v, .. } = scene.objects[0].shape else { panic!() };
        let cross = half_u.cross(half_v);
        let numbers: Vec<f64> = normal[1..normal.len() - 1].split(", ").map(|n| n.parse().unwrap()).collect();
        let wanted = DVec3::from_slice(&numbers).normalize();
        assert!(close(cross.normalize(), wanted), "{normal}");
        assert!((cross.length() - 2.0).abs() < 1e-12 && (half_v.length() - 2.0).abs() < 1e-12);
    }
}

#[test]
fn power_becomes_intensity_and_radiance_does_not_depend_on_the_unit() {
    let lights = "light = [{ kind = 'point', power = 40 }, { kind = 'spot', power = 40, outer_angle = 180, \
                  inner_angle = 180 }, { kind = 'sphere', power = 40 }]\n";
    for (unit, factor) in [("unit = 'm'", 1.0), ("unit = 'mm'", 1e6)] {
        let scene = load(&format!("{unit}\ncamera = {{ from = [0, 0, 4] }}\n{lights}")).unwrap();
        let expected = 40.0 * factor / (4.0 * std::f32::consts::PI);
        for light in &scene.lights {
            let (LightKind::Point { intensity, .. } | LightKind::Spot { intensity, .. }) = light.kind else {
                panic!()
            };
            assert!((intensity[0] / expected - 1.0).abs() < 1e-5, "{unit}: {}", intensity[0]);
        }
        let emission = scene.objects[0].emission.as_ref().unwrap();
        assert_eq!(emission.quantity, EmissionQuantity::Power);
        assert!((emission.color[0] / (40.0 * factor) - 1.0).abs() < 1e-5);
    }
}

#[test]
fn lengths_with_units_follow_the_scene_unit() {
    let text =
        "unit = 'mm'\ncamera = { from = [0, 0, '4 m'] }\nobject = { kind = 'sphere', radius = '2 cm' }";
    let scene = load(text).unwrap();
    assert!(
        matches!(scene.objects[0].shape, ShapeDescription::Sphere { radius, .. } if (radius - 20.0).abs() < 1e-9)
    );
    assert!((scene.cameras[0].placement.translation().z - 4000.0).abs() < 1e-9);
}

#[test]
fn unknown_keys_name_the_nearest_known_one_with_line_and_column() {
    for (text, place, slip, meant) in [
        ("object = { kind = 'sphere', raduis = 1 }", "2:29", "raduis", "radius"),
        ("[[object]]\nkind = 'box'\ncentre = [0, 0, 0]", "4:1", "centre", "center"),
        ("[fimL]\nwidth = 3", "2:2", "fimL", "film"),
        ("[settings]\npases = 3", "3:1", "pases", "passes"),
        ("[media.water]\nioor = 1.3", "3:1", "ioor", "ior"),
        ("[media.water]\ncolor = { rgb = 0.5, att = 1 }", "3:22", "att", "at"),
        ("[[light]]\nkind = 'point'\npower = 1\nradiance = 2", "5:1", "radiance", ""),
        ("object = { kind = 'mesh', fiel = 'a.ply' }", "2:27", "fiel", "file"),
    ] {
        let error = fault(text);
        assert!(error.starts_with(&format!("scene.toml:{place}: unknown key `{slip}`")), "{error}");
        assert!(error.contains(&format!("did you mean '{meant}")), "{error}");
    }
}

#[test]
fn each_class_of_faults_is_found_where_it_stands() {
    let mut failures = Vec::new();
    for (text, place, message) in [
        ("object = { kind = 'spere' }", "2:19", "unknown kind 'spere'; did you mean 'sphere'?"),
        ("object = { kind = 'sphere', radius = nan }", "2:38", "`radius` must be above 0, not NaN"),
        ("object = { kind = 'sphere', radius = 0 }", "2:38", "`radius` must be above 0, not 0"),
        ("light = { kind = 'disc', radius = 0, radiance = 1 }", "2:35", "`radius` must be above 0"),
        ("light = { kind = 'rectangle', size = [1, 0], radiance = 1 }", "2:42", "`size` must be above 0"),
        ("light = { kind = 'disc' }", "2:9", "needs `radiance` or `power`"),
        ("light = { kind = 'disc', radiance = -1 }", "2:37", "`radiance` must be 0 or more"),
        ("object = { kind = 'sphere', radius = 'big' }", "2:38", "which is no length"),
        ("object = { kind = 'sphere', radius = '1 foot' }", "2:38", "unknown unit 'foot'"),
        ("object = { kind = 'sphere', center = [0, 0] }", "2:38", "`center` must have 3 values, not 2"),
        ("object = { kind = 'sphere', center = [0, inf, 0] }", "2:42", "finite number"),
        (
            "object = { kind = 'mesh', file = 'none.ply' }",
            "2:34",
            "can't read 'none.ply': there is no such file",
        ),
        ("object = { kind = 'mesh', file = 'src' }", "2:34", "not a regular file"),
        ("object = { kind = 'sphere', transform = { scale = 0 } }", "2:51", "`scale` is 0"),
        (
            "object = { kind = 'sphere', transform = { scale = 1, translate = [0, 0, 0] } }",
            "2:51",
            "exclude each other",
        ),
        (
            "object = { kind = 'sphere', medium = 'a', interface = { inside = 'b' } }",
            "2:55",
            "exclude each other",
        ),
        (
            "object = [{ kind = 'box', name = 'a' }, { kind = 'box', name = 'a' }]",
            "2:64",
            "two objects are named 'a'",
        ),
        (
            "object = { kind = 'box', name = 'a' }\nlight = { kind = 'disc', name = 'a', radiance = 1 }",
            "3:9",
            "named 'a'",
        ),
        ("object = { kind = 'instance', of = 'a' }", "2:36", "no object before this one is named 'a'"),
        ("object = { kind = 'cylinder', phi = [0, 90], capped = true }", "2:55", "can't be capped"),
        ("object = { kind = 'sphere', theta = [90, 0] }", "2:37", "rising"),
        ("object = { kind = 'vessel', outer = [[1, 0]], medium = 'a' }", "2:37", "at least two points"),
        ("object = { kind = 'vessel', outer = [[1, 0], [1, 0]], medium = 'a' }", "2:46", "same point twice"),
        ("object = { kind = 'vessel', outer = [[1, 0], [1, 1]] }", "2:10", "needs `medium`"),
        ("object = { kind = 'rectangle', normal = [0, 0, 0] }", "2:41", "must not be zero"),
        ("object = { kind = 'box', min = [0, 0, 0], max = [1, 0, 1] }", "2:49", "`max` must be above `min`"),
        ("[media.a]\nfilter = [1, 0, 1]", "3:14", "`filter` must be above 0 and at most 1"),
        ("[media.a]\nsigma_s = 1\ng = 1", "4:5", "`g` must be between -1 and 1"),
        ("[media.a]\nior = 0", "3:7", "`ior` must be above 0"),
        ("[media.a]\nfilter = 0.5\nsigma_a = 1", "4:11", "exclude each other"),
        ("[media.a]\nior = 1\n[media.a]\nior = 2", "4:", "not valid TOML"),
        ("[materials.a]\nkind = 'matte'\ncolor = 1.5", "4:9", "`color` must be from 0 to 1"),
        ("[materials.a]\nkind = 'matte'\ncolor = 'red'", "4:9", "no color"),
        ("[textures.a]\nkind = 'image'\nfile = 'none.png'", "4:8", "there is no such file"),
        ("[film]\nsize = [0, 1]", "3:9", "must be from 1 to"),
        ("[film]\ncrop = [0, 0, 641, 1]", "3:8", "within the 640 x 480 film"),
        ("[film]\nfilter = 'mitchell'", "3:10", "unknown filter"),
        ("[settings]\npasses = 1.5", "3:10", "must be a whole number"),
        ("[settings]\nintegrator = 'bdpt'", "3:14", "unknown integrator"),
        ("format_version = 2", "2:18", "this program reads 1"),
        ("unit = 'parsec'", "2:8", "unknown unit 'parsec'"),
        ("object = [\n  { kind = 'box',", "3:", "not valid TOML"),
    ] {
        let error = fault(text);
        if !error.starts_with(&format!("scene.toml:{place}")) || !error.contains(message) {
            failures.push(format!(
                "{text}
expected {place} {message}
found {error}"
            ));
        }
    }
    assert!(
        failures.is_empty(),
        "{}",
        failures.join(
            "

"
        )
    );
}

#[test]
fn a_scene_needs_a_camera_and_something_to_see() {
    let error = load("object = { kind = 'box' }").unwrap_err();
    assert!(error.message.contains("no camera") && error.remedy.unwrap().contains("[camera]"));
    let error = load("camera = { from = [0, 0, 1] }").unwrap_err();
    assert!(error.message.contains("neither an object nor a light"));
    for camera in [
        "{}",
        "{ from = [0, 0, 0] }",
        "{ from = [0, 1, 0], up = [0, 1, 0] }",
        "{ from = [1, 0, 0], fov = 180 }",
    ] {
        assert!(load(&format!("camera = {camera}\nobject = {{ kind = 'box' }}")).is_err(), "{camera}");
    }
    assert!(
        load("camera = { from = [0, 1, 0] }\nobject = { kind = 'box' }").is_ok(),
        "straight down needs no up"
    );
}

#[test]
fn overrides_change_what_is_read_and_faults_in_them_name_them() {
    let text = "[camera]\nfrom = [0, 0, 4]\n[media.water]\nior = 1.33\n[[object]]\nkind = 'vessel'\nname = 'glass'\n\
                outer = [[1, 0], [1, 2]]\nmedium = 'water'\n";
    let wall = |scene: &SceneDescription| match &scene.objects[0].shape {
        ShapeDescription::Vessel(vessel) => vessel.wall,
        _ => panic!("no vessel"),
    };
    assert_eq!(wall(&load_with(text, "object.glass.wall", "3 mm").unwrap()), 0.003);
    assert_eq!(wall(&load_with(text, "object.0.wall", "0.1").unwrap()), 0.1);
    assert_eq!(load_with(text, "settings.passes", "8").unwrap().settings.passes, Some(8));
    let index = load_with(text, "medium.water.ior", "1.4").unwrap().media[0].index.clone();
    assert_eq!(index, IndexDescription::Constant(1.4));
    let named = load_with(text, "media.water.ior", "water").unwrap().media[0].index.clone();
    assert!(matches!(named, IndexDescription::Named(name) if name.source.file.contains("--set")));
    let error = load_with(text, "camera.fovv", "30").unwrap_err().to_string();
    assert!(
        error.starts_with("--set camera.fovv=30: unknown key `fovv`") && error.contains("'fov'"),
        "{error}"
    );
    let error = load_with(text, "camera.fov", "-3").unwrap_err().to_string();
    assert!(error.starts_with("--set camera.fov=-3: `fov` must be"), "{error}");
    let error = load_with(text, "object.glas.wall", "1").unwrap_err().to_string();
    assert!(error.contains("no element is named 'glas'") && error.contains("'glass'"), "{error}");
}
