//! Tests of all lights: samplers against their densities, weights against power, irradiance against closed forms.

mod direct;
mod direction_test;
mod emission;
mod irradiance;

use super::*;
use direction_test::direction_test;
use hyaline_geometry::mesh::{MeshData, MeshSampler};
use hyaline_geometry::shape::{Rectangle, RevolvedArc, RevolvedSegment, Sphere, WHOLE_TURN};
use hyaline_geometry::{Aggregate, Item, ItemGeometry, Mesh, Primitive, Shape, bvh::MeshBvh};
use hyaline_math::float::f64 as float;
use hyaline_math::{DVec3, Ray, Transform};
use hyaline_scene::SpotFalloff;
use hyaline_testkit::Random;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Lanes in use in these tests.
const LANES: usize = 3;

/// Radiance of the lights with a surface.
const L: f32 = 2.5;

/// A light with a surface, and that surface for rays to meet.
struct Lamp {
    name: &'static str,
    light: Light,
    geometry: Aggregate,
    /// A ball about it.
    center: Vec3,
    radius: f32,
}

impl Lamp {
    fn of_shape(name: &'static str, shape: Shape, placement: Transform, sides: ShiningSides) -> Self {
        let primitive = Primitive::new(shape).placed(&placement);
        let light = Light::Shape(ShapeLight::new(primitive, Spectrum::splat(L), sides));
        Self::new(name, light, ItemGeometry::Shape(primitive))
    }

    fn of_mesh(
        name: &'static str,
        data: MeshData,
        transform: Option<Transform>,
        sides: ShiningSides,
    ) -> Self {
        let mesh = Arc::new(MeshBvh::new(Mesh::new(data).expect("a valid mesh")));
        let sampler = MeshSampler::new(mesh.clone(), transform);
        let light = Light::Mesh(MeshLight::new(sampler, Spectrum::splat(L), sides));
        Self::new(name, light, ItemGeometry::Mesh { mesh, transform })
    }

    fn new(name: &'static str, light: Light, geometry: ItemGeometry) -> Self {
        let geometry = Aggregate::build(vec![Item { geometry, mask: u8::MAX }]);
        let (center, radius) = (geometry.bounds().center(), geometry.bounds().radius());
        Self { name, light, geometry, center, radius }
    }

    /// All places where a ray meets the lamp.
    fn hits(&self, p: Vec3, wi: Vec3) -> Vec<SurfaceHit> {
        let ray = Ray::new(p, wi);
        let mut candidates = Vec::new();
        self.geometry.crossings(&ray, u8::MAX, &mut |candidate| candidates.push(candidate));
        candidates.iter().map(|candidate| self.geometry.surface(&ray, candidate)).collect()
    }

    /// A direction to a place that is not seen edge-on: toward the outline of a curved lamp that is sampled by area the
    /// density has no bound, and no quadrature integrates it.
    fn sample_clearly(&self, p: Vec3, u: Vec2) -> Option<Vec3> {
        let sample = self.light.sample_direct(p, u)?;
        let target = sample.target.expect("a lamp has a surface");
        is_seen_clearly(target.n, sample.wi).then_some(sample.wi)
    }

    /// Density of `sample_clearly`: that of all places a direction leads to.
    fn pdf_clearly(&self, p: Vec3, wi: Vec3) -> f64 {
        let hits = self.hits(p, wi);
        let clear = hits.iter().filter(|hit| is_seen_clearly(hit.ng, wi));
        clear.map(|hit| f64::from(self.light.pdf_direct(p, wi, Some(hit)))).sum()
    }
}

fn is_seen_clearly(n: Vec3, wi: Vec3) -> bool {
    n.dot(wi).abs() > 0.1
}

fn sphere(radius: f64) -> Shape {
    Shape::Sphere(Sphere::new(radius).expect("a valid sphere"))
}

fn rectangle(half_u: DVec3, half_v: DVec3) -> Shape {
    Shape::Rectangle(Rectangle::new(DVec3::ZERO, half_u, half_v).expect("a valid rectangle"))
}

fn disc(radius: f64) -> Shape {
    Shape::Segment(RevolvedSegment::disc(radius, 0.0, 0.0, WHOLE_TURN).expect("a valid disc"))
}

fn square(half: f64) -> Shape {
    rectangle(DVec3::Z * half, DVec3::X * half)
}

/// A turn and a shift, and a scale alike in all directions.
fn placed(scale: f64) -> Transform {
    let turn = Transform::rotate(DVec3::new(1.0, 2.0, -0.5), 0.8).unwrap();
    let shift = Transform::translate(DVec3::new(0.3, -0.2, 0.1));
    shift.after(&turn).after(&Transform::scale(DVec3::splat(scale)).unwrap())
}

/// Two triangles that make the square of `square(half)`.
fn square_mesh(half: f32) -> MeshData {
    let corner = |x: f32, z: f32| Vec3::new(x * half, 0.0, z * half);
    MeshData {
        positions: vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..MeshData::default()
    }
}

