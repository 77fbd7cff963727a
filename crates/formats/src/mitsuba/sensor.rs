//! `<sensor>` with its film, pixel filter and sampler.

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::limits::Limits;
use crate::own::{MAX_PIXELS, MAX_SIDE, TENT_RADIUS};
use hyaline_math::{Transform, float};
use hyaline_scene::{
    CameraDescription, FileIntegrator, FilmDescription, FovAxis, Located, PixelFilter, Projection, SceneError,
};

/// Mitsuba's film size.
const DEFAULT_SIZE: (i64, i64) = (768, 576);
/// Mitsuba's bell: standard deviation and cut-off at four of them, pixels.
const GAUSSIAN_SIGMA: f64 = 0.5;

impl Importer<'_> {
    /// Reads a sensor; the film of the first is that of the scene.
    pub(super) fn sensor(&mut self, sensor: Element<'_>, index: usize) -> Result<()> {
        note_without_effect(sensor)?;
        let film = match sensor.child("film")? {
            Some(film) => read_film(film)?,
            None => FilmDescription { width: 768, height: 576, ..FilmDescription::default() },
        };
        if index == 0 {
            self.scene.film = film;
        } else if self.scene.film != film {
            sensor.warn("the films of the sensors differ; the first one's counts for all");
        }
        if let Some(sampler) = sensor.child("sampler")? {
            let spp = sampler.integer("sample_count")?.and_then(|count| u32::try_from(count).ok());
            sampler.ignore_all();
            let name = String::from("none");
            self.scene.settings.file_integrator.get_or_insert(FileIntegrator { name, max_depth: None, spp });
        }
        let to_world = sensor.transform("to_world")?;
        let aspect = f64::from(self.scene.film.width) / f64::from(self.scene.film.height);
        let projection = read_projection(sensor, &to_world, aspect)?;
        let placement = camera_placement(sensor, &to_world)?;
        let medium = match sensor.child("medium")? {
            Some(medium) => {
                let volume = self.volume(medium, "camera")?;
                self.medium_of_volume(volume, sensor.source())
            }
            None => None,
        };
        let name = match sensor.id() {
            Some(id) => id.to_owned(),
            None if index == 0 => "camera".to_owned(),
            None => format!("camera-{}", index + 1),
        };
        let camera = CameraDescription { name, placement, projection, medium };
        self.scene.cameras.push(Located::new(camera, sensor.source().clone()));
        Ok(())
    }
}

/// What changes nothing here: everything stands still, and nothing is cut off near or far.
fn note_without_effect(sensor: Element<'_>) -> Result<()> {
    sensor.ignore(&["shutter_open", "shutter_close"]);
    for (name, usual) in [("near_clip", 1e-2), ("far_clip", 1e4)] {
        if sensor.float(name, usual, Limits::ANY)? != usual {
            sensor.info(format!("`{name}` of {} has no effect: nothing is cut off", sensor.title()));
        }
    }
    for name in ["principal_point_offset_x", "principal_point_offset_y"] {
        if sensor.float(name, 0.0, Limits::ANY)? != 0.0 {
            sensor.warn(format!("`{name}` of {} is not supported and ignored", sensor.title()));
        }
    }
    Ok(())
}

/// Our cameras look along -z with x to the right, Mitsuba's along +z with x to the left: half a turn about y.
pub(super) fn camera_placement(sensor: Element<'_>, to_world: &Transform) -> Result<Transform> {
    use hyaline_math::DVec3;
    if to_world.is_mirroring() {
        let message = "mirrors the picture, which is not supported: it is shown unmirrored";
        sensor.warn(format!("`to_world` of {} {message}", sensor.title()));
    }
    let eye = to_world.translation();
    let forward = to_world.vector(DVec3::Z).normalize_or_zero();
    Transform::look_at(eye, eye + forward, to_world.vector(DVec3::Y))
        .ok_or_else(|| sensor.error("the sensor's transform leaves no direction of view"))
}

fn read_projection(sensor: Element<'_>, to_world: &Transform, aspect: f64) -> Result<Projection> {
    use hyaline_math::DVec3;
    match sensor.kind() {
        "perspective" => {
            let (fov, fov_axis) = field_of_view(sensor)?;
            Ok(Projection::Perspective { fov, fov_axis })
        }
        "thinlens" => {
            let (fov, fov_axis) = field_of_view(sensor)?;
            let lens_radius = sensor.float("aperture_radius", 0.1, Limits::NOT_NEGATIVE)?;
            let focus_distance = sensor.float("focus_distance", 1.0, Limits::POSITIVE)?;
            Ok(Projection::ThinLens { fov, fov_axis, lens_radius, focus_distance })
        }
        // Panoramic in versions 0.5 and 0.6: all directions, the middle of the picture along +z.
        "spherical" => {
            Ok(Projection::Spherical { longitude: std::f64::consts::TAU, latitude: std::f64::consts::PI })
        }
        // The film's width spans -1 to 1 of the sensor's space.
        "orthographic" => {
            Ok(Projection::Orthographic { height: 2.0 * to_world.vector(DVec3::X).length() / aspect })
        }
        _ => {
            sensor.warn(format!("{} is replaced by a perspective one", sensor.title()));
            let (fov, fov_axis) = field_of_view(sensor)?;
            Ok(Projection::Perspective { fov, fov_axis })
        }
    }
}

