//! OpenEXR: the channels R, G, B (or Y) of the first layer that has them.

use super::check_size;
use exr::prelude::{FlatSamples, MetaData, ReadChannels, ReadLayers};
use hyaline_scene::ImageData;
use std::io::Cursor;

/// Reads an EXR image.
pub(super) fn read(bytes: &[u8]) -> Result<ImageData, String> {
    let describe = |error: exr::error::Error| format!("not a sound EXR image: {error}");
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(describe)?;
    for header in &meta.headers {
        let size = header.layer_size;
        check_size(size.0 as u64, size.1 as u64)?;
        // Compression reaches about 1 : 1000 for even images; what claims much more is damaged.
        let claimed = (size.0 as u64) * (size.1 as u64) * header.channels.bytes_per_pixel as u64;
        if claimed / 4000 > bytes.len() as u64 {
            return Err("not a sound EXR image: it is too short for its size".to_owned());
        }
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(describe)?;
    for layer in &image.layer_data {
        let find = |name: &str| {
            let channels = &layer.channel_data.list;
            channels.iter().find(|channel| {
                let full = channel.name.to_string();
                full.rsplit('.').next().is_some_and(|last| last.eq_ignore_ascii_case(name))
            })
        };
        let channels = match (find("R"), find("G"), find("B"), find("Y")) {
            (Some(r), Some(g), Some(b), _) => [r, g, b],
            (_, _, _, Some(y)) => [y, y, y],
            _ => continue,
        };
        let (width, height) = check_size(layer.size.0 as u64, layer.size.1 as u64)?;
        let count = width as usize * height as usize;
        let channels = channels.map(|channel| &channel.sample_data);
        if channels.iter().any(|samples| samples.len() != count) {
            return Err("an EXR image with subsampled channels can't be read".to_owned());
        }
        let pixels = (0..count).map(|i| channels.map(|samples| value(samples, i))).collect();
        return Ok(ImageData { width, height, pixels });
    }
    Err("the EXR image has neither channels R, G, B nor Y".to_owned())
}

fn value(samples: &FlatSamples, index: usize) -> f32 {
    match samples {
        FlatSamples::F16(values) => values[index].to_f32(),
        FlatSamples::F32(values) => values[index],
        FlatSamples::U32(values) => values[index] as f32,
    }
}
