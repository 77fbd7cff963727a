//! The file as a whole: its sections, names that must differ, and what every scene needs.

use super::document::Node;
use super::field::Field;
use super::overrides::default_name;
use super::table::Table;
use super::{camera, film, medium, references, settings};
use crate::assets::Assets;
use crate::{Result, unit};
use hyaline_math::Transform;
use hyaline_scene::{
    BoundaryDescription, IndexDescription, Located, MaterialDescription, MaterialKind, MediumDescription,
    ObjectDescription, SceneDescription, SceneError, ShapeDescription, Source,
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
    /// What is wrong; reading goes on after the entry that a fault is in.
    faults: Vec<SceneError>,
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
        Self { scene: SceneDescription::default(), assets, metres: 1.0, faults: Vec::new() }
    }

    /// Reads a whole document.
    ///
    /// # Errors
    /// All faults, at least one.
    pub(super) fn read(mut self, root: &Node) -> std::result::Result<SceneDescription, Vec<SceneError>> {
        let sections = self.header(root).map_err(|fault| vec![fault])?;
        if let Some(field) = sections.settings {
            let metres = self.metres;
            let read = |table| settings::read(table, metres, &mut self.scene.settings);
            let result = field.table("settings").and_then(read);
            self.keep(result);
        }
        if let Some(field) = sections.film {
            let result = field.table("film").and_then(|table| film::read(table, &mut self.scene.film));
            self.keep(result);
        }
        self.named(sections.textures, "texture", Self::texture_entry);
        self.named(sections.media, "medium", Self::medium_entry);
        self.named(sections.materials, "material", Self::material_entry);
        self.elements(sections.objects, "object", Self::object);
        self.elements(sections.lights, "light", Self::light);
        self.elements(sections.cameras, "camera", Self::camera);
        if let Some(field) = sections.world {
            let result = self.world(field);
            self.keep(result);
        }
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        references::complete(&mut self.scene, self.metres).map_err(|fault| vec![fault])?;
        require_something(&self.scene, &root.source).map_err(|fault| vec![fault])?;
        Ok(self.scene)
    }

    fn keep(&mut self, result: Result<()>) {
        self.faults.extend(result.err());
    }

    /// The items; none where they have a fault, which is kept.
    fn kept<T>(&mut self, items: Result<Vec<T>>) -> Vec<T> {
        items.unwrap_or_else(|fault| {
            self.faults.push(fault);
            Vec::new()
        })
    }

    fn world(&mut self, field: Field<'_>) -> Result<()> {
        let mut table = field.table("world")?;
        self.scene.surrounding = table.read_some("medium", |medium| medium.name())?;
        table.finish()
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

    /// Reads the entries of a section whose keys are names, each whether or not another has a fault.
    fn named<'n>(
        &mut self,
        section: Option<Field<'n>>,
        what: &str,
        read: fn(&mut Self, Table<'n>, Located<String>) -> Result<()>,
    ) {
        let entries = section.map_or(Ok(Vec::new()), |section| section.entries());
        for (field, source) in self.kept(entries) {
            let name = Located::new(field.key.to_owned(), source.clone());
            let table = field.table(format!("{what} '{}'", field.key));
            let result = table.and_then(|table| read(self, table, name));
            self.keep(result);
        }
    }

    /// Reads the elements of an array of tables, each whether or not another has a fault; a single table stands for an
    /// array of one.
    fn elements<'n>(
        &mut self,
        section: Option<Field<'n>>,
        what: &'static str,
        read: fn(&mut Self, Table<'n>, String) -> Result<()>,
    ) {
        let items = section.map_or(Ok(Vec::new()), |section| section.items_or_one());
        let mut names: Vec<(String, Source)> = Vec::new();
        for (index, field) in self.kept(items).into_iter().enumerate() {
            let element = named_element(field, what, index, &mut names);
            let result = element.and_then(|(table, name)| {
                let result = read(self, table, name.clone());
                if result.is_err() && what == "object" {
                    self.stand_in(name, field.source());
                }
                result
            });
            self.keep(result);
        }
    }

    /// Puts something in the place of an object that has a fault, so that instances of it have none.
    fn stand_in(&mut self, name: String, source: &Source) {
        let shape = ShapeDescription::Compound { parts: Vec::new() };
        let object = ObjectDescription {
            name,
            shape,
            placement: Transform::IDENTITY,
            boundary: BoundaryDescription::None,
            material: Located::new(String::new(), source.clone()),
            slot_materials: Vec::new(),
            emission: None,
        };
        self.scene.objects.push(Located::new(object, source.clone()));
    }

    fn medium_entry(&mut self, mut table: Table<'_>, name: Located<String>) -> Result<()> {
        let clear = MediumDescription::clear(name.value, IndexDescription::Constant(1.0));
        let medium = medium::read(&mut table, self.metres, clear, self.assets, &mut self.scene.notes)?;
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

/// The table of an element of `[[what]]` and its name, which differs from those in `names` and joins them.
fn named_element<'n>(
    field: Field<'n>,
    what: &'static str,
    index: usize,
    names: &mut Vec<(String, Source)>,
) -> Result<(Table<'n>, String)> {
    let mut table = field.table(what)?;
    let kind = table.take("kind").and_then(|kind| kind.string().ok()).unwrap_or_default();
    let given = table.read_some("name", |name| name.name())?;
    let place = given.as_ref().map_or(field.source(), |name| &name.source).clone();
    let name = given.map_or_else(|| default_name(what, kind, index), |name| name.value);
    if let Some((_, first)) = names.iter().find(|(other, _)| *other == name) {
        let message = format!("two {what}s are named '{name}'; the other is at {first}");
        return Err(SceneError::at(&place, message).with_remedy("rename one of them"));
    }
    table.what = if what == "camera" { format!("camera '{name}'") } else { format!("{kind} '{name}'") };
    names.push((name.clone(), place));
    Ok((table, name))
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
