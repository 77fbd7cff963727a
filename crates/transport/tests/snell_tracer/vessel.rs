//! Glasses and bowls as one would measure them with a ruler, in the half-plane of (distance from the axis, height).
//!
//! - The wall has the same thickness everywhere, measured across it; the outside is given.
//! - The vessel stands on the plane y = 0; its inner base is a plane at the height `base`, or the inner wall where
//!   that is higher.
//! - The rim is cut square to the wall, or a half circle over the cut that touches both sides of the wall.
//! - A level is a fraction of the way from the inner base to the inner edge of the rim. A meniscus is an arc that
//!   leaves the level surface smoothly and meets the wall under 20° at the height to which the liquid climbs.

use super::{Medium, Scene, Surface};
use hyaline_math::float::f64::{atan2, cos, sin};
use hyaline_math::{DVec2, DVec3};

/// The outside of a vessel.
#[derive(Clone, Copy, Debug)]
pub enum Outside {
    /// A straight wall from foot to lip.
    Straight { foot: DVec2, lip: DVec2 },
    /// A part of a sphere that stands on a circle of radius `foot` and opens in one of radius `opening`.
    Spherical { radius: f64, foot: f64, opening: f64 },
}

/// A liquid: how full, how far it climbs.
#[derive(Clone, Copy, Debug)]
pub struct Liquid {
    pub medium: Medium,
    pub level: f64,
    pub meniscus: f64,
}

/// A vessel with liquids, from the lowest up.
#[derive(Clone, Debug)]
pub struct Vessel {
    pub outside: Outside,
    pub wall: f64,
    pub base: f64,
    pub has_round_rim: bool,
    pub glass: Medium,
    pub liquids: Vec<Liquid>,
}

/// The surface of a liquid: level up to the arc's center, then along the circle.
#[derive(Clone, Copy, Debug)]
struct Top {
    medium: Medium,
    height: f64,
    contact: DVec2,
    /// Center and radius of the meniscus; the radius is 0 where there is none.
    center: DVec2,
    radius: f64,
}

impl Outside {
    fn lip(&self) -> DVec2 {
        match *self {
            Self::Straight { lip, .. } => lip,
            Self::Spherical { radius, opening, .. } => {
                self.middle() + DVec2::new(opening, (radius * radius - opening * opening).sqrt())
            }
        }
    }

    /// Center of the sphere.
    fn middle(&self) -> DVec2 {
        match *self {
            Self::Straight { .. } => DVec2::ZERO,
            Self::Spherical { radius, foot, .. } => DVec2::new(0.0, (radius * radius - foot * foot).sqrt()),
        }
    }

    /// Direction up along the wall at its point nearest to `q`.
    fn up(&self, q: DVec2) -> DVec2 {
        match *self {
            Self::Straight { foot, lip } => (lip - foot).normalize(),
            Self::Spherical { .. } => (q - self.middle()).perp().normalize(),
        }
    }

    /// How deep below the outer surface a point is; negative outside.
    fn depth(&self, q: DVec2) -> f64 {
        match *self {
            Self::Straight { lip, .. } => self.up(q).perp_dot(q - lip),
            Self::Spherical { radius, .. } => radius - (q - self.middle()).length(),
        }
    }

    /// The surface at a depth.
    fn surface(&self, depth: f64) -> Surface {
        match *self {
            Self::Straight { foot, lip } => {
                let slope = (lip.x - foot.x) / (lip.y - foot.y);
                let across = depth * (1.0 + slope * slope).sqrt();
                Surface::Cone { radius: foot.x - slope * foot.y - across, slope }
            }
            Self::Spherical { radius, .. } => {
                Surface::Sphere { center: DVec3::Y * self.middle().y, radius: radius - depth }
            }
        }
    }

