//! Protects multiple time steps: a nested step is the loops that its table describes, has the order proved, its
//! modified energy, and as many evaluations of slow and fast forces as are said.

use std::cell::Cell;
use std::rc::Rc;

use rug::Float;
use shadowstep::number::CorrectlyRounded;
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::energy_drift;
use shadowstep::systems::many_parts::{FlowState, ManyParts, Part, SystemOfParts, parts};
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Carried, Scheme as _, Stepper, System as _, splitting_scheme};
use shadowstep_tests::{coordinates, log10_largest_distance, numbers, precision, rational, same_bits};

const DIGITS: u32 = 60;

#[splitting_scheme("nested-s6.toml", parts = 3)]
#[derive(Clone, Copy)]
struct NestedS6;

fn nested(name: &str) -> TableScheme<ManyParts> {
    shipped(name).unwrap().for_many_parts().unwrap()
}

/// A soft force on two atoms with a stiff bond that is not harmonic.
const MOLECULE: [&str; 3] = ["cos(x) + cos(y)/2 + x*y/9", "20*((x - y)^2 - 1)^2", "px^2/2 + py^2/3"];

fn molecule<N: CorrectlyRounded + 'static>(context: &N::Context) -> SystemOfParts<N> {
    let parts = parts(&MOLECULE, (&["x", "y"], &["px", "py"]), &[], context).unwrap();
    let (q, p) = (numbers(&["0.4", "-0.7"], context), numbers(&["0.3", "0.6"], context));
    SystemOfParts::new(parts, &q, &p).unwrap()
}

/// Tuckerman, Berne and Martyna's loops.
#[test]
fn a_step_is_the_loops_of_its_table_bit_for_bit() {
    let mut system = molecule::<f64>(&());
    let stepper = Stepper::new(nested("r-respa-4"), "1/8").unwrap();
    (0..5).for_each(|_| stepper.step(&mut system));
    // weights of h = 1/8 and four substeps are powers of two
    let (h, substeps) = (0.125, 4);
    let small = h / f64::from(substeps);
    let [slow, fast, kinetic] =
        parts::<f64>(&MOLECULE, (&["x", "y"], &["px", "py"]), &[], &()).unwrap().try_into().ok().unwrap();
    let mut flows = [slow, fast, kinetic];
    let mut other = molecule::<f64>(&());
    let mut flow = |part: usize, time: f64| {
        flows[part].flow(&time, &mut FlowState::new(other.state_mut(), Carried::Nothing), false);
    };
    for _ in 0..5 {
        flow(0, h / 2.0);
        flow(1, small / 2.0);
        for substep in 1..=substeps {
            flow(2, small);
            flow(1, if substep == substeps { small / 2.0 } else { small });
        }
        flow(0, h / 2.0);
    }
    assert!(same_bits(&coordinates(&system), &coordinates(&other)));
}

#[test]
fn the_orders_are_those_proved() {
    let context = precision(DIGITS);
    let ended = |scheme: TableScheme<ManyParts>, steps: u32| {
        let stepper = Stepper::with_context(scheme, rational(&format!("1/{steps}")), &context).unwrap();
        let mut system = molecule::<Float>(&context);
        (0..steps).for_each(|_| stepper.step(&mut system));
        coordinates(&system)
    };
    let exact = ended(shipped("kahan-li8").unwrap().for_many_parts().unwrap(), 1 << 11);
    for (name, steps) in [("r-respa-4", 64), ("r-respa-8", 64), ("nested-s6", 32)] {
        let scheme = nested(name);
        let proved = f64::from(scheme.proved().proof.many_parts.as_ref().unwrap().order);
        let error = |steps| log10_largest_distance(&ended(scheme.clone(), steps), &exact) / std::f64::consts::LOG10_2;
        let order = error(steps) - error(2 * steps);
        println!("{name}: {order:.3}, proved {proved}");
        assert!((order - proved).abs() < 0.15, "{name}: {order} measured, {proved} proved");
    }
}

