//! Smoothing kernels by name.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use sphpack::prelude::kernels::WithKernel;
use sphpack::prelude::{Kernel, KernelKind};

use crate::errors::wrong;

type Numbers<'py> = Bound<'py, PyArray1<f64>>;

/// Values and slopes at some distances.
struct Evaluate<'a>(&'a [f64]);

impl<const D: usize> WithKernel<D> for Evaluate<'_> {
    type Output = (Vec<f64>, Vec<f64>);

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        (self.0.iter())
            .map(|&r| kernel.value_and_slope(r.abs()))
            .unzip()
    }
}

fn kind(py: Python<'_>, name: &str) -> PyResult<KernelKind> {
    (name.parse::<KernelKind>()).map_err(|unknown| wrong(py, &unknown.to_string()))
}

/// Where a kernel ends, in units of h.
#[pyfunction]
pub(crate) fn kernel_support(py: Python<'_>, name: &str) -> PyResult<f64> {
    kind(py, name).map(KernelKind::support_over_h)
}

/// W and dW/dr of a kernel in `dimension` (1, 2 or 3) dimensions at distances `r`.
#[pyfunction]
pub(crate) fn kernel_values<'py>(
    py: Python<'py>,
    name: &str,
    dimension: usize,
    h: f64,
    r: PyReadonlyArray1<'py, f64>,
) -> PyResult<(Numbers<'py>, Numbers<'py>)> {
    let kind = kind(py, name)?;
    if !(h > 0.0 && h.is_finite()) {
        return Err(wrong(
            py,
            &format!("h is {h}; it must be a positive, finite number"),
        ));
    }
    let work = Evaluate(r.as_slice()?);
    let (values, slopes) = match dimension {
        1 => kind.with::<1, _>(h, work),
        2 => kind.with::<2, _>(h, work),
        3 => kind.with::<3, _>(h, work),
        _ => {
            return Err(wrong(
                py,
                &format!("dimension is {dimension}; it must be 1, 2 or 3"),
            ));
        }
    };
    Ok((
        PyArray1::from_vec(py, values),
        PyArray1::from_vec(py, slopes),
    ))
}
