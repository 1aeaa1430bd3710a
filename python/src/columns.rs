//! Columns of particles to and from dictionaries of flat arrays.

use std::collections::HashMap;

use numpy::{Element, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sphpack::prelude::{Kind, Side};
use sphpack::{Shared, Table};

use crate::errors::wrong;

/// The particles' columns; the table is used up.
pub(crate) fn to_python<'py>(py: Python<'py>, table: Table) -> PyResult<Bound<'py, PyDict>> {
    let normal: Vec<f64> = if table.normals.is_empty() {
        Vec::new()
    } else {
        (0..table.len()).flat_map(|i| table.normal(i)).collect()
    };
    let kind: Vec<u8> = (table.kind.iter())
        .map(|&kind| place(&Kind::ALL, kind))
        .collect();
    let side: Vec<u8> = (table.side.iter())
        .map(|&side| place(&Side::ALL, side))
        .collect();
    let body: Vec<i32> = (table.body.iter())
        .map(|body| body.map_or(-1, i32::from))
        .collect();
    let every = |of: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..table.len()).map(of).collect() };
    let density = every(&|i| table.density_of(i));
    let spacing = every(&|i| table.spacing_of(i));
    let h = every(&|i| table.smoothing_length_of(i));
    let columns = PyDict::new(py);
    columns.set_item("id", PyArray1::from_vec(py, table.id))?;
    columns.set_item("kind", PyArray1::from_vec(py, kind))?;
    columns.set_item("side", PyArray1::from_vec(py, side))?;
    columns.set_item("body", PyArray1::from_vec(py, body))?;
    for (name, numbers) in [
        ("position", table.position.into_flattened()),
        ("volume", table.volume),
        ("mass", table.mass),
        ("gamma", table.gamma),
        ("residual", table.residual),
        ("normal", normal),
        ("pressure", table.pressure),
        ("distance", table.distance),
        ("density", density),
        ("spacing", spacing),
        ("h", h),
    ] {
        if !numbers.is_empty() {
            columns.set_item(name, PyArray1::from_vec(py, numbers))?;
        }
    }
    Ok(columns)
}

/// The number of a kind or a side, as in files.
fn place<T: PartialEq>(all: &[T], one: T) -> u8 {
    all.iter()
        .position(|other| *other == one)
        .unwrap_or_default() as u8
}

/// The kinds or sides that some numbers stand for.
fn named<T: Copy>(py: Python<'_>, all: &[T], numbers: Vec<u8>, name: &str) -> PyResult<Vec<T>> {
    (numbers.into_iter())
        .map(|number| all.get(usize::from(number)).copied())
        .collect::<Option<_>>()
        .ok_or_else(|| {
            let most = all.len() - 1;
            wrong(
                py,
                &format!("{name} has numbers that are none; there are 0 to {most}"),
            )
        })
}

/// The columns of [`to_python`] as a table again.
pub(crate) fn from_python(
    dimension: usize,
    stop_reason: String,
    bodies: Vec<String>,
    columns: &Bound<'_, PyDict>,
) -> PyResult<Table> {
    let py = columns.py();
    let numbers = |name: &str| column::<f64>(columns, name);
    let id: Vec<u32> = column(columns, "id")?;
    let points = |name: &str| -> PyResult<Vec<[f64; 3]>> {
        let flat = numbers(name)?;
        Ok(flat.as_chunks::<3>().0.to_vec())
    };
    let normals: HashMap<u32, [f64; 3]> = (id.iter().copied().zip(points("normal")?))
        .filter(|(_, normal)| *normal != [0.0; 3])
        .collect();
    let kind = named(py, &Kind::ALL, column(columns, "kind")?, "kind")?;
    let side = named(py, &Side::ALL, column(columns, "side")?, "side")?;
    let body = (column::<i32>(columns, "body")?.into_iter())
        .map(|body| u16::try_from(body).ok())
        .collect();
    let table = Table {
        dimension,
        stop_reason,
        bodies,
        position: points("position")?,
        kind,
        side,
        body,
        volume: numbers("volume")?,
        mass: numbers("mass")?,
        gamma: numbers("gamma")?,
        residual: numbers("residual")?,
        normals,
        pressure: numbers("pressure")?,
        distance: numbers("distance")?,
        density: numbers("density")?,
        spacing: numbers("spacing")?,
        smoothing_length: numbers("h")?,
        shared: Shared::default(),
        id,
    };
    let count = table.len();
    let always = [
        table.position.len(),
        table.kind.len(),
        table.side.len(),
        table.body.len(),
        table.volume.len(),
        table.mass.len(),
        table.gamma.len(),
        table.residual.len(),
    ];
    let sometimes = [
        table.pressure.len(),
        table.distance.len(),
        table.density.len(),
        table.spacing.len(),
        table.smoothing_length.len(),
    ];
    let is_right = always.iter().all(|&length| length == count)
        && sometimes
            .iter()
            .all(|&length| length == 0 || length == count);
    if !is_right {
        return Err(wrong(
            py,
            "the columns differ in length; all need an entry for every particle",
        ));
    }
    Ok(table)
}

/// A column; empty where there is none.
fn column<T: Element + Copy>(columns: &Bound<'_, PyDict>, name: &str) -> PyResult<Vec<T>> {
    match columns.get_item(name)? {
        Some(array) => Ok(array.cast::<PyArray1<T>>()?.readonly().as_slice()?.to_vec()),
        None => Ok(Vec::new()),
    }
}

/// Points of a flat array.
pub(crate) fn points<const D: usize>(py: Python<'_>, flat: &[f64]) -> PyResult<Vec<[f64; D]>> {
    let (points, rest) = flat.as_chunks::<D>();
    if !rest.is_empty() {
        return Err(wrong(
            py,
            "points need as many numbers each as there are dimensions",
        ));
    }
    if points.iter().flatten().any(|x| !x.is_finite()) {
        return Err(wrong(
            py,
            "a point has a coordinate that is not a finite number; remove it",
        ));
    }
    Ok(points.to_vec())
}
