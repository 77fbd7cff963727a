//! Which way meshes face: bodies that are inside out are turned, other faults of the kind are told.
//!
//! A body has one inside, so its mesh can be turned by the sign of its volume. An interface says what is on each
//! side of its normals, and what shines does so along them: there the file is obeyed. A part of a compound may face
//! inward on purpose, being the hollow of another part: parts are left alone.

use hyaline_geometry::Mesh;
use hyaline_scene::{BoundaryDescription, Located, Note, ObjectDescription, ShapeDescription};

/// A mesh more open than this is a sheet: it has no volume to tell its inside by.
const OPENNESS_OF_SHEETS: f64 = 0.1;

/// The mesh with its outside out, as far as the object says where that is; notes tell what was found.
pub(super) fn settle(object: &Located<ObjectDescription>, mesh: Mesh, notes: &mut Vec<Note>) -> Mesh {
    let shines_outward = object.emission.as_ref().is_some_and(|emission| !emission.two_sided);
    let is_part = matches!(object.shape, ShapeDescription::Compound { .. });
    if is_part || (object.boundary == BoundaryDescription::None && !shines_outward) {
        return mesh;
    }
    let name = &object.name;
    let is_sheet = mesh.openness() > OPENNESS_OF_SHEETS;
    if is_sheet && matches!(object.boundary, BoundaryDescription::Solid { .. }) {
        let message = format!(
            "object '{name}' is a body of a medium, but its mesh is an open sheet: paths lose track of where they are; close it, or make it an `interface`"
        );
        notes.push(Note::warning(&object.source, message));
    }
    if is_sheet || mesh.signed_volume() >= 0.0 {
        return mesh;
    }
    match object.boundary {
        BoundaryDescription::Solid { .. } => {
            let message = format!(
                "mesh of object '{name}' is inside out: its faces look inward; as it is a body, it was turned; turn its faces to be rid of this note"
            );
            notes.push(Note::info(&object.source, message));
            mesh.turned_inside_out()
        }
        BoundaryDescription::Interface { .. } => {
            let message = format!(
                "mesh of object '{name}' is inside out: its normals look inward, so the medium named `inside` is taken to be outside of it, as the file says; turn its faces, or exchange the two media"
            );
            notes.push(Note::warning(&object.source, message));
            mesh
        }
        BoundaryDescription::None => {
            let message = format!(
                "mesh of object '{name}' shines, but it is inside out: its faces look inward, and so does the light; turn its faces, or let it shine from both sides"
            );
            notes.push(Note::warning(&object.source, message));
            mesh
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_geometry::mesh::{MeshData, generate};
    use hyaline_math::{Transform, Vec3};
    use hyaline_scene::{Emission, EmissionQuantity, GeneratedForm, Severity};

    fn object(boundary: BoundaryDescription) -> Located<ObjectDescription> {
        let shape = ShapeDescription::Generated { form: GeneratedForm::Ball, triangles: 8 };
        ObjectDescription {
            name: "thing".into(),
            shape,
            placement: Transform::IDENTITY,
            boundary,
            material: "dielectric".into(),
            slot_materials: Vec::new(),
            emission: None,
        }
        .into()
    }

    fn solid() -> Located<ObjectDescription> {
        object(BoundaryDescription::Solid { medium: "glass".into() })
    }

    /// Settles a mesh; returns its volume, and severity and text of the notes.
    fn settled(object: &Located<ObjectDescription>, mesh: Mesh) -> (f64, Vec<(Severity, String)>) {
        let mut notes = Vec::new();
        let volume = settle(object, mesh, &mut notes).signed_volume();
        (volume, notes.into_iter().map(|note| (note.severity, note.message)).collect())
    }

    fn hollow_ball() -> Mesh {
        Mesh::new(generate::hollow_ball(Vec3::ZERO, 1.0, 0.1, 400)).unwrap()
    }

    #[test]
    fn a_body_that_is_inside_out_is_turned_and_its_hollow_with_it() {
        let volume = hollow_ball().signed_volume();
        let (turned, notes) = settled(&solid(), hollow_ball().turned_inside_out());
        assert_eq!(turned, volume);
        assert!(notes[0].0 == Severity::Info && notes[0].1.contains("'thing'"), "{notes:?}");
        let (kept, notes) = settled(&solid(), hollow_ball());
        assert_eq!((kept, notes.len()), (volume, 0));
    }

    #[test]
    fn an_interface_and_a_lamp_keep_their_winding_and_are_warned_of() {
        let interface = BoundaryDescription::Interface { outside: None, inside: Some("glass".into()) };
        let mut lamp = object(BoundaryDescription::None);
        lamp.emission = Some(Emission {
            color: [1.0; 3],
            quantity: EmissionQuantity::Radiance,
            two_sided: false,
            visible_to_camera: true,
            texture: None,
            medium: None,
        });
        for object in [object(interface), lamp] {
            let (volume, notes) = settled(&object, hollow_ball().turned_inside_out());
            assert!(volume < 0.0);
            assert!(notes[0].0 == Severity::Warning && notes[0].1.contains("inside out"), "{notes:?}");
            assert!(settled(&object, hollow_ball()).1.is_empty());
        }
    }

    #[test]
    fn the_parts_of_a_compound_are_left_alone() {
        let mut object = solid();
        object.shape = ShapeDescription::Compound { parts: Vec::new() };
        let (volume, notes) = settled(&object, hollow_ball().turned_inside_out());
        assert!(volume < 0.0 && notes.is_empty());
    }

    #[test]
    fn a_few_holes_do_not_hide_that_a_body_is_inside_out_but_a_sheet_is_not_turned() {
        let mut data = generate::icosphere(Vec3::ZERO, 1.0, 320);
        data.triangles.drain(10..14);
        let (volume, notes) = settled(&solid(), Mesh::new(data).unwrap().turned_inside_out());
        assert!(volume > 0.0 && notes.len() == 1, "{notes:?}");

        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X + Vec3::Y];
        let data = MeshData {
            positions: corners.to_vec(),
            triangles: vec![[0, 1, 2], [2, 1, 3]],
            ..MeshData::default()
        };
        let (_, notes) = settled(&solid(), Mesh::new(data).unwrap());
        assert!(notes[0].0 == Severity::Warning && notes[0].1.contains("open sheet"), "{notes:?}");
    }
}
