//! What a render says of itself when it is done: one line of JSON, or two for people.

use serde::Serialize;

/// The figures of a render.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    /// Passes in the film, earlier runs' among them.
    pub(crate) passes: u64,
    /// Samples per pixel in the film.
    pub(crate) spp: u64,
    /// Where the time went.
    pub(crate) seconds: Seconds,
    /// Rays traced by this run.
    pub(crate) rays: u64,
    /// Photons emitted by this run.
    pub(crate) photons: u64,
    /// Branches that `whitted` cut in this run.
    pub(crate) branches_cut: u64,
    /// Most memory held; absent where the system does not tell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) peak_memory_bytes: Option<u64>,
    /// Everything that was warned of.
    pub(crate) warnings: Vec<String>,
}

/// Wall-clock seconds of the stages.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Seconds {
    /// Reading files.
    pub(crate) load: f64,
    /// Compiling the world, hierarchies among it.
    pub(crate) build: f64,
    /// What the integrator learns before the first pass.
    pub(crate) prepare: f64,
    /// Passes and checkpoints.
    pub(crate) render: f64,
}

impl Report {
    /// The report on one line.
    pub(crate) fn to_json(&self) -> String {
        // Numbers and strings alone: nothing that could fail to be written.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The report for people.
    pub(crate) fn to_text(&self) -> String {
        let Seconds { load, build, prepare, render } = self.seconds;
        let rate = self.rays as f64 / (prepare + render).max(1e-9) / 1e6;
        let mut text = format!(
            "{} passes in {:.1} s (read {load:.1}, build {build:.1}, prepare {prepare:.1}, render {render:.1}), {rate:.1} Mray/s",
            self.passes,
            load + build + prepare + render,
        );
        if self.branches_cut > 0 {
            text.push_str(&format!(", {} branches cut", self.branches_cut));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_report_is_one_line_with_the_agreed_keys() {
        let report = Report {
            passes: 16,
            spp: 16,
            seconds: Seconds { load: 0.1, build: 0.2, prepare: 0.0, render: 1.5 },
            rays: 100,
            photons: 0,
            branches_cut: 3,
            peak_memory_bytes: Some(1024),
            warnings: vec!["two\nlines".into()],
        };
        let json = report.to_json();
        assert!(!json.contains('\n'));
        let value: serde_json::Value = serde_json::from_str(&json).unwrap();
        for key in
            ["passes", "spp", "seconds", "rays", "photons", "peak_memory_bytes", "warnings", "branches_cut"]
        {
            assert!(value.get(key).is_some(), "{key}");
        }
        assert_eq!(value["seconds"]["render"], 1.5);
    }
}
