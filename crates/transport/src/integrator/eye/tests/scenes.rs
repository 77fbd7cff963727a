//! Small scenes of simple shapes, known by hand as well.

use super::by_hand::{GLASS, Shape};
use hyaline_math::{DVec3, Transform};
use hyaline_scene::*;
use hyaline_world::World;
use std::f64::consts::PI;

/// Radius of the disc lamps, scene units.
pub(super) const LAMP_RADIUS: f64 = 0.3;
/// Mean cosine of the fog.
const G: f64 = 0.4;
/// Coefficients of the fog, 1 / scene unit.
const SIGMA: [f64; 2] = [0.3, 0.05];

/// A compiled scene, and what is known of it.
pub(super) struct Stage {
    pub(super) world: World,
    shapes: Vec<Shape>,
    plate: Option<[f64; 2]>,
    /// GGX width of all that is rough.
    pub(super) alpha: f64,
    pub(super) sigma_t: f64,
}

impl Stage {
    /// The surface that a place is on.
    pub(super) fn shape_at(&self, p: DVec3) -> Shape {
        let nearest = self.shapes.iter().min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)));
        *nearest.expect("a scene has surfaces")
    }

    /// Index at a place.
    pub(super) fn ior_at(&self, p: DVec3) -> f64 {
        let is_in_ball = |shape: &Shape| match *shape {
            Shape::Sphere { center, radius } => p.distance(center) < radius,
            Shape::Plane { .. } => false,
        };
        let is_in_plate = self.plate.is_some_and(|[bottom, top]| (bottom..top).contains(&p.y));
        if is_in_plate || self.shapes.iter().any(is_in_ball) { GLASS } else { 1.0 }
    }

    /// Phase function of the fog by the cosine of the angle of deflection, sr⁻¹. [Henyey & Greenstein 1941]
    pub(super) fn henyey_greenstein(&self, cos: f64) -> f64 {
        let square = 1.0 + G * G - 2.0 * G * cos;
        (1.0 - G * G) / (4.0 * PI * square * square.sqrt())
    }
}

/// Lights to test with.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lighting {
    Discs,
    Point,
    Spot,
    Directional,
    Sky,
}

/// A scene in the making: a matte floor at y = 0, and glass above it.
pub(super) struct Making {
    description: SceneDescription,
    shapes: Vec<Shape>,
    /// Heights of the plate's faces.
    plate: Option<[f64; 2]>,
    roughness: f64,
}

impl Making {
    /// - `roughness`: of the surfaces that are to be rough.
    pub(super) fn new(roughness: f64) -> Self {
        let mut description = SceneDescription::default();
        (description.film.width, description.film.height) = (16, 16);
        let camera = CameraDescription {
            name: "camera".into(),
            placement: Transform::look_at(DVec3::new(0.0, 0.5, 3.0), DVec3::Y * 0.5, DVec3::Y)
                .expect("a view"),
            projection: Projection::Perspective { fov: 0.6, fov_axis: FovAxis::Y },
            medium: None,
        };
        description.cameras.push(camera.into());
        description.media.push(MediumDescription::clear("glass", IndexDescription::Constant(GLASS)).into());
        let mut making = Self { description, shapes: Vec::new(), plate: None, roughness };
        making.material("matte", MaterialKind::Matte { reflectance: ColorSource::Constant([0.5; 3]) });
        making.material("black", MaterialKind::Black);
        for (name, roughness) in [("polished", 0.0), ("ground", roughness)] {
            let white = || ColorSource::Constant([1.0; 3]);
            let roughness = ScalarSource::Constant(roughness as f32);
            making.material(name, MaterialKind::Dielectric { roughness, tint: (white(), white()) });
        }
        let floor = square(0.0, 1.0);
        making.object("floor", floor, BoundaryDescription::None, "matte", None);
        making.shapes.push(Shape::Plane { p: DVec3::ZERO, n: DVec3::Y });
        making
    }

    /// A plate of glass from one height to another.
    pub(super) fn plate(mut self, bottom: (f64, &str), top: (f64, &str)) -> Self {
        self.plate = Some([bottom.0, top.0]);
        for ((y, finish), up) in [(bottom, -1.0), (top, 1.0)] {
            let inside = BoundaryDescription::Interface { outside: None, inside: Some("glass".into()) };
            self.object(&format!("face {y}"), square(y, up), inside, finish, None);
            self.shapes.push(Shape::Plane { p: DVec3::Y * y, n: DVec3::Y });
        }
        self
    }

