//! Known faults are found, and nothing is found where there is none.

use serde_json::json;

use super::super::case::Body;
use super::super::kernel::Kernel;
use super::super::shape::{OutlineFormat, Shape};
use super::super::trial::Ending;
use super::*;

/// A square lattice with a square body of nine particles, its Γ and residual summed up anew.
struct Made {
    case: Case,
    trial: Trial,
}

const N: i32 = 16;

fn made() -> Made {
    let shape = Shape::Box {
        min: vec![5.0, 5.0],
        max: vec![9.0, 9.0],
    };
    let n = f64::from(N);
    let case = Case {
        dimension: 2,
        spacing: 1.0,
        origin: vec![0.0; 2],
        sides: Sides::Corners(vec![0.0; 2], vec![n; 2]),
        periodic: vec![true, false],
        bodies: vec![Body::new("b0", shape)],
        fill: true,
        refinement: None,
        method: None,
        kernel: Some(Kernel::WendlandC2),
        h_over_spacing: Some(1.3),
        packing: Vec::new(),
        quality: None,
        include: Some(vec!["free", "boundary", "fixed", "frozen"]),
        prefix: String::new(),
    };
    let mut rows = Vec::new();
    for j in -4..N + 4 {
        for i in 0..N {
            let is_solid = (5..9).contains(&i) && (5..9).contains(&j);
            let is_inner = (6..8).contains(&i) && (6..8).contains(&j);
            let kind = match (is_solid, is_inner) {
                _ if !(0..N).contains(&j) => "frozen",
                (true, false) => "boundary",
                _ => "free",
            };
            rows.push(Row {
                id: rows.len().to_string(),
                at: [f64::from(i) + 0.5, f64::from(j) + 0.5, 0.0],
                kind: kind.to_owned(),
                side: if is_solid { "solid" } else { "fluid" }.to_owned(),
                body: if is_solid { "b0" } else { "" }.to_owned(),
                volume: 1.0,
                mass: 1.0,
                gamma: 1.0,
                residual: 0.0,
                spacing: None,
            });
        }
    }
    let trial = Trial {
        dry: Ending {
            code: Some(0),
            ..Ending::default()
        },
        pack: Ending {
            code: Some(0),
            ..Ending::default()
        },
        left: vec!["out.csv".to_owned(), "out.json".to_owned()],
        rows: Some(Ok(rows)),
        ..Trial::default()
    };
    let mut made = Made { case, trial };
    made.measure();
    made
}

impl Made {
    fn rows(&mut self) -> &mut Vec<Row> {
        match &mut self.trial.rows {
            Some(Ok(rows)) => rows,
            _ => panic!("there are rows"),
        }
    }

    /// Fills in columns and report as an honest command would.
    fn measure(&mut self) {
        let (kernel, h) = self.case.judges();
        let n = f64::from(N);
        let rows = self.rows().clone();
        let mut closest = f64::INFINITY;
        let measured: Vec<(f64, f64)> = rows
            .iter()
            .map(|row| {
                let (mut gamma, mut gradient) = (0.0, [0.0; 2]);
                for other in &rows {
                    for turn in [-n, 0.0, n] {
                        let d = [row.at[0] - other.at[0] + turn, row.at[1] - other.at[1]];
                        let r = d[0].hypot(d[1]);
                        let (w, slope) = kernel.at(r, h, 2);
                        gamma += other.volume * w;
                        if r > 0.0 {
                            gradient[0] += other.volume * slope * d[0] / r;
                            gradient[1] += other.volume * slope * d[1] / r;
                        }
                        if !row.is_frozen() && (row.id != other.id || turn != 0.0) {
                            closest = closest.min(r);
                        }
                    }
                }
                (gamma, h * gradient[0].hypot(gradient[1]))
            })
            .collect();
        for (row, (gamma, residual)) in self.rows().iter_mut().zip(measured) {
            (row.gamma, row.residual) = (gamma, residual);
        }
        let own: Vec<f64> = rows_of(self).map(|row| row.gamma).collect();
        let (min, max) = own
            .iter()
            .fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
        let count = |kind: &str| rows.iter().filter(|row| row.kind == kind).count();
        self.trial.report = Some(json!({
            "converged": true,
            "closest_pair_over_spacing": closest,
            "particles": {
                "free": count("free"), "boundary": count("boundary"),
                "fixed": count("fixed"), "frozen": count("frozen"),
            },
            "density": { "min": min, "max": max, "linf": (max - 1.0).abs().max((1.0 - min).abs()) },
        }));
    }

    fn classes(&self) -> Vec<String> {
        match judge(&self.case, &self.trial).verdict {
            Verdict::Failed(faults) => faults.into_iter().map(|fault| fault.class).collect(),
            Verdict::Right => Vec::new(),
            other => vec![format!("{other:?}")],
        }
    }

