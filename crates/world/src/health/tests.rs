use super::examine;
use crate::World;
use hyaline_math::{DVec3, Transform, Vec3};
use hyaline_scene::*;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A scene with a camera and three media; `water` and `glass` have the same priority, `ice` a higher one.
#[derive(Default)]
struct Kit(SceneDescription);

impl Kit {
    fn new() -> Self {
        let mut kit = Self::default();
        let placement = Transform::look_at(DVec3::new(0.0, 0.0, 30.0), DVec3::ZERO, DVec3::Y).unwrap();
        let projection = Projection::Perspective { fov: 0.5, fov_axis: FovAxis::Y };
        kit.0
            .cameras
            .push(CameraDescription { name: "eye".into(), placement, projection, medium: None }.into());
        for (name, index, priority) in [("water", 1.33, 0), ("glass", 1.5, 0), ("ice", 1.31, 2)] {
            let clear = MediumDescription::clear(name, IndexDescription::Constant(index));
            kit.0.media.push(MediumDescription { priority, ..clear }.into());
        }
        let white = || ColorSource::Constant([1.0; 3]);
        let clear =
            MaterialKind::Dielectric { roughness: ScalarSource::Constant(0.0), tint: (white(), white()) };
        kit.0.materials.push(MaterialDescription::new("clear", clear).into());
        let matte = MaterialKind::Matte { reflectance: ColorSource::Constant([0.5; 3]) };
        kit.0.materials.push(MaterialDescription::new("matte", matte).into());
        kit.0.lights.push(
            LightDescription {
                name: "lamp".into(),
                kind: LightKind::Point { position: DVec3::Y * 20.0, intensity: [1.0; 3] },
                medium: None,
            }
            .into(),
        );
        kit
    }

    fn object(mut self, name: &str, shape: ShapeDescription, boundary: BoundaryDescription) -> Self {
        let material = if boundary == BoundaryDescription::None { "matte" } else { "clear" };
        let object = ObjectDescription {
            name: name.into(),
            shape,
            placement: Transform::IDENTITY,
            boundary,
            material: material.into(),
            slot_materials: Vec::new(),
            emission: None,
        };
        self.0.objects.push(object.into());
        self
    }

    fn solid(self, name: &str, shape: ShapeDescription, medium: &str) -> Self {
        self.object(name, shape, BoundaryDescription::Solid { medium: medium.into() })
    }

    fn sheet(self, name: &str, shape: ShapeDescription, outside: Option<&str>, inside: Option<&str>) -> Self {
        let side = |name: Option<&str>| name.map(Into::into);
        let boundary = BoundaryDescription::Interface { outside: side(outside), inside: side(inside) };
        self.object(name, shape, boundary)
    }

    /// Everything noted, those of the compiler among it.
    fn notes(&self) -> Vec<Note> {
        let (world, mut notes) = World::compile(&self.0).unwrap();
        notes.extend(examine(&self.0, &world));
        notes
    }

    #[track_caller]
    fn assert_healthy(&self) {
        let notes = self.notes();
        assert!(notes.is_empty(), "{notes:#?}");
    }

    /// Expects one note, of this severity, with all of these words.
    #[track_caller]
    fn assert_noted(&self, severity: Severity, words: &[&str]) {
        let notes = self.notes();
        assert_eq!(notes.len(), 1, "{notes:#?}");
        assert_eq!(notes[0].severity, severity, "{notes:#?}");
        for word in words {
            assert!(notes[0].message.contains(word), "'{word}' is missing in: {}", notes[0].message);
        }
    }
}

fn ball(x: f64, radius: f64) -> ShapeDescription {
    ShapeDescription::Sphere { center: DVec3::X * x, radius, phi: [0.0, TAU], theta: [0.0, PI] }
}

fn cuboid(min: [f64; 3], max: [f64; 3]) -> ShapeDescription {
    ShapeDescription::Box { min: min.into(), max: max.into(), radius: 0.0 }
}

fn floor(y: f64) -> ShapeDescription {
    ShapeDescription::Rectangle {
        center: DVec3::new(0.0, y, 0.0),
        half_u: DVec3::Z * 50.0,
        half_v: DVec3::X * 50.0,
    }
}