/// One of each kind of lamp, about as large as the unit sphere and near the origin.
fn lamps() -> Vec<Lamp> {
    use ShiningSides::{Both, Outer};
    let uneven = placed(1.0).after(&Transform::scale(DVec3::new(1.0, 0.5, 0.8)).unwrap());
    let mirrored = Transform::scale(DVec3::new(1.0, 1.0, -0.7)).unwrap();
    let half_sphere = Sphere::part(0.8, WHOLE_TURN, [0.0, 0.5 * PI]).unwrap();
    let torus = RevolvedArc::torus(0.7, 0.25, WHOLE_TURN, WHOLE_TURN).unwrap();
    let cylinder = RevolvedSegment::cylinder(0.4, [-0.5, 0.5], [0.3, 4.0]).unwrap();
    let slanted = rectangle(DVec3::X * 0.6, DVec3::new(0.3, 0.5, 0.0));
    let tetrahedron = MeshData {
        positions: vec![Vec3::ZERO, Vec3::X * 0.9, Vec3::Y * 0.7, Vec3::Z * 0.8],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        ..MeshData::default()
    };
    vec![
        Lamp::of_shape("sphere", sphere(0.7), placed(1.2), Outer),
        Lamp::of_shape("two-sided sphere", sphere(0.7), placed(1.0), Both),
        Lamp::of_shape("ellipsoid", sphere(0.9), uneven, Outer),
        Lamp::of_shape("half sphere", Shape::Sphere(half_sphere), placed(1.0), Both),
        Lamp::of_shape("rectangle", rectangle(DVec3::X * 0.8, DVec3::Y * 0.3), placed(1.1), Outer),
        Lamp::of_shape("two-sided rectangle", square(0.5), placed(1.0), Both),
        Lamp::of_shape("mirrored rectangle", rectangle(DVec3::X, DVec3::Z), mirrored, Outer),
        Lamp::of_shape("parallelogram", slanted, placed(1.0), Outer),
        Lamp::of_shape("disc", disc(0.7), placed(1.0), Outer),
        Lamp::of_shape("torus", Shape::Arc(torus), placed(1.0), Outer),
        Lamp::of_shape("part cylinder", Shape::Segment(cylinder), uneven, Both),
        Lamp::of_mesh("square mesh", square_mesh(0.5), None, Outer),
        Lamp::of_mesh("tetrahedron", tetrahedron, Some(placed(0.9)), Both),
    ]
}

const SCENE: SceneSphere = SceneSphere { center: Vec3::new(1.0, -2.0, 0.5), radius: 3.0 };

/// An image with a bright spot, black parts, and noise.
fn sky_image() -> SkyImage {
    let mut random = Random::from_seed(9);
    let pixels = (0..16 * 8).map(|i| {
        let (x, y) = (i % 16, i / 16);
        let noise = [(); 3].map(|()| if x < 6 { 0.0 } else { random.uniform_f32() });
        let sun = if (x, y) == (12, 2) { 40.0 } else { 0.0 };
        Spectrum::from_lanes([noise[0] + sun, noise[1] + sun, noise[2] + 0.5 * sun, 0.0])
    });
    SkyImage::new(16, 8, pixels.collect()).expect("a valid image")
}

fn image_sky() -> Light {
    Light::Environment(EnvironmentLight::from_image(sky_image(), &placed(2.0), LANES, SCENE))
}

fn constant_sky() -> Light {
    Light::Environment(EnvironmentLight::from_constant(Spectrum::splat(L), SCENE))
}

fn directional() -> Light {
    let direction = Vec3::new(0.48, -0.6, 0.64);
    Light::Directional(DirectionalLight { direction, irradiance: Spectrum::splat(L), scene: SCENE })
}

fn spot(outer_angle: f32, inner_angle: f32, falloff: SpotFalloff) -> Light {
    let axis = Vec3::new(0.48, -0.6, 0.64);
    Light::Spot(SpotLight::new(Vec3::ONE, axis, Spectrum::splat(L), outer_angle, inner_angle, falloff))
}

fn spots() -> Vec<Light> {
    use SpotFalloff::{LinearInAngle, Smooth};
    let angles = [(0.6, 0.3), (0.01, 0.004), (1.2, 1.2), (2.5, 0.0)];
    angles.iter().flat_map(|&(outer, inner)| [Smooth, LinearInAngle].map(|f| spot(outer, inner, f))).collect()
}

fn projectors() -> Vec<Light> {
    let mut random = Random::from_seed(4);
    let pixels = (0..7 * 5).map(|i| {
        let noise = [(); 3].map(|()| if i % 7 < 2 || i / 7 == 3 { 0.0 } else { random.uniform_f32() });
        Spectrum::from_lanes([noise[0], noise[1], noise[2], 0.0])
    });
    let slide = Slide::new(7, 5, pixels.collect(), LANES);
    let one = |fov: f32, slide: Option<Slide>| {
        Light::Projector(ProjectorLight::new(&placed(1.3), fov, Spectrum::splat(L), slide))
    };
    vec![one(1.1, slide), one(0.7, None)]
}

/// All lights without a surface.
fn bare_lights() -> Vec<Light> {
    let point = PointLight { position: Vec3::new(0.5, 0.25, -1.0), intensity: Spectrum::splat(L) };
    let mut lights = spots();
    lights.extend(projectors());
    lights.extend([Light::Point(point), directional(), constant_sky(), image_sky()]);
    lights
}

fn random_pair(random: &mut Random) -> Vec2 {
    Vec2::new(random.uniform_f32(), random.uniform_f32())
}

fn to_array(v: Vec3) -> [f64; 3] {
    v.as_dvec3().to_array()
}

fn to_vector(v: [f64; 3]) -> Vec3 {
    DVec3::from_array(v).as_vec3()
}
