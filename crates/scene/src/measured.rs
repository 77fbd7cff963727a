//! Measured coefficients of liquids and a few solids, by name: the one table for all formats. A medium that bears such a
//! name needs no description.
//!
//! In 1/mm, at the red, green and blue of the cameras that measured them. The scattering is *reduced*, (1 - g) σ_s: it goes
//! with an isotropic phase function. Powders are those of a solution as it was measured; `concentration` thins it.
//!
//! Sources: Jensen, Marschner, Levoy & Hanrahan, A Practical Model for Subsurface Light Transport, SIGGRAPH 2001, fig. 5
//! (the first twelve); Narasimhan, Gupta, Donner, Ramamoorthi, Nayar & Jensen, Acquiring Scattering Properties of
//! Participating Media by Dilution, SIGGRAPH 2006 (the rest), as tabulated in pbrt-v4, src/pbrt/media.cpp.

use crate::Rgb;

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Name in our words.
    pub name: &'static str,
    /// Reduced scattering coefficient, 1/mm.
    pub sigma_s: Rgb,
    /// Absorption coefficient, 1/mm.
    pub sigma_a: Rgb,
}

const fn row(name: &'static str, sigma_s: Rgb, sigma_a: Rgb) -> Measured {
    Measured { name, sigma_s, sigma_a }
}

/// Everything that is known.
pub const ALL: [Measured; 47] = [
    row("apple", [2.29, 2.39, 1.97], [0.0030, 0.0034, 0.046]),
    row("chicken1", [0.15, 0.21, 0.38], [0.015, 0.077, 0.19]),
    row("chicken2", [0.19, 0.25, 0.32], [0.018, 0.088, 0.20]),
    row("cream", [7.38, 5.47, 3.15], [0.0002, 0.0028, 0.0163]),
    row("ketchup", [0.18, 0.07, 0.03], [0.061, 0.97, 1.45]),
    row("marble", [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071]),
    row("potato", [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12]),
    row("skim milk", [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142]),
    row("skin1", [0.74, 0.88, 1.01], [0.032, 0.17, 0.48]),
    row("skin2", [1.09, 1.59, 1.79], [0.013, 0.070, 0.145]),
    row("spectralon", [11.6, 20.4, 14.9], [0.0, 0.0, 0.0]),
    row("whole milk", [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014]),
    row("lowfat milk", [0.89187, 1.5136, 2.532], [0.002875, 0.00575, 0.0115]),
    row("reduced milk", [2.4858, 3.1669, 4.5214], [0.0025556, 0.0051111, 0.012778]),
    row("regular milk", [4.5513, 5.8294, 7.136], [0.0015333, 0.0046, 0.019933]),
    row("espresso", [0.72378, 0.84557, 1.0247], [4.7984, 6.5751, 8.8493]),
    row("mint mocha coffee", [0.31602, 0.38538, 0.48131], [3.772, 5.8228, 7.82]),
    row("lowfat soy milk", [0.30576, 0.34233, 0.61664], [0.0014375, 0.0071875, 0.035937]),
    row("regular soy milk", [0.59223, 0.73866, 1.4693], [0.0019167, 0.0095833, 0.065167]),
    row("lowfat chocolate milk", [0.64925, 0.83916, 1.1057], [0.0115, 0.0368, 0.1564]),
    row("regular chocolate milk", [1.4585, 2.1289, 2.9527], [0.010063, 0.043125, 0.14375]),
    row("coke", [8.9053e-5, 8.372e-5, 0.0], [0.10014, 0.16503, 0.2468]),
    row("pepsi", [6.1697e-5, 4.2564e-5, 0.0], [0.091641, 0.14158, 0.20729]),
    row("sprite", [6.0306e-6, 6.4139e-6, 6.5504e-6], [0.001886, 0.0018308, 0.0020025]),
    row("gatorade", [0.0024574, 0.003007, 0.0037325], [0.024794, 0.019289, 0.008878]),
    row("chardonnay", [1.7982e-5, 1.3758e-5, 1.2023e-5], [0.010782, 0.011855, 0.023997]),
    row("white zinfandel", [1.7501e-5, 1.9069e-5, 1.288e-5], [0.012072, 0.016184, 0.019843]),
    row("merlot", [2.1129e-5, 0.0, 0.0], [0.11632, 0.25191, 0.29434]),
    row("budweiser beer", [2.4356e-5, 2.4079e-5, 1.0564e-5], [0.011492, 0.024911, 0.057786]),
    row("coors light beer", [5.0922e-5, 4.301e-5, 0.0], [0.006164, 0.013984, 0.034983]),
    row("clorox", [0.0024035, 0.0031373, 0.003991], [0.0033542, 0.014892, 0.026297]),
    row("apple juice", [0.00013612, 0.00015836, 0.000227], [0.012957, 0.023741, 0.052184]),
    row("cranberry juice", [0.00010402, 0.00011646, 7.8139e-5], [0.039437, 0.094223, 0.12426]),
    row("grape juice", [5.382e-5, 0.0, 0.0], [0.10404, 0.23958, 0.29325]),
    row("ruby grapefruit juice", [0.011002, 0.010927, 0.011036], [0.085867, 0.18314, 0.25262]),
    row("white grapefruit juice", [0.22826, 0.23998, 0.32748], [0.0138, 0.018831, 0.056781]),
    row("shampoo", [0.0007176, 0.0008303, 0.0009016], [0.014107, 0.045693, 0.061717]),
    row("strawberry shampoo", [0.00015671, 0.00015947, 1.518e-5], [0.01449, 0.05796, 0.075823]),
    row("head & shoulders shampoo", [0.023805, 0.028804, 0.034306], [0.084621, 0.15688, 0.20365]),
    row("lemon tea powder", [0.040224, 0.045264, 0.051081], [2.4288, 4.5757, 7.2127]),
    row("orange powder", [0.00015617, 0.00017482, 0.0001762], [0.001449, 0.003441, 0.007863]),
    row("pink lemonade powder", [0.00012103, 0.00013073, 0.00012528], [0.001165, 0.002366, 0.003195]),
    row("cappuccino powder", [1.8436, 2.5851, 2.1662], [35.844, 49.547, 61.084]),
    row("salt powder", [0.027333, 0.032451, 0.031979], [0.28415, 0.3257, 0.34148]),
    row("sugar powder", [0.00022272, 0.00025513, 0.000271], [0.012638, 0.031051, 0.050124]),
    row("suisse mocha powder", [2.7979, 3.5452, 4.3365], [17.502, 27.004, 35.433]),
    row("pacific ocean surface water", [0.0001764, 0.00032095, 0.00019617], [0.031845, 0.031324, 0.030147]),
];

