//! Bodies: distances, what is inside, points on the surface; and what is wrong with a file.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use sphpack::prelude::geometry::{Sketch, Soup};
use sphpack::prelude::{Closest, Surface};
use sphpack::{Error, Examine, Examined, Mend, body_format};

use crate::columns::points;
use crate::errors::{raised, wrong};

/// Queries that one thread takes at a time, at least.
const AT_ONCE: usize = 256;

type Flat<'py> = Bound<'py, PyArray1<f64>>;

#[derive(Debug, Clone)]
enum Held {
    Plane(Arc<dyn Surface<2>>),
    Space(Arc<dyn Surface<3>>),
}

/// A closed outline or mesh.
#[pyclass(frozen, module = "sphpack._native")]
#[derive(Debug)]
pub(crate) struct Body(Held);

/// Runs a line with the surface, whatever its dimension.
macro_rules! with_surface {
    ($body:expr, $surface:ident => $work:expr) => {
        match &$body.0 {
            Held::Plane($surface) => $work,
            Held::Space($surface) => $work,
        }
    };
}

#[pymethods]
impl Body {
    /// A body from a file, mended as packing mends it.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = py.detach(|| -> Result<Held, Error> {
            let of =
                |error: sphpack::prelude::geometry::GeometryError| Error::Usage(error.to_string());
            if body_format(&path)?.dimension() == 2 {
                let outline = Sketch::read(&path)
                    .and_then(|sketch| sketch.body())
                    .map_err(of)?;
                return Ok(Held::Plane(Arc::new(outline.outline)));
            }
            let mesh = Soup::read(&path).and_then(|soup| soup.body()).map_err(of)?;
            Ok(Held::Space(Arc::new(mesh.mesh)))
        });
        read.map(Self).map_err(|e| raised(py, &e))
    }

    /// A body within closed loops of points.
    #[staticmethod]
    fn outline(py: Python<'_>, loops: Vec<PyReadonlyArray1<'_, f64>>) -> PyResult<Self> {
        let loops = (loops.iter())
            .map(|flat| points::<2>(py, flat.as_slice()?))
            .collect::<PyResult<Vec<_>>>()?;
        let mended = py.detach(|| Sketch::new(loops).and_then(|sketch| sketch.body()));
        let mended = mended.map_err(|e| wrong(py, &e.to_string()))?;
        Ok(Self(Held::Plane(Arc::new(mended.outline))))
    }

    /// A body within triangles, three places in `vertices` each.
    #[staticmethod]
    fn mesh(
        py: Python<'_>,
        vertices: PyReadonlyArray1<'_, f64>,
        triangles: PyReadonlyArray1<'_, u32>,
    ) -> PyResult<Self> {
        let vertices = points::<3>(py, vertices.as_slice()?)?;
        let triangles = triangles.as_slice()?.as_chunks::<3>().0.to_vec();
        let mended = py.detach(|| Soup::new(vertices, triangles).and_then(|soup| soup.body()));
        let mended = mended.map_err(|e| wrong(py, &e.to_string()))?;
        Ok(Self(Held::Space(Arc::new(mended.mesh))))
    }

    /// 2 or 3.
    #[getter]
    fn dimension(&self) -> usize {
        match self.0 {
            Held::Plane(_) => 2,
            Held::Space(_) => 3,
        }
    }

    /// Length of the outline, or area of the surface.
    #[getter]
    fn measure(&self) -> f64 {
        with_surface!(self, surface => surface.measure())
    }

    /// Area or volume.
    #[getter]
    fn volume(&self) -> f64 {
        with_surface!(self, surface => surface.volume())
    }

    /// Lower and upper corner of the smallest box around it.
    #[getter]
    fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        with_surface!(self, surface => {
            let bounds = surface.bounds();
            (bounds.min.to_vec(), bounds.max.to_vec())
        })
    }

    /// Signed distances, nearest points and outward normals there.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<(Flat<'py>, Flat<'py>, Flat<'py>)> {
        let flat = places.as_slice()?;
        with_surface!(self, surface => {
            let places = points(py, flat)?;
            let hits: Vec<Closest<_>> = py.detach(|| {
                (places.par_iter().with_min_len(AT_ONCE)).map(|&p| surface.closest(p)).collect()
            });
            Ok((
                PyArray1::from_vec(py, hits.iter().map(|hit| hit.distance).collect()),
                PyArray1::from_vec(py, hits.iter().flat_map(|hit| hit.point).collect()),
                PyArray1::from_vec(py, hits.iter().flat_map(|hit| hit.normal).collect()),
            ))
        })
    }

    /// Which places are inside.
    fn inside<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let flat = places.as_slice()?;
        with_surface!(self, surface => {
            let places = points(py, flat)?;
            let inside = py.detach(|| surface.inside_batch(&places));
            Ok(PyArray1::from_vec(py, inside))
        })
    }

    /// So many points, evenly spread over the surface, corners and edges first; and the outward normals there.
    fn sample<'py>(&self, py: Python<'py>, count: usize) -> PyResult<(Flat<'py>, Flat<'py>)> {
        with_surface!(self, surface => {
            let hits = py.detach(|| surface.sample(count));
            let hits = hits.map_err(|e| wrong(py, &e.to_string()))?;
            Ok((
                PyArray1::from_vec(py, hits.iter().flat_map(|hit| hit.point).collect()),
                PyArray1::from_vec(py, hits.iter().flat_map(|hit| hit.normal).collect()),
            ))
        })
    }
}

/// What can be said of a body's file before it is packed, as JSON.
#[pyfunction]
#[pyo3(signature = (path, spacing=None))]
pub(crate) fn check(py: Python<'_>, path: PathBuf, spacing: Option<f64>) -> PyResult<String> {
    let what = Examine {
        spacing,
        mend: Mend::AsPacking,
    };
    let found = py.detach(|| Examined::of(&path, &what).map(|(found, _)| found.to_json()));
    found.map_err(|e| raised(py, &e))
}
