//! Where glass meets what it stands on, light differs from one side to the other: with the first passes' wide radii,
//! `merging` must not take one for the other.

mod pictures;
mod scene_kit;

use hyaline_math::DVec3;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::RenderSettings;
use hyaline_world::World;
use pictures::{Shot, assert_same, known_to};
use scene_kit::*;
use std::ops::Range;
use std::sync::Arc;

/// Relative error of the difference above which nothing would be shown.
const POWER: f64 = 0.006;
/// The same where photons across the edge are as bright as those that are missed, but for 1.7 %.
const POWER_UNDER_GLASS: f64 = 0.004;
/// Edge of the pictures, pixels: the first radius is a fifth of it.
const EDGE: u32 = 12;

fn means(world: &World, integrator: &str, passes: Range<u32>, power: f64) -> Moments {
    known_to(0.7 * power, 0, |seed| {
        let settings = RenderSettings { seed, ..settings() };
        Shot { world, integrator, settings, size: (EDGE, EDGE) }.mean_of_any(passes.clone())
    })
}

fn assert_as_path(kit: &SceneKit, power: f64, what: &str) {
    let world = kit.world();
    let (photons, paths) = (means(&world, "merging", 0..24, power), means(&world, "path", 0..64, power));
    assert_same(&photons, &paths, power, what);
}

/// A matte floor and a lamp above it on the left.
fn ground() -> SceneKit {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.7).surface("floor", floor(0.0, 6.0), "matte");
    kit.lamp("lamp", sphere(DVec3::new(-2.0, 2.0, 0.4), 0.4), 20.0);
    kit.camera(DVec3::new(-0.8, 3.0, 0.0), DVec3::ZERO);
    kit
}

/// Glass on the right, which stands on the floor.
fn block() -> ShapeDescription {
    cuboid(DVec3::new(0.0, 0.0, -2.0), DVec3::new(2.0, 0.8, 2.0))
}

#[test]
fn what_black_glass_reflects_ends_at_its_foot() {
    // The floor under the block is dark, and no photons are there to be counted for the floor before it.
    let mut kit = ground();
    kit.absorbing_medium("black glass", 2.5, [1e4; 3], 0).solid("block", block(), "black glass");
    assert_as_path(&kit, POWER, "black glass");
}

#[test]
fn the_floor_under_glass_is_lit_up_to_the_edge() {
    // All its light comes through glass; beside it, where light comes straight, there are few photons.
    let mut kit = ground();
    kit.medium("glass", 1.5).solid("block", block(), "glass");
    assert_as_path(&kit, POWER_UNDER_GLASS, "clear glass");
}

#[test]
fn a_rough_boundary_is_lit_from_below_by_what_lies_there() {
    // Ground glass over water on the left, where a lamp shines on the floor, and over ink on the right.
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.7).surface("floor", floor(0.0, 6.0), "matte");
    let white = || ColorSource::Constant([1.0; 3]);
    let roughness = ScalarSource::Constant(0.6);
    kit.material("ground", MaterialKind::Dielectric { roughness, tint: (white(), white()) });
    kit.medium("water", 1.33).absorbing_medium("ink", 1.33, [30.0; 3], 1);
    let below = BoundaryDescription::Interface { outside: None, inside: Some("water".into()) };
    kit.object("top", floor(0.8, 6.0), below, "ground");
    kit.solid("block", block(), "ink");
    kit.lamp("lamp", rectangle(DVec3::new(-1.0, 0.7, 0.0), DVec3::X * 0.4, DVec3::Z * 0.6), 20.0);
    kit.camera(DVec3::new(0.0, 3.0, 0.0), DVec3::Y * 0.8);
    assert_as_path(&kit, POWER, "ground glass");
}

#[test]
fn under_an_open_mesh_no_light_is_lost() {
    // Light goes in by the pyramid and out where its base is missing: what the floor then lies in depends on the way
    // there, and neither is right.
    let mut kit = ground();
    let corners = [[-0.8, 0.6, -0.8], [-0.8, 0.6, 0.8], [0.8, 0.6, 0.8], [0.8, 0.6, -0.8], [0.0, 1.2, 0.0]];
    let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    let mesh = MeshData { positions: corners.to_vec(), triangles, ..MeshData::default() };
    kit.medium("glass", 1.5);
    kit.solid("pyramid", ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: true }, "glass");
    kit.camera(DVec3::new(2.4, 0.5, 0.0), DVec3::new(0.6, 0.0, 0.0));
    kit.description.cameras[0].projection = Projection::Perspective { fov: 0.2, fov_axis: FovAxis::Y };
    assert_as_path(&kit, POWER, "open mesh");
}
