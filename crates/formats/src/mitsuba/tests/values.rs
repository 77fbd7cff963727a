//! Numbers, colors, spectra and transforms in every spelling.

use super::{camera, close, load, scene};
use hyaline_math::DVec3;
use hyaline_scene::{FovAxis, LightKind, PixelFilter, Projection, Rgb};

/// What a constant environment shines with, and how many notes that makes.
fn radiance(value: &str) -> (Rgb, usize) {
    let scene = scene(&format!("<emitter type='constant'>{value}</emitter>"));
    let LightKind::Environment { radiance, .. } = scene.lights[0].kind else { panic!() };
    (radiance, scene.notes.len())
}

fn near(a: Rgb, b: Rgb, error: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= error)
}

#[test]
fn colors_are_read_in_every_spelling() {
    for (value, expected) in [
        ("<rgb name='radiance' value='0.25, 0.5, 1'/>", [0.25, 0.5, 1.0]),
        ("<rgb name='radiance' value='0.25 0.5 1'/>", [0.25, 0.5, 1.0]),
        ("<rgb name='radiance' value='#ff0000'/>", [1.0, 0.0, 0.0]),
        ("<srgb name='radiance' value='#ff0000'/>", [1.0, 0.0, 0.0]),
        ("<srgb name='radiance' value='1, 0.5, 0'/>", [1.0, 0.214_041, 0.0]),
        ("<spectrum name='radiance' value='2'/>", [2.0; 3]),
        ("<spectrum name='radiance' value='1, 2, 3'/>", [1.0, 2.0, 3.0]),
        ("<float name='radiance' value='3'/>", [3.0; 3]),
        ("<spectrum name='intensity' value='4'/>", [4.0; 3]),
        ("<float name='scale' value='2'/><rgb name='radiance' value='1, 2, 3'/>", [2.0, 4.0, 6.0]),
        ("<spectrum name='radiance' type='uniform'><float name='value' value='2'/></spectrum>", [2.0; 3]),
        ("<spectrum name='radiance' type='d65'><float name='scale' value='3'/></spectrum>", [3.0; 3]),
        (
            "<texture name='radiance' type='srgb'><rgb name='color' value='1, 2, 3'/></texture>",
            [1.0, 2.0, 3.0],
        ),
    ] {
        let (color, notes) = radiance(value);
        assert!(near(color, expected, 1e-5) && notes == 0, "{value}: {color:?}, {notes} notes");
    }
}

#[test]
fn spectra_by_wavelengths_have_their_color() {
    // Equal energy in Rec. 709, as light; a grey as a factor.
    let equal = "<spectrum name='radiance' value='300:2, 900:2'/>";
    assert!(near(radiance(equal).0, [2.41, 1.9, 1.82], 0.03), "{:?}", radiance(equal));
    let regular = "<spectrum name='radiance' type='regular'><string name='values' value='2, 2, 2'/>\
                   <float name='wavelength_min' value='300'/><float name='wavelength_max' value='900'/></spectrum>";
    assert_eq!(radiance(regular), radiance(equal));
    let irregular = "<spectrum name='radiance' type='irregular'><string name='values' value='2, 2'/>\
                     <string name='wavelengths' value='300, 900'/></spectrum>";
    assert_eq!(radiance(irregular), radiance(equal));
    let absorbing = scene(
        "<medium type='homogeneous' id='m'><spectrum name='sigma_a' value='300:2 900:2'/></medium>\
         <shape type='sphere'><ref name='interior' id='m'/></shape>",
    );
    let hyaline_scene::Absorption::SigmaA(sigma_a) = absorbing.media[0].absorption else { panic!() };
    assert!(near(sigma_a, [2.0; 3], 1e-5), "{sigma_a:?}");
    let hot = radiance("<blackbody name='radiance' temperature='3000K' scale='0.01'/>").0;
    assert!(hot[0] > 2.0 * hot[1] && hot[1] > 2.0 * hot[2], "{hot:?}");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.spd"), "# a measurement\n300 2\n\n900\t2\n").unwrap();
    let text = "<scene version='3.0.0'><sensor type='perspective'/><emitter type='constant'>\
                <spectrum name='radiance' filename='a.spd'/></emitter></scene>";
    let scene = crate::load_mitsuba_text(text, "a.xml", folder.path(), &[]).unwrap();
    let LightKind::Environment { radiance: of_file, .. } = scene.lights[0].kind else { panic!() };
    assert_eq!((of_file, scene.notes.len()), radiance(equal));
}

