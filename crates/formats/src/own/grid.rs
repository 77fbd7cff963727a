//! `grid` of a medium: how dense it is where.
//!
//! `grid = { file = "smoke.raw", size = [64, 64, 128], min = [-1, 0, -1], max = [1, 4, 1] }`: a file of `f32`,
//! little-endian, x fastest, then y, then z; or a Mitsuba `.vol` file, which says its size and, where `min` and `max`
//! are absent, its box itself. A bare file fills the unit cube where they are absent. `transform` moves the box.
//! `albedo = { file, size, channels }` varies the share of what is scattered: by default of the same size, in 3 channels.
//! Between the centers of cells the numbers are interpolated; outside of the box there is nothing.

use super::field::Field;
use super::transform;
use crate::assets::{Assets, refuse_sparse_grid};
use crate::grid::BoxedGrid;
use crate::limits::Limits;
use crate::{Result, ending};
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{DensityGrid, GridData};
use std::path::Path;
use std::sync::Arc;

/// Most cells along an axis.
const MAX_SIDE: i64 = 1 << 16;

/// Reads a grid of densities.
///
/// # Errors
/// Files that can't be read or are of another size, numbers that no density or albedo has, a flat box.
pub(super) fn read(field: Field<'_>, metres: f64, assets: &Assets) -> Result<DensityGrid> {
    let mut table = field.table("grid of a medium")?;
    let file = table.require("file", "\"smoke.raw\"")?;
    let size = table.read_some("size", size)?;
    let BoxedGrid { data: density, bounds } = data(file, size, size, 1, assets)?;
    if density.channels != 1 {
        return Err(file.error("a grid of densities has one channel, but this one has three"));
    }
    let albedo = table.read_some("albedo", |field| albedo(field, density.size, assets))?;
    let min = table.read("min", bounds[0], |field| field.point(metres))?;
    let max = table.read("max", bounds[1], |field| field.point(metres))?;
    let moved = table.read("transform", Transform::IDENTITY, |field| transform::read(field, metres))?;
    table.finish()?;
    let extent = Transform::scale(max - min).filter(|_| (max - min).min_element() > 0.0);
    let Some(extent) = extent else {
        let error = field.error("the box of the grid is flat or turned inside out");
        return Err(error.with_remedy("each number of `max` must be above that of `min`"));
    };
    let placement = moved.after(&Transform::translate(min).after(&extent));
    Ok(DensityGrid { density, albedo, placement })
}

fn albedo(field: Field<'_>, usual_size: [u32; 3], assets: &Assets) -> Result<Arc<GridData>> {
    let mut table = field.table("albedo of a grid")?;
    let file = table.require("file", "\"albedo.raw\"")?;
    let said = table.read_some("size", size)?;
    let channels = table.read_some("channels", |field| field.integer(1, 3).map(|count| count as u32))?;
    table.finish()?;
    let grid = data(file, said, said.or(Some(usual_size)), channels.unwrap_or(3), assets)?.data;
    if let Some(channels) = channels.filter(|channels| *channels != grid.channels) {
        let error = file.error(format!("`channels` is {channels}, but the file has {}", grid.channels));
        return Err(error.with_remedy("remove `channels`: the file says it"));
    }
    match grid.values.iter().find(|value| !Limits::FRACTION.contain(f64::from(**value))) {
        Some(bad) => Err(file.error(format!("an albedo is from 0 to 1, but the file has {bad}"))),
        None => Ok(grid),
    }
}

/// The numbers of a file.
///
/// - `said`: what the scene says of its size; a file that tells its own must not contradict.
/// - `size`, `channels`: those of a bare file.
///
/// # Errors
/// The file can't be read, is of another size, or is bare and of no size.
fn data(
    file: Field<'_>,
    said: Option<[u32; 3]>,
    size: Option<[u32; 3]>,
    channels: u32,
    assets: &Assets,
) -> Result<BoxedGrid> {
    let name = file.string()?;
    if ending(Path::new(name)) == "vol" {
        let grid = assets.grid(file.source(), name).map(|grid| BoxedGrid::clone(&grid))?;
        let found = grid.data.size;
        return match said {
            Some(said) if said != found => {
                let error = file.error(format!("`size` is {said:?}, but '{name}' has {found:?} cells"));
                Err(error.with_remedy("remove `size`: the file says it"))
            }
            _ => Ok(grid),
        };
    }
    refuse_sparse_grid(file.source(), name)?;
    let Some(size) = size else {
        let error = file.error(format!("'{name}' does not say its size"));
        return Err(error.with_remedy("add `size = [x, y, z]`, the cells along each axis"));
    };
    let data = Arc::new(assets.raw_grid(file.source(), name, size, channels)?);
    Ok(BoxedGrid { data, bounds: [DVec3::ZERO, DVec3::ONE] })
}

