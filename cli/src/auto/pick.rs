//! Which settings `method = "auto"` takes.

use serde::Serialize;
use sphpack_kernels::KernelKind;
use toml::{Table, Value};

use super::table::{Choice, front};
use crate::Error;
use crate::scene::{AccuracyMeasure, Method, PackingSpec, Scene};

/// The kernel that the table is judged by, and its h/∆s.
const TABLE_JUDGE: (KernelKind, f64) = (KernelKind::Quintic, 1.2);

/// Keys that say nothing about what the method that is picked does.
const BESIDE: [&str; 6] = [
    "method",
    "accuracy",
    "seed",
    "velocity_tolerance",
    "hybrid",
    "agitated",
];

/// What was picked for a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Picked {
    /// What was asked for; `None` where nothing was.
    pub measure: Option<AccuracyMeasure>,
    /// And how small.
    pub asked: Option<f64>,
    /// The name of the settings in docs/chart.md.
    pub name: String,
    /// Keys of `[packing]` that differ from the default's.
    pub settings: Table,
    /// What they come to at worst on the charted scenes: of `measure`, or of linf.
    pub charted: f64,
    /// Their pairs over the default's there.
    pub cost: f64,
    /// Settings of the scene that stay although the table is without them, such as `finish = "even"`.
    pub kept: Vec<String>,
    /// The kernel and h/∆s that judge the scene, where they are not the table's.
    pub judged_by: Option<String>,
    /// The accuracy and the name of the next more accurate settings.
    #[serde(skip)]
    pub(super) finer: Option<(f64, String)>,
}

/// A scene with its settings picked, and what was picked; the scene as it is where its method is another than "auto".
///
/// # Errors
/// [`Error::Scene`] where the scene's own settings exclude all others.
pub(crate) fn settled(scene: &Scene, dimension: usize) -> Result<(Scene, Option<Picked>), Error> {
    if scene.packing.method != Method::Auto {
        return Ok((scene.clone(), None));
    }
    let asked = (scene.packing.accuracy.as_ref()).and_then(|accuracy| accuracy.asked());
    let measure = asked.map_or(AccuracyMeasure::Linf, |(measure, _)| measure);
    // What the scene cannot have, with many sizes of particles or by its own settings, is not there for it.
    let mut possible: Vec<(Choice, Scene, Vec<String>)> = Vec::new();
    for choice in front(dimension, measure)? {
        let (with, kept) = applied(scene, &choice.settings)?;
        if with.check().is_ok() {
            possible.push((choice, with, kept));
        }
    }
    let number = match asked {
        Some((_, most)) => (possible.iter())
            .position(|(choice, ..)| choice.accuracy <= most)
            .unwrap_or(possible.len().saturating_sub(1)),
        None => usual(&possible),
    };
    let finer = (possible.get(number + 1)).map(|(next, ..)| (next.accuracy, next.name.clone()));
    if number >= possible.len() {
        let (with, _) = applied(scene, &Table::new())?;
        let message = match with.check() {
            Err(fault) => fault.message,
            Ok(()) => format!(
                "no settings are charted for {measure} that this scene can have; name a method instead of \"auto\""
            ),
        };
        return Err(Error::Scene {
            path: scene.path.clone(),
            at: None,
            message,
        });
    }
    let (choice, with, kept) = possible.swap_remove(number);
    let judge = scene.judge();
    let picked = Picked {
        measure: asked.map(|(measure, _)| measure),
        asked: asked.map(|(_, most)| most),
        name: choice.name,
        settings: choice.settings,
        charted: choice.accuracy,
        cost: choice.cost,
        kept,
        judged_by: (judge != TABLE_JUDGE).then(|| kernel_words(judge)),
        finer,
    };
    Ok((with, Some(picked)))
}

fn kernel_words((kernel, h): (KernelKind, f64)) -> String {
    format!("{kernel} at h/∆s = {h}")
}

