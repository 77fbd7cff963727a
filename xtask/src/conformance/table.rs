//! The results as Markdown and as JSON.

use super::scene::Measured;
use serde_json::json;

/// One row per scene.
pub(crate) fn markdown(words: &[String], results: &[(String, Result<Measured, String>)]) -> String {
    let mut text = format!("`hyaline render {}`\n\n", words.join(" "));
    text.push_str(
        "| scene | spp | relmse | trimmed | mean ratio | tile test | FLIP | seconds | warnings |\n",
    );
    text.push_str("|---|---|---|---|---|---|---|---|---|\n");
    for (name, result) in results {
        match result {
            Ok(measured) => text.push_str(&row(name, measured)),
            Err(error) => text.push_str(&format!("| {name} | | | | | | | | failed: {} |\n", cell(error))),
        }
    }
    text
}

fn row(name: &str, measured: &Measured) -> String {
    let figure = |key: &str| measured.figures[key].as_f64().unwrap_or(f64::NAN);
    let tiles = &measured.tiles;
    let verdict = match (tiles.passes, tiles.is_long_enough()) {
        (true, true) => "passes",
        (true, false) => "passes, but too short",
        (false, _) => "FAILS",
    };
    let warnings: Vec<String> = measured.warnings.iter().map(|warning| cell(warning)).collect();
    format!(
        "| {name} | {} | {:.3e} | {:.3e} | {:.4} | {verdict}: {} of {} tiles, worst p {:.1e} of {:.1e}, error of the mean {:.2} % | {:.4} | {:.1} | {} |\n",
        measured.spp,
        figure("relmse"),
        figure("relmse_trimmed"),
        figure("mean_ratio"),
        tiles.failing,
        tiles.count,
        tiles.worst_p,
        tiles.threshold,
        100.0 * tiles.mean_error,
        figure("flip"),
        measured.seconds,
        warnings.join("; "),
    )
}

/// Text that does not break a table.
fn cell(text: &str) -> String {
    text.replace('|', "/").replace('\n', " ")
}

/// All figures, for programs.
pub(crate) fn json(words: &[String], results: &[(String, Result<Measured, String>)]) -> String {
    let scenes: Vec<serde_json::Value> = results
        .iter()
        .map(|(name, result)| match result {
            Ok(measured) => json!({
                "scene": name,
                "spp": measured.spp,
                "figures": measured.figures,
                "tile_test": {
                    "passes": measured.tiles.passes,
                    "tiles": measured.tiles.count,
                    "failing": measured.tiles.failing,
                    "worst_p": measured.tiles.worst_p,
                    "threshold": measured.tiles.threshold,
                    "failures": measured.tiles.failures,
                    "mean_error": measured.tiles.mean_error,
                },
                "seconds": measured.seconds,
                "warnings": measured.warnings,
            }),
            Err(error) => json!({ "scene": name, "error": error }),
        })
        .collect();
    let text = json!({ "arguments": words, "scenes": scenes });
    format!("{text:#}\n")
}
