//! Names of elements and values as version 3 has them.

/// Elements that hold properties of their own.
pub(super) const PLUGIN_TAGS: [&str; 13] = [
    "scene",
    "integrator",
    "sensor",
    "sampler",
    "film",
    "rfilter",
    "shape",
    "bsdf",
    "texture",
    "medium",
    "phase",
    "emitter",
    "subsurface",
];

/// Elements that are a value.
pub(super) const PROPERTY_TAGS: [&str; 12] = [
    "float",
    "integer",
    "boolean",
    "string",
    "rgb",
    "srgb",
    "spectrum",
    "blackbody",
    "point",
    "vector",
    "transform",
    "animation",
];

/// Kinds of texture that are a single color: version 2 and 3 write spectra as plugins, too.
pub(super) const SPECTRUM_KINDS: [&str; 9] =
    ["uniform", "constant", "d65", "srgb", "srgb_d65", "rgb", "blackbody", "regular", "irregular"];

/// Names of elements that changed between versions.
pub(super) fn present_tag(tag: &str) -> &str {
    match tag {
        "camera" => "sensor",
        "luminaire" => "emitter",
        "lookAt" => "lookat",
        other => other,
    }
}

/// A name as version 3 writes it: `toWorld` becomes `to_world`, `intIOR` `int_ior`.
pub(super) fn present_name(name: &str) -> String {
    let mut result = String::with_capacity(name.len() + 4);
    let mut previous_is_small = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && previous_is_small {
            result.push('_');
        }
        previous_is_small = c.is_ascii_lowercase() || c.is_ascii_digit();
        result.push(c.to_ascii_lowercase());
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn older_names_become_present_ones() {
        for (old, new) in [
            ("toWorld", "to_world"),
            ("intIOR", "int_ior"),
            ("fovAxis", "fov_axis"),
            ("sigmaS", "sigma_s"),
            ("cropOffsetX", "crop_offset_x"),
            ("shapeIndex", "shape_index"),
            ("flipTexCoords", "flip_tex_coords"),
            ("to_world", "to_world"),
            ("p0", "p0"),
            ("k", "k"),
        ] {
            assert_eq!(present_name(old), new);
        }
    }
}
