//! Meshes, images and grids that a scene names, each read once.
//!
//! Names are relative to the scene's folder or absolute, and may lead out of the folder: scenes share textures in
//! folders beside them. Only regular files are opened, so that pipes and devices can't stall a load, and nothing of a
//! file's content gets into a message but numbers and single words of meshes.

use crate::grid::{BoxedGrid, read_raw, read_vol};
use crate::image::Encoding;
use crate::mesh::FileMesh;
use crate::{Result, ending, image, mesh};
use hyaline_scene::{GridData, ImageData, MeshData, SceneError, Source};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Images by path and by how their values were taken.
type Images = BTreeMap<(PathBuf, Option<Encoding>), Arc<ImageData>>;

/// Reader of the files beside a scene.
#[derive(Debug)]
pub(crate) struct Assets {
    base_dir: PathBuf,
    /// Folders to look in before the scene's, the first of them first.
    before: RefCell<Vec<PathBuf>>,
    /// Folders to look in after the scene's.
    after: RefCell<Vec<PathBuf>>,
    meshes: RefCell<BTreeMap<PathBuf, Arc<MeshData>>>,
    parts: RefCell<BTreeMap<(PathBuf, u32), FileMesh>>,
    images: RefCell<Images>,
    grids: RefCell<BTreeMap<PathBuf, Arc<BoxedGrid>>>,
}

impl Assets {
    /// Files beside a scene in `base_dir`.
    pub(crate) fn new(base_dir: &Path) -> Self {
        Self {
            base_dir: base_dir.to_owned(),
            before: RefCell::default(),
            after: RefCell::default(),
            meshes: RefCell::default(),
            parts: RefCell::default(),
            images: RefCell::default(),
            grids: RefCell::default(),
        }
    }

    /// The scene's folder.
    pub(crate) fn base_dir(&self) -> &Path {
        &self.base_dir
    }

    /// Looks in a folder before all others from now on.
    pub(crate) fn look_first_in(&self, folder: PathBuf) {
        self.before.borrow_mut().insert(0, folder);
    }

    /// Looks in a folder after all others from now on.
    pub(crate) fn look_last_in(&self, folder: PathBuf) {
        let mut after = self.after.borrow_mut();
        if folder != self.base_dir && !after.contains(&folder) {
            after.push(folder);
        }
    }

