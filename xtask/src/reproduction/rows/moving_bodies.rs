//! 003 figs. 7 and 24: an airfoil whose surface is found by the divergence of positions, and a rotating S.

use sphpack::scene::Method;

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::setup::Setup;

pub(super) fn moving_bodies(all: &mut Vec<Row>) {
    for (figure, scene, spacing, quick) in [
        ("fig7", "naca5515", 1.0 / 80.0, true),
        ("fig24", "s_shape", 0.04, true),
        ("fig24", "s_shape", 0.01, false),
    ] {
        for method in [Method::Hybrid, Method::Balanced] {
            let setup = Setup::of(scene, spacing, method);
            let setup = if method == Method::Hybrid {
                setup.at(1.2)
            } else {
                setup
            };
            let found = |measure| {
                let row = row(figure, setup, measure);
                if figure == "fig7" {
                    row.claims("all surface points are found").at_most(0.0)
                } else {
                    row
                }
            };
            let rows = [
                found(Measure::SurfaceMissed),
                row(figure, setup, Measure::SurfaceFalse),
                row(figure, setup, Measure::Linf),
                row(figure, setup, Measure::OnSurface),
                row(figure, setup, Measure::OffSurface).at_most(0.05),
            ];
            all.extend(rows.map(|row| {
                let row = row.of("003");
                if quick && method == Method::Balanced {
                    row.quick()
                } else {
                    row
                }
            }));
        }
    }
}
