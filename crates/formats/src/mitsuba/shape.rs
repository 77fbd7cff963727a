//! `<shape>`: its form, its finish, and the media on its sides.

use super::bsdf::Sides;
use super::element::Element;
use super::emitter;
use super::importer::Importer;
use crate::Result;
use crate::limits::{LARGEST_LENGTH, Limits, SMALLEST_LENGTH};
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{
    BoundaryDescription, ColorSource, Located, MaterialKind, MeshData, ObjectDescription, ShapeDescription,
};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::Arc;

/// Radii that count.
const RADIUS: Limits = Limits::between(SMALLEST_LENGTH, LARGEST_LENGTH);

/// A form with its placement.
struct Form {
    shape: ShapeDescription,
    placement: Transform,
    /// Whether the normals of `shape` are already turned as the file wants them.
    is_turned: bool,
}

impl Importer<'_> {
    /// Reads a shape; unsupported ones are left out with a warning.
    pub(super) fn shape(&mut self, shape: Element<'_>) -> Result<()> {
        shape.ignore(&["subdiv", "max_smooth_angle"]);
        let flip = shape.boolean("flip_normals", false)?;
        let Some(form) = self.form(shape, flip)? else {
            shape.ignore_all();
            shape.warn(format!("{} is not supported and left out", shape.title()));
            return Ok(());
        };
        let swap = flip && !form.is_turned;
        let name = self.default_name(shape)?;
        let name = self.object_name(name);
        let emission = match shape.child("emitter")? {
            Some(emitter) => emitter::area(emitter)?,
            None => None,
        };
        if swap && emission.is_some() {
            shape.warn(format!("{} shines outwards although `flip_normals` turns it inwards", shape.title()));
        }
        let (material, boundary) = self.surface(shape, &name, swap, emission.is_some())?;
        let object = ObjectDescription {
            name,
            shape: form.shape,
            placement: form.placement,
            boundary,
            material,
            slot_materials: Vec::new(),
            emission,
        };
        self.scene.objects.push(Located::new(object, shape.source().clone()));
        Ok(())
    }

    /// What a shape is called: by its id, its file, or its type.
    fn default_name(&self, shape: Element<'_>) -> Result<String> {
        let file = shape.string("filename")?;
        let stem = file.as_ref().and_then(|name| Path::new(name.as_str()).file_stem());
        Ok(match (shape.id(), stem) {
            (Some(id), _) => id.to_owned(),
            (None, Some(stem)) => stem.to_string_lossy().into_owned(),
            (None, None) => format!("{}-{}", shape.kind(), self.scene.objects.len() + 1),
        })
    }

    /// The finish of a shape and the media at it.
    fn surface(
        &mut self,
        shape: Element<'_>,
        name: &str,
        swap: bool,
        is_emitter: bool,
    ) -> Result<(Located<String>, BoundaryDescription)> {
        let interior = shape.child_named("medium", "interior")?;
        let exterior = shape.child_named("medium", "exterior")?;
        let has_media = interior.is_some() || exterior.is_some();
        let (material, sides) = match shape.child("bsdf")? {
            Some(bsdf) => {
                let finish = self.bsdf(bsdf)?;
                (finish.material, finish.sides)
            }
            None => {
                let source = shape.source();
                let grey = MaterialKind::Matte { reflectance: ColorSource::Constant([0.5; 3]) };
                if is_emitter {
                    (self.add_material("black", MaterialKind::Black, false, source), Sides::Opaque)
                } else if has_media {
                    (
                        self.add_material("pass-through", MaterialKind::PassThrough, true, source),
                        Sides::PassThrough,
                    )
                } else {
                    (self.add_material("matte", grey, false, source), Sides::Opaque)
                }
            }
        };
        let (inside, outside) = match sides {
            Sides::Opaque => {
                // What surrounds a surface that lets no light through is told by what lies around it.
                interior.into_iter().chain(exterior).for_each(|medium| medium.ignore_all());
                return Ok((material, BoundaryDescription::None));
            }
            Sides::Dielectric { inside, outside } => (inside, outside),
            Sides::PassThrough => (1.0, 1.0),
        };
        let mut side =
            |volume: Option<Element<'_>>, index: f64, what: &str| -> Result<Option<Located<String>>> {
                let volume = match volume {
                    Some(volume) => self.volume(volume, &format!("{name}/{what}"))?,
                    None => None,
                };
                self.world_is_vacuum |= volume.is_none() && index == 1.0;
                Ok(self.medium(volume, index, shape.source()))
            };
        let mut inside = side(interior, inside, "interior")?;
        let mut outside = side(exterior, outside, "exterior")?;
        if swap {
            std::mem::swap(&mut inside, &mut outside);
        }
        Ok((material, BoundaryDescription::Interface { outside, inside }))
    }

    /// The form of a shape; `None` where its type is unknown.
    fn form(&self, shape: Element<'_>, flip: bool) -> Result<Option<Form>> {
        let placement = shape.transform("to_world")?;
        let form = |shape: ShapeDescription| Form { shape, placement, is_turned: false };
        let half_u = if flip { -DVec3::X } else { DVec3::X };
        let normal = if flip { -DVec3::Z } else { DVec3::Z };
        Ok(Some(match shape.kind() {
            "sphere" => form(ShapeDescription::Sphere {
                center: shape.point("center")?.unwrap_or(DVec3::ZERO),
                radius: shape.float("radius", 1.0, RADIUS)?,
                phi: [0.0, TAU],
                theta: [0.0, PI],
            }),
            "rectangle" => Form {
                shape: ShapeDescription::Rectangle { center: DVec3::ZERO, half_u, half_v: DVec3::Y },
                placement,
                is_turned: true,
            },
            "disk" => Form {
                shape: ShapeDescription::Disc { center: DVec3::ZERO, normal, radius: 1.0, inner_radius: 0.0 },
                placement,
                is_turned: true,
            },
            "cube" => form(ShapeDescription::Box { min: -DVec3::ONE, max: DVec3::ONE, radius: 0.0 }),
            "cylinder" => self.cylinder(shape, &placement)?,
            "ply" | "obj" => self.mesh(shape, placement, flip)?,
            _ => return Ok(None),
        }))
    }

    /// An open cylinder from p0 to p1; ours stands on the origin along y.
    fn cylinder(&self, shape: Element<'_>, to_world: &Transform) -> Result<Form> {
        let p0 = shape.point("p0")?.unwrap_or(DVec3::ZERO);
        let axis = shape.point("p1")?.unwrap_or(DVec3::Z) - p0;
        let radius = shape.float("radius", 1.0, RADIUS)?;
        let length = axis.length();
        match Transform::from_y_axis(p0, axis, DVec3::X) {
            Some(upright) if RADIUS.contain(length) => Ok(Form {
                shape: ShapeDescription::Cylinder {
                    radius,
                    y: [0.0, length],
                    phi: [0.0, TAU],
                    capped: false,
                },
                placement: to_world.after(&upright),
                is_turned: false,
            }),
            _ => Err(shape.error("the ends `p0` and `p1` of the cylinder coincide")),
        }
    }

    fn mesh(&self, shape: Element<'_>, placement: Transform, flip: bool) -> Result<Form> {
        let Some(name) = shape.string("filename")? else {
            return Err(shape.error(format!("{} needs `filename`", shape.title())));
        };
        let mut mesh = self.assets.mesh(&name.source, &name)?;
        let flat = shape.boolean("face_normals", false)?;
        let is_obj = shape.kind() == "obj";
        let flip_v = shape.boolean("flip_tex_coords", is_obj)? && !mesh.uvs.is_empty();
        // One BSDF holds for the whole shape: what OBJ files say about materials is of no use.
        let has_slots = !mesh.slots.is_empty();
        if flip || flip_v || has_slots {
            mesh = Arc::new(changed(MeshData::clone(&mesh), flip, flip_v));
        }
        Ok(Form { shape: ShapeDescription::Mesh { mesh, flat }, placement, is_turned: true })
    }
}

/// A mesh without slots, inside out where `flip`, its texture coordinates upside down where `flip_v`.
fn changed(mut mesh: MeshData, flip: bool, flip_v: bool) -> MeshData {
    if flip {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        for normal in &mut mesh.normals {
            *normal = normal.map(|coordinate| -coordinate);
        }
    }
    if flip_v {
        mesh.uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
    }
    mesh.face_slots = Vec::new();
    mesh.slots = Vec::new();
    mesh
}
