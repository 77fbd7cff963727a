//! `<shape>`: its form, its finish, and the media on its sides.

use super::bsdf::Sides;
use super::element::Element;
use super::form::Form;
use super::importer::Importer;
use super::media::Later;
use crate::Result;
use hyaline_scene::{BoundaryDescription, ColorSource, Emission, Located, MaterialKind, ObjectDescription};
use std::path::Path;

/// An object that is not placed in the scene yet.
#[derive(Clone, Debug)]
pub(super) struct Built {
    /// The object; its name is one that others may have.
    pub(super) object: ObjectDescription,
    /// Media that wait until all shapes are read.
    pub(super) later: Vec<Later>,
}

impl Importer<'_> {
    /// Reads a shape of the scene and what is within it.
    pub(super) fn shape(&mut self, shape: Element<'_>) -> Result<()> {
        match shape.kind() {
            // Described for instances to refer to.
            "shapegroup" => Ok(()),
            "instance" => self.instance(shape),
            // Several shapes that Mitsuba joins to one where they look alike.
            "merge" => shape.children("shape")?.into_iter().try_for_each(|(_, inner)| match inner.kind() {
                "merge" | "instance" | "shapegroup" => {
                    inner.ignore_all();
                    inner.warn(format!("{} within 'merge' is not supported and left out", inner.title()));
                    Ok(())
                }
                _ => self.shape(inner),
            }),
            _ => {
                let built = self.build(shape)?;
                built.into_iter().try_for_each(|built| self.add_object(built, shape))
            }
        }
    }

    /// Adds an object to the scene, with a name that nobody has.
    pub(super) fn add_object(&mut self, mut built: Built, element: Element<'_>) -> Result<()> {
        self.check_room(element)?;
        built.object.name = self.names.unique(built.object.name);
        let index = self.scene.objects.len();
        self.later.extend(built.later.into_iter().map(|later| (index, later)));
        self.scene.objects.push(Located::new(built.object, element.source().clone()));
        Ok(())
    }

    /// The objects that a shape is, without adding them: mostly one; none, with a warning, where it is not supported.
    pub(super) fn build(&mut self, shape: Element<'_>) -> Result<Vec<Built>> {
        let flip = shape.boolean("flip_normals", false)?;
        let name = self.default_name(shape)?;
        let forms = self.forms(shape, flip)?;
        if forms.is_empty() {
            shape.ignore_all();
            shape.warn(format!("{} is not supported and left out", shape.title()));
        }
        let emission = match shape.child("emitter")? {
            Some(emitter) => self.area(emitter)?,
            None => None,
        };
        if forms.iter().all(|form| form.bsdf.is_none()) && shape.children("bsdf")?.len() > 1 {
            shape.warn(format!("{} has several bsdfs; the first counts", shape.title()));
        }
        let swap = |form: &Form| flip && !form.is_turned;
        forms
            .into_iter()
            .map(|form| {
                let (swap, emission) = (swap(&form), emission.clone());
                self.finish(shape, form, name.clone(), swap, emission)
            })
            .collect()
    }

    /// Gives a form its finish, its light and its media.
    fn finish(
        &mut self,
        shape: Element<'_>,
        form: Form,
        name: String,
        swap: bool,
        mut emission: Option<Emission>,
    ) -> Result<Built> {
        if let (true, Some(emission)) = (swap, &mut emission) {
            emission.two_sided = true;
            let turned = "is turned inwards by `flip_normals`";
            shape.warn(format!("{} {turned}, but shines to both sides", shape.title()));
        }
        let mut later = Vec::new();
        let surface = self.surface(shape, form.bsdf.or(shape.child("bsdf")?), emission.is_some())?;
        let boundary = self.boundary(shape, &name, surface.sides, swap, &mut later)?;
        if emission.is_some()
            && let Some(exterior) = shape.child_named("medium", "exterior")?
        {
            later.push(Later::Lamp(self.volume(exterior, &format!("{name}/exterior"))?));
        }
        let object = ObjectDescription {
            name,
            shape: form.shape,
            placement: form.placement,
            boundary,
            material: surface.material,
            slot_materials: Vec::new(),
            emission,
        };
        Ok(Built { object, later })
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

    /// The finish of a shape: that of its bsdf, or the one that Mitsuba gives to a shape without.
    fn surface(
        &mut self,
        shape: Element<'_>,
        bsdf: Option<Element<'_>>,
        is_emitter: bool,
    ) -> Result<super::bsdf::Finish> {
        if let Some(bsdf) = bsdf {
            return self.bsdf(bsdf);
        }
        let has_media = shape.has_child("medium")?;
        let (name, kind, sides) = if is_emitter {
            ("black", MaterialKind::Black, Sides::Opaque)
        } else if has_media {
            ("pass-through", MaterialKind::PassThrough, Sides::PassThrough)
        } else {
            let grey = ColorSource::Constant([0.5; 3]);
            ("matte", MaterialKind::Matte { reflectance: grey }, Sides::Opaque)
        };
        let material = self.add_material(name, kind, sides == Sides::PassThrough, shape.source());
        Ok(super::bsdf::Finish { material, sides })
    }

    /// The media at a shape, as far as they are settled by now.
    fn boundary(
        &mut self,
        shape: Element<'_>,
        name: &str,
        sides: Sides,
        swap: bool,
        later: &mut Vec<Later>,
    ) -> Result<BoundaryDescription> {
        let interior = shape.child_named("medium", "interior")?;
        let exterior = shape.child_named("medium", "exterior")?;
        if sides == Sides::Opaque {
            // What surrounds a surface that lets no light through is told by what lies around it.
            interior.into_iter().chain(exterior).for_each(|medium| medium.ignore_all());
            return Ok(BoundaryDescription::None);
        }
        let mut volume = |medium: Option<Element<'_>>, what: &str| match medium {
            Some(medium) => self.volume(medium, &format!("{name}/{what}")),
            None => Ok(None),
        };
        let (mut inside, mut outside) = (volume(interior, "interior")?, volume(exterior, "exterior")?);
        let Sides::Dielectric { inside: mut inner, outside: mut outer } = sides else {
            if swap {
                std::mem::swap(&mut inside, &mut outside);
            }
            later.push(Later::Sides(inside, outside));
            return Ok(BoundaryDescription::None);
        };
        if swap {
            std::mem::swap(&mut inside, &mut outside);
            std::mem::swap(&mut inner, &mut outer);
        }
        let mut side = |volume: Option<usize>, index: f64| {
            self.world_is_vacuum |= volume.is_none() && index == 1.0;
            self.medium(volume, index, shape.source())
        };
        let (inside, outside) = (side(inside, inner), side(outside, outer));
        Ok(BoundaryDescription::Interface { outside, inside })
    }
}
