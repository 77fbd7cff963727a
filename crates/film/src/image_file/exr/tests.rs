//! EXR files round trip, are reproducible, and never cause a panic.

use super::*;
use crate::develop;
use crate::film::tests::film;

fn picture() -> Image {
    let mut image = develop(&film(0..3));
    image.metadata.push(("command".to_owned(), "hyaline glaß.toml -o glaß.exr".to_owned()));
    image
}

/// Numbers in 0…1 from a counter.
fn noise(counter: u64) -> f64 {
    let x = (counter + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (x >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn all_channels_and_texts_are_in_the_file() {
    let image = picture();
    let bytes = encode(&image).expect("encoded");
    let meta = MetaData::read_from_buffered(&bytes[..], true).expect("a header");
    let header = &meta.headers[0];
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let expected = [
        "B",
        "G",
        "R",
        "albedo.B",
        "albedo.G",
        "albedo.R",
        "depth.Z",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "object.id",
    ];
    assert_eq!(names, expected);
    for (name, value) in &image.metadata {
        assert_eq!(
            header.own_attributes.other.get(&attribute_name(name)),
            Some(&AttributeValue::Text(text(value))),
            "{name}"
        );
    }
    let read = decode(&bytes).expect("read");
    assert_eq!((read.rgb, read.window), (image.rgb, image.window));
}

#[test]
fn the_same_picture_is_the_same_file() {
    let image = picture();
    let first = encode(&image).expect("encoded");
    assert!((0..20).all(|_| encode(&image).expect("encoded") == first));
}

#[test]
fn half_floats_are_read() {
    let half = |values: [f32; 2]| {
        FlatSamples::F16(values.iter().map(|&v| ::exr::prelude::f16::from_f32(v)).collect())
    };
    let channels = [("R", [0.5, 1.0]), ("G", [0.25, 2.0]), ("B", [0.0, 4.0]), ("A", [1.0, 1.0])];
    let list = channels.map(|(name, values)| AnyChannel::new(text(name), half(values))).into_iter().collect();
    let file = exr_image::Image::from_channels(Vec2(2, 1), AnyChannels::sort(list));
    let mut bytes = Vec::new();
    file.write().to_buffered(Cursor::new(&mut bytes)).expect("written");
    assert_eq!(decode(&bytes).expect("read").rgb, [[0.5, 0.25, 0.0], [1.0, 2.0, 4.0]]);
}

#[test]
fn files_without_colors_are_refused() {
    let list = [AnyChannel::new(text("Z"), FlatSamples::F32(vec![1.0]))].into_iter().collect();
    let file = exr_image::Image::from_channels(Vec2(1, 1), AnyChannels::sort(list));
    let mut bytes = Vec::new();
    file.write().to_buffered(Cursor::new(&mut bytes)).expect("written");
    assert!(decode(&bytes).expect_err("no colors").to_string().contains("no channels R, G and B"));
}

#[test]
fn truncated_and_damaged_files_give_an_error_or_a_picture_but_no_panic() {
    let bytes = encode(&picture()).expect("encoded");
    for length in (0..bytes.len()).step_by(7) {
        let _ = decode(&bytes[..length]);
    }
    let mut refused = 0;
    for i in 0..6000 {
        let mut damaged = bytes.clone();
        // Half of the changes go to the header, where they hurt most.
        let reach = if i % 2 == 0 { bytes.len() } else { 900 };
        for k in 0..1 + i % 3 {
            let bit = (noise(8 * i + k) * (8 * reach) as f64) as usize;
            damaged[bit / 8] ^= 1 << (bit % 8);
        }
        refused += u32::from(decode(&damaged).is_err());
    }
    assert!(refused > 1000, "the test reaches the errors: {refused}");
}

#[test]
fn damaged_files_of_every_compression_give_no_panic_either() {
    use Compression::{B44, PIZ, PXR24, RLE, Uncompressed, ZIP1};
    for compression in [Uncompressed, RLE, ZIP1, PIZ, PXR24, B44] {
        let channel = |name: &str, k: u64| {
            AnyChannel::new(text(name), FlatSamples::F32((0..40 * 40).map(|i| noise(i + k) as f32).collect()))
        };
        let list = [channel("R", 0), channel("G", 9), channel("B", 5)].into_iter().collect();
        let encoding = Encoding { compression, ..Encoding::FAST_LOSSLESS };
        let file = exr_image::Image::from_encoded_channels(Vec2(40, 40), encoding, AnyChannels::sort(list));
        let mut bytes = Vec::new();
        file.write().to_buffered(Cursor::new(&mut bytes)).expect("written");
        assert!(decode(&bytes).is_ok(), "{compression}");
        for i in 0..1500 {
            let mut damaged = bytes.clone();
            for k in 0..1 + i % 4 {
                let reach = if i % 2 == 0 { bytes.len() } else { 800 };
                damaged[(noise(16 * i + k) * reach as f64) as usize] = (noise(16 * i + k + 8) * 256.0) as u8;
            }
            let _ = decode(&damaged);
        }
    }
}
