//! The compiled scene: immutable, indexed, shared by all threads.

pub mod camera;
pub mod compile;
pub mod light;
pub mod material;
mod meeting;
mod specular;
pub mod texture;
mod world;

pub use meeting::Encounter;
pub use specular::NEARLY_POLISHED;
pub use world::{ItemInfo, World, mask};