fn mesh_of(data: hyaline_geometry::mesh::MeshData) -> ShapeDescription {
    let mesh = MeshData {
        positions: data.positions.iter().map(|p| p.to_array()).collect(),
        normals: data.normals.iter().flatten().map(|n| n.to_array()).collect(),
        triangles: data.triangles,
        ..MeshData::default()
    };
    ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: false }
}

fn ball_mesh() -> hyaline_geometry::mesh::MeshData {
    hyaline_geometry::mesh::generate::icosphere(Vec3::ZERO, 1.0, 320)
}

#[test]
fn healthy_scenes_get_no_notes() {
    Kit::new()
        .solid("ball", ball(0.0, 1.0), "glass")
        .solid("mesh", ShapeDescription::Generated { form: GeneratedForm::Knot, triangles: 2000 }, "glass")
        .assert_healthy();
    Kit::new()
        .object("floor", floor(-1.0), BoundaryDescription::None)
        .solid("ball", ball(0.0, 1.0), "water")
        .solid("ice", cuboid([-0.2, 0.5, -0.2], [0.2, 2.0, 0.2]), "ice")
        .assert_healthy();
    Kit::new()
        .sheet("pool", floor(0.0), None, Some("water"))
        .sheet("sunk", cuboid([0.0, -2.0, 0.0], [1.0, -1.0, 1.0]), Some("water"), Some("glass"))
        .sheet("bubble", cuboid([0.2, -1.8, 0.2], [0.5, -1.2, 0.7]), Some("glass"), None)
        .sheet("flying", cuboid([3.0, 0.5, 0.0], [4.0, 2.0, 1.0]), None, Some("glass"))
        .object("ground", floor(-5.0), BoundaryDescription::None)
        .assert_healthy();
    let shells = ShapeDescription::Generated { form: GeneratedForm::Shells, triangles: 6000 };
    Kit::new().solid("shells", shells, "glass").assert_healthy();
}

#[test]
fn a_hole_in_a_body_is_told_with_its_place_and_remedy() {
    let mut data = ball_mesh();
    data.triangles.remove(3);
    let words = ["'ball'", "3 open edges", "fill the holes", "(", "taken to have entered"];
    Kit::new().solid("ball", mesh_of(data), "glass").assert_noted(Severity::Warning, &words);
}

#[test]
fn a_flipped_face_and_a_copy_are_told() {
    let mut data = ball_mesh();
    data.triangles[5].swap(0, 1);
    Kit::new()
        .solid("ball", mesh_of(data), "glass")
        .assert_noted(Severity::Warning, &["'ball'", "wound opposite"]);
    let mut data = ball_mesh();
    data.triangles.push(data.triangles[5]);
    let kit = Kit::new().solid("ball", mesh_of(data), "glass");
    let texts: Vec<String> = kit.notes().into_iter().map(|note| note.message).collect();
    assert!(texts.iter().any(|text| text.contains("1 faces twice")), "{texts:?}");
}

#[test]
fn rims_that_another_interface_continues_are_no_holes() {
    // A ball cut at the equator: its upper half is in air, its lower half under water.
    let whole = hyaline_geometry::mesh::generate::uv_sphere(Vec3::ZERO, 1.0, 800);
    let part = |is_upper: bool| {
        let mut data = whole.clone();
        data.triangles.retain(|face| {
            let y: f32 = face.iter().map(|&i| whole.positions[i as usize].y).sum();
            (y > 0.0) == is_upper
        });
        data
    };
    // The halves alone are sheets; with a core that makes the whole nearly closed they are not.
    let with_core = |mut data: hyaline_geometry::mesh::MeshData, at: f32| {
        let first = data.positions.len() as u32;
        let mut core = hyaline_geometry::mesh::generate::icosphere(Vec3::new(0.0, at, 0.0), 40.0, 320);
        core.triangles.iter_mut().flatten().for_each(|i| *i += first);
        data.positions.extend(core.positions);
        data.normals.as_mut().unwrap().extend(core.normals.unwrap());
        data.triangles.extend(core.triangles);
        data
    };
    let kit = |lower: hyaline_geometry::mesh::MeshData| {
        Kit::new().sheet("upper", mesh_of(with_core(part(true), 100.0)), None, Some("glass")).sheet(
            "lower",
            mesh_of(with_core(lower, -100.0)),
            None,
            Some("glass"),
        )
    };
    kit(part(false)).assert_healthy();
    let mut torn = part(false);
    torn.triangles.remove(0);
    kit(torn).assert_noted(Severity::Warning, &["'lower'", "interface with 2 open edges"]);
}

