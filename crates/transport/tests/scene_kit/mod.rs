//! Small scenes built in code, and estimates of radiance in them, for the tests of integrators.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "each test file uses its own part of the kit, and a test exports nothing"
)]

use hyaline_math::{DVec3, Ray, Transform, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scattering::MediumSet;
use hyaline_scene::*;
use hyaline_testkit::Moments;
use hyaline_transport::integrator::radiance;
use hyaline_transport::{RenderSettings, Stats};
use hyaline_world::World;
use std::sync::Arc;

/// A scene under construction.
#[derive(Clone)]
pub struct SceneKit {
    pub description: SceneDescription,
}

impl SceneKit {
    /// Nothing but a camera at the origin that looks along -z, and the finish named 'dielectric'.
    pub fn new() -> Self {
        let mut description = SceneDescription::default();
        description.film.width = 16;
        description.film.height = 16;
        let mut kit = Self { description };
        kit.camera(DVec3::ZERO, -DVec3::Z);
        kit.material("dielectric", clear_dielectric());
        kit.material("black", MaterialKind::Black);
        kit
    }

    /// Replaces the camera.
    pub fn camera(&mut self, from: DVec3, to: DVec3) -> &mut Self {
        let up = if (to - from).normalize().y.abs() > 0.9 { DVec3::X } else { DVec3::Y };
        let camera = CameraDescription {
            name: "camera".into(),
            placement: Transform::look_at(from, to, up).unwrap(),
            projection: Projection::Perspective { fov: 0.6, fov_axis: FovAxis::Y },
            medium: None,
        };
        self.description.cameras = vec![camera.into()];
        self
    }

    pub fn medium(&mut self, name: &str, ior: f64) -> &mut Self {
        self.absorbing_medium(name, ior, [0.0; 3], 0)
    }

    pub fn absorbing_medium(&mut self, name: &str, ior: f64, sigma_a: Rgb, priority: i32) -> &mut Self {
        let medium = MediumDescription {
            absorption: Absorption::SigmaA(sigma_a),
            priority,
            ..MediumDescription::clear(name, IndexDescription::Constant(ior))
        };
        self.description.media.push(medium.into());
        self
    }

    pub fn material(&mut self, name: &str, kind: MaterialKind) -> &mut Self {
        self.description.materials.push(MaterialDescription::new(name, kind).into());
        self
    }

    pub fn matte(&mut self, name: &str, reflectance: f32) -> &mut Self {
        self.material(name, MaterialKind::Matte { reflectance: ColorSource::Constant([reflectance; 3]) })
    }

    pub fn object(
        &mut self,
        name: &str,
        shape: ShapeDescription,
        boundary: BoundaryDescription,
        material: &str,
    ) -> &mut Self {
        let object = ObjectDescription {
            name: name.into(),
            shape,
            placement: Transform::IDENTITY,
            boundary,
            material: material.into(),
            slot_materials: Vec::new(),
            emission: None,
        };
        self.description.objects.push(object.into());
        self
    }

    pub fn solid(&mut self, name: &str, shape: ShapeDescription, medium: &str) -> &mut Self {
        self.object(name, shape, BoundaryDescription::Solid { medium: medium.into() }, "dielectric")
    }

    pub fn interface(
        &mut self,
        name: &str,
        shape: ShapeDescription,
        outside: Option<&str>,
        inside: Option<&str>,
    ) -> &mut Self {
        let boundary = BoundaryDescription::Interface {
            outside: outside.map(Into::into),
            inside: inside.map(Into::into),
        };
        self.object(name, shape, boundary, "dielectric")
    }

    pub fn surface(&mut self, name: &str, shape: ShapeDescription, material: &str) -> &mut Self {
        self.object(name, shape, BoundaryDescription::None, material)
    }

    /// A black surface that shines from the side of its normal.
    pub fn lamp(&mut self, name: &str, shape: ShapeDescription, radiance: f32) -> &mut Self {
        self.surface(name, shape, "black");
        let object = self.description.objects.last_mut().unwrap();
        object.emission = Some(Emission {
            color: [radiance; 3],
            quantity: EmissionQuantity::Radiance,
            two_sided: false,
            visible_to_camera: true,
            texture: None,
            medium: None,
        });
        self
    }

    pub fn sky(&mut self, radiance: f32) -> &mut Self {
        let kind = LightKind::Environment {
            radiance: [radiance; 3],
            image: None,
            placement: Transform::IDENTITY,
            visible_to_camera: true,
        };
        self.light(kind)
    }

    pub fn light(&mut self, kind: LightKind) -> &mut Self {
        self.description.lights.push(LightDescription { name: "light".into(), kind, medium: None }.into());
        self
    }

    pub fn world(&self) -> World {
        World::compile(&self.description).unwrap().0
    }
}

pub fn clear_dielectric() -> MaterialKind {
    let white = || ColorSource::Constant([1.0; 3]);
    MaterialKind::Dielectric { roughness: ScalarSource::Constant(0.0), tint: (white(), white()) }
}

pub fn sphere(center: DVec3, radius: f64) -> ShapeDescription {
    use std::f64::consts::PI;
    ShapeDescription::Sphere { center, radius, phi: [0.0, 2.0 * PI], theta: [0.0, PI] }
}

pub fn cuboid(min: DVec3, max: DVec3) -> ShapeDescription {
    ShapeDescription::Box { min, max, radius: 0.0 }
}

/// A square with its normal along `half_u` × `half_v`.
pub fn rectangle(center: DVec3, half_u: DVec3, half_v: DVec3) -> ShapeDescription {
    ShapeDescription::Rectangle { center, half_u, half_v }
}

/// A square of the plane y = `height`, its normal up.
pub fn floor(height: f64, half: f64) -> ShapeDescription {
    rectangle(DVec3::new(0.0, height, 0.0), DVec3::Z * half, DVec3::X * half)
}

/// A tumbler of 3 cm radius with a 2.5 mm wall, in scene units of `unit` meters⁻¹; `fill` as (medium, level, meniscus).
pub fn tumbler(rim: RimKind, fill: &[(&str, f64, f64)], unit: f64) -> ShapeDescription {
    ShapeDescription::Vessel(VesselDescription {
        profile: VesselProfile::Points {
            outer: vec![[0.03 * unit, 0.0], [0.036 * unit, 0.1 * unit]],
            curve: ProfileCurve::Lines,
        },
        wall: 0.0025 * unit,
        base: 0.008 * unit,
        rim,
        medium: "glass".into(),
        fill: fill
            .iter()
            .map(|&(medium, level, meniscus)| FillLayer {
                medium: medium.into(),
                level,
                meniscus: meniscus * unit,
            })
            .collect(),
    })
}

/// A closed ball of triangles, its normals smooth.
pub fn ball_mesh(center: Vec3, radius: f32, rings: u32) -> ShapeDescription {
    let segments = 2 * rings;
    let mut mesh = MeshData::default();
    for ring in 0..=rings {
        let theta = std::f32::consts::PI * ring as f32 / rings as f32;
        for segment in 0..segments {
            let phi = std::f32::consts::TAU * segment as f32 / segments as f32;
            let (sin_t, cos_t) = hyaline_math::float::sin_cos(theta);
            let (sin_p, cos_p) = hyaline_math::float::sin_cos(phi);
            let n = Vec3::new(sin_t * cos_p, cos_t, -sin_t * sin_p);
            mesh.positions.push((center + n * radius).to_array());
            mesh.normals.push(n.to_array());
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let [a, b, c, d] = [(ring, segment), (ring + 1, segment), (ring + 1, next), (ring, next)]
                .map(|(r, s)| r * segments + s);
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    ShapeDescription::Mesh { mesh: Arc::new(mesh), flat: false }
}

/// Settings for statistics: independent samples.
pub fn settings() -> RenderSettings {
    RenderSettings { sampler: SamplerKind::Independent, ..RenderSettings::default() }
}

/// One sample of `path` along `ray`, sample number `index`.
pub fn sample(world: &World, ray: Ray, set: MediumSet, index: u32) -> f32 {
    sample_with(&settings(), world, ray, set, index)
}

/// The same of paths that are not split at polished surfaces.
pub fn unsplit_sample(world: &World, ray: Ray, set: MediumSet, index: u32) -> f32 {
    let techniques = Techniques { splitting: false, ..Techniques::default() };
    sample_with(&RenderSettings { techniques, ..settings() }, world, ray, set, index)
}

fn sample_with(settings: &RenderSettings, world: &World, ray: Ray, set: MediumSet, index: u32) -> f32 {
    let mut sampler = Sampler::new(settings.sampler, settings.seed, (index % 4096, index / 4096), 0);
    let mut stats = Stats::default();
    let value = radiance(world, settings, ray, set, &mut sampler, &mut stats, None);
    assert!(stats.never_entered.is_empty(), "left what was never entered: {:?}", stats.never_entered);
    value.mean(world.lanes)
}

/// Estimate of the radiance along `ray` from `count` samples, the ray starting where the first camera is.
pub fn estimate(world: &World, ray: Ray, count: u32) -> Moments {
    let mut moments = Moments::new();
    for index in 0..count {
        moments.push(f64::from(sample(world, ray, world.camera_media[0].clone(), index)));
    }
    moments
}

/// Fails unless `moments` agrees with `expected` within four standard errors, or a fraction of 1e-4.
pub fn assert_mean(moments: &Moments, expected: f64, what: &str) {
    let error = moments.variance_of_mean().sqrt();
    let allowed = 4.0 * error + 1e-4 * expected.abs();
    let mean = moments.mean();
    assert!((mean - expected).abs() <= allowed, "{what}: {mean} ± {error}, expected {expected}");
}

/// The six walls of a cube from -1 to 1, each of the material 'matte'.
pub fn walls(kit: &mut SceneKit) {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    for (name, center, half_u, half_v) in [
        ("left", -x, y, z),
        ("right", x, y, z),
        ("back", -z, x, y),
        ("front", z, x, y),
        ("floor", -y, x, z),
        ("ceiling", y, x, z),
    ] {
        kit.surface(name, rectangle(center, half_u, half_v), "matte");
    }
}

/// A matte ball with things in it, all of finite curvature, so that no look-up reaches over an edge.
pub fn hollow(lamp: impl FnOnce(&mut SceneKit)) -> SceneKit {
    let mut kit = SceneKit::new();
    kit.matte("matte", 0.7).surface("wall", sphere(DVec3::ZERO, 2.0), "matte");
    kit.medium("glass", 1.5).solid("lens", sphere(DVec3::new(0.5, -0.5, -0.8), 0.6), "glass");
    lamp(&mut kit);
    kit.camera(DVec3::new(0.0, 0.1, 1.2), DVec3::new(0.1, -0.2, -1.0));
    kit
}

pub fn lamp_ball(kit: &mut SceneKit) {
    kit.lamp("lamp", sphere(DVec3::new(-0.6, 0.9, 0.3), 0.3), 4.0);
}
