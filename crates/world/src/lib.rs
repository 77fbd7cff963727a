//! The compiled scene: immutable, indexed, shared by all threads.

pub mod camera;
pub mod compile;
pub mod health;
pub mod light;
pub mod material;
mod meeting;
pub mod texture;
mod world;

pub use meeting::Encounter;
pub use world::{ItemInfo, World, mask};
