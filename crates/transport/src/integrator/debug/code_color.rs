//! Colors that tell things apart: the same number always has the same color, and neighbors differ much.

use hyaline_spectrum::Spectrum;

/// 1 over the golden ratio: steps by it around the circle of hues never come near an earlier one too soon.
const GOLDEN_STEP: f32 = 0.618_034;

/// Saturation and value, in turn: where hues come close after some steps, these differ.
const SHADES: [(f32, f32); 3] = [(0.85, 0.9), (0.5, 0.95), (0.9, 0.5)];

/// Color of thing number `index`, linear Rec. 709, 0…1.
pub(super) fn of_index(index: u32) -> Spectrum {
    // The fraction is taken of an integer's remainder: a product of large numbers would have lost it.
    let hue = (GOLDEN_STEP * (index % 4096) as f32).fract();
    let (saturation, value) = SHADES[index as usize % SHADES.len()];
    from_hue(hue, saturation, value)
}

/// Color of medium number `index`: dark gray for the world's, which most pictures are full of.
pub(super) fn of_medium(index: u32) -> Spectrum {
    if index == 0 { Spectrum::splat(0.1) } else { of_index(index) }
}

/// Color of a photon after so many bounces: white for none, then from red over green to violet for 8 and more.
pub(super) fn of_bounces(bounces: u32) -> Spectrum {
    match bounces {
        0 => Spectrum::ONE,
        _ => from_hue(0.1 * bounces.min(8) as f32 - 0.1, 0.9, 1.0),
    }
}

/// The hexagonal color of a hue on the circle 0…1 (red, green at 1/3, blue at 2/3).
///
/// Source: Smith, Color gamut transform pairs, SIGGRAPH 1978.
fn from_hue(hue: f32, saturation: f32, value: f32) -> Spectrum {
    let primary = |phase: f32| {
        let distance = ((hue + phase).fract() * 6.0 - 3.0).abs() - 1.0;
        value * (1.0 - saturation * (1.0 - distance.clamp(0.0, 1.0)))
    };
    Spectrum::from_rgb([primary(0.0), primary(2.0 / 3.0), primary(1.0 / 3.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_run_from_red_over_green_to_blue() {
        for (hue, rgb) in [(0.0, [1.0, 0.0, 0.0]), (1.0 / 3.0, [0.0, 1.0, 0.0]), (2.0 / 3.0, [0.0, 0.0, 1.0])]
        {
            let color = from_hue(hue, 1.0, 1.0).to_rgb();
            assert!(color.iter().zip(rgb).all(|(a, b)| (a - b).abs() < 1e-5), "{hue}: {color:?}");
        }
    }

    #[test]
    fn any_two_of_the_first_things_can_be_told_apart() {
        let colors: Vec<[f32; 3]> = (0..24).map(|index| of_index(index).to_rgb()).collect();
        for (i, a) in colors.iter().enumerate() {
            for (j, b) in colors.iter().enumerate().skip(i + 1) {
                let distance = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                assert!(distance > 0.04, "{i} {a:?} and {j} {b:?}");
            }
        }
    }
}
