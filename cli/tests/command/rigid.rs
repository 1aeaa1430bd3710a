//! Solids as rigid bodies, in the report.

use serde_json::Value;

use crate::Desk;

/// The bodies of a scene's report.
fn bodies(scene: &str) -> Value {
    let desk = Desk::new().with("scene.toml", scene);
    desk.succeed(&["pack", "scene.toml", "--report", "r.json", "--quiet"]);
    let mut report: Value = serde_json::from_slice(&desk.read("r.json")).expect("JSON");
    report["bodies"].take()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The box is periodic along x, and the ellipse across its seam.
fn ellipse(surface: &str) -> String {
    format!(
        "spacing = 0.1\n[domain]\nmin = [0.0, 0.0]\nmax = [6.0, 4.0]\nperiodic = [true, false]\n[[body]]\nname = \"egg\"\ndensity = 3.0\nsurface = \"{surface}\"\nshape = {{ ellipse = {{ center = [5.9, 2.1], semi_axes = [1.2, 0.7] }} }}\n"
    )
}

#[test]
fn an_ellipse_across_a_seam_is_whole() {
    let (a, b) = (1.2_f64, 0.7_f64);
    let mass = 3.0 * std::f64::consts::PI * a * b;
    for surface in ["inset", "exact"] {
        let bodies = bodies(&ellipse(surface));
        let rigid = &bodies[0]["rigid"];
        for (key, within) in [("exact", 1e-9), ("particles", 0.01)] {
            let one = &rigid[key];
            assert!((number(&one["mass"]) / mass - 1.0).abs() < within, "{one}");
            let center = [0, 1].map(|k| number(&one["center"][k]));
            assert!((center[0] - 5.9).abs() < 0.1 * within, "{center:?}");
            assert!((center[1] - 2.1).abs() < 0.1 * within, "{center:?}");
            let entry = |i: usize, k: usize| number(&one["inertia"][i][k]);
            for (is, should) in [
                (entry(0, 0), mass * b * b / 4.0),
                (entry(1, 1), mass * a * a / 4.0),
                (entry(2, 2), mass * (a * a + b * b) / 4.0),
            ] {
                // Points have no size of their own: ∆s²/12 of each is not theirs.
                assert!(
                    (is / should - 1.0).abs() < 3.0 * within,
                    "{key} {is} {should}"
                );
            }
            assert!(entry(0, 1).abs() < within * mass);
        }
    }
}

#[test]
fn what_is_no_solid_or_goes_on_is_none() {
    let disc = |name: &str, x: f64, more: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\n{more}shape = {{ circle = {{ center = [{x:?}, 2.0], radius = 0.7 }} }}\n"
        )
    };
    let bodies = bodies(&format!(
        "spacing = 0.1\n[domain]\nmin = [0.0, 0.0]\nmax = [6.0, 4.0]\n{}{}{}",
        disc("hole", 1.5, "role = \"void\"\n"),
        disc("cut", 6.0, ""),
        disc("whole", 3.5, "")
    ));
    for body in bodies.as_array().expect("bodies") {
        let has = body["rigid"].is_object();
        assert_eq!(has, body["name"] == "whole", "{body}");
    }
}