#[test]
fn bodies_of_equal_priority_that_overlap_are_told_with_the_one_that_wins() {
    let words = ["'pond'", "'stone'", "'stone', the later one", "higher `priority`"];
    Kit::new()
        .solid("pond", cuboid([-3.0, -1.0, -3.0], [3.0, 0.0, 3.0]), "water")
        .solid("stone", ball(0.0, 0.5), "glass")
        .assert_noted(Severity::Warning, &words);
    // The same medium, or a priority that decides.
    Kit::new().solid("a", ball(0.0, 1.0), "glass").solid("b", ball(0.5, 1.0), "glass").assert_healthy();
    Kit::new().solid("a", ball(0.0, 1.0), "glass").solid("b", ball(0.5, 1.0), "ice").assert_healthy();
}

#[test]
fn a_body_on_a_table_and_bodies_face_to_face_are_remarked_on() {
    Kit::new()
        .object("table", floor(0.0), BoundaryDescription::None)
        .solid("block", cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]), "glass")
        .assert_noted(Severity::Info, &["'table'", "'block'", "optical contact"]);
    Kit::new()
        .solid("left", cuboid([-1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), "glass")
        .solid("right", cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]), "water")
        .assert_noted(Severity::Info, &["'left'", "'right'", "coincide", "the finish of 'right'"]);
}

#[test]
fn a_gap_too_narrow_to_be_meant_is_told() {
    Kit::new()
        .solid("left", cuboid([-1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), "glass")
        .solid("right", cuboid([5e-6, 0.0, 0.0], [1.0, 1.0, 1.0]), "glass")
        .assert_noted(Severity::Warning, &["'left'", "'right'", "apart", "film"]);
    Kit::new()
        .solid("left", cuboid([-1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), "glass")
        .solid("right", cuboid([1e-3, 0.0, 0.0], [1.0, 1.0, 1.0]), "glass")
        .assert_healthy();
}

#[test]
fn coinciding_interfaces_must_join() {
    let wall =
        |x: f64| ShapeDescription::Rectangle { center: DVec3::X * x, half_u: DVec3::Y, half_v: DVec3::Z };
    Kit::new()
        .sheet("first", wall(0.0), None, Some("glass"))
        .sheet("second", wall(0.0), Some("glass"), Some("water"))
        .assert_noted(Severity::Info, &["'first'", "'second'", "from the outermost"]);
    Kit::new()
        .sheet("first", wall(0.0), None, Some("glass"))
        .sheet("second", wall(0.0), None, Some("water"))
        .assert_noted(Severity::Warning, &["don't join", "'second', the later one"]);
}

#[test]
fn an_interface_that_names_air_where_water_is_is_to_blame() {
    let words =
        ["interface 'sunk'", "names vacuum", "'water'", "inside of 'pool'", "name 'water' as its outside"];
    Kit::new()
        .sheet("pool", floor(0.0), None, Some("water"))
        .sheet("sunk", cuboid([0.0, -2.0, 0.0], [1.0, -1.0, 1.0]), None, Some("glass"))
        .assert_noted(Severity::Warning, &words);
    // The same in a closed body of water, the ball described first.
    Kit::new()
        .sheet("sunk", ball(0.0, 0.5), None, Some("glass"))
        .sheet("tank", cuboid([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]), None, Some("water"))
        .assert_noted(Severity::Warning, &["interface 'sunk'", "inside of 'tank'"]);
}

#[test]
fn interfaces_that_overlap_or_stand_in_different_air_are_told() {
    Kit::new()
        .sheet("a", ball(0.0, 1.0), None, Some("glass"))
        .sheet("b", ball(1.0, 1.0), None, Some("water"))
        .assert_noted(Severity::Warning, &["'a'", "'b'", "overlap"]);
    Kit::new()
        .sheet("a", ball(0.0, 1.0), None, Some("glass"))
        .sheet("b", ball(3.0, 1.0), Some("water"), Some("glass"))
        .assert_noted(Severity::Warning, &["'a'", "'b'", "name the same medium"]);
}

#[test]
fn an_interface_within_a_body_is_not_seen() {
    Kit::new()
        .solid("block", cuboid([-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]), "glass")
        .sheet("bubble", ball(0.0, 1.0), Some("glass"), None)
        .assert_noted(Severity::Warning, &["interface 'bubble'", "not seen", "`priority`"]);
}

#[test]
fn walls_without_thickness_are_told() {
    // A square of two layers, front and back.
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = MeshData {
        positions: corners.to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3], [1, 0, 2], [2, 0, 3]],
        ..MeshData::default()
    };
    let shape = ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: true };
    let notes = Kit::new().solid("pane", shape, "glass").notes();
    let texts: Vec<&str> = notes.iter().map(|note| note.message.as_str()).collect();
    assert!(
        texts.iter().any(|text| text.contains("'pane'") && text.contains("thin-dielectric")),
        "{texts:?}"
    );
    Kit::new()
        .solid("slab", cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1e-9]), "glass")
        .assert_noted(Severity::Warning, &["'slab'", "without thickness"]);
    Kit::new().solid("slab", cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1e-4]), "glass").assert_healthy();
}

