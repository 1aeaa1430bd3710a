//! `sphpack list`.

use std::fmt::Write as _;

use sphpack_kernels::KernelKind;
use sphpack_packing::{Lattice, MethodInfo};

use super::arguments::What;
use super::say;
use crate::Error;
use crate::error::DONE;
use crate::scene::{AccuracyMeasure, Method, SHAPES};

pub(super) fn run(what: What) -> Result<u8, Error> {
    let mut text = String::new();
    match what {
        What::Methods => {
            for info in Method::ALL.map(Method::info) {
                let _ = writeln!(text, "{:12} {}", info.name, info.summary);
            }
            let _ = writeln!(
                text,
                "{:12} picks method and settings for accuracy = {{ MEASURE = NUMBER }}, the cheapest that kept it on the charted scenes; MEASURE is one of:",
                Method::Auto.name()
            );
            for measure in AccuracyMeasure::ALL {
                let _ = writeln!(
                    text,
                    "{:12}   {:14} {}",
                    "",
                    measure.name(),
                    measure.words()
                );
            }
        }
        What::Kernels => {
            for kernel in KernelKind::ALL {
                let default = if kernel == KernelKind::default() {
                    " (the default)"
                } else {
                    ""
                };
                let _ = writeln!(
                    text,
                    "{:12} support radius {} h{default}",
                    kernel.name(),
                    kernel.support_over_h()
                );
            }
        }
        What::Lattices => {
            let MethodInfo {
                kernel,
                h_over_spacing,
                ..
            } = *Method::default().info();
            let _ = writeln!(
                text,
                "{:12} by kernel and h/∆s; {} in 2-D, {} in 3-D with the default ones (the default)",
                "auto",
                Lattice::auto(2, kernel, h_over_spacing),
                Lattice::auto(3, kernel, h_over_spacing)
            );
            for lattice in Lattice::ALL {
                let _ = writeln!(text, "{:12} {}-D", lattice.name(), lattice.dimension());
            }
        }
        What::Shapes => {
            for shape in SHAPES {
                let _ = writeln!(
                    text,
                    "{:10} {:9} shape = {}",
                    shape.name, shape.dimensions, shape.example
                );
            }
        }
    }
    say(&text)?;
    Ok(DONE)
}
