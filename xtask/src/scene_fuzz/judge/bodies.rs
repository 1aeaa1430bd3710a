//! Whether every particle is on the right side of the true bodies, and bodies have their volumes.

use super::super::case::Role;
use super::super::rows::Row;
use super::super::truth::True;
use super::{Faults, Scene};

/// How far on the wrong side a particle may be, in ∆s, and a little for rounding.
const SLACK: f64 = 0.1 + 1e-6;

/// Bodies whose surfaces share a layer of particles are nearer to each other than this, in ∆s.
const SHARE_LAYER: f64 = 1.0;

pub(super) fn judge(scene: &Scene<'_>, faults: &mut Faults) {
    let truth = scene.truth;
    for (number, body) in truth.bodies.iter().enumerate() {
        // A deeper particle surface leaves true body to the fluid.
        let allowed = SLACK + (body.inset - 0.5).max(0.0);
        let mut fluid = Worst::default();
        let mut own = Worst::default();
        for row in scene.rows.iter().filter(|row| !row.is_frozen()) {
            let is_own = row.side == "solid" && row.body == body.name;
            if is_own || row.side == "fluid" {
                let distance = to_images(scene, number, row) / scene.spacing(row);
                match body.role {
                    Role::Solid | Role::Void if row.side == "fluid" => {
                        fluid.see(-distance - allowed, row);
                    }
                    Role::Solid if is_own => own.see(distance - SLACK, row),
                    Role::Container if row.side == "fluid" => fluid.see(distance - SLACK, row),
                    _ => {}
                }
            }
        }
        let what = match body.role {
            Role::Solid => "fluid in a solid",
            Role::Void => "fluid in a void",
            Role::Container => "fluid beyond a container",
        };
        fluid.tell(what, &body.name, faults);
        own.tell("solid outside its body", &body.name, faults);
    }
    unseen_overlaps(scene, faults);
    volumes(scene, faults);
}

/// How far a particle is from a body or the nearest of its images across periodic sides, negative inside.
fn to_images(scene: &Scene<'_>, number: usize, row: &Row) -> f64 {
    let truth = scene.truth;
    let mut least = truth.distance(number, row.at);
    let [low, high] = truth.bodies[number].bounds();
    for code in 1..3_usize.pow(scene.case.dimension as u32) {
        let turn = |k: usize| [0.0, -1.0, 1.0][code / 3_usize.pow(k as u32) % 3];
        let mut at = row.at;
        for k in scene.axes() {
            at[k] += turn(k) * (scene.max[k] - scene.min[k]);
        }
        let is_image = scene.axes().all(|k| {
            let room = scene.spacing(row);
            let is_near = low[k] - room <= at[k] && at[k] <= high[k] + room;
            is_near && (turn(k) == 0.0 || scene.case.periodic[k])
        });
        if is_image {
            least = least.min(truth.distance(number, at));
        }
    }
    least
}

/// The particle farthest on the wrong side.
#[derive(Default)]
struct Worst {
    count: usize,
    by: f64,
    which: String,
}

impl Worst {
    fn see(&mut self, by: f64, row: &Row) {
        if by > 0.0 {
            self.count += 1;
            if by > self.by {
                self.by = by;
                self.which = format!("{} {:?} {:?}", row.kind, row.body, row.at);
            }
        }
    }

    fn tell(&self, what: &str, body: &str, faults: &mut Faults) {
        if self.count > 0 {
            faults.add(
                what,
                format!(
                    "body {body}: {} particles, the worst {:.3} ∆s more than allowed: {}",
                    self.count, self.by, self.which
                ),
            );
        }
    }
}

/// Bodies that claim the same room must be refused, and solid ones where nothing is to be.
fn unseen_overlaps(scene: &Scene<'_>, faults: &mut Faults) {
    let truth = scene.truth;
    let spacing = scene.case.spacing;
    for (i, a) in truth.bodies.iter().enumerate() {
        for (j, b) in truth.bodies.iter().enumerate() {
            let is_claim = i < j && a.role == b.role && a.precedence == b.precedence;
            if is_claim && a.role == Role::Solid {
                // Where particles are is where it matters.
                let depth = |row: &Row| (-a.distance(row.at)).min(-b.distance(row.at)) / spacing;
                let deepest = scene.rows.iter().map(depth).fold(0.0, f64::max);
                if deepest > 0.3 {
                    faults.add(
                        "overlap not refused",
                        format!("{} and {}, {deepest:.3} ∆s deep", a.name, b.name),
                    );
                }
            }
            if a.role == Role::Solid && b.role == Role::Void && is_within(scene, a, b) {
                faults.add("solid in a void", format!("{} in {}", a.name, b.name));
            }
        }
    }
}

/// Whether one body lies wholly in another: all of a few thousand places that it holds.
fn is_within(scene: &Scene<'_>, body: &True, other: &True) -> bool {
    let [min, max] = body.bounds();
    let steps: usize = if scene.case.dimension == 2 { 60 } else { 15 };
    let mut holds_any = false;
    for i in 0..steps.pow(scene.case.dimension as u32) {
        let p = std::array::from_fn(|k| {
            let cell = i / steps.pow(k as u32) % steps;
            min[k] + (max[k] - min[k]) * (cell as f64 + 0.5) / steps as f64
        });
        if body.distance(p) < 0.0 {
            holds_any = true;
            if other.distance(p) > 0.0 {
                return false;
            }
        }
    }
    holds_any
}

