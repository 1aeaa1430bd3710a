//! What serde writes of reports.

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{BodyFormat, DefectKind, LoopRole, OutlineDefectKind, Repair, ShellRole, Sketch, Soup};

fn returns<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> serde_json::Value {
    let written = serde_json::to_value(value).expect("finite numbers");
    let read: T = serde_json::from_value(written.clone()).expect("what was written");
    assert_eq!(&read, value);
    written
}

#[test]
fn names_are_those_of_the_types() {
    for kind in DefectKind::ALL {
        assert_eq!(returns(&kind), kind.name());
    }
    for kind in OutlineDefectKind::ALL {
        assert_eq!(returns(&kind), kind.name());
    }
    for format in BodyFormat::ALL {
        assert_eq!(returns(&format), format.extension());
    }
    use ShellRole::{Body, Cavity, Redundant, Undecided};
    for role in [Body, Cavity, Redundant, Undecided] {
        assert_eq!(returns(&role), role.name());
    }
    use LoopRole as Role;
    for role in [Role::Body, Role::Hole, Role::Nothing, Role::Undecided] {
        assert_eq!(returns(&role), role.name());
    }
}

#[test]
fn reports_and_repairs_return() {
    let leaf = Soup::from_loose(&[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]).expect("finite");
    let report = returns(&leaf.check());
    assert_eq!(
        report["shells"][0]["max"],
        serde_json::json!([1.0, 1.0, 0.0])
    );
    let bow = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let report = returns(&Sketch::new(vec![bow]).expect("finite").check());
    assert_eq!(report["defects"][0]["kind"], "self-intersection");
    let written = returns(&Repair::Turned {
        triangles: 2,
        of: 3,
    });
    assert_eq!(
        written,
        serde_json::json!({"turned": {"triangles": 2, "of": 3}})
    );
}
