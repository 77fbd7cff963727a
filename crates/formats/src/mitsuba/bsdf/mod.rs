//! `<bsdf>`: finishes, and the indices that a dielectric gives to the two sides of its shape.
//!
//! A plain bsdf is one finish. Wrappers (twosided, mask, bumpmap, normalmap, coating) change the finish within them,
//! blends join several. What has no counterpart here is replaced by the nearest that has, and noted.

mod blend;
mod conductor;
mod dielectric;
mod indices;
mod metals;
mod plastic;
mod principled;
mod relief;
mod replaced;
mod roughness;
mod wrapper;

#[cfg(test)]
mod tests;

use super::element::Element;
use super::importer::Importer;
use crate::Result;
use crate::own::add_material;
use hyaline_scene::{ColorSource, Located, MaterialDescription, MaterialKind, Source};

/// Most bsdfs within each other.
const MAX_DEPTH: usize = 16;

/// What a BSDF says about the media at its shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sides {
    /// Nothing: it lets no light through, or is thin.
    Opaque,
    /// They differ in index.
    Dielectric {
        /// Index on the side that normals point away from.
        inside: f64,
        /// Index on the side that normals point to.
        outside: f64,
    },
    /// They have one index.
    PassThrough,
}

/// A finish and what it says about the sides.
pub(super) struct Finish {
    /// Name of the material.
    pub(super) material: Located<String>,
    /// What it says about the media.
    pub(super) sides: Sides,
}

/// A finish that has no name yet.
struct Surface {
    /// The id that names it, if it has one.
    id: Option<String>,
    /// Everything but the name.
    material: MaterialDescription,
    /// What it says about the media.
    sides: Sides,
}

/// Where among the wrappers a bsdf stands.
#[derive(Clone, Copy)]
struct Nesting {
    /// Bsdfs around it.
    depth: usize,
    /// Whether one of them is `twosided`.
    two_sided: bool,
}

impl Nesting {
    fn deeper(self) -> Self {
        Self { depth: self.depth + 1, ..self }
    }
}

impl Surface {
    fn new(kind: MaterialKind, sides: Sides, two_sided: bool) -> Self {
        // The two sides of what lets light through do not differ.
        let two_sided =
            two_sided || sides != Sides::Opaque || matches!(kind, MaterialKind::ThinDielectric { .. });
        let material = MaterialDescription { two_sided, ..MaterialDescription::new("", kind) };
        Self { id: None, material, sides }
    }
}

impl Importer<'_> {
    /// Reads a BSDF and adds its material.
    pub(super) fn bsdf(&mut self, bsdf: Element<'_>) -> Result<Finish> {
        let surface = self.surface_finish(bsdf, Nesting { depth: 0, two_sided: false })?;
        Ok(self.add_surface(surface, bsdf.source()))
    }

    /// Gives a finish its name: its id, else what kind it is.
    fn add_surface(&mut self, surface: Surface, source: &Source) -> Finish {
        let Surface { id, material, sides } = surface;
        let name = id.unwrap_or_else(|| kind_name(&material.kind).to_owned());
        let material = MaterialDescription { name, ..material };
        let name = add_material(&mut self.scene.materials, material, source);
        Finish { material: Located::new(name, source.clone()), sides }
    }

    /// Reads a bsdf with all that is within it.
    fn surface_finish(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        if nesting.depth > MAX_DEPTH {
            let message = format!("more than {MAX_DEPTH} bsdfs within each other, or one within itself");
            return Err(bsdf.error(message));
        }
        let mut surface = match bsdf.kind() {
            "twosided" => self.two_sided(bsdf, nesting),
            "mask" => self.mask(bsdf, nesting),
            "bumpmap" | "bump" => self.bump_map(bsdf, nesting),
            "normalmap" => self.normal_map(bsdf, nesting),
            "coating" | "roughcoating" => self.coating(bsdf, nesting),
            "blendbsdf" => self.blend(bsdf, nesting),
            "mixturebsdf" | "mixture" => self.mixture(bsdf, nesting),
            "principled" | "disney" => self.principled(bsdf, nesting),
            "principledthin" => self.principled_thin(bsdf, nesting),
            _ => {
                let (kind, sides) = self.plain(bsdf)?;
                Ok(Surface::new(kind, sides, nesting.two_sided))
            }
        }?;
        if let Some(id) = bsdf.id() {
            surface.id = Some(id.to_owned());
        }
        Ok(surface)
    }

    /// A bsdf that holds no other.
    fn plain(&mut self, bsdf: Element<'_>) -> Result<(MaterialKind, Sides)> {
        let opaque = |kind: MaterialKind| Ok((kind, Sides::Opaque));
        match bsdf.kind() {
            "diffuse" => opaque(matte(self.color_source(bsdf, "reflectance", 0.5)?)),
            "dielectric" | "roughdielectric" => self.dielectric(bsdf),
            "thindielectric" => self.thin_dielectric(bsdf).and_then(opaque),
            "conductor" | "roughconductor" => self.conductor(bsdf).and_then(opaque),
            "plastic" | "roughplastic" | "pplastic" => self.plastic(bsdf).and_then(opaque),
            "phong" => self.phong(bsdf).and_then(opaque),
            "null" => Ok((MaterialKind::PassThrough, Sides::PassThrough)),
            _ => self.replaced(bsdf),
        }
    }
}

/// Lambert's law; black where nothing is reflected.
fn matte(reflectance: ColorSource) -> MaterialKind {
    match reflectance {
        ColorSource::Constant([0.0, 0.0, 0.0]) => MaterialKind::Black,
        reflectance => MaterialKind::Matte { reflectance },
    }
}

/// What a finish without an id is called.
fn kind_name(kind: &MaterialKind) -> &'static str {
    match kind {
        MaterialKind::Matte { .. } => "matte",
        MaterialKind::Phong { .. } => "phong",
        MaterialKind::PerfectSpecular { .. } => "mirror",
        MaterialKind::Conductor { .. } => "conductor",
        MaterialKind::Dielectric { .. } => "dielectric",
        MaterialKind::ThinDielectric { .. } => "thin-dielectric",
        MaterialKind::PassThrough => "pass-through",
        MaterialKind::Black => "black",
        MaterialKind::Plastic { .. } => "plastic",
        MaterialKind::Blend { .. } => "blend",
        MaterialKind::GlossySpecular { .. } | MaterialKind::SimpleTransparent { .. } => "finish",
    }
}
