//! Closed meshes made in code, each of about a wanted number of triangles: for the gallery, tests and benchmarks.
//!
//! All are wound counter-clockwise seen from the outside, and have smooth vertex normals.

use super::MeshData;
use hyaline_math::float::f64::{cos, sin, sin_cos};
use hyaline_math::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// A sphere of rings and segments.
///
/// - `triangle_count`: wanted number of triangles, at least 8; the next smaller grid is taken.
pub fn uv_sphere(center: Vec3, radius: f32, triangle_count: usize) -> MeshData {
    displaced_sphere(center, radius, triangle_count, 0.0)
}

/// A sphere of rings and segments whose radius is rippled.
///
/// - `triangle_count`: wanted number of triangles, at least 8; the next smaller grid is taken.
/// - `amplitude`: height of the ripples as a fraction of the radius, 0…0.5.
pub fn displaced_sphere(center: Vec3, radius: f32, triangle_count: usize, amplitude: f64) -> MeshData {
    // A grid of r rings and 2 r segments has 2 r (2 r - 2) triangles.
    let rings = ((0.5 + (0.25 + triangle_count as f64 / 4.0).sqrt()) as usize).max(2);
    let segments = 2 * rings;
    let place = |polar: f64, azimuth: f64| {
        let ((sin_p, cos_p), (sin_a, cos_a)) = (sin_cos(polar), sin_cos(azimuth));
        let direction = DVec3::new(sin_p * cos_a, cos_p, sin_p * sin_a);
        let ripple = sin(9.0 * direction.x + 1.0) * sin(11.0 * direction.y) * sin(10.0 * direction.z + 2.0)
            + 0.3 * sin(41.0 * direction.x) * sin(37.0 * direction.y + 1.0) * sin(43.0 * direction.z);
        center + (direction * (f64::from(radius) * (1.0 + amplitude * ripple))).as_vec3()
    };
    let mut positions = vec![place(0.0, 0.0)];
    for ring in 1..rings {
        let polar = PI * ring as f64 / rings as f64;
        positions.extend((0..segments).map(|s| place(polar, TAU * s as f64 / segments as f64)));
    }
    positions.push(place(PI, 0.0));
    with_vertex_normals(positions, sphere_faces(rings as u32, segments as u32))
}

/// Faces of a sphere whose vertices are the upper pole, rings from above, and the lower pole.
fn sphere_faces(rings: u32, segments: u32) -> Vec<[u32; 3]> {
    let vertex = |ring: u32, segment: u32| 1 + (ring - 1) * segments + segment % segments;
    let last = 1 + (rings - 1) * segments;
    let mut triangles = Vec::new();
    for s in 0..segments {
        triangles.push([0, vertex(1, s + 1), vertex(1, s)]);
        for ring in 1..rings - 1 {
            let [a, b] = [vertex(ring, s), vertex(ring, s + 1)];
            let [c, d] = [vertex(ring + 1, s), vertex(ring + 1, s + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
        triangles.push([last, vertex(rings - 1, s), vertex(rings - 1, s + 1)]);
    }
    triangles
}

/// A sphere of equal faces: an icosahedron whose faces are split into a triangular grid.
///
/// - `triangle_count`: wanted number of triangles; the nearest 20 f² is taken, f = 1, 2, ...
pub fn icosphere(center: Vec3, radius: f32, triangle_count: usize) -> MeshData {
    let splits = ((triangle_count as f64 / 20.0).sqrt().round() as u32).max(1);
    let (corners, faces) = icosahedron();
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for face in faces {
        let first = positions.len() as u32;
        let [a, b, c] = face.map(|i| corners[i]);
        // Row by row from the corner a; row i has i + 1 vertices.
        let vertex = |row: u32, column: u32| first + row * (row + 1) / 2 + column;
        for row in 0..=splits {
            for column in 0..=row {
                // The weighted sum is the same, bit for bit, from both faces of an edge: the corner off the edge
                // has weight 0, and the sum of two products commutes.
                let [w_a, w_b, w_c] = [splits - row, row - column, column].map(f64::from);
                let p = (a * w_a + b * w_b) + c * w_c;
                positions.push(center + (p.normalize() * f64::from(radius)).as_vec3());
                if row < splits {
                    triangles.push([
                        vertex(row, column),
                        vertex(row + 1, column),
                        vertex(row + 1, column + 1),
                    ]);
                }
                if row < splits && column < row {
                    triangles.push([
                        vertex(row, column),
                        vertex(row + 1, column + 1),
                        vertex(row, column + 1),
                    ]);
                }
            }
        }
    }
    let normals = positions.iter().map(|&p| (p - center).normalize_or_zero()).collect();
    MeshData { positions, normals: Some(normals), triangles, ..MeshData::default() }
}

/// Unit vertices and outward faces.
fn icosahedron() -> (Vec<DVec3>, [[usize; 3]; 20]) {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut corners = Vec::new();
    for (x, y) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        corners.push(DVec3::new(x, y, 0.0));
    }
    for (y, z) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        corners.push(DVec3::new(0.0, y, z));
    }
    for (z, x) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        corners.push(DVec3::new(x, 0.0, z));
    }
    let corners = corners.into_iter().map(|p| p.normalize()).collect();
    let faces = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (corners, faces)
}

