//! `transform`: a table with one of `translate`, `rotate`, `scale`, `matrix`, or an array of such, applied in order.
//!
//! `rotate = { axis = [0, 1, 0], degrees = 30 }` (the axis may be "x", "y" or "z"), `scale` a number or a triple,
//! `matrix` three or four rows of four numbers, acting on columns.

use super::field::Field;
use crate::Result;
use crate::limits::Limits;
use hyaline_math::{DVec3, Transform};

/// Factors and angles beyond this have no use and would overflow.
const NUMBERS: Limits = Limits::between(-1e12, 1e12);

/// Reads a transform or a list of them.
pub(super) fn read(field: Field<'_>, metres: f64) -> Result<Transform> {
    let mut total = Transform::IDENTITY;
    for item in field.items_or_one()? {
        total = step(item, metres)?.after(&total);
        let is_finite = total.linear().is_finite() && total.translation().is_finite();
        if !is_finite || !total.inverse().linear().is_finite() {
            return Err(item.error("the transforms together leave the range of numbers"));
        }
    }
    Ok(total)
}

fn step(field: Field<'_>, metres: f64) -> Result<Transform> {
    let mut table = field.table("transform")?;
    let keys = ["translate", "rotate", "scale", "matrix"];
    let chosen = table.take_one(&keys).map_err(|error| {
        error
            .with_remedy("several steps are an array: transform = [{ scale = 2 }, { translate = [0, 1, 0] }]")
    })?;
    table.finish()?;
    let Some(chosen) = chosen else {
        return Err(field.error("an empty transform").with_remedy("give translate, rotate, scale or matrix"));
    };
    match chosen.key {
        "translate" => Ok(Transform::translate(chosen.point(metres)?)),
        "rotate" => rotation(chosen),
        "scale" => scaling(chosen),
        _ => matrix(chosen, metres),
    }
}

fn rotation(field: Field<'_>) -> Result<Transform> {
    let mut table = field.table("rotate")?;
    let axis = table.require("axis", "[0, 1, 0]")?;
    let degrees = table.require("degrees", "30")?.number(NUMBERS)?;
    table.finish()?;
    let direction = match axis.string() {
        Ok(_) => axis.choice(&[("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z)])?,
        Err(_) => axis.direction()?,
    };
    Transform::rotate(direction, degrees.to_radians()).ok_or_else(|| axis.error("the axis has no length"))
}

fn scaling(field: Field<'_>) -> Result<Transform> {
    let factors = match field.items() {
        Ok(_) => DVec3::from_array(field.array(|item| item.number(NUMBERS))?),
        Err(_) => DVec3::splat(field.number(NUMBERS)?),
    };
    Transform::scale(factors).ok_or_else(|| field.error("a factor of `scale` is 0 or nearly so"))
}

fn matrix(field: Field<'_>, metres: f64) -> Result<Transform> {
    let rows = field.items()?;
    let shape = || field.error("`matrix` must be three or four rows of four numbers");
    if rows.len() != 3 && rows.len() != 4 {
        return Err(shape());
    }
    let mut matrix = [[0.0, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
    for (target, row) in matrix.iter_mut().zip(rows) {
        let items = row.items().map_err(|_| shape())?;
        if items.len() != 4 {
            return Err(shape());
        }
        for (value, item) in target.iter_mut().zip(&items[..3]) {
            *value = item.number(NUMBERS)?;
        }
        target[3] = items[3].length(metres, NUMBERS)?;
    }
    Transform::from_rows(matrix)
        .ok_or_else(|| field.error("`matrix` can't be inverted, or its last row is not [0, 0, 0, 1]"))
}
