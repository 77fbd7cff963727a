//! The compiled scene: immutable, indexed, shared by all threads.

pub mod camera;
pub mod compile;
mod face;
pub mod light;
pub mod material;
mod meeting;
pub mod relief;
pub mod texture;
mod world;

pub use face::{Face, StraightWay};
pub use meeting::Encounter;
pub use world::{ItemInfo, World, mask};
