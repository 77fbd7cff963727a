//! Indices of refraction of glasses, liquids, crystals and plastics, with dispersion where it is well known.

use super::is_same_name;
use hyaline_optics::IndexModel::Constant;
use hyaline_optics::{Abbe, Cauchy, IndexModel, Sellmeier};

/// Index of refraction of a named substance.
///
/// Returns `None` for unknown names; `index_names` lists the known ones, and some of them have further spellings.
/// Source: given beside each entry of the table.
pub fn index_by_name(name: &str) -> Option<IndexModel> {
    TABLE
        .iter()
        .find(|(names, _)| names.iter().any(|known| is_same_name(known, name)))
        .map(|(_, model)| *model)
}

/// The first spelling of all names that `index_by_name` knows, for error messages.
pub fn index_names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|(names, _)| names[0])
}

const TABLE: &[(&[&str], IndexModel)] = &[
    // Gases at 0 °C and liquids at 20 °C without a formula: Hecht, Optics, 4th ed., table 4.1, at 589 nm.
    (&["vacuum"], Constant(1.0)),
    (&["air"], Constant(1.000_277)),
    (&["helium"], Constant(1.000_036)),
    (&["hydrogen"], Constant(1.000_132)),
    (&["carbon dioxide"], Constant(1.000_45)),
    (&["carbon tetrachloride"], Constant(1.461)),
    (&["glycerol", "glycerin", "glycerine"], Constant(1.4729)),
    (&["benzene"], Constant(1.501)),
    (&["silicone oil"], Constant(1.520_45)),
    (&["bromine"], Constant(1.661)),
    (&["water"], WATER),
    // 35 g/kg of salt, 20 °C: Quan & Fry, Appl. Opt. 34, 1995, eq. 3; dispersion of water.
    (&["sea water", "seawater", "salt water"], abbe(1.3394, 55.7)),
    // Water with 4 % extract and 4 % alcohol by mass, each raising the index as in the ICUMSA and OIML tables.
    (&["beer"], abbe(1.341, 55.7)),
    // Codex Alimentarius CXS 33, virgin olive oil, 20 °C: 1.4677 to 1.4705.
    (&["vegetable oil", "olive oil", "oil"], Constant(1.469)),
    // 17 % water, 20 °C: Chataway, Canadian Journal of Research 6, 1932; AOAC method 969.38.
    (&["honey"], Constant(1.494)),
    // Rheims, Köser & Wriedt, Meas. Sci. Technol. 8, 1997; 20 °C.
    (&["ethanol", "alcohol"], cauchy(1.352_65, 0.003_06, 0.000_02)),
    (&["acetone"], cauchy(1.349_79, 0.003_06, 0.000_06)),
    // Fitted to the table of Warren & Brandt, J. Geophys. Res. 113 (D14220), 2008, to 0.0002 from 450 to 650 nm.
    (&["ice", "water ice"], abbe(1.309_75, 54.5)),
    // Rubin, Solar Energy Materials 12, 1985, clear soda-lime-silica, evaluated at the d, F and C lines.
    (&["soda lime glass", "window glass", "glass"], abbe(1.5234, 64.0)),
    // Schott, data sheet Borofloat 33.
    (&["pyrex", "borosilicate glass", "borosilicate"], abbe(1.4714, 65.4)),
    // Schott, optical glass catalogue, 2017.
    (
        &["BK7", "N-BK7", "crown glass"],
        sellmeier(
            [1.039_612_12, 0.231_792_344, 1.010_469_45],
            [0.006_000_698_67, 0.020_017_914_4, 103.560_653],
        ),
    ),
    (
        &["F2", "flint glass"],
        sellmeier(
            [1.345_333_59, 0.209_073_176, 0.937_357_162],
            [0.009_977_438_71, 0.047_045_076_7, 111.886_764],
        ),
    ),
    (
        &["SF10"],
        sellmeier(
            [1.616_259_77, 0.259_229_334, 1.077_623_17],
            [0.012_753_455_9, 0.058_198_395_4, 116.607_68],
        ),
    ),
    (
        &["SF11", "dense flint glass"],
        sellmeier(
            [1.738_484_03, 0.311_168_974, 1.174_908_71],
            [0.013_606_860_4, 0.061_595_046_3, 121.922_711],
        ),
    ),
    // Malitson, J. Opt. Soc. Am. 55, 1965.
    (
        &["fused silica", "fused quartz", "quartz glass", "silica"],
        resonances([0.696_166_3, 0.407_942_6, 0.897_479_4], [0.068_404_3, 0.116_241_4, 9.896_161]),
    ),
    // Malitson, Applied Optics 2, 1963.
    (
        &["fluorite", "calcium fluoride", "CaF2"],
        resonances([0.567_588_8, 0.471_091_4, 3.848_472_3], [0.050_263_605, 0.100_390_9, 34.649_04]),
    ),
    // Ordinary ray: Malitson & Dodge 1972, in Handbook of Laser Science and Technology IV, part 2, 1986.
    (
        &["sapphire", "ruby", "corundum"],
        resonances([1.431_349_3, 0.650_547_13, 5.341_402_1], [0.072_663_1, 0.119_324_2, 18.028_251]),
    ),
    // Peter, Zeitschrift für Physik 15, 1923.
    (&["diamond"], resonances([0.3306, 4.3356, 0.0], [0.175, 0.106, 0.0])),
    // Wood & Nassau, Applied Optics 21, 1982; 12 mol % yttria.
    (
        &["cubic zirconia", "zirconia"],
        resonances([1.347_091, 2.117_788, 9.452_943], [0.062_543, 0.166_739, 24.320_57]),
    ),
    // Li, J. Phys. Chem. Ref. Data 5, 1976, at the d, F and C lines.
    (&["sodium chloride", "salt", "rock salt"], abbe(1.5443, 42.9)),
    // Optical grade, Bäumer (ed.), Handbook of Plastic Optics, 2nd ed., 2010, table of optical plastics.
    (&["acrylic", "acrylic glass", "PMMA", "plexiglass", "plexiglas", "perspex"], abbe(1.4918, 57.4)),
    (&["polycarbonate"], abbe(1.5855, 29.9)),
    (&["polystyrene"], abbe(1.5905, 30.9)),
    // Hecht, Optics, 4th ed., and makers' data, at 589 nm.
    (&["polypropylene"], Constant(1.49)),
    (&["PET"], Constant(1.575)),
    (&["amber"], Constant(1.55)),
];