    /// The particle of cell (i, j).
    fn at(&mut self, i: i32, j: i32) -> &mut Row {
        let place = ((j + 4) * N + i) as usize;
        &mut self.rows()[place]
    }
}

fn rows_of(made: &mut Made) -> impl Iterator<Item = &Row> {
    made.rows().iter().filter(|row| !row.is_frozen())
}

/// What is found after a change; columns and report are honest about it.
#[track_caller]
fn found(change: impl FnOnce(&mut Made), class: &str) {
    let mut made = made();
    change(&mut made);
    made.measure();
    let classes = made.classes();
    assert!(classes.iter().any(|c| c == class), "{class}: {classes:?}");
}

#[test]
fn a_perfect_lattice_is_right() {
    assert_eq!(made().classes(), Vec::<String>::new());
}

#[test]
fn faults_of_particles_are_found() {
    found(|made| made.at(3, 0).at[1] = -2.0, "outside");
    found(|made| made.at(3, 0).at[1] = -1e-6, "outside by a hair");
    found(|made| made.at(0, 3).at[0] = -0.4, "outside");
    found(|made| made.at(0, 3).at[0] = 16.0, "not wrapped");
    found(|made| made.at(2, 2).at = [1.6, 2.5, 0.0], "close pair");
    found(
        |made| made.at(2, 2).at = [1.5, 2.5, 0.0],
        "pair in one place",
    );
    // Across the periodic side.
    found(|made| made.at(0, 2).at = [15.9, 2.5, 0.0], "close pair");
    found(|made| made.at(2, 2).id = "7".to_owned(), "id twice");
    found(|made| made.at(2, 2).mass = f64::NAN, "not finite");
    found(|made| made.at(2, 2).volume = 1.001, "sum of volumes");
    found(
        |made| made.at(2, 2).volume = 1.0 + 1e-6,
        "sum of volumes off by a hair",
    );
}

#[test]
fn faults_of_bodies_are_found() {
    found(
        |made| made.at(6, 6).side = "fluid".to_owned(),
        "fluid in a solid",
    );
    found(
        |made| {
            let row = made.at(2, 2);
            (row.side, row.body) = ("solid".to_owned(), "b0".to_owned());
        },
        "solid outside its body",
    );
    found(
        |made| {
            for (i, j) in [(6, 6), (7, 7), (5, 5)] {
                made.at(i, j).volume = 0.7;
                made.at(i, j - 4).volume = 1.3;
            }
        },
        "volume of a body",
    );
    found(
        |made| {
            made.case.bodies[0].role = Role::Void;
            made.at(6, 6).side = "fluid".to_owned();
        },
        "fluid in a void",
    );
    found(
        |made| made.case.bodies[0].role = Role::Container,
        "fluid beyond a container",
    );
    found(
        |made| {
            let twin = made.case.bodies[0].clone();
            made.case.bodies.push(twin);
        },
        "overlap not refused",
    );
    found(
        |made| {
            let mut hole = made.case.bodies[0].clone();
            hole.shape = Shape::Circle {
                center: [7.0, 7.0],
                radius: 3.0,
            };
            (hole.role, hole.name) = (Role::Void, "hole".to_owned());
            made.case.bodies.push(hole);
        },
        "solid in a void",
    );
}

/// What is found where columns or report lie.
#[track_caller]
fn lie(change: impl FnOnce(&mut Made), class: &str) {
    let mut made = made();
    change(&mut made);
    let classes = made.classes();
    assert_eq!(
        classes.first().map(String::as_str),
        Some(class),
        "{classes:?}"
    );
}

fn report(made: &mut Made) -> &mut serde_json::Value {
    made.trial.report.as_mut().unwrap()
}

/// What is left of a packing of many sizes may be of one: its report is in the particles' own all the same.
#[test]
fn a_report_of_many_sizes_is_in_the_particles_own() {
    let mut made = made();
    for row in made.rows() {
        row.volume = 0.81;
    }
    made.measure();
    let is_found = |made: &Made| {
        let mut classes = made.classes().into_iter();
        classes.any(|class| class == "closest pair in the report")
    };
    report(&mut made)["closest_pair_over_spacing"] = json!(1.0 / 0.9);
    assert!(is_found(&made));
    for ratio in [1.0, 2.0] {
        report(&mut made)["resolution"] = json!({ "ratio": ratio });
        assert!(!is_found(&made));
    }
}

