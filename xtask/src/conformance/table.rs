//! The results as Markdown and as JSON.

use super::measure::Measured;
use serde_json::{Value, json};

/// Name of a scene and what was measured of it, or why nothing could be.
pub(crate) type Row = (String, Result<Measured, String>);

/// One row per scene.
pub(crate) fn markdown(words: &str, rows: &[Row]) -> String {
    let mut text = format!("`hyaline render {words}`\n\n");
    text.push_str(
        "| scene | spp | relmse | trimmed | mean ratio | tile test | FLIP | seconds | warnings |\n",
    );
    text.push_str("|---|---|---|---|---|---|---|---|---|\n");
    for (name, result) in rows {
        match result {
            Ok(measured) => text.push_str(&row(name, measured)),
            Err(error) => text.push_str(&format!("| {name} | | | | | | | | FAILED: {} |\n", cell(error))),
        }
    }
    text
}

fn row(name: &str, measured: &Measured) -> String {
    let figure = |key: &str| measured.figures.as_ref().and_then(|figures| figures[key].as_f64());
    let shown = |value: Option<f64>, form: fn(f64) -> String| value.map_or_else(String::new, form);
    let scientific = |value: f64| format!("{value:.3e}");
    let plain = |value: f64| format!("{value:.4}");
    let warnings: Vec<String> = measured.warnings.iter().map(|warning| cell(warning)).collect();
    let mean = format!("(mean {:.4})", measured.noise.mean);
    let ratio = figure("mean_ratio").map_or(mean, |ratio| format!("{ratio:.4}"));
    format!(
        "| {name} | {} | {} | {} | {ratio} | {} | {} | {:.1} | {} |\n",
        measured.spp,
        shown(figure("relmse"), scientific),
        shown(figure("relmse_trimmed"), scientific),
        verdict(measured),
        shown(figure("flip"), plain),
        measured.seconds,
        warnings.join("; "),
    )
}

/// What the tile test says, and whether the render was long enough for it.
fn verdict(measured: &Measured) -> String {
    let noise = &measured.noise;
    let length = if noise.is_settled() {
        format!("error of the mean {:.2} %", 100.0 * noise.relative_error)
    } else if noise.relative_error.is_finite() {
        let wanted = noise.wanted_length(measured.spp);
        format!("too short: error of the mean {:.2} %, wants {wanted:.0} spp", 100.0 * noise.relative_error)
    } else {
        "too short: one pass".to_owned()
    };
    match (&measured.tiles, &measured.figures) {
        (Some(tiles), _) => format!(
            "{}: {} of {} tiles differ, worst p {:.1e} of {:.1e}, finds {:.1} %, {length}",
            if tiles.passes { "passes" } else { "FAILS" },
            tiles.failing,
            tiles.count,
            tiles.worst_p,
            tiles.threshold,
            100.0 * tiles.resolution,
        ),
        (None, Some(_)) => format!("no variance of the reference, {length}"),
        (None, None) => format!("no reference, {length}"),
    }
}

/// Text that does not break a table.
pub(crate) fn cell(text: &str) -> String {
    text.replace('|', "/").replace('\n', " ")
}

/// All figures, for programs.
pub(crate) fn json(words: &str, rows: &[Row]) -> String {
    let scenes: Vec<Value> = rows
        .iter()
        .map(|(name, result)| match result {
            Ok(measured) => scene(name, measured),
            Err(error) => json!({ "scene": name, "error": error }),
        })
        .collect();
    let text = json!({ "arguments": words, "scenes": scenes });
    format!("{text:#}\n")
}

fn scene(name: &str, measured: &Measured) -> Value {
    let tile_test = measured.tiles.as_ref().map(|tiles| {
        json!({
            "passes": tiles.passes,
            "tiles": tiles.count,
            "failing": tiles.failing,
            "failing_by_own_variance": tiles.failing_by_own_variance,
            "resolution": tiles.resolution,
            "worst_p": tiles.worst_p,
            "threshold": tiles.threshold,
            "failures": tiles.failures,
        })
    });
    json!({
        "scene": name,
        "spp": measured.spp,
        "figures": measured.figures,
        "tile_test": tile_test,
        "mean": measured.noise.mean,
        "mean_error": measured.noise.relative_error,
        "is_settled": measured.noise.is_settled(),
        "seconds": measured.seconds,
        "warnings": measured.warnings,
    })
}

#[cfg(test)]
mod tests {
    use super::super::tiles::{Noise, Tiles};
    use super::*;

    fn measured(relative_error: f64) -> Measured {
        Measured {
            spp: 64,
            seconds: 1.25,
            warnings: vec!["a | b".into()],
            estimate: None,
            noise: Noise { mean: 0.5, relative_error },
            figures: None,
            tiles: None,
        }
    }

    #[test]
    fn every_row_has_nine_cells_whatever_is_missing() {
        let figures = json!({ "relmse": 1e-3, "relmse_trimmed": 5e-4, "mean_ratio": 1.001, "flip": 0.02 });
        let tiles = Tiles {
            passes: false,
            count: 256,
            failing: 2,
            failing_by_own_variance: 9,
            resolution: 0.02,
            worst_p: 1e-9,
            threshold: 1e-5,
            failures: Vec::new(),
        };
        let rows: Vec<Row> = vec![
            ("bare".into(), Ok(measured(0.006))),
            ("compared".into(), Ok(Measured { figures: Some(figures.clone()), ..measured(0.002) })),
            ("tested".into(), Ok(Measured { figures: Some(figures), tiles: Some(tiles), ..measured(0.002) })),
            ("broken".into(), Err("no | way\nout".into())),
        ];
        let text = markdown("--spp 64", &rows);
        let lines: Vec<&str> = text.lines().skip(2).collect();
        assert!(lines.iter().all(|line| line.matches('|').count() == 10), "{text}");
        assert!(text.contains("no reference, too short: error of the mean 0.60 %, wants 256 spp"), "{text}");
        assert!(text.contains("no variance of the reference, error of the mean 0.20 %"), "{text}");
        assert!(text.contains("FAILS: 2 of 256 tiles") && text.contains("FAILED: no / way out"), "{text}");
        let parsed: Value = serde_json::from_str(&json("--spp 64", &rows)).unwrap();
        assert_eq!(parsed["scenes"][2]["tile_test"]["failing"], 2);
        assert_eq!(parsed["scenes"][3]["error"], "no | way\nout");
    }
}
