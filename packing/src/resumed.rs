//! Every method that iterates can be stopped anywhere and gone on with, to the same bits.

use std::io::{self, Write};
use std::ops::ControlFlow;

use sphpack_geometry::Ball;
use sphpack_neighbors::Domain;

use crate::{
    Agitated, Balanced, Complex, Coupled, Damaged, Finish, Hybrid, Keeper, MinimiserKind, Observer,
    Packed, PackingError, Ppa, Problem, Progress, Relaxation, RunLog, Settling, Silent, Stage,
    Standard,
};

pub(crate) type Pack<'a, const D: usize> =
    &'a dyn Fn(&mut dyn Observer) -> Result<Packed<D>, PackingError>;

/// Has a state kept before every step, and holds on to some.
#[derive(Default)]
struct Recorder {
    earlier: Option<Vec<u8>>,
    asked: usize,
    kept: Vec<Vec<u8>>,
    last: Vec<u8>,
    /// Stops the packing after so many steps.
    steps: Option<usize>,
}

impl Observer for Recorder {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        let is_moving = matches!(progress.stage, Stage::Capture | Stage::Settling);
        match self.steps {
            Some(most) if is_moving && self.asked >= most => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    }

    fn keeper(&mut self) -> Option<&mut dyn Keeper> {
        Some(self)
    }
}

