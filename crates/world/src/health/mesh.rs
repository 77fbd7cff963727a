//! Facts about meshes as notes: what is wrong, what it is taken for, what to do.

use super::rim::Rims;
use super::subject::{Scene, at, number};
use hyaline_geometry::ItemGeometry;
use hyaline_geometry::bvh::MeshBvh;
use hyaline_geometry::mesh::MeshHealth;
use hyaline_geometry::mesh::health::Marked;
use hyaline_math::{Transform, Vec3};
use hyaline_scattering::{BoundaryKind, ObjectId};
use hyaline_scene::{Note, Severity};
use std::sync::Arc;

/// A mesh more open than this is a sheet and meant to be one.
const OPENNESS_OF_SHEETS: f64 = 0.1;

/// A closed mesh whose volume is below this fraction of its area times its size encloses nothing.
const FLAT: f64 = 1e-6;

/// Share of contrary vertex normals that is worth telling: for what bends light, and for what is opaque.
const CONTRARY: [f64; 2] = [0.01, 0.05];

/// Notes on all meshes; one that several objects share is judged once, at the first of them.
pub(super) fn notes(scene: &Scene) -> Vec<Note> {
    let mut notes = Vec::new();
    let mut judged: Vec<*const MeshBvh> = Vec::new();
    let rims = Rims::new(scene);
    for (index, (info, item)) in scene.world.items.iter().zip(scene.world.geometry.items()).enumerate() {
        let ItemGeometry::Mesh { mesh, transform } = &item.geometry else { continue };
        if judged.contains(&Arc::as_ptr(mesh)) {
            continue;
        }
        judged.push(Arc::as_ptr(mesh));
        let found: Vec<(Severity, String)> = match scene.kind(info.object) {
            BoundaryKind::None => opaque(scene, info.object, mesh),
            kind => {
                let is_sheet = matches!(kind, BoundaryKind::Interface { .. });
                let holes = is_sheet.then(|| rims.holes(index, info.object));
                Findings::new(kind, mesh, *transform, holes).all()
            }
        };
        let name = scene.name(info.object);
        notes.extend(found.into_iter().map(|(severity, text)| {
            scene.note(severity, info.object, format!("mesh of object '{name}' {text}"))
        }));
    }
    notes
}

/// What matters of a mesh that bounds no medium.
fn opaque(scene: &Scene, object: ObjectId, mesh: &MeshBvh) -> Vec<(Severity, String)> {
    let mut found = Vec::new();
    let mesh = mesh.mesh();
    found.extend(contrary_normals(mesh.contrary_normals(), CONTRARY[1]));
    let material = scene.described(object).and_then(|described| {
        let materials = &scene.description.materials;
        materials.iter().find(|material| material.name == described.material.value)
    });
    let is_one_sided = material.is_some_and(|material| !material.two_sided && material.back.is_none());
    if is_one_sided && mesh.openness() < OPENNESS_OF_SHEETS && mesh.signed_volume() < 0.0 {
        let text = "is inside out, and its finish works from the front only: it is black from outside; turn its faces, or let the finish work from both sides";
        found.push((Severity::Warning, text.to_owned()));
    }
    found
}

/// The facts about a mesh where media meet.
struct Findings {
    health: MeshHealth,
    is_body: bool,
    is_flat: bool,
    size: f32,
    /// Where open edges are that no other interface continues; `None` for a body.
    holes: Option<Vec<Vec3>>,
    transform: Option<Transform>,
}

impl Findings {
    fn new(
        kind: BoundaryKind,
        mesh: &MeshBvh,
        transform: Option<Transform>,
        holes: Option<Vec<Vec3>>,
    ) -> Self {
        let mesh = mesh.mesh();
        let (health, size) = (mesh.health(), mesh.bounds().size().length());
        let is_flat = health.openness < OPENNESS_OF_SHEETS
            && health.volume.abs() < FLAT * mesh.area() * f64::from(size);
        Self { health, is_body: matches!(kind, BoundaryKind::Solid { .. }), is_flat, size, holes, transform }
    }

    fn all(&self) -> Vec<(Severity, String)> {
        let parts = [self.holes(), self.faces(), self.shells(), self.volume()];
        let normals = contrary_normals(self.health.contrary_normals, CONTRARY[0]);
        parts.into_iter().flatten().chain(normals).collect()
    }

    /// Where a fault is, in the world.
    fn place(&self, fault: &Marked) -> String {
        let local = fault.place.unwrap_or(Vec3::ZERO);
        at(self.transform.map_or(local, |transform| transform.point(local.as_dvec3()).as_vec3()))
    }

