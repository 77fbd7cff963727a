//! Image files: OpenEXR, PNG and PFM, chosen by the file's ending.

mod exr;
mod pfm;
mod png;

use crate::atomic::write_atomically;
use crate::image::Image;
use std::fmt;
use std::path::Path;

/// A kind of image file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// OpenEXR: linear f32, all channels, window and metadata.
    Exr,
    /// PNG: 8-bit sRGB, exposed and clipped; written only.
    Png,
    /// Portable float map: linear f32 colors.
    Pfm,
}

/// Why an image file could not be read or written. Messages don't name the file: the caller knows it.
#[derive(Debug)]
pub enum ImageError {
    /// The file could not be read or written.
    Io(std::io::Error),
    /// The file's ending names no format that we know; it is given without the dot.
    UnknownEnding(String),
    /// The content is not what the ending says, or damaged, or of a kind that we don't read.
    Content(String),
}

impl ImageFormat {
    /// The format that a file's ending names, in capitals or not.
    ///
    /// # Errors
    /// If it names none of ours.
    pub fn from_path(path: &Path) -> Result<Self, ImageError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match ending.as_str() {
            "exr" => Ok(Self::Exr),
            "png" => Ok(Self::Png),
            "pfm" => Ok(Self::Pfm),
            _ => Err(ImageError::UnknownEnding(ending)),
        }
    }
}

/// Writes an image file, whole or not at all.
///
/// - `exposure`: factor on the colors of a PNG; EXR and PFM keep radiance as it is.
///
/// # Errors
/// If the ending is unknown or the file can't be written.
pub fn write_image(path: &Path, image: &Image, exposure: f32) -> Result<(), ImageError> {
    let bytes = match ImageFormat::from_path(path)? {
        ImageFormat::Exr => exr::encode(image)?,
        ImageFormat::Png => png::encode(image, exposure)?,
        ImageFormat::Pfm => pfm::encode(image),
    };
    Ok(write_atomically(path, &bytes)?)
}

/// Reads the colors of an EXR or PFM file.
///
/// # Errors
/// If the ending is unknown, or the file can't be read or is damaged.
pub fn read_image(path: &Path) -> Result<Image, ImageError> {
    match ImageFormat::from_path(path)? {
        ImageFormat::Exr => exr::decode(&std::fs::read(path)?),
        ImageFormat::Pfm => pfm::decode(&std::fs::read(path)?),
        ImageFormat::Png => Err(ImageError::Content(
            "a PNG holds no radiance: read the .exr or .pfm of the picture instead".to_owned(),
        )),
    }
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::UnknownEnding(ending) if ending.is_empty() => {
                write!(f, "an image file's name must end in .exr, .png or .pfm")
            }
            Self::UnknownEnding(ending) => {
                write!(f, "'.{ending}' is no image format known here: use .exr, .png or .pfm")
            }
            Self::Content(text) => write!(f, "{text}"),
        }
    }
}

impl std::error::Error for ImageError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io(error) => Some(error),
            Self::UnknownEnding(_) | Self::Content(_) => None,
        }
    }
}

impl From<std::io::Error> for ImageError {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rect::Rect;

    #[test]
    fn endings_name_formats() {
        assert_eq!(ImageFormat::from_path(Path::new("a/b.EXR")).expect("known"), ImageFormat::Exr);
        let message = |name: &str| ImageFormat::from_path(Path::new(name)).expect_err("unknown").to_string();
        assert_eq!(message("a.jpg"), "'.jpg' is no image format known here: use .exr, .png or .pfm");
        assert_eq!(message("a"), "an image file's name must end in .exr, .png or .pfm");
    }

    #[test]
    fn radiance_survives_exr_and_pfm_files() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let rgb = (0..35).map(|i| [i as f32 * 1e-3, 1e9 / (i + 1) as f32, -(i as f32)]).collect();
        let image = Image::new(7, 5, rgb);
        for name in ["a.exr", "a.pfm"] {
            let path = folder.path().join(name);
            write_image(&path, &image, 0.1).expect("written");
            assert_eq!(read_image(&path).expect("read").rgb, image.rgb, "{name}");
        }
        assert!(read_image(&folder.path().join("a.png")).is_err());
        assert!(matches!(read_image(&folder.path().join("none.exr")), Err(ImageError::Io(_))));
    }

    #[test]
    fn crops_have_their_own_size_where_the_format_knows_no_window() {
        let window = Rect { x0: 2, y0: 1, x1: 5, y1: 3 };
        let image = Image { window, ..Image::new(7, 5, vec![]).with_rgb(vec![[0.5; 3]; 6]) };
        let pfm = pfm::decode(&pfm::encode(&image)).expect("read");
        assert_eq!((pfm.width, pfm.height, pfm.rgb.len()), (3, 2, 6));
        let exr = exr::decode(&exr::encode(&image).expect("encoded")).expect("read");
        assert_eq!((exr.width, exr.height, exr.window), (7, 5, window));
    }
}
