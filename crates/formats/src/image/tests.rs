//! Tests of image files: written by the format's own writer or by hand, read back, and damaged.

use super::{Encoding, read};
use crate::color::linear_from_srgb;
use hyaline_scene::ImageData;
use std::path::Path;

fn read_as(name: &str, bytes: &[u8]) -> Result<ImageData, String> {
    read(Path::new(name), bytes, None).map_err(|error| error.message)
}

fn encode_png(color: png::ColorType, depth: png::BitDepth, width: u32, height: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

#[test]
fn png_of_every_depth_becomes_linear() {
    let rgb = encode_png(png::ColorType::Rgb, png::BitDepth::Eight, 2, 1, &[0, 128, 255, 255, 0, 0]);
    let image = read_as("a.png", &rgb).unwrap();
    assert_eq!((image.width, image.height), (2, 1));
    assert_eq!(image.pixels, [[0.0, linear_from_srgb(128.0 / 255.0), 1.0], [1.0, 0.0, 0.0]]);
    let linear = read(Path::new("a.png"), &rgb, Some(Encoding::Linear)).unwrap();
    assert_eq!(linear.pixels[0][1], 128.0 / 255.0);
    let grey = encode_png(png::ColorType::GrayscaleAlpha, png::BitDepth::Sixteen, 1, 1, &[255, 255, 0, 0]);
    assert_eq!(read_as("a.png", &grey).unwrap().pixels, [[1.0; 3]]);
    let bits = encode_png(png::ColorType::Grayscale, png::BitDepth::One, 3, 1, &[0b1010_0000]);
    assert_eq!(read_as("a.png", &bits).unwrap().pixels, [[1.0; 3], [0.0; 3], [1.0; 3]]);
}

#[test]
fn exr_is_read_with_its_values() {
    let mut bytes = std::io::Cursor::new(Vec::new());
    use exr::prelude::{Image, SpecificChannels, WritableImage};
    let channels = SpecificChannels::rgb(|position: exr::math::Vec2<usize>| {
        (position.0 as f32, position.1 as f32 * 100.0, 0.25f32)
    });
    Image::from_channels((3, 2), channels).write().non_parallel().to_buffered(&mut bytes).unwrap();
    let image = read_as("a.exr", bytes.get_ref()).unwrap();
    assert_eq!((image.width, image.height), (3, 2));
    assert_eq!(image.pixels[5], [2.0, 100.0, 0.25], "the last pixel of the last row");
    for length in (0..bytes.get_ref().len()).step_by(7) {
        assert!(read_as("a.exr", &bytes.get_ref()[..length]).is_err(), "cut at {length}");
    }
}

#[test]
fn pfm_is_read_from_the_bottom_up() {
    let mut bytes = b"PF\n1 2\n-1.0\n".to_vec();
    for value in [1.0f32, 2.0, 3.0, 4.0, 5.0, 6.0] {
        bytes.extend(value.to_le_bytes());
    }
    assert_eq!(read_as("a.pfm", &bytes).unwrap().pixels, [[4.0, 5.0, 6.0], [1.0, 2.0, 3.0]]);
    let mut grey = b"Pf 1 1 1.0\n".to_vec();
    grey.extend(7.5f32.to_be_bytes());
    assert_eq!(read_as("a.pfm", &grey).unwrap().pixels, [[7.5; 3]]);
    assert!(read_as("a.pfm", &bytes[..30]).unwrap_err().contains("PFM ends"));
    assert!(read_as("a.pfm", b"PF\n4000000000 4000000000\n-1\n").unwrap_err().contains("can't be read"));
    assert!(read_as("a.pfm", b"PF\nnan 2\n-1\n").is_err());
}

#[test]
fn radiance_images_are_read_plain_and_packed() {
    let head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n".to_vec();
    let mut plain = head.clone();
    plain.extend(b"-Y 1 +X 2\n");
    plain.extend([128, 64, 0, 129, 0, 0, 0, 0]);
    assert_eq!(read_as("a.hdr", &plain).unwrap().pixels, [[1.0, 0.5, 0.0], [0.0; 3]]);
    let mut packed = head.clone();
    packed.extend(b"-Y 1 +X 8\n");
    packed.extend([2, 2, 0, 8]);
    packed.extend([128 + 8, 128]);
    packed.extend([3, 1, 2, 3, 128 + 5, 0]);
    packed.extend([128 + 8, 0, 128 + 8, 129]);
    let image = read_as("a.hdr", &packed).unwrap();
    assert_eq!((image.pixels[0], image.pixels[7]), ([1.0, 1.0 / 128.0, 0.0], [1.0, 0.0, 0.0]));
    for length in 0..packed.len() {
        assert!(read_as("a.hdr", &packed[..length]).is_err(), "cut at {length}");
    }
    let mut long = head;
    long.extend(b"-Y 1 +X 8\n\x02\x02\x00\x08\xff\x00");
    assert!(read_as("a.hdr", &long).unwrap_err().contains("longer than its row"));
}

#[test]
fn foreign_and_unsound_images_are_refused() {
    assert!(read_as("a.tga", b"").unwrap_err().contains("'.tga'"));
    assert!(read_as("a.png", b"not a png").unwrap_err().contains("not a sound PNG"));
    let mut nan = b"Pf 1 1 -1.0\n".to_vec();
    nan.extend(f32::NAN.to_le_bytes());
    assert!(read_as("a.pfm", &nan).unwrap_err().contains("not finite"));
}