    fn holes(&self) -> Vec<(Severity, String)> {
        let edges = &self.health.edges;
        let is_sheet = self.health.openness >= OPENNESS_OF_SHEETS;
        let count = self.holes.as_ref().map_or(edges.open.count, Vec::len);
        if count == 0 || (is_sheet && !self.is_body) {
            return Vec::new();
        }
        let hole = self.holes.as_ref().and_then(|holes| holes.first());
        let place = hole.map_or_else(|| self.place(&edges.open), |&hole| at(hole));
        let reach = number(1e-6 * self.size);
        let text = if edges.nearly_closed == count {
            format!(
                "has {count} open edges, one at {place}, all at seams whose vertices differ by a rounding: rays that slip through are put right where they can be; merge vertices nearer than {reach}"
            )
        } else if self.is_body {
            format!(
                "is a body with {count} open edges, one at {place}: a path that slips through a hole is taken to have entered where it leaves; fill the holes, or make the object an `interface`"
            )
        } else {
            format!(
                "is an interface with {count} open edges, one at {place}: a path that slips through a hole keeps the medium it was in; fill the holes"
            )
        };
        vec![(Severity::Warning, text)]
    }

    fn faces(&self) -> Vec<(Severity, String)> {
        let (edges, mut found) = (&self.health.edges, Vec::new());
        if edges.branching.count > 0 {
            let text = format!(
                "has {} edges with more than two faces, one at {}: every face counts as a boundary; remove the faces inside",
                edges.branching.count,
                self.place(&edges.branching)
            );
            found.push((Severity::Warning, text));
        }
        if edges.flipped.count > 0 {
            let text = format!(
                "has {} edges whose faces are wound opposite ways, one at {}: light that enters by a face that looks inward is taken to leave; let all faces look outward",
                edges.flipped.count,
                self.place(&edges.flipped)
            );
            found.push((Severity::Warning, text));
        }
        let repeated = &self.health.duplicate_faces;
        if repeated.count > 0 {
            let text = format!(
                "has {} faces twice, one at {}: they count once; remove the copies",
                repeated.count,
                self.place(repeated)
            );
            found.push((Severity::Info, text));
        }
        found
    }

    fn shells(&self) -> Vec<(Severity, String)> {
        let shells = &self.health.shells;
        let all = shells.count;
        let mut found = Vec::new();
        let is_whole_inside_out = self.health.volume < 0.0;
        if shells.inside_out.count > 0 && !is_whole_inside_out {
            let text = format!(
                "has {} of {all} shells inside out, one at {}: it is rendered as a bubble of the medium outside; turn its faces",
                shells.inside_out.count,
                self.place(&shells.inside_out)
            );
            found.push((Severity::Warning, text));
        }
        // Of a body the union is what counts; an interface has the medium it names behind every face.
        let (severity, assumption) = if self.is_body {
            (Severity::Info, "rendered as one body, surfaces inside of it are not seen")
        } else {
            (Severity::Warning, "each surface is seen, with the media that the interface names")
        };
        if shells.doubled.count > 0 {
            let text = format!(
                "has {} of {all} shells within another and facing the same way, one at {}: {assumption}; turn the faces of those that are hollows, remove the others",
                shells.doubled.count,
                self.place(&shells.doubled)
            );
            found.push((severity, text));
        }
        if shells.crossing.count > 0 {
            let text = format!(
                "has {} of {all} shells that cross others, one at {}: {assumption}; unite them",
                shells.crossing.count,
                self.place(&shells.crossing)
            );
            found.push((severity, text));
        }
        found
    }

    fn volume(&self) -> Vec<(Severity, String)> {
        if !self.is_flat {
            return Vec::new();
        }
        let text = "encloses no volume: its two sides cancel; give it a thickness, or make it one sheet with the finish `thin-dielectric` and no medium";
        vec![(Severity::Warning, text.to_owned())]
    }
}

/// - `share`: of corners whose vertex normal looks away from the face's; `least`: that is worth telling.
fn contrary_normals(share: f64, least: f64) -> Option<(Severity, String)> {
    let percent = |share: f64| (100.0 * share).round();
    if share > 1.0 - least {
        let text = "has vertex normals that look inward: of them only the line counts, the winding of the faces says which side is out";
        return Some((Severity::Info, text.to_owned()));
    }
    let text = format!(
        "has vertex normals more than 90 degrees off the face's at {} % of its corners: there the shading turns over; compute the normals anew, or leave them out",
        percent(share)
    );
    (share > least).then_some((Severity::Warning, text))
}
