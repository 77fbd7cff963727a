//! The compiled scene: immutable, indexed, shared by all threads.

pub mod camera;
pub mod compile;
mod face;
pub mod health;
pub mod light;
pub mod material;
mod meeting;
pub mod relief;
mod specular;
pub mod texture;
mod world;

pub use face::{Face, StraightWay};
pub use meeting::Encounter;
pub use specular::NEARLY_POLISHED;
pub use world::{ItemInfo, World, mask};
