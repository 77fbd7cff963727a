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
//! | pass-through, black | none |
//!
//! Each also has `two_sided` (true). Colors, exponents and roughness may come from textures: `{ texture = "NAME" }`,
//! `{ checker = [color, color], scale = 12 }`, `{ image = "FILE", scale = 1 }`.

use super::field::Field;
use super::scene::Reader;
use super::table::Table;
use crate::Result;
use crate::limits::Limits;
use hyaline_scene::{ColorSource, Located, MaterialDescription, MaterialKind, Metal, ScalarSource, Source};

const KINDS: [&str; 10] = [
    "matte",
    "phong",
    "mirror",
    "conductor",
    "glossy",
    "simple-transparent",
    "dielectric",
    "thin-dielectric",
    "pass-through",
    "black",
];
/// Exponents of Phong lobes: beyond, a mirror is meant.
const EXPONENT: Limits = Limits::between(0.0, 1e6);

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
        let kind = self.material_kind(&mut table)?;
        let two_sided = table.read("two_sided", true, |field| field.boolean())?;
        table.finish()?;
        Ok(MaterialDescription { two_sided, ..MaterialDescription::new(name, kind) })
    }

    fn material_kind(&mut self, table: &mut Table<'_>) -> Result<MaterialKind> {
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
                ior: table.read("ior", 1.5, |field| field.number_f32(Limits::above_to(0.0, 100.0)))?,
                tint: self.reflectance(table, "tint", 1.0)?,
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
        let field = table.take("exponent");
        field.map_or(Ok(ScalarSource::Constant(100.0)), |field| self.scalar_source(field, EXPONENT))
    }

    fn roughness(&mut self, table: &mut Table<'_>) -> Result<ScalarSource> {
        let field = table.take("roughness");
        field.map_or(Ok(ScalarSource::Constant(0.0)), |field| self.scalar_source(field, Limits::FRACTION))
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