#[test]
fn a_compound_body_that_is_not_closed_is_told() {
    let part = |shape| ShapePart { shape, placement: Transform::IDENTITY };
    let tube = ShapeDescription::Cylinder { radius: 1.0, y: [0.0, 2.0], phi: [0.0, TAU], capped: false };
    let lid =
        ShapeDescription::Disc { center: DVec3::Y * 2.0, normal: DVec3::Y, radius: 1.0, inner_radius: 0.0 };
    let parts = vec![part(tube), part(lid)];
    Kit::new()
        .solid("cup", ShapeDescription::Compound { parts }, "glass")
        .assert_noted(Severity::Warning, &["'cup'", "don't leave it as often", "close it"]);
}

#[test]
fn normals_and_backs_of_opaque_meshes_are_told_only_where_they_matter() {
    let mut data = ball_mesh();
    let lower = |p: &Vec3| p.y < 0.0;
    for (p, n) in data.positions.iter().zip(data.normals.iter_mut().flatten()).filter(|(p, _)| lower(p)) {
        *n = -p.normalize();
    }
    Kit::new()
        .object("stone", mesh_of(data), BoundaryDescription::None)
        .assert_noted(Severity::Warning, &["'stone'", "90 degrees"]);
    let mut holed = ball_mesh();
    holed.triangles.truncate(200);
    Kit::new().object("stone", mesh_of(holed), BoundaryDescription::None).assert_healthy();

    let mut turned = ball_mesh();
    turned.triangles.iter_mut().for_each(|face| face.swap(1, 2));
    turned.normals.iter_mut().flatten().for_each(|n| *n = -*n);
    let mut kit = Kit::new().object("stone", mesh_of(turned), BoundaryDescription::None);
    kit.assert_healthy();
    kit.0.materials[1].value.two_sided = false;
    kit.assert_noted(Severity::Warning, &["'stone'", "black from outside"]);
}

#[test]
fn all_faults_of_a_description_are_found_at_once() {
    let mut kit = Kit::new().solid("a", ball(0.0, 1.0), "glas").solid("b", ball(0.0, -1.0), "glass").solid(
        "c",
        ball(0.0, 1.0),
        "watre",
    );
    kit.0.media[0].value.index = IndexDescription::Constant(-1.0);
    let faults = World::compile_or_all_faults(&kit.0).unwrap_err();
    let texts: Vec<String> = faults.iter().map(ToString::to_string).collect();
    assert_eq!(texts.len(), 4, "{texts:?}");
    for (text, word) in texts.iter().zip(["'water'", "'glas'", "'b'", "'watre'"]) {
        assert!(text.contains(word), "{texts:?}");
    }
    assert_eq!(World::compile(&kit.0).unwrap_err(), faults[0]);
}