    /// Where the surface at a depth has a given height.
    fn at_height(&self, depth: f64, y: f64) -> DVec2 {
        let r = match self.surface(depth) {
            Surface::Cone { radius, slope } => radius + slope * y,
            Surface::Sphere { center, radius } => (radius * radius - (y - center.y) * (y - center.y)).sqrt(),
            other => panic!("a wall is no {other:?}"),
        };
        DVec2::new(r, y)
    }
}

impl Vessel {
    /// Center of the rim's half circle.
    fn rim(&self) -> DVec2 {
        let lip = self.outside.lip();
        // To the left of the way up is the axis.
        lip + self.outside.up(lip).perp() * (0.5 * self.wall)
    }

    fn top(&self, liquid: &Liquid) -> Top {
        const CONTACT_ANGLE: f64 = 20.0 / 180.0 * std::f64::consts::PI;
        let inner_edge = 2.0 * self.rim() - self.outside.lip();
        let height = self.base + liquid.level * (inner_edge.y - self.base);
        let contact = self.outside.at_height(self.wall, height + liquid.meniscus);
        let up = self.outside.up(contact);
        // The arc climbs from level to the direction of the wall less the contact angle.
        let turn = atan2(up.y, up.x) - CONTACT_ANGLE;
        assert!(turn < std::f64::consts::FRAC_PI_2, "the surface of a liquid must not overhang");
        let radius = liquid.meniscus / (1.0 - cos(turn));
        let center = DVec2::new(contact.x - radius * sin(turn), height + radius);
        Top { medium: liquid.medium, height, contact, center, radius }
    }

    fn medium_at(&self, tops: &[Top], q: DVec2) -> Medium {
        let (depth, lip) = (self.outside.depth(q), self.outside.lip());
        if depth > self.wall && q.y > self.base {
            return tops.iter().find(|top| q.y < top.height_at(q.x)).map_or(0, |top| top.medium);
        }
        let is_below_cut = (q - lip).dot(self.outside.up(lip)) < 0.0;
        let is_wall = depth > 0.0 && q.y > 0.0 && is_below_cut;
        let is_rim = self.has_round_rim && (q - self.rim()).length() < 0.5 * self.wall;
        if is_wall || is_rim { self.glass } else { 0 }
    }

    /// The vessel alone in the world.
    pub fn scene(self, ior: &[f64], size: f64) -> Scene {
        let level = |y: f64| Surface::Plane { point: DVec3::Y * y, normal: DVec3::Y };
        let mut surfaces =
            vec![level(0.0), level(self.base), self.outside.surface(0.0), self.outside.surface(self.wall)];
        surfaces.push(if self.has_round_rim {
            Surface::Torus { center: self.rim(), radius: 0.5 * self.wall }
        } else {
            let (lip, across) = (self.outside.lip(), self.rim() - self.outside.lip());
            match across.y {
                0.0 => level(lip.y),
                rise => Surface::Cone { radius: lip.x - lip.y * across.x / rise, slope: across.x / rise },
            }
        });
        let tops: Vec<Top> = self.liquids.iter().map(|liquid| self.top(liquid)).collect();
        for top in &tops {
            surfaces.push(level(top.height));
            if top.radius > 0.0 {
                surfaces.push(Surface::Torus { center: top.center, radius: top.radius });
            }
        }
        let medium_at = move |p: DVec3| self.medium_at(&tops, DVec2::new(DVec2::new(p.x, p.z).length(), p.y));
        Scene { surfaces, medium_at: Box::new(medium_at), ior: ior.to_vec(), size, room: 6.0 * size }
    }
}

impl Top {
    /// Up to where the liquid stands at a distance from the axis; where the wall leans inward, it is below the contact.
    fn height_at(&self, r: f64) -> f64 {
        let past = r - self.center.x;
        if self.radius == 0.0 || past < 0.0 {
            self.height
        } else if r > self.contact.x {
            self.contact.y
        } else {
            self.center.y - (self.radius * self.radius - past * past).sqrt()
        }
    }
}
