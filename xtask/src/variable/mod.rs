//! Variable spacing against its bars, scene by scene, and beside the other ways to come to it.

mod judged;
mod others;
mod rows;
mod time;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use sphpack::{Options, Outcome, Scene, run as pack};
use sphpack_packing::{Kind, Silent};

use crate::chart::{Axis, Chart, Scale, Series};
use crate::reproduction::paint;
use crate::selection::Selection;
use crate::shown_table::ShownTable;
use crate::workspace::{root, write};
use judged::Judged;
use rows::{ROWS, Row};

const HEAD: &str = "\
| scene | | spacings | growth | particles (times fewer) | evaluations | L∞ | 99 % | rms | by all pairs | h∣∇Γ∣ max, rms | closest pair | volumes off | size / asked | seconds | |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
";

/// Packs every row; fails where one misses a bar.
pub(crate) fn run(selection: &Selection) -> Result<(), String> {
    let mut table = ShownTable::new(HEAD);
    let mut missed = Vec::new();
    let mut curve = Vec::new();
    for row in ROWS
        .iter()
        .filter(|row| selection.wants(row.scene, row.quick))
    {
        let Some(scene) = scene(row, selection)? else {
            let line = format!(
                "| {} | {} | no data | | | | | | | | | | | | | |\n",
                row.scene, row.what
            );
            table.push(&line);
            continue;
        };
        let outcome =
            pack(&scene, &Options::default(), &mut Silent).map_err(|error| error.to_string())?;
        let judged = Judged::of(&outcome);
        let misses = misses(row, &outcome, &judged);
        let line = line(row, &outcome, &judged, &misses);
        table.push(&line);
        if !misses.is_empty() {
            missed.push(format!(
                "{} {}: {}",
                row.scene,
                row.growth,
                misses.join(", ")
            ));
        }
        if row.scene == "circle" && row.what == ROWS[0].what {
            curve.push((row.growth, outcome));
        }
    }
    if selection.write {
        document(
            &table.into_text(),
            &others::table()?,
            &time::table()?,
            &curve,
        )?;
    }
    if missed.is_empty() {
        Ok(())
    } else {
        Err(format!("missed: {}", missed.join("; ")))
    }
}

