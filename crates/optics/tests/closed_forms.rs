//! Small optical systems, traced with the laws alone, against their closed forms.

use hyaline_math::{Vec3, float};
use hyaline_optics::{fresnel_dielectric, reflect, refract, transmittance};

/// Angle between two unit vectors, radians, precise for small angles too.
fn angle(a: Vec3, b: Vec3) -> f32 {
    float::atan2(a.cross(b).length(), a.dot(b))
}

/// Power through a pane at normal incidence, summed over its inner bounces.
fn pane(eta: f32, inner_transmittance: f32) -> (f32, f32) {
    let (entering, leaving) = (fresnel_dielectric(1.0, eta), fresnel_dielectric(1.0, 1.0 / eta));
    let (mut reflected, mut transmitted) = (entering, 0.0);
    let mut inside = 1.0 - entering;
    for bounce in 0..100 {
        inside *= inner_transmittance;
        if bounce % 2 == 0 {
            transmitted += inside * (1.0 - leaving);
        } else {
            reflected += inside * (1.0 - leaving);
        }
        inside *= leaving;
    }
    (reflected, transmitted)
}

#[test]
fn a_clear_pane_transmits_twelve_thirteenths() {
    let (reflected, transmitted) = pane(1.5, transmittance(0.0, 0.004));
    assert!((transmitted - 0.923_077).abs() < 1e-6, "{transmitted}");
    assert!((reflected - 0.076_923).abs() < 1e-6, "{reflected}");
    for eta in [1.1, 1.333, 2.42] {
        let r = fresnel_dielectric(1.0, eta);
        let (reflected, transmitted) = pane(eta, 1.0);
        assert!((transmitted - (1.0 - r) / (1.0 + r)).abs() < 1e-6);
        assert!((reflected + transmitted - 1.0).abs() < 1e-6);
    }
}

#[test]
fn an_absorbing_pane_follows_the_series() {
    for (sigma, thickness) in [(0.5, 0.2), (3.0, 1.0), (100.0, 0.004)] {
        let a = transmittance(sigma, thickness);
        let r: f32 = 0.04;
        let want = (1.0 - r) * (1.0 - r) * a / (1.0 - r * r * a * a);
        assert!((pane(1.5, a).1 - want).abs() < 1e-6);
    }
}

#[test]
fn a_slab_shifts_a_ray_sideways_and_keeps_its_direction() {
    let (n, thickness) = (1.5_f32, 0.3_f32);
    for degrees in [5.0_f32, 30.0, 60.0, 85.0] {
        let (sin, cos) = float::sin_cos(degrees.to_radians());
        let wo = Vec3::new(-sin, 0.0, cos);
        let inside = refract(wo, Vec3::Z, n).unwrap();
        let exit = inside * (thickness / -inside.z);
        let direction = refract(-inside, Vec3::Z, 1.0 / n).unwrap();
        assert!((direction + wo).length() < 2e-6);
        let shift = (exit - direction * exit.dot(direction)).length();
        let want = thickness * sin * (1.0 - cos / (n * n - sin * sin).sqrt());
        assert!((shift - want).abs() < 1e-6, "{degrees} deg: {shift} not {want}");
    }
}

#[test]
fn a_ball_lens_focuses_at_its_focal_length() {
    for (n, radius) in [(1.5_f32, 1.0_f32), (1.333, 2.0), (1.8, 0.5)] {
        let height = 0.005 * radius;
        let p = Vec3::new(height, 0.0, -(radius * radius - height * height).sqrt());
        let inside = refract(-Vec3::Z, p / radius, n).unwrap();
        let q = p + inside * (-2.0 * p.dot(inside));
        let out = refract(-inside, -q / radius, 1.0 / n).unwrap();
        let focus = q.z - q.x * out.z / out.x;
        let want = n * radius / (2.0 * (n - 1.0));
        assert!((focus / want - 1.0).abs() < 3e-4, "n = {n}: {focus} not {want}");
    }
}

/// Deviation of a ray by a prism of apex angle `apex` for the angle of incidence `i`; `None` where the second face
/// reflects totally.
fn deviation(n: f32, apex: f32, i: f32) -> Option<f32> {
    // Faces meet at the origin; outer normals at ±(90° - apex / 2) from straight down the base.
    let (sin, cos) = float::sin_cos(0.5 * apex);
    let (left, right) = (Vec3::new(-cos, sin, 0.0), Vec3::new(cos, sin, 0.0));
    let tangent = Vec3::new(-sin, -cos, 0.0);
    let wo = left * float::cos(i) + tangent * float::sin(i);
    let inside = refract(wo, left, n)?;
    let out = refract(-inside, -right, 1.0 / n)?;
    Some(angle(-wo, out))
}

#[test]
fn a_prism_has_its_least_deviation() {
    let (n, apex) = (1.5168_f32, 60.0_f32.to_radians());
    let least = (1..900)
        .filter_map(|i| deviation(n, apex, (i as f32 * 0.1).to_radians()))
        .fold(f32::INFINITY, f32::min)
        .to_degrees();
    let want = 2.0 * float::asin(n * float::sin(0.5 * apex)).to_degrees() - 60.0;
    assert!((least - want).abs() < 1e-3, "{least} not {want}");
    assert!((least - 38.65).abs() < 0.01);
}

#[test]
fn a_diver_sees_the_whole_sky_in_snells_window() {
    let grazing = Vec3::new(1.0, 0.0, 0.0);
    let in_water = refract(grazing, Vec3::Z, 1.333).unwrap();
    assert!((angle(in_water, -Vec3::Z).to_degrees() - 48.607).abs() < 1e-2);
}

#[test]
fn the_primary_rainbow_stands_at_42_degrees() {
    // Rays into a unit drop along -z, reflected once inside; the bow is the largest angle from the antisolar point.
    let bow = (1..1000)
        .map(|i| {
            let height = i as f32 / 1000.0;
            let p = Vec3::new(height, 0.0, (1.0 - height * height).sqrt());
            let inside = refract(Vec3::Z, p, 1.333).unwrap();
            let q = p + inside * (-2.0 * p.dot(inside));
            let back = reflect(-inside, -q);
            let s = q + back * (-2.0 * q.dot(back));
            let out = refract(-back, -s, 1.0 / 1.333).unwrap();
            angle(out, Vec3::Z)
        })
        .fold(0.0, f32::max);
    assert!((bow.to_degrees() - 42.08).abs() < 0.01, "{}", bow.to_degrees());
}
