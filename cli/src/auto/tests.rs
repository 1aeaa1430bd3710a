//! What is picked, what stays, and what is refused.

use sphpack_kernels::KernelKind;
use sphpack_packing::Silent;
use toml::Table;

use super::pick::applied;
use super::{choices, settled};
use crate::Error;
use crate::scene::{AccuracyMeasure, Finish, Masses, Method, Scene};
use crate::{Options, run};

const HEAD: &str = "\
spacing = 0.2
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[[body]]
shape = { circle = { center = [0.0, 0.0], radius = 0.6 } }
[packing]
method = \"auto\"
";

#[track_caller]
fn scene(more: &str) -> Scene {
    Scene::parse(&format!("{HEAD}{more}"), "auto.toml").unwrap()
}

#[track_caller]
fn refuse(text: &str, line: usize, parts: &[&str]) {
    let error = Scene::parse(text, "bad.toml").unwrap_err();
    assert!(matches!(error, Error::Scene { .. }), "{error}");
    let message = error.to_string();
    assert!(
        message.starts_with(&format!("bad.toml:{line}:")),
        "{message}"
    );
    for part in parts {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[track_caller]
fn settings(text: &str) -> Table {
    text.parse().unwrap()
}

#[test]
fn the_cheapest_that_keeps_it_is_taken() {
    for measure in AccuracyMeasure::ALL {
        let front: Vec<_> = (choices().unwrap().into_iter())
            .filter(|choice| choice.dimension == 2 && choice.measure == measure)
            .collect();
        for (number, choice) in front.iter().enumerate() {
            for (asked, wanted) in [
                (choice.accuracy, number),
                (0.999 * choice.accuracy, (number + 1).min(front.len() - 1)),
            ] {
                let scene = scene(&format!("accuracy = {{ {measure} = {asked:e} }}\n"));
                let (with, picked) = settled(&scene, 2).unwrap();
                let picked = picked.unwrap();
                assert_eq!(picked.name, front[wanted].name, "{measure} = {asked}");
                assert_eq!(picked.asked, Some(asked));
                assert_ne!(with.packing.method, Method::Auto);
                assert_eq!(with.packing.accuracy, None);
                let says_so = picked.words()[0].contains("finer");
                assert_eq!(says_so, asked < front[wanted].accuracy, "{picked:?}");
            }
        }
    }
}

#[test]
fn without_an_accuracy_it_is_the_default() {
    let (_, picked) = settled(&scene(""), 2).unwrap();
    let picked = picked.unwrap();
    assert_eq!((picked.measure, picked.asked), (None, None));
    assert!(picked.settings.is_empty(), "{picked:?}");
    assert_eq!(picked.cost, 1.0);
    assert!(picked.words()[0].contains("no accuracy is asked for"));
    // Another method is left alone.
    let mut other = scene("");
    other.packing.method = Method::Hybrid;
    assert_eq!(settled(&other, 2).unwrap(), (other, None));
}

#[test]
fn what_a_scene_says_itself_stays() {
    let picks =
        settings("finish = \"consistent\"\nmasses = \"corrected\"\nresidual_tolerance = 0.003");
    // The default, but written out.
    let own = scene("finish = \"even\"\nlevelling = 3.0\nresidual_tolerance = 0.003\n");
    let (with, kept) = applied(&own, &picks).unwrap();
    assert_eq!(with.packing.finish, Finish::Even);
    assert_eq!(with.packing.levelling, Some(3.0));
    assert_eq!(with.packing.masses, Masses::Corrected);
    assert_eq!(kept, ["finish = \"even\"", "levelling = 3.0"]);
    // A program has no file to write in.
    let mut made = scene("");
    made.packing.given = Default::default();
    made.packing.balance = 0.25;
    let (with, kept) = applied(&made, &picks).unwrap();
    assert_eq!(with.packing.finish, Finish::Consistent);
    assert_eq!(kept, ["balance = 0.25"]);
}

#[test]
fn the_judge_stays_whatever_packs() {
    let picks = settings("kernel = \"wendland-c4\"\nh_over_spacing = 2.0");
    let plain = scene("");
    let (with, _) = applied(&plain, &picks).unwrap();
    assert_eq!(with.packing.kernel, Some(KernelKind::WendlandC4));
    assert_eq!(with.judge(), plain.judge());
    let judged = scene("[quality]\nkernel = \"wendland-c2\"\nh_over_spacing = 1.3\n");
    let (with, _) = applied(&judged, &picks).unwrap();
    assert_eq!(with.judge(), (KernelKind::WendlandC2, 1.3));
    // And is named, as it is not the table's.
    let (_, picked) = settled(&judged, 2).unwrap();
    let words = picked.unwrap().words().join("; ");
    assert!(
        words.contains("this scene by wendland-c2 at h/∆s = 1.3"),
        "{words}"
    );
    // One that the scene packs with is not replaced.
    let own = scene("kernel = \"cubic\"\n");
    let (with, kept) = applied(&own, &picks).unwrap();
    assert_eq!(with.packing.kernel, Some(KernelKind::Cubic));
    assert_eq!(kept, ["kernel = \"cubic\""]);
}

#[test]
fn what_a_scene_cannot_have_is_not_picked() {
    let graded = scene("accuracy = { linf = 1e-9 }\n[refinement]\ncoarsest = 0.4\n");
    let (with, picked) = settled(&graded, 2).unwrap();
    with.check().unwrap();
    assert!(picked.is_some());
    assert_ne!(with.packing.masses, Masses::Corrected);
}

#[test]
fn faults_name_the_place_and_the_cure() {
    let with = |more: &str| format!("{HEAD}{more}\n");
    refuse(
        &with("accuracy = { lif = 0.1 }"),
        9,
        &["unknown key \"lif\"", "did you mean \"linf\"?", "residual"],
    );
    refuse(
        &with("accuracy = { linf = 0.1, residual = 1e-3 }"),
        9,
        &["linf and residual", "keep the one"],
    );
    refuse(
        &with("accuracy = {}"),
        9,
        &["no measure", "accuracy = { linf = 0.002 }", "interpolation"],
    );
    refuse(
        &with("accuracy = { linf = 0.0 }"),
        9,
        &["packing.accuracy.linf is 0", "positive"],
    );
    refuse(
        &with("accuracy = { linf = 0.1 }").replace("auto", "hybrid"),
        9,
        &["method is \"hybrid\"", "method = \"auto\""],
    );
    refuse(
        &with("accuracy = { derivative = 0.1 }\n[refinement]\ncoarsest = 0.4"),
        9,
        &["one size", "linf or residual"],
    );
}

#[test]
fn every_measure_is_measured_and_judged() {
    for measure in AccuracyMeasure::ALL {
        for asked in [1e3, 1e-12] {
            let scene = scene(&format!(
                "accuracy = {{ {measure} = {asked:e} }}\nmax_iterations = 200\n"
            ));
            let outcome = run(&scene, &Options::default(), &mut Silent).unwrap();
            let report = outcome.report;
            let auto = report.auto.unwrap();
            let measured = auto.measured.unwrap();
            match measure {
                AccuracyMeasure::Linf => assert_eq!(measured, report.density.linf),
                AccuracyMeasure::Residual => assert_eq!(measured, report.residual.max),
                // Particles may interpolate better than their lattice.
                _ => assert!(measured.abs() < 1.0 && measured != 0.0, "{measured}"),
            }
            let is_reached = measured <= asked;
            assert!(is_reached || asked < 1.0, "{measure}: {auto:?}");
            assert_eq!(auto.reached, Some(is_reached), "{measure}: {auto:?}");
            assert_eq!(auto.worst_at.len(), 2);
            let words = auto.words().unwrap();
            assert_eq!(words.starts_with("reached"), is_reached, "{words}");
            if !is_reached {
                assert!(
                    words.contains("worst at") && words.contains("asked for"),
                    "{words}"
                );
            }
        }
    }
}
