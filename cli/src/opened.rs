//! A scene as it is before anything is built: its settings picked, its bodies' files read.

use crate::Error;
use crate::auto::{Picked, settled};
use crate::body_file::{BodyFile, of_body};
use crate::scene::{Fault, Scene};

/// A scene, its settings picked, its dimension, and what its bodies' files hold, in their order.
pub(crate) struct Opened {
    pub(crate) scene: Scene,
    /// What was picked for the method "auto".
    pub(crate) picked: Option<Picked>,
    pub(crate) dimension: usize,
    pub(crate) files: Vec<Option<BodyFile>>,
}

/// Reads the bodies' files, each once. Refuses scenes that do not pass [`Scene::check`], or mix dimensions.
pub(crate) fn opened(scene: &Scene) -> Result<Opened, Error> {
    let mut files = Vec::new();
    let fail = |message: String| Error::Scene {
        path: scene.path.clone(),
        at: None,
        message,
    };
    scene
        .check()
        .map_err(|Fault { message, .. }| fail(message))?;
    let mut known = scene
        .domain
        .min
        .as_ref()
        .map(|min| (min.len(), "the domain".to_owned()));
    for body in &scene.body {
        let (dimension, what) = match body.shape.file() {
            Some(file) => {
                let path = scene.resolve(file);
                let read = BodyFile::read(&path)
                    .map_err(|error| of_body(error, &scene.path, &body.name))?;
                let format = read.format;
                files.push(Some(read));
                let what = format.description();
                (format.dimension(), format!("{}, {what}", path.display()))
            }
            None => {
                files.push(None);
                (
                    body.shape.dimension().unwrap_or(3),
                    body.shape.name().to_owned(),
                )
            }
        };
        match &known {
            Some((other, of)) if *other != dimension => {
                return Err(fail(format!(
                    "body \"{}\" is {dimension}-dimensional ({what}), {of} is {other}-dimensional; all must agree",
                    body.name
                )));
            }
            Some(_) => {}
            None => known = Some((dimension, format!("body \"{}\"", body.name))),
        }
        let misfit = match dimension {
            2 if body.rotate.is_some() => {
                Some("write rotate_degrees = … instead of rotate".to_owned())
            }
            3 if body.rotate_degrees.is_some() => Some(
                "write rotate = { axis = [0, 0, 1], degrees = … } instead of rotate_degrees"
                    .to_owned(),
            ),
            _ => match &body.translate {
                Some(shift) if shift.len() != dimension => Some(format!(
                    "translate needs {dimension} entries, not {}",
                    shift.len()
                )),
                _ => None,
            },
        };
        if let Some(cure) = misfit {
            return Err(fail(format!(
                "body \"{}\" is {dimension}-dimensional; {cure}",
                body.name
            )));
        }
    }
    let dimension = known.map_or(2, |(dimension, _)| dimension);
    match &scene.domain.periodic {
        Some(periodic) if periodic.len() != dimension => Err(fail(format!(
            "domain.periodic has {} entries; it needs {dimension}, one for each axis",
            periodic.len()
        ))),
        _ => {
            // A scene that needed the dimension is another one now.
            let mut known = scene.clone();
            known.settle_diagonals(dimension);
            known
                .check()
                .map_err(|Fault { message, .. }| fail(message))?;
            let (scene, picked) = settled(&known, dimension)?;
            Ok(Opened {
                scene,
                picked,
                dimension,
                files,
            })
        }
    }
}
