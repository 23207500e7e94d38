//! `Stepper::steps` of one system: the bits, evaluations and kept values of a loop of steps.

use std::any::Any;
use std::cell::Cell;
use std::rc::Rc;
use std::slice;

use shadowstep::number::{DoubleDouble, Lanes, Limbs, Number};
use shadowstep::problems::{HenonHeiles, Kepler};
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::systems::kinetic::{Kinetic, Quadratic};
use shadowstep::systems::potential::{FewCoordinates, Vectorised};
use shadowstep::systems::system::Visitor;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Carried, DiagonalMasses, Motion, Potential, Rational, Stepper, System, UnitMasses, potential};

/// Sees that the states are those of steps one by one.
struct OneByOne<'a, M> {
    stepper: &'a Stepper<TableScheme, f64>,
    system: M,
    seen: u64,
}

impl<M: System<Number = f64, Class = Quadratic>> Visitor<f64> for OneByOne<'_, M> {
    fn visit(&mut self, q: &[f64], p: &[f64]) {
        self.stepper.step(&mut self.system);
        self.seen += 1;
        assert_eq!((self.system.state().q(), self.system.state().p()), (q, p), "state {}", self.seen);
    }
}

fn check_visited<M: System<Number = f64, Class = Quadratic>>(scheme: &str, start: impl Fn() -> M) {
    let stepper = Stepper::new(shipped(scheme).unwrap(), "1/50").unwrap();
    for count in [0, 1, 7, 8, 100] {
        let mut system = start();
        let mut one_by_one = OneByOne { stepper: &stepper, system: start(), seen: 0 };
        stepper.steps_visited(&mut system, count, &mut one_by_one);
        assert_eq!(one_by_one.seen, count);
        let mut one_by_one = one_by_one.system;
        same(&one_by_one, &system);
        stepper.step_augmented(&mut system);
        stepper.step_augmented(&mut one_by_one);
        same(&one_by_one, &system);
    }
}

#[test]
fn a_visitor_sees_the_states_of_steps_one_by_one() {
    let boxed = || -> Box<dyn Potential<f64>> { Box::new(HenonHeiles) };
    for scheme in ["stormer-verlet", "yoshida4", "saba4", "chin-4a"] {
        let arrays = || Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2], [0.1, 0.0]).unwrap();
        let vectors = || Motion::new(boxed(), UnitMasses, vec![0.1, 0.2], vec![0.1, 0.0]).unwrap();
        check_visited(scheme, arrays);
        check_visited(scheme, || arrays().compensated());
        check_visited(scheme, || arrays().fixed_point(&[2.0; 2], &[2.0; 2]).unwrap());
        check_visited(scheme, vectors);
        check_visited(scheme, || vectors().compensated());
    }
}

/// Steps of one system and of several, merged and not: the bits of each alone.
fn check_several<M: System<Number: Number<Context = ()> + PartialEq, Class = Quadratic>>(start: impl Fn(f64) -> M) {
    for scheme in ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b", "saba4", "ruth3", "chin-4a"] {
        let stepper = Stepper::<_, M::Number>::new(shipped(scheme).unwrap(), "1/20").unwrap();
        for (count, merged) in [0, 1, 7, 8, 9, 100].into_iter().flat_map(|count| [(count, false), (count, true)]) {
            let [mut alone, mut together] = [(); 2].map(|()| {
                let mut motions = [0.1, 0.2, 0.3, 0.15, 0.25, 0.35].map(&start);
                // one has a gradient that the first kick takes, another its rate as well
                motions[1].kick(&stepper.weights().kicks[0], Carried::Nothing);
                motions[2].kick(&stepper.weights().kicks[0], Carried::Rate);
                motions
            });
            let (first, others) = together.split_at_mut(1);
            for systems in [first, others] {
                match merged {
                    true => stepper.merged_steps(systems, count),
                    false => stepper.steps(systems, count),
                }
            }
            for (alone, of_several) in alone.iter_mut().zip(&mut together) {
                match merged {
                    true => stepper.merged_steps(slice::from_mut(alone), count),
                    false => (0..count).for_each(|_| stepper.step(alone)),
                }
                let what = format!("{scheme}, {count} steps, merged: {merged}");
                assert_eq!(
                    (alone.state().q(), alone.state().p()),
                    (of_several.state().q(), of_several.state().p()),
                    "{what}"
                );
                assert_eq!(alone.state().remainders(), of_several.state().remainders(), "{what}");
                assert_eq!(alone.state().evaluations(), of_several.state().evaluations(), "{what}");
                stepper.step_augmented(alone);
                stepper.step_augmented(of_several);
                assert_eq!(alone.state().increments().beta, of_several.state().increments().beta, "{what}");
                assert_eq!(alone.state().q(), of_several.state().q(), "{what}");
                assert_eq!(alone.state().evaluations(), of_several.state().evaluations(), "{what}");
            }
        }
    }
}

