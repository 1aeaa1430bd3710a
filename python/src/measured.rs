//! How even anybody's particles are.

use std::path::PathBuf;

use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use sphpack::Cloud;
use sphpack::prelude::{KernelKind, Kind};

use crate::errors::{raised, wrong};

/// The figures and the audit of `sphpack quality`, as JSON. `position` has three numbers for each particle, z = 0 in the plane.
#[pyfunction]
#[pyo3(signature = (position, dimension, spacing, kernel, h_over_spacing, volume=None, frozen=None))]
#[allow(
    clippy::too_many_arguments,
    reason = "what Python passes by name is one argument each here"
)]
pub(crate) fn quality(
    py: Python<'_>,
    position: PyReadonlyArray1<'_, f64>,
    dimension: usize,
    spacing: f64,
    kernel: &str,
    h_over_spacing: f64,
    volume: Option<PyReadonlyArray1<'_, f64>>,
    frozen: Option<PyReadonlyArray1<'_, bool>>,
) -> PyResult<String> {
    for (name, value) in [("spacing", spacing), ("h_over_spacing", h_over_spacing)] {
        if !(value > 0.0 && value.is_finite()) {
            let message = format!("{name} is {value}; it must be a positive, finite number");
            return Err(wrong(py, &message));
        }
    }
    let kernel =
        (kernel.parse::<KernelKind>()).map_err(|unknown| wrong(py, &unknown.to_string()))?;
    let position: Vec<[f64; 3]> = crate::columns::points(py, position.as_slice()?)?;
    let count = position.len();
    let volume = match volume {
        Some(volume) => volume.as_slice()?.to_vec(),
        None => vec![spacing.powi(dimension as i32); count],
    };
    let kind: Vec<Kind> = match frozen {
        Some(frozen) => (frozen.as_slice()?.iter())
            .map(|&frozen| if frozen { Kind::Frozen } else { Kind::Free })
            .collect(),
        None => vec![Kind::Free; count],
    };
    if count == 0 || volume.len() != count || kind.len() != count {
        return Err(wrong(
            py,
            "there must be particles, and a volume and a mark for each where these are given",
        ));
    }
    let cloud = Cloud {
        path: PathBuf::from("particles"),
        dimension,
        position,
        volume,
        kind,
        id: None,
        gamma: None,
        distance: None,
        smoothing_length: None,
        sizes: None,
        normal: None,
    };
    py.detach(|| {
        cloud
            .report(spacing, kernel, h_over_spacing)
            .map(|report| report.to_json())
    })
    .map_err(|e| raised(py, &e))
}