/// Where nothing is asked for: the default, or where something beats that, the least product of cost and accuracy, which on double
/// logarithmic axes is nearest to the corner.
fn usual(possible: &[(Choice, Scene, Vec<String>)]) -> usize {
    let product = |i: usize| possible[i].0.cost * possible[i].0.accuracy;
    let default = (possible.iter()).position(|(choice, ..)| choice.settings.is_empty());
    let best = || (0..possible.len()).min_by(|&a, &b| product(a).total_cmp(&product(b)));
    default.or_else(best).unwrap_or(0)
}

/// The scene with these settings, and what of its own is beside them or instead. Its own settings stay; so does the kernel
/// that judges, whatever kernel packs.
pub(super) fn applied(scene: &Scene, settings: &Table) -> Result<(Scene, Vec<String>), Error> {
    let damaged = |error: &dyn std::fmt::Display| {
        Error::System(format!(
            "settings of the program's own table cannot be used: {error}"
        ))
    };
    // TOML has no numbers as large as a seed may be; none is picked.
    let keys = |packing: &PackingSpec| {
        let seedless = PackingSpec {
            seed: 0,
            ..packing.clone()
        };
        Table::try_from(seedless).map_err(|e| damaged(&e))
    };
    let own = keys(&scene.packing)?;
    let plain = keys(&PackingSpec::default())?;
    let is_own = |key: &str| scene.packing.given.has(key) || own.get(key) != plain.get(key);
    let mut packing = own.clone();
    packing.remove("accuracy");
    let default = Value::from(Method::default().name());
    packing.insert("method".to_owned(), default);
    for (key, value) in settings {
        if key == "method" || !is_own(key) {
            packing.insert(key.clone(), value.clone());
        }
    }
    let mut usual = plain.clone();
    usual.extend(settings.clone());
    let kept = (packing.iter())
        .filter(|(key, value)| {
            !BESIDE.contains(&key.as_str()) && usual.get(key.as_str()) != Some(value)
        })
        .map(|(key, value)| format!("{key} = {value}"))
        .collect();
    let mut with = scene.clone();
    with.packing = packing.try_into().map_err(|e| damaged(&e))?;
    with.packing.seed = scene.packing.seed;
    let (kernel, h_over_spacing) = scene.judge();
    if with.judge() != (kernel, h_over_spacing) {
        with.quality.kernel = Some(kernel);
        with.quality.h_over_spacing = Some(h_over_spacing);
    }
    Ok((with, kept))
}

/// A number as it would be written in a scene.
pub(super) fn number(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

impl Picked {
    /// What there is to say before the work, a line each.
    pub fn words(&self) -> Vec<String> {
        let settings: Vec<String> = (self.settings.iter())
            .map(|(key, value)| format!("{key} = {value}"))
            .collect();
        let settings = if settings.is_empty() {
            "every setting the default".to_owned()
        } else {
            settings.join(", ")
        };
        let Self { name, cost, .. } = self;
        let charted = number(self.charted);
        let times = format!("for {cost} times the default's pairs");
        let mut lines = vec![match (self.measure, self.asked) {
            (Some(measure), Some(asked)) if self.charted > asked => format!(
                "auto takes {name} ({settings}), the most accurate that is charted: {measure} = {} is finer than that, which came to {charted} at worst, {times}",
                number(asked)
            ),
            (Some(measure), Some(asked)) => format!(
                "auto takes {name} ({settings}) for {measure} = {}: on the charted scenes it came to {charted} at worst, {times}",
                number(asked)
            ),
            _ => format!(
                "auto takes {name} ({settings}), as no accuracy is asked for: on the charted scenes linf came to {charted} at worst, {times}"
            ),
        }];
        if !self.kept.is_empty() {
            lines.push(format!(
                "auto leaves the scene's own {} as it is; the table is without it",
                self.kept.join(", ")
            ));
        }
        if let Some(judge) = &self.judged_by {
            lines.push(format!(
                "auto's table is judged by {}, this scene by {judge}",
                kernel_words(TABLE_JUDGE)
            ));
        }
        lines
    }
}
