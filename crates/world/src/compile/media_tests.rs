use super::*;
use crate::World;
use hyaline_math::Transform;
use hyaline_scene::{
    BoundaryDescription, MaterialDescription, MaterialKind, ObjectDescription, Scattering, SceneDescription,
    ShapeDescription,
};

/// A medium that scatters, in a box of sides 1, 1 and 2 where it has densities.
fn medium(sigma_s: f32, densities: &[f32]) -> Located<MediumDescription> {
    let size = [densities.len() as u32, 1, 1];
    let density = (!densities.is_empty()).then(|| DensityGrid {
        density: Arc::new(GridData { size, channels: 1, values: densities.to_vec() }),
        albedo: None,
        placement: Transform::scale(DVec3::new(1.0, 1.0, 2.0)).unwrap(),
    });
    let scattering = Some(Scattering { sigma_s: [0.0, 0.0, sigma_s], phase: PhaseDescription::Isotropic });
    let clear = MediumDescription::clear("smoke", IndexDescription::Constant(1.0));
    MediumDescription { density, scattering, ..clear }.into()
}

fn fault(description: &Located<MediumDescription>) -> String {
    compile(description).err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn grids_of_too_many_free_paths_are_refused() {
    for (sigma_s, densities) in [
        (1e20, &[1e9, 1.0][..]),
        (1.0, &[1e-3, 1e9]),
        (10.0, &[3e38]),
        (1e38, &[1e-31]),
        // Along the diagonal, √6, a little more than 1e7.
        (1e6, &[0.0, 4.1]),
    ] {
        let error = fault(&medium(sigma_s, densities));
        assert!(error.contains("the grid of medium 'smoke' is too dense"), "{sigma_s}: {error}");
        assert!(error.contains("mean free paths") && error.contains("solid with a surface"), "{error}");
    }
    for (sigma_s, densities) in [(1e6, &[0.0, 4.0][..]), (0.0, &[3e38]), (1e20, &[0.0]), (1e30, &[])] {
        assert_eq!(fault(&medium(sigma_s, densities)), "", "{sigma_s} {densities:?}");
    }
}

#[test]
fn grids_that_only_shine_are_as_dense_as_steps_can_be() {
    let glowing = |density: f32| {
        let mut description = medium(0.0, &[density]);
        description.emission = [1.0, 0.0, 0.0];
        fault(&description)
    };
    assert!(glowing(1e9).contains("too dense"));
    assert_eq!(glowing(1e6), "");
}

#[test]
fn coefficients_whose_sum_is_not_finite_are_refused() {
    let with_absorption = |sigma_a: f32| {
        let mut description = medium(3e38, &[]);
        description.absorption = Absorption::SigmaA([0.0, 0.0, sigma_a]);
        fault(&description)
    };
    assert!(with_absorption(3e38).contains("whose sum is not finite; lower its coefficients"));
    assert!(with_absorption(f32::INFINITY).contains("medium 'smoke' has absorption"));
    assert_eq!(with_absorption(1.0), "");
}

#[test]
fn unknown_media_may_have_meant_a_measured_liquid() {
    let remedy = |name: &str| {
        let mut scene = SceneDescription::default();
        scene.media.push(medium(1.0, &[]));
        scene.materials.push(MaterialDescription::new("black", MaterialKind::Black).into());
        let object = ObjectDescription {
            name: "ball".into(),
            shape: ShapeDescription::Box { min: DVec3::ZERO, max: DVec3::ONE, radius: 0.0 },
            placement: Transform::IDENTITY,
            boundary: BoundaryDescription::Solid { medium: name.into() },
            material: "black".into(),
            slot_materials: Vec::new(),
            emission: None,
        };
        scene.objects.push(object.into());
        let faults = World::compile_or_all_faults(&scene).err().unwrap_or_default();
        let told = faults.iter().find(|fault| fault.message.contains("no medium is named"));
        told.and_then(|fault| fault.remedy.clone()).unwrap_or_default()
    };
    assert_eq!(remedy("wohle milk"), "did you mean 'whole milk'?");
    assert_eq!(remedy("coffe"), "did you mean 'coffee'?");
    assert_eq!(remedy("smok"), "did you mean 'smoke'?");
}