#[test]
fn steps_of_several_systems_are_those_of_each_alone() {
    let in_arrays = |x| Motion::new(HenonHeiles, UnitMasses, [x, 0.2], [0.1, 0.0]).unwrap();
    check_several(in_arrays);
    check_several(|x| in_arrays(x).compensated());
    check_several(|x| in_arrays(x).fixed_point(&[2.0; 2], &[2.0; 2]).unwrap());
    let in_vectors = |x| Motion::new(HenonHeiles, UnitMasses, vec![x, 0.2], vec![0.1, 0.0]).unwrap();
    check_several(in_vectors);
    check_several(|x| in_vectors(x).compensated());
}

/// Whose gradients are one program, with other parameters; or two programs.
#[test]
fn steps_of_several_systems_of_formulas_are_those_of_each_alone() {
    type FourLanes = Lanes<4>;
    let lanes = |x: f64| Lanes([x, x + 0.01, x + 0.02, x + 0.03]);
    let potential = |formula: &str, x: f64| {
        let parameters = [("depth", lanes(1.0 + x)), ("width", lanes(2.0 - x))];
        FormulaPotential::<FourLanes>::new(formula, &["x", "y"], &parameters).unwrap()
    };
    let at = |x: f64| ([lanes(x), lanes(0.2)], [lanes(0.1), lanes(0.0)]);
    let in_vectors = |formula: &str, x: f64| {
        let (q, p) = at(x);
        Motion::new(potential(formula, x), UnitMasses, q.to_vec(), p.to_vec()).unwrap()
    };
    let well = "-depth * exp(-(x^2 + y^2)/width) + sin(y)/7 + cos(y)/9 - 1/sqrt(3 + x^2)";
    check_several(|x| Motion::new(potential(well, x), UnitMasses, at(x).0, at(x).1).unwrap());
    check_several(|x| in_vectors(well, x));
    check_several(|x| in_vectors(well, x).compensated());
    check_several(|x| in_vectors(if x > 0.18 { well } else { "depth * (x^2 + y^2)/width" }, x));
}

/// Of lanes behind a `dyn`: potentials of one type and of several, which know their type and do not.
#[test]
fn steps_of_several_boxed_systems_are_those_of_each_alone() {
    type Boxed = Box<dyn Potential<Lanes<4>>>;
    let lanes = |x: f64| Lanes([x, x + 0.01, x + 0.02, x + 0.03]);
    let motion = |potential: Boxed, x: f64| {
        let q: Vec<_> = (0..potential.dimension()).map(|i| lanes(x + i as f64 / 8.0)).collect();
        let p = q.iter().rev().copied().collect();
        let masses = DiagonalMasses::of_each(
            &[3, 4, 5, 6]
                .map(|mass| {
                    let masses: Vec<_> = (0..q.len()).map(|i| 1.0 / f64::from(mass + i as u32)).collect();
                    DiagonalMasses::from_numbers(&masses).unwrap()
                })
                .each_ref(),
        );
        let kinetic: Box<dyn Kinetic<Lanes<4>, Class = Quadratic>> =
            if x > 0.22 { Box::new(masses.unwrap()) } else { Box::new(UnitMasses) };
        Motion::new(potential, kinetic, q, p).unwrap()
    };
    let spring = |x: f64| -> Boxed { Box::new(Vectorised(Spring { stiffness: lanes(1.0 + x) })) };
    let unknown = |x: f64| -> Boxed { Box::new(Spring { stiffness: lanes(1.0 + x) }) };
    let formula =
        |x: f64| -> Boxed { Box::new(FormulaPotential::new("a*cos(q)", &["q"], &[("a", lanes(x))]).unwrap()) };
    check_several(|x| motion(spring(x), x));
    check_several(|x| motion(unknown(x), x));
    check_several(|x| motion(formula(x), x));
    check_several(|x| motion(if x > 0.18 { spring(x) } else { unknown(x) }, x));
    check_several(|x| motion(if x > 0.18 { spring(x) } else { formula(x) }, x));
    check_several(|x| motion(Box::new(Vectorised(Kepler)), x));
    check_several(|x| motion(Box::new(Vectorised(Space)), x));
    check_several(|x| motion(Box::new(Vectorised(Chain)), x));
    check_several(|x| motion(spring(x), x).compensated_if(x > 0.18));
    check_several(|x| motion(spring(x), x).compensated_if(false));
}

// ---------------------------------------------------------------------------------------------------------------
// A potential and a kinetic energy behind a `dyn`: of a few coordinates many steps are one call

potential! { pub struct Spring { stiffness } U(q) = stiffness*q^2/2 }
potential! { pub struct Pendulum; U(q) = -cos(q) }
potential! { pub struct Space; U(x, y, z) = -1/sqrt(x^2 + 2*y^2 + 3*z^2) }
potential! { pub struct Chain; U(a, b, c, d) = (a - b)^4 + (b - c)^4 + (c - d)^4 + a^2 + d^2 }

/// Counts the calls that make many steps.
struct Watched<P> {
    potential: P,
    calls: Rc<Cell<u32>>,
}