/// What everyday words stand for.
pub const ALIASES: [(&str, &str); 6] = [
    ("milk", "whole milk"),
    ("beer", "budweiser beer"),
    ("wine", "merlot"),
    ("juice", "apple juice"),
    ("coffee", "espresso"),
    ("sea water", "pacific ocean surface water"),
];

/// What bears this name; case, spaces and signs don't count.
pub fn by_name(name: &str) -> Option<&'static Measured> {
    let alias = ALIASES.iter().find(|(word, _)| is_same_name(word, name));
    let wanted = alias.map_or(name, |(_, meant)| meant);
    ALL.iter().find(|measured| is_same_name(measured.name, wanted))
}

/// Whether two spellings are one name: case, spaces and signs don't count.
pub fn is_same_name(a: &str, b: &str) -> bool {
    let plain = |name: &str| -> String {
        name.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
    };
    plain(a) == plain(b)
}

/// Every name that [`by_name`] finds, each in one spelling.
pub fn names() -> impl Iterator<Item = &'static str> {
    ALIASES.iter().map(|(word, _)| *word).chain(ALL.iter().map(|measured| measured.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_however_they_are_written() {
        let sigma_s = |name: &str| by_name(name).map(|measured| measured.sigma_s);
        assert_eq!(sigma_s("Skin1"), Some([0.74, 0.88, 1.01]));
        assert_eq!(sigma_s("Whole milk"), sigma_s("wholemilk"));
        assert_eq!(sigma_s("Head & Shoulders Shampoo"), sigma_s("headshouldersshampoo"));
        assert_eq!(sigma_s("holy water"), None);
    }

    #[test]
    fn everyday_words_stand_for_what_was_measured() {
        for (word, meant) in ALIASES {
            assert_eq!(by_name(word).map(|measured| measured.name), Some(meant));
        }
        assert_eq!(by_name("Seawater"), by_name("pacific ocean surface water"));
        let names: Vec<&str> = names().collect();
        assert!(names.len() == 53 && names.iter().all(|name| by_name(name).is_some()), "{names:?}");
    }

    #[test]
    fn all_names_differ_and_all_figures_are_coefficients() {
        for (i, measured) in ALL.iter().enumerate() {
            assert_eq!(by_name(measured.name), Some(&ALL[i]));
            let figures = measured.sigma_s.iter().chain(&measured.sigma_a);
            assert!(figures.clone().all(|&sigma| (0.0..100.0).contains(&sigma)), "{measured:?}");
            assert!(figures.sum::<f32>() > 0.0, "{measured:?}");
        }
    }
}
