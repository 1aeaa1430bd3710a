//! Who is near whom.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use sphpack::prelude::{Bounds, CellList, Domain};

use crate::columns::points;
use crate::errors::wrong;

/// Numbers of the particles near each, one list behind the other, and where each list begins.
type Lists = (Vec<u32>, Vec<u64>);

/// [`Lists`] as arrays.
type Arrays<'py> = (Bound<'py, PyArray1<u32>>, Bound<'py, PyArray1<u64>>);

/// The box, and which of its sides are periodic.
type Box = (Vec<f64>, Vec<f64>, Vec<bool>);

/// For every point those at most `radius` away, itself left out: all one behind the other, ascending for each, and where each one's
/// begin, the end of all last. `periodic` is a box (lower and upper corner) with the axes that wrap around.
#[pyfunction]
#[pyo3(signature = (places, dimension, radius, periodic=None))]
pub(crate) fn neighbors<'py>(
    py: Python<'py>,
    places: PyReadonlyArray1<'py, f64>,
    dimension: usize,
    radius: f64,
    periodic: Option<Box>,
) -> PyResult<Arrays<'py>> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(wrong(
            py,
            &format!("the radius is {radius}; it must be a positive, finite number"),
        ));
    }
    let flat = places.as_slice()?;
    let (indices, starts) = match dimension {
        2 => found(py, points::<2>(py, flat)?, radius, periodic)?,
        3 => found(py, points::<3>(py, flat)?, radius, periodic)?,
        _ => {
            return Err(wrong(
                py,
                &format!("the points are in {dimension} dimensions; there must be 2 or 3"),
            ));
        }
    };
    Ok((
        PyArray1::from_vec(py, indices),
        PyArray1::from_vec(py, starts),
    ))
}

fn found<const D: usize>(
    py: Python<'_>,
    points: Vec<[f64; D]>,
    radius: f64,
    periodic: Option<Box>,
) -> PyResult<Lists> {
    if points.is_empty() {
        return Ok((Vec::new(), vec![0]));
    }
    let domain = match periodic {
        None => {
            let bounds = Bounds::of(&points).grown(radius);
            Domain::new(bounds.min, bounds.max)
        }
        Some((min, max, axes)) => {
            let corners = <[f64; D]>::try_from(min)
                .ok()
                .zip(<[f64; D]>::try_from(max).ok());
            let (Some((min, max)), Ok(axes)) = (corners, <[bool; D]>::try_from(axes)) else {
                return Err(wrong(py, "the periodic box needs a number for every axis"));
            };
            if (0..D).any(|k| {
                let size = max[k] - min[k];
                !(size > 0.0 && size.is_finite()) || axes[k] && size < 2.0 * radius
            }) {
                return Err(wrong(
                    py,
                    "the box must have a size, and be two radii long along periodic axes",
                ));
            }
            Domain::new(min, max).with_periodic(axes)
        }
    };
    Ok(py.detach(|| {
        let wrapped: Vec<[f64; D]> = points.iter().map(|&p| domain.wrap(p)).collect();
        let mut list = CellList::new(&domain, radius);
        list.update(&wrapped);
        let near: Vec<Vec<usize>> = (0..wrapped.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|i| list.of(i, &wrapped))
            .collect();
        let mut starts = Vec::with_capacity(near.len() + 1);
        let mut indices = Vec::with_capacity(near.iter().map(Vec::len).sum());
        starts.push(0);
        for list in near {
            indices.extend(list.into_iter().map(|j| j as u32));
            starts.push(indices.len() as u64);
        }
        (indices, starts)
    }))
}
