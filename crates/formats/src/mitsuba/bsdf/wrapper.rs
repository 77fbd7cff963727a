//! Wrappers around one bsdf: `twosided`, `mask`, `coating`.

use super::super::element::Element;
use super::super::importer::Importer;
use super::dielectric::relative_ior;
use super::indices::BK7;
use super::{Nesting, Surface};
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{MaterialKind, ScalarSource};

impl Importer<'_> {
    /// The finish that a wrapper wraps.
    pub(super) fn wrapped(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let inner = bsdf.children("bsdf")?;
        let Some((_, first)) = inner.first() else {
            return Err(bsdf.error(format!("{} has no bsdf within", bsdf.title())));
        };
        if inner.len() > 1 {
            bsdf.warn(format!("{} has more than one bsdf within; the first counts", bsdf.title()));
        }
        self.surface_finish(*first, nesting.deeper())
    }

    /// One finish for both sides, or one for each.
    pub(super) fn two_sided(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let nesting = Nesting { two_sided: true, ..nesting };
        let inner = bsdf.children("bsdf")?;
        let [(_, front), (_, back)] = inner.as_slice() else { return self.wrapped(bsdf, nesting) };
        let mut surface = self.surface_finish(*front, nesting.deeper())?;
        let back = self.surface_finish(*back, nesting.deeper())?;
        surface.material.back = Some(self.add_surface(back, bsdf.source()).material);
        Ok(surface)
    }

    /// A finish with holes.
    pub(super) fn mask(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let opacity = self.scalar_source(bsdf, "opacity", 0.5)?;
        let mut surface = self.wrapped(bsdf, nesting)?;
        surface.material.opacity = match (surface.material.opacity, opacity) {
            (ScalarSource::Constant(inner), ScalarSource::Constant(outer)) => {
                ScalarSource::Constant(inner * outer)
            }
            (ScalarSource::Constant(1.0), outer) => outer,
            (inner, _) => {
                bsdf.warn("of masks within each other only the inner one counts");
                inner
            }
        };
        Ok(surface)
    }

    /// A clear coat: over a matte base plastic, over anything else left out.
    pub(super) fn coating(&mut self, bsdf: Element<'_>, nesting: Nesting) -> Result<Surface> {
        let mut surface = self.wrapped(bsdf, nesting)?;
        let MaterialKind::Matte { reflectance } = &surface.material.kind else {
            bsdf.ignore_all();
            bsdf.warn(format!("the coat of {} is left out: only matte finishes take one", bsdf.title()));
            return Ok(surface);
        };
        let diffuse = reflectance.clone();
        let roughness = match bsdf.kind() {
            "coating" => ScalarSource::Constant(0.0),
            _ => self.roughness(bsdf)?,
        };
        bsdf.ignore(&["thickness"]);
        if bsdf.color("sigma_a", Limits::NOT_NEGATIVE)?.is_some_and(|sigma| sigma != [0.0; 3]) {
            bsdf.warn(format!("the absorption of the coat of {} is left out", bsdf.title()));
        }
        surface.material.kind = MaterialKind::Plastic {
            diffuse,
            specular: self.color_source(bsdf, "specular_reflectance", 1.0)?,
            ior: relative_ior(bsdf, BK7)?,
            roughness,
            nonlinear: true,
        };
        Ok(surface)
    }
}
