//! What the first surface looks like, for the auxiliary layers of a film.

use crate::walk::Vertex;
use hyaline_film::PixelSample;
use hyaline_math::Ray;

/// Writes albedo, normal, depth and object of the first vertex of a path.
pub fn record(sample: &mut PixelSample, vertex: &Vertex, ray: &Ray) {
    let n = vertex.hit.n;
    let facing = if n.dot(ray.direction) > 0.0 { -n } else { n };
    sample.albedo = vertex.bsdf.albedo_estimate().to_rgb();
    sample.normal = facing.to_array();
    sample.depth = Some(vertex.distance);
    sample.object = vertex.object.0 + 1;
}
