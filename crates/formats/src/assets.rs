//! Meshes and images that a scene names, each read once.

use crate::image::Encoding;
use crate::{Result, image, mesh};
use hyaline_scene::{ImageData, MeshData, SceneError, Source};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Images by path and by how their values were taken.
type Images = BTreeMap<(PathBuf, Option<Encoding>), Arc<ImageData>>;

/// Reader of the files beside a scene.
///
/// Names are relative to the scene's folder or absolute; they may lead out of the folder, but only to regular files
/// that exist.
#[derive(Debug)]
pub(crate) struct Assets {
    base_dir: PathBuf,
    meshes: RefCell<BTreeMap<PathBuf, Arc<MeshData>>>,
    images: RefCell<Images>,
}

impl Assets {
    /// Files beside a scene in `base_dir`.
    pub(crate) fn new(base_dir: &Path) -> Self {
        let base_dir = base_dir.to_owned();
        Self { base_dir, meshes: RefCell::default(), images: RefCell::default() }
    }

    /// The path that a name means.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.base_dir.join(name)
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
        let mesh = Arc::new(mesh::read(&path, &bytes).map_err(|error| place(error, source))?);
        self.meshes.borrow_mut().insert(path, mesh.clone());
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
        let image = Arc::new(image::read(&key.0, &bytes, encoding).map_err(|error| place(error, source))?);
        self.images.borrow_mut().insert(key, image.clone());
        Ok(image)
    }
}

/// Gives a fault without a place the place where the file was named.
fn place(mut error: SceneError, source: &Source) -> SceneError {
    error.source.get_or_insert_with(|| source.clone());
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
