use super::triangle::LocalRay;
use super::*;
use crate::Candidate;
use crate::bvh::MeshBvh;
use hyaline_math::{Ray, Transform, Vec3};
use hyaline_testkit::{Random, chi_square};
use std::sync::Arc;

fn square() -> MeshData {
    MeshData {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..MeshData::default()
    }
}

fn hit(primitive: u32, barycentric: Vec2) -> Candidate {
    Candidate { t: 1.0, item: 0, primitive, barycentric }
}

#[test]
fn each_fault_is_named() {
    let faulty = |change: fn(&mut MeshData)| {
        let mut data = square();
        change(&mut data);
        Mesh::new(data).unwrap_err()
    };
    assert_eq!(faulty(|m| m.triangles.clear()), MeshError::Empty);
    assert_eq!(
        faulty(|m| m.triangles[1][2] = 4),
        MeshError::IndexOutOfRange { face: 1, index: 4, vertex_count: 4 }
    );
    assert_eq!(faulty(|m| m.positions[2].y = f32::NAN), MeshError::NonFinitePosition { vertex: 2 });
    assert_eq!(faulty(|m| m.positions[3].x = 1e20), MeshError::PositionTooLarge { vertex: 3 });
    assert_eq!(
        faulty(|m| m.normals = Some(vec![Vec3::Z; 3])),
        MeshError::WrongLength { list: "normals", expected: 4, found: 3 }
    );
    assert_eq!(faulty(|m| m.uvs = Some(vec![Vec2::INFINITY; 4])), MeshError::NonFiniteUv { vertex: 0 });
    assert_eq!(
        faulty(|m| m.face_slots = Some(vec![1; 3])),
        MeshError::WrongLength { list: "material slots", expected: 2, found: 3 }
    );
    assert_eq!(faulty(|m| m.positions = vec![Vec3::ONE; 4]), MeshError::NoFaceHasAnArea { face_count: 2 });
    assert!(faulty(|m| m.triangles[1][2] = 4).to_string().contains("face 1 refers to vertex 4"));
}

#[test]
fn degenerate_faces_are_dropped_with_their_slots() {
    let mut data = square();
    data.triangles = vec![[0, 0, 1], [0, 1, 2], [1, 3, 1], [0, 2, 3]];
    data.face_slots = Some(vec![5, 6, 7, 8]);
    let mesh = Mesh::new(data).unwrap();
    assert_eq!((mesh.dropped_faces(), mesh.face_count()), (2, 2));
    assert_eq!((mesh.face_slot(0), mesh.face_slot(1)), (6, 8));
}

#[test]
fn area_volume_and_bounds_of_a_cube_are_exact() {
    let mesh = Mesh::new(cube()).unwrap();
    assert_eq!(mesh.area(), 6.0);
    assert!((mesh.signed_volume() - 1.0).abs() < 1e-15);
    assert_eq!(mesh.bounds(), Bounds { min: Vec3::ZERO, max: Vec3::ONE });
    assert!(mesh.topology().is_closed());
}

