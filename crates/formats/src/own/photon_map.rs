//! `[settings.photon_map]`: what the stages of photon mapping do, in the words of Jensen's book.
//!
//! - `caustic_photons`, `global_photons`, `volume_photons`: photons emitted for each map; 0 leaves the map out.
//! - `nearest`: photons that an estimate takes, one number for all maps or `{ caustic, global, volume }`;
//!   `max_radius`: how far it looks at most, a length or "auto".
//! - `kernel`: "constant", "cone" or `{ cone = k }`, "gaussian", "epanechnikov";
//!   `collection`: "sphere", "disc" or `{ disc = thickness }`.
//! - `projection`: "none", "cells" or "objects"; `projection_cells`: their number along each axis.
//! - `final_gather`, `gather_rays`, `exclude_direct`, `exclude_single_scattering`, `max_bounces`, `leaf_size`.

use super::document::Value;
use super::field::Field;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{Collection, NearestPhotons, PhotonKernel, PhotonMapSettings, ProjectionMaps};

/// Most photons that can be asked of a map: about 40 GB of them.
const MAX_PHOTONS: i64 = 1_000_000_000;
/// Most photons that an estimate may take.
const MAX_NEAREST: i64 = 1_000_000;
/// Most photons in a leaf of the tree.
const MAX_LEAF: i64 = 1024;
/// Most cells along an axis of a projection map.
const MAX_CELLS: i64 = 1024;
/// Most gather rays of a path and pass.
const MAX_GATHER_RAYS: i64 = 65_536;

/// Changes `settings` to what the table says. `metres` is the length of a scene unit.
pub(super) fn read(mut table: Table<'_>, metres: f64, settings: &mut PhotonMapSettings) -> Result<()> {
    let PhotonMapSettings {
        caustic_photons,
        global_photons,
        volume_photons,
        nearest,
        max_radius,
        kernel,
        collection,
        leaf_size,
        projection,
        projection_cells,
        final_gather,
        gather_rays,
        exclude_direct,
        exclude_single_scattering,
        max_bounces,
    } = settings;
    let photons = [
        ("caustic_photons", caustic_photons),
        ("global_photons", global_photons),
        ("volume_photons", volume_photons),
    ];
    for (key, count) in photons {
        *count = table.read(key, *count, |field| integer(field, 0, MAX_PHOTONS))?;
    }
    let counts = [
        ("leaf_size", leaf_size, MAX_LEAF),
        ("projection_cells", projection_cells, MAX_CELLS),
        ("gather_rays", gather_rays, MAX_GATHER_RAYS),
        ("max_bounces", max_bounces, i64::from(u32::MAX)),
    ];
    for (key, count, most) in counts {
        *count = table.read(key, *count, |field| integer(field, 1, most))?;
    }
    let switches = [
        ("final_gather", final_gather),
        ("exclude_direct", exclude_direct),
        ("exclude_single_scattering", exclude_single_scattering),
    ];
    for (key, switch) in switches {
        *switch = table.read(key, *switch, |field| field.boolean())?;
    }
    *nearest = table.read("nearest", *nearest, |field| read_nearest(field, *nearest))?;
    *max_radius = table.read("max_radius", *max_radius, |field| read_radius(field, metres))?;
    *kernel = table.read("kernel", *kernel, read_kernel)?;
    *collection = table.read("collection", *collection, read_collection)?;
    *projection = table.read("projection", *projection, |field| field.choice(&PROJECTIONS))?;
    table.finish()
}

const PROJECTIONS: [(&str, ProjectionMaps); 3] =
    [("none", ProjectionMaps::None), ("cells", ProjectionMaps::Cells), ("objects", ProjectionMaps::Objects)];

fn integer(field: Field<'_>, low: i64, high: i64) -> Result<u32> {
    debug_assert!(high <= i64::from(u32::MAX));
    field.integer(low, high).map(|count| count as u32)
}

/// One number for all maps, or a table with a number for each; those that are absent stay as they are.
fn read_nearest(field: Field<'_>, old: NearestPhotons) -> Result<NearestPhotons> {
    let count = |field: Field<'_>| integer(field, 2, MAX_NEAREST);
    if !matches!(field.node.value, Value::Table(_)) {
        let all = count(field)?;
        return Ok(NearestPhotons { caustic: all, global: all, volume: all });
    }
    let mut table = field.table("settings.photon_map.nearest")?;
    let nearest = NearestPhotons {
        caustic: table.read("caustic", old.caustic, count)?,
        global: table.read("global", old.global, count)?,
        volume: table.read("volume", old.volume, count)?,
    };
    table.finish()?;
    Ok(nearest)
}

/// A length in scene units, or `None` for "auto".
fn read_radius(field: Field<'_>, metres: f64) -> Result<Option<f64>> {
    match field.string() {
        Ok("auto") => Ok(None),
        Ok(word) if word.starts_with(char::is_alphabetic) => Err(field
            .error(format!("`{}` is '{word}', which is no length", field.key))
            .with_remedy("write \"auto\", a number of scene units, or a length such as \"2 mm\"")),
        _ => field.length(metres, Limits::POSITIVE).map(Some),
    }
}

fn read_kernel(field: Field<'_>) -> Result<PhotonKernel> {
    let kernels = [
        ("constant", PhotonKernel::Constant),
        ("cone", PhotonKernel::default()),
        ("gaussian", PhotonKernel::Gaussian),
        ("epanechnikov", PhotonKernel::Epanechnikov),
    ];
    if !matches!(field.node.value, Value::Table(_)) {
        return field.choice(&kernels);
    }
    let mut table = field.table("settings.photon_map.kernel")?;
    let k = table.require("cone", "1.1")?.number_f32(Limits::from(1.0))?;
    table.finish()?;
    Ok(PhotonKernel::Cone { k })
}

fn read_collection(field: Field<'_>) -> Result<Collection> {
    let collections = [("sphere", Collection::Sphere), ("disc", Collection::default())];
    if !matches!(field.node.value, Value::Table(_)) {
        return field.choice(&collections);
    }
    let mut table = field.table("settings.photon_map.collection")?;
    // A disc of no thickness would lose photons to rounding alone.
    let thickness = table.require("disc", "0.25")?.number_f32(Limits::above_to(0.0, 1.0))?;
    table.finish()?;
    Ok(Collection::Disc { thickness })
}

#[cfg(test)]
#[path = "photon_map_tests.rs"]
mod tests;