impl Keeper for Recorder {
    fn is_due(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn keep(&mut self, write: &dyn Fn(&mut dyn Write) -> io::Result<()>) {
        self.last.clear();
        write(&mut self.last).expect("memory takes everything");
        // The first few, and then ever rarer ones.
        if self.asked <= 2 || (self.asked + 1).is_power_of_two() || self.asked.is_multiple_of(97) {
            self.kept.push(self.last.clone());
        }
    }

    fn earlier(&mut self) -> Option<Vec<u8>> {
        self.earlier.take()
    }
}

fn going_on_from(state: &[u8]) -> Recorder {
    Recorder {
        earlier: Some(state.to_vec()),
        ..Recorder::default()
    }
}

fn assert_same<const D: usize>(a: &Packed<D>, b: &Packed<D>, what: &str) {
    assert!(a.particles == b.particles, "{what}: particles");
    assert_eq!(a.stop_reason, b.stop_reason, "{what}");
    assert_eq!(a.iterations, b.iterations, "{what}");
    assert_eq!(a.force_evaluations, b.force_evaluations, "{what}");
    let history = |packed: &Packed<D>| -> Vec<_> {
        (packed.history.iter())
            .map(|sample| (sample.evaluation, sample.energy.to_bits(), sample.residual))
            .collect()
    };
    assert_eq!(history(a), history(b), "{what}");
}

/// That states change nothing, that from each of them the same comes, and that a stop loses nothing.
pub(crate) fn check<const D: usize>(pack: Pack<'_, D>) {
    let plain = pack(&mut Silent).expect("a sound problem");
    let mut recorder = Recorder::default();
    let recorded = pack(&mut recorder).expect("a sound problem");
    assert_same(&plain, &recorded, "kept at every step");
    assert!(recorder.kept.len() > 4, "{}", recorder.kept.len());
    for (number, state) in recorder.kept.iter().chain([&recorder.last]).enumerate() {
        let resumed = pack(&mut going_on_from(state)).expect("a sound state");
        assert_same(&plain, &resumed, &format!("from state {number}"));
    }
    // Stopped, gone on with, stopped again.
    let mut state = None;
    let mut stops = 0;
    loop {
        let mut stopped = Recorder {
            earlier: state.take(),
            steps: Some(recorder.asked.div_ceil(4)),
            ..Recorder::default()
        };
        let packed = pack(&mut stopped).expect("a sound problem");
        if packed.stop_reason != crate::StopReason::Interrupted {
            assert_same(&plain, &packed, "after stops");
            break;
        }
        stops += 1;
        assert!(stops < 9);
        state = Some(stopped.last);
    }
    assert!(stops > 1, "{stops}");
    damage(pack, &recorder.kept[recorder.kept.len() / 2]);
}

/// States that were changed are refused, or lead to something else; they never make it panic.
fn damage<const D: usize>(pack: Pack<'_, D>, state: &[u8]) {
    let shortly = |state: &[u8]| {
        let mut recorder = Recorder {
            steps: Some(1),
            ..going_on_from(state)
        };
        pack(&mut recorder)
    };
    let is_refused = |state: &[u8]| matches!(shortly(state), Err(PackingError::Earlier(Damaged)));
    for part in 0..12 {
        let end = state.len() * part / 12;
        assert!(end == 0 || is_refused(&state[..end]), "{end}");
    }
    assert!(is_refused(&[state, &[0]].concat()));
    let mut changed = state.to_vec();
    for k in 0..40 {
        let place = k * state.len() / 40 + k;
        for bits in [0x01, 0xff] {
            changed[place] ^= bits;
            let _ = shortly(&changed);
            changed[place] ^= bits;
        }
    }
}

/// A disc and a smaller one.
fn discs(spacing: f64) -> Problem<2> {
    Problem::new(Domain::new([-1.2, -1.0], [1.4, 1.0]), spacing)
        .body("disc", Ball::new([-0.3, 0.05], 0.5).expect("a disc"))
        .body("small", Ball::new([0.8, 0.1], 0.3).expect("a disc"))
}

#[test]
fn graded() {
    let mut problem = discs(0.06);
    let mut field = crate::Refinement::new(0.15, 1.1);
    for body in &problem.bodies {
        field = field.around(body.surface.clone(), 0.06);
    }
    problem.resolution = field.into();
    check(&|observer| Balanced::default().pack_in(&problem, &mut RunLog::new(observer)));
}

#[test]
fn balanced() {
    let problem = discs(0.1);
    for minimiser in MinimiserKind::ALL {
        let balanced = Balanced {
            settling: Settling {
                minimiser,
                max_evaluations: 300,
                ..Settling::default()
            },
            ..Balanced::default()
        };
        check(&|observer| balanced.pack_in(&problem, &mut RunLog::new(observer)));
    }
}

#[test]
fn balanced_in_a_periodic_box_with_a_band() {
    let mut domain = Domain::new([-3.0; 2], [3.0; 2]);
    domain.periodic = [true, false];
    let problem = Problem::new(domain, 0.1).body("disc", Ball::new([0.0; 2], 0.6).expect("a disc"));
    let balanced = Balanced {
        settling: Settling {
            residual_tolerance: Some(2e-4),
            ..Settling::default()
        },
        ..Balanced::default()
    };
    check(&|observer| balanced.pack_in(&problem, &mut RunLog::new(observer)));
}

#[test]
fn balanced_finishes() {
    for finish in [Finish::Both, Finish::Calm] {
        let balanced = Balanced {
            settling: Settling {
                finish,
                ..Settling::default()
            },
            ..Balanced::default()
        };
        check(&|observer| balanced.pack_in(&discs(0.12), &mut RunLog::new(observer)));
    }
}

#[test]
fn balanced_in_space() {
    // Large enough that its counts are not tried out, which would be done again at every beginning.
    let problem = Problem::new(Domain::new([-1.1; 3], [1.1; 3]), 0.25)
        .body("ball", Ball::new([0.0; 3], 0.73).expect("a ball"));
    let balanced = Balanced {
        settling: Settling {
            finish: Finish::Consistent,
            max_evaluations: 120,
            ..Settling::default()
        },
        ..Balanced::default()
    };
    check(&|observer| balanced.pack_in(&problem, &mut RunLog::new(observer)));
}

#[test]
fn hybrid() {
    let problem = discs(0.15);
    let hybrid = Hybrid {
        velocity_tolerance: 1e-3,
        ..Hybrid::default()
    };
    check(&|observer| hybrid.pack_in(&problem, &mut RunLog::new(observer)));
    let accelerated = Hybrid {
        settling: Some(Settling::default()),
        predicted: 0.9,
        moving_over_spacing: 3.5,
        ..Hybrid::default()
    };
    check(&|observer| accelerated.pack_in(&problem, &mut RunLog::new(observer)));
}

#[test]
fn standard() {
    let standard = Standard {
        max_iterations: 400,
        ..Standard::default()
    };
    check(&|observer| standard.pack_in(&discs(0.12), &mut RunLog::new(observer)));
}

#[test]
fn coupled() {
    let coupled = Coupled {
        apart_iterations: 150,
        max_iterations: 500,
        ..Coupled::default()
    };
    check(&|observer| coupled.pack_in(&discs(0.12), &mut RunLog::new(observer)));
}

#[test]
fn agitated() {
    let agitated = Agitated {
        revolution: 20.0,
        max_iterations: 700,
        ..Agitated::default()
    };
    check(&|observer| agitated.pack_in(&discs(0.15), &mut RunLog::new(observer)));
}

#[test]
fn ppa() {
    let ppa = Ppa {
        max_iterations: 400,
        ..Ppa::default()
    };
    check(&|observer| ppa.pack_in(&discs(0.12), &mut RunLog::new(observer)));
}

#[test]
fn relaxation() {
    let relaxation = Relaxation {
        max_iterations: 300,
        ..Relaxation::default()
    };
    check(&|observer| relaxation.pack_in(&discs(0.12), &mut RunLog::new(observer)));
}

#[test]
fn complex() {
    let complex = Complex {
        relaxation: Relaxation {
            max_iterations: 250,
            ..Relaxation::default()
        },
        ..Complex::default()
    };
    check(&|observer| complex.pack_in(&discs(0.12), &mut RunLog::new(observer)));
}
