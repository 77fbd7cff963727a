//! What each light is in: where its photons start.
//!
//! A lamp is looked at from some places just off its surface, on both sides if both shine; a light without a surface
//! from where it is; what comes from infinity starts in the medium of the world.

use super::{Library, locate};
use crate::World;
use crate::light::{Light, LightMedia};
use hyaline_math::{Vec2, Vec3, offset_origin};
use hyaline_scattering::{MediumId, MediumSet};
use hyaline_scene::{LightKind, Note, SceneError, Source};

/// Places of a lamp's surface that are looked at.
const PLACE_COUNT: u32 = 7;

/// Locates all lights, in the order of `world.lights`.
///
/// # Errors
/// A light declares a medium that is not there.
pub(super) fn compile_all(
    library: &Library,
    world: &World,
    notes: &mut Vec<Note>,
) -> Result<Vec<LightMedia>, SceneError> {
    let mut media = lamps(library, world, notes)?;
    let surrounding = library.surrounding()?;
    for light in &library.description.lights {
        let place = match &light.kind {
            LightKind::Ambient { .. } => continue,
            LightKind::Directional { .. } | LightKind::Environment { .. } => None,
            LightKind::Point { position, .. } | LightKind::Spot { position, .. } => Some(*position),
            LightKind::Projector { placement, .. } => Some(placement.translation()),
        };
        let set = match place {
            None => MediumSet::new(surrounding),
            Some(place) => {
                let declared = library.medium_or(&light.medium, surrounding)?;
                let name = format!("light '{}'", light.name);
                locate::locate(world, &[place.as_vec3()], None, declared, &name, &light.source, notes)
            }
        };
        media.push(LightMedia { outer: set.clone(), inner: set });
    }
    Ok(media)
}

/// Locates the lights with a surface, which come first.
fn lamps(library: &Library, world: &World, notes: &mut Vec<Note>) -> Result<Vec<LightMedia>, SceneError> {
    let surrounding = library.surrounding()?;
    let items = (0..).zip(&world.items);
    let lamps = items.filter_map(|(id, info)| Some((id, info.light? as usize, info)));
    let mut media = Vec::new();
    for (item, index, info) in lamps {
        debug_assert_eq!(index, media.len(), "items are added in the order of their lights");
        // A part of a compound bears the name of the whole.
        let name = &world.object_names[info.object.0 as usize];
        let object = &library.description.objects[library.objects.find(&name.as_str().into())?];
        let emission = object.emission.as_ref();
        let declared = emission.map_or(Ok(surrounding), |e| library.medium_or(&e.medium, surrounding))?;
        let mut look =
            Look { world, item, declared, name: format!("light '{name}'"), source: &object.source, notes };
        media.push(look.both_sides(world.lights.get(index)));
    }
    Ok(media)
}

/// What it takes to locate a lamp.
struct Look<'a> {
    world: &'a World,
    item: u32,
    declared: MediumId,
    name: String,
    source: &'a Source,
    notes: &'a mut Vec<Note>,
}

impl Look<'_> {
    fn both_sides(&mut self, light: &Light) -> LightMedia {
        let outer = self.locate(&places(light, 1.0));
        let inner = if light.is_two_sided() { self.locate(&places(light, -1.0)) } else { outer.clone() };
        LightMedia { outer, inner }
    }

    fn locate(&mut self, places: &[Vec3]) -> MediumSet {
        locate::locate(
            self.world,
            places,
            Some(self.item),
            self.declared,
            &self.name,
            self.source,
            self.notes,
        )
    }
}

/// Places spread over a lamp's surface, just off it on its outer (`side` 1) or inner (-1) side.
fn places(light: &Light, side: f32) -> Vec<Vec3> {
    // Points of the lattice of the plastic number. Source: Roberts, The unreasonable effectiveness of quasirandom
    // sequences, 2018.
    let lattice = |i: u32| (Vec2::new(0.754_877_7, 0.569_840_3) * (i as f32 + 0.5)).fract();
    let samples = (0..PLACE_COUNT).filter_map(|i| light.sample_emission(lattice(i), Vec2::new(0.25, 0.5)));
    samples
        .filter_map(|sample| {
            let away = sample.n? * side;
            Some(offset_origin(sample.origin, sample.p_error, away, away))
        })
        .collect()
}
