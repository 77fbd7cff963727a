//! From the numbers of a PLY file to a mesh: which property goes where, and the checks that both encodings share.

use super::header::{Element, Header};
use crate::mesh::{MAX_COUNT, fan};
use hyaline_scene::MeshData;

/// Corners of the largest polygon.
const MAX_CORNERS: usize = 4096;

/// Where a vertex property goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// Coordinate of a position.
    Position(usize),
    /// Coordinate of a normal.
    Normal(usize),
    /// Texture coordinate.
    Uv(usize),
    /// Nowhere.
    Skip,
}

/// What the vertex element holds.
#[derive(Clone, Debug)]
pub(super) struct VertexLayout {
    /// One for each property.
    pub(super) targets: Vec<Target>,
    has_normals: bool,
    has_uvs: bool,
}

impl VertexLayout {
    /// Finds the properties; lists are skipped.
    pub(super) fn new(element: &Element) -> Result<Self, String> {
        let target = |name: &str| match name {
            "x" => Target::Position(0),
            "y" => Target::Position(1),
            "z" => Target::Position(2),
            "nx" => Target::Normal(0),
            "ny" => Target::Normal(1),
            "nz" => Target::Normal(2),
            "u" | "s" | "texture_u" => Target::Uv(0),
            "v" | "t" | "texture_v" => Target::Uv(1),
            _ => Target::Skip,
        };
        let mut targets: Vec<Target> = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            let wanted = if property.list.is_some() { Target::Skip } else { target(&property.name) };
            targets.push(if targets.contains(&wanted) { Target::Skip } else { wanted });
        }
        let has = |wanted: &[Target]| wanted.iter().all(|target| targets.contains(target));
        if !has(&[Target::Position(0), Target::Position(1), Target::Position(2)]) {
            return Err("the vertices have no x, y and z".to_owned());
        }
        let has_normals = has(&[Target::Normal(0), Target::Normal(1), Target::Normal(2)]);
        let has_uvs = has(&[Target::Uv(0), Target::Uv(1)]);
        Ok(Self { targets, has_normals, has_uvs })
    }
}

/// A mesh being read.
#[derive(Debug, Default)]
pub(super) struct Builder {
    mesh: MeshData,
    vertex_count: usize,
}

/// A vertex being read.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
}

impl Vertex {
    /// Stores a value where it belongs.
    #[inline]
    pub(super) fn set(&mut self, target: Target, value: f32) {
        match target {
            Target::Position(i) => self.position[i] = value,
            Target::Normal(i) => self.normal[i] = value,
            Target::Uv(i) => self.uv[i] = value,
            Target::Skip => {}
        }
    }
}

impl Builder {
    /// A mesh without vertices; checks that the header has what a mesh needs.
    pub(super) fn new(header: &Header) -> Result<Self, String> {
        let find = |name: &str| header.elements.iter().find(|element| element.name == name);
        let Some(vertices) = find("vertex") else { return Err("the mesh has no vertices".to_owned()) };
        if find("face").is_none() {
            let has_strips = find("tristrips").is_some();
            let remedy = if has_strips { "; triangle strips can't be read" } else { "" };
            return Err(format!("the mesh has no faces{remedy}"));
        }
        for name in ["vertex", "face"] {
            if header.elements.iter().filter(|element| element.name == name).count() > 1 {
                return Err(format!("the header has two elements '{name}'"));
            }
        }
        if header.elements.iter().any(|element| element.count > MAX_COUNT) {
            return Err("the header promises more than 2^32 records".to_owned());
        }
        Ok(Self { mesh: MeshData::default(), vertex_count: vertices.count })
    }

    /// Makes room for vertices; the caller has checked the count against the file's size.
    pub(super) fn reserve_vertices(&mut self, layout: &VertexLayout, count: usize) {
        self.mesh.positions.reserve_exact(count);
        if layout.has_normals {
            self.mesh.normals.reserve_exact(count);
        }
        if layout.has_uvs {
            self.mesh.uvs.reserve_exact(count);
        }
    }

    /// Makes room for triangles; the caller has checked the count against the file's size.
    pub(super) fn reserve_triangles(&mut self, count: usize) {
        self.mesh.triangles.reserve_exact(count);
    }

    /// Adds a vertex.
    #[inline]
    pub(super) fn push_vertex(&mut self, layout: &VertexLayout, vertex: Vertex) -> Result<(), String> {
        let finite = |values: &[f32]| values.iter().all(|value| value.is_finite());
        if !finite(&vertex.position) {
            return Err("a coordinate is not finite".to_owned());
        }
        self.mesh.positions.push(vertex.position);
        if layout.has_normals {
            if !finite(&vertex.normal) {
                return Err("a normal is not finite".to_owned());
            }
            self.mesh.normals.push(vertex.normal);
        }
        if layout.has_uvs {
            if !finite(&vertex.uv) {
                return Err("a texture coordinate is not finite".to_owned());
            }
            self.mesh.uvs.push(vertex.uv);
        }
        Ok(())
    }

    /// A vertex index, checked.
    #[inline]
    pub(super) fn index(&self, index: i64) -> Result<u32, String> {
        match u32::try_from(index) {
            Ok(small) if (small as usize) < self.vertex_count => Ok(small),
            _ => {
                Err(format!("vertex index {index} is out of range, there are {} vertices", self.vertex_count))
            }
        }
    }

    /// The number of corners of a polygon, checked.
    pub(super) fn corner_count(count: i64) -> Result<usize, String> {
        match usize::try_from(count) {
            Ok(count) if count <= MAX_CORNERS => Ok(count),
            _ => Err(format!("a face of {count} corners")),
        }
    }

    /// Adds a polygon; fewer than three corners make nothing.
    #[inline]
    pub(super) fn push_face(&mut self, corners: &[u32]) -> Result<(), String> {
        if let [a, b, c] = *corners {
            self.mesh.triangles.push([a, b, c]);
        } else {
            fan(corners, &mut self.mesh.triangles);
        }
        if self.mesh.triangles.len() > MAX_COUNT {
            Err("more than 2^32 triangles".to_owned())
        } else {
            Ok(())
        }
    }

    /// The mesh.
    pub(super) fn finish(self) -> MeshData {
        self.mesh
    }
}

/// Position of the list of vertex indices within the face element.
pub(super) fn index_property(element: &Element) -> Result<usize, String> {
    let is_indices = |name: &str| name == "vertex_indices" || name == "vertex_index";
    let found = element.properties.iter().position(|p| p.list.is_some() && is_indices(&p.name));
    found.ok_or_else(|| "the faces have no list `vertex_indices`".to_owned())
}
