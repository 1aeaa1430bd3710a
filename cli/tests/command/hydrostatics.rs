//! Pressure, density and mass of fluid at rest.

use crate::Desk;

const TANK: &str = "\
spacing = 0.1
[domain]
min = [-1.2, -0.6]
max = [1.2, 1.6]
[[body]]
name = \"tank\"
role = \"container\"
shape = { box = { min = [-0.8, -0.2], max = [0.8, 1.0] } }
[packing]
method = \"ppa\"
max_iterations = 200
";

#[test]
fn pressure_grows_with_depth() {
    let fluid = "[fluid]\ndensity = 1000.0\nhydrostatic = { gravity = [0.0, -9.81], level = 1.0, sound_speed = 50.0 }\n";
    let desk = Desk::new().with("tank.toml", format!("{TANK}{fluid}"));
    desk.run(&["pack", "tank.toml", "-o", "out.csv"]);
    let text = String::from_utf8(desk.read("out.csv")).expect("text");
    let header: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let place = |name: &str| header.iter().position(|&h| h == name).expect("a column");
    let columns = ["y", "volume", "mass", "pressure", "density"].map(place);
    let mut mass = 0.0;
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [y, volume, own, pressure, density] =
            columns.map(|c| fields[c].parse::<f64>().expect("a number"));
        assert!((pressure - 9810.0 * (1.0 - y)).abs() < 1e-6, "{line}");
        // Tait's equation with γ = 7.
        let tait = 1000.0 * 2500.0 / 7.0 * ((density / 1000.0).powi(7) - 1.0);
        assert!((tait - pressure).abs() < 1e-6 * pressure, "{line}");
        assert!((own - density * volume).abs() < 1e-12 * own, "{line}");
        mass += own;
    }
    // A little more than the tank's 1.92 m³ hold without pressure.
    assert!((1920.0..1925.0).contains(&mass), "{mass}");
}

#[test]
fn gravity_needs_a_direction() {
    for (key, part) in [
        (
            "gravity = [0.0, 0.0], level = 1.0, sound_speed = 50.0",
            "gravity is zero",
        ),
        (
            "gravity = [-9.81], level = 1.0, sound_speed = 50.0",
            "gravity has 1 entries",
        ),
        (
            "gravity = [0.0, -9.81], level = 1.0, sound_speed = 0.0",
            "sound_speed is 0",
        ),
    ] {
        let desk = Desk::new().with(
            "tank.toml",
            format!("{TANK}[fluid]\nhydrostatic = {{ {key} }}\n"),
        );
        desk.refuse(&["pack", "tank.toml", "-o", "out.csv"], &[part]);
    }
}
