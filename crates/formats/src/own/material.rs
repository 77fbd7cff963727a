//! `[materials.NAME]` and inline materials: finishes of surfaces.
//!
//! | kind | keys (defaults) |
//! |---|---|
//! | matte | color (0.5) |
//! | phong | color (0.5), specular (0.2), exponent (100) |
//! | mirror | color (1) |
//! | conductor | metal: a name or `{ eta, k }`; roughness (0), tint (1) |
//! | glossy | color (0.8), exponent (100) |
//! | simple-transparent | k_r (0.1), k_t (0.9), phong = `{ diffuse, specular, exponent }` |
//! | dielectric | roughness (0), reflected (1), transmitted (1) |
//! | thin-dielectric | ior (1.5), tint (1) |
//! | plastic | color (0.5), specular (1), ior (1.5), roughness (0), nonlinear (false) |
//! | blend | first, second: names or materials; weight (0.5), the share of the second |
//! | pass-through, black | none |
//!
//! Each also has `opacity` (1) and a relief: `bump`, `normals` or `slopes`. Opaque ones have `two_sided` (true) and `back`,
//! a name or a material, transparent ones `straight_shadows` (false). Colors, exponents, roughness, opacity and weight
//! may come from textures: `{ texture = "NAME" }`, `{ checker = [color, color], scale = 12 }`,
//! `{ image = "FILE", scale = 1 }`.

use super::field::Field;
use super::scene::Reader;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, Located, MaterialDescription, MaterialKind, Metal, ScalarSource, Source};

const KINDS: [&str; 12] = [
    "matte",
    "phong",
    "mirror",
    "conductor",
    "glossy",
    "simple-transparent",
    "dielectric",
    "thin-dielectric",
    "plastic",
    "blend",
    "pass-through",
    "black",
];
/// Exponents of Phong lobes: beyond, a mirror is meant.
const EXPONENT: Limits = Limits::between(0.0, 1e6);
/// Indices of refraction of coats and panes.
const IOR: Limits = Limits::above_to(0.0, 100.0);

