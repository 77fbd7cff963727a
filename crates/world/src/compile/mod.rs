//! From description to world: names become indices, shapes become geometry, colors become lanes.
//!
//! 1. Media, textures and materials, each by name.
//! 2. Objects: their shapes become items of the geometry, their boundaries go to the table of boundaries, what shines
//!    becomes a light.
//! 3. The hierarchy over everything; which items may coincide with others.
//! 4. Lights without a shape, cameras.
//! 5. Where each camera and light is: found by looking around.

mod blends;
mod cameras;
mod coincidence;
mod faults;
mod light_media;
mod lights;
mod locate;
mod materials;
mod media;
mod names;
mod objects;
mod orientation;
mod shapes;

use crate::World;
use crate::light::LightSet;
use crate::texture::Texture;
pub(crate) use shapes::is_open;

use faults::Faults;
use hyaline_geometry::Aggregate;
use hyaline_scattering::{Boundaries, Medium, MediumId};
use hyaline_scene::{Located, Note, SceneDescription, SceneError, Severity, measured};
use hyaline_spectrum::Spectrum;
use names::Names;

/// Lanes in `rgb` mode.
const RGB_LANES: usize = 3;

/// Everything that is looked up by name while compiling.
struct Library<'a> {
    description: &'a SceneDescription,
    media: Names<'a>,
    materials: Names<'a>,
    textures: Names<'a>,
    objects: Names<'a>,
}

impl<'a> Library<'a> {
    fn new(description: &'a SceneDescription) -> Self {
        Self {
            description,
            media: Names::new("medium", description.media.iter().map(|m| m.name.as_str()))
                .suggesting(measured::names()),
            materials: Names::new("material", description.materials.iter().map(|m| m.name.as_str())),
            textures: Names::new("texture", description.textures.iter().map(|t| t.name.as_str())),
            objects: Names::new("object", description.objects.iter().map(|o| o.name.as_str())),
        }
    }

    /// The id of a medium. The world's vacuum is 0, so the described media count from 1.
    fn medium(&self, name: &Located<String>) -> Result<MediumId, SceneError> {
        Ok(MediumId(self.media.find(name)? as u32 + 1))
    }

    /// The id of the medium that fills the world.
    fn surrounding(&self) -> Result<MediumId, SceneError> {
        self.medium_or(&self.description.surrounding, MediumId(0))
    }

    /// The media that paths may start in outside of all solids: the world's, and those that cameras declare.
    fn bases(&self) -> Result<Vec<MediumId>, SceneError> {
        let surrounding = self.surrounding()?;
        let cameras = self.description.cameras.iter();
        let declared = cameras.map(|camera| self.medium_or(&camera.medium, surrounding));
        std::iter::once(Ok(surrounding)).chain(declared).collect()
    }

    fn medium_or(&self, name: &Option<Located<String>>, default: MediumId) -> Result<MediumId, SceneError> {
        name.as_ref().map_or(Ok(default), |name| self.medium(name))
    }
}

impl World {
    /// Compiles a description: resolves names, builds geometry and hierarchies, places lights and cameras.
    ///
    /// Returns the world and what is doubtful about it.
    ///
    /// # Errors
    /// The first fault: a name that nothing bears, a shape that cannot be, a scene without a camera.
    pub fn compile(description: &SceneDescription) -> Result<(World, Vec<Note>), SceneError> {
        Self::compile_or_all_faults(description).map_err(|faults| {
            let first = faults.into_iter().next();
            first.unwrap_or_else(|| SceneError::general("the scene can't be used"))
        })
    }

    /// The same, telling everything that is wrong.
    ///
    /// # Errors
    /// All faults, at least one, of an object only the first.
    pub fn compile_or_all_faults(
        description: &SceneDescription,
    ) -> Result<(World, Vec<Note>), Vec<SceneError>> {
        let (mut notes, mut faults) = (Vec::new(), Faults::default());
        let library = Library::new(description);
        let mut media = vec![Medium::VACUUM];
        for medium in &description.media {
            media.push(faults.keep(media::compile(medium)).unwrap_or(Medium::VACUUM));
        }
        let textures: Vec<Texture> = description.textures.iter().map(|t| Texture::new(&t.value)).collect();
        let materials = materials::compile_all(&library, &mut notes, &mut faults)?;
        let mut parts = objects::compile_all(&library, &materials, &mut notes, &mut faults);

        let bounds = parts.bounds();
        let shapeless = lights::compile_all(&library, &textures, bounds, parts.lights.len(), &mut faults);
        cameras::check(&library, &mut faults);
        let bases = faults.keep(library.bases()).unwrap_or_default();
        faults.none()?;
        parts.lights.extend(shapeless.lights);
        let has_permeable = coincidence::mark(&mut parts, &media, &materials, &bases);
        let mut world = World {
            geometry: Aggregate::build(parts.geometry),
            items: parts.items,
            object_names: parts.names,
            object_materials: parts.object_materials,
            boundaries: Boundaries::new(parts.boundaries),
            media,
            materials,
            textures,
            lights: LightSet::new(parts.lights, RGB_LANES),
            light_media: Vec::new(),
            camera_sky: shapeless.camera_sky,
            ambient: shapeless.ambient,
            cameras: Vec::new(),
            camera_names: Vec::new(),
            camera_media: Vec::new(),
            has_permeable,
            has_volumes: false,
            lanes: RGB_LANES,
        };
        world.has_volumes =
            world.media.iter().any(|medium| medium.scatters() || medium.shines() || medium.grid.is_some());
        let shines = world.media.iter().any(Medium::shines);
        if world.lights.lights().is_empty() && !shines {
            let message =
                "the scene has no light: the picture will be black, but for an ambient term in `whitted`";
            notes.push(Note { severity: Severity::Warning, source: None, message: message.into() });
        }
        cameras::compile_all(&library, &mut world, &mut notes).map_err(|fault| vec![fault])?;
        world.light_media =
            light_media::compile_all(&library, &world, &mut notes).map_err(|fault| vec![fault])?;
        Ok((world, notes))
    }
}

/// A color as light or factor in lanes.
fn lanes(color: hyaline_scene::Rgb) -> Spectrum {
    Spectrum::from_rgb(color)
}
