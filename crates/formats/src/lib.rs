//! Readers: scene files and meshes to a scene description.
//!
//! `load` chooses the reader by the ending of the file's name: `.toml` is hyaline's own format, `.xml` Mitsuba's.
//! Each reader checks every value where it reads it: what cannot be meant is a `SceneError` with file, line and
//! column and a remedy, what is not supported a `Note`. No input makes a reader panic or run without end.
//!
//! ```
//! let text = "
//!     [camera]
//!     from = [0, 0.5, 2]
//!     [[object]]
//!     kind = \"sphere\"
//!     radius = \"30 cm\"
//! ";
//! let scene = hyaline_formats::load_toml_text(text, "ball.toml", std::path::Path::new("."), &[]).unwrap();
//! assert_eq!(scene.objects.len(), 1);
//! ```

mod assets;
mod color;
mod grid;
mod image;
mod limits;
mod mesh;
mod mitsuba;
mod nearest;
mod own;
mod place;
mod unit;

use hyaline_scene::{ImageData, MeshData, SceneDescription, SceneError, Source};
use std::path::Path;
use std::sync::Arc;

type Result<T> = std::result::Result<T, SceneError>;

/// A scene, or everything that is wrong with it: at least one fault.
type ResultOrAllFaults = std::result::Result<SceneDescription, Vec<SceneError>>;

/// Reads a scene from its text, the file's name, the folder of its files, and overrides.
type TextReader = fn(&str, &Arc<str>, &Path, &[(String, String)]) -> ResultOrAllFaults;

/// Reads a scene file; its ending (`.toml`, `.xml`) tells the format.
///
/// - `overrides`: pairs of `--set KEY=VALUE`. In TOML any key by its dotted path, array elements by name or index; in
///   other formats `settings.*`, `film.*`, `camera.*`, `media.NAME.*` and `object.NAME.*`; in Mitsuba's also
///   `default.NAME` for its parameters and `import.two_sided`.
///
/// # Errors
/// The file can't be read, its ending is unknown or not supported yet, or something in it is wrong.
pub fn load(
    path: &Path,
    overrides: &[(String, String)],
) -> std::result::Result<SceneDescription, SceneError> {
    load_or_all_faults(path, overrides).map_err(first)
}

/// Reads a scene file as [`load`] does, and tells everything that is wrong with it.
///
/// # Errors
/// All faults, at least one. In TOML that is the first of each section, object, light and so on; other formats and
/// files that are no TOML end at the first.
pub fn load_or_all_faults(path: &Path, overrides: &[(String, String)]) -> ResultOrAllFaults {
    let one = |fault: SceneError| vec![fault];
    let file: Arc<str> = Arc::from(path.display().to_string());
    let source = Source::file(file.clone());
    let read: TextReader = match ending(path).as_str() {
        "toml" => own::read,
        "xml" => |text, file, base_dir, overrides| {
            mitsuba::read(text, file, base_dir, overrides).map_err(|fault| vec![fault])
        },
        "gltf" | "glb" | "pbrt" => {
            let message = format!("scenes ending in .{} can't be read yet", ending(path));
            return Err(one(SceneError::at(&source, message).with_remedy("give a .toml or .xml scene")));
        }
        _ => {
            let error = SceneError::at(&source, "the ending of the file's name tells no scene format");
            return Err(one(error.with_remedy("the formats are .toml (hyaline) and .xml (Mitsuba 3)")));
        }
    };
    let bytes = assets::read_file(&source, &file, path).map_err(one)?;
    let text = String::from_utf8(bytes).map_err(|error| one(not_text(&file, error.as_bytes())))?;
    let base_dir = path.parent().unwrap_or(Path::new(""));
    read(text.strip_prefix('\u{feff}').unwrap_or(&text), &file, base_dir, overrides)
}

/// Reads a scene in hyaline's own format from its text.
///
/// - `file_name`: its name in messages.
/// - `base_dir`: the folder that file names in it are relative to.
/// - `overrides`: as for [`load`].
///
/// # Errors
/// The first thing that is wrong with it, and where.
pub fn load_toml_text(
    text: &str,
    file_name: &str,
    base_dir: &Path,
    overrides: &[(String, String)],
) -> std::result::Result<SceneDescription, SceneError> {
    own::read(text, &Arc::from(file_name), base_dir, overrides).map_err(first)
}

/// Reads a Mitsuba scene (version 3, and the older names of 0.5 and 0.6) from its text.
///
/// - `file_name`, `base_dir`, `overrides`: as for [`load_toml_text`].
///
/// # Errors
/// The first thing that is wrong with it, and where. What is merely not supported is a note of the description.
pub fn load_mitsuba_text(
    text: &str,
    file_name: &str,
    base_dir: &Path,
    overrides: &[(String, String)],
) -> std::result::Result<SceneDescription, SceneError> {
    mitsuba::read(text, &Arc::from(file_name), base_dir, overrides)
}

/// Reads a mesh file (`.ply`, `.obj`; of a `.serialized` file the first mesh).
///
/// # Errors
/// It can't be read, is damaged or empty: with the line, or the offset in bytes where it is binary.
pub fn load_mesh(path: &Path) -> std::result::Result<MeshData, SceneError> {
    let name = path.display().to_string();
    mesh::read(path, &assets::read_file(&Source::file(name.as_str()), &name, path)?)
}

/// Reads a mesh from the content of a file whose name is `file_name`.
///
/// # Errors
/// As for [`load_mesh`].
pub fn mesh_from_bytes(bytes: &[u8], file_name: &str) -> std::result::Result<MeshData, SceneError> {
    mesh::read(Path::new(file_name), bytes)
}

/// Reads an image file (`.png`, `.jpg`, `.exr`, `.pfm`, `.hdr`) as linear Rec. 709 colors; 8- and 16-bit images are taken as
/// sRGB.
///
/// # Errors
/// It can't be read or is damaged.
pub fn load_image(path: &Path) -> std::result::Result<ImageData, SceneError> {
    let name = path.display().to_string();
    image::read(path, &assets::read_file(&Source::file(name.as_str()), &name, path)?, None)
}

/// Reads an image from the content of a file whose name is `file_name`.
///
/// # Errors
/// As for [`load_image`].
pub fn image_from_bytes(bytes: &[u8], file_name: &str) -> std::result::Result<ImageData, SceneError> {
    image::read(Path::new(file_name), bytes, None)
}

/// The fault to tell where only one is told.
fn first(faults: Vec<SceneError>) -> SceneError {
    faults.into_iter().next().unwrap_or_else(|| SceneError::general("the scene can't be read"))
}

/// The ending of a file's name, in lower case, without the dot.
fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default()
}

fn not_text(file: &Arc<str>, bytes: &[u8]) -> SceneError {
    let valid = std::str::from_utf8(bytes).err().map_or(0, |error| error.valid_up_to());
    let line = 1 + bytes[..valid].iter().filter(|byte| **byte == b'\n').count();
    let line_number = u32::try_from(line).unwrap_or(u32::MAX);
    let source = Source { file: file.clone(), line: line_number, column: 0, length: 1 };
    SceneError::at(&source, "not a text in UTF-8")
}
