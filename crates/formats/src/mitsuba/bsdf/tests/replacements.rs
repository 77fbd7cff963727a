//! What is not rendered as such.

use super::*;
use hyaline_math::float;

#[test]
fn a_finish_without_counterpart_is_matte_in_its_own_color_and_noted() {
    for (kind, color) in [
        ("measured", None),
        ("hair", None),
        ("irawan", None),
        ("hk", None),
        ("difftrans", Some("transmittance")),
        ("openpbr", Some("base_color")),
    ] {
        let value = color.map_or(String::new(), |name| format!("<rgb name='{name}' value='0.1, 0.2, 0.3'/>"));
        let scene = scene(&format!("<bsdf type='{kind}'>{value}<float name='other' value='1'/></bsdf>"));
        let reflectance = color.map_or(grey(0.5), |_| ColorSource::Constant([0.1, 0.2, 0.3]));
        assert_eq!(finish(&scene).kind, MaterialKind::Matte { reflectance }, "{kind}");
        let expected = format!("scene.xml:2:32: bsdf '{kind}' is not supported and replaced by a matte one");
        assert_eq!(notes(&scene), [expected]);
    }
}

#[test]
fn a_rough_diffuse_finish_is_noted_only_where_it_is_rough() {
    let rough = |alpha: &str| scene(&format!("<bsdf type='roughdiffuse'>{alpha}</bsdf>"));
    assert_eq!(rough("<float name='alpha' value='0'/>").notes, []);
    assert_eq!(notes(&rough("")), ["scene.xml:2:32: bsdf 'roughdiffuse' is replaced by 'diffuse'"]);
    assert_eq!(finish(&rough("")).kind, MaterialKind::Matte { reflectance: grey(0.5) });
}

#[test]
fn wards_lobe_becomes_phongs_of_its_width() {
    let scene = scene(
        "<bsdf type='ward'><float name='alpha_u' value='0.2'/><float name='alpha_v' value='0.2'/></bsdf>",
    );
    let MaterialKind::Phong { exponent: ScalarSource::Constant(exponent), .. } = finish(&scene).kind else {
        panic!("no lobe")
    };
    // About the normal both fall to 1/e at tan θ = 0.2; about the mirror direction that is twice the angle.
    let angle = 2.0 * float::atan(0.2);
    assert!((float::powf(float::cos(angle), exponent) * std::f32::consts::E - 1.0).abs() < 0.1, "{exponent}");
    assert_eq!(scene.notes.len(), 1);
}

#[test]
fn polarizing_elements_let_light_through() {
    let scene = scene("<bsdf type='polarizer'/>");
    assert_eq!(finish(&scene).kind, MaterialKind::PassThrough);
    assert_eq!(scene.notes.len(), 1);
}
