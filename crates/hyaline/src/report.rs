//! What a render says of itself when it is done: one line of JSON, or two for people.

use hyaline_transport::photon::maps::{MapStatistics, PhotonStatistics};
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
    /// Estimated relmse of the picture; absent for fewer than two passes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<f64>,
    /// What the photon stage did; absent for integrators without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) photon_maps: Option<PhotonMapsReport>,
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

/// The photon maps of a render.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct PhotonMapsReport {
    /// Light over specular surfaces alone.
    pub(crate) caustic: MapReport,
    /// The map of the rest, or of all light.
    pub(crate) global: MapReport,
    /// Light that media scatter; absent where none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) volume: Option<MapReport>,
}

/// One photon map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct MapReport {
    /// Photons emitted for it.
    pub(crate) emitted: u64,
    /// Photons kept.
    pub(crate) stored: u64,
    /// Memory that it takes.
    pub(crate) bytes: u64,
    /// Seconds that tracing took.
    pub(crate) tracing: f64,
    /// Seconds that building the tree took.
    pub(crate) building: f64,
    /// Estimates made from it by this run.
    pub(crate) look_ups: u64,
    /// Seconds that they took, all threads together, judged by one in 64.
    pub(crate) looking_up: f64,
}

impl From<PhotonStatistics> for PhotonMapsReport {
    fn from(statistics: PhotonStatistics) -> Self {
        let map = |map: MapStatistics| MapReport {
            emitted: map.emitted,
            stored: map.stored,
            bytes: map.bytes,
            tracing: map.tracing.as_secs_f64(),
            building: map.building.as_secs_f64(),
            look_ups: map.look_ups,
            looking_up: map.looking_up.as_secs_f64(),
        };
        let volume = (statistics.volume.emitted > 0).then(|| map(statistics.volume));
        Self { caustic: map(statistics.caustic), global: map(statistics.global), volume }
    }
}

impl PhotonMapsReport {
    /// One line for people.
    fn to_text(self) -> String {
        let map = |name: &str, map: MapReport| {
            let MapReport { emitted, stored, bytes, tracing, building, look_ups, looking_up } = map;
            format!(
                "{name} {stored} of {emitted} ({:.1} MB, traced {tracing:.1} s, built {building:.1} s, looked up {:.1} M times in {looking_up:.1} s)",
                bytes as f64 / 1e6,
                look_ups as f64 / 1e6
            )
        };
        let volume = self.volume.map_or_else(String::new, |volume| format!(", {}", map("volume", volume)));
        format!("photons kept: {}, {}{volume}", map("caustic", self.caustic), map("global", self.global))
    }
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
        if let Some(error) = self.error {
            text.push_str(&format!(", estimated relmse {error:.1e}"));
        }
        if self.branches_cut > 0 {
            text.push_str(&format!(", {} branches cut", self.branches_cut));
        }
        if let Some(maps) = self.photon_maps {
            text.push_str(&format!("\n{}", maps.to_text()));
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
            error: Some(2e-3),
            photon_maps: None,
            branches_cut: 3,
            peak_memory_bytes: Some(1024),
            warnings: vec!["two\nlines".into()],
        };
        let json = report.to_json();
        assert!(!json.contains('\n'));
        let value: serde_json::Value = serde_json::from_str(&json).unwrap();
        for key in [
            "passes",
            "spp",
            "seconds",
            "rays",
            "photons",
            "error",
            "peak_memory_bytes",
            "warnings",
            "branches_cut",
        ] {
            assert!(value.get(key).is_some(), "{key}");
        }
        assert_eq!(value["seconds"]["render"], 1.5);
        assert!(report.to_text().contains("estimated relmse 2.0e-3"), "{}", report.to_text());
    }

    #[test]
    fn each_map_has_its_figures() {
        let map = MapStatistics { emitted: 100, stored: 60, bytes: 1200, ..MapStatistics::default() };
        let maps = PhotonMapsReport::from(PhotonStatistics { caustic: map, ..PhotonStatistics::default() });
        let value = serde_json::to_value(maps).unwrap();
        for key in ["emitted", "stored", "bytes", "tracing", "building", "look_ups", "looking_up"] {
            assert!(value["caustic"][key].is_number() && value["global"][key].is_number(), "{key}");
        }
        assert_eq!(value["caustic"]["stored"], 60);
        assert!(maps.to_text().contains("caustic 60 of 100"), "{}", maps.to_text());
    }
}
