//! The dynamical matrix against springs by hand, and against a plain sum over all pairs and images.

use faer::{Mat, Side};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Odometer, point};
use sphpack_packing::Lattice;

use super::{Crystal, softest};

/// Wendland's C2 as it is printed, by no code of ours.
fn wendland<const D: usize>(r: f64, h: f64) -> f64 {
    let sigma = if D == 2 {
        7.0 / (4.0 * std::f64::consts::PI * h * h)
    } else {
        21.0 / (16.0 * std::f64::consts::PI * h * h * h)
    };
    let q = r / h;
    if q < 2.0 {
        sigma * (1.0 - 0.5 * q).powi(4) * (1.0 + 2.0 * q)
    } else {
        0.0
    }
}

/// A periodic box of whole unit cells.
struct Periodic<const D: usize> {
    sites: Vec<[f64; D]>,
    edges: [f64; D],
    h: f64,
}

impl<const D: usize> Periodic<D> {
    fn new(lattice: Lattice, cells: [usize; D], h: f64) -> Self {
        let cell = lattice.unit_cell::<D>().cell();
        let inner = lattice.unit_cell::<D>().sites();
        let mut sites = Vec::new();
        for n in Odometer::new([0; D], cells.map(|count| count as i64)) {
            let shift: [f64; D] = std::array::from_fn(|axis| n[axis] as f64 * cell[axis]);
            sites.extend(inner.iter().map(|&site| point::add(site, shift)));
        }
        let edges = std::array::from_fn(|axis| cells[axis] as f64 * cell[axis]);
        Self { sites, edges, h }
    }

    /// What particle `i` adds to the energy, a pair counted once: over all others and all images within reach.
    fn energy_of(&self, places: &[[f64; D]], i: usize) -> f64 {
        let reach = self
            .edges
            .map(|edge| (2.0 * self.h / edge).ceil() as i64 + 1);
        let mut sum = 0.0;
        for n in Odometer::new(reach.map(|n| -n), reach.map(|n| n + 1)) {
            let shift: [f64; D] = std::array::from_fn(|axis| n[axis] as f64 * self.edges[axis]);
            for (j, &place) in places.iter().enumerate() {
                if j != i {
                    let r = point::distance(point::add(place, shift), places[i]);
                    sum += wendland::<D>(r, self.h);
                }
            }
        }
        sum
    }

    fn slope(&self, places: &mut [[f64; D]], i: usize, axis: usize) -> f64 {
        const STEP: f64 = 1e-4;
        let here = places[i][axis];
        let [high, low] = [STEP, -STEP].map(|step| {
            places[i][axis] = here + step;
            self.energy_of(places, i)
        });
        places[i][axis] = here;
        (high - low) / (2.0 * STEP)
    }

    /// All eigenvalues of its second derivatives, by differences of energies.
    fn spectrum(&self) -> Vec<f64> {
        const STEP: f64 = 1e-3;
        let count = self.sites.len();
        let mut places = self.sites.clone();
        let mut matrix = Mat::<f64>::zeros(D * count, D * count);
        for j in 0..count {
            for moved in 0..D {
                for sign in [1.0, -1.0] {
                    places[j][moved] = self.sites[j][moved] + sign * STEP;
                    for i in 0..count {
                        for axis in 0..D {
                            let slope = self.slope(&mut places, i, axis);
                            matrix[(D * i + axis, D * j + moved)] += sign * slope / (2.0 * STEP);
                        }
                    }
                }
                places[j][moved] = self.sites[j][moved];
            }
        }
        matrix.self_adjoint_eigenvalues(Side::Lower).unwrap()
    }
}

