//! Looking through an object at the checkered walls of a room, with the renderer and with the f64 tracer at once.
//!
//! 1. A random ray is followed by both, through everything at every boundary or reflected at one of them.
//! 2. The tracer also follows what leaves each boundary 2e-6 of the scene's size beside the path: how far that ends from
//!    the path's end tells how much the path magnifies an error made there. Where it meets other boundaries, the ray is
//!    too near to an edge, to grazing or to the critical angle for `f32` to decide, and is left out. Such rays are
//!    counted, and there may be few.
//! 3. The media met must be the same, the ends as near to each other as roundings allow, the square of the wall of
//!    the same color, the weight the same.
#![allow(unreachable_pub, reason = "the module is a part of a test, not of a library")]

use crate::scene_kit::SceneKit;
use crate::snell_tracer::{self, Choices, Medium, Path, Scene, Step};
use hyaline_math::{DVec3, Ray, Vec3, offset_origin};
use hyaline_scattering::MediumSet;
use hyaline_scene::{ColorSource, MaterialKind, TextureDescription, TextureKind};
use hyaline_testkit::Random;
use hyaline_transport::Stats;
use hyaline_transport::walk::{self, Event};
use hyaline_world::{World, mask};

/// Rays per object.
const RAYS: usize = 6_000;
/// Fraction of the rays that may be undecided.
const UNDECIDED: f64 = 0.01;
/// Squares along each edge of a wall.
const SQUARES: f64 = 200.0;
/// Boundaries after which a path is given up.
const LONGEST: usize = 12;
/// Distance of the neighboring rays, relative to the scene's size.
const BESIDE: f64 = 2e-6;
/// Roundings of `f32`, relative to the scene's size, that each boundary may add before the rest of the path magnifies
/// them: to the point, its normal, the offset of the next ray's start and its direction.
const ROUNDINGS: f64 = 8.0;

const LIGHT: f32 = 0.75;
const DARK: f32 = 0.25;

/// Where the rays of a comparison come from.
pub enum Rays {
    /// From all around the scene towards points of a ball.
    Towards { center: DVec3, radius: f64 },
    /// From one point in every direction; the point is where the camera of the kit stands.
    From(DVec3),
}

/// Fails unless renderer and tracer see the same through the objects of `kit`, which `scene` describes too.
pub fn assert_same_view(kit: &SceneKit, scene: &Scene, rays: &Rays, what: &str) {
    let mut kit = kit.clone();
    if let Rays::From(p) = rays {
        kit.camera(*p, *p + DVec3::X);
    } else {
        kit.camera(DVec3::new(0.0, 0.0, 4.0 * scene.size), DVec3::ZERO);
    }
    add_room(&mut kit, scene.room);
    let world = kit.world();
    let mut random = Random::from_seed(29);
    let mut tally = Tally::default();
    for _ in 0..RAYS {
        let ray = random_ray(&mut random, rays, scene.size);
        let reflect_at = (random.uniform() < 0.5).then(|| (random.uniform() * 5.0) as usize);
        let choices = Choices { reflect_at, longest: LONGEST };
        match traced(scene, &ray, choices) {
            None => tally.undecided += 1,
            Some((path, spread)) => {
                let seen = follow(&world, ray, choices);
                tally.compare(scene, &path, &spread, &seen, &format!("{what}: {ray:?} {choices:?}"));
            }
        }
    }
    tally.assert_plausible(what);
}

/// What became of all the rays.
#[derive(Default)]
struct Tally {
    undecided: usize,
    compared: usize,
    boundaries: usize,
    got_out: usize,
    /// Largest error over what is allowed.
    worst: f64,
}