/// A rippled tube along a (2, 3) torus knot.
///
/// - `size`: the knot fits into a ball of this radius.
/// - `triangle_count`: wanted number of triangles, at least 128; the next smaller grid is taken.
/// - `amplitude`: height of the ripples as a fraction of the tube's radius, 0…0.3.
pub fn torus_knot(center: Vec3, size: f32, triangle_count: usize, amplitude: f64) -> MeshData {
    // A tube is about sixteen times as long as around.
    let around = ((triangle_count as f64 / 32.0).sqrt() as usize).max(3);
    let along = (triangle_count / (2 * around)).max(16);
    let curve = |s: f64| {
        let r = 2.0 + cos(3.0 * s);
        DVec3::new(r * cos(2.0 * s), sin(3.0 * s), r * sin(2.0 * s))
    };
    let scale = f64::from(size) / 4.0;
    let mut positions = Vec::with_capacity(along * around);
    for i in 0..along {
        let s = TAU * i as f64 / along as f64;
        let (p, ahead, behind) = (curve(s), curve(s + 1e-3), curve(s - 1e-3));
        let tangent = (ahead - behind).normalize();
        // The way off the axis of the torus is never parallel to the knot, so this frame closes.
        let side = tangent.cross(DVec3::new(p.x, 0.0, p.z)).normalize();
        let up = side.cross(tangent);
        for j in 0..around {
            let phi = TAU * j as f64 / around as f64;
            let ripple = 1.0 + amplitude * sin(60.0 * s + 4.0 * phi) * sin(37.0 * s - 5.0 * phi);
            let (sin_phi, cos_phi) = sin_cos(phi);
            let offset = (side * cos_phi + up * sin_phi) * (0.42 * ripple);
            positions.push(center + ((p + offset) * scale).as_vec3());
        }
    }
    with_vertex_normals(positions, tube_faces(along as u32, around as u32))
}

/// Faces of a closed tube, ring by ring.
fn tube_faces(along: u32, around: u32) -> Vec<[u32; 3]> {
    let vertex = |i: u32, j: u32| (i % along) * around + j % around;
    let mut triangles = Vec::new();
    for i in 0..along {
        for j in 0..around {
            let [a, b] = [vertex(i, j), vertex(i, j + 1)];
            let [c, d] = [vertex(i + 1, j), vertex(i + 1, j + 1)];
            triangles.extend([[a, d, b], [a, c, d]]);
        }
    }
    triangles
}

