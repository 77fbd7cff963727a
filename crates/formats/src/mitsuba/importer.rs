//! The import as a whole: shapes, lights, cameras, and what every scene needs.

use super::backs;
use super::element::{Element, warn_of_leftovers};
use super::group::Groups;
use super::media::{Later, Media};
use super::mesh::ChangedMeshes;
use super::notes::Notes;
use super::object_names::ObjectNames;
use super::tree::Tree;
use crate::Result;
use crate::assets::Assets;
use crate::own::add_material;
use hyaline_scene::{
    FileIntegrator, LightKind, Located, MaterialDescription, MaterialKind, SceneDescription, SceneError,
    Source,
};

/// Builds a description from a tree.
#[derive(Debug)]
pub(super) struct Importer<'a> {
    tree: &'a Tree,
    /// Files that the scene names.
    pub(super) assets: &'a Assets,
    /// What has been read so far.
    pub(super) scene: SceneDescription,
    /// Media made from volumes and indices.
    pub(super) media: Media,
    /// Whether a boundary has said that the world's index is 1.
    pub(super) world_is_vacuum: bool,
    /// Whether the file is of version 0.5 or 0.6, whose defaults differ.
    pub(super) is_old: bool,
    /// Whether backs are finished as fronts are, whatever the file says.
    two_sided: bool,
    /// Index of what fills the world.
    pub(super) world_index: f64,
    /// Media of objects that are settled once all shapes are read.
    pub(super) later: Vec<(usize, Later)>,
    /// Members of shape groups.
    pub(super) groups: Groups,
    /// Meshes that were changed after reading.
    pub(super) meshes: ChangedMeshes,
    /// Names of objects and lights.
    pub(super) names: ObjectNames,
}

impl<'a> Importer<'a> {
    /// Starts with an empty scene.
    ///
    /// - `two_sided`: whether backs are finished as fronts are, whatever the file says.
    pub(super) fn new(tree: &'a Tree, assets: &'a Assets, two_sided: bool) -> Self {
        Self {
            tree,
            assets,
            scene: SceneDescription::default(),
            media: Media::default(),
            world_is_vacuum: false,
            is_old: false,
            two_sided,
            world_index: 1.0,
            later: Vec::new(),
            groups: Groups::default(),
            meshes: ChangedMeshes::default(),
            names: ObjectNames::default(),
        }
    }

    /// Reads the whole scene.
    pub(super) fn read(mut self) -> Result<SceneDescription> {
        let notes = Notes::default();
        let Some(root) = Element::root(self.tree, &notes) else {
            return Err(SceneError::general("an empty file"));
        };
        self.is_old = root.major_version() == 0;
        for (_, shape) in root.children("shape")? {
            self.shape(shape)?;
        }
        self.settle_surrounding(root.source());
        self.settle_media();
        for (_, emitter) in root.children("emitter")? {
            self.emitter(emitter)?;
        }
        let sensors = root.children("sensor")?;
        for (index, (_, sensor)) in sensors.iter().enumerate() {
            self.sensor(*sensor, index)?;
        }
        self.integrator(root)?;
        // Described for others to refer to; what nobody refers to changes nothing.
        for tag in ["bsdf", "texture", "medium", "film", "sampler", "rfilter", "phase"] {
            root.mark_described(tag)?;
        }
        if self.scene.cameras.is_empty() {
            let error = SceneError::at(root.source(), "the scene has no camera");
            return Err(error.with_remedy("add <sensor type=\"perspective\">"));
        }
        if self.scene.objects.is_empty() && self.scene.lights.is_empty() {
            let error = SceneError::at(root.source(), "the scene has neither a shape nor an emitter");
            return Err(error.with_remedy("add <shape> or <emitter>"));
        }
        if self.two_sided {
            self.scene.materials.iter_mut().for_each(|material| material.two_sided = true);
        }
        backs::note(&self.scene, &notes);
        warn_of_leftovers(self.tree, &notes);
        self.scene.notes = notes.into_list();
        Ok(self.scene)
    }

    /// What the file asks for, which is reported and not obeyed.
    fn integrator(&mut self, root: Element<'_>) -> Result<()> {
        let Some(outer) = root.child("integrator")? else { return Ok(()) };
        let mut integrator = outer;
        for _ in 0..4 {
            // Integrators such as `aov` wrap the one that matters.
            match integrator.child("integrator")? {
                Some(inner) => integrator = inner,
                None => break,
            }
        }
        let max_depth = integrator.integer("max_depth")?.and_then(|depth| u32::try_from(depth).ok());
        if integrator.boolean("hide_emitters", false)? {
            self.hide_emitters();
        }
        outer.ignore_all();
        integrator.ignore_all();
        let spp = self.scene.settings.file_integrator.as_ref().and_then(|sampled| sampled.spp);
        let name = integrator.kind().to_owned();
        self.scene.settings.file_integrator = Some(FileIntegrator { name, max_depth, spp });
        Ok(())
    }

    /// Takes lamps and surroundings from the sight of the camera.
    fn hide_emitters(&mut self) {
        for emission in self.scene.objects.iter_mut().filter_map(|object| object.emission.as_mut()) {
            emission.visible_to_camera = false;
        }
        for light in &mut self.scene.lights {
            if let LightKind::Environment { visible_to_camera, .. } = &mut light.kind {
                *visible_to_camera = false;
            }
        }
    }

    /// Adds a material; returns its name.
    pub(super) fn add_material(
        &mut self,
        name: &str,
        kind: MaterialKind,
        two_sided: bool,
        source: &Source,
    ) -> Located<String> {
        let material = MaterialDescription { two_sided, ..MaterialDescription::new(name, kind) };
        Located::new(add_material(&mut self.scene.materials, material, source), source.clone())
    }
}