/// `fov` along `fov_axis` (x), or `focal_length` of a 35 mm film, whose diagonal counts.
pub(super) fn field_of_view(sensor: Element<'_>) -> Result<(f64, FovAxis)> {
    let axis = match sensor.string("fov_axis")? {
        None => FovAxis::X,
        Some(axis) => match axis.as_str() {
            "x" => FovAxis::X,
            "y" => FovAxis::Y,
            "diagonal" | "diag" => FovAxis::Diagonal,
            "smaller" => FovAxis::Smaller,
            "larger" => FovAxis::Larger,
            other => {
                let error = SceneError::at(&axis.source, format!("unknown fov_axis '{other}'"));
                return Err(error.with_remedy("the axes are x, y, diagonal, smaller and larger"));
            }
        },
    };
    if sensor.property("fov").is_some() {
        return Ok((sensor.float("fov", 0.0, Limits::inside(0.0, 180.0))?.to_radians(), axis));
    }
    let millimetres = match sensor.property("focal_length") {
        None => 50.0,
        Some(property) => {
            let length = property.parse(property.value()?.trim().trim_end_matches("mm"))?;
            if length <= 0.0 {
                return Err(property.error("`focal_length` must be above 0"));
            }
            length
        }
    };
    let half_diagonal = 0.5 * (36f64 * 36.0 + 24.0 * 24.0).sqrt();
    Ok((2.0 * float::f64::atan2(half_diagonal, millimetres), FovAxis::Diagonal))
}

/// The angle across the width of a picture.
///
/// - `fov`: the angle across its `axis`, radians.
/// - `aspect`: width over height.
pub(super) fn across_width(fov: f64, axis: FovAxis, aspect: f64) -> f64 {
    let factor = match axis {
        FovAxis::X => 1.0,
        FovAxis::Y => aspect,
        FovAxis::Diagonal => aspect / (1.0 + aspect * aspect).sqrt(),
        FovAxis::Smaller => aspect.max(1.0),
        FovAxis::Larger => aspect.min(1.0),
    };
    let (sin, cos) = float::f64::sin_cos(0.5 * fov);
    2.0 * float::f64::atan2(sin * factor, cos)
}

fn read_film(film: Element<'_>) -> Result<FilmDescription> {
    // What concerns the file that Mitsuba would write.
    film.ignore(&[
        "pixel_format",
        "component_format",
        "file_format",
        "filename",
        "gamma",
        "banner",
        "attach_log",
        "compensate",
        "sample_border",
        "high_quality_edges",
        "tonemap_method",
        "exposure",
        "fill_gaps",
        "variable",
        "label",
        "key",
        "burn",
    ]);
    let whole = |name: &str, default: i64, low: i64, high: i64| -> Result<u32> {
        let number = film.integer(name)?.unwrap_or(default);
        if (low..=high).contains(&number) {
            return Ok(number as u32);
        }
        Err(film.error(format!("the film's `{name}` must be from {low} to {high}, not {number}")))
    };
    let width = whole("width", DEFAULT_SIZE.0, 1, i64::from(MAX_SIDE))?;
    let height = whole("height", DEFAULT_SIZE.1, 1, i64::from(MAX_SIDE))?;
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(film.error(format!("a film of {width} x {height} pixels is too large")));
    }
    let x0 = whole("crop_offset_x", 0, 0, i64::from(width) - 1)?;
    let y0 = whole("crop_offset_y", 0, 0, i64::from(height) - 1)?;
    let (most_x, most_y) = (width - x0, height - y0);
    let w = whole("crop_width", i64::from(most_x), 1, i64::from(most_x))?;
    let h = whole("crop_height", i64::from(most_y), 1, i64::from(most_y))?;
    let crop = [x0, y0, x0 + w, y0 + h];
    let crop = (crop != [0, 0, width, height]).then_some(crop);
    let filter = match film.child("rfilter")? {
        Some(filter) => read_filter(filter)?,
        None => gaussian(GAUSSIAN_SIGMA),
    };
    Ok(FilmDescription { width, height, crop, filter, exposure: 1.0 })
}

fn read_filter(filter: Element<'_>) -> Result<PixelFilter> {
    let pixels = Limits::above_to(0.0, 16.0);
    Ok(match filter.kind() {
        "box" => {
            if filter.float("radius", 0.5, pixels)? != 0.5 {
                filter.warn("a box filter of another size than the pixel is replaced by the pixel's");
            }
            PixelFilter::Box
        }
        "tent" => PixelFilter::Tent(filter.float("radius", f64::from(TENT_RADIUS), pixels)? as f32),
        "gaussian" => gaussian(filter.float("stddev", GAUSSIAN_SIGMA, Limits::above_to(0.0, 4.0))?),
        other => {
            filter.ignore_all();
            filter.warn(format!("the pixel filter '{other}' has negative parts; a gaussian one replaces it"));
            gaussian(GAUSSIAN_SIGMA)
        }
    })
}

fn gaussian(sigma: f64) -> PixelFilter {
    PixelFilter::Gaussian { sigma: sigma as f32, radius: 4.0 * sigma as f32 }
}
