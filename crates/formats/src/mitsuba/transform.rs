//! `<transform>`: translate, rotate, scale, lookat and matrix, applied in order.

use super::tree::Property;
use crate::Result;
use hyaline_math::{DMat3, DVec3, Transform};

/// The map that a transform describes.
///
/// # Errors
/// A step that is unknown, malformed or can't be inverted.
pub(super) fn read(property: &Property) -> Result<Transform> {
    // An animation counts by its first transform, which the caller notes.
    let steps = match property.tag.as_str() {
        "animation" => property.steps.first().map_or(&[][..], |first| &first.steps),
        _ => &property.steps,
    };
    let mut total = Transform::IDENTITY;
    for step in steps {
        total = read_step(step)?.after(&total);
        let is_finite = total.linear().is_finite() && total.inverse().linear().is_finite();
        if !is_finite || !total.translation().is_finite() {
            return Err(step.error("the steps of the transform leave the range of numbers"));
        }
    }
    Ok(total)
}

fn read_step(step: &Property) -> Result<Transform> {
    match step.tag.as_str() {
        "translate" => Ok(Transform::translate(step.vector(0.0)?)),
        "rotate" => {
            let degrees = step.text("angle").map_or(Ok(0.0), |angle| step.parse(angle))?;
            let axis = step.triple("axis")?.map_or_else(|| step.vector(0.0), Ok)?;
            Transform::rotate(axis, degrees.to_radians())
                .ok_or_else(|| step.error("the axis of the rotation has no length"))
        }
        "scale" => Transform::scale(step.vector(1.0)?)
            .ok_or_else(|| step.error("a factor of the scaling is 0 or nearly so")),
        "lookat" => look_at(step),
        "matrix" => matrix(step),
        other => Err(step
            .error(format!("unknown step <{other}> of a transform"))
            .with_remedy("the steps are translate, rotate, scale, lookat and matrix")),
    }
}

/// Mitsuba's look-at: local +z points to the target, +x to the left of the view.
fn look_at(step: &Property) -> Result<Transform> {
    let need = |key: &str| {
        step.triple(key)?.ok_or_else(|| step.error(format!("<lookat> needs the attribute `{key}`")))
    };
    let (origin, target) = (need("origin")?, need("target")?);
    let forward = (target - origin).try_normalize();
    let forward = forward.ok_or_else(|| step.error("`origin` and `target` coincide"))?;
    let up = step.triple("up")?.filter(|up| *up != DVec3::ZERO);
    let up = up.unwrap_or_else(|| if forward.y.abs() > 0.999 { DVec3::Z } else { DVec3::Y });
    let left = up.cross(forward).try_normalize();
    let left =
        left.ok_or_else(|| step.error("`up` is zero or parallel to the view").with_remedy("turn `up`"))?;
    Transform::from_parts(DMat3::from_cols(left, forward.cross(left), forward), origin)
        .ok_or_else(|| step.error("the look-at can't be inverted"))
}

/// A matrix by rows: 16 numbers, or 9 for a linear map.
fn matrix(step: &Property) -> Result<Transform> {
    let numbers = step.numbers(step.value()?)?;
    let mut rows = [[0.0, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
    let side = match numbers.len() {
        9 => 3,
        16 => 4,
        count => return Err(step.error(format!("a matrix must have 9 or 16 numbers, not {count}"))),
    };
    for (row, values) in rows.iter_mut().zip(numbers.chunks_exact(side)) {
        row[..side].copy_from_slice(values);
    }
    if rows[3] != [0.0, 0.0, 0.0, 1.0] {
        return Err(step.error("the last row of a matrix must be 0 0 0 1"));
    }
    Transform::from_rows(rows).ok_or_else(|| {
        step.error("the matrix can't be inverted: it makes the shape flat")
            .with_remedy("check it for zero columns")
    })
}