fn check_spectrum<const D: usize>(lattice: Lattice, cells: [usize; D], h: f64) {
    let expected = Periodic::new(lattice, cells, h).spectrum();
    let crystal = Crystal::<D>::new(lattice, KernelKind::WendlandC2, h);
    let mut found = Vec::new();
    for k in crystal.cell.waves_in(lattice, cells) {
        found.extend(crystal.values(k).unwrap());
    }
    found.sort_by(f64::total_cmp);
    assert_eq!(found.len(), expected.len(), "{lattice}");
    // What differences of energies leave.
    let rounding = 1e-5 * expected[expected.len() - 1].max(1.0);
    for (found, expected) in found.iter().zip(&expected) {
        assert!(
            (found - expected).abs() < rounding,
            "{lattice}: {found} {expected}"
        );
    }
    assert!(
        expected[0] < 1e-5 && expected[expected.len() - 1] > 0.1,
        "{lattice}"
    );
}

/// The waves of a periodic box have, all together, the eigenvalues of its energy's second derivatives.
#[test]
fn waves_are_those_of_the_energy_of_a_box() {
    check_spectrum(Lattice::Square, [3, 4], 0.8);
    check_spectrum(Lattice::Hexagonal, [3, 2], 0.9);
    check_spectrum(Lattice::SimpleCubic, [2, 2, 3], 0.7);
    check_spectrum(Lattice::Bcc, [2, 2, 1], 0.7);
    check_spectrum(Lattice::Fcc, [2, 1, 1], 0.7);
    check_spectrum(Lattice::Hcp, [2, 1, 1], 0.7);
}

/// A square lattice of which only nearest neighbours see each other: λ = 2 W″ (1 − cos k) along a wave along an axis,
/// 2 W′ (1 − cos k) across it, which is negative as every kernel falls.
#[test]
fn springs_to_four_neighbours_are_those_by_hand() {
    let h = 0.65;
    let crystal = Crystal::<2>::new(Lattice::Square, KernelKind::WendlandC2, h);
    let step = 1e-4;
    let [low, here, high] = [1.0 - step, 1.0, 1.0 + step].map(|r| wendland::<2>(r, h));
    let (slope, curvature) = (
        (high - low) / (2.0 * step),
        (high - 2.0 * here + low) / (step * step),
    );
    for k in [0.3, 1.7, std::f64::consts::PI] {
        let both = 2.0 * (1.0 - f64::cos(k));
        let values = crystal.values([0.0, k]).unwrap();
        assert!((values[0] - both * slope).abs() < 1e-6, "{k}: {values:?}");
        assert!(
            (values[1] - both * curvature).abs() < 1e-6,
            "{k}: {values:?}"
        );
        let soft = &crystal.modes([0.0, k]).unwrap()[0];
        assert!((soft.ways[0][0][0].hypot(soft.ways[0][0][1]) - 1.0).abs() < 1e-12);
        assert!(soft.ways[0][1][0].hypot(soft.ways[0][1][1]) < 1e-12);
    }
    // One particle alone is held by all four.
    let alone = crystal.alone().unwrap();
    assert!(
        (alone[0] - 2.0 * (slope + curvature)).abs() < 1e-6,
        "{alone:?}"
    );
}

fn check_turned<const D: usize>(lattice: Lattice, turn: impl Fn([f64; D]) -> [f64; D]) {
    for kernel in [KernelKind::Quintic, KernelKind::WendlandC4] {
        let crystal = Crystal::<D>::new(lattice, kernel, 1.2);
        let k: [f64; D] = std::array::from_fn(|axis| 0.9 - 0.7 * axis as f64);
        let here = crystal.values(k).unwrap();
        let turned = crystal.values(turn(k)).unwrap();
        for (a, b) in here.iter().zip(&turned) {
            assert!((a - b).abs() < 1e-12, "{lattice}: {here:?} {turned:?}");
        }
        // Waves are known up to a translation of the reciprocal lattice.
        let same = point::add(k, crystal.cell.reciprocal()[D - 1]);
        for (a, b) in here.iter().zip(&crystal.values(same).unwrap()) {
            assert!((a - b).abs() < 1e-12, "{lattice}: {here:?}");
        }
    }
}

