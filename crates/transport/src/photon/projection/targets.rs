//! What photons are aimed at: balls about the parts of specular objects.

use super::ball::{Ball, merged};
use super::{cluster, patch};
use hyaline_geometry::ItemGeometry;
use hyaline_world::World;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Balls in all, at most.
const MOST_BALLS: usize = 1024;

/// Balls of one item, at most.
const MOST_PER_ITEM: u32 = 256;

/// The specular parts of a scene.
#[derive(Clone, Debug, Default)]
pub(in crate::photon) struct Targets {
    /// Balls that together cover everything specular.
    pub(super) parts: Vec<Ball>,
    /// One ball about everything specular of each object.
    pub(super) objects: Vec<Ball>,
    /// The same, neighbors put together where there are many.
    pub(super) merged_objects: Vec<Ball>,
}

impl Targets {
    pub(super) fn new(world: &World) -> Self {
        let items = world.specular_items();
        let share = (MOST_BALLS / items.len().max(1)) as u32;
        let mut by_object: BTreeMap<u32, Vec<Ball>> = BTreeMap::new();
        for item in items {
            let balls = balls_of(world, item, share.clamp(1, MOST_PER_ITEM));
            by_object.entry(world.items[item as usize].object.0).or_default().extend(balls);
        }
        let objects: Vec<Ball> = by_object.values().filter_map(|balls| Ball::about_balls(balls)).collect();
        let parts = merged(by_object.into_values().flatten().collect(), MOST_BALLS);
        let merged_objects = merged(objects.clone(), MOST_BALLS);
        Self { parts, objects, merged_objects }
    }
}

/// Balls about the specular parts of an item, about `count`.
fn balls_of(world: &World, item: u32, count: u32) -> Vec<Ball> {
    match &world.geometry.items()[item as usize].geometry {
        ItemGeometry::Shape(primitive) => match patch::whole_ball(primitive) {
            Some(ball) => vec![ball],
            None => patch::cut(primitive, count).into_iter().map(|(_, patch)| patch.ball).collect(),
        },
        ItemGeometry::Mesh { mesh, transform } => {
            let faces = (0..mesh.mesh().face_count() as u32).into_par_iter();
            let faces: Vec<u32> = faces.filter(|&face| world.is_specular_face(item, face)).collect();
            cluster::balls(mesh.mesh(), transform.as_ref(), &faces, count)
        }
    }
}
