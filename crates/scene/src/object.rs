//! Objects: a shape, what it bounds, its finish, and what it emits.

use crate::{Located, MeshData, Rgb};
use hyaline_math::{DVec3, Transform};
use serde::Serialize;
use std::sync::Arc;

/// Something that rays can hit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectDescription {
    /// Name, for messages and the object-id layer.
    pub name: String,
    /// Its form.
    pub shape: ShapeDescription,
    /// Object space to world.
    pub placement: Transform,
    /// Which media meet at its surface. Ignored by a vessel, which brings its own.
    pub boundary: BoundaryDescription,
    /// Name of its material.
    pub material: Located<String>,
    /// Materials of the slots of a mesh: (slot name in the mesh, material name). Slots not named here take `material`.
    pub slot_materials: Vec<(String, Located<String>)>,
    /// Light that its surface sends out.
    pub emission: Option<Emission>,
}

/// Which media meet at a surface.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub enum BoundaryDescription {
    /// None: opaque or thin.
    #[default]
    None,
    /// A closed body of one medium. Bodies may overlap; the medium's priority decides.
    Solid {
        /// Name of the medium inside.
        medium: Located<String>,
    },
    /// A sheet, open or closed, that names the media on both sides.
    Interface {
        /// Medium on the side the normals point to; `None` is the world's.
        outside: Option<Located<String>>,
        /// Medium on the other side; `None` is the world's.
        inside: Option<Located<String>>,
    },
}

/// Light sent out by a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Emission {
    /// How much, in the unit of `quantity`.
    pub color: Rgb,
    /// What `color` is.
    pub quantity: EmissionQuantity,
    /// Whether the inner side shines too.
    pub two_sided: bool,
    /// Whether camera rays see it.
    pub visible_to_camera: bool,
    /// Factor on the radiance that varies over the surface, by texture name.
    pub texture: Option<Located<String>>,
    /// Medium that the light declares to shine into; used where looking around does not tell.
    pub medium: Option<Located<String>>,
}

/// What an emission's color measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum EmissionQuantity {
    /// W sr⁻¹ m⁻², alike in all directions and places.
    Radiance,
    /// W in all, spread evenly over the surface.
    Power,
}

/// Forms, in object space. The axis of revolution is y; normals of closed forms point out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum ShapeDescription {
    /// A sphere or a part of one.
    Sphere {
        /// Center.
        center: DVec3,
        /// Radius, > 0.
        radius: f64,
        /// Range of azimuth about y, radians, 0…2π for the whole.
        phi: [f64; 2],
        /// Range of the angle from +y, radians, 0…π for the whole.
        theta: [f64; 2],
    },
    /// A flat disc; `inner_radius` > 0 makes an annulus.
    Disc {
        /// Center.
        center: DVec3,
        /// Normal, any length.
        normal: DVec3,
        /// Radius, > 0.
        radius: f64,
        /// Radius of the hole, ≥ 0.
        inner_radius: f64,
    },
    /// A parallelogram; its normal is `half_u` × `half_v`.
    Rectangle {
        /// Center.
        center: DVec3,
        /// From the center to the middle of the +u edge.
        half_u: DVec3,
        /// From the center to the middle of the +v edge.
        half_v: DVec3,
    },
    /// A box, its edges rounded where `radius` > 0.
    Box {
        /// Lowest corner.
        min: DVec3,
        /// Highest corner.
        max: DVec3,
        /// Radius of the edges.
        radius: f64,
    },
    /// A cylinder about y.
    Cylinder {
        /// Radius, > 0.
        radius: f64,
        /// Lower and upper end.
        y: [f64; 2],
        /// Range of azimuth, radians; anything but the whole turn can't be capped.
        phi: [f64; 2],
        /// Whether discs close it.
        capped: bool,
    },
    /// A cone about y, its base at y = 0.
    Cone {
        /// Radius of the base, > 0.
        radius: f64,
        /// Height of the apex, > 0.
        height: f64,
        /// Whether a disc closes it.
        capped: bool,
    },
    /// A torus about y, or a part of one.
    Torus {
        /// From the axis to the tube's center.
        major_radius: f64,
        /// Radius of the tube.
        minor_radius: f64,
        /// Range of azimuth about y, radians.
        phi: [f64; 2],
        /// Range of the angle about the tube, from the outermost point towards +y, radians.
        theta: [f64; 2],
    },
    /// Triangles.
    Mesh {
        /// The triangles.
        mesh: Arc<MeshData>,
        /// Whether to ignore the normals of the file.
        flat: bool,
    },
    /// A mesh made in code.
    Generated {
        /// What it looks like; of the order of one scene unit in size, about the origin.
        form: GeneratedForm,
        /// About how many triangles it has.
        triangles: u32,
    },
    /// A profile turned about y.
    Revolution {
        /// Points (radius, height); outside is on the right hand of the walk.
        profile: Vec<[f64; 2]>,
        /// How the points are joined.
        curve: ProfileCurve,
    },
    /// Several shapes as one object.
    Compound {
        /// The parts.
        parts: Vec<ShapePart>,
    },
    /// Another object's shape again, placed anew.
    Instance {
        /// Name of the object.
        of: Located<String>,
    },
    /// A drinking glass, bowl or bottle with what is in it.
    Vessel(VesselDescription),
}

/// Meshes that are made in code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum GeneratedForm {
    /// A torus knot with a wavy surface.
    Knot,
    /// A ball with a wavy surface.
    Ball,
    /// Hollow balls of thin glass.
    Shells,
}

/// How the points of a profile are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum ProfileCurve {
    /// Straight lines.
    #[default]
    Lines,
    /// A smooth curve of arcs through the points.
    Smooth,
}

/// A shape within a compound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShapePart {
    /// Its form; no vessel, no instance.
    pub shape: ShapeDescription,
    /// Part space to object space.
    pub placement: Transform,
}

/// A glass and its liquids.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VesselDescription {
    /// Its outer form.
    pub profile: VesselProfile,
    /// Thickness of the wall.
    pub wall: f64,
    /// Thickness of the base.
    pub base: f64,
    /// Form of the rim.
    pub rim: RimKind,
    /// Medium of the walls.
    pub medium: Located<String>,
    /// Liquids from the lowest up.
    pub fill: Vec<FillLayer>,
}

/// Outer form of a vessel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum VesselProfile {
    /// Points (radius, height) from the base's edge up to the rim.
    Points {
        /// The points.
        outer: Vec<[f64; 2]>,
        /// How they are joined.
        curve: ProfileCurve,
    },
    /// A part of a sphere between two horizontal circles, its foot at height 0.
    Bowl {
        /// Radius of the sphere.
        radius: f64,
        /// Radius of the foot, below the equator.
        foot: f64,
        /// Radius of the opening, above the equator.
        opening: f64,
    },
}

/// Form of a vessel's rim.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum RimKind {
    /// Part torus.
    #[default]
    Round,
    /// Annulus.
    Flat,
}

/// One liquid in a vessel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FillLayer {
    /// Name of the medium.
    pub medium: Located<String>,
    /// Height of its surface as a fraction of the inner height, 0…1.
    pub level: f64,
    /// How far the liquid climbs the wall, scene units; 0 is flat.
    pub meniscus: f64,
}
