//! `sphpack quality`.

use super::arguments::QualityArguments;
use super::{say, threads};
use crate::Error;
use crate::cloud::{Cloud, H_OVER_SPACING};
use crate::cloud_report::CloudReport;
use crate::error::{DONE, NOT_CONVERGED};
use crate::picture::grouped;
use crate::scene::kernel_by_name;

/// What a file's own smoothing length may come to; beyond, it is in other units, or something else.
const USUAL_H_OVER_SPACING: std::ops::RangeInclusive<f64> = 0.5..=4.0;

pub(super) fn run(arguments: &QualityArguments) -> Result<u8, Error> {
    for (name, value) in [
        ("--spacing", Some(arguments.spacing)),
        ("--h-over-spacing", arguments.h_over_spacing),
    ] {
        if let Some(value) = value.filter(|&value| !(value > 0.0 && value.is_finite())) {
            return Err(Error::Usage(format!(
                "{name} is {value}; it must be a positive, finite number"
            )));
        }
    }
    let kernel = kernel_by_name(&arguments.kernel)
        .map_err(|message| Error::Usage(format!("--kernel: {message}")))?;
    threads::start(None)?;
    let cloud = Cloud::read(&arguments.particles, arguments.spacing)?;
    let of_each = cloud.sizes.as_ref().and_then(|sizes| sizes.h_over_spacing);
    let own = (cloud.smoothing_length.map(|h| h / arguments.spacing))
        .or(of_each)
        .filter(|ratio| USUAL_H_OVER_SPACING.contains(ratio));
    let h_over_spacing = (arguments.h_over_spacing).or(own).unwrap_or(H_OVER_SPACING);
    let answer = cloud.report(arguments.spacing, kernel, h_over_spacing)?;
    if arguments.json {
        say(&answer.to_json())?;
    } else {
        say(&words(&answer))?;
    }
    Ok(if answer.audit.passed {
        DONE
    } else {
        NOT_CONVERGED
    })
}

fn words(answer: &CloudReport) -> String {
    let CloudReport {
        particles,
        density,
        residual,
        audit,
        ..
    } = answer;
    let mut found = if audit.passed { "passed" } else { "FAILED" }.to_owned();
    for words in &audit.messages {
        found += &format!("\n             {words}");
    }
    let left_out = if particles.left_out_near_edge > 0 {
        format!(
            "\n             {} within a support radius of the box's edge are left out (no row is frozen)",
            grouped(particles.left_out_near_edge)
        )
    } else {
        String::new()
    };
    format!(
        "  particles  {} in {}-D, {} frozen, {} measured{left_out}\n  kernel     {}, h/∆s = {}\n  density    Γ from {:.5} to {:.5}, max |Γ − 1| = {:.3} %, RMS {:.3} % (perfect lattice: {:.5})\n  residual   h |Σ V ∇W| at most {:.2e}, RMS {:.2e}, mean {:.2e}\n  audit      closest pair {:.3} ∆s; {found}\n",
        grouped(particles.total),
        answer.dimension,
        grouped(particles.frozen),
        grouped(particles.measured),
        answer.kernel,
        answer.h_over_spacing,
        density.min,
        density.max,
        100.0 * density.linf,
        100.0 * density.rms,
        density.lattice,
        residual.max,
        residual.rms,
        residual.mean,
        audit.closest_pair_over_spacing,
    )
}
