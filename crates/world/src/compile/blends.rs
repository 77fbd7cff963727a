//! Materials that are made of others: none of itself, none too deep, and a back only where there is no way through.

use super::Library;
use crate::material::{Composition, Material};
use hyaline_scene::{Located, MaterialKind, SceneError};

/// Materials within materials, at most: shadow rays ask for all of them.
const DEEPEST: usize = 8;

/// Looks at what every material is made of.
///
/// # Errors
/// A material that is made of itself or nested too deeply; a back behind a finish that light passes.
pub(super) fn check(library: &Library, materials: &[Material]) -> Result<(), SceneError> {
    for index in 0..materials.len() {
        descend(library, materials, &mut vec![index])?;
        check_back(library, materials, index)?;
    }
    Ok(())
}

/// Follows the parts of the last material of `way`; the others led to it.
fn descend(library: &Library, materials: &[Material], way: &mut Vec<usize>) -> Result<(), SceneError> {
    let at = way[way.len() - 1];
    for (part, name) in parts(library, materials, at) {
        if way.contains(&part) || way.len() > DEEPEST {
            let message = if way.contains(&part) {
                format!("material '{}' is made of itself", name.value)
            } else {
                format!("material '{}' lies more than {DEEPEST} materials deep", name.value)
            };
            let error = SceneError::at(&name.source, message);
            return Err(error.with_remedy("name a material here that is complete by itself"));
        }
        way.push(part);
        descend(library, materials, way)?;
        way.pop();
    }
    Ok(())
}

/// Indices of the materials that one is made of, and where they are named.
fn parts<'a>(
    library: &'a Library,
    materials: &[Material],
    index: usize,
) -> Vec<(usize, &'a Located<String>)> {
    let description = &library.description.materials[index];
    let mut parts = Vec::new();
    if let (Composition::Blend(a, b, _), MaterialKind::Blend { first, second, .. }) =
        (&materials[index].composition, &description.kind)
    {
        parts.extend([(*a as usize, first), (*b as usize, second)]);
    }
    if let (Some(back), Some(name)) = (materials[index].back, &description.back) {
        parts.push((back as usize, name));
    }
    parts
}

/// A body of glass cannot have one boundary towards the outside and another towards the inside.
fn check_back(library: &Library, materials: &[Material], index: usize) -> Result<(), SceneError> {
    let Some(back) = materials[index].back else { return Ok(()) };
    let Some(name) = &library.description.materials[index].back else { return Ok(()) };
    if !passes(materials, index) && !passes(materials, back as usize) {
        return Ok(());
    }
    let message = format!(
        "material '{}' has '{}' on its back, and light passes one of them",
        library.description.materials[index].name, name.value
    );
    Err(SceneError::at(&name.source, message)
        .with_remedy("give a back to opaque materials alone, an opaque one"))
}

/// Whether light may cross a part of a material.
fn passes(materials: &[Material], index: usize) -> bool {
    match &materials[index].composition {
        Composition::Single(finish) => finish.is_transparent(),
        Composition::Blend(first, second, _) => {
            passes(materials, *first as usize) || passes(materials, *second as usize)
        }
    }
}