#[test]
fn damaged_spectra_are_faults_with_a_place() {
    for (value, message) in [
        ("<spectrum name='radiance' value='500:1, 400:2'/>", "wavelengths of `radiance` must rise"),
        ("<spectrum name='radiance' value='500:1, 2'/>", "pairs 'wavelength:value'"),
        ("<spectrum name='radiance' value='500:x'/>", "must be a number"),
        ("<spectrum name='radiance' filename='none.spd'/>", "there is no such file"),
        ("<blackbody name='radiance' temperature='0'/>", "from 1 to 1000000 K"),
        ("<blackbody name='radiance'/>", "`temperature`"),
        ("<spectrum name='radiance' type='regular'/>", "needs `values`"),
        (
            "<spectrum name='radiance' type='irregular'><string name='values' value='1, 2'/>\
          <string name='wavelengths' value='1'/></spectrum>",
            "1 wavelengths for 2 values",
        ),
        ("<rgb name='radiance' value='1, 2'/>", "1 or 3 numbers, not 2"),
        ("<rgb name='radiance' value='-1'/>", "0 or more"),
    ] {
        let text = format!(
            "<scene version='3.0.0'><sensor type='perspective'/>\n<emitter type='constant'>{value}</emitter></scene>"
        );
        let error = load(&text).unwrap_err().to_string();
        assert!(error.starts_with("scene.xml:2:") && error.contains(message), "{error}");
    }
    // A spectrum within itself neither loops nor counts.
    let own = "<spectrum type='uniform' id='s'><ref id='s' name='value'/></spectrum>\
               <emitter type='constant'><ref name='radiance' id='s'/></emitter>";
    assert_eq!(scene(own).lights.len(), 1);
}

#[test]
fn transforms_are_read_in_every_spelling() {
    let place = |steps: &str| {
        let text = format!("<shape type='sphere'><transform name='to_world'>{steps}</transform></shape>");
        scene(&text).objects[0].placement
    };
    for (steps, expected) in [
        ("<translate value='1, 2, 3'/>", DVec3::new(2.0, 3.0, 4.0)),
        ("<translate value='1'/>", DVec3::new(2.0, 2.0, 2.0)),
        ("<translate x='1'/>", DVec3::new(2.0, 1.0, 1.0)),
        ("<scale x='2'/>", DVec3::new(2.0, 1.0, 1.0)),
        ("<scale value='2, 3, 4'/>", DVec3::new(2.0, 3.0, 4.0)),
        ("<scale value='2'/>", DVec3::new(2.0, 2.0, 2.0)),
        ("<rotate z='1' angle='90'/>", DVec3::new(-1.0, 1.0, 1.0)),
        ("<rotate value='0, 0, 2' angle='90'/>", DVec3::new(-1.0, 1.0, 1.0)),
        ("<rotate axis='0 0 1' angle='-90'/>", DVec3::new(1.0, -1.0, 1.0)),
        ("<matrix value='1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1'/>", DVec3::new(6.0, 1.0, 1.0)),
        ("<lookAt origin='0, 0, 0' target='0, 0, 1' up='0, 1, 0'/>", DVec3::new(1.0, 1.0, 1.0)),
    ] {
        let found = place(steps).point(DVec3::ONE);
        assert!(close(found, expected), "{steps}: {found}");
    }
    let moving = scene(
        "<shape type='sphere'><animation name='toWorld'><transform time='0'><translate x='2'/></transform>\
         <transform time='1'/></animation></shape>",
    );
    assert!(close(moving.objects[0].placement.translation(), DVec3::new(2.0, 0.0, 0.0)));
    assert!(moving.notes[0].message.contains("animation"), "{}", moving.notes[0]);
}

