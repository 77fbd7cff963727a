//! A color that may vary over space: a value, a constant volume, or a grid from a file.

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{GridData, Rgb};
use std::sync::Arc;

/// Volumes that only wrap another, at most.
const MAX_WRAPPERS: usize = 4;

/// A field in space.
#[derive(Clone, Debug)]
pub(super) enum Field {
    /// The same everywhere.
    Constant(Rgb),
    /// By a grid.
    Grid {
        /// The values.
        data: Arc<GridData>,
        /// The unit cube to world.
        placement: Transform,
    },
}

/// Mean color of a grid.
pub(super) fn mean(data: &GridData) -> Rgb {
    let channels = data.channels as usize;
    let mut sums = [0.0f64; 3];
    for cell in data.values.chunks_exact(channels) {
        sums = std::array::from_fn(|i| sums[i] + f64::from(cell[i.min(channels - 1)]));
    }
    let cells = (data.values.len() / channels).max(1) as f64;
    sums.map(|sum| (sum / cells) as f32)
}

impl Importer<'_> {
    /// The field that a medium has under `name`; `None` where it has none, or, with a warning, one that can't be read.
    pub(super) fn field(&mut self, medium: Element<'_>, name: &str, limits: Limits) -> Result<Option<Field>> {
        if let Some(color) = medium.color(name, limits)? {
            return Ok(Some(Field::Constant(color)));
        }
        let Some(mut volume) = medium.child_named("texture", name)? else { return Ok(None) };
        for _ in 0..MAX_WRAPPERS {
            match volume.kind() {
                "constvolume" => {
                    let color = volume.color("value", limits)?;
                    return Ok(Some(Field::Constant(color.unwrap_or([1.0; 3]))));
                }
                "gridvolume" | "grid" => return self.grid_volume(volume, name, limits).map(Some),
                "volcache" => {}
                _ => break,
            }
            volume.ignore_all();
            let Some(inner) = volume.child("texture")? else { break };
            volume = inner;
        }
        volume.ignore_all();
        volume.warn(format!("`{name}` as {} can't be read; its default counts", volume.title()));
        Ok(None)
    }

    fn grid_volume(&mut self, volume: Element<'_>, name: &str, limits: Limits) -> Result<Field> {
        let Some(file) = volume.string("filename")? else {
            return Err(volume.error(format!("{} needs `filename`", volume.title())));
        };
        volume.ignore(&["raw", "accel", "send_data", "max_value"]);
        for (key, usual) in [("filter_type", "trilinear"), ("wrap_mode", "clamp")] {
            if let Some(other) = volume.string(key)?.filter(|value| value.as_str() != usual) {
                let message = format!("`{key}` '{}' of a grid is replaced by '{usual}'", other.value);
                volume.notes.warn(&other.source, message);
            }
        }
        let grid = self.assets.grid(&file.source, &file)?;
        if let Some(bad) = grid.data.values.iter().find(|value| !limits.contain(f64::from(**value))) {
            let message = format!("`{name}` must be {}, but the grid has {bad}", limits.words());
            return Err(volume.error(message));
        }
        let placement = self.grid_placement(volume, grid.bounds, grid.data.size)?;
        Ok(Field::Grid { data: grid.data.clone(), placement })
    }

    /// The unit cube to world: by `to_world` alone, or the box of the file before it.
    fn grid_placement(&self, volume: Element<'_>, bounds: [DVec3; 2], size: [u32; 3]) -> Result<Transform> {
        let to_world = volume.transform("to_world")?;
        let given = (volume.point("min")?, volume.point("max")?);
        let [min, max] = match given {
            (Some(min), Some(max)) => [min, max],
            _ if self.is_old || volume.boolean("use_grid_bbox", false)? => bounds,
            _ => [DVec3::ZERO, DVec3::ONE],
        };
        let flat = || volume.error("the box of the grid is flat or not finite");
        let extent = Transform::scale(max - min).filter(|_| min.is_finite()).ok_or_else(flat)?;
        let in_box = Transform::translate(min).after(&extent);
        let cells = if self.is_old { between_outermost_points(size) } else { Transform::IDENTITY };
        Ok(to_world.after(&in_box).after(&cells))
    }
}

/// Versions 0.5 and 0.6 have the outermost points of a grid on the sides of its box, we half a cell within.
fn between_outermost_points(size: [u32; 3]) -> Transform {
    let points = DVec3::from_array(size.map(|count| f64::from(count.max(2))));
    let factor = points / (points - 1.0);
    let grown = Transform::scale(factor).unwrap_or_default();
    Transform::translate(-0.5 / (points - 1.0)).after(&grown)
}