/// Each solid body's volume, where no other shares its particles.
fn volumes(scene: &Scene<'_>, faults: &mut Faults) {
    let truth = scene.truth;
    let particle = scene.coarsest().powi(scene.case.dimension as i32);
    if ["free", "boundary", "fixed"]
        .iter()
        .any(|kind| !scene.case.includes(kind))
    {
        return;
    }
    for (number, body) in truth.bodies.iter().enumerate() {
        if body.role != Role::Solid || body.inset > 0.5 || shares(scene, number) {
            continue;
        }
        let own = scene
            .rows
            .iter()
            .filter(|row| !row.is_frozen() && row.side == "solid" && row.body == body.name);
        let on_surface = (0.5 + body.inset).min(1.0);
        let sum: f64 = own
            .map(|row| {
                let share = if row.is_on_surface() { on_surface } else { 1.0 };
                share * row.volume
            })
            .sum();
        let is = truth.volume(number);
        let allowed = (0.01 * is).max(0.5 * particle);
        let omitted = omitted(scene, &body.name, 0.5 * particle);
        if sum > is + allowed || sum < is - allowed - omitted {
            faults.add(
                "volume of a body",
                format!(
                    "body {} has {sum:.6e}, is {is:.6e}: {:+.2} particles, {:+.2} %",
                    body.name,
                    (sum - is) / particle,
                    100.0 * (sum / is - 1.0)
                ),
            );
        }
    }
}

/// The volume of a body's parts that get no particles, as warnings name them, each of less than `most`.
fn omitted(scene: &Scene<'_>, name: &str, most: f64) -> f64 {
    let is_alone = scene.truth.bodies.len() == 1;
    let warnings = scene.report.get("warnings").and_then(|all| all.as_array());
    let named = |words: &str| -> Option<f64> {
        let (part, rest) = words.split_once(" gets no particles: its volume ")?;
        // Of a body that gets none at all it is not said that it is a part.
        let part = part.strip_prefix("a part of ").unwrap_or(part);
        let is_own = part.starts_with(&format!("body \"{name}\" "));
        let volume: f64 = rest.split(' ').next()?.parse().ok()?;
        (is_own && volume < most).then_some(volume)
    };
    // Where there are many parts the rest is told by its number and volume, in particles to two digits.
    let others = |words: &str| -> Option<f64> {
        let (count, rest) =
            words.split_once(" more parts get no particles; the volume of all of them is ")?;
        let (count, particles): (f64, f64) =
            (count.parse().ok()?, rest.split(' ').next()?.parse().ok()?);
        let volume = 2.0 * most * (particles + 0.005);
        (is_alone && volume < most * (count + 0.5)).then_some(volume)
    };
    (warnings.into_iter().flatten())
        .filter_map(|warning| {
            let words = warning.as_str()?;
            named(words).or_else(|| others(words))
        })
        .sum()
}

/// Whether a body's volume is not its own alone: it lies in a void or with one in it, or particles on its true surface
/// sit on that of another, or on a side of the box, and count for more or less than half.
fn shares(scene: &Scene<'_>, number: usize) -> bool {
    let truth = scene.truth;
    let spacing = scene.coarsest();
    let own = &truth.bodies[number];
    let [low, high] = own.bounds();
    let is_at_side = scene.axes().any(|axis| {
        (low[axis] - scene.min[axis]).min(scene.max[axis] - high[axis]) < SHARE_LAYER * spacing
    });
    if own.inset < 0.5 && is_at_side {
        return true;
    }
    let near: Vec<&Row> = scene
        .rows
        .iter()
        .filter(|row| truth.distance(number, row.at).abs() < 1.5 * spacing)
        .collect();
    (truth.bodies.iter().enumerate()).any(|(k, other)| {
        if k == number {
            return false;
        }
        let [a, b] = [own.bounds(), other.bounds()];
        let is_far = scene
            .axes()
            .any(|k| a[0][k].max(b[0][k]) > a[1][k].min(b[1][k]) + SHARE_LAYER * spacing);
        if is_far {
            return false;
        }
        let touches = || {
            near.iter()
                .any(|row| truth.distance(k, row.at).abs() < 1.5 * spacing)
        };
        match other.role {
            // A ring has its middle outside.
            Role::Void => {
                let is_around = scene.axes().all(|k| a[0][k] < b[0][k] && b[1][k] < a[1][k]);
                touches() || is_around || other.distance(middle(own)) < 0.0
            }
            _ => (own.inset < 0.5 || other.inset < 0.5) && touches(),
        }
    })
}

fn middle(body: &True) -> [f64; 3] {
    let [min, max] = body.bounds();
    std::array::from_fn(|k| 0.5 * (min[k] + max[k]))
}