/// E_8 of a symmetric scheme is off by h^16.
#[test]
fn the_modified_energy_converges() {
    let context = precision(DIGITS);
    let drift = |name, h: &str| {
        let stepper = Stepper::with_context(nested(name), h, &context).unwrap();
        energy_drift(stepper.with(molecule::<Float>(&context)), 200, &Bilinear::new(8)).unwrap().drift.to_f64()
    };
    for name in ["r-respa-4", "nested-s6"] {
        let found = ["1/80", "1/160"].map(|h| drift(name, h));
        println!("{name}: {found:?}");
        let order = (found[0] / found[1]).log2();
        assert!((order - 16.0).abs() < 1.0, "{name}: {order}, {found:?}");
    }
}

#[test]
fn generated_steps_have_the_bits_of_their_twins_and_are_undone() {
    let twin = nested("nested-s6");
    assert_eq!(NestedS6.summary(), twin.summary());
    let (generated, twin) = (Stepper::new(NestedS6, "1/10").unwrap(), Stepper::new(twin, "1/10").unwrap());
    let [mut one, mut other] = [(); 2].map(|()| molecule::<f64>(&()));
    let start = coordinates(&one);
    for back in [false, true] {
        for _ in 0..20 {
            match back {
                false => (generated.step_augmented(&mut one), twin.step(&mut other)),
                true => (generated.step_back(&mut one), twin.step_back_augmented(&mut other)),
            };
            assert!(same_bits(&coordinates(&one), &coordinates(&other)));
        }
        let off = log10_largest_distance(&coordinates(&one), &start);
        assert!(if back { off < -13.0 } else { off > -1.0 }, "10^{off}");
    }
}

/// ½kq² as a part that counts its evaluations.
struct Spring {
    k: f64,
    slope: f64,
    evaluations: Rc<Cell<usize>>,
}

impl Part<f64> for Spring {
    fn add_energy(&mut self, q: &[f64], _: &[f64], energy: &mut f64) {
        *energy += self.k * q[0] * q[0] / 2.0;
    }

    fn flow(&mut self, time: &f64, state: &mut FlowState<'_, f64>, continues: bool) {
        if !continues {
            self.slope = self.k * state.q()[0];
            self.evaluations.set(self.evaluations.get() + 1);
        }
        state.subtract_product(1, time, &self.slope);
    }

    fn is_potential(&self, _: usize) -> bool {
        true
    }
}

#[test]
fn fast_forces_are_evaluated_once_for_each_substep_and_slow_ones_once_for_each_step() {
    for (name, slow, fast) in [("r-respa-4", 1, 4), ("r-respa-8", 1, 8), ("nested-s6", 6, 36)] {
        let scheme = nested(name);
        assert_eq!(scheme.plan().evaluations, slow, "{name}");
        assert_eq!(scheme.plan().count(shadowstep::steps::scheme::MapKind::Drift), fast, "{name}");
        let counts = [(); 2].map(|()| Rc::new(Cell::new(0)));
        let spring = |k, count: &Rc<Cell<usize>>| {
            Box::new(Spring { k, slope: 0.0, evaluations: Rc::clone(count) }) as Box<dyn Part<f64>>
        };
        let kinetic = parts::<f64>(&["p^2/2"], (&["q"], &["p"]), &[], &()).unwrap().pop().unwrap();
        let all = vec![spring(1.0, &counts[0]), spring(100.0, &counts[1]), kinetic];
        let mut system = SystemOfParts::new(all, &[1.0], &[0.0]).unwrap();
        let stepper = Stepper::new(scheme, "1/100").unwrap();
        (0..100).for_each(|_| stepper.step(&mut system));
        // and those at the start
        assert_eq!(counts.map(|count| count.get()), [100 * slow + 1, 100 * fast + 1], "{name}");
    }
}

#[test]
#[should_panic(expected = "an inner scheme is for H of three parts, and this one has 4")]
fn more_than_three_parts_are_refused() {
    let four = ["x^2/2", "x^4", "cos(x)", "px^2/2"];
    let parts = parts::<f64>(&four, (&["x"], &["px"]), &[], &()).unwrap();
    let mut system = SystemOfParts::new(parts, &[1.0], &[0.0]).unwrap();
    Stepper::new(nested("r-respa-4"), "1/10").unwrap().step(&mut system);
}