/// A hollow ball: an outer sphere, and an inner one whose faces look into the hollow.
///
/// - `thickness`: of the wall, as a fraction of the radius, 0…1.
/// - `triangle_count`: wanted number of triangles of both together.
pub fn hollow_ball(center: Vec3, radius: f32, thickness: f32, triangle_count: usize) -> MeshData {
    let mut ball = icosphere(center, radius, triangle_count / 2);
    let mut hollow = icosphere(center, radius * (1.0 - thickness), triangle_count / 2);
    hollow.triangles.iter_mut().for_each(|face| face.swap(1, 2));
    hollow.normals.iter_mut().flatten().for_each(|n| *n = -*n);
    append(&mut ball, hollow);
    ball
}

/// Hollow balls in a cubic grid about a point, filled from below.
///
/// - `size`: edge of the grid.
/// - `triangle_count`: wanted number of triangles of all together.
pub fn hollow_balls(center: Vec3, size: f32, ball_count: usize, triangle_count: usize) -> MeshData {
    let per_edge = (1..).find(|n| n * n * n >= ball_count).unwrap_or(1);
    let cell = size / per_edge as f32;
    let mut balls = MeshData::default();
    for i in 0..ball_count {
        let [x, y, z] = [i % per_edge, i / (per_edge * per_edge), i / per_edge % per_edge];
        let corner = center - Vec3::splat(0.5 * size);
        let middle = corner + Vec3::new(x as f32 + 0.5, y as f32 + 0.5, z as f32 + 0.5) * cell;
        append(&mut balls, hollow_ball(middle, 0.45 * cell, 0.08, triangle_count / ball_count.max(1)));
    }
    balls
}

/// Adds the faces of another mesh that has normals and no texture coordinates.
fn append(mesh: &mut MeshData, other: MeshData) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions);
    mesh.normals.get_or_insert_default().extend(other.normals.unwrap_or_default());
    mesh.triangles.extend(other.triangles.into_iter().map(|face| face.map(|i| i + first)));
}

/// A mesh whose vertex normals are the means of the adjacent faces' normals, weighted by area.
fn with_vertex_normals(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> MeshData {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for face in &triangles {
        let normal = super::doubled_area(face.map(|i| positions[i as usize].as_dvec3()));
        for &i in face {
            sums[i as usize] += normal;
        }
    }
    let normals = sums.into_iter().map(|n| n.normalize_or_zero().as_vec3()).collect();
    MeshData { positions, normals: Some(normals), triangles, ..MeshData::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    #[test]
    fn generated_meshes_are_closed_and_face_outward() {
        let center = Vec3::new(0.3, -0.2, 0.1);
        let meshes = [
            (uv_sphere(center, 1.0, 8), 1.3),
            (uv_sphere(center, 1.0, 2000), 0.98 * 4.0 / 3.0 * PI),
            (displaced_sphere(center, 1.0, 20_000, 0.1), 3.0),
            (icosphere(center, 1.0, 20), 2.5),
            (icosphere(center, 1.0, 2000), 0.99 * 4.0 / 3.0 * PI),
            (torus_knot(center, 1.0, 20_000, 0.2), 0.2),
            (hollow_ball(center, 1.0, 0.1, 4000), 0.98 * 4.0 / 3.0 * PI * (1.0 - 0.9_f64.powi(3))),
        ];
        for (data, least_volume) in meshes {
            let mesh = Mesh::new(data).unwrap();
            assert!(mesh.topology().is_closed(), "{:?}", mesh.topology());
            assert_eq!(mesh.dropped_faces(), 0);
            let volume = mesh.signed_volume();
            assert!(volume > least_volume && volume < 4.5, "{volume} against {least_volume}");
        }
    }

    #[test]
    fn the_wanted_number_of_triangles_is_met_within_a_tenth() {
        let wanted = 100_000;
        let counts = [
            uv_sphere(Vec3::ZERO, 1.0, wanted).triangles.len(),
            icosphere(Vec3::ZERO, 1.0, wanted).triangles.len(),
            torus_knot(Vec3::ZERO, 1.0, wanted, 0.1).triangles.len(),
            hollow_balls(Vec3::ZERO, 1.0, 8, wanted).triangles.len(),
        ];
        for count in counts {
            assert!(count.abs_diff(wanted) < wanted / 10, "{count} for {wanted}");
        }
    }
}