impl Reader<'_> {
    /// Reads an entry of `[materials]`.
    pub(super) fn material_entry(&mut self, table: Table<'_>, name: Located<String>) -> Result<()> {
        let material = self.material_table(table, name.value)?;
        self.scene.materials.push(Located::new(material, name.source));
        Ok(())
    }

    /// A material by name, or one described on the spot, which is named after `owner`.
    pub(super) fn material(&mut self, field: Field<'_>, owner: &str) -> Result<Located<String>> {
        if field.string().is_ok() {
            return field.name();
        }
        let name = format!("{owner}/{}", field.key);
        let material = self.material_table(field.table(format!("material of '{owner}'"))?, name)?;
        let source: &Source = field.source();
        let name = super::references::add_material(&mut self.scene.materials, material, source);
        Ok(Located::new(name, source.clone()))
    }

    fn material_table(&mut self, mut table: Table<'_>, name: String) -> Result<MaterialDescription> {
        let kind = self.material_kind(&mut table, &name)?;
        let two_sided = table.read("two_sided", true, |field| field.boolean())?;
        let opacity = self.scalar(&mut table, "opacity", 1.0, Limits::FRACTION)?;
        let relief = self.relief(&mut table)?;
        let is_transparent = is_transparent(&kind);
        let straight_shadows = match table.take("straight_shadows") {
            Some(field) if field.boolean()? && !is_transparent => {
                let error = field.error("`straight_shadows` is for finishes that refract light");
                return Err(error.with_remedy("those are dielectric, thin-dielectric and simple-transparent"));
            }
            Some(field) => field.boolean()?,
            None => false,
        };
        let back = match table.take("back") {
            Some(field) if is_transparent || kind == MaterialKind::PassThrough => {
                return Err(field.error("a transparent finish has no `back` of its own"));
            }
            Some(field) => Some(self.material(field, &name)?),
            None => None,
        };
        table.finish()?;
        Ok(MaterialDescription { name, kind, two_sided, back, opacity, relief, straight_shadows })
    }

    fn material_kind(&mut self, table: &mut Table<'_>, name: &str) -> Result<MaterialKind> {
        let kind = table.require("kind", "\"matte\"")?;
        Ok(match kind.string()? {
            "matte" => MaterialKind::Matte { reflectance: self.reflectance(table, "color", 0.5)? },
            "phong" => MaterialKind::Phong {
                diffuse: self.reflectance(table, "color", 0.5)?,
                specular: self.reflectance(table, "specular", 0.2)?,
                exponent: self.exponent(table)?,
            },
            "mirror" => MaterialKind::PerfectSpecular { reflectance: self.reflectance(table, "color", 1.0)? },
            "conductor" => MaterialKind::Conductor {
                metal: metal(table.require("metal", "\"gold\"")?)?,
                roughness: self.roughness(table)?,
                tint: self.reflectance(table, "tint", 1.0)?,
            },
            "glossy" => MaterialKind::GlossySpecular {
                reflectance: self.reflectance(table, "color", 0.8)?,
                exponent: self.exponent(table)?,
            },
            "simple-transparent" => simple_transparent(table)?,
            "dielectric" => MaterialKind::Dielectric {
                roughness: self.roughness(table)?,
                tint: (
                    self.reflectance(table, "reflected", 1.0)?,
                    self.reflectance(table, "transmitted", 1.0)?,
                ),
            },
            "thin-dielectric" => MaterialKind::ThinDielectric {
                ior: table.read("ior", 1.5, |field| field.number_f32(IOR))?,
                tint: self.reflectance(table, "tint", 1.0)?,
            },
            "plastic" => MaterialKind::Plastic {
                diffuse: self.reflectance(table, "color", 0.5)?,
                specular: self.reflectance(table, "specular", 1.0)?,
                ior: table.read("ior", 1.5, |field| field.number_f32(IOR))?,
                roughness: self.roughness(table)?,
                nonlinear: table.read("nonlinear", false, |field| field.boolean())?,
            },
            "blend" => MaterialKind::Blend {
                first: self.material(table.require("first", "\"wood\"")?, name)?,
                second: self.material(table.require("second", "{ kind = \"mirror\" }")?, name)?,
                weight: self.scalar(table, "weight", 0.5, Limits::FRACTION)?,
            },
            "pass-through" => MaterialKind::PassThrough,
            "black" => MaterialKind::Black,
            _ => return Err(kind.no_such_choice(&KINDS)),
        })
    }

    fn reflectance(&mut self, table: &mut Table<'_>, key: &'static str, default: f32) -> Result<ColorSource> {
        let field = table.take(key);
        field.map_or(Ok(ColorSource::Constant([default; 3])), |field| {
            self.color_source(field, Limits::FRACTION)
        })
    }

    fn exponent(&mut self, table: &mut Table<'_>) -> Result<ScalarSource> {
        self.scalar(table, "exponent", 100.0, EXPONENT)
    }

    fn roughness(&mut self, table: &mut Table<'_>) -> Result<ScalarSource> {
        self.scalar(table, "roughness", 0.0, Limits::FRACTION)
    }

    fn scalar(
        &mut self,
        table: &mut Table<'_>,
        key: &'static str,
        default: f32,
        limits: Limits,
    ) -> Result<ScalarSource> {
        let field = table.take(key);
        field.map_or(Ok(ScalarSource::Constant(default)), |field| self.scalar_source(field, limits))
    }
}

/// Whether a finish refracts light or stands for what does.
fn is_transparent(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::Dielectric { .. }
        | MaterialKind::ThinDielectric { .. }
        | MaterialKind::SimpleTransparent { .. } => true,
        MaterialKind::Matte { .. }
        | MaterialKind::Phong { .. }
        | MaterialKind::PerfectSpecular { .. }
        | MaterialKind::Conductor { .. }
        | MaterialKind::GlossySpecular { .. }
        | MaterialKind::Plastic { .. }
        | MaterialKind::Blend { .. }
        | MaterialKind::PassThrough
        | MaterialKind::Black => false,
    }
}

fn metal(field: Field<'_>) -> Result<Metal> {
    if field.string().is_ok() {
        return Ok(Metal::Named(field.name()?));
    }
    let mut table = field.table("metal")?;
    let limits = Limits::between(0.0, 1000.0);
    let eta = table.require("eta", "[0.14, 0.37, 1.44]")?.color(limits)?;
    let k = table.require("k", "[3.98, 2.38, 1.6]")?.color(limits)?;
    table.finish()?;
    Ok(Metal::Indices { eta, k })
}

fn simple_transparent(table: &mut Table<'_>) -> Result<MaterialKind> {
    let fraction = |field: Field<'_>| field.number_f32(Limits::FRACTION);
    let k_r = table.read("k_r", 0.1, fraction)?;
    let k_t = table.read("k_t", 0.9, fraction)?;
    let phong = table.read_some("phong", |field| {
        let mut table = field.table("phong")?;
        let color = |field: Field<'_>| field.color(Limits::FRACTION);
        let diffuse = table.read("diffuse", [0.0; 3], color)?;
        let specular = table.read("specular", [0.5; 3], color)?;
        let exponent = table.read("exponent", 1000.0, |field| field.number_f32(EXPONENT))?;
        table.finish()?;
        Ok((diffuse, specular, exponent))
    })?;
    Ok(MaterialKind::SimpleTransparent { k_r, k_t, phong })
}
