//! Black backs: Mitsuba's opaque bsdfs reflect nothing on the side that normals point away from, unless they are
//! within `twosided`. Where the camera sees much of such backs, the scene was likely written for a program that does
//! not tell the sides apart; `--set import.two_sided=true` then reads it so.
//!
//! What a camera sees of a surface is measured by its signed solid angle: faces that are turned away count against
//! those that are turned to the eye, so that closed bodies seen from outside add up to nothing.

use super::notes::Notes;
use hyaline_math::{DVec3, Transform, float};
use hyaline_scene::{BoundaryDescription, ObjectDescription, SceneDescription, ShapeDescription};
use std::collections::BTreeSet;

/// Solid angle of backs from which on they are worth a note, sr: about a twentieth of what a usual lens sees.
const NOTABLE: f64 = 0.05;
/// Most triangles that are looked at.
const MAX_TRIANGLES: usize = 4_000_000;

/// Notes the objects whose black backs the first camera sees.
pub(super) fn note(scene: &SceneDescription, notes: &Notes) {
    let Some(eye) = scene.cameras.first().map(|camera| camera.placement.translation()) else { return };
    let one_sided = scene.materials.iter().filter(|material| !material.two_sided);
    let one_sided: BTreeSet<&str> = one_sided.map(|material| material.name.as_str()).collect();
    let mut budget = MAX_TRIANGLES;
    for object in &scene.objects {
        let is_opaque = object.boundary == BoundaryDescription::None && object.emission.is_none();
        if !is_opaque || !one_sided.contains(object.material.as_str()) {
            continue;
        }
        if signed_solid_angle(object, eye, &mut budget) < -NOTABLE {
            let message = "the camera sees the back of a shape whose bsdf is not within 'twosided': it is black, as \
                           Mitsuba has it; --set import.two_sided=true reads all bsdfs as two-sided";
            notes.warn(&object.source, message);
            return;
        }
    }
}

/// Solid angle of a surface, faces turned to the eye less those turned away, sr.
fn signed_solid_angle(object: &ObjectDescription, eye: DVec3, budget: &mut usize) -> f64 {
    match &object.shape {
        ShapeDescription::Rectangle { center, half_u, half_v } => {
            quadrilateral(&object.placement, *center, *half_u, *half_v, eye)
        }
        ShapeDescription::Disc { center, normal, radius, .. } => {
            // The square of the same area.
            let u = normal.normalize_or(DVec3::Z).any_orthonormal_vector();
            let v = normal.normalize_or(DVec3::Z).cross(u);
            let half = 0.5 * radius * std::f64::consts::PI.sqrt();
            quadrilateral(&object.placement, *center, u * half, v * half, eye)
        }
        ShapeDescription::Mesh { mesh, .. } if mesh.triangles.len() <= *budget => {
            *budget -= mesh.triangles.len();
            let corner = |index: u32| DVec3::from(mesh.positions[index as usize].map(f64::from));
            let faces = mesh.triangles.iter();
            faces.map(|face| triangle(&object.placement, face.map(corner), eye)).sum()
        }
        // Closed, or as likely seen from inside as from outside.
        _ => 0.0,
    }
}

fn quadrilateral(placement: &Transform, center: DVec3, u: DVec3, v: DVec3, eye: DVec3) -> f64 {
    let [a, b, c, d] = [center - u - v, center + u - v, center + u + v, center - u + v];
    triangle(placement, [a, b, c], eye) + triangle(placement, [a, c, d], eye)
}

/// Positive where the outside is turned to the eye; a mirror turns the winding and leaves the outside outside.
///
/// Source: Van Oosterom & Strackee, The Solid Angle of a Plane Triangle, IEEE Trans. Biomed. Eng. 30(2), 1983, eq. 8.
fn triangle(placement: &Transform, corners: [DVec3; 3], eye: DVec3) -> f64 {
    let [a, b, c] = corners.map(|corner| (placement.point(corner) - eye).normalize_or_zero());
    let sine = a.dot(b.cross(c));
    let cosine = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
    let outward = if placement.is_mirroring() { 2.0 } else { -2.0 };
    outward * float::f64::atan2(sine, cosine)
}

#[cfg(test)]
mod tests {
    use crate::load_mitsuba_text;
    use std::path::Path;

    fn notes(shape: &str, overrides: &[(&str, &str)]) -> Vec<String> {
        let text = format!(
            "<scene version='3.0.0'><sensor type='perspective'><transform name='to_world'>\
             <lookat origin='0, 0, 5' target='0, 0, 0' up='0, 1, 0'/></transform></sensor>{shape}</scene>"
        );
        let overrides: Vec<_> = overrides.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
        let scene = load_mitsuba_text(&text, "a.xml", Path::new("."), &overrides).unwrap();
        assert!(overrides.is_empty() || scene.materials.iter().all(|material| material.two_sided));
        scene.notes.iter().map(|note| note.message.clone()).collect()
    }

    const AWAY: &str = "<transform name='to_world'><rotate y='1' angle='180'/></transform>";

    #[test]
    fn black_backs_before_the_camera_are_noted() {
        for kind in ["rectangle", "disk"] {
            let shape = |inner: &str| format!("<shape type='{kind}'>{inner}</shape>");
            assert!(notes(&shape(""), &[]).is_empty(), "{kind} faces the camera");
            let found = notes(&shape(AWAY), &[]);
            assert!(found.len() == 1 && found[0].contains("import.two_sided=true"), "{found:?}");
            let mirrored = "<transform name='to_world'><scale x='-1'/></transform>";
            assert!(notes(&shape(mirrored), &[]).is_empty(), "a mirror leaves the front in front");
            let two_sided = AWAY.to_owned() + "<bsdf type='twosided'><bsdf type='diffuse'/></bsdf>";
            assert!(notes(&shape(&two_sided), &[]).is_empty());
            assert!(notes(&shape(AWAY), &[("import.two_sided", "true")]).is_empty());
        }
        assert!(notes("<shape type='cube'/><shape type='sphere'/>", &[]).is_empty());
    }

    #[test]
    fn the_switch_takes_true_and_false_only() {
        let overrides = [("import.two_sided".to_owned(), "yes".to_owned())];
        let text = "<scene version='3.0.0'><sensor type='perspective'/><shape type='cube'/></scene>";
        let error = load_mitsuba_text(text, "a.xml", Path::new("."), &overrides).unwrap_err().to_string();
        assert!(error.contains("import.two_sided must be true or false, not 'yes'"), "{error}");
    }

    #[test]
    fn closed_meshes_show_no_net_back() {
        let folder = tempfile::tempdir().unwrap();
        let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
        std::fs::write(folder.path().join("a.obj"), tetrahedron).unwrap();
        let load = |flip: bool, eye: &str| {
            let text = format!(
                "<scene version='3.0.0'><sensor type='perspective'><transform name='to_world'>\
                 <translate value='{eye}'/></transform></sensor><shape type='obj'>\
                 <string name='filename' value='a.obj'/><boolean name='flip_normals' value='{flip}'/></shape></scene>"
            );
            load_mitsuba_text(&text, "a.xml", folder.path(), &[]).unwrap().notes.len()
        };
        assert_eq!((load(false, "3, 2, 1"), load(true, "3, 2, 1")), (0, 0));
        assert_eq!((load(false, "0.1, 0.1, 0.1"), load(true, "0.1, 0.1, 0.1")), (1, 0), "seen from inside");
    }
}