    /// The path that a name means: in the first folder that has such a file, or else in the scene's.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        let beside = self.base_dir.join(name);
        let (before, after) = (self.before.borrow(), self.after.borrow());
        if before.is_empty() && after.is_empty() {
            return beside;
        }
        let others = before.iter().map(|folder| folder.join(name));
        let mut candidates =
            others.chain([beside.clone()]).chain(after.iter().map(|folder| folder.join(name)));
        candidates.find(|path| path.exists()).unwrap_or(beside)
    }

    /// A mesh by its file's name, which was said at `source`.
    ///
    /// # Errors
    /// The file can't be read, is no mesh, or is damaged.
    pub(crate) fn mesh(&self, source: &Source, name: &str) -> Result<Arc<MeshData>> {
        let path = self.path(name);
        if let Some(mesh) = self.meshes.borrow().get(&path) {
            return Ok(mesh.clone());
        }
        let bytes = read_file(source, name, &path)?;
        let mesh = Arc::new(mesh::read(&path, &bytes).map_err(|error| named_at(error, source))?);
        self.meshes.borrow_mut().insert(path, mesh.clone());
        Ok(mesh)
    }

    /// One of the meshes of a `.serialized` file.
    ///
    /// # Errors
    /// As for [`Self::mesh`]; the file has no mesh of this number.
    pub(crate) fn serialized_mesh(&self, source: &Source, name: &str, index: u32) -> Result<FileMesh> {
        let key = (self.path(name), index);
        if let Some(mesh) = self.parts.borrow().get(&key) {
            return Ok(mesh.clone());
        }
        let bytes = read_file(source, name, &key.0)?;
        let mesh = mesh::read_serialized(&key.0, &bytes, index).map_err(|error| named_at(error, source))?;
        self.parts.borrow_mut().insert(key, mesh.clone());
        Ok(mesh)
    }

    /// An image by its file's name, which was said at `source`; `encoding` overrides what the kind of file implies.
    ///
    /// # Errors
    /// The file can't be read, is no image, or is damaged.
    pub(crate) fn image(
        &self,
        source: &Source,
        name: &str,
        encoding: Option<Encoding>,
    ) -> Result<Arc<ImageData>> {
        let key = (self.path(name), encoding);
        if let Some(image) = self.images.borrow().get(&key) {
            return Ok(image.clone());
        }
        let bytes = read_file(source, name, &key.0)?;
        let image = Arc::new(image::read(&key.0, &bytes, encoding).map_err(|error| named_at(error, source))?);
        self.images.borrow_mut().insert(key, image.clone());
        Ok(image)
    }

    /// A `.vol` file by its name, which was said at `source`.
    ///
    /// # Errors
    /// The file can't be read, is no grid, or is damaged.
    pub(crate) fn grid(&self, source: &Source, name: &str) -> Result<Arc<BoxedGrid>> {
        let path = self.path(name);
        if let Some(grid) = self.grids.borrow().get(&path) {
            return Ok(grid.clone());
        }
        refuse_sparse_grid(source, name)?;
        let bytes = read_file(source, name, &path)?;
        let grid = Arc::new(read_vol(&bytes).map_err(|message| in_file(&path, message, source))?);
        self.grids.borrow_mut().insert(path, grid.clone());
        Ok(grid)
    }

    /// A file of bare `f32` by its name, which was said at `source`.
    ///
    /// # Errors
    /// The file can't be read or holds anything but that many values.
    pub(crate) fn raw_grid(
        &self,
        source: &Source,
        name: &str,
        size: [u32; 3],
        channels: u32,
    ) -> Result<GridData> {
        let path = self.path(name);
        let bytes = read_file(source, name, &path)?;
        read_raw(&bytes, size, channels).map_err(|message| in_file(&path, message, source))
    }
}

/// Names the formats of sparse grids, which would otherwise be taken for damaged files of another one.
///
/// # Errors
/// The ending of the file is that of OpenVDB or NanoVDB.
pub(crate) fn refuse_sparse_grid(source: &Source, name: &str) -> Result<()> {
    let format = match ending(Path::new(name)).as_str() {
        "vdb" => "OpenVDB",
        "nvdb" => "NanoVDB",
        _ => return Ok(()),
    };
    let error = SceneError::at(source, format!("'{name}': {format} grids can't be read"));
    Err(error.with_remedy("convert it to Mitsuba's .vol, or to dense f32 numbers with `size`"))
}

/// A fault of a file as a whole.
fn in_file(path: &Path, message: String, source: &Source) -> SceneError {
    named_at(SceneError::at(&Source::file(path.display().to_string()), message), source)
}

/// Adds to a fault within a file where the file was named.
fn named_at(mut error: SceneError, source: &Source) -> SceneError {
    match &error.source {
        None => error.source = Some(source.clone()),
        Some(_) => error.message += &format!(" (the file is named at {source})"),
    }
    error
}

/// Reads a regular file that was named at `source`.
pub(crate) fn read_file(source: &Source, name: &str, path: &Path) -> Result<Vec<u8>> {
    let unreadable = |reason: String| {
        let error = SceneError::at(source, format!("can't read '{name}': {reason}"));
        error.with_remedy(format!("looked for {}", path.display()))
    };
    let metadata = std::fs::metadata(path).map_err(|error| unreadable(reason(&error)))?;
    if !metadata.is_file() {
        return Err(unreadable("it is not a regular file".to_owned()));
    }
    std::fs::read(path).map_err(|error| unreadable(reason(&error)))
}

/// What went wrong, without the system's error number.
pub(crate) fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}