/// The unit cube, each side with vertices of its own.
fn cube() -> MeshData {
    let mut data = MeshData::default();
    for axis in 0..3 {
        for upper in [false, true] {
            let first = data.positions.len() as u32;
            for (u, v) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
                let mut p = Vec3::ZERO;
                p[axis] = if upper { 1.0 } else { 0.0 };
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                data.positions.push(p);
            }
            for face in [[0, 1, 2], [0, 2, 3]] {
                let [a, b, c] = face.map(|i| i + first);
                data.triangles.push(if upper { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    data
}

#[test]
fn open_and_flipped_edges_are_counted() {
    assert_eq!(Mesh::new(square()).unwrap().topology(), MeshTopology { open_edges: 4, flipped_edges: 0 });
    let mut holed = cube();
    holed.triangles.pop();
    assert_eq!(Mesh::new(holed).unwrap().topology(), MeshTopology { open_edges: 3, flipped_edges: 0 });
    let mut flipped = cube();
    flipped.triangles[0].swap(0, 1);
    assert_eq!(Mesh::new(flipped).unwrap().topology(), MeshTopology { open_edges: 0, flipped_edges: 3 });
}

#[test]
fn the_geometric_normal_follows_the_winding_and_the_shading_normal_follows_it() {
    let mut data = square();
    data.normals = Some(vec![Vec3::new(0.6, 0.0, -0.8), Vec3::X, Vec3::ZERO, Vec3::new(0.0, 0.0, -2.0)]);
    let mesh = Mesh::new(data.clone()).unwrap();
    let surface = mesh.surface(&hit(1, Vec2::new(0.0, 0.5)), None);
    assert_eq!(surface.ng, Vec3::Z);
    assert!((surface.n - Vec3::new(-0.3, 0.0, 0.9).normalize()).length() < 1e-6, "{}", surface.n);
    data.shading = Shading::Flat;
    assert_eq!(Mesh::new(data).unwrap().surface(&hit(1, Vec2::new(0.0, 0.5)), None).n, Vec3::Z);
    // A mirror turns the winding around but leaves the outside outside.
    let mirror = Transform::scale(hyaline_math::DVec3::new(1.0, 1.0, -1.0)).unwrap();
    assert_eq!(mesh.surface(&hit(0, Vec2::ZERO), Some(&mirror)).ng, Vec3::NEG_Z);
}

#[test]
fn texture_coordinates_and_their_derivative_are_linear_on_a_face() {
    let mut data = square();
    data.uvs = Some(vec![Vec2::new(1.0, 0.0), Vec2::new(3.0, 0.0), Vec2::new(3.0, 4.0), Vec2::new(1.0, 4.0)]);
    let mesh = Mesh::new(data.clone()).unwrap();
    let surface = mesh.surface(&hit(0, Vec2::new(0.25, 0.5)), None);
    assert_eq!((surface.p, surface.uv), (Vec3::new(0.75, 0.5, 0.0), Vec2::new(2.5, 2.0)));
    let tangents = mesh.tangents(0, None);
    assert!((tangents.dpdu - 0.5 * Vec3::X).length() < 1e-6);
    assert!((tangents.dpdv - 0.25 * Vec3::Y).length() < 1e-6);
    data.uvs = Some(vec![Vec2::ONE; 4]);
    let constant = Mesh::new(data).unwrap().tangents(0, None);
    assert!((constant.dpdu.length() - 1.0).abs() < 1e-6 && constant.dpdu.dot(Vec3::Z).abs() < 1e-6);
    assert!((constant.dpdu.cross(constant.dpdv) - Vec3::Z).length() < 1e-6);
}

#[test]
fn the_error_bound_of_a_point_holds() {
    let mut random = Random::from_seed(11);
    for _ in 0..200_000 {
        let scale = 10_f64.powi(random.between(-3.0, 4.0) as i32);
        let mut corner =
            || Vec3::from_array(random.direction().map(|x| (x * scale) as f32)) + 0.3 * scale as f32;
        let positions = vec![corner(), corner(), corner()];
        let data = MeshData { positions, triangles: vec![[0, 1, 2]], ..MeshData::default() };
        let mesh = Mesh::new(data).unwrap();
        let (v, w) = (0.5 * random.uniform_f32(), 0.5 * random.uniform_f32());
        let point = mesh.point(0, Vec2::new(v, w), None);
        let [a, b, c] = mesh.corners(0).map(|p| p.as_dvec3());
        let n = (b - a).cross(c - a).normalize();
        let distance = n.dot(point.p.as_dvec3() - a).abs();
        assert!(distance <= f64::from(point.p_error), "{distance} > {}", point.p_error);
        assert!(point.p_error < 1e-6 * scale as f32);
    }
}

/// Distance and barycentric coordinates by Cramer's rule in `f64`, and how far from an edge, relatively.
fn reference(ray: &Ray, corners: [Vec3; 3]) -> (f64, [f64; 3], f64) {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let (ab, ac, ao) = (b - a, c - a, o - a);
    let n = ab.cross(ac);
    let determinant = -d.dot(n);
    let v = ac.dot(ao.cross(d)) / determinant;
    let w = -ab.dot(ao.cross(d)) / determinant;
    let weights = [1.0 - v - w, v, w];
    (ao.dot(n) / determinant, weights, weights.into_iter().fold(f64::INFINITY, |m, x| m.min(x.abs())))
}

#[test]
fn triangles_are_crossed_where_algebra_says() {
    let mut random = Random::from_seed(12);
    let mut hits = 0;
    for _ in 0..200_000 {
        let mut vector = |size: f32| Vec3::from_array(random.direction().map(|x| x as f32)) * size;
        let corners = [vector(1.0), vector(1.0), vector(1.0)];
        let (origin, target) = (vector(2.0), vector(0.5));
        let ray = Ray::new(origin, (target - origin).normalize());
        let (t, weights, margin) = reference(&ray, corners);
        let grazing = doubled_area(corners.map(|p| p.as_dvec3())).dot(ray.direction.as_dvec3()).abs();
        if margin < 1e-9 || t.abs() < 1e-9 || grazing < 1e-6 {
            continue;
        }
        let found = LocalRay::from_world(&ray).triangle(corners);
        let expected = t > 0.0 && weights.into_iter().all(|w| w > 0.0);
        assert_eq!(found.is_some(), expected, "{corners:?} {ray:?}");
        if let Some(found) = found {
            hits += 1;
            assert!((f64::from(found.t) - t).abs() < 1e-6 * t.abs());
            assert!((f64::from(found.barycentric.x) - weights[1]).abs() < 1e-6);
            assert!((f64::from(found.barycentric.y) - weights[2]).abs() < 1e-6);
        }
    }
    assert!(hits > 20_000, "{hits}");
}

#[test]
fn the_ends_of_the_interval_are_excluded() {
    let corners = [Vec3::new(-1.0, -1.0, 2.0), Vec3::new(1.0, -1.0, 2.0), Vec3::new(0.0, 1.0, 2.0)];
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let t =
        |t_min, t_max| LocalRay::from_world(&Ray { t_min, t_max, ..ray }).triangle(corners).map(|hit| hit.t);
    assert_eq!(t(0.0, f32::INFINITY), Some(2.0));
    assert_eq!(t(0.0, 2.0), None);
    assert_eq!(t(2.0, 3.0), None);
    assert_eq!(t(2.0_f32.next_down(), 2.0_f32.next_up()), Some(2.0));
}

#[test]
fn a_ray_through_an_edge_or_vertex_crosses_one_face_of_a_fan() {
    // A fan about the z axis, seen along it: the common vertex and the edges are met exactly.
    let rim: Vec<Vec3> = [(4, 1), (1, 3), (-2, 3), (-3, -1), (-1, -2), (2, -3)]
        .map(|(x, y)| Vec3::new(x as f32, y as f32, 1.0))
        .to_vec();
    for target in [Vec3::Z, Vec3::new(2.0, 0.5, 1.0), Vec3::new(-1.0, 1.5, 1.0), Vec3::new(-0.5, -1.0, 1.0)] {
        let origin = target - 5.0 * Vec3::Z;
        for scale in [1e-3, 1.0, 1e4_f32] {
            let ray = LocalRay::from_world(&Ray::new(origin * scale, Vec3::Z));
            let crossed = (0..rim.len())
                .filter(|&i| {
                    let corners = [Vec3::Z, rim[i], rim[(i + 1) % rim.len()]].map(|p| p * scale);
                    ray.triangle(corners).is_some()
                })
                .count();
            assert_eq!(crossed, 1, "{target} at {scale}");
        }
    }
}

#[test]
fn rays_without_a_direction_hit_nothing() {
    let corners = [Vec3::new(-1.0, -1.0, 2.0), Vec3::new(1.0, -1.0, 2.0), Vec3::new(0.0, 1.0, 2.0)];
    for direction in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        let ray = Ray::new(Vec3::ZERO, direction);
        assert_eq!(LocalRay::from_world(&ray).triangle(corners), None);
    }
}

#[test]
fn samples_are_uniform_by_area() {
    let transform = Transform::scale(hyaline_math::DVec3::new(3.0, 1.0, 0.5)).unwrap();
    let data = generate::displaced_sphere(Vec3::ZERO, 1.0, 300, 0.2);
    for transform in [None, Some(transform)] {
        let bvh = Arc::new(MeshBvh::new(Mesh::new(data.clone()).unwrap()));
        let sampler = MeshSampler::new(bvh.clone(), transform);
        let (counts, expected) = octant_counts(&bvh, &sampler, transform);
        let result = chi_square(&counts, &expected, 5.0);
        assert!(result.p_value > 0.001, "{result:?}");
    }
}

/// Samples found in, and expected in, each face quartered: by its corners and its middle.
fn octant_counts(bvh: &MeshBvh, sampler: &MeshSampler, transform: Option<Transform>) -> (Vec<f64>, Vec<f64>) {
    let mesh = bvh.mesh();
    let sample_count = 200_000;
    let place = |p: Vec3| transform.map_or(p.as_dvec3(), |t| t.point(p.as_dvec3()));
    let mut counts = vec![0.0; 4 * mesh.face_count()];
    let mut random = Random::from_seed(13);
    for _ in 0..sample_count {
        let sample = sampler.sample(Vec2::new(random.uniform_f32(), random.uniform_f32()));
        let (face, weights) = locate(mesh, &place, sample.p);
        let quarter = weights.iter().position(|&w| w > 0.5).unwrap_or(3);
        counts[4 * face + quarter] += 1.0;
        assert!((f64::from(sample.pdf_a) * sampler.area() - 1.0).abs() < 1e-6);
    }
    let area = |face| 0.5 * doubled_area(mesh.corners(face as u32).map(place)).length();
    let expected = (0..counts.len()).map(|i| sample_count as f64 * 0.25 * area(i / 4) / sampler.area());
    (counts, expected.collect())
}

/// The face whose plane and edges hold the point best, and the weights of its corners.
fn locate(mesh: &Mesh, place: &impl Fn(Vec3) -> DVec3, p: Vec3) -> (usize, [f64; 3]) {
    let fit = |face: u32| {
        let [a, b, c] = mesh.corners(face).map(place);
        let n = doubled_area([a, b, c]);
        let q = p.as_dvec3() - a;
        let v = q.cross(c - a).dot(n) / n.length_squared();
        let w = (b - a).cross(q).dot(n) / n.length_squared();
        let outside = -(1.0 - v - w).min(v).min(w).min(0.0);
        (outside + n.normalize().dot(q).abs(), [1.0 - v - w, v, w])
    };
    let faces = (0..mesh.face_count()).map(|face| (face, fit(face as u32)));
    let (face, (_, weights)) = faces.min_by(|a, b| a.1.0.total_cmp(&b.1.0)).unwrap();
    (face, weights)
}
