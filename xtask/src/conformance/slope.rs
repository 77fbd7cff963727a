//! How fast errors fall as passes grow, and whether the render knows how large they are.
//!
//! A scene is rendered to 8, 16, 32, ... passes, each going on with the film of the one before. Its error is that of the
//! trimmed relmse above what the reference itself is off by; the slope of its logarithm against that of the passes is
//! fitted by least squares. -1 is what independent noise does, -2/3 what merging with a shrinking radius does.

use super::folder::{Floor, Scene};
use super::measure::{Measured, Renderer};
use super::{Arguments, table, write};
use serde_json::{Value, json};

/// Passes of the first length.
const FIRST: u32 = 8;
/// Passes of the last, where nothing is said.
const LAST: u32 = 512;
/// Flattest slope that passes.
const FLATTEST: f64 = -0.5;
/// Errors below this share of the reference's own say nothing: they are the difference of two larger numbers.
const LEAST_OF_FLOOR: f64 = 0.1;

/// One length of a scene's render.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    passes: f64,
    /// Trimmed relmse, and relmse, above the reference's.
    trimmed: f64,
    relmse: f64,
    /// The render's own estimate of the latter.
    estimate: Option<f64>,
    seconds: f64,
}

impl Point {
    fn new(measured: &Measured, floor: Floor) -> Self {
        let figure = |key: &str| {
            measured.figures.as_ref().and_then(|figures| figures[key].as_f64()).unwrap_or(f64::NAN)
        };
        Self {
            passes: measured.spp as f64,
            trimmed: figure("relmse_trimmed") - floor.trimmed,
            relmse: figure("relmse") - floor.relmse,
            estimate: measured.estimate,
            seconds: measured.seconds,
        }
    }
}

/// Measures the slope of every scene; prints a table and writes it as `slope.md` and `slope.json`.
///
/// # Errors
/// A scene can't be rendered or measured, or, if asked for, a slope is too flat.
pub(super) fn run(renderer: &Renderer<'_>, scenes: &[Scene], arguments: &Arguments) -> Result<(), String> {
    let lengths = lengths(arguments.spp.unwrap_or(LAST));
    let mut text = format!("`hyaline render {}`\n\n", renderer.words.join(" "));
    text.push_str("| scene | passes | trimmed, above the reference's | relmse, above the reference's | estimate | estimate / relmse | seconds |\n");
    text.push_str("|---|---|---|---|---|---|---|\n");
    let (mut slopes, mut records, mut bad) = (String::new(), Vec::new(), Vec::new());
    for scene in scenes {
        eprintln!("slope: {}", scene.name);
        match renderer.series(scene, &lengths) {
            Ok(series) => {
                let points: Vec<Point> = series.iter().map(|one| Point::new(one, scene.floor)).collect();
                let found = slope(&points, scene.floor);
                points.iter().for_each(|point| text.push_str(&row(&scene.name, point)));
                slopes.push_str(&format!("| {} | {} |\n", scene.name, shown(found)));
                records.push(record(&scene.name, &points, found));
                if arguments.strict && found.is_some_and(|slope| slope > FLATTEST) {
                    bad.push(scene.name.as_str());
                }
            }
            Err(error) => {
                text.push_str(&format!("| {} | FAILED: {} | | | | | |\n", scene.name, table::cell(&error)));
                bad.push(scene.name.as_str());
            }
        }
    }
    text.push_str(&format!("\n| scene | slope |\n|---|---|\n{slopes}"));
    print!("{text}");
    write(&renderer.output.join("slope.md"), &text)?;
    write(&renderer.output.join("slope.json"), &format!("{:#}\n", Value::Array(records)))?;
    if bad.is_empty() { Ok(()) } else { Err(format!("failed: {}", bad.join(", "))) }
}

/// 8, 16, 32, ... passes, up to `last`.
fn lengths(last: u32) -> Vec<u32> {
    std::iter::successors(Some(FIRST), |passes| passes.checked_mul(2))
        .take_while(|&passes| passes <= last)
        .collect()
}

/// Slope of the logarithm of the trimmed error against that of the passes; `None` where fewer than two errors stand out
/// from the reference's own.
fn slope(points: &[Point], floor: Floor) -> Option<f64> {
    let least = (LEAST_OF_FLOOR * floor.trimmed).max(f64::MIN_POSITIVE);
    let stands_out = |point: &&Point| point.trimmed >= least;
    let logs: Vec<[f64; 2]> = points
        .iter()
        .filter(stands_out)
        .map(|point| [libm::log(point.passes), libm::log(point.trimmed)])
        .collect();
    let count = logs.len() as f64;
    let mean = |i: usize| logs.iter().map(|log| log[i]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let products = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum::<f64>();
    let squares = logs.iter().map(|log| (log[0] - x) * (log[0] - x)).sum::<f64>();
    (logs.len() >= 2).then(|| products / squares)
}

fn row(name: &str, point: &Point) -> String {
    let Point { passes, trimmed, relmse, estimate, seconds } = *point;
    let estimate = estimate.unwrap_or(f64::NAN);
    let ratio = estimate / relmse;
    format!(
        "| {name} | {passes} | {trimmed:.2e} | {relmse:.2e} | {estimate:.2e} | {ratio:.2} | {seconds:.1} |\n"
    )
}

fn shown(slope: Option<f64>) -> String {
    slope.map_or_else(|| "at the floor".to_owned(), |slope| format!("{slope:.2}"))
}

fn record(name: &str, points: &[Point], slope: Option<f64>) -> Value {
    let lengths: Vec<Value> = points
        .iter()
        .map(|point| {
            let Point { passes, trimmed, relmse, estimate, seconds } = *point;
            json!({ "passes": passes, "trimmed": trimmed, "relmse": relmse, "estimate": estimate, "seconds": seconds })
        })
        .collect();
    json!({ "scene": name, "slope": slope, "lengths": lengths })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(error: impl Fn(f64) -> f64) -> Vec<Point> {
        let point = |passes: u32| {
            let error = error(passes.into());
            Point { passes: passes.into(), trimmed: error, relmse: error, estimate: None, seconds: 1.0 }
        };
        lengths(LAST).into_iter().map(point).collect()
    }

    #[test]
    fn the_slope_of_a_power_is_its_exponent() {
        let found =
            slope(&points(|passes| 0.3 / libm::cbrt(passes * passes)), Floor::default()).expect("a slope");
        assert!((found + 2.0 / 3.0).abs() < 1e-9, "{found}");
    }

    #[test]
    fn errors_within_that_of_the_reference_do_not_count() {
        let floor = Floor { relmse: 0.0, trimmed: 0.01 };
        let found = slope(&points(|passes| if passes > 64.0 { 0.0005 } else { 0.8 / passes }), floor);
        assert!(found.is_some_and(|slope| (slope + 1.0).abs() < 1e-9), "{found:?}");
        assert_eq!(slope(&points(|_| -1.0), floor), None);
    }

    #[test]
    fn lengths_double() {
        assert_eq!(lengths(100), [8, 16, 32, 64]);
    }
}