impl<N: Number, P: Potential<N>> Potential<N> for Watched<P> {
    fn dimension(&self) -> usize {
        self.potential.dimension()
    }
    fn scratch(&self) -> usize {
        self.potential.scratch()
    }
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.potential.prepare(scratch, context);
    }
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        self.potential.energy(q, energy, scratch);
    }
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.potential.gradient(q, gradient, scratch);
    }
    fn hessian(&self) -> Option<&dyn shadowstep::systems::potential::HessianProduct<N>> {
        self.potential.hessian()
    }
    fn advance_few(&mut self, others: Vec<&mut dyn Any>, steps: &mut FewCoordinates<'_, N>) -> bool {
        self.calls.set(self.calls.get() + 1);
        self.potential.advance_few(others, steps)
    }
}

/// Makes steps one by one and together, of a potential behind a `dyn`; the calls that made many at once.
fn calls_for<N, P, K>(scheme: &str, potential: impl Fn() -> P, kinetic: impl Fn() -> K, compensated: bool) -> u32
where
    N: Number<Context = ()> + PartialEq + 'static,
    P: Potential<N> + 'static,
    K: Kinetic<N, Class = Quadratic> + 'static,
{
    let stepper = Stepper::<_, N>::new(shipped(scheme).unwrap(), "1/50").unwrap();
    let calls = Rc::new(Cell::new(0));
    let state = || {
        let number = |i: usize| N::from_rational(&Rational::new((3 + i).into(), 7.into()), &());
        let q: Vec<N> = (0..potential().dimension()).map(number).collect();
        let p: Vec<N> = q.iter().rev().cloned().collect();
        (q, p)
    };
    let known = || {
        let (q, p) = state();
        Motion::new(potential(), kinetic(), q, p).unwrap().compensated_if(compensated)
    };
    let boxed = || {
        let (q, p) = state();
        let potential: Box<dyn Potential<N>> = Box::new(Watched { potential: potential(), calls: calls.clone() });
        let kinetic: Box<dyn Kinetic<N, Class = Quadratic>> = Box::new(kinetic());
        Motion::new(potential, kinetic, q, p).unwrap().compensated_if(compensated)
    };
    for count in [7, 8, 100] {
        let [mut one_by_one, mut together] = [boxed(), boxed()];
        for motion in [&mut one_by_one, &mut together] {
            // a kick leaves a gradient that the first one together takes
            motion.kick(&stepper.weights().kicks[0], Carried::Nothing);
        }
        (0..count).for_each(|_| stepper.step(&mut one_by_one));
        stepper.steps(slice::from_mut(&mut together), count);
        same(&one_by_one, &together);
        stepper.step_augmented(&mut one_by_one);
        stepper.step_augmented(&mut together);
        same(&one_by_one, &together);
        assert_eq!(one_by_one.state().increments().beta, together.state().increments().beta);
        let (mut known, mut behind) = (known(), boxed());
        stepper.merged_steps(slice::from_mut(&mut known), count);
        stepper.merged_steps(slice::from_mut(&mut behind), count);
        same(&known, &behind);
    }
    calls.get()
}

fn same<N: Number + PartialEq>(a: &impl System<Number = N>, b: &impl System<Number = N>) {
    assert_eq!(
        (a.state().q(), a.state().p(), a.state().remainders()),
        (b.state().q(), b.state().p(), b.state().remainders())
    );
    assert_eq!(a.state().evaluations(), b.state().evaluations());
}

/// 8 steps and 100 steps, one by one and merged, are one call each.
const ALL: u32 = 4;

#[test]
fn steps_behind_a_dyn_are_one_call_with_the_same_bits() {
    for scheme in ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b", "saba4", "ruth3"] {
        assert_eq!(calls_for::<f64, _, _>(scheme, || Pendulum, || UnitMasses, false), ALL, "{scheme}");
        assert_eq!(calls_for::<f64, _, _>(scheme, || Kepler, || UnitMasses, false), ALL, "{scheme}");
        assert_eq!(calls_for::<f64, _, _>(scheme, || Space, || UnitMasses, false), ALL, "{scheme}");
        let masses = || DiagonalMasses::from_numbers(&[3.0, 0.7]).unwrap();
        assert_eq!(calls_for::<f64, _, _>(scheme, || Kepler, masses, false), ALL, "{scheme}");
    }
}

#[test]
fn other_steps_behind_a_dyn_are_those_one_by_one() {
    let unit = || UnitMasses;
    assert_eq!(calls_for::<f64, _, _>("yoshida4", || Chain, unit, false), 0, "four coordinates");
    assert_eq!(calls_for::<f64, _, _>("yoshida4", || Kepler, unit, true), 0, "compensated");
    assert_eq!(calls_for::<f64, _, _>("chin-4a", || Kepler, unit, false), 0, "gradient kicks");
    assert_eq!(calls_for::<DoubleDouble, _, _>("yoshida4", || Kepler, unit, false), 0, "two doubles");
    assert_eq!(calls_for::<Limbs<3>, _, _>("yoshida4", || Kepler, unit, false), 0, "long numbers");
}
