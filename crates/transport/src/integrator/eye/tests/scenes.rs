//! Small scenes of simple shapes, known by hand as well.

use super::by_hand::{Finish, GLASS, Shape};
use hyaline_math::{DMat3, DVec3, Transform};
use hyaline_scene::*;
use hyaline_world::World;
use std::f64::consts::PI;

/// Size of the picture, pixels.
pub(super) const SIZE: (u32, u32) = (64, 48);
/// Radius of the disc lamps, scene units.
pub(super) const LAMP_RADIUS: f64 = 0.3;
/// Mean cosine of the fog.
const G: f64 = 0.4;
/// Coefficients of the fog, 1 / scene unit.
const SIGMA: [f64; 2] = [0.3, 0.05];

/// Density of the smoke.
const SMOKE: f64 = 0.7;

/// A compiled scene, and what is known of it.
pub(super) struct Stage {
    pub(super) world: World,
    shapes: Vec<(Shape, Finish)>,
    plate: Option<[f64; 2]>,
    pub(super) sigma_t: f64,
    /// What the medium about things does to light.
    pub(super) particle: Finish,
}

impl Stage {
    /// The surface that a place is on.
    pub(super) fn shape_at(&self, p: DVec3) -> (Shape, Finish) {
        let nearest = self.shapes.iter().min_by(|a, b| a.0.distance(p).total_cmp(&b.0.distance(p)));
        *nearest.expect("a scene has surfaces")
    }

    /// Index at a place.
    pub(super) fn ior_at(&self, p: DVec3) -> f64 {
        let is_in_ball = |&(shape, _): &(Shape, Finish)| match shape {
            Shape::Sphere { center, radius } => p.distance(center) < radius,
            Shape::Plane { .. } => false,
        };
        let is_in_plate = self.plate.is_some_and(|[bottom, top]| (bottom..top).contains(&p.y));
        if is_in_plate || self.shapes.iter().any(is_in_ball) { GLASS } else { 1.0 }
    }
}

/// Lights to test with.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lighting {
    /// A few.
    Discs,
    /// More than a path asks at once, the last the brightest.
    ManyDiscs,
    Point,
    Spot,
    Directional,
    Sky,
}

/// A scene in the making: a matte floor at y = 0, and glass above it.
pub(super) struct Making {
    description: SceneDescription,
    shapes: Vec<(Shape, Finish)>,
    /// Heights of the plate's faces.
    plate: Option<[f64; 2]>,
    roughness: f64,
    particle: Finish,
}

impl Making {
    /// - `roughness`: of the surfaces that are to be rough.
    pub(super) fn new(roughness: f64) -> Self {
        let mut description = SceneDescription::default();
        (description.film.width, description.film.height) = SIZE;
        let camera = CameraDescription {
            name: "camera".into(),
            placement: Transform::look_at(DVec3::new(0.0, 0.5, 3.0), DVec3::Y * 0.5, DVec3::Y)
                .expect("a view"),
            projection: Projection::Perspective { fov: 0.6, fov_axis: FovAxis::Y },
            medium: None,
        };
        description.cameras.push(camera.into());
        description.media.push(MediumDescription::clear("glass", IndexDescription::Constant(GLASS)).into());
        let particle = Finish::Fog(G);
        let mut making = Self { description, shapes: Vec::new(), plate: None, roughness, particle };
        making.material("matte", MaterialKind::Matte { reflectance: ColorSource::Constant([0.5; 3]) });
        making.material("black", MaterialKind::Black);
        for (name, roughness) in [("polished", 0.0), ("ground", roughness)] {
            let white = || ColorSource::Constant([1.0; 3]);
            let roughness = ScalarSource::Constant(roughness as f32);
            making.material(name, MaterialKind::Dielectric { roughness, tint: (white(), white()) });
        }
        let floor = square(0.0, 1.0);
        making.object("floor", floor, BoundaryDescription::None, "matte", None);
        making.shapes.push((Shape::Plane { p: DVec3::ZERO, n: DVec3::Y }, Finish::Matte));
        making
    }

