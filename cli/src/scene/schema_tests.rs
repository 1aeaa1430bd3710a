//! The schema beside the parser: what one takes the other does.

use std::path::Path;

use serde_json::{Value, json};

use super::{Scene, TEMPLATE, json_schema};

/// What a value breaks of a schema, as far as ours uses them; by the words of JSON Schema alone.
fn faults(value: &Value, schema: &Value, root: &Value) -> Vec<String> {
    let mut found = Vec::new();
    if schema == &Value::Bool(true) {
        return found;
    }
    let rules = schema.as_object().expect("a schema is a table");
    for (rule, of) in rules {
        let is_met = |schema: &Value| faults(value, schema, root).is_empty();
        let all = || of.as_array().expect("a list");
        match rule.as_str() {
            "$ref" => {
                let pointer = of.as_str().and_then(|text| text.strip_prefix('#'));
                let other = pointer.and_then(|pointer| root.pointer(pointer));
                found.extend(faults(value, other.expect("it is there"), root));
            }
            "type" => {
                let is = |name: &str| match name {
                    "object" => value.is_object(),
                    "array" => value.is_array(),
                    "string" => value.is_string(),
                    "boolean" => value.is_boolean(),
                    "null" => value.is_null(),
                    "integer" => value.as_f64().is_some_and(|x| x.fract() == 0.0),
                    "number" => value.is_number(),
                    other => panic!("{other}"),
                };
                let names = of.as_array().cloned().unwrap_or(vec![of.clone()]);
                if !names.iter().any(|name| is(name.as_str().expect("a name"))) {
                    found.push(format!("{value} is no {of}"));
                }
            }
            "enum" if !all().contains(value) => found.push(format!("{value} is none of {of}")),
            "const" if of != value => found.push(format!("{value} is not {of}")),
            "anyOf" if !all().iter().any(is_met) => found.push(format!("{value} is none of any")),
            "oneOf" if all().iter().filter(|one| is_met(one)).count() != 1 => {
                found.push(format!("{value} is not one of them"));
            }
            "minimum" if value.as_f64() < of.as_f64() => found.push(format!("{value} is small")),
            "maximum" if value.as_f64() > of.as_f64() => found.push(format!("{value} is large")),
            "exclusiveMinimum" if value.as_f64() <= of.as_f64() => {
                found.push(format!("{value} is not above {of}"));
            }
            "minItems" | "maxItems" => {
                let (count, bound) = (value.as_array().map_or(0, Vec::len) as u64, of.as_u64());
                let is_less = rule == "minItems";
                if value.is_array() && (Some(count) < bound) == is_less && Some(count) != bound {
                    found.push(format!("{value} has {count} entries"));
                }
            }
            "items" => {
                for entry in value.as_array().into_iter().flatten() {
                    found.extend(faults(entry, of, root));
                }
            }
            "required" => {
                for key in all() {
                    if value.get(key.as_str().expect("a key")).is_none() {
                        found.push(format!("{key} is missing"));
                    }
                }
            }
            "properties" => {
                for (key, own) in of.as_object().expect("a table") {
                    let inner = value.get(key).map(|value| faults(value, own, root));
                    found.extend(inner.into_iter().flatten());
                }
            }
            "additionalProperties" if of == &Value::Bool(false) => {
                let known = &rules["properties"];
                for key in value.as_object().into_iter().flat_map(|table| table.keys()) {
                    if known.get(key).is_none() {
                        found.push(format!("{key} is unknown"));
                    }
                }
            }
            "enum"
            | "const"
            | "anyOf"
            | "oneOf"
            | "minimum"
            | "maximum"
            | "exclusiveMinimum"
            | "additionalProperties"
            | "$schema"
            | "$defs"
            | "title"
            | "description"
            | "default"
            | "format" => {}
            other => panic!("a rule that is not looked at: {other}"),
        }
    }
    found
}

fn of_scene(text: &str) -> Vec<String> {
    let table: toml::Table = text.parse().expect("TOML");
    let value = serde_json::to_value(table).expect("JSON");
    let schema = json_schema();
    faults(&value, &schema, &schema)
}

