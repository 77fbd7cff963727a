//! Media: volumes of the file joined with indices of refraction.
//!
//! A dielectric boundary says the index on each of its sides, so its media are settled as it is read. What says no
//! index (a boundary without refraction, a lamp, a light, a camera) waits until all shapes are read and takes the one
//! that its volume has elsewhere.

use super::element::Element;
use super::importer::Importer;
use super::volume::Volume;
use crate::Result;
use hyaline_scene::{BoundaryDescription, IndexDescription, Located, MediumDescription, Source};
use std::collections::BTreeMap;

/// The media made so far.
#[derive(Debug, Default)]
pub(super) struct Media {
    volumes: Vec<Volume>,
    /// Which volume each element of the file became.
    read: BTreeMap<usize, Option<usize>>,
    made: Vec<(Option<usize>, f64, String)>,
}

/// Media that are settled once all shapes are read.
#[derive(Clone, Copy, Debug)]
pub(super) enum Later {
    /// Of a boundary that does not refract: volumes on the side that normals point away from, and to.
    Sides(Option<usize>, Option<usize>),
    /// Of a lamp: the volume that it shines into.
    Lamp(Option<usize>),
}

/// Whether an index is that of air or of vacuum.
fn is_airy(index: f64) -> bool {
    (1.0..1.001).contains(&index)
}

impl Importer<'_> {
    /// Number of a volume; those of equal content are one.
    pub(super) fn volume(&mut self, element: Element<'_>, owner: &str) -> Result<Option<usize>> {
        if let Some(known) = self.media.read.get(&element.key()) {
            return Ok(*known);
        }
        let name = element.id().map_or_else(|| format!("{owner}/medium"), str::to_owned);
        let index = self.read_volume(element, name)?.map(|volume| {
            let volumes = &mut self.media.volumes;
            volumes.iter().position(|known| known.is_like(&volume)).unwrap_or_else(|| {
                volumes.push(volume);
                volumes.len() - 1
            })
        });
        self.media.read.insert(element.key(), index);
        Ok(index)
    }

    /// Name of the medium of a side: its volume with its index. `None` is the world's: no volume, index 1.
    pub(super) fn medium(
        &mut self,
        volume: Option<usize>,
        index: f64,
        source: &Source,
    ) -> Option<Located<String>> {
        if volume.is_none() && index == 1.0 {
            return None;
        }
        let made = self.media.made.iter().find(|(v, i, _)| (*v, *i) == (volume, index));
        if let Some((_, _, name)) = made {
            return Some(Located::new(name.clone(), source.clone()));
        }
        let volume_described = volume.map(|volume| &self.media.volumes[volume]);
        let base = volume_described.map_or_else(|| format!("index {index}"), |volume| volume.name.clone());
        let is_taken = |name: &str| self.scene.media.iter().any(|medium| medium.name == name);
        let mut name = if is_taken(&base) { format!("{base} @ {index}") } else { base };
        while is_taken(&name) {
            name.push('\'');
        }
        let clear = MediumDescription::clear(name.clone(), IndexDescription::Constant(index));
        let medium = match volume_described {
            Some(volume) => volume.with_index_of(clear),
            None => clear,
        };
        self.scene.media.push(Located::new(medium, source.clone()));
        self.media.made.push((volume, index, name.clone()));
        Some(Located::new(name, source.clone()))
    }

    /// The medium of a volume that was named without an index: the only index it was used with, else 1.
    pub(super) fn medium_of_volume(
        &mut self,
        volume: Option<usize>,
        source: &Source,
    ) -> Option<Located<String>> {
        let index = volume.and_then(|volume| self.only_index(volume)).unwrap_or(1.0);
        self.medium(volume, index, source)
    }

    /// The index that a volume was used with, where it is but one.
    fn only_index(&self, volume: usize) -> Option<f64> {
        let mut indices =
            self.media.made.iter().filter(|(v, _, _)| *v == Some(volume)).map(|(_, index, _)| *index);
        match (indices.next(), indices.next()) {
            (Some(only), None) => Some(only),
            _ => None,
        }
    }

    /// The world is filled with air where boundaries say so and none says vacuum: 1.000277 is Mitsuba's default.
    pub(super) fn settle_surrounding(&mut self, source: &Source) {
        let mut airs: Vec<f64> = self.media.made.iter().map(|(_, index, _)| *index).collect();
        airs.retain(|index| is_airy(*index) && *index != 1.0);
        airs.sort_by(f64::total_cmp);
        airs.dedup();
        if let ([air], false) = (airs.as_slice(), self.world_is_vacuum) {
            self.scene.surrounding = self.medium(None, *air, source);
            self.world_index = *air;
        }
    }

    /// Settles what waited for all shapes: where no index is said, both sides of a boundary have the same.
    pub(super) fn settle_media(&mut self) {
        for (object, later) in std::mem::take(&mut self.later) {
            let source = self.scene.objects[object].source.clone();
            match later {
                Later::Sides(inside, outside) => {
                    let index = self.common_index(inside, outside);
                    let mut side = |volume: Option<usize>| match volume {
                        None => None,
                        volume => self.medium(volume, index, &source),
                    };
                    let (inside, outside) = (side(inside), side(outside));
                    self.scene.objects[object].boundary = BoundaryDescription::Interface { outside, inside };
                }
                Later::Lamp(volume) => {
                    let medium = self.medium_of_volume(volume, &source);
                    if let Some(emission) = &mut self.scene.objects[object].emission {
                        emission.medium = medium;
                    }
                }
            }
        }
    }

    /// The index on both sides of a boundary that does not refract.
    fn common_index(&self, inside: Option<usize>, outside: Option<usize>) -> f64 {
        match (inside, outside) {
            (Some(inside), Some(outside)) => {
                let known = self.only_index(outside).or_else(|| self.only_index(inside));
                known.unwrap_or(self.world_index)
            }
            // A side without a volume is the world's.
            _ => self.world_index,
        }
    }
}
