//! Mitsuba's names of conductors, and ours for those that the catalogue has.
//!
//! Names end in `_palik` where they tell the source of the values; those without come from other tables. Ours stand
//! for both: the sources differ by less than the specimens they were measured on.

/// Mitsuba's names that the catalogue of metals has, without `_palik`, with ours.
const KNOWN: [(&str, &str); 13] = [
    ("Ag", "silver"),
    ("Al", "aluminium"),
    ("Au", "gold"),
    ("Cr", "chromium"),
    ("Cu", "copper"),
    ("Hg", "mercury"),
    ("Mo", "molybdenum"),
    ("Nb", "niobium"),
    ("Ni", "nickel"),
    ("Rh", "rhodium"),
    ("TiN", "titanium nitride"),
    ("V", "vanadium"),
    ("W", "tungsten"),
];

/// Mitsuba's names that it lacks, without `_palik`.
const LACKING: [&str; 24] = [
    "a-C", "AlAs", "AlSb", "Be", "CsI", "Cu2O", "CuO", "d-C", "HgTe", "Ir", "K", "Li", "MgO", "Na", "Se",
    "SiC", "SnTe", "Ta", "Te", "ThF4", "TiC", "TiO2", "VC", "VN",
];

/// Our name of a metal, if the catalogue has it.
pub(super) fn our_name(theirs: &str) -> Option<&'static str> {
    let theirs = without_source(theirs);
    KNOWN.iter().find(|(known, _)| known.eq_ignore_ascii_case(theirs)).map(|(_, ours)| *ours)
}

/// Whether Mitsuba has a conductor of this name.
pub(super) fn is_listed(theirs: &str) -> bool {
    LACKING.iter().any(|known| known.eq_ignore_ascii_case(without_source(theirs)))
}

fn without_source(name: &str) -> &str {
    name.strip_suffix("_palik").unwrap_or(name)
}