/// Daimon & Masumura, Applied Optics 46, 2007: distilled water at 20.0 °C, relative to air.
///
/// Their formula has three ultraviolet terms; the two here are fitted to it, and differ by less than 1e-7 from 360 to
/// 830 nm.
const WATER: IndexModel =
    sellmeier([0.595_466_8, 0.166_415_5, 0.113_074_868_8], [0.005_371_905, 0.020_380_675, 10.697_927_21]);

const fn abbe(nd: f64, abbe: f64) -> IndexModel {
    IndexModel::Abbe(Abbe { nd, abbe })
}

const fn cauchy(a: f64, b: f64, c: f64) -> IndexModel {
    IndexModel::Cauchy(Cauchy { a, b, c })
}

const fn sellmeier(b: [f64; 3], c: [f64; 3]) -> IndexModel {
    IndexModel::Sellmeier(Sellmeier { b, c })
}

/// Sellmeier's formula from the wavelengths of its resonances, µm, not their squares.
const fn resonances(b: [f64; 3], lambda: [f64; 3]) -> IndexModel {
    let c = [lambda[0] * lambda[0], lambda[1] * lambda[1], lambda[2] * lambda[2]];
    IndexModel::Sellmeier(Sellmeier { b, c })
}

#[cfg(test)]
mod tests;