/// A scene with every kind of key.
const RICH: &str = "\
dp = 0.1
[domain]
margin = 0.8
[refinement]
coarsest = 0.4
region = [{ shape = { box = { min = [1.0, -0.5], max = [2.0, 0.5] } }, spacing = 0.1 }]
[[body]]
name = \"a\"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
role = \"void\"
surface = 0.25
thin = \"watertight\"
[[body]]
shape = { file = \"part.svg\" }
units = \"mm\"
surface = \"exact\"
rotate = { axis = [0, 0, 1], degrees = 90 }
[fluid]
hydrostatic = { gravity = [0.0, -9.81], level = 1, sound_speed = 45.0 }
[packing]
method = \"hybrid\"
kernel = \"wendland-c2\"
coefh = 1.0
lattice = \"auto\"
minimiser = \"fire\"
hybrid.capture = [0.5, 0.65]
agitated.agitators = \"none\"
accuracy = { linf = 0.002 }
[quality]
kernel = \"cubic\"
[output]
include = [\"free\", \"frozen\"]
surroundings = { min = [-10.0, -5.0], max = [20.0, 5.0] }
";

#[test]
fn scenes_keep_to_it() {
    assert_eq!(of_scene(RICH), [""; 0]);
    assert_eq!(of_scene(TEMPLATE), [""; 0]);
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(scenes).expect("scenes").flatten() {
        if entry
            .path()
            .extension()
            .is_some_and(|ending| ending == "toml")
        {
            let text = std::fs::read_to_string(entry.path()).expect("text");
            assert_eq!(of_scene(&text), [""; 0], "{}", entry.path().display());
            count += 1;
        }
    }
    assert!(count > 10);
}

/// The report's scene, every default in it.
#[test]
fn what_is_written_keeps_to_it() {
    let scene = Scene::parse(TEMPLATE, Path::new("t.toml")).expect("a scene");
    let schema = json_schema();
    let value = serde_json::to_value(&scene).expect("JSON");
    assert_eq!(faults(&value, &schema, &schema), [""; 0]);
}

#[test]
fn slips_are_found() {
    for (from, to) in [
        ("dp = 0.1\n", ""),
        ("dp = 0.1\n", "dp = \"0.1\"\n"),
        ("dp = 0.1\n", "dp = -0.1\n"),
        ("margin", "margn"),
        ("coarsest = 0.4\n", ""),
        ("circle", "cirkle"),
        ("radius", "r"),
        ("\"void\"", "\"fluid\""),
        ("surface = 0.25", "surface = \"inside\""),
        ("\"watertight\"", "\"heavy\""),
        ("units = \"mm\"", "units = \"mile\""),
        ("\"hybrid\"", "\"hybrd\""),
        ("\"wendland-c2\"", "\"wendland\""),
        ("\"auto\"", "\"square-ish\""),
        ("\"fire\"", "\"adam\""),
        ("[0.5, 0.65]", "[0.5]"),
        ("\"none\"", "\"some\""),
        ("\"frozen\"", "\"ice\""),
        ("[[body]]\nname", "[body]\nname"),
    ] {
        let text = RICH.replacen(from, to, 1);
        assert_ne!(text, RICH, "{from}");
        let Ok(table) = text.parse::<toml::Table>() else {
            continue;
        };
        let value = serde_json::to_value(table).expect("JSON");
        let schema = json_schema();
        assert!(!faults(&value, &schema, &schema).is_empty(), "{to}");
    }
}

/// Editors show what a key is.
#[test]
fn every_key_is_told() {
    let schema = json_schema();
    let mut count = 0;
    let tables = schema["$defs"].as_object().expect("tables").values();
    for table in tables.chain([&schema]) {
        for (key, own) in table["properties"].as_object().into_iter().flatten() {
            assert!(own.get("description").is_some(), "{key}: {own}");
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
    assert_eq!(schema["title"], json!("A scene of sphpack"));
}
