//! Bodies in one another: which roles may be, and which body comes first.

use sphpack_geometry::Surface;
use sphpack_neighbors::point;

use crate::Error;
use crate::dimension::Built;
use crate::overlap::{PER_PARTICLE, TOUCHING_OVER_SPACING};
use crate::scene::{Role, Scene};

/// How a body's surface lies to another body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Lie {
    /// Nowhere in it.
    Out,
    /// Nowhere out of it.
    In,
    /// In it here and out of it there, by more than bodies may touch.
    Across,
}

/// Of places on the surface of `a`; a tenth of ∆s to either side is neither in nor out.
fn lie<const D: usize>(a: &dyn Surface<D>, b: &dyn Surface<D>, spacing: f64) -> Lie {
    let slack = TOUCHING_OVER_SPACING * spacing;
    let count = PER_PARTICLE * a.measure() / spacing.powi(D as i32 - 1);
    let (mut is_in, mut is_out) = (false, false);
    for at in a.scatter(count.clamp(200.0, 20_000.0) as usize) {
        let distance = b.closest(at.point).distance;
        is_in |= distance < -slack;
        is_out |= distance > slack;
    }
    match (is_in, is_out) {
        (true, true) => Lie::Across,
        (_, false) => {
            // All of it is on the surface, or in; beside it or within is told a little behind.
            let behind =
                |at: [f64; D], normal: [f64; D]| point::add_scaled(at, -2.0 * slack, normal);
            let first = a.closest(a.bounds().center());
            if is_in || b.inside(behind(first.point, first.normal)) {
                Lie::In
            } else {
                Lie::Out
            }
        }
        (false, true) => Lie::Out,
    }
}

/// The order in which a particle is asked which body holds it, every body after those that lie in it; a body keeps its
/// place where nothing lies in it.
///
/// # Errors
/// [`Error::Scene`] where roles exclude each other: a solid body in a void or out of every container would lose its
/// particles, and one that a void or a container's wall cuts some of them.
pub(crate) fn order<const D: usize>(scene: &Scene, all: &[Built<D>]) -> Result<Vec<usize>, Error> {
    let role = |i: usize| scene.body[i].role;
    if (0..all.len()).all(|i| role(i) == Role::Solid) {
        return Ok((0..all.len()).collect());
    }
    let lie = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|i| all[i].surface.as_ref());
        lie(a, b, scene.spacing)
    };
    let of_role = |wanted: Role| (0..all.len()).filter(move |&i| role(i) == wanted);
    let name = |i: usize| scene.body[i].name.as_str();
    let fail = |message: String| {
        Err(Error::Scene {
            path: scene.path.clone(),
            at: None,
            message,
        })
    };
    // What lies in each.
    let mut inner: Vec<Vec<usize>> = vec![Vec::new(); all.len()];
    for (solid, void) in of_role(Role::Solid).flat_map(|s| of_role(Role::Void).map(move |v| (s, v)))
    {
        match (lie(solid, void), lie(void, solid)) {
            (Lie::In, _) => {
                return fail(format!(
                    "body \"{}\" is solid and lies in \"{}\", which is a void and holds no particles; leave one of them out, or give \"{}\" the role \"container\" to fill it with fluid around the solid",
                    name(solid),
                    name(void),
                    name(void)
                ));
            }
            (_, Lie::In) => inner[solid].push(void),
            (Lie::Out, Lie::Out) => {}
            _ => {
                return fail(format!(
                    "the void \"{}\" crosses the surface of the solid body \"{}\"; move it in or out, or give it a higher precedence (precedence = 1) to cut the body",
                    name(void),
                    name(solid)
                ));
            }
        }
    }
    for solid in of_role(Role::Solid) {
        let mut is_contained = None;
        for container in of_role(Role::Container) {
            match lie(solid, container) {
                Lie::In => {
                    inner[container].push(solid);
                    is_contained = Some(true);
                }
                Lie::Out => is_contained = is_contained.or(Some(false)),
                Lie::Across => {
                    return fail(format!(
                        "the wall of the container \"{}\" crosses the solid body \"{}\"; a body may touch the wall from within, but not pass through it",
                        name(container),
                        name(solid)
                    ));
                }
            }
        }
        if is_contained == Some(false) {
            let container = of_role(Role::Container).map(name).next().unwrap_or("");
            return fail(format!(
                "body \"{}\" is solid and lies outside the container \"{container}\", where no particles are kept; move it in, or leave one of them out",
                name(solid)
            ));
        }
    }
    for container in of_role(Role::Container) {
        for void in of_role(Role::Void) {
            if lie(container, void) == Lie::In {
                return fail(format!(
                    "the container \"{}\" lies in the void \"{}\", which holds no particles; leave one of them out",
                    name(container),
                    name(void)
                ));
            }
            if lie(void, container) == Lie::In {
                inner[container].push(void);
            }
        }
        for other in of_role(Role::Container).filter(|&other| other != container) {
            if lie(other, container) == Lie::In && lie(container, other) != Lie::In {
                inner[container].push(other);
            }
        }
    }
    let mut order = Vec::with_capacity(all.len());
    for i in 0..all.len() {
        place(i, &inner, &mut order);
    }
    Ok(order)
}

/// Appends a body after those in it, unless it is there.
fn place(body: usize, inner: &[Vec<usize>], order: &mut Vec<usize>) {
    if order.contains(&body) {
        return;
    }
    for &within in &inner[body] {
        place(within, inner, order);
    }
    order.push(body);
}
