//! A scene with all that is known about it, and the text that it becomes.

use std::fmt::Write;

use super::kernel::Kernel;
use super::shape::Shape;

/// The method that picks settings.
pub(super) const AUTO: &str = "auto";

/// What a body is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Solid,
    Container,
    Void,
}

/// A body of a scene, lengths in ∆s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    pub(super) name: String,
    pub(super) shape: Shape,
    /// What a damaged file stands for; `None`: its shape is what it says.
    pub(super) meant: Option<Shape>,
    pub(super) scale: f64,
    /// In the plane about z.
    pub(super) rotate: Option<([f64; 3], f64)>,
    pub(super) translate: Option<Vec<f64>>,
    pub(super) role: Role,
    pub(super) precedence: i32,
    pub(super) density: f64,
    /// The inset of its particle surface in ∆s; `None` is the default, ½.
    pub(super) surface: Option<f64>,
    /// At its surface, in ∆s, where particles differ in size; `None` is ∆s.
    pub(super) spacing: Option<f64>,
}

impl Body {
    pub(super) fn new(name: &str, shape: Shape) -> Self {
        Self {
            name: name.to_owned(),
            shape,
            meant: None,
            scale: 1.0,
            rotate: None,
            translate: None,
            role: Role::Solid,
            precedence: 0,
            density: 1.0,
            surface: None,
            spacing: None,
        }
    }

    /// How far inside its particles sit, in ∆s.
    pub(super) fn inset(&self) -> f64 {
        self.surface.unwrap_or(0.5)
    }
}

/// The box of a scene.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Sides {
    Corners(Vec<f64>, Vec<f64>),
    Margin(f64),
}

/// Particles that grow away from bodies and regions, lengths in ∆s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Refinement {
    pub(super) coarsest: f64,
    pub(super) finest: Option<f64>,
    pub(super) growth: f64,
    /// Corners of boxes, and how fine they are inside.
    pub(super) regions: Vec<(Vec<f64>, Vec<f64>, f64)>,
}

/// A scene. Lengths are in ∆s and places from the box's corner, until it is [`placed`](Self::placed).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Case {
    pub(super) dimension: usize,
    /// ∆s in scene units.
    pub(super) spacing: f64,
    /// Where the box begins, in scene units.
    pub(super) origin: Vec<f64>,
    pub(super) sides: Sides,
    pub(super) periodic: Vec<bool>,
    pub(super) bodies: Vec<Body>,
    pub(super) fill: bool,
    pub(super) refinement: Option<Refinement>,
    pub(super) method: Option<&'static str>,
    pub(super) kernel: Option<Kernel>,
    pub(super) h_over_spacing: Option<f64>,
    /// Other keys of the packing, as lines.
    pub(super) packing: Vec<String>,
    pub(super) quality: Option<(Kernel, f64)>,
    /// `None` is the default, all but the frozen ones.
    pub(super) include: Option<Vec<&'static str>>,
    /// Of the names of the bodies' files.
    pub(super) prefix: String,
}

impl Case {
    /// In scene units, as it is written.
    pub(super) fn placed(&self) -> Self {
        let mut new = self.clone();
        let (unit, origin) = (self.spacing, self.origin.as_slice());
        let nowhere = [0.0; 3];
        let at =
            |p: &[f64]| -> Vec<f64> { p.iter().zip(origin).map(|(x, o)| x * unit + o).collect() };
        new.sides = match &self.sides {
            Sides::Corners(min, max) => Sides::Corners(at(min), at(max)),
            Sides::Margin(margin) => Sides::Margin(margin * unit),
        };
        if let Some(refinement) = &mut new.refinement {
            refinement.coarsest *= unit;
            refinement.finest = refinement.finest.map(|finest| finest * unit);
            for (min, max, spacing) in &mut refinement.regions {
                (*min, *max, *spacing) = (at(min), at(max), *spacing * unit);
            }
        }
        let is_moved = origin.iter().any(|o| *o != 0.0);
        for body in &mut new.bodies {
            body.spacing = body.spacing.map(|spacing| spacing * unit);
            let stays = body.translate.is_some() || !body.shape.can_shift();
            let to = if stays { &nowhere } else { origin };
            body.shape = body.shape.placed(unit, to);
            body.meant = body.meant.as_ref().map(|meant| meant.placed(unit, to));
            if matches!(body.shape, Shape::Airfoil { .. }) {
                body.scale *= unit;
            }
            if let Some(shift) = &body.translate {
                body.translate = Some(at(shift));
            } else if stays && is_moved {
                body.translate = Some(origin.to_vec());
            }
        }
        new
    }

    /// With voids for solid bodies: for a method that fills none.
    pub(super) fn emptied(mut self) -> Self {
        for body in &mut self.bodies {
            if body.role == Role::Solid {
                body.role = Role::Void;
            }
        }
        self
    }