/// A row's scene; `None` where its body's file is not there.
fn scene(row: &Row, selection: &Selection) -> Result<Option<Scene>, String> {
    let mut path = root().join("scenes").join(format!("{}.toml", row.scene));
    if row.text.contains("bunny.stl") {
        let data = (selection.data.clone()).unwrap_or_else(|| root().join("data"));
        if !data.join("bunny.stl").is_file() {
            return Ok(None);
        }
        path = data.join("bunny.toml");
    }
    if row.text.contains("hat.csv") {
        let folder = root().join("target/variable");
        path = folder.join("hat.toml");
        fs::create_dir_all(&folder)
            .and_then(|()| fs::write(folder.join("hat.csv"), rows::hat()))
            .map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    Scene::parse(&row.toml(), &path)
        .map(Some)
        .map_err(|error| error.to_string())
}

fn misses(row: &Row, outcome: &Outcome, judged: &Judged) -> Vec<String> {
    let report = &outcome.report;
    let mut misses = Vec::new();
    let mut need = |holds: bool, what: &str| {
        if !holds {
            misses.push(what.to_owned());
        }
    };
    let [linf, most, rms] = row.density;
    need(report.converged, "not converged");
    need(report.audit.passed, "audit");
    need(report.force_evaluations <= row.evaluations, "evaluations");
    need(report.density.linf <= linf, "L∞");
    need(outcome.table.error_of_most(0.99) <= most, "99 %");
    need(report.density.rms <= rms, "rms");
    if let Some([max, rms]) = row.residual {
        need(report.residual.max <= max, "residual");
        need(report.residual.rms <= rms, "rms of the residual");
    }
    need(judged.closest_free >= row.closest, "closest pair");
    need(report.audit.volume_error <= 1e-12, "volumes");
    let [least, greatest] = judged.size_over_asked;
    need(least >= 0.995 && greatest <= 1.005, "sizes");
    need(
        (judged.linf.unwrap_or(report.density.linf) - report.density.linf).abs() < 1e-9,
        "all pairs say otherwise",
    );
    misses
}

fn line(row: &Row, outcome: &Outcome, judged: &Judged, misses: &[String]) -> String {
    let report = &outcome.report;
    let percent = |value: f64| format!("{:.3} %", 100.0 * value);
    let inner = outcome
        .table
        .kind
        .iter()
        .filter(|&&kind| kind != Kind::Frozen)
        .count();
    let times = report
        .resolution
        .map_or(1.0, |resolution| resolution.times_fewer);
    let ratio = report.resolution.map_or(1.0, |resolution| resolution.ratio);
    let [least, greatest] = judged.size_over_asked;
    format!(
        "| {} | {} | {} … {} ({ratio:.1} : 1) | {} | {inner} ({times:.0}) | {} | {} | {} | {} | {} | {:.1e}, {:.1e} | {:.3} | {:.0e} | {least:.4} … {greatest:.4} | {:.1} | {} |\n",
        row.scene,
        row.what,
        report.resolution.map_or(row.spacings[0], |r| r.finest),
        row.spacings[1],
        row.growth,
        report.force_evaluations,
        percent(report.density.linf),
        percent(outcome.table.error_of_most(0.99)),
        percent(report.density.rms),
        judged.linf.map_or_else(|| "–".to_owned(), percent),
        report.residual.max,
        report.residual.rms,
        judged.closest_free,
        report.audit.volume_error,
        report.seconds.total,
        if misses.is_empty() {
            "holds".to_owned()
        } else {
            format!("**missed: {}**", misses.join(", "))
        },
    )
}

/// Two discs, one four times finer than the other, few enough particles to be told apart.
const TWO: &str = "spacing = 0.12
[refinement]
coarsest = 0.24
growth = 1.1
[domain]
min = [-1.5, -0.8]
max = [1.5, 0.8]
[[body]]
name = \"coarse\"
shape = { circle = { center = [-0.6, 0.0], radius = 0.6 } }
[[body]]
name = \"fine\"
spacing = 0.03
shape = { circle = { center = [0.4, 0.0], radius = 0.3 } }
";

fn draw_two(path: &Path) -> Result<(), String> {
    let own = root().join("scenes/two discs.toml");
    let scene = Scene::parse(TWO, own).map_err(|error| error.to_string())?;
    let outcome =
        pack(&scene, &Options::default(), &mut Silent).map_err(|error| error.to_string())?;
    paint(&outcome, path)
}

fn document(table: &str, others: &str, time: &str, curve: &[(f64, Outcome)]) -> Result<(), String> {
    let series = |name: &str, of: &dyn Fn(&Outcome) -> f64| Series {
        name: name.to_owned(),
        points: curve
            .iter()
            .map(|(growth, outcome)| [growth - 1.0, of(outcome)])
            .collect(),
        joined: true,
    };
    let chart = Chart {
        title: "Variable spacing around a circle: what growth costs",
        axes: [
            Axis {
                title: "growth − 1",
                scale: Scale::Logarithmic,
            },
            Axis {
                title: "part of one",
                scale: Scale::Logarithmic,
            },
        ],
        series: vec![
            series("L∞ of Γ − 1", &|outcome| outcome.report.density.linf),
            series("99 % of Γ − 1", &|outcome| {
                outcome.table.error_of_most(0.99)
            }),
            series("rms of Γ − 1", &|outcome| outcome.report.density.rms),
            series("max of h∣∇Γ∣", &|outcome| {
                outcome.report.residual.max
            }),
            series("rms of h∣∇Γ∣", &|outcome| {
                outcome.report.residual.rms
            }),
            series("1 / times fewer", &|outcome| {
                outcome
                    .report
                    .resolution
                    .map_or(1.0, |r| 1.0 / r.times_fewer)
            }),
        ],
    };
    write("docs/variable-growth.svg", &chart.svg())?;
    draw_two(&root().join("docs/variable-two.png"))?;
    let mut text = String::new();
    let _ = write!(
        text,
        "# Variable spacing and its bars\n\n\
         Quintic kernel, h/s = 1.2, method balanced, defaults, no tuning per scene. Regenerate with\n\
         `cargo xtask variable --data DIR --write`, where DIR holds `bunny.stl`.\n\n\
         Γ is gathered: Σ V_j W(r_ij, h_i), by each particle's own h. A column has it by all pairs, where there are few enough\n\
         particles for that. A symmetric sum, with (h_i + h_j)/2, is biased by the field itself, whatever the packing: by\n\
         μ (¼ ∣∇h∣² + ½ h ∇²h) with μ = 0.483 in the plane and 0.467 in space for the quintic. The closest pair is in the mean size\n\
         of both, V^(1/D), of pairs with a free particle. *Size / asked* is V^(1/D) of free particles over what the field says\n\
         where they are. Bars: L∞ 0.20, 99 % 0.08, rms 0.03 %, 3·10⁻² and 6·10⁻³, a pair 0.78, volumes 10⁻¹², sizes ±0.5 %,\n\
         130 evaluations; for growth 1.2 and 1.3: 0.30 and 0.40 %, 140 evaluations, the residual not judged. Seconds depend on the machine.\n\n\
         {table}\n\
         ![Two discs, one four times finer: particles at their size, coloured by density](variable-two.png)\n\n\
         ![What growth costs](variable-growth.svg)\n\n\
         Density hardly depends on growth. The kernel gradient sum grows with it: a row of particles loses growth − 1 of its\n\
         particles to the next, so that many sit at a dislocation; their density can be levelled, D ways to go and one Γ, their\n\
         gradient cannot.\n\n\
         ## Beside others\n\n\
         Squares halved where the field asks for it, and shifted by −h² ∇Γ/4 a step while sizes follow the field; neither knows of the\n\
         circle's surface.\n\n\
         {others}\n\
         ## Time\n\n\
         Of settling, lists of neighbours and the minimiser included, over particles and evaluations; all particles move. Graded ones take two\n\
         whole sums an evaluation where others take one and a lighter one, their lists hold a pair where either sees the other,\n\
         and are made anew more often, as steps are as long for coarse particles as they are.\n\n\
         {time}\n\
         ## How\n\n\
         1. The spacing s(x) is on each body's surface what the scene says, and grows from there with the distance d as\n\
            s + (growth − 1) (√(d² + 9 s²) − 3 s), up to the coarsest; from where a surface bends and `curvature` asks for more, with\n\
            8 s for 3 s.\n\
         2. Surfaces get their particles first, a curve at equal steps of ∫ dl/s. Every part's core and every pocket of fluid gets as many as ∫ s^−D dV asks for, at the\n\
            centres of mass of an equal-mass partition.\n\
         3. Order, 40 evaluations: ½ Σ V_i V_j W(r_ij, h̄) with h̄² = (h_i² + h_j²)/2 and the usual repulsion, sizes frozen.\n\
            With (h_i + h_j)/2 particles of different size mix where spacings grow fast.\n\
         4. Level, 69 evaluations, 19 more where L∞ is above 0.1 % or the rms above 0.015 %: 15 Σ (Γ_i − 1)² (by short kernels from the lattice's Γ) and a weak repulsion, with V_i = c s(x_i)^D, c such that every region keeps its\n\
            volume, and h_i = η s(x_i) following every move, all of it in the gradient.\n\n\
         Open sides of the box are mirrors: the frozen particles beyond them are images of those within. `finish`, `masses`, `band`\n\
         are for particles of one size, and so is `thin = \"watertight\"`. Other methods refuse a field. Far from all bodies, where the field\n\
         is the same everywhere, particles are placed and moved like the others: there is no lattice.\n"
    );
    write("docs/variable.md", &text)
}
