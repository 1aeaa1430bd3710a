//! Whether a body makes sense, as far as that can be said without building it.

use super::fault::{Checked, Key, fault, finite, positive, vector};
use super::{BodySpec, Role, Shape};

/// Whether a body's numbers are in their ranges; `index` is its place in the scene.
pub(super) fn check_body(body: &BodySpec, index: usize) -> Checked {
    let at = |name| vec![Key::Name("body"), Key::Index(index), Key::Name(name)];
    let called = format!("body \"{}\"", body.name);
    if body.name.chars().any(char::is_control) || body.name.chars().count() > 100 {
        return fault(
            &at("name"),
            format!(
                "body {}: the name holds a line break or another control character, or is longer than 100; use a short, plain name",
                index + 1
            ),
        );
    }
    check_shape(&body.shape, &called, &at("shape"))?;
    positive(&at("scale"), &format!("{called}: scale"), body.scale)?;
    positive(&at("density"), &format!("{called}: density"), body.density)?;
    if body.precedence != 0 && body.role == Role::Container {
        return fault(
            &at("precedence"),
            format!(
                "{called}: precedence is for solid bodies that overlap, and voids that cut them; leave it out, or make the role \"solid\""
            ),
        );
    }
    let inset = body.surface.0;
    if !(0.0..=10.0).contains(&inset) {
        return fault(
            &at("surface"),
            format!(
                "{called}: surface is {inset}; it must be \"inset\", \"exact\", or a number of spacings from 0 to 10"
            ),
        );
    }
    let dimension = body.shape.dimension();
    if let Some(degrees) = body.rotate_degrees {
        finite(
            &at("rotate_degrees"),
            &format!("{called}: rotate_degrees"),
            &[degrees],
        )?;
        if dimension == Some(3) {
            return fault(
                &at("rotate_degrees"),
                format!(
                    "{called} is 3-dimensional; write rotate = {{ axis = [0, 0, 1], degrees = {degrees} }} instead of rotate_degrees"
                ),
            );
        }
    }
    if let Some(rotation) = &body.rotate {
        vector(
            &at("rotate"),
            &format!("{called}: rotate.axis"),
            &rotation.axis,
            3,
        )?;
        finite(
            &at("rotate"),
            &format!("{called}: rotate.degrees"),
            &[rotation.degrees],
        )?;
        if rotation.axis.iter().all(|&x| x == 0.0) {
            return fault(
                &at("rotate"),
                format!("{called}: rotate.axis is zero; give a direction, such as [0, 0, 1]"),
            );
        }
        if dimension == Some(2) {
            return fault(
                &at("rotate"),
                format!(
                    "{called} is 2-dimensional; write rotate_degrees = {} instead of rotate",
                    rotation.degrees
                ),
            );
        }
    }
    if let Some(shift) = &body.translate {
        match dimension {
            Some(dimension) => vector(
                &at("translate"),
                &format!("{called}: translate"),
                shift,
                dimension,
            )?,
            None => finite(&at("translate"), &format!("{called}: translate"), shift)?,
        }
    }
    Ok(())
}

pub(super) fn check_shape(shape: &Shape, called: &str, at: &[Key]) -> Checked {
    let within = |name| {
        let mut keys = at.to_vec();
        keys.extend([Key::Name(shape.name()), Key::Name(name)]);
        keys
    };
    let label = |name: &str| format!("{called}: {}.{name}", shape.name());
    if let Shape::Box { min, .. } = shape
        && min.len() != 2
        && min.len() != 3
    {
        return fault(
            &within("min"),
            format!(
                "{} has {} entries; write two (2-D) or three (3-D)",
                label("min"),
                min.len()
            ),
        );
    }
    for (name, values) in shape.vectors() {
        vector(
            &within(name),
            &label(name),
            values,
            shape.dimension().unwrap_or(3),
        )?;
        if name == "semi_axes" {
            for &value in values {
                positive(&within(name), &label(name), value)?;
            }
        }
    }
    for (name, value) in shape.lengths() {
        positive(&within(name), &label(name), value)?;
    }
    match shape {
        Shape::Box { min, max } => {
            for (axis, (low, high)) in min.iter().zip(max).enumerate() {
                if low >= high {
                    return fault(
                        &within("max"),
                        format!(
                            "{}[{axis}] is {high}, not above min[{axis}], which is {low}; make it larger",
                            label("max")
                        ),
                    );
                }
            }
        }
        Shape::Polygon { points } => {
            for (index, point) in points.iter().enumerate() {
                let mut keys = within("points");
                keys.push(Key::Index(index));
                vector(&keys, &format!("{}[{index}]", label("points")), point, 2)?;
            }
        }
        Shape::File(path) if path.as_os_str().is_empty() => {
            return fault(
                at,
                format!(
                    "{called}: file is empty; write the name of a mesh or an outline, such as body.stl or outline.csv"
                ),
            );
        }
        _ => {}
    }
    Ok(())
}
