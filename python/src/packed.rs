//! Packing: on a thread of its own, while this one listens to Ctrl-C and tells how far it is.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sphpack::prelude::packing::{Observer, Progress};
use sphpack::{Error, Options, Outcome, Scene, files};

use crate::columns::{from_python, to_python};
use crate::errors::raised;

/// How long Ctrl-C may wait.
const TICK: Duration = Duration::from_millis(50);

/// The most threads that make sense.
const MAX_THREADS: usize = 1024;

/// Passes on how far the packing is, and stops it when asked to.
struct Watcher {
    told: Sender<Progress>,
    is_stopped: Arc<AtomicBool>,
}

impl Observer for Watcher {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        // Nobody listens any more: that is no reason to stop.
        let _ = self.told.send(*progress);
        if self.is_stopped.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// A packing at work.
struct Work {
    heard: Receiver<Progress>,
    is_stopped: Arc<AtomicBool>,
    thread: JoinHandle<Result<Outcome, Error>>,
}

impl Work {
    fn begin(scene: Scene, threads: Option<usize>, memory: Option<f64>) -> Result<Self, Error> {
        let pool = match threads {
            Some(number) if !(1..=MAX_THREADS).contains(&number) => {
                return Err(Error::Usage(format!(
                    "threads is {number}; it must be from 1 to {MAX_THREADS}"
                )));
            }
            Some(number) => Some(
                rayon::ThreadPoolBuilder::new()
                    .num_threads(number)
                    .build()
                    .map_err(|e| {
                        Error::System(format!(
                            "{number} threads cannot be started ({e}); use fewer"
                        ))
                    })?,
            ),
            None => None,
        };
        let (told, heard) = mpsc::channel();
        let is_stopped = Arc::new(AtomicBool::new(false));
        let mut watcher = Watcher {
            told,
            is_stopped: Arc::clone(&is_stopped),
        };
        let options = Options {
            memory_bytes: memory,
        };
        let thread = thread::Builder::new()
            .name("sphpack".into())
            .spawn(move || {
                let mut work = || sphpack::run(&scene, &options, &mut watcher);
                match pool {
                    Some(pool) => pool.install(work),
                    None => work(),
                }
            })
            .map_err(|e| Error::System(format!("a thread cannot be started ({e})")))?;
        Ok(Self {
            heard,
            is_stopped,
            thread,
        })
    }

    /// Waits for the end, and says what interrupted it, if anything did.
    fn watch(
        mut self,
        py: Python<'_>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> (thread::Result<Result<Outcome, Error>>, Option<PyErr>) {
        let mut interrupted: Option<PyErr> = None;
        loop {
            let heard = &mut self.heard;
            let news = py.detach(move || match heard.recv_timeout(TICK) {
                // What was said since counts, not what was said first.
                Ok(first) => Ok(heard.try_iter().last().unwrap_or(first)),
                Err(error) => Err(error),
            });
            let told = match (&news, progress) {
                (Err(RecvTimeoutError::Disconnected), _) => break,
                (Ok(news), Some(listener)) if interrupted.is_none() => tell(py, news, listener),
                _ => Ok(()),
            };
            if let Err(error) = told.and_then(|()| py.check_signals()) {
                self.is_stopped.store(true, Ordering::Relaxed);
                interrupted.get_or_insert(error);
            }
        }
        let thread = self.thread;
        (py.detach(|| thread.join()), interrupted)
    }
}

/// Tells a listener how far the packing is.
fn tell(py: Python<'_>, news: &Progress, listener: &Bound<'_, PyAny>) -> PyResult<()> {
    let told = PyDict::new(py);
    told.set_item("stage", news.stage.name())?;
    told.set_item("evaluation", news.evaluation)?;
    told.set_item("max_evaluations", news.max_evaluations)?;
    told.set_item("criterion", news.criterion)?;
    told.set_item("tolerance", news.tolerance)?;
    told.set_item("on_surface", news.on_surface)?;
    told.set_item("target", news.target)?;
    told.set_item("seconds", news.seconds)?;
    listener.call1((told,)).map(drop)
}

/// Packs a scene's text: the columns of the particles that it includes, the report as JSON, and whatever interrupted it.
/// `path` is for messages, and other paths are relative to its folder.
#[pyfunction]
#[pyo3(signature = (text, path, threads=None, memory=None, progress=None))]
pub(crate) fn pack<'py>(
    py: Python<'py>,
    text: &str,
    path: PathBuf,
    threads: Option<usize>,
    memory: Option<f64>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, String, Option<PyErr>)> {
    let scene = Scene::parse(text, path).map_err(|e| raised(py, &e))?;
    let kept = scene.clone();
    let work = Work::begin(scene, threads, memory).map_err(|e| raised(py, &e))?;
    let (ended, interrupted) = work.watch(py, progress.as_ref());
    let outcome = match ended {
        Ok(Ok(outcome)) => outcome,
        Ok(Err(error)) => return Err(interrupted.unwrap_or_else(|| raised(py, &error))),
        Err(_) => {
            return Err(PyRuntimeError::new_err(
                "sphpack has failed in a way that it should not; please report the scene",
            ));
        }
    };
    let report = outcome.report.to_json();
    let rows = py.detach(move || {
        let mut outcome = outcome;
        let table = std::mem::take(&mut outcome.table);
        outcome.included(table, &kept)
    });
    Ok((to_python(py, rows)?, report, interrupted))
}

/// What a scene would take: particles, memory, seconds on one thread and evaluations.
#[pyfunction]
pub(crate) fn plan<'py>(
    py: Python<'py>,
    text: &str,
    path: PathBuf,
) -> PyResult<Bound<'py, PyDict>> {
    let planned = py.detach(|| {
        let scene = Scene::parse(text, path)?;
        sphpack::plan(&scene, None)
    });
    let planned = planned.map_err(|e| raised(py, &e))?;
    let estimate = planned.estimate;
    let told = PyDict::new(py);
    told.set_item("dimension", planned.dimension)?;
    told.set_item("particles", estimate.particles as u64)?;
    told.set_item("frozen", estimate.frozen as u64)?;
    told.set_item("neighbors", estimate.neighbors)?;
    told.set_item("memory_bytes", estimate.memory_bytes)?;
    told.set_item("evaluations", planned.evaluations)?;
    told.set_item("times_fewer", planned.times_fewer)?;
    Ok(told)
}

/// Writes columns into a file whose ending says the format.
#[pyfunction]
pub(crate) fn save(
    py: Python<'_>,
    path: PathBuf,
    force: bool,
    dimension: usize,
    stop_reason: String,
    bodies: Vec<String>,
    columns: &Bound<'_, PyDict>,
) -> PyResult<()> {
    let table = from_python(dimension, stop_reason, bodies, columns)?;
    py.detach(|| files::save(&table, &path, force))
        .map_err(|e| raised(py, &e))
}
