//! Cones from a light, and discs across its light, about the bounds of each specular object.
//!
//! An object is chosen by the size of its cone or disc, and a direction or place in it uniformly. Where several
//! objects overlap, only the first of them counts: what another would emit there is given up, so that each direction
//! and place has one chance, however many objects lie that way.

use super::Departure;
use super::ball::Ball;
use super::beam::Beam;
use hyaline_math::{DVec3, Frame, Vec2, Vec3};
use hyaline_sampling::{Distribution1d, warp};
use hyaline_world::light::{Light, SceneSphere, UnitBox};

/// Cones from a point.
#[derive(Clone, Debug)]
pub(in crate::photon) struct Cones {
    /// Axis, and 1 - cos of the half-angle.
    cones: Vec<(Vec3, f32)>,
    choice: Distribution1d,
    /// Sum of the cones over the directions that the light shines in.
    kept: f64,
}

impl Cones {
    /// `None` where it takes all that the light shines on, as within an object, or nothing; then nothing is gained.
    pub(super) fn new(light: &Light, objects: &[Ball]) -> Option<Self> {
        let position = light.position()?.as_dvec3();
        let all = Beam::new(Ball { center: position, radius: 0.0 }, light.cone_of_emission(&UnitBox::WHOLE));
        if objects.iter().any(|ball| ball.contains(position)) {
            return None;
        }
        let cone = |ball: &Ball| {
            let to_object = ball.center - position;
            let sine2 = ball.radius * ball.radius / to_object.length_squared();
            (to_object.normalize().as_vec3(), warp::one_minus_cos(sine2 as f32 * (1.0 + 1e-6)))
        };
        let cones: Vec<(Vec3, f32)> = objects.iter().filter(|ball| all.may_meet(ball)).map(cone).collect();
        let choice = Distribution1d::from_f64(cones.iter().map(|&(_, h)| f64::from(h))).ok()?;
        let solid_angle: f64 = cones.iter().map(|&(_, h)| 1.0 / f64::from(warp::pdf_cone(h))).sum();
        let kept = solid_angle / f64::from(light.solid_angle());
        (kept < 1.0).then_some(Self { cones, choice, kept })
    }

    pub(super) fn kept(&self) -> f64 {
        self.kept
    }

    /// - `u_object`: uniform in [0, 1).
    pub(super) fn emit(&self, light: &Light, u_object: f32, u_direction: Vec2) -> Option<Departure> {
        let pick = self.choice.sample(u_object);
        let (axis, h) = self.cones[pick.index];
        let direction = Frame::from_normal(axis).to_world(warp::sample_cone(u_direction, h)).normalize();
        let is_in = |&(axis, h): &(Vec3, f32)| 0.5 * (direction - axis).length_squared() <= h;
        let intensity = light.intensity(direction);
        if self.cones[..pick.index].iter().any(is_in) || intensity.is_zero() {
            return None;
        }
        let flux = intensity / (warp::pdf_cone(h) * pick.probability);
        Some(Departure::bare(light.position()?, direction, flux))
    }
}

/// Discs across parallel light.
#[derive(Clone, Debug)]
pub(in crate::photon) struct Discs {
    /// Center and radius.
    discs: Vec<(Vec3, f32)>,
    choice: Distribution1d,
    /// Sum of the discs over the one that covers the scene.
    kept: f64,
}

impl Discs {
    /// `None` where the objects' discs are as large as the scene's; then nothing is gained.
    pub(super) fn new(scene: &SceneSphere, objects: &[Ball]) -> Option<Self> {
        let discs: Vec<(Vec3, f32)> = objects.iter().map(|b| (b.center.as_vec3(), b.radius as f32)).collect();
        let squares = || discs.iter().map(|&(_, radius)| f64::from(radius) * f64::from(radius));
        let choice = Distribution1d::from_f64(squares().collect::<Vec<_>>().into_iter()).ok()?;
        let kept = squares().sum::<f64>() / f64::from(scene.radius).powi(2);
        (kept < 1.0).then_some(Self { discs, choice, kept })
    }

    pub(super) fn kept(&self) -> f64 {
        self.kept
    }

    /// A place on the disc of one of the objects where light starts that travels along `direction`, and how many
    /// times the area of the scene's disc its chance is the inverse of.
    pub(super) fn sample(
        &self,
        scene: &SceneSphere,
        direction: Vec3,
        u_object: f32,
        u_position: Vec2,
    ) -> Option<(Vec3, f64)> {
        let pick = self.choice.sample(u_object);
        let (center, radius) = self.discs[pick.index];
        let frame = Frame::from_normal(direction);
        let q = warp::sample_disc(u_position) * radius;
        let place = center + frame.s * q.x + frame.t * q.y;
        let is_in = |&(center, radius): &(Vec3, f32)| {
            let offset = center - place;
            offset.length_squared() - offset.dot(direction).powi(2) <= radius * radius
        };
        if self.discs[..pick.index].iter().any(is_in) {
            return None;
        }
        // Back to where the light enters the scene.
        let depth = (place - scene.center).dot(direction) + scene.radius;
        let share = f64::from(radius).powi(2) / f64::from(scene.radius).powi(2);
        Some((place - direction * depth, share / f64::from(pick.probability)))
    }
}

/// Whether a ray that starts somewhere meets one of the objects.
pub(super) fn any_ahead(objects: &[Ball], origin: Vec3, direction: Vec3) -> bool {
    let (origin, direction): (DVec3, DVec3) = (origin.as_dvec3(), direction.as_dvec3());
    objects.iter().any(|ball| {
        let offset = ball.center - origin;
        let along = offset.dot(direction);
        let miss2 = (offset - direction * along).length_squared();
        miss2 <= ball.radius * ball.radius && (along >= 0.0 || ball.contains(origin))
    })
}
