//! Bodies as sets of points, and the scene in which the first of a list that holds a point tells the medium there.

use super::surface::Triangle;
use super::{Medium, Scene, Surface};
use hyaline_math::{DVec2, DVec3};

/// A set of points.
#[derive(Clone, Debug)]
pub enum Body {
    Ball {
        center: DVec3,
        radius: f64,
    },
    Cuboid {
        min: DVec3,
        max: DVec3,
    },
    /// A box whose edges are rounded: the points within `radius` of a smaller box.
    RoundedCuboid {
        min: DVec3,
        max: DVec3,
        radius: f64,
    },
    Torus {
        major_radius: f64,
        minor_radius: f64,
    },
    /// Within a closed, convex shell of triangles.
    Hull(Vec<Triangle>),
}

impl Body {
    fn holds(&self, p: DVec3) -> bool {
        match self {
            Self::Ball { center, radius } => (p - *center).length() < *radius,
            Self::Cuboid { min, max } => p.cmpgt(*min).all() && p.cmplt(*max).all(),
            Self::RoundedCuboid { min, max, radius } => {
                (p - p.clamp(*min + *radius, *max - *radius)).length() < *radius
            }
            Self::Torus { major_radius, minor_radius } => {
                let from_ring = DVec2::new(DVec2::new(p.x, p.z).length() - major_radius, p.y);
                from_ring.length() < *minor_radius
            }
            Self::Hull(triangles) => triangles.iter().all(|triangle| {
                let [a, b, c] = triangle.corners;
                (b - a).cross(c - a).dot(p - a) < 0.0
            }),
        }
    }

    fn surfaces(&self) -> Vec<Surface> {
        match self {
            Self::Ball { center, radius } => vec![Surface::Sphere { center: *center, radius: *radius }],
            Self::Cuboid { min, max } => Surface::planes_of_box(*min, *max),
            Self::RoundedCuboid { min, max, radius } => {
                vec![Surface::AboutBox { min: *min + *radius, max: *max - *radius, radius: *radius }]
            }
            Self::Torus { major_radius, minor_radius } => {
                let center = DVec2::new(*major_radius, 0.0);
                vec![Surface::Torus { center, radius: *minor_radius }]
            }
            Self::Hull(triangles) => vec![Surface::Triangles(triangles.clone())],
        }
    }
}

impl Scene {
    /// Bodies, the strongest first: the first that holds a point tells its medium. The room is six times as wide.
    pub fn of_bodies(bodies: Vec<(Body, Medium)>, ior: &[f64], size: f64) -> Self {
        let surfaces = bodies.iter().flat_map(|(body, _)| body.surfaces()).collect();
        let medium_at =
            move |p: DVec3| bodies.iter().find(|(body, _)| body.holds(p)).map_or(0, |&(_, medium)| medium);
        Self { surfaces, medium_at: Box::new(medium_at), ior: ior.to_vec(), size, room: 6.0 * size }
    }
}