impl Tally {
    fn compare(&mut self, scene: &Scene, path: &Path, spread: &Spread, seen: &Seen, what: &str) {
        let expected: Vec<_> = path.steps.iter().map(|s| (s.from, s.to, s.transmits)).collect();
        assert_eq!(seen.boundaries, expected, "{what}: other media than {path:?}");
        assert_eq!(seen.albedo.is_some(), path.got_out, "{what}: {path:?}");
        self.compared += 1;
        self.boundaries += expected.len();
        let roundings = ROUNDINGS * f64::from(f32::EPSILON);
        let allowed = roundings * scene.size * spread.end;
        let error = (seen.end - path.end).length();
        assert!(error <= allowed, "{what}: ends {error:e} off, {allowed:e} are allowed: {path:?}");
        let turned = (seen.direction - path.direction).length();
        let may_turn = roundings * spread.direction;
        assert!(turned <= may_turn, "{what}: is turned by {turned:e}, {may_turn:e} are allowed: {path:?}");
        let (change, may_change) = ((seen.weight - path.weight).abs(), roundings * spread.weight);
        assert!(change <= may_change, "{what}: weighs {} not {}: {path:?}", seen.weight, path.weight);
        self.worst =
            [error / allowed, turned / may_turn, change / may_change].into_iter().fold(self.worst, f64::max);
        if let Some(albedo) = seen.albedo {
            self.got_out += 1;
            let (square, to_edge) = square_of(path.end, scene.room);
            assert!(albedo == square || to_edge <= allowed, "{what}: sees {albedo}, not {square}: {path:?}");
        }
    }

    fn assert_plausible(&self, what: &str) {
        let undecided = self.undecided as f64 / RAYS as f64;
        println!(
            "{what}: {} boundaries on {} paths, {} undecided, worst {}",
            self.boundaries, self.compared, self.undecided, self.worst
        );
        assert!(undecided <= UNDECIDED, "{what}: {} of {RAYS} rays are undecided", self.undecided);
        assert!(self.boundaries > RAYS, "{what}: only {} boundaries were met", self.boundaries);
        assert!(self.got_out > RAYS / 4, "{what}: only {} rays got out", self.got_out);
    }
}

/// A ray of single precision, as both sides are given it.
fn random_ray(random: &mut Random, rays: &Rays, size: f64) -> Ray {
    let direction = |random: &mut Random| DVec3::from_array(random.direction());
    match *rays {
        Rays::Towards { center, radius } => {
            let from = (center + direction(random) * 3.0 * size).as_vec3();
            let to = (center + direction(random) * (radius * random.uniform())).as_vec3();
            Ray::new(from, (to - from).normalize())
        }
        Rays::From(p) => Ray::new(p.as_vec3(), direction(random).as_vec3().normalize()),
    }
}

/// How much of what each boundary and the start are off by arrives, summed; at least what a straight way makes of it.
#[derive(Default)]
struct Spread {
    end: f64,
    direction: f64,
    weight: f64,
}

/// The tracer's path along `ray` and its spread; `None` where rays beside it take another way.
fn traced(scene: &Scene, ray: &Ray, choices: Choices) -> Option<(Path, Spread)> {
    let ray =
        snell_tracer::Ray { origin: ray.origin.as_dvec3(), direction: ray.direction.as_dvec3().normalize() };
    let path = scene.follow(ray, choices)?;
    let mut spread = Spread::default();
    add_spread(scene, &path, 0, ray, ray.direction, choices, &mut spread)?;
    for (count, step) in (1..).zip(&path.steps) {
        let onward = snell_tracer::Ray { origin: step.p, direction: step.next };
        add_spread(scene, &path, count, onward, step.n, choices, &mut spread)?;
    }
    Some((path, spread))
}

/// Follows the rest of `path` after `count` boundaries from places beside `onward`, shifted across `n`.
fn add_spread(
    scene: &Scene,
    path: &Path,
    count: usize,
    onward: snell_tracer::Ray,
    n: DVec3,
    choices: Choices,
    spread: &mut Spread,
) -> Option<()> {
    let medium = match path.steps[..count].last() {
        Some(step) => {
            if step.transmits {
                step.to
            } else {
                step.from
            }
        }
        None => (scene.medium_at)(onward.origin),
    };
    let way = |steps: &[Step]| -> Vec<(Medium, Medium, bool)> {
        steps.iter().map(|step| (step.from, step.to, step.transmits)).collect()
    };
    let (s, t) = n.any_orthonormal_pair();
    let (u, v) = onward.direction.any_orthonormal_pair();
    let mut most = Spread { end: 6.0, direction: 2.0, weight: 2.0 * path.weight };
    let rest_weight = scene.follow_from(onward, medium, count, choices)?.weight;
    for (shift, turn) in [(s, u), (t, -u), (-s - t, v), (s - t, -v)] {
        let origin = onward.origin + shift * (BESIDE * scene.size);
        let beside = snell_tracer::Ray { origin, direction: (onward.direction + turn * BESIDE).normalize() };
        let other = scene.follow_from(beside, medium, count, choices)?;
        if way(&other.steps) != way(&path.steps[count..]) {
            return None;
        }
        most.end = most.end.max((other.end - path.end).length() / (BESIDE * scene.size));
        most.direction = most.direction.max((other.direction - path.direction).length() / BESIDE);
        most.weight = most.weight.max((other.weight / rest_weight - 1.0).abs() * path.weight / BESIDE);
    }
    spread.end += most.end;
    spread.direction += most.direction;
    spread.weight += most.weight;
    Some(())
}

