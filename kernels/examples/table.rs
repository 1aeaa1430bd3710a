//! A table of one kernel: W and dW/dr from the centre to the support, and what both integrate to.
//!
//! `cargo run -p sphpack-kernels --example table -- [kernel] [dimension] [smoothing length]`

use std::error::Error;
use std::f64::consts::PI;

use sphpack_kernels::{Kernel, KernelKind, WithKernel};

/// Rows of the table, and steps of the integrals.
const ROWS: usize = 12;
const STEPS: usize = 1200;

struct Table {
    name: &'static str,
}

impl<const D: usize> WithKernel<D> for Table {
    type Output = String;

    fn call<K: Kernel<D>>(self, w: K) -> String {
        let (h, support) = (w.smoothing_length(), w.support());
        let mut text = format!("{} in {D}-D, h = {h}, support {support}\n", self.name);
        text += "    r/h         W(r)        dW/dr\n";
        for row in 0..=ROWS {
            let r = support * row as f64 / ROWS as f64;
            // Adding zero makes a plain zero of a negative one.
            let (value, slope) = (w.value(r), w.slope(r) + 0.0);
            text += &format!("{:7.3} {value:12.5e} {slope:12.5e}\n", r / h);
        }
        // Shells of the middle rule: 2 dr, 2π r dr, 4π r² dr.
        let sphere = [2.0, 2.0 * PI, 4.0 * PI][D - 1];
        let dr = support / STEPS as f64;
        let (mut one, mut moment) = (0.0, 0.0);
        for step in 0..STEPS {
            let r = (step as f64 + 0.5) * dr;
            let shell = sphere * r.powi(D as i32 - 1) * dr;
            one += shell * w.value(r);
            moment += shell * r * w.slope(r);
        }
        text += &format!("∫ W dV = {one:.6}, ∫ r dW/dr dV = {moment:.6} (1 and −{D})\n");
        text
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |place: usize, usual: &'static str| arguments.get(place).map_or(usual, |a| a);
    let kind: KernelKind = argument(0, "quintic").parse()?;
    let h: f64 = argument(2, "1").parse()?;
    let table = Table { name: kind.name() };
    let text = match argument(1, "2") {
        "1" => kind.with::<1, _>(h, table),
        "2" => kind.with::<2, _>(h, table),
        "3" => kind.with::<3, _>(h, table),
        other => return Err(format!("{other} dimensions; kernels exist in 1, 2 and 3").into()),
    };
    print!("{text}");
    Ok(())
}
