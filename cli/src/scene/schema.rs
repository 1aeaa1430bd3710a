//! The JSON Schema of scenes, from which editors complete and check them as they are written.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};
use sphpack_geometry::Thin;
use sphpack_kernels::KernelKind;
use sphpack_packing::{Kind, Lattice, MinimiserKind};

use super::{LengthUnit, Scene};

/// The JSON Schema (draft 2020-12) of scenes, in TOML or JSON: their own keys, with what each is, and the words of solvers that are
/// read too. Whatever a schema can tell of a scene; not what depends on its bodies.
#[must_use]
pub fn json_schema() -> Value {
    let mut schema = SchemaGenerator::default().into_root_schema_for::<Scene>();
    schema.insert("title".to_owned(), json!("A scene of sphpack"));
    let mut schema = schema.to_value();
    for (of, word, means) in [
        ("", "dp", "spacing, as DualSPHysics calls it"),
        ("", "dx", "spacing, as PySPH calls it"),
        ("PackingSpec", "hdx", H_OVER_SPACING),
        ("PackingSpec", "hdp", H_OVER_SPACING),
        ("PackingSpec", "h", "The smoothing length, scene units"),
        ("PackingSpec", "coefh", COEFH),
        ("QualitySpec", "hdx", H_OVER_SPACING),
        ("QualitySpec", "hdp", H_OVER_SPACING),
        ("QualitySpec", "h", "The smoothing length, scene units"),
        ("QualitySpec", "coefh", COEFH),
    ] {
        let known = json!({ "type": "number", "exclusiveMinimum": 0, "description": means });
        properties(&mut schema, of)[word] = known;
    }
    properties(&mut schema, "BodySpec")["units"] = json!({
        "enum": LengthUnit::names(),
        "description": "The unit of the body's file, in a scene in metres; instead of scale",
    });
    // One of its names must be there.
    if let Some(required) = schema["required"].as_array_mut() {
        required.retain(|key| key != "spacing");
    }
    schema["anyOf"] = json!([
        { "required": ["spacing"] },
        { "required": ["dp"] },
        { "required": ["dx"] },
    ]);
    schema
}

const H_OVER_SPACING: &str = "h_over_spacing, as solvers call it";
const COEFH: &str = "Smoothing length over √D ∆s, as DualSPHysics gives it";

/// The keys of a table; of the scene itself where it has no name.
fn properties<'a>(schema: &'a mut Value, of: &str) -> &'a mut Value {
    match of {
        "" => &mut schema["properties"],
        name => &mut schema["$defs"][name]["properties"],
    }
}

/// One of some names; in JSON, null is as if the key were left out.
fn named(names: &[&str]) -> Schema {
    let mut all = vec![Value::Null];
    all.extend(names.iter().map(|&name| name.into()));
    json_schema!({ "enum": all })
}

pub(super) fn kernel(_: &mut SchemaGenerator) -> Schema {
    named(&KernelKind::ALL.map(KernelKind::name))
}

pub(super) fn minimiser(_: &mut SchemaGenerator) -> Schema {
    named(&MinimiserKind::ALL.map(MinimiserKind::name))
}

pub(super) fn lattice(_: &mut SchemaGenerator) -> Schema {
    let mut names = vec!["auto"];
    names.extend(Lattice::ALL.map(Lattice::name));
    named(&names)
}

pub(super) fn kinds(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "array", "items": { "enum": Kind::ALL.map(Kind::name) } })
}

pub(super) fn inset(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "anyOf": [{ "enum": ["inset", "exact"] }, { "type": "number" }] })
}

pub(super) fn thin(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": [Thin::Mass, Thin::Watertight] })
}