#[test]
fn wrong_columns_and_figures_are_found() {
    lie(|made| made.at(3, 0).residual += 1e-6, "residual column");
    lie(|made| made.at(3, 1).gamma *= 1.0 - 1e-7, "gamma column");
    lie(
        |made| report(made)["closest_pair_over_spacing"] = json!(1.1),
        "closest pair in the report",
    );
    lie(
        |made| report(made)["density"]["linf"] = json!(0.5),
        "density in the report",
    );
    lie(
        |made| report(made)["particles"]["free"] = json!(3),
        "report counts otherwise",
    );
    lie(
        |made| report(made)["converged"] = json!(false),
        "report and exit status disagree",
    );
    lie(
        |made| report(made)["audit"] = json!({ "passed": false }),
        "report and exit status disagree",
    );
}

#[test]
fn faults_of_endings_are_found() {
    lie(|made| made.trial.left.clear(), "file missing");
    lie(|made| made.trial.dry.code = Some(2), "dry run said no");
    lie(|made| made.trial.pack.bytes = 2 << 30, "too much memory");
    let refused = |made: &mut Made, errors: &str| {
        made.trial.pack.code = Some(2);
        made.trial.dry.code = Some(2);
        made.trial.pack.errors = errors.to_owned();
        made.trial.left.clear();
    };
    let mut made_well = made();
    refused(
        &mut made_well,
        "sphpack: scene.toml: body \"b0\" is 3.5 too thin",
    );
    assert_eq!(
        judge(&made_well.case, &made_well.trial).verdict,
        Verdict::Refused("body … is # too thin".to_owned())
    );
    assert_eq!(judge(&made_well.case, &made_well.trial).notes, []);
    // Nothing at all is wrong with this one.
    let plain = &mut made_well.case;
    (plain.kernel, plain.h_over_spacing, plain.periodic) = (None, None, vec![false; 2]);
    let notes = judge(&made_well.case, &made_well.trial).notes;
    assert_eq!(notes[0].class, "refused needlessly");
    lie(|made| refused(made, "sphpack: no"), "refusal names nothing");
    lie(|made| refused(made, ""), "refused without a word");
    lie(
        |made| refused(made, "sphpack: body \"b0\" is NaN"),
        "refusal in odd words",
    );
    lie(
        |made| {
            refused(made, "sphpack: body \"b0\" is thin");
            made.trial.dry.code = Some(0);
        },
        "dry run said yes",
    );
    lie(
        |made| {
            refused(made, "sphpack: body \"b0\" is thin");
            made.trial.left.push("out.csv".to_owned());
        },
        "refused and wrote",
    );
    lie(|made| made.trial.pack.code = Some(101), "panic");
    lie(|made| made.trial.pack.code = None, "panic");
    lie(
        |made| {
            made.trial.pack.code = None;
            made.trial.pack.was_killed = true;
        },
        "too slow",
    );
    lie(
        |made| {
            made.trial.pack.code = Some(3);
            report(made)["converged"] = json!(false);
        },
        "exit 3 without a word",
    );
    // Published methods bear their names.
    lie(
        |made| {
            made.case.method = Some("hybrid");
            made.trial.pack.code = None;
        },
        "panic (hybrid)",
    );
}

#[test]
fn parts_that_are_said_to_have_no_particles_are_no_loss() {
    let classes = |warnings: &[&str]| {
        let mut made = made();
        for row in made.rows() {
            if row.side == "solid" {
                row.kind = "free".to_owned();
                row.side = "fluid".to_owned();
                row.body.clear();
            }
        }
        // Three parts of 0.36 particles, between particles.
        let loops = [[11.7, 11.7], [11.7, 13.7], [13.7, 11.7]].map(|[x, y]| {
            let [right, top] = [x + 0.6, y + 0.6];
            vec![[x, y], [right, y], [right, top], [x, top]]
        });
        let shape = Shape::Outline {
            loops: loops.to_vec(),
            format: OutlineFormat::Csv,
        };
        made.case.bodies = vec![Body::new("b0", shape)];
        made.measure();
        report(&mut made)["warnings"] = json!(warnings);
        made.classes()
    };
    let one = "body \"b0\" at (12, 12) gets no particles: its volume 3.600e-1 is 0.36 of a particle's; its room is left";
    let part = format!("a part of {one}");
    let two = "2 more parts get no particles; the volume of all of them is 0.72 of a particle's";
    assert_eq!(classes(&[one, two]), Vec::<String>::new());
    assert_eq!(classes(&[&part, &part, &part]), Vec::<String>::new());
    assert_eq!(classes(&[]), ["volume of a body"]);
    // Parts as large as that have particles.
    let large = "2 more parts get no particles; the volume of all of them is 1.9 of a particle's";
    assert_eq!(classes(&[one, large]), ["volume of a body"]);
}