    pub(super) fn ball(mut self, center: DVec3, radius: f64, finish: &str) -> Self {
        let shape = ShapeDescription::Sphere { center, radius, phi: [0.0, 2.0 * PI], theta: [0.0, PI] };
        let solid = BoundaryDescription::Solid { medium: "glass".into() };
        self.object("ball", shape, solid, finish, None);
        self.shapes.push(Shape::Sphere { center, radius });
        self
    }

    /// Fills the world with a medium that scatters.
    pub(super) fn fog(mut self) -> Self {
        let [sigma_s, sigma_a] = SIGMA.map(|sigma| [sigma as f32; 3]);
        let phase = PhaseDescription::from_mean_cosine(G as f32);
        let fog = MediumDescription {
            absorption: Absorption::SigmaA(sigma_a),
            scattering: Some(Scattering { sigma_s, phase }),
            ..MediumDescription::clear("fog", IndexDescription::Constant(1.0))
        };
        self.description.media.push(fog.into());
        self.description.surrounding = Some("fog".into());
        self
    }

    pub(super) fn lit(mut self, lighting: Lighting) -> Stage {
        let at = DVec3::new(0.4, 2.5, 0.2);
        match lighting {
            Lighting::Discs => {
                // Two, so that their choice counts.
                for (x, radiance) in [(-0.5, 3.0), (0.6, 1.0)] {
                    let center = DVec3::new(x, 2.5, 0.1);
                    let disc = ShapeDescription::Disc {
                        center,
                        normal: -DVec3::Y,
                        radius: LAMP_RADIUS,
                        inner_radius: 0.0,
                    };
                    self.object(
                        &format!("lamp {x}"),
                        disc,
                        BoundaryDescription::None,
                        "black",
                        Some(radiance),
                    );
                }
            }
            Lighting::Point => self.light(LightKind::Point { position: at, intensity: [1.0; 3] }),
            Lighting::Spot => self.light(LightKind::Spot {
                position: at,
                direction: -at.normalize(),
                intensity: [1.0; 3],
                outer_angle: 0.6,
                inner_angle: 0.4,
                falloff: SpotFalloff::Smooth,
            }),
            Lighting::Directional => {
                self.light(LightKind::Directional { direction: -at.normalize(), irradiance: [1.0; 3] });
            }
            Lighting::Sky => self.light(LightKind::Environment {
                radiance: [1.0; 3],
                image: None,
                placement: Transform::IDENTITY,
                visible_to_camera: true,
            }),
        }
        let (world, _) = World::compile(&self.description).expect("the scene is sound");
        Stage {
            world,
            shapes: self.shapes,
            plate: self.plate,
            alpha: self.roughness.powi(2),
            sigma_t: SIGMA[0] + SIGMA[1],
        }
    }

    fn light(&mut self, kind: LightKind) {
        self.description.lights.push(LightDescription { name: "light".into(), kind, medium: None }.into());
    }

    fn material(&mut self, name: &str, kind: MaterialKind) {
        self.description.materials.push(MaterialDescription::new(name, kind).into());
    }

    fn object(
        &mut self,
        name: &str,
        shape: ShapeDescription,
        boundary: BoundaryDescription,
        material: &str,
        radiance: Option<f32>,
    ) {
        let emission = radiance.map(|radiance| Emission {
            color: [radiance; 3],
            quantity: EmissionQuantity::Radiance,
            two_sided: false,
            visible_to_camera: true,
            texture: None,
            medium: None,
        });
        let object = ObjectDescription {
            name: name.into(),
            shape,
            placement: Transform::IDENTITY,
            boundary,
            material: material.into(),
            slot_materials: Vec::new(),
            emission,
        };
        self.description.objects.push(object.into());
    }
}

/// A square of the plane at a height, its normal up or down.
fn square(y: f64, up: f64) -> ShapeDescription {
    let (half_u, half_v) = (DVec3::Z * 3.0, DVec3::X * (3.0 * up));
    ShapeDescription::Rectangle { center: DVec3::Y * y, half_u, half_v }
}