/// What the renderer finds along a ray.
struct Seen {
    boundaries: Vec<(Medium, Medium, bool)>,
    end: DVec3,
    direction: DVec3,
    weight: f64,
    /// Of the square of the wall, where the path got so far.
    albedo: Option<f32>,
}

fn follow(world: &World, mut ray: Ray, choices: Choices) -> Seen {
    let mut set: MediumSet = world.camera_media[0].clone();
    let mut stats = Stats::default();
    let mut seen =
        Seen { boundaries: Vec::new(), end: DVec3::ZERO, direction: DVec3::ZERO, weight: 1.0, albedo: None };
    while seen.boundaries.len() < choices.longest && seen.albedo.is_none() {
        let Event::Surface(vertex) = walk::advance(world, &ray, mask::PATH, &mut set, &mut stats) else {
            panic!("the walls of the room have a gap: {ray:?}");
        };
        assert!(stats.never_entered.is_empty(), "{ray:?} leaves what it never entered");
        seen.end = vertex.hit.p.as_dvec3();
        seen.direction = ray.direction.as_dvec3();
        if !vertex.bsdf.is_delta() {
            seen.albedo = Some(vertex.bsdf.albedo_estimate().mean(world.lanes));
            break;
        }
        let branches = vertex.bsdf.branches(-ray.direction);
        let find = |transmits: bool| branches.iter().flatten().find(|branch| branch.transmits == transmits);
        let is_through = choices.reflect_at != Some(seen.boundaries.len());
        let branch = find(true).filter(|_| is_through).or(find(false));
        let branch = branch.expect("light goes on from a clear boundary");
        let (from, to) = (set.active(), vertex.far_set(world, &set).active());
        seen.boundaries.push((from.index(), to.index(), branch.transmits));
        seen.weight *= f64::from(branch.weight.mean(world.lanes));
        if branch.transmits {
            vertex.commit(world, &mut set);
        }
        let origin: Vec3 = offset_origin(vertex.hit.p, vertex.hit.p_error, vertex.hit.ng, branch.wi);
        ray = Ray::new(origin, branch.wi);
        seen.direction = branch.wi.as_dvec3();
    }
    seen
}

/// Encloses everything in a cube of checkered walls.
fn add_room(kit: &mut SceneKit, room: f64) {
    let periods = (0.5 * SQUARES) as f32;
    let checker = TextureDescription {
        uv_transform: [[periods, 0.0, 0.0], [0.0, periods, 0.0]],
        ..TextureDescription::new("checker", TextureKind::Checker { even: [LIGHT; 3], odd: [DARK; 3] })
    };
    kit.description.textures.push(checker.into());
    kit.material("wall", MaterialKind::Matte { reflectance: ColorSource::Texture("checker".into()) });
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let center = DVec3::AXES[axis] * (side * room);
            let [u, v] = [1, 2].map(|step| DVec3::AXES[(axis + step) % 3] * room);
            kit.surface("wall", crate::scene_kit::rectangle(center, u, v), "wall");
        }
    }
}

/// Reflectance of the square at a place on the walls, and the distance to the nearest edge of it.
fn square_of(p: DVec3, room: f64) -> (f32, f64) {
    let axis = (0..3).max_by(|&i, &j| p[i].abs().total_cmp(&p[j].abs())).unwrap_or(0);
    let along = [1, 2].map(|step| (p[(axis + step) % 3] + room) / (2.0 * room) * SQUARES);
    let is_even = (along[0].floor() as i64 + along[1].floor() as i64) % 2 == 0;
    let to_edge = along.map(|x| (x - x.round()).abs() * 2.0 * room / SQUARES);
    (if is_even { LIGHT } else { DARK }, to_edge[0].min(to_edge[1]))
}