    /// A matte wall at one side of the floor.
    pub(super) fn wall(mut self) -> Self {
        let (center, half_u, half_v) = (DVec3::new(-1.4, 0.3, 0.0), DVec3::Y * 3.0, DVec3::Z * 3.0);
        let wall = ShapeDescription::Rectangle { center, half_u, half_v };
        self.object("wall", wall, BoundaryDescription::None, "matte", None);
        self.shapes.push((Shape::Plane { p: center, n: DVec3::X }, Finish::Matte));
        self
    }

    /// The finish of a material of glass.
    fn finish(&self, name: &str) -> Finish {
        if name == "polished" { Finish::Polished } else { Finish::Ground(self.roughness.powi(2)) }
    }

    /// A plate of glass from one height to another.
    pub(super) fn plate(mut self, bottom: (f64, &str), top: (f64, &str)) -> Self {
        self.plate = Some([bottom.0, top.0]);
        for ((y, finish), up) in [(bottom, -1.0), (top, 1.0)] {
            let inside = BoundaryDescription::Interface { outside: None, inside: Some("glass".into()) };
            self.object(&format!("face {y}"), square(y, up), inside, finish, None);
            self.shapes.push((Shape::Plane { p: DVec3::Y * y, n: DVec3::Y }, self.finish(finish)));
        }
        self
    }

    pub(super) fn ball(mut self, center: DVec3, radius: f64, finish: &str) -> Self {
        let shape = ShapeDescription::Sphere { center, radius, phi: [0.0, 2.0 * PI], theta: [0.0, PI] };
        let solid = BoundaryDescription::Solid { medium: "glass".into() };
        self.object("ball", shape, solid, finish, None);
        self.shapes.push((Shape::Sphere { center, radius }, self.finish(finish)));
        self
    }

    /// Fills the world with a medium that scatters.
    pub(super) fn fog(self) -> Self {
        self.filled_with(None)
    }

    /// Fills the world with a medium that scatters and has a grid, though all its densities are the same.
    pub(super) fn smoke(mut self) -> Self {
        let density = GridData { size: [2; 3], channels: 1, values: vec![SMOKE as f32; 8] };
        let placement = Transform::from_parts(DMat3::from_diagonal(DVec3::splat(10.0)), DVec3::splat(-5.0));
        let placement = placement.expect("a box");
        self.particle = Finish::Smoke(G);
        self.filled_with(Some(DensityGrid { density: density.into(), albedo: None, placement }))
    }

    fn filled_with(mut self, density: Option<DensityGrid>) -> Self {
        let [sigma_s, sigma_a] = SIGMA.map(|sigma| [sigma as f32; 3]);
        let phase = PhaseDescription::from_mean_cosine(G as f32);
        let fog = MediumDescription {
            absorption: Absorption::SigmaA(sigma_a),
            scattering: Some(Scattering { sigma_s, phase }),
            density,
            ..MediumDescription::clear("fog", IndexDescription::Constant(1.0))
        };
        self.description.media.push(fog.into());
        self.description.surrounding = Some("fog".into());
        self
    }

    pub(super) fn lit(mut self, lighting: Lighting) -> Stage {
        let at = DVec3::new(0.4, 2.5, 0.2);
        match lighting {
            Lighting::Discs | Lighting::ManyDiscs => {
                // Two at least, so that their choice counts.
                let few = [(-0.5, 3.0), (0.6, 1.0)];
                let many = [(-2.7, 1.0), (-1.6, 0.5), (-0.5, 2.0), (0.6, 0.3), (1.7, 1.0), (2.8, 5.0)];
                let discs = if let Lighting::Discs = lighting { &few[..] } else { &many[..] };
                for &(x, radiance) in discs {
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
        let density = if let Finish::Smoke(_) = self.particle { SMOKE } else { 1.0 };
        let (world, _) = World::compile(&self.description).expect("the scene is sound");
        Stage {
            world,
            shapes: self.shapes,
            plate: self.plate,
            sigma_t: density * (SIGMA[0] + SIGMA[1]),
            particle: self.particle,
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
