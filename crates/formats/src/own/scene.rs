//! The file as a whole: its sections, names that must differ, and what every scene needs.

use super::document::Node;
use super::field::Field;
use super::overrides::default_name;
use super::table::Table;
use super::{camera, film, medium, references, settings};
use crate::assets::Assets;
use crate::{Result, unit};
use hyaline_scene::{
    IndexDescription, Located, MaterialDescription, MaterialKind, MediumDescription, SceneDescription,
    SceneError, Source,
};

/// The version of the format that is read.
const FORMAT_VERSION: i64 = 1;

/// Reads sections into a description.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    /// What has been read so far.
    pub(super) scene: SceneDescription,
    /// Files that the scene names.
    pub(super) assets: &'a Assets,
    /// Length of a scene unit in metres.
    pub(super) metres: f64,
}

/// The sections of a file, in the order in which they are read.
struct Sections<'a> {
    settings: Option<Field<'a>>,
    film: Option<Field<'a>>,
    textures: Option<Field<'a>>,
    media: Option<Field<'a>>,
    materials: Option<Field<'a>>,
    objects: Option<Field<'a>>,
    lights: Option<Field<'a>>,
    cameras: Option<Field<'a>>,
    world: Option<Field<'a>>,
}

impl<'a> Reader<'a> {
    /// Starts with an empty scene.
    pub(super) fn new(assets: &'a Assets) -> Self {
        Self { scene: SceneDescription::default(), assets, metres: 1.0 }
    }

    /// Reads a whole document.
    pub(super) fn read(mut self, root: &Node) -> Result<SceneDescription> {
        let sections = self.header(root)?;
        if let Some(field) = sections.settings {
            settings::read(field.table("settings")?, self.metres, &mut self.scene.settings)?;
        }
        if let Some(field) = sections.film {
            film::read(field.table("film")?, &mut self.scene.film)?;
        }
        self.named(sections.textures, "texture", Self::texture_entry)?;
        self.named(sections.media, "medium", Self::medium_entry)?;
        self.named(sections.materials, "material", Self::material_entry)?;
        self.elements(sections.objects, "object", Self::object)?;
        self.elements(sections.lights, "light", Self::light)?;
        self.elements(sections.cameras, "camera", Self::camera)?;
        if let Some(field) = sections.world {
            let mut table = field.table("world")?;
            self.scene.surrounding = table.read_some("medium", |medium| medium.name())?;
            table.finish()?;
        }
        references::complete(&mut self.scene)?;
        require_something(&self.scene, &root.source)?;
        Ok(self.scene)
    }

    fn header<'n>(&mut self, root: &'n Node) -> Result<Sections<'n>> {
        let mut table = Table::root(root)?;
        if let Some(version) = table.take("format_version") {
            let found = version.integer(i64::MIN, i64::MAX)?;
            if found != FORMAT_VERSION {
                let message = format!("format_version is {found}; this program reads {FORMAT_VERSION}");
                return Err(version.error(message).with_remedy("update the program or the file"));
            }
        }
        if let Some(field) = table.take("unit") {
            let metres = unit::metres(field.string()?);
            self.metres = metres.ok_or_else(|| field.no_such_choice(&unit::names()))?;
        }
        let sections = Sections {
            settings: table.take("settings"),
            film: table.take("film"),
            textures: table.take("textures"),
            media: table.take("media"),
            materials: table.take("materials"),
            objects: table.take("object"),
            lights: table.take("light"),
            cameras: table.take("camera"),
            world: table.take("world"),
        };
        table.finish()?;
        Ok(sections)
    }

    /// Reads the entries of a section whose keys are names.
    fn named<'n>(
        &mut self,
        section: Option<Field<'n>>,
        what: &str,
        read: fn(&mut Self, Table<'n>, Located<String>) -> Result<()>,
    ) -> Result<()> {
        for (field, source) in section.map_or(Ok(Vec::new()), |section| section.entries())? {
            let table = field.table(format!("{what} '{}'", field.key))?;
            read(self, table, Located::new(field.key.to_owned(), source.clone()))?;
        }
        Ok(())
    }

    /// Reads the elements of an array of tables; a single table stands for an array of one.
    fn elements<'n>(
        &mut self,
        section: Option<Field<'n>>,
        what: &'static str,
        read: fn(&mut Self, Table<'n>, String) -> Result<()>,
    ) -> Result<()> {
        let Some(section) = section else { return Ok(()) };
        let mut names: Vec<(String, Source)> = Vec::new();
        for (index, field) in section.items_or_one()?.into_iter().enumerate() {
            let mut table = field.table(what)?;
            let kind = table.take("kind").and_then(|kind| kind.string().ok()).unwrap_or_default();
            let given = table.read_some("name", |name| name.name())?;
            let place = given.as_ref().map_or(field.source(), |name| &name.source).clone();
            let name = given.map_or_else(|| default_name(what, kind, index), |name| name.value);
            if let Some((_, first)) = names.iter().find(|(other, _)| *other == name) {
                let message = format!("two {what}s are named '{name}'; the other is at {first}");
                return Err(SceneError::at(&place, message).with_remedy("rename one of them"));
            }
            table.what =
                if what == "camera" { format!("camera '{name}'") } else { format!("{kind} '{name}'") };
            names.push((name.clone(), place));
            read(self, table, name)?;
        }
        Ok(())
    }

    fn medium_entry(&mut self, mut table: Table<'_>, name: Located<String>) -> Result<()> {
        let clear = MediumDescription::clear(name.value, IndexDescription::Constant(1.0));
        let medium = medium::read(&mut table, self.metres, clear, self.assets)?;
        table.finish()?;
        self.scene.media.push(Located::new(medium, name.source));
        Ok(())
    }

    fn camera(&mut self, mut table: Table<'_>, name: String) -> Result<()> {
        let camera = camera::read(&mut table, self.metres, name, None)?;
        let source = table.source.clone();
        table.finish()?;
        self.scene.cameras.push(Located::new(camera, source));
        Ok(())
    }

    /// Name of a finish that nobody described, added to the materials at its first use.
    pub(super) fn implicit_material(
        &mut self,
        name: &str,
        kind: MaterialKind,
        source: &Source,
    ) -> Located<String> {
        let wanted = MaterialDescription::new(name, kind);
        let name = references::add_material(&mut self.scene.materials, wanted, source);
        Located::new(name, source.clone())
    }
}

fn require_something(scene: &SceneDescription, source: &Source) -> Result<()> {
    if scene.cameras.is_empty() {
        let error = SceneError::at(source, "the scene has no camera");
        return Err(error.with_remedy("add [camera] with `from = [x, y, z]` and `to = [x, y, z]`"));
    }
    if scene.objects.is_empty() && scene.lights.is_empty() {
        let error = SceneError::at(source, "the scene has neither an object nor a light");
        return Err(error.with_remedy("add [[object]] or [[light]] with a `kind`"));
    }
    Ok(())
}