#[test]
fn look_at_needs_no_up() {
    for up in ["", "up='0, 0, 0'"] {
        let placement = camera(&format!("<lookat origin='0, 5, 0' target='0, 0, 0' {up}/>")).placement;
        assert!(close(placement.vector(-DVec3::Z), -DVec3::Y));
    }
}

/// A sensor with some properties, the projection that it gives, and the notes.
fn sensor(kind: &str, properties: &str) -> (Projection, PixelFilter, Vec<String>) {
    let text = format!(
        "<scene version='0.6.0'><sensor type='{kind}'>{properties}</sensor><shape type='sphere'/></scene>"
    );
    let scene = load(&text).unwrap();
    let notes = scene.notes.iter().map(|note| note.message.clone()).collect();
    (scene.cameras[0].projection.clone(), scene.film.filter, notes)
}

#[test]
fn fields_of_view_lie_along_every_axis() {
    for (name, axis) in [
        ("x", FovAxis::X),
        ("y", FovAxis::Y),
        ("diagonal", FovAxis::Diagonal),
        ("smaller", FovAxis::Smaller),
        ("larger", FovAxis::Larger),
    ] {
        let text = format!("<float name='fov' value='60'/><string name='fovAxis' value='{name}'/>");
        let (projection, _, notes) = sensor("perspective", &text);
        assert!(matches!(projection, Projection::Perspective { fov, fov_axis }
            if fov_axis == axis && (fov.to_degrees() - 60.0).abs() < 1e-12));
        assert!(notes.is_empty(), "{notes:?}");
    }
    let (projection, _, _) = sensor("perspective", "<string name='focalLength' value='24mm'/>");
    let Projection::Perspective { fov, fov_axis: FovAxis::Diagonal } = projection else { panic!() };
    // Half the diagonal of 36 x 24 over the focal length.
    assert!((fov.to_degrees() - 84.062).abs() < 1e-3, "{}", fov.to_degrees());
}

#[test]
fn what_a_sensor_asks_for_in_vain_is_noted() {
    let (_, filter, notes) = sensor(
        "perspective",
        "<float name='nearClip' value='0.5'/><float name='farClip' value='10000'/>\
         <float name='principalPointOffsetX' value='0.1'/><float name='shutterOpen' value='0'/>\
         <film type='ldrfilm'><rfilter type='lanczos'><integer name='lobes' value='3'/></rfilter></film>",
    );
    assert!(matches!(filter, PixelFilter::Gaussian { .. }));
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("`near_clip`")));
    assert!(notes.iter().any(|note| note.contains("`principal_point_offset_x`")));
    assert!(notes.iter().any(|note| note.contains("'lanczos'")));
    for filter in ["mitchell", "catmullrom"] {
        let notes =
            sensor("perspective", &format!("<film type='hdrfilm'><rfilter type='{filter}'/></film>")).2;
        assert!(notes.len() == 1 && notes[0].contains(filter), "{notes:?}");
    }
    let (projection, _, notes) = sensor("irradiancemeter", "");
    assert!(matches!(projection, Projection::Perspective { .. }) && notes[0].contains("irradiancemeter"));
}

#[test]
fn panoramic_and_parallel_sensors_are_read() {
    assert!(matches!(sensor("spherical", "").0, Projection::Spherical { longitude, latitude }
        if (longitude - 2.0 * latitude).abs() < 1e-12));
    let scaled = "<transform name='toWorld'><scale x='3' y='3'/></transform>\
                  <film type='hdrfilm'><integer name='width' value='200'/><integer name='height' value='100'/></film>";
    let (projection, _, notes) = sensor("orthographic", scaled);
    assert_eq!(projection, Projection::Orthographic { height: 3.0 }, "{notes:?}");
}

#[test]
fn truth_is_read_in_any_case() {
    for word in ["true", "True", "TRUE", " true "] {
        let scene =
            scene(&format!("<shape type='rectangle'><boolean name='flipNormals' value='{word}'/></shape>"));
        let hyaline_scene::ShapeDescription::Rectangle { half_u, .. } = scene.objects[0].shape else {
            panic!()
        };
        assert!(close(half_u, -DVec3::X));
    }
}