    /// The method that it asks for; settings that are picked are those of the default one.
    pub(super) fn method(&self) -> &'static str {
        (self.method.filter(|method| *method != AUTO)).unwrap_or("balanced")
    }

    /// The kernel and h/∆s that pack.
    pub(super) fn packs(&self) -> (Kernel, f64) {
        let (kernel, h) = match self.method() {
            "coupled" => (Kernel::Cubic, 1.0),
            "relaxation" | "complex" => (Kernel::WendlandC2, 1.3),
            _ => (Kernel::Quintic, 1.2),
        };
        (
            self.kernel.unwrap_or(kernel),
            self.h_over_spacing.unwrap_or(h),
        )
    }

    /// The kernel and h/∆s that judge.
    pub(super) fn judges(&self) -> (Kernel, f64) {
        self.quality.unwrap_or(self.packs())
    }

    /// Whether the output holds a kind of particles.
    pub(super) fn includes(&self, kind: &str) -> bool {
        match &self.include {
            Some(include) => include.contains(&kind),
            None => kind != "frozen",
        }
    }

    /// The name of a body's file, without its ending.
    pub(super) fn file_name(&self, body: usize) -> String {
        format!("{}body{body}", self.prefix)
    }

    /// The text of a scene that is placed.
    pub(super) fn toml(&self) -> String {
        let mut text = format!("spacing = {:?}\n[domain]\n", self.spacing);
        let _ = match &self.sides {
            Sides::Corners(min, max) => writeln!(text, "min = {min:?}\nmax = {max:?}"),
            Sides::Margin(margin) => writeln!(text, "margin = {margin:?}"),
        };
        if self.periodic.contains(&true) {
            let _ = writeln!(text, "periodic = {:?}", self.periodic);
        }
        if let Some(refinement) = &self.refinement {
            let _ = writeln!(
                text,
                "[refinement]\ncoarsest = {:?}\ngrowth = {:?}",
                refinement.coarsest, refinement.growth
            );
            if let Some(finest) = refinement.finest {
                let _ = writeln!(text, "finest = {finest:?}");
            }
            for (min, max, spacing) in &refinement.regions {
                let _ = writeln!(
                    text,
                    "[[refinement.region]]\nshape = {{ box = {{ min = {min:?}, max = {max:?} }} }}\nspacing = {spacing:?}"
                );
            }
        }
        for (k, body) in self.bodies.iter().enumerate() {
            let shape = body.shape.toml(&self.file_name(k));
            let _ = writeln!(text, "[[body]]\nname = {:?}\nshape = {shape}", body.name);
            if body.scale != 1.0 {
                let _ = writeln!(text, "scale = {:?}", body.scale);
            }
            if let Some((axis, degrees)) = &body.rotate {
                let _ = match self.dimension {
                    2 => writeln!(text, "rotate_degrees = {degrees:?}"),
                    _ => writeln!(
                        text,
                        "rotate = {{ axis = {axis:?}, degrees = {degrees:?} }}"
                    ),
                };
            }
            if let Some(shift) = &body.translate {
                let _ = writeln!(text, "translate = {shift:?}");
            }
            if let Some(spacing) = body.spacing {
                let _ = writeln!(text, "spacing = {spacing:?}");
            }
            match body.role {
                Role::Solid => {}
                Role::Container => text.push_str("role = \"container\"\n"),
                Role::Void => text.push_str("role = \"void\"\n"),
            }
            if body.precedence != 0 {
                let _ = writeln!(text, "precedence = {}", body.precedence);
            }
            if body.density != 1.0 {
                let _ = writeln!(text, "density = {:?}", body.density);
            }
            let _ = match body.surface {
                None => Ok(()),
                Some(0.0) => writeln!(text, "surface = \"exact\""),
                Some(inset) => writeln!(text, "surface = {inset:?}"),
            };
        }
        if !self.fill {
            text.push_str("[fluid]\nfill = false\n");
        }
        let mut packing = Vec::new();
        packing.extend(self.method.map(|method| format!("method = {method:?}")));
        packing.extend(
            self.kernel
                .map(|kernel| format!("kernel = {:?}", kernel.name())),
        );
        packing.extend(
            self.h_over_spacing
                .map(|h| format!("h_over_spacing = {h:?}")),
        );
        packing.extend(self.packing.iter().cloned());
        if !packing.is_empty() {
            let _ = writeln!(text, "[packing]\n{}", packing.join("\n"));
        }
        if let Some((kernel, h)) = &self.quality {
            let _ = writeln!(
                text,
                "[quality]\nkernel = {:?}\nh_over_spacing = {h:?}",
                kernel.name()
            );
        }
        if let Some(include) = &self.include {
            let _ = writeln!(text, "[output]\ninclude = {include:?}");
        }
        text
    }
}