fn size(field: Field<'_>) -> Result<[u32; 3]> {
    field.array(|item| item.integer(1, MAX_SIDE).map(|count| count as u32))
}

#[cfg(test)]
mod tests {
    use crate::load_toml_text;
    use hyaline_math::DVec3;
    use hyaline_scene::{DensityGrid, PhaseDescription, SceneError};
    use std::path::Path;

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let bytes = |values: &[f32]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        let write =
            |name: &str, values: &[f32]| std::fs::write(folder.path().join(name), bytes(values)).unwrap();
        write("smoke.raw", &[0.0, 1.0, 2.0, 3.0]);
        write("albedo.raw", &[0.5, 0.25, 1.0]);
        write("bad.raw", &[0.0, 1.0, f32::NAN, 3.0]);
        let mut vol = b"VOL\x03".to_vec();
        vol.extend([3u32, 1, 1, 2, 1].iter().flat_map(|n| n.to_le_bytes()));
        vol.extend(bytes(&[0.0, 0.0, -3.0, 2.0, 1.0, 3.0]));
        vol.extend([255, 0]);
        std::fs::write(folder.path().join("smoke.vol"), vol).unwrap();
        folder
    }

    fn load(medium: &str) -> Result<hyaline_scene::MediumDescription, SceneError> {
        let folder = folder();
        let text = format!(
            "camera = {{ from = [0, 0, 4] }}\nobject = {{ kind = 'sphere', medium = 'm' }}\n[media.m]\n{medium}"
        );
        load_toml_text(&text, "a.toml", folder.path(), &[]).map(|scene| scene.media[0].value.clone())
    }

    fn grid(keys: &str) -> Result<DensityGrid, SceneError> {
        load(&format!("sigma_s = 1\ngrid = {{ {keys} }}")).map(|medium| medium.density.unwrap())
    }

    #[test]
    fn a_size_that_agrees_with_its_file_is_no_fault() {
        let same = grid(
            "file = 'smoke.vol', size = [1, 1, 2], albedo = { file = 'smoke.vol', size = [1, 1, 2], channels = 1 }",
        );
        assert_eq!(same.unwrap().albedo.unwrap().values, [1.0, 0.0]);
        let other = grid("file = 'smoke.raw', size = [2, 2, 1], albedo = { file = 'smoke.vol' }").unwrap();
        assert_eq!(
            other.albedo.unwrap().size,
            [1, 1, 2],
            "the density's size is the default of a bare file only"
        );
    }

    #[test]
    fn bare_files_and_volumes_are_placed_in_their_box() {
        let albedo = "albedo = { file = 'albedo.raw', size = [1, 1, 1] }";
        let bare = grid(&format!(
            "file = 'smoke.raw', size = [2, 2, 1], min = [0, 0, 1], max = [2, '4 m', 2], {albedo}"
        ));
        let bare = bare.unwrap();
        assert_eq!((bare.density.size, &bare.density.values[..]), ([2, 2, 1], &[0.0, 1.0, 2.0, 3.0][..]));
        assert_eq!(bare.albedo.unwrap().values, [0.5, 0.25, 1.0]);
        assert_eq!(bare.placement.point(DVec3::ONE), DVec3::new(2.0, 4.0, 2.0));
        assert_eq!(bare.placement.point(DVec3::ZERO), DVec3::Z);
        let vol = grid("file = 'smoke.vol', transform = { translate = [1, 0, 0] }").unwrap();
        assert_eq!(vol.density.values, [1.0, 0.0]);
        assert_eq!(vol.placement.point(DVec3::ONE), DVec3::new(3.0, 1.0, 3.0));
    }

    #[test]
    fn grids_that_cannot_be_are_refused_with_their_place() {
        for (keys, message) in [
            ("file = 'smoke.raw'", "does not say its size"),
            (
                "file = 'smoke.raw', size = [2, 2, 2]",
                "are 32 bytes, but there are 16 (the file is named at a.toml:5",
            ),
            ("file = 'bad.raw', size = [2, 2, 1]", "NaN in the cell (0, 1, 0)"),
            ("file = 'smoke.raw', size = [4, 1, 0]", "`size` must be from 1 to"),
            ("file = 'smoke.raw', size = [4, 1, 1], max = [1, 0, 1]", "flat"),
            ("file = 'smoke.raw', size = [4, 1, 1], max = [1, -1, 1]", "inside out"),
            ("file = 'none.raw', size = [4, 1, 1]", "there is no such file"),
            ("file = 'smoke.vol', sise = [1, 1, 1]", "did you mean 'size'"),
            (
                "file = 'smoke.vol', size = [1, 2, 1]",
                "`size` is [1, 2, 1], but 'smoke.vol' has [1, 1, 2] cells; remove `size`",
            ),
            (
                "file = 'smoke.raw', size = [2, 2, 1], albedo = { file = 'smoke.vol', channels = 3 }",
                "`channels` is 3, but the file has 1",
            ),
            (
                "file = 'smoke.raw', size = [2, 2, 1], albedo = { file = 'smoke.vol', size = [2, 2, 1] }",
                "`size` is [2, 2, 1], but 'smoke.vol' has [1, 1, 2] cells",
            ),
            ("file = 'smoke.vdb'", "OpenVDB grids can't be read"),
            ("file = 'Smoke.NVDB', size = [2, 2, 1]", "NanoVDB grids can't be read"),
            (
                "file = 'smoke.vol', albedo = { file = 'smoke.raw', size = [4, 1, 1], channels = 1 }",
                "from 0 to 1",
            ),
        ] {
            let error = grid(keys).unwrap_err().to_string();
            assert!(error.contains(message) && error.contains("a.toml:5"), "{keys}: {error}");
        }
    }

    #[test]
    fn phase_functions_and_emission_are_read() {
        let medium = load("sigma_s = 2\nphase = 'rayleigh'\nemission = [1, 2, 3]").unwrap();
        assert_eq!(medium.scattering.unwrap().phase, PhaseDescription::Rayleigh);
        assert_eq!(medium.emission, [1.0, 2.0, 3.0]);
        let double = load("sigma_s = 2\nphase = { double = [0.8, -0.2, 0.25] }").unwrap().scattering.unwrap();
        let expected = PhaseDescription::DoubleHenyeyGreenstein { g1: 0.8, g2: -0.2, weight: 0.25 };
        assert_eq!(double.phase, expected);
        let single = load("sigma_s = 2\nphase = { hg = 0.5 }").unwrap().scattering.unwrap();
        assert_eq!(single.phase, PhaseDescription::HenyeyGreenstein { g: 0.5 });
        let isotropic = load("sigma_s = 2\nphase = 'isotropic'").unwrap().scattering.unwrap();
        assert_eq!(isotropic.phase, PhaseDescription::Isotropic);
        for (keys, message) in [
            ("sigma_s = -1", "`sigma_s` must be 0 or more"),
            ("sigma_a = [1, -2, 3]", "`sigma_a` must be 0 or more"),
            ("emission = -1", "`emission` must be 0 or more"),
            ("sigma_s = 1\ng = 1", "`g` must be between -1 and 1"),
            ("sigma_s = 1\nphase = { hg = -1 }", "`hg` must be between -1 and 1"),
            ("sigma_s = 1\nphase = { double = [0.5, 1, 0] }", "`double` must be between -1 and 1"),
            ("sigma_s = 1\nphase = { double = [0.5, 0.1, 2] }", "`double` must be from 0 to 1"),
            ("sigma_s = 1\nphase = 'raleigh'", "did you mean 'rayleigh'"),
            ("sigma_s = 1\nphase = {}", "needs `hg` or `double`"),
            ("sigma_s = 1\ng = 0.5\nphase = 'rayleigh'", "exclude each other"),
        ] {
            let error = load(keys).unwrap_err().to_string();
            assert!(error.contains(message), "{keys}: {error}");
        }
        let overrides = [("media.fog.emission".to_owned(), "2".to_owned())];
        let text = "<scene version='3.0.0'><sensor type='perspective'/><medium type='homogeneous' id='fog'/>\
                    <shape type='sphere'><ref name='interior' id='fog'/></shape></scene>";
        let scene = crate::load_mitsuba_text(text, "a.xml", Path::new("."), &overrides).unwrap();
        assert_eq!(scene.media[0].emission, [2.0; 3]);
    }
}
