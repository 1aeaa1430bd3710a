//! Whole scenes, from the parsed file to the figures: the balanced method beside the hybrid one of paper 001, and all
//! particles moved beside only those near a surface.

use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use sphpack::scene::{BandWidth, Method};
use sphpack::{Options, Scene, run};
use sphpack_packing::Silent;

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
    Scene::read(&path).expect("a shipped scene")
}

fn bench(c: &mut Criterion, name: &str, change: impl Fn(&mut Scene)) {
    let mut scene = scene(name.split(',').next().unwrap_or(name));
    change(&mut scene);
    c.bench_function(name, |b| {
        b.iter(|| run(&scene, &Options::default(), &mut Silent).expect("a packing"));
    });
}

fn all(c: &mut Criterion) {
    bench(c, "cylinder, ∆s = 0.1", |scene| scene.spacing = 0.1);
    bench(c, "cylinder, ∆s = 0.1, hybrid", |scene| {
        scene.spacing = 0.1;
        scene.packing.method = Method::Hybrid;
    });
    bench(c, "cylinder, ∆s = 0.025", |scene| scene.spacing = 0.025);
    bench(c, "cylinder, ∆s = 0.025, everything moves", |scene| {
        scene.spacing = 0.025;
        scene.packing.band = BandWidth::Full;
    });
    bench(c, "naca0015, ∆s = 0.02", |_| {});
    bench(c, "spot", |_| {});
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = all
}
criterion_main!(benches);