/// Waves that a rotation of the lattice carries into each other are equally stiff.
#[test]
fn turned_waves_are_as_stiff() {
    check_turned(Lattice::Square, |[x, y]| [-y, x]);
    let (cos, sin) = (0.5, 0.75_f64.sqrt());
    check_turned(Lattice::Hexagonal, |[x, y]| {
        [cos * x - sin * y, sin * x + cos * y]
    });
    for lattice in [Lattice::SimpleCubic, Lattice::Bcc, Lattice::Fcc] {
        check_turned(lattice, |[x, y, z]| [y, z, x]);
        check_turned(lattice, |[x, y, z]| [-y, x, z]);
    }
    check_turned(Lattice::Hcp, |[x, y, z]| {
        [cos * x - sin * y, sin * x + cos * y, z]
    });
}

fn check_acoustic<const D: usize>(lattice: Lattice) {
    for kernel in KernelKind::ALL {
        let crystal = Crystal::<D>::new(lattice, kernel, 1.3);
        // Nothing holds a lattice as a whole.
        let values = crystal.values([0.0; D]).unwrap();
        let zeros = values.iter().filter(|value| value.abs() < 1e-12).count();
        assert_eq!(zeros, D, "{lattice} {kernel}: {values:?}");
        // Long waves are sound: their squares of frequency go with k².
        let [once, twice] = [1e-3, 2e-3].map(|k| {
            let values = crystal.values([k; D]).unwrap();
            values[D - 1] / (k * k)
        });
        assert!(
            (once / twice - 1.0).abs() < 1e-4,
            "{lattice} {kernel}: {once} {twice}"
        );
    }
}

#[test]
fn nothing_holds_a_lattice_as_a_whole() {
    check_acoustic::<2>(Lattice::Square);
    check_acoustic::<2>(Lattice::Hexagonal);
    for lattice in [
        Lattice::SimpleCubic,
        Lattice::Bcc,
        Lattice::Fcc,
        Lattice::Hcp,
    ] {
        check_acoustic::<3>(lattice);
    }
}

/// In the plane the square lattice shears, the hexagonal one stays; between 1.10 and 1.12 all close-packed ones do.
#[test]
fn close_packed_lattices_are_stable_where_square_ones_are_not() {
    let at = |lattice, h| softest(lattice, KernelKind::Quintic, h).expect("eigenvalues");
    for lattice in [Lattice::Square, Lattice::SimpleCubic] {
        let found = at(lattice, 1.11);
        assert!(found < -1e-4, "{lattice}: {found}");
    }
    for lattice in [Lattice::Hexagonal, Lattice::Bcc, Lattice::Fcc, Lattice::Hcp] {
        let found = at(lattice, 1.11);
        assert!(found > super::UNSTABLE, "{lattice}: {found}");
    }
    assert!(at(Lattice::Hexagonal, 1.3) < -1e-3);
}

/// Where some lattice is stable the one of least energy is, or as good as: elsewhere instabilities reach −0.1.
#[test]
fn auto_takes_a_stable_lattice_where_there_is_one() {
    for kernel in [
        KernelKind::Quintic,
        KernelKind::Cubic,
        KernelKind::WendlandC2,
        KernelKind::WendlandC4,
    ] {
        for dimension in [2, 3] {
            for h in [0.93, 1.0, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4] {
                let at = |lattice| softest(lattice, kernel, h).expect("eigenvalues");
                let of_dimension = Lattice::ALL
                    .into_iter()
                    .filter(|l| l.dimension() == dimension);
                // hcp costs most to look at, and is never the only one.
                let best = (of_dimension.filter(|&l| l != Lattice::Hcp))
                    .map(at)
                    .fold(f64::MIN, f64::max);
                let taken = Lattice::auto(dimension, kernel, h);
                assert!(
                    best < -1e-4 || at(taken) > -2e-3,
                    "{kernel:?} {h}: {taken} {}",
                    at(taken)
                );
            }
        }
    }
}
